#include "contact/spare_cores.hpp"

#include <atomic>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace microslip::contact::test_spare_cores {
namespace {

/// A test leaves nothing to spare.
class SpareCores : public ::testing::Test {
 protected:
  void TearDown() override { allow_cores(1); }
};

/// Threads that took part in tasks, each of which waits for all n to have begun or,
/// if they never do, for `looks`.
std::size_t threads_of(std::size_t n, int looks) {
  std::vector<std::thread::id> ids(n);
  std::atomic<std::size_t> begun{0};
  run_on_spare_cores(n, [&](std::size_t i) {
    ids[i] = std::this_thread::get_id();
    ++begun;
    for (int look = 0; look < looks && begun < n; ++look) std::this_thread::yield();
  });
  return std::set<std::thread::id>(ids.begin(), ids.end()).size();
}

constexpr int patient = 100'000'000;
constexpr int brief = 100;

TEST_F(SpareCores, EveryTaskIsDoneOnceForAnyNumberOfCores) {
  for (const int n_cores : {1, 2, 5}) {
    allow_cores(n_cores);
    for (const std::size_t n : {0U, 1U, 2U, 7U, 100U}) {
      for (int again = 0; again < 50; ++again) {
        std::vector<int> done(n, 0);
        run_on_spare_cores(n, [&](std::size_t i) { ++done[i]; });
        EXPECT_EQ(done, std::vector<int>(n, 1)) << n_cores << " cores";
      }
    }
  }
}

TEST_F(SpareCores, TasksRunSideBySideWhereThereAreCores) {
  allow_cores(3);
  EXPECT_EQ(threads_of(3, patient), 3U);
}

TEST_F(SpareCores, WithOneCoreTheCallerDoesAll) {
  allow_cores(1);
  EXPECT_EQ(threads_of(4, brief), 1U);
}

TEST_F(SpareCores, WhoComputesTakesACoreAndWhoWaitsGivesItBack) {
  allow_cores(2);
  {
    const CoreShare busy(CoreShare::Kind::taken);
    EXPECT_EQ(threads_of(4, brief), 1U);
    const CoreShare waiting(CoreShare::Kind::given_back);
    EXPECT_EQ(threads_of(2, patient), 2U);
  }
  EXPECT_EQ(threads_of(2, patient), 2U);
}

TEST_F(SpareCores, TasksMayAskForCoresThemselves) {
  allow_cores(3);
  std::atomic<int> done{0};
  run_on_spare_cores(4, [&](std::size_t) { run_on_spare_cores(5, [&](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 20);
}

TEST_F(SpareCores, TheFirstExceptionIsThrownOnAndTheCoresAreThereAgain) {
  allow_cores(2);
  EXPECT_THROW(run_on_spare_cores(10,
                                  [](std::size_t i) {
                                    if (i == 3) throw std::runtime_error("third");
                                  }),
               std::runtime_error);
  EXPECT_EQ(threads_of(2, patient), 2U);
}

}  // namespace
}  // namespace microslip::contact::test_spare_cores
