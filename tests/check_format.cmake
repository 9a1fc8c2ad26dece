# Fails on a source that clang-format would write otherwise (mend with clang-format -i FILE), and on comments beyond
# its column limit: it wraps none that begin with ///, which hold equations and tables.
#   cmake -DROOT=<source folder> -DCLANG_FORMAT=<program> -P check_format.cmake
cmake_minimum_required(VERSION 3.25)
set(patterns "")
set(rooms mesh fem contact solver pipelines tests)
foreach(room IN LISTS rooms)
  list(APPEND patterns ${ROOT}/${room}/*.hpp ${ROOT}/${room}/*.cpp)
endforeach()
file(GLOB_RECURSE files ${patterns})
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files} RESULT_VARIABLE result
  ERROR_VARIABLE complaints)
if(NOT result EQUAL 0)
  string(SUBSTRING "${complaints}" 0 4000 complaints)
  message(FATAL_ERROR "not formatted:\n${complaints}")
endif()

# Characters, not bytes. Texts in strings may be longer.
execute_process(WORKING_DIRECTORY ${ROOT}
  COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C.UTF-8
    grep -rnE --include=*.hpp --include=*.cpp "^.{101,}$" ${rooms}
  COMMAND grep -E "^[^:]*:[0-9]+:(.*[ ])?//"
  OUTPUT_VARIABLE long_comments)
if(long_comments)
  string(SUBSTRING "${long_comments}" 0 4000 long_comments)
  message(FATAL_ERROR "comments longer than 100 characters:\n${long_comments}")
endif()
