# Fails on a source that clang-format would write otherwise; mend with clang-format -i FILE.
#   cmake -DROOT=<source folder> -DCLANG_FORMAT=<program> -P check_format.cmake
cmake_minimum_required(VERSION 3.25)
set(patterns "")
foreach(room IN ITEMS mesh fem contact solver pipelines tests)
  list(APPEND patterns ${ROOT}/${room}/*.hpp ${ROOT}/${room}/*.cpp)
endforeach()
file(GLOB_RECURSE files ${patterns})
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files} RESULT_VARIABLE result
  ERROR_VARIABLE complaints)
if(NOT result EQUAL 0)
  string(SUBSTRING "${complaints}" 0 4000 complaints)
  message(FATAL_ERROR "not formatted:\n${complaints}")
endif()
