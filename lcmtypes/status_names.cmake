# Writes a C++ header with the words for the numbers of the messages, read from the constants in
# the .lcm files:
#
#   const int8_t STATUS_SCALE_HELD = 2;   in ego_motion_t.lcm
#
# becomes entry 2, "scale_held", of kEgoMotionStatusNames. A group is what precedes the first
# underscore; its constants must count 0, 1, 2, ... in the order of the file.
#
#   cmake -DTYPES=a.lcm,b.lcm -DOUT=status_names.hpp -P status_names.cmake
cmake_minimum_required(VERSION 3.22)
string(REPLACE "," ";" TYPES "${TYPES}")

# ego_motion -> EgoMotion
function(camel_case words result)
  string(REPLACE "_" ";" words "${words}")
  set(joined "")
  foreach(word ${words})
    string(SUBSTRING ${word} 0 1 head)
    string(SUBSTRING ${word} 1 -1 tail)
    string(TOUPPER ${head} head)
    string(APPEND joined ${head}${tail})
  endforeach()
  set(${result} ${joined} PARENT_SCOPE)
endfunction()

string(CONCAT text
  "// Written by lcmtypes/status_names.cmake from the constants of the .lcm files.\n"
  "#pragma once\n\n#include <array>\n\nnamespace plumb {\n\n")
foreach(type ${TYPES})
  get_filename_component(name ${type} NAME_WE)
  string(REGEX REPLACE "_t$" "" name ${name})
  camel_case(${name} type_name)
  file(STRINGS ${type} lines REGEX "^ *const int8_t +[A-Z]+_[A-Z0-9_]+ *= *[0-9]+;")
  set(groups "")
  foreach(line ${lines})
    string(REGEX MATCH "int8_t +([A-Z]+)_([A-Z0-9_]+) *= *([0-9]+)" ignored "${line}")
    set(group ${CMAKE_MATCH_1})
    string(TOLOWER ${CMAKE_MATCH_2} word)
    set(number ${CMAKE_MATCH_3})
    list(LENGTH words_${group} count)
    if(group STREQUAL "MAX")
      continue()  # a limit, and no word
    endif()
    if(NOT group IN_LIST groups)
      list(APPEND groups ${group})
      set(words_${group} "")
      set(count 0)
    endif()
    if(NOT number EQUAL count)
      message(FATAL_ERROR "${type}: ${group}_* must count 0, 1, 2, ...; ${number} follows ${count} others")
    endif()
    list(APPEND words_${group} ${word})
  endforeach()
  foreach(group ${groups})
    string(TOLOWER ${group} group_name)
    camel_case(${group_name} group_name)
    list(LENGTH words_${group} count)
    list(JOIN words_${group} "\", \"" words)
    string(APPEND text "inline constexpr std::array<const char*, ${count}> k${type_name}${group_name}Names = {\n"
      "    \"${words}\"};\n")
  endforeach()
endforeach()
string(APPEND text "\n}  // namespace plumb\n")
file(WRITE ${OUT} "${text}")
