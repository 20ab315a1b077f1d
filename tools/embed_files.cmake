# Writes OUTPUT, a C++ file that holds the text of FILES (separated by |) as constants, found by their names without folder.
#   cmake -DOUTPUT=page_files.cpp -DFILES=a/page.html|b/page.css -P embed_files.cmake
cmake_minimum_required(VERSION 3.25)
string(REPLACE "|" ";" files "${FILES}")
set(entries "")
foreach(path IN LISTS files)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" content)
  if(content MATCHES "\\)embedded\"")
    message(FATAL_ERROR "${path} cannot be embedded: it holds the end mark")
  endif()
  string(APPEND entries "    {\"${name}\"sv, R\"embedded(${content})embedded\"sv},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"view/embedded.hpp\"

#include <stdexcept>
#include <utility>

namespace mamo::view {
namespace {

using namespace std::string_view_literals;

constexpr std::pair<std::string_view, std::string_view> kFiles[] = {
${entries}};

}  // namespace

std::string_view embedded(std::string_view name) {
  for (const auto& [known, content] : kFiles)
    if (known == name) return content;
  throw std::logic_error(\"no embedded file \" + std::string(name));
}

}  // namespace mamo::view
")
