#include "pipelines/units.hpp"

#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>

#include <fmt/format.h>

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
    return ut_read_xml(nullptr);
  }();
  if (system == nullptr) throw UnitError("the unit database of UDUNITS cannot be read");
  return system;
}

Unit parse_unit(const std::string& text) {
  return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Length of the number at the front of the text; 0: there is none.
std::size_t number_length(std::string_view text, double& value) {
  const std::size_t sign = !text.empty() && text.front() == '+' ? 1 : 0;
  const auto [end, error] =
      std::from_chars(text.data() + sign, text.data() + text.size(), value);
  return error == std::errc() ? static_cast<std::size_t>(end - text.data()) : 0;
}

}  // namespace

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
  const Unit expected = parse_unit(unit);
  const Unit found = parse_unit(given);
  if (!found) throw UnitError(fmt::format("unknown unit \"{}\"; expected a unit of {}", given, unit));
  // Radians count as pure numbers there: "rad/s" would pass for hertz and be wrong by 2π.
  const bool angular = given.find("rad") != std::string::npos;
  if (!ut_are_convertible(found.get(), expected.get()) || (angular && unit == "Hz")) {
    throw UnitError(fmt::format("unit \"{}\" does not measure what is asked; expected a unit of {}",
                                given, unit == "1" ? "a pure number (or %)" : unit));
  }
  const Converter converter(ut_get_converter(found.get(), expected.get()));
  if (!converter) throw UnitError(fmt::format("unit \"{}\" cannot be converted to {}", given, unit));
  return cv_convert_double(converter.get(), value);
}

}  // namespace microslip::pipelines
