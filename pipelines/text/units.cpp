#include "pipelines/text/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "pipelines/text/nearest_name.hpp"

namespace microslip::pipelines {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

/// The unit system of the library, read once; lives as long as the program.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);  // it would print on its own
    ut_system* const read = ut_read_xml(nullptr);
    if (read != nullptr) {
      const Unit degree(ut_parse(read, "arc_degree", UT_UTF8));
      ut_map_name_to_unit("deg", UT_UTF8, degree.get());  // the one common name it does not know
    }
    return read;
  }();
  if (system == nullptr) throw UnitError("the unit database of UDUNITS cannot be read");
  return system;
}

Unit parse_unit(const std::string& text) {
  return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8));
}

/// Base units and their powers, e.g. "m-1.kg.s-2", "s-1.rad", "1". Compared instead of
/// ut_are_convertible(), which takes seconds for hertz (by the reciprocal) and radians for pure
/// numbers.
std::string dimension_of(const Unit& unit) {
  std::array<char, 256> text{};
  const int length = ut_format(unit.get(), text.data(), text.size(), UT_ASCII | UT_DEFINITION);
  if (length < 0 || static_cast<std::size_t>(length) >= text.size()) return "?";
  const std::string_view definition(text.data(), static_cast<std::size_t>(length));
  double factor = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + length, factor);
  const auto after = static_cast<std::size_t>(end - text.data());
  const bool scaled = error == std::errc() && after < definition.size() && *end == ' ';
  const std::string_view dimension = scaled ? definition.substr(after + 1) : definition;
  return std::string(dimension.substr(0, dimension.find(" @ ")));  // degC is "K @ 273.15"
}

/// What to convert a unit to where `unit` is expected: turns and angles per time are frequencies, a
/// turn per second is one hertz.
std::string counterpart(const Unit& found, const std::string& unit) {
  const bool turns = unit == "Hz" && dimension_of(found) == dimension_of(parse_unit("rad/s"));
  return turns ? "revolution/s" : unit;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// UDUNITS reads numbers inside a unit as factors: "2.5.1 mm" would be a quarter of a millimetre,
/// "5-2 mm" minus ten, "kg^0.5" five. Whole powers and "1/s" are all a unit may hold.
bool has_stray_number(std::string_view unit) {
  constexpr std::string_view not_first = "0123456789.,+-*^";
  if (not_first.find(unit.front()) != std::string_view::npos && !unit.starts_with("1/"))
    return true;
  for (std::size_t i = 0; i + 1 < unit.size(); ++i) {
    if ((unit[i] == '.' || unit[i] == ',') && is_digit(unit[i + 1])) return true;
    if (unit[i] == ' ' && is_digit(unit[i + 1])) return true;
  }
  return unit.find('\0') != std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Whether a decimal number stands for less than 1: of those no double holds,
/// the ones that are nearest to 0.
bool is_below_one(std::string_view number) {
  long order = 0;  // of the first digit that is not 0: above 0 before the decimal point
  bool in_fraction = false;
  bool significant = false;
  std::size_t i = 0;
  for (; i < number.size() && number[i] != 'e' && number[i] != 'E'; ++i) {
    if (number[i] == '.') in_fraction = true;
    if (!is_digit(number[i])) continue;
    significant = significant || number[i] != '0';
    if (significant && !in_fraction) ++order;
    if (!significant && in_fraction) --order;
  }
  if (i == number.size()) return order <= 0;
  const std::string_view exponent =
      number.substr(i + (number.substr(i, 2) == "e+" || number.substr(i, 2) == "E+" ? 2 : 1));
  long power = 0;
  const auto [end, error] =
      std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
  if (error != std::errc()) return exponent.starts_with('-');  // more than any text has digits
  return order + power <= 0;
}

/// Length of the number at the front of the text; 0: there is none.
/// What is too small for a double is 0.
/// @throws UnitError  a number too large for a double.
std::size_t number_length(std::string_view text, double& value) {
  const bool plus = text.size() > 1 && text[0] == '+' && (is_digit(text[1]) || text[1] == '.');
  const char* const begin = text.data() + (plus ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    if (is_below_one({begin, static_cast<std::size_t>(end - begin)})) {
      value = 0.0;
      return static_cast<std::size_t>(end - text.data());
    }
    throw UnitError(fmt::format("\"{}\" is beyond the range of double precision", text));
  }
  return error == std::errc() ? static_cast<std::size_t>(end - text.data()) : 0;
}

/// How messages call what a unit measures.
std::string expected_text(const std::string& unit) {
  return unit == "1" ? "a pure number, or %" : fmt::format("a unit that converts to {}", unit);
}

/// What a unit was meant to be, as a question; "": nothing is known.
std::string similar_unit(const std::string& given, const std::string& unit) {
  static constexpr std::array<std::string_view, 33> usual{
      "Pa", "kPa",    "MPa",    "GPa",    "N",     "kN",     "MN",  "m",    "mm",  "um",  "cm",
      "in", "Hz",     "kHz",    "rad/s",  "rpm",   "s",      "ms",  "min",  "h",   "kg",  "g",
      "t",  "kg/m^3", "g/cm^3", "t/mm^3", "N/m^3", "N/mm^3", "N/m", "N/mm", "deg", "rad", "N*m"};
  if (unit == "s" && std::ranges::any_of(given, is_digit)) {
    return "; a time is one number and one unit, e.g. \"90 min\"";
  }
  std::vector<std::string_view> known;
  for (const std::string_view one : usual) {
    const Unit candidate = parse_unit(std::string(one));
    const bool fits = candidate && dimension_of(candidate) ==
                                       dimension_of(parse_unit(counterpart(candidate, unit)));
    const auto small = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    if (fits && small(one.front()) == small(given.front())) known.push_back(one);
  }
  const std::string near = nearest_name(given, known);
  return near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
}

/// Factor and offset from one unit to another of the same dimension.
Converter converter_between(const std::string& given, const std::string& unit) {
  Unit expected = parse_unit(unit);
  if (!expected || (unit != "1" && has_stray_number(unit))) {  // roots of units are beyond UDUNITS
    throw UnitError(
        fmt::format("unit \"{}\" is not understood here; give a plain number [{}]", given, unit));
  }
  const Unit found = has_stray_number(given) ? Unit() : parse_unit(given);
  if (!found) {
    throw UnitError(fmt::format("unknown unit \"{}\"; expected {}{}", given, expected_text(unit),
                                similar_unit(given, unit)));
  }
  expected = parse_unit(counterpart(found, unit));
  if (dimension_of(found) != dimension_of(expected)) {
    throw UnitError(fmt::format("unit \"{}\" measures something else, in {}; expected {}{}", given,
                                dimension_of(found), expected_text(unit),
                                similar_unit(given, unit)));
  }
  Converter converter(ut_get_converter(found.get(), expected.get()));
  if (!converter)
    throw UnitError(fmt::format("unit \"{}\" cannot be converted to {}", given, unit));
  return converter;
}

}  // namespace

double in_hertz(double angular) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  const double quotient = angular / two_pi;
  const auto n_digits = [](double value) {
    std::array<char, 32> text{};
    return std::to_chars(text.data(), text.data() + text.size(), value).ptr - text.data();
  };
  double best = quotient;
  for (const double towards : {-HUGE_VAL, HUGE_VAL}) {
    const double next = std::nextafter(quotient, towards);
    if (next * two_pi == angular && n_digits(next) < n_digits(best)) best = next;
  }
  return best;
}

bool is_of_usable_size(double value) {
  const double size = std::abs(value);
  return size == 0.0 || (size >= 1e-100 && size <= 1e100);
}

double parse_number(std::string_view text) {
  const std::string_view number = trimmed(text);
  double value = 0.0;
  if (number.empty() || number_length(number, value) != number.size()) {
    throw UnitError(fmt::format("\"{}\" is not a number", text));
  }
  return value;
}

double to_si(std::string_view text, const std::string& unit) {
  static std::mutex mutex;  // UDUNITS keeps its status in one place
  const std::lock_guard lock(mutex);
  const std::string_view whole = trimmed(text);
  double value = 0.0;
  const std::size_t length = number_length(whole, value);
  if (length == 0) throw UnitError(fmt::format("\"{}\" does not begin with a number", text));
  const std::string given(trimmed(whole.substr(length)));
  if (given.empty()) return value;
  const Converter converter = converter_between(given, unit);
  return cv_convert_double(converter.get(), value);
}

}  // namespace microslip::pipelines
