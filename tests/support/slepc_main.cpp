// main() of tests that need PETSc: the session is made first and dies last.
#include <gtest/gtest.h>

#include "fem/slepc_session.hpp"
#include "tests/support/run_tests.hpp"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const microslip::fem::SlepcSession session;
  return microslip::test::run_tests(argc, argv);
}
