#include "pipelines/system/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <clocale>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "pipelines/system/scene_error.hpp"
#include "tests/pipelines/synthetic_run.hpp"

namespace microslip::pipelines::test_output_file {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t n_files(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::string message_of(const std::filesystem::path& file) {
  try {
    write_whole(file, "x");
  } catch (const ExhaustedError& error) {
    return error.what();
  }
  return "";
}

/// No file of this process may grow past `bytes` while this lives: a disk that fills up.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  FileSizeLimit(FileSizeLimit&&) = delete;
  FileSizeLimit& operator=(FileSizeLimit&&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    static_cast<void>(std::signal(SIGXFSZ, handler_));
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(OutputFile, WritesAndReplacesWithoutLeavingTemporaryFiles) {
  const synthetic::Folder folder("output_file");
  write_whole(folder.path() / "a.txt", "first, longer than the second");
  write_whole(folder.path() / "a.txt", "second");
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "second");
  EXPECT_EQ(n_files(folder.path()), 1U);
}

TEST(OutputFile, MissingFolderIsNamed) {
  const synthetic::Folder folder("output_missing");
  const std::string message = message_of(folder.path() / "no" / "a.txt");
  EXPECT_NE(message.find((folder.path() / "no" / "a.txt").string()), std::string::npos);
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST(OutputFile, UnwritableFolderIsNamedAndStaysEmpty) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const synthetic::Folder folder("output_unwritable");
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THROW(require_writable(folder.path()), ExhaustedError);
  EXPECT_NE(message_of(folder.path() / "a.txt").find("Permission denied"), std::string::npos);
  EXPECT_EQ(n_files(folder.path()), 0U);
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

// Row 59. Hard: a disk that fills while a file is written over.
// Met in: runs into shared folders.
// Right: the old file stays whole, nothing stands beside it.
TEST(OutputFile, FullDiskKeepsTheOldFileAndLeavesNothingElse) {
  const synthetic::Folder folder("output_full");
  const std::filesystem::path file = folder.path() / "a.txt";
  write_whole(file, "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_THROW(write_whole(file, std::string(5000, 'x')), ExhaustedError);
  }
  EXPECT_EQ(content_of(file), "old");
  EXPECT_EQ(n_files(folder.path()), 1U);
}

TEST(OutputFile, FolderInPlaceOfTheFileIsRefusedAndLeavesNothing) {
  const synthetic::Folder folder("output_folder");
  std::filesystem::create_directory(folder.path() / "a.txt");
  EXPECT_THROW(write_whole(folder.path() / "a.txt", "x"), ExhaustedError);
  EXPECT_EQ(n_files(folder.path()), 1U);
}

TEST(OutputFile, FileInPlaceOfAFolderIsRefused) {
  const synthetic::Folder folder("output_file_as_folder");
  write_whole(folder.path() / "runs", "x");
  EXPECT_THROW(make_folder(folder.path() / "runs"), ExhaustedError);
  EXPECT_THROW(make_folder(folder.path() / "runs" / "deeper"), ExhaustedError);
}

std::string refusal_of(const std::function<void()>& question) {
  try {
    question();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(OutputFile, NamesThatCannotBeFoldersOrFilesAreBadInput) {
  const synthetic::Folder folder("output_names");
  const std::filesystem::path file = folder.path() / "a.txt";
  write_whole(file, "x");
  for (const auto& path : {file, file / "below", file / "below" / "deeper"}) {
    const std::string said = refusal_of([&] { require_folder_name(path, "-o"); });
    EXPECT_NE(said.find("-o " + path.string()), std::string::npos) << said;
    EXPECT_NE(said.find(file.string() + " is a file"), std::string::npos) << said;
  }
  EXPECT_NE(refusal_of([&] { require_file_name(folder.path(), "-o"); }).find("is a folder"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { require_file_name(file / "b.txt", "-o"); }).find("is a file"),
            std::string::npos);
  for (const auto& path :
       {folder.path(), folder.path() / "new" / "one", std::filesystem::path("new")}) {
    EXPECT_EQ(refusal_of([&] { require_folder_name(path, "-o"); }), "");
  }
  EXPECT_EQ(refusal_of([&] { require_file_name(file, "-o"); }), "");
  EXPECT_EQ(refusal_of([&] { require_file_name("b.txt", "-o"); }), "");
}

TEST(OutputFile, LinksAreFollowedAndDevicesStay) {
  const synthetic::Folder folder("output_links");
  write_whole(folder.path() / "a.txt", "old");
  std::filesystem::create_symlink(folder.path() / "a.txt", folder.path() / "link");
  write_whole(folder.path() / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(content_of(folder.path() / "a.txt"), "new");
  std::filesystem::create_symlink("/dev/null", folder.path() / "null");
  write_whole(folder.path() / "null", "x");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "null"));
  if (!std::filesystem::exists("/dev/full")) return;
  std::filesystem::create_symlink("/dev/full", folder.path() / "full");
  EXPECT_NE(message_of(folder.path() / "full").find("No space left"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "full"));
}

TEST(OutputFile, WritableFolderStaysEmptyAfterAsking) {
  const synthetic::Folder folder("output_probe");
  require_writable(folder.path());
  EXPECT_EQ(n_files(folder.path()), 0U);
}

TEST(OutputFile, NumbersReadBackToTheSameDouble) {
  for (const double value : {1.0 / 3.0, 296.12345678901234, -2.2250738585072014e-308, 5e-324, 1e22,
                             0.1, -0.0, std::numeric_limits<double>::max()}) {
    const std::string text = format_number(value);
    double read = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    EXPECT_EQ(std::signbit(read), std::signbit(value));
    EXPECT_EQ(read, value);
  }
}

TEST(OutputFile, NumbersHaveAPointInEveryLocale) {
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(format_number(1.5), "1.5") << (german != nullptr ? german : "locale not installed");
  static_cast<void>(std::setlocale(LC_ALL, "C"));
}

}  // namespace
}  // namespace microslip::pipelines::test_output_file
