/// @file
/// Values as bytes, exact, for the build that wrote them to read back: numbers, texts, lists, dense
/// matrices, and structs whose members are told by a function members() found beside the call.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace microslip::pipelines {

/// For members(), which serves values that are written and values that are read alike.
template <typename T, typename U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

/// A value that only a function of its own makes, which tells no members: its bytes are the value.
template <typename T>
concept OnlyAsBytes = std::is_trivially_copyable_v<T> && !std::is_default_constructible_v<T>;

/// FNV-1a, 64 bits.
[[nodiscard]] inline std::uint64_t fingerprint(std::string_view bytes,
                                               std::uint64_t seed = 0xcbf29ce484222325U) {
  for (const char byte : bytes) seed = (seed ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return seed;
}

class ByteWriter {
 public:
  template <typename T>
  void operator()(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || OnlyAsBytes<T>) {
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      std::apply([this](const auto&... member) { ((*this)(member), ...); }, members(value));
    }
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes_ += text;
  }
  template <typename T>
  void operator()(const std::vector<T>& list) {
    (*this)(list.size());
    for (const T& entry : list) (*this)(entry);
  }
  template <typename T, std::size_t n>
  void operator()(const std::array<T, n>& list) {
    for (const T& entry : list) (*this)(entry);
  }
  template <typename T>
  void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }
  template <typename A, typename B>
  void operator()(const std::variant<A, B>& value) {
    (*this)(value.index() == 0);
    std::visit(*this, value);
  }
  template <typename S, int r, int c, int o>
  void operator()(const Eigen::Matrix<S, r, c, o>& matrix) {
    (*this)(matrix.rows());
    (*this)(matrix.cols());
    bytes_.append(reinterpret_cast<const char*>(matrix.data()),
                  static_cast<std::size_t>(matrix.size()) * sizeof(S));
  }
  template <typename S, int o>
  void operator()(const Eigen::SparseMatrix<S, o>& matrix) {
    std::vector<Eigen::Triplet<S, Eigen::Index>> entries;
    for (Eigen::Index k = 0; k < matrix.outerSize(); ++k) {
      for (typename Eigen::SparseMatrix<S, o>::InnerIterator entry(matrix, k); entry; ++entry) {
        entries.emplace_back(entry.row(), entry.col(), entry.value());
      }
    }
    (*this)(matrix.rows());
    (*this)(matrix.cols());
    (*this)(entries.size());
    bytes_.append(reinterpret_cast<const char*>(entries.data()),
                  entries.size() * sizeof entries[0]);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  void operator()(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      copy(&value, sizeof value);
    } else {
      std::apply([this](auto&... member) { ((*this)(member), ...); }, members(value));
    }
  }
  void operator()(std::string& text) {
    text.resize(size());
    copy(text.data(), text.size());
  }
  template <typename T>
  void operator()(std::vector<T>& list) {
    list.resize(size());
    for (T& entry : list) (*this)(entry);
  }
  template <typename T, std::size_t n>
  void operator()(std::array<T, n>& list) {
    for (T& entry : list) (*this)(entry);
  }
  template <typename T>
  void operator()(std::optional<T>& value) {
    bool has_value = false;
    (*this)(has_value);
    if (has_value) (*this)(value.emplace());
  }
  template <OnlyAsBytes T>
  void operator()(std::optional<T>& value) {
    bool has_value = false;
    (*this)(has_value);
    if (!has_value) return;
    std::array<std::byte, sizeof(T)> bytes;
    copy(bytes.data(), bytes.size());
    value.emplace(std::bit_cast<T>(bytes));
  }
  template <typename A, typename B>
  void operator()(std::variant<A, B>& value) {
    bool is_first = true;
    (*this)(is_first);
    if (!is_first) value.template emplace<1>();
    std::visit(*this, value);
  }
  template <typename S, int r, int c, int o>
  void operator()(Eigen::Matrix<S, r, c, o>& matrix) {
    Eigen::Index rows = 0;
    Eigen::Index cols = 0;
    (*this)(rows);
    (*this)(cols);
    matrix.resize(rows, cols);
    copy(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(S));
  }
  template <typename S, int o>
  void operator()(Eigen::SparseMatrix<S, o>& matrix) {
    Eigen::Index rows = 0;
    Eigen::Index cols = 0;
    (*this)(rows);
    (*this)(cols);
    std::vector<Eigen::Triplet<S, Eigen::Index>> entries(size());
    copy(entries.data(), entries.size() * sizeof entries[0]);
    matrix.resize(rows, cols);
    matrix.setFromTriplets(entries.begin(), entries.end());
  }

 private:
  std::size_t size() {
    std::size_t n = 0;
    (*this)(n);
    return n;
  }
  void copy(void* to, std::size_t n) {
    if (n > bytes_.size()) throw std::out_of_range("the bytes end within a value");
    if (n > 0) std::memcpy(to, bytes_.data(), n);
    bytes_.remove_prefix(n);
  }

  std::string_view bytes_;
};

}  // namespace microslip::pipelines
