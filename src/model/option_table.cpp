#include "mamo/model/option_table.hpp"

#include <charconv>
#include <sstream>
#include <stdexcept>

#include "mamo/common/nearest_name.hpp"

namespace mamo {
namespace {

template <class T>
T parse_number(const std::string& name, const std::string& text, T least, T most) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= least && value <= most) return value;
  std::ostringstream message;
  message << "option " << name << ": '" << text << "' is no number from " << least << " to " << most;
  throw std::invalid_argument(message.str());
}

template <class T>
std::string shown(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

void OptionTable::add(const std::string& name, double& value, double least, double most, const std::string& meaning) {
  docs_.push_back({name, shown(value), meaning});
  set_[name] = [=, &value](const std::string& text) { value = parse_number<double>(name, text, least, most); };
}

void OptionTable::add(const std::string& name, int& value, int least, int most, const std::string& meaning) {
  docs_.push_back({name, shown(value), meaning});
  set_[name] = [=, &value](const std::string& text) { value = parse_number<int>(name, text, least, most); };
}

void OptionTable::add(const std::string& name, bool& value, const std::string& meaning) {
  docs_.push_back({name, value ? "true" : "false", meaning});
  set_[name] = [=, &value](const std::string& text) {
    if (text != "true" && text != "false")
      throw std::invalid_argument("option " + name + ": '" + text + "' is neither true nor false");
    value = text == "true";
  };
}

void OptionTable::add(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
                      const std::string& meaning) {
  docs_.push_back({name, value, meaning});
  set_[name] = [=, &value](const std::string& text) {
    if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
      std::string list;
      for (const std::string& a : allowed) list += (list.empty() ? "" : ", ") + a;
      throw std::invalid_argument("option " + name + ": '" + text + "' is none of " + list);
    }
    value = text;
  };
}

void OptionTable::apply(const std::map<std::string, std::string>& settings) const {
  for (const auto& [name, text] : settings) {
    const auto found = set_.find(name);
    if (found == set_.end()) {
      std::vector<std::string> known;
      for (const OptionDoc& d : docs_) known.push_back(d.name);
      throw std::invalid_argument("no option is called '" + name + "'; the nearest is " + nearest_name(name, known));
    }
    found->second(text);
  }
}

}  // namespace mamo
