// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/units.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <numbers>

using dust::test::approx;
using namespace dust::scenario;
namespace dim = dust::sdk::dimension;
using dust::sdk::Dimension;

namespace {

/// One rounding in the table's quotient and one in the product.
constexpr double k_two_roundings = 4.5e-16;

double value(const std::string& text, Dimension d) {
  std::string error;
  const auto written = split_number(text, error);
  REQUIRE_MESSAGE(written, error);
  const auto si = to_si(*written, d, error);
  REQUIRE_MESSAGE(si, error);
  return *si;
}

std::string refusal(const std::string& text, Dimension d) {
  std::string error;
  const auto written = split_number(text, error);
  if (written && to_si(*written, d, error)) return {};
  return error;
}

}  // namespace

TEST_CASE("the units of the contract shall give SI values") {
  CHECK(value("1.25 mm", dim::length) == 1.25e-3);
  CHECK(value("350 mm", dim::length) == 0.35);
  CHECK(value("80 l/min", dim::volume_flow) == approx(80e-3 / 60).epsilon(k_two_roundings));
  CHECK(value("16 deg", dim::angle) ==
        approx(16 * std::numbers::pi / 180).epsilon(k_two_roundings));
  CHECK(value("6 g/s", dim::mass_flow) == 0.006);
  CHECK(value("0.5 m/s", dim::velocity) == 0.5);
  CHECK(value("50 MPa", dim::pressure) == 5e7);
  CHECK(value("25 g", dim::mass) == 0.025);
  CHECK(value("8.2 mbar", dim::pressure) == approx(820.0).epsilon(k_two_roundings));
  CHECK(value("1.2 kg/m3", dim::density) == 1.2);
}

TEST_CASE("the units of the trade shall give SI values") {
  CHECK(value("500 t/h", dim::mass_flow) == approx(500e3 / 3600).epsilon(k_two_roundings));
  CHECK(value("2000 m3/h", dim::volume_flow) == approx(2000.0 / 3600).epsilon(k_two_roundings));
  CHECK(value("48 in", dim::length) == approx(1.2192).epsilon(k_two_roundings));
  CHECK(value("10 ft", dim::length) == approx(3.048).epsilon(k_two_roundings));
  CHECK(value("600 ft/min", dim::velocity) == approx(3.048).epsilon(k_two_roundings));
  CHECK(value("2 lb", dim::mass) == approx(0.90718474).epsilon(k_two_roundings));
  CHECK(value("100 lb/ft3", dim::density) == approx(1601.846337396014).epsilon(1e-14));
  CHECK(value("1000 cfm", dim::volume_flow) ==
        approx(1000 * 0.3048 * 0.3048 * 0.3048 / 60).epsilon(1e-14));
  CHECK(value("600 fpm", dim::velocity) == approx(3.048).epsilon(k_two_roundings));
  CHECK(value("500 tph", dim::mass_flow) == approx(500e3 / 3600).epsilon(k_two_roundings));
  CHECK(value("20 degC", dim::temperature) == approx(293.15).epsilon(k_two_roundings));
  CHECK(value("-40 \u00b0C", dim::temperature) == approx(233.15).epsilon(k_two_roundings));
  // Its zero lies elsewhere: it is not a factor.
  CHECK(refusal("3 J/degC", dim::temperature).find("a temperature is expected (K, degC)") !=
        std::string::npos);
}

TEST_CASE("compound units, exponents and brackets shall be understood") {
  CHECK(value("2 Pa s", dim::dynamic_viscosity) == 2);
  CHECK(value("2 Pa*s", dim::dynamic_viscosity) == 2);
  CHECK(value("18 uPa s", dim::dynamic_viscosity) == approx(18e-6).epsilon(k_two_roundings));
  CHECK(value("2 kg/(m s)", dim::dynamic_viscosity) == 2);
  CHECK(value("2 kg/m/s", dim::dynamic_viscosity) == 2);
  CHECK(value("2 kg m-1 s-1", dim::dynamic_viscosity) == 2);
  CHECK(value("9.81 m/s^2", dim::acceleration) == 9.81);
  CHECK(value("9.81 m/s\u00b2", dim::acceleration) == 9.81);
  CHECK(value("3 mm3", dim::volume) == approx(3e-9).epsilon(k_two_roundings));
  CHECK(value("2.5 g/cm3", dim::density) == approx(2500.0).epsilon(k_two_roundings));
  CHECK(value("5 \u00b5m", dim::length) == 5e-6);
  CHECK(value("3 1/s", dim::frequency) == 3);
  CHECK(value("2 min", dim::time) == 120);
  CHECK(value("60 rpm", dim::angular_velocity) ==
        approx(2 * std::numbers::pi).epsilon(k_two_roundings));
  CHECK(value("55 %", dim::none) == 0.55);
  CHECK(value("3.6 g/t", dim::none) == approx(3.6e-6).epsilon(1e-15));
  CHECK(value("1e-3", dim::length) == 1e-3);
  CHECK(value("-.5e1", dim::none) == -5);
}

TEST_CASE("a unit of another dimension shall be refused with the expected one") {
  CHECK(refusal("16 mm", dim::angle) ==
        "'mm' is the unit of a length: an angle is expected (rad, deg)");
  CHECK(refusal("1 kg", dim::mass_flow).find("a mass flow is expected (kg/s, g/s, t/h, tph)") !=
        std::string::npos);
  CHECK(refusal("1 mm", dim::none).find("a bare number is expected") != std::string::npos);
  CHECK(refusal("5 %", dim::length).find("a length is expected") != std::string::npos);
  CHECK(refusal("1 furlong", dim::length).find("unknown unit 'furlong'") != std::string::npos);
  for (const char* unit :
       {"m^", "m/", "/m", "m//s", "(m", "m)", "m-", "()", "m(", "((((((((((m))))))))))"}) {
    CHECK_MESSAGE(!parse_unit(unit), unit);
  }
}

TEST_CASE("units to choose from shall hold those of the table that no prefix makes, each once") {
  CHECK(example_units(dim::length) == "m, mm, um, in, ft");
  CHECK(example_units(dim::mass) == "kg, g, mg, t, lb");
  CHECK(example_units(dim::time) == "s, ms, min, h");
  CHECK(example_units(dim::angle) == "rad, deg");
  CHECK(example_units(dim::angular_velocity) == "rad/s, deg/s, rpm");
  CHECK(example_units(dim::volume_flow) == "m3/s, l/min, m3/h, cfm");
  CHECK(example_units(dim::velocity) == "m/s, mm/s, m/min, fpm");
}

TEST_CASE("numbers that other readers take differently shall be refused with what to write") {
  CHECK(refusal("010", dim::none).find("write 10") != std::string::npos);
  CHECK(refusal("-007 mm", dim::length).find("write -7") != std::string::npos);
  CHECK(refusal("00.5", dim::none).find("write 0.5") != std::string::npos);
  CHECK_FALSE(refusal("1,5", dim::none).empty());
  CHECK_FALSE(refusal("1_000", dim::none).empty());
  CHECK_FALSE(refusal("1:30", dim::time).empty());
  CHECK_FALSE(refusal("0x10", dim::none).empty());
  CHECK_FALSE(refusal("0o10", dim::none).empty());
  CHECK_FALSE(refusal("1e999", dim::none).empty());
  CHECK_FALSE(refusal("1e308 km", dim::length).empty());
  CHECK_FALSE(refusal("nan", dim::none).empty());
  CHECK_FALSE(refusal("--1", dim::none).empty());
  CHECK_FALSE(refusal("", dim::none).empty());
  CHECK(refusal("0", dim::none).empty());
  CHECK(refusal("0.5", dim::none).empty());
}

TEST_CASE("the written SI unit of every named dimension shall read back as that dimension") {
  for (const Dimension d : {dim::length,
                            dim::mass,
                            dim::time,
                            dim::temperature,
                            dim::angle,
                            dim::area,
                            dim::volume,
                            dim::frequency,
                            dim::velocity,
                            dim::acceleration,
                            dim::angular_velocity,
                            dim::density,
                            dim::force,
                            dim::pressure,
                            dim::dynamic_viscosity,
                            dim::mass_flow,
                            dim::volume_flow,
                            dim::energy,
                            dim::surface_energy,
                            dim::stiffness,
                            dim::mass * dim::area / dim::temperature}) {
    const auto unit = parse_unit(si_unit(d));
    REQUIRE_MESSAGE(unit, si_unit(d));
    CHECK(unit->dimension == d);
    CHECK(unit->numerator / unit->denominator == 1.0);
  }
}

TEST_CASE("a number shall be written so that it reads back the same") {
  for (const double v : {0.1, 1.0 / 3.0, 6.02e23, -1e-300, 350e-3, 5e-324}) {
    CHECK(value(number_text(v), dim::none) == v);
  }
}
