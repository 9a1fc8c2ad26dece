#include "fem/machine_memory.hpp"

#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "fem/ranks.hpp"
#include "tests/support/address_space.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::fem::test_machine_memory {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(MachineMemory, IsThatOfAMachine) {
  EXPECT_GT(available_memory_here().megabytes, 10.0);
  EXPECT_LT(available_memory_here().megabytes, 1e9);
  EXPECT_GT(available_memory_mb(), 10.0);
  EXPECT_LE(available_memory_mb(), available_memory_here().megabytes * 1.1);  // others use it too
}

TEST(MachineMemory, OfGroupsIsTheSmallestOfThoseAbove) {
  const test::TemporaryFolder folder;
  const auto root = folder.path();
  write(root / "groups", "0::/outer/inner\n");
  write(root / "outer/memory.max", "3000000000\n");
  write(root / "outer/memory.current", "1000000000\n");
  write(root / "outer/memory.stat", "anon 600000000\ninactive_file 400000000\n");
  write(root / "outer/inner/memory.max", "max\n");
  write(root / "outer/inner/memory.current", "500000000\n");
  EXPECT_DOUBLE_EQ(memory_left_in_groups(root / "groups", root), 2400.0);
  write(root / "outer/inner/memory.max", "700000000\n");
  EXPECT_DOUBLE_EQ(memory_left_in_groups(root / "groups", root), 200.0);
  write(root / "outer/inner/memory.current", "800000000\n");
  EXPECT_DOUBLE_EQ(memory_left_in_groups(root / "groups", root), 0.0);
}

TEST(MachineMemory, OfGroupsOfVersionOneIsFoundToo) {
  const test::TemporaryFolder folder;
  const auto root = folder.path();
  write(root / "groups", "5:cpu,cpuacct:/job\n4:memory:/job\n");
  write(root / "memory/memory.limit_in_bytes", "9223372036854771712\n");
  write(root / "memory/memory.usage_in_bytes", "5000000000\n");
  EXPECT_EQ(memory_left_in_groups(root / "groups", root), HUGE_VAL);
  write(root / "memory/job/memory.limit_in_bytes", "2000000000\n");
  write(root / "memory/job/memory.usage_in_bytes", "500000000\n");
  EXPECT_DOUBLE_EQ(memory_left_in_groups(root / "groups", root), 1500.0);
  EXPECT_EQ(memory_left_in_groups(root / "no such file", root), HUGE_VAL);
}

TEST(MachineMemory, IsWhatTheAddressSpaceLeaves) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer takes terabytes of address space";
#endif
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit little{.rlim_cur = 6'000'000'000, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  const AvailableMemory available = available_memory_here();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_LT(available.megabytes, 6000.0 * n_ranks_here());
  if (available.megabytes > 0.0 && available.limited_by.find("ulimit") == std::string::npos) {
    EXPECT_LT(available.megabytes, available_memory_here().megabytes * 1.1);  // less still
  }
}

// The machine is one for all ranks, an address space is not: two ranks have twice that of one.
TEST(MachineMemory, OfEveryRankIsAnAddressSpaceOfItsOwn) {
  constexpr double left = 500.0;  // [MB], of each
  const double without = available_memory_mb();
  if (without < 2.0 * left * n_ranks()) GTEST_SKIP() << "the machine has " << without << " MB";
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit little{.rlim_cur = static_cast<rlim_t>(1e6 * (test::address_space_mb() + left)),
                      .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  const AvailableMemory here = available_memory_here();
  const double everywhere = available_memory_mb();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  // Measuring takes a buffer or two.
  EXPECT_NEAR(here.megabytes, left * n_ranks_here(), 0.05 * left * n_ranks_here());
  EXPECT_NE(here.limited_by.find("ulimit"), std::string::npos) << here.limited_by;
  EXPECT_NEAR(everywhere, left * n_ranks(), 0.05 * left * n_ranks());
}

}  // namespace
}  // namespace microslip::fem::test_machine_memory
