#include "pipelines/text/nearest_name.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace microslip::pipelines {
namespace {

/// What the symbols of theory and of other programs are called here, in small letters.
struct Symbol {
  std::string_view symbol, key;
};
constexpr std::array symbols{
    Symbol{"mu", "friction_coefficient"},
    Symbol{"friction", "friction_coefficient"},
    Symbol{"kn", "normal_stiffness"},
    Symbol{"k_n", "normal_stiffness"},
    Symbol{"k_v", "normal_stiffness"},
    Symbol{"kt", "tangential_stiffness"},
    Symbol{"k_t", "tangential_stiffness"},
    Symbol{"k_u", "tangential_stiffness"},
    Symbol{"e", "youngs_modulus"},
    Symbol{"nu", "poissons_ratio"},
    Symbol{"rho", "density"},
    Symbol{"zeta", "damping_ratio"},
};

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string_view> known) {
  const std::string small = in_small_letters(name);
  const auto symbol = std::ranges::find(symbols, small, &Symbol::symbol);
  if (symbol != symbols.end() && std::ranges::find(known, symbol->key) != known.end()) {
    return std::string(symbol->key);
  }
  std::string_view best;
  std::size_t least = std::max<std::size_t>(3, name.size() / 2) + 1;
  for (const std::string_view candidate : known) {
    // A shortened name is near to the beginning of the whole one.
    const std::string whole = in_small_letters(candidate);
    const std::size_t distance =
        std::min(edit_distance(small, whole),
                 edit_distance(small, std::string_view(whole).substr(0, name.size() + 1)) + 1);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return std::string(best);
}

}  // namespace microslip::pipelines
