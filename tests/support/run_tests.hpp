/// @file
/// The tests of a program that are written in one file: each file has an entry in CTest, several
/// share a program, which is compiled and linked once.
#pragma once

#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace microslip::test {

/// Names of the tests written in `file`.cpp, as a filter of GoogleTest.
inline std::string tests_of(std::string_view file) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::string names;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (std::filesystem::path(test.file()).stem() != file) continue;
      names += std::string(names.empty() ? "" : ":") + suite.name() + "." + test.name();
    }
  }
  return names;
}

/// Runs what `--file=NAME` chooses, everything without it;
/// what --gtest_filter=-… leaves out stays out.
/// @return exit code; 1 as well where no test is written in that file.
inline int run_tests(int argc, char** argv) {
  constexpr std::string_view option = "--file=";
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(option)) continue;
    const std::string names = tests_of(argument.substr(option.size()));
    if (names.empty()) {
      std::cerr << "no test is written in " << argument.substr(option.size()) << ".cpp\n";
      return 1;
    }
    const std::string given = GTEST_FLAG_GET(filter);
    const std::size_t left_out = given.find('-');
    GTEST_FLAG_SET(filter, left_out == std::string::npos ? names : names + given.substr(left_out));
  }
  return RUN_ALL_TESTS();
}

}  // namespace microslip::test
