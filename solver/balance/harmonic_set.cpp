#include "solver/balance/harmonic_set.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace microslip::solver {

HarmonicSet::HarmonicSet(int highest) {
  if (highest < 1) {
    throw std::invalid_argument("harmonics: at least one, not " + std::to_string(highest));
  }
  orders_.resize(static_cast<std::size_t>(highest));
  std::iota(orders_.begin(), orders_.end(), 1);
}

HarmonicSet::HarmonicSet(std::vector<int> orders, Mean mean)
    : orders_(std::move(orders)), mean_(mean) {
  std::sort(orders_.begin(), orders_.end());
  orders_.erase(std::unique(orders_.begin(), orders_.end()), orders_.end());
  if (orders_.empty() || orders_.front() < 1) {
    throw std::invalid_argument("harmonics: a set needs orders of 1 and above; " +
                                (orders_.empty() ? std::string("it is empty")
                                                 : "it has " + std::to_string(orders_.front())));
  }
}

bool HarmonicSet::contains(int order) const {
  return std::binary_search(orders_.begin(), orders_.end(), order);
}

HarmonicSet HarmonicSet::united(const std::vector<int>& orders) const {
  std::vector<int> all = orders_;
  all.insert(all.end(), orders.begin(), orders.end());
  return HarmonicSet(std::move(all), mean_);
}

}  // namespace microslip::solver
