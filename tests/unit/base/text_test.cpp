// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "base/process/memory.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

using namespace dust::base;

TEST_CASE("numbers for people shall read as printf writes them") {
  const double numbers[] = {0.0,   1.0,   -1.0,    0.1 + 0.2, 1e-5, 123456.0, 1234567.0,
                            9.995, 1e100, -2.5e-9, 99.95,     1e21, 0.5,      2.5};
  for (const double v : numbers) {
    for (const int digits : {1, 2, 3, 4, 6, 9, 12}) {
      CAPTURE(v);
      CAPTURE(digits);
      char expected[400];
      std::snprintf(expected, sizeof expected, "%.*g", digits, v);
      CHECK(digits_text(v, digits) == expected);
      std::snprintf(expected, sizeof expected, "%.*f", digits, v);
      CHECK(fixed_text(v, digits) == expected);
      std::snprintf(expected, sizeof expected, "%.*e", digits, v);
      CHECK(exponent_text(v, digits) == expected);
    }
  }
  CHECK(digits_text(std::numeric_limits<double>::infinity(), 4) == "inf");
  CHECK(digits_text(-std::numeric_limits<double>::infinity(), 4) == "-inf");
  CHECK(digits_text(std::numeric_limits<double>::quiet_NaN(), 4) == "nan");
}

TEST_CASE("the shortest text of a number shall read back as the same bits") {
  for (const double v : {0.1, 1.0 / 3.0, 1e300, 5e-324, -0.0, 123456789.0}) {
    const double back = std::strtod(shortest_text(v).c_str(), nullptr);
    CHECK(back == v);
    CHECK(std::signbit(back) == std::signbit(v));
  }
  CHECK(shortest_text(0.1) == "0.1");
  CHECK(shortest_text(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(shortest_text(-std::numeric_limits<double>::quiet_NaN()) == "nan");
}

TEST_CASE("durations shall have three digits below 100 s, then minutes and hours") {
  CHECK(duration_text(0.01234) == "0.0123 s");
  CHECK(duration_text(99.94) == "99.9 s");
  CHECK(duration_text(125.0) == "2 min 05 s");
  CHECK(duration_text(3599.6) == "1 h 00 min");
  CHECK(duration_text(3725.0) == "1 h 02 min");
}

TEST_CASE("estimated durations shall have two digits of one unit") {
  CHECK(estimated_duration_text(0.2) == "1 s");
  CHECK(estimated_duration_text(44.4) == "44 s");
  CHECK(estimated_duration_text(98.9) == "99 s");
  CHECK(estimated_duration_text(118.0) == "2 min");
  CHECK(estimated_duration_text(98.0 * 60.0) == "98 min");
  CHECK(estimated_duration_text(100.0 * 60.0) == "1.7 h");
  CHECK(estimated_duration_text(123.0 * 3600.0) == "123 h");
}

TEST_CASE("lengths, masses and flows shall have the unit that people of their size use") {
  CHECK(length_text(0.35) == "350 mm");
  CHECK(length_text(1.2) == "1.2 m");
  CHECK(length_text(60e-6) == "60 um");
  CHECK(length_text(0.99999) == "1 m");
  CHECK(length_text(0.0) == "0 m");
  CHECK(length_text(2e-9) == "0.002 um");
  CHECK(area_text(0.0123) == "123 cm2");
  CHECK(area_text(31750.4) == "31750 m2");
  CHECK(volume_text(-2e-6) == "-2 cm3");
  CHECK(volume_text(123456.0) == "123456 m3");
  CHECK(mass_text(1234.0) == "1.23 t");
  CHECK(mass_text(0.15) == "150 g");
  CHECK(mass_text(-3.0) == "-3 kg");
  CHECK(mass_text(0.0) == "0 kg");
  CHECK(volume_flow_text(4500.0 / 3600.0) == "4500 m3/h");
  CHECK(volume_flow_text(123456.0 / 3600.0) == "123456 m3/h");
  CHECK(volume_flow_text(12.0 / 6e4) == "12 l/min");
}

TEST_CASE("places shall have their three coordinates in m") {
  CHECK(place_text({0.0059, -1.2, 0.0}) == "(0.0059, -1.2, 0) m");
  CHECK(place_text({0.1234567, 1e-7, 1000.0}, 6) == "(0.123457, 1e-07, 1000) m");
}

TEST_CASE("edges shall share the unit of the longest") {
  CHECK(extent_text({0.34, 0.02, 0.33}) == "340 x 20 x 330 mm");
  CHECK(extent_text({3.4, 2.6, 3.0}) == "3.4 x 2.6 x 3 m");
  CHECK(extent_text({1.2, 0.02, 0.5}) == "1200 x 20 x 500 mm");
  CHECK(extent_text({4e-4, 3e-4, 5e-4}) == "400 x 300 x 500 um");
}

TEST_CASE("mass flows shall be t/h where the domain is a plant, kg/s and below elsewhere") {
  CHECK(mass_flow_text(250.0 / 3.6, 3.4) == "250 t/h (69.4 kg/s)");
  CHECK(mass_flow_text(5000.0 / 3.6, 30.0) == "5000 t/h (1389 kg/s)");
  CHECK(mass_flow_text(0.2, 3.4) == "200 g/s");
  CHECK(mass_flow_text(0.006, 0.34) == "6 g/s");
  CHECK(mass_flow_text(2.5, 0.34) == "2.5 kg/s");
  CHECK(mass_flow_text(1.0 / 3.6, 3.4) == "1 t/h (278 g/s)");
  CHECK(mass_flow_text(3e-6, 0.34) == "3 mg/s");
  CHECK(mass_flow_text(0.0, 3.4) == "0 kg/s");
}

TEST_CASE("a need of memory shall be told beside what is free, where that is less") {
  CHECK(dust::base::shortage_text(4e9, 4e9).empty());
  CHECK(dust::base::shortage_text(41.2e9, 20e9)
            .starts_with(
                "the run needs about 41.2 GB of memory, and 20 GB of this machine's are free"));
  const auto free = dust::base::free_memory();
  CHECK((!free || *free > 0.0));
}
