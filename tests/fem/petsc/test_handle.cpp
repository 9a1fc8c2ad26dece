#include "fem/petsc/handle.hpp"

#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "fem/petsc/petsc_check.hpp"

namespace microslip::fem::test_handle {
namespace {

// Number of owners PETSC sees, itself held once more to look at it after the handle let go.
PetscInt owners(Mat matrix) {
  PetscInt n = 0;
  check(PetscObjectGetReference(reinterpret_cast<PetscObject>(matrix), &n));
  return n;
}

Mat create_watched(MatHandle& handle) {
  check(MatCreate(PETSC_COMM_SELF, handle.out()));
  check(PetscObjectReference(reinterpret_cast<PetscObject>(handle.get())));
  return handle.get();
}

TEST(Handle, DestroysWhatItHoldsOnce) {
  Mat watched = nullptr;
  {
    MatHandle handle;
    watched = create_watched(handle);
    EXPECT_EQ(owners(watched), 2);
  }
  EXPECT_EQ(owners(watched), 1);
  check(MatDestroy(&watched));
}

TEST(Handle, IsEmptyAfterBeingMovedFrom) {
  MatHandle first;
  Mat watched = create_watched(first);
  {
    MatHandle second(std::move(first));
    EXPECT_FALSE(
        static_cast<bool>(first));  // NOLINT(bugprone-use-after-move): the point of the test
    EXPECT_EQ(second.get(), watched);
    MatHandle third;
    third = std::move(second);
    EXPECT_FALSE(static_cast<bool>(second));  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(owners(watched), 2);
  }
  EXPECT_EQ(owners(watched), 1);
  check(MatDestroy(&watched));
}

TEST(Handle, LetsGoOfTheOldWhenGivenTheNew) {
  MatHandle handle;
  Mat first = create_watched(handle);
  Mat second = create_watched(handle);
  EXPECT_EQ(owners(first), 1);
  MatHandle other;
  Mat third = create_watched(other);
  handle = std::move(other);
  EXPECT_EQ(owners(second), 1);
  EXPECT_EQ(owners(third), 2);
  for (Mat* watched : {&first, &second, &third}) check(MatDestroy(watched));
}

TEST(Handle, CannotBeCopied) {
  static_assert(!std::is_copy_constructible_v<MatHandle>);
  static_assert(!std::is_copy_assignable_v<MatHandle>);
  static_assert(std::is_nothrow_move_constructible_v<MatHandle>);
  static_assert(std::is_nothrow_move_assignable_v<MatHandle>);
}

}  // namespace
}  // namespace microslip::fem::test_handle
