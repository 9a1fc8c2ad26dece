/// @file
/// Damaged inputs for a reader where libFuzzer is not: files of a corpus with some bytes changed,
/// the same in every run as far as the time goes. For programs that sanitizers watch.
///
/// usage: fuzz_READER SECONDS SEED FILE …
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/mutated_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::string text_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.empty()) throw std::runtime_error(std::string(path) + ": nothing to damage");
  return text;
}

void run(double seconds, unsigned seed, const std::vector<std::string>& corpus) {
  using Clock = std::chrono::steady_clock;
  constexpr unsigned most_changes = 8;
  constexpr std::size_t piece = 40;  // bytes
  const std::string bytes{"0123456789 .,;:-+eE\n\t\"'[]{}()=#$\\/*xNnaif\0\x7f\x80\xc3\xff", 47};
  microslip::test::MutatedText mutated(seed, bytes);
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(seconds));
  std::size_t n = 0;
  for (; Clock::now() < end; ++n) {
    const std::string padded = corpus[n % corpus.size()] + std::string(most_changes, ' ');
    // However many pieces are taken out, something is left to change.
    const std::size_t taken = std::clamp<std::size_t>(padded.size() / most_changes, 1, piece);
    const std::string text = mutated.of(padded, most_changes, taken, piece);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  std::printf("%zu inputs, seed %u\n", n, seed);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 1;
  try {
    std::vector<std::string> corpus;
    for (int i = 3; i < argc; ++i) corpus.push_back(text_of(argv[i]));
    run(std::atof(argv[1]), static_cast<unsigned>(std::atoi(argv[2])), corpus);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz: an error that is none of the reader's: %s\n", error.what());
    return 1;
  }
  return 0;
}
