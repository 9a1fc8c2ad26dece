#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "fem/blas_threads.hpp"
#include "fem/petsc/handle.hpp"
#include "fem/slepc_session.hpp"

namespace microslip::fem::test_petsc_error {
namespace {

std::string message_of_a_failing_call() {
  MatHandle matrix;
  check(MatCreate(PETSC_COMM_SELF, matrix.out()));
  try {
    check(MatSetType(matrix.get(), "no_such_type"));
  } catch (const PetscError& error) {
    return error.what();
  }
  return {};
}

TEST(PetscError, SaysWhatTheLibrarySaidAndWhereItWasCalled) {
  const std::string message = message_of_a_failing_call();
  EXPECT_NE(message.find("no_such_type"), std::string::npos) << message;
  EXPECT_NE(message.find("test_petsc_error.cpp:"), std::string::npos) << message;
  EXPECT_EQ(message.find('/'), std::string::npos) << "a folder of this machine: " << message;
}

TEST(PetscError, PrintsNothing) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_FALSE(message_of_a_failing_call().empty());
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(PetscError, ForgetsTheWordsOfAnEarlierError) {
  EXPECT_FALSE(message_of_a_failing_call().empty());
  try {
    check(PETSC_ERR_ARG_WRONG);
    FAIL() << "a code that is not 0 passed";
  } catch (const PetscError& error) {
    EXPECT_EQ(std::string(error.what()).find("no_such_type"), std::string::npos) << error.what();
  }
}

TEST(PetscError, MemoryThatIsNotThereIsAMemoryError) {
  double* values = nullptr;
  try {
    check(PetscMalloc1(std::size_t{1} << 45, &values));  // 2^48 bytes: more than an address space
    FAIL() << "it was there";
  } catch (const MemoryError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("out of memory: ", 0), 0U) << error.what();
  }
}

TEST(SlepcSession, ASecondOneIsRefused) { EXPECT_THROW(SlepcSession(), std::logic_error); }

TEST(SlepcSession, NamesItsLibraries) {
  std::string names;
  for (const auto& [library, version] : library_versions()) names += library + " " + version + "\n";
  for (const char* name : {"PETSc 3.", "SLEPc 3.", "MUMPS 5.", "MPI Open MPI"}) {
    EXPECT_NE(names.find(name), std::string::npos) << names;
  }
  EXPECT_NE(blas_description().find("BLAS"), std::string::npos) << blas_description();
}

}  // namespace
}  // namespace microslip::fem::test_petsc_error
