// main() of tests that open no library.
#include <gtest/gtest.h>

#include "tests/support/run_tests.hpp"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return microslip::test::run_tests(argc, argv);
}
