#include "pipelines/text/units.hpp"

#include <gtest/gtest.h>
#include <numbers>

#include <array>
#include <clocale>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace microslip::pipelines::test_units {
namespace {

constexpr double pi = std::numbers::pi;

/// Conversions multiply by one factor of UDUNITS, itself rounded: three roundings.
void expect_close(double value, double expected) {
  EXPECT_NEAR(value, expected, 3.0 * std::numeric_limits<double>::epsilon() * std::abs(expected));
}

std::string complaint(std::string_view text, const std::string& unit) {
  try {
    const double value = to_si(text, unit);
    return "taken as " + std::to_string(value);
  } catch (const UnitError& error) {
    return error.what();
  }
}

bool refuses(std::string_view text, const std::string& unit) {
  return !complaint(text, unit).starts_with("taken as");
}

TEST(Units, QuantitiesOfTheSceneFilesAreConverted) {
  expect_close(to_si("210 GPa", "Pa"), 2.1e11);
  expect_close(to_si("2.5 mm", "m"), 0.0025);
  expect_close(to_si("296 Hz", "Hz"), 296.0);
  expect_close(to_si("0.3 kHz", "Hz"), 300.0);
  expect_close(to_si("0.2 %", "1"), 0.002);
  expect_close(to_si("1e12 N/m^3", "N/m^3"), 1e12);
  expect_close(to_si("1e3 N/mm^3", "N/m^3"), 1e12);
  expect_close(to_si("1e-13 m^2/N", "m^2/N"), 1e-13);
  expect_close(to_si("7.8 g/cm^3", "kg/m^3"), 7800.0);
  expect_close(to_si("7.8e-9 t/mm^3", "kg/m^3"), 7800.0);
  expect_close(to_si("-3 kN", "N"), -3000.0);
  expect_close(to_si("5 N/mm^2", "Pa"), 5e6);
  expect_close(to_si("10 1/s", "Hz"), 10.0);
}

TEST(Units, AnglesAreReadInDegreesAndRadians) {
  expect_close(to_si("10 deg", "rad"), pi / 18.0);
  expect_close(to_si("10 degree", "rad"), pi / 18.0);
  expect_close(to_si("10°", "rad"), pi / 18.0);
  expect_close(to_si("0.5 rad", "rad"), 0.5);
  expect_close(to_si("0.5 rad", "deg"), 90.0 / pi);
  expect_close(to_si("90 deg", "deg"), 90.0);
}

TEST(Units, AMicrometreMayBeSpelledInThreeWays) {
  for (const char* text : {"10 um", "10 µm", "10 micrometer"}) expect_close(to_si(text, "m"), 1e-5);
}

TEST(Units, ANumberWithoutUnitIsTakenAsItIs) {
  EXPECT_EQ(to_si("0.1", "Pa"), 0.1);
  EXPECT_EQ(to_si("  +2.5e3\t", "N"), 2500.0);
  EXPECT_EQ(to_si("-.5", "m"), -0.5);
}

TEST(Units, BlanksBetweenNumberAndUnitDoNotMatter) {
  expect_close(to_si("2.5mm", "m"), 0.0025);
  expect_close(to_si("  2.5 \t mm ", "m"), 0.0025);
}

TEST(Units, AnotherDimensionIsRefusedWithBothNames) {
  const std::string message = complaint("210 GHz", "Pa");
  EXPECT_NE(message.find("GHz"), std::string::npos) << message;
  EXPECT_NE(message.find("Pa"), std::string::npos) << message;
  EXPECT_TRUE(refuses("5 N", "m"));
  EXPECT_TRUE(refuses("5 N/m^2", "N/m^3"));
  EXPECT_TRUE(refuses("5 m", "1"));
  EXPECT_TRUE(refuses("5 %", "m"));
}

TEST(Units, AnotherDimensionIsToldByWhatItMeasures) {
  EXPECT_NE(complaint("20 degC", "m").find("something else, in K"), std::string::npos);
  expect_close(to_si("20 degC", "K"), 293.15);  // an offset is no dimension
}

TEST(Units, TheReciprocalIsAnotherDimension) {  // UDUNITS would convert 0.01 s to 100 Hz
  EXPECT_TRUE(refuses("0.01 s", "Hz"));
  EXPECT_TRUE(refuses("5e-12 1/Pa", "Pa"));
  EXPECT_TRUE(refuses("1e13 Pa", "m^2/N"));
}

TEST(Units, ATurnPerSecondIsAHertz) {  // UDUNITS would take 60 rpm for 6.28 Hz
  expect_close(to_si("60 rpm", "Hz"), 1.0);
  expect_close(to_si("3000 revolutions/min", "Hz"), 50.0);
  expect_close(to_si("3 rad/s", "Hz"), 1.5 / pi);
  expect_close(to_si("720 deg/s", "Hz"), 2.0);
  EXPECT_TRUE(refuses("60 rpm", "1"));
  EXPECT_TRUE(refuses("60 rad", "Hz"));
}

TEST(Units, TurnsAreNotPureNumbers) {
  EXPECT_TRUE(refuses("60 Hz", "rad/s"));
  EXPECT_TRUE(refuses("10 deg", "1"));
  EXPECT_TRUE(refuses("10 %", "rad"));
  expect_close(to_si("60 rpm", "rad/s"), 2.0 * pi);
}

TEST(Units, AnUnknownUnitIsNamed) {
  const std::string message = complaint("5 parsec_per_fortnightly", "m");
  EXPECT_NE(message.find("parsec_per_fortnightly"), std::string::npos) << message;
  EXPECT_NE(message.find("unknown"), std::string::npos) << message;
}

TEST(Units, AMisspeltUnitIsToldWithTheOneThatIsMeant) {
  const auto expect_meant = [](const char* text, const char* unit, const std::string& meant) {
    const std::string said = complaint(text, unit);
    EXPECT_NE(said.find("did you mean \"" + meant + "\"?"), std::string::npos) << said;
  };
  expect_meant("210 MPA", "Pa", "MPa");
  expect_meant("210 GPA", "Pa", "GPa");
  expect_meant("1 khz", "Hz", "kHz");
  expect_meant("300 HZ", "Hz", "Hz");
  EXPECT_NE(complaint("1h30", "s").find("e.g. \"90 min\""), std::string::npos)
      << complaint("1h30", "s");
  EXPECT_EQ(complaint("2 furlongs_", "Pa").find("did you mean"), std::string::npos);
}

TEST(Units, NumbersInsideAUnitAreNotFactors) {  // each would be another value without a word
  for (const char* text : {"2.5.1 mm", "2 5 mm", "5-2 mm", "5+2 mm", "2,5 mm", "5 *2 mm", "5 m 2",
                           "5 m.2", "1..5 mm"}) {
    EXPECT_TRUE(refuses(text, "m")) << text << ": " << complaint(text, "m");
  }
}

TEST(Units, RootsOfUnitsAskForAPlainNumber) {  // UDUNITS reads kg^0.5 as five
  EXPECT_EQ(to_si("0.5", "N/kg^0.5"), 0.5);
  for (const char* text : {"0.5 N", "0.5 N/kg^0.5", "0.5 N.kg"}) {
    EXPECT_NE(complaint(text, "N/kg^0.5").find("plain number"), std::string::npos) << text;
  }
}

TEST(Units, WhatIsNoNumberIsRefused) {
  for (const char* text : {"", " ", "abc", "mm", "e5 m", "--5 m", "+-5 m", ".", "-", "0x"}) {
    EXPECT_TRUE(refuses(text, "m")) << "\"" << text << "\"";
  }
}

TEST(Units, NumbersNoDoubleHoldsAreNamedSo) {
  const std::string digits(400, '7');
  for (const std::string& text :
       {std::string("1e400"), std::string("-1e400 m"), digits, digits + ".5",
        "0.0" + digits + "e600", std::string("1e99999999999999999999")}) {
    EXPECT_NE(complaint(text, "m").find("range"), std::string::npos) << text;
  }
}

TEST(Units, NumbersTooSmallForADoubleAreZero) {
  const std::string zeros(400, '0');
  for (const std::string& text :
       {std::string("1e-400"), std::string("-1E-400 m"), "0." + zeros + "1", "12" + zeros + "e-900",
        std::string("1e-99999999999999999999")}) {
    EXPECT_EQ(to_si(text, "m"), 0.0) << text;
  }
  EXPECT_EQ(parse_number("1e-320"), 1e-320);
}

TEST(Units, SizesBeyondAllUnitsAreNotUsable) {
  for (const double value : {0.0, -0.0, 1e-100, -1e100, 3.0}) EXPECT_TRUE(is_of_usable_size(value));
  for (const double value :
       {1e-101, -5e-324, 1e101, std::nan(""), -std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(is_of_usable_size(value)) << value;
  }
}

TEST(Units, ZeroBytesDoNotHideWhatFollows) {
  EXPECT_TRUE(refuses(std::string_view("5 mm\0furlong", 12), "m"));
}

// Row 61. Hard: a locale with decimal commas changes how C reads and writes numbers.
// Met in: machines set up in German or French.
// Right: numbers have points.
TEST(Units, NumbersHaveAPointInAnyLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  const double value = to_si("2.5 mm", "m");
  const double number = parse_number("2.5");
  std::setlocale(LC_ALL, before.c_str());
  expect_close(value, 0.0025);
  EXPECT_EQ(number, 2.5);
}

TEST(Units, AFrequencyIsToldAsItWasGiven) {
  for (int i = 1; i < 20000; ++i) {
    const double given = 0.01 * i;
    EXPECT_EQ(in_hertz(to_si(std::to_string(given), "Hz") * 2.0 * std::numbers::pi),
              std::stod(std::to_string(given)));
  }
  EXPECT_EQ(in_hertz(0.0), 0.0);
}

TEST(ParseNumber, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(parse_number(" 1e-3 "), 1e-3);
  EXPECT_EQ(parse_number("+4"), 4.0);
  EXPECT_TRUE(std::isnan(parse_number("nan")));
  EXPECT_TRUE(std::isinf(parse_number("-inf")));
  for (const char* text : {"", "1 2", "1,5", "1e", "0x10", "1.2.3", "+-1", "five", "1 mm"}) {
    EXPECT_THROW(static_cast<void>(parse_number(text)), UnitError) << text;
  }
}

/// Any text ends in a number or a UnitError.
TEST(Units, AnyTextEndsInANumberOrAnError) {
  constexpr std::string_view alphabet = "0123456789.,+-eE mNPaGHzkg^/*%()°µ\"'\\\t[]@_";
  unsigned state = 20240611;  // fixed seed of a linear congruence
  const auto next = [&](unsigned n) {
    return ((state = state * 1664525U + 1013904223U) >> 16) % n;
  };
  int n_taken = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string text;
    for (unsigned length = next(12); length > 0; --length) {
      text += alphabet[next(static_cast<unsigned>(alphabet.size()))];
    }
    const std::array<const char*, 4> units{"m", "Pa", "1", "Hz"};
    n_taken += refuses(text, units[next(4)]) ? 0 : 1;
  }
  EXPECT_GT(n_taken, 0);
  EXPECT_LT(n_taken, 5000);
}

}  // namespace
}  // namespace microslip::pipelines::test_units
