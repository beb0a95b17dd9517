# cmake -DOUTPUT=file.cpp -P embed.cmake -- a.json b.bvh ...: writes a C++ source that holds the files' bytes, so that the
# program finds them from any folder.
set(arrays "")
set(table "")
set(index 0)
set(in_files FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  set(file "${CMAKE_ARGV${i}}")
  if(in_files)
    get_filename_component(name "${file}" NAME)
    file(READ "${file}" bytes HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
    string(APPEND arrays "constexpr char kFile${index}[] = {${bytes}};\n")
    string(APPEND table "    {\"${name}\", {kFile${index}, sizeof kFile${index}}},\n")
    math(EXPR index "${index} + 1")
  elseif(file STREQUAL "--")
    set(in_files TRUE)
  endif()
endforeach()
file(WRITE "${OUTPUT}" "// Written by demo/scenes/embed.cmake.
#include \"demo/scenes/shipped_files.h\"

namespace pleat::demo {
namespace {

${arrays}
constexpr ShippedFile kTable[] = {
${table}};

}  // namespace

const std::span<const ShippedFile> kShippedFiles = kTable;

}  // namespace pleat::demo
")
