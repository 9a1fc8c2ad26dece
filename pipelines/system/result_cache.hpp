/// @file
/// What earlier runs have solved, by what it followed from:
/// a folder of files that any number of runs share.
///
/// The name of a file is the fingerprint of all its inputs, its first line tells the program that
/// wrote it. Files are written whole; runs that want the same result at the same time wait for the
/// first. A file that is damaged, or of another program, is solved for again and replaced; one that
/// cannot be written is done without. Files that were not used for longest go where all together
/// would be larger than allowed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace microslip::pipelines {

/// The folder: MICROSLIP_CACHE, else microslip in XDG_CACHE_HOME, else in ~/.cache. Empty:
/// MICROSLIP_CACHE is "off", or there is no home.
[[nodiscard]] std::filesystem::path cache_folder();

class ResultCache {
 public:
  using Tell = std::function<void(const std::string& sentence)>;

  /// From now on, as long as it lives, in_use(); one at a time.
  /// @param folder      made where it is missing. Empty: there is none, in_use() stays nullptr.
  /// @param tell        hears what was taken from where, and why something was not.
  /// @param most_bytes  of all files together.
  ResultCache(std::filesystem::path folder, Tell tell, std::uintmax_t most_bytes = 2'000'000'000);
  ~ResultCache();
  ResultCache(const ResultCache&) = delete;
  ResultCache& operator=(const ResultCache&) = delete;
  ResultCache(ResultCache&&) = delete;
  ResultCache& operator=(ResultCache&&) = delete;

  [[nodiscard]] static ResultCache* in_use();

  /// For scripts that keep what they draw there as files of their own.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// One result: while it lives, another run that wants the same waits.
  class Entry {
   public:
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    Entry(Entry&&) = delete;
    Entry& operator=(Entry&&) = delete;

    /// What was kept; empty: nothing, or nothing that can be used.
    [[nodiscard]] std::optional<std::string> find() const;
    void keep(std::string_view bytes) const;

   private:
    friend ResultCache;
    Entry(ResultCache& cache, std::string kind, std::string_view inputs);
    void wait_for_turn(std::uint64_t number);

    ResultCache& cache_;
    std::string kind_;
    std::filesystem::path file_;
    int lock_ = -1;
  };

  /// What was kept, as an entry finds it, for who can do without:
  /// another run that is making it is not waited for.
  [[nodiscard]] std::optional<std::string> kept(std::string_view kind,
                                                std::string_view inputs) const;

  /// @param kind    what it is, for names and messages: "mesh", "modes".
  /// @param inputs  all that it follows from.
  /// @throws InterruptedError  while another run was waited for.
  [[nodiscard]] Entry entry(std::string kind, std::string_view inputs);

 private:
  [[nodiscard]] std::filesystem::path file_of(std::string_view kind, std::string_view inputs) const;
  [[nodiscard]] std::optional<std::string> found_in(const std::filesystem::path& file,
                                                    std::string_view kind) const;
  void make_room(std::uintmax_t bytes) const;

  std::filesystem::path folder_;
  Tell tell_;
  std::uintmax_t most_bytes_;
};

}  // namespace microslip::pipelines
