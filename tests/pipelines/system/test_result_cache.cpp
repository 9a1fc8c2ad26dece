// Results shared between runs: found again only for the same inputs and by the same program, never
// in the way.
#include "pipelines/system/result_cache.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <thread>
#include <vector>

#include "pipelines/system/output_file.hpp"
#include "pipelines/system/sealed_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::pipelines::test_result_cache {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class Cache : public testing::Test {
 protected:
  [[nodiscard]] ResultCache cache(std::uintmax_t most_bytes = 1'000'000) {
    return {folder_.path() / "cache",
            [this](const std::string& line) {
              const std::lock_guard lock(mutex_);
              told_ += line + '\n';
            },
            most_bytes};
  }
  [[nodiscard]] std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "cache")) {
      if (entry.path().extension() == ".cached") found.push_back(entry.path());
    }
    return found;
  }
  [[nodiscard]] bool told(const std::string& part) {
    const std::lock_guard lock(mutex_);
    return told_.find(part) != std::string::npos;
  }

  test::TemporaryFolder folder_;
  std::mutex mutex_;
  std::string told_;
};

TEST_F(Cache, IsUsedWhileItLivesAndNotWithoutAFolder) {
  EXPECT_EQ(ResultCache::in_use(), nullptr);
  {
    const ResultCache here = cache();
    EXPECT_EQ(ResultCache::in_use(), &here);
  }
  const ResultCache none({}, [](const auto&) { FAIL(); });
  EXPECT_EQ(ResultCache::in_use(), nullptr);
}

TEST_F(Cache, FindsWhatWasKeptForTheSameInputsAlone) {
  const std::string bytes("a\0b\n", 4);
  cache().entry("modes", "steel").keep(bytes);
  ResultCache later = cache();
  EXPECT_EQ(later.entry("modes", "steel").find(), bytes);
  EXPECT_TRUE(told("modes: taken from an earlier run"));
  EXPECT_FALSE(later.entry("modes", "brass").find());
  EXPECT_FALSE(later.entry("mesh", "steel").find());
}

TEST_F(Cache, WhatIsDamagedOrOfAnotherProgramIsToldAndReplaced) {
  ResultCache here = cache();
  here.entry("modes", "steel").keep("shapes");
  const fs::path file = files().at(0);
  const std::string whole = bytes_of(file);
  for (const std::size_t size : {whole.find('\n') + 2, whole.size() - 1}) {
    write_whole(file, whole.substr(0, size));
    EXPECT_FALSE(here.entry("modes", "steel").find()) << size;
    EXPECT_TRUE(told("damaged; it is made again")) << told_;
    told_.clear();
  }
  write_whole(file, "microslip 0.0.1 beef" + whole.substr(whole.find('\n')));
  EXPECT_FALSE(here.entry("modes", "steel").find());
  EXPECT_TRUE(told("found \"microslip 0.0.1 beef\": another version or build")) << told_;
  here.entry("modes", "steel").keep("shapes");
  EXPECT_EQ(here.entry("modes", "steel").find(), "shapes");
}

TEST_F(Cache, WhatWasNotUsedForLongestGoesFirst) {
  const std::string result(400, 'x');
  ResultCache here = cache(1000);
  here.entry("modes", "a").keep(result);
  here.entry("modes", "b").keep(result);
  for (const fs::path& file : files())
    fs::last_write_time(file, fs::file_time_type::clock::now() - 2h);
  EXPECT_TRUE(here.entry("modes", "a").find());  // used now
  here.entry("modes", "c").keep(result);
  EXPECT_TRUE(here.entry("modes", "a").find());
  EXPECT_FALSE(here.entry("modes", "b").find());
  EXPECT_TRUE(here.entry("modes", "c").find());
  here.entry("modes", "huge").keep(std::string(2000, 'x'));
  EXPECT_EQ(files().size(), 2U) << "what fits in no cache drives nothing out";
}

TEST_F(Cache, LeftoversOfKilledRunsGo) {
  ResultCache here = cache();
  const fs::path old = folder_.path() / "cache" / ".modes.1.0.part";
  const fs::path now = folder_.path() / "cache" / ".modes.2.0.part";
  for (const fs::path& part : {old, now}) std::ofstream(part) << "half";
  fs::last_write_time(old, fs::file_time_type::clock::now() - 2h);
  here.entry("modes", "a").keep("x");
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(now)) << "another run is writing it";
}

TEST_F(Cache, AFolderThatCannotBeMadeIsDoneWithout) {
  std::ofstream(folder_.path() / "cache") << "a file";
  const ResultCache here = cache();
  EXPECT_EQ(ResultCache::in_use(), nullptr);
  EXPECT_TRUE(told("nothing is taken from earlier runs"));
}

TEST_F(Cache, WhoeverWantsTheSameWaitsForTheFirst) {
  ResultCache here = cache();
  std::optional<std::string> found;
  std::jthread second;
  {
    const ResultCache::Entry first = here.entry("modes", "steel");
    second = std::jthread([&] { found = here.entry("modes", "steel").find(); });
    while (!told("waiting for it")) std::this_thread::sleep_for(1ms);
    EXPECT_FALSE(here.entry("modes", "brass").find()) << "for another result nobody waits";
    first.keep("shapes");
  }
  second.join();
  EXPECT_EQ(found, "shapes");
}

TEST(CacheFolder, IsWhereUsersExpectIt) {
  ::setenv("HOME", "/home/somebody", 1);
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("MICROSLIP_CACHE");
  EXPECT_EQ(cache_folder(), "/home/somebody/.cache/microslip");
  ::setenv("XDG_CACHE_HOME", "relative", 1);  // to be ignored, says the specification
  EXPECT_EQ(cache_folder(), "/home/somebody/.cache/microslip");
  ::setenv("XDG_CACHE_HOME", "/scratch", 1);
  EXPECT_EQ(cache_folder(), "/scratch/microslip");
  ::setenv("MICROSLIP_CACHE", "/elsewhere", 1);
  EXPECT_EQ(cache_folder(), "/elsewhere");
  ::setenv("MICROSLIP_CACHE", "off", 1);
  EXPECT_EQ(cache_folder(), "");
}

}  // namespace
}  // namespace microslip::pipelines::test_result_cache
