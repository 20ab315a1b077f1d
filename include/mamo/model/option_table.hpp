// Options of planners by documented name: one declaration gives default, meaning, range check and parsing.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace mamo {

struct OptionDoc {
  std::string name, default_value, meaning;
};

/// Bound to variables that hold the defaults. apply() throws std::invalid_argument naming the option, the
/// value, what was expected and, for an unknown name, the nearest known one.
class OptionTable {
 public:
  void add(const std::string& name, double& value, double least, double most, const std::string& meaning);
  void add(const std::string& name, int& value, int least, int most, const std::string& meaning);
  void add(const std::string& name, bool& value, const std::string& meaning);
  void add(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
           const std::string& meaning);

  void apply(const std::map<std::string, std::string>& settings) const;
  const std::vector<OptionDoc>& docs() const { return docs_; }

 private:
  std::map<std::string, std::function<void(const std::string&)>> set_;
  std::vector<OptionDoc> docs_;
};

}  // namespace mamo
