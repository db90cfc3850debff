// SPDX-License-Identifier: MIT
#include "encase/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "common/interval.hpp"

namespace encase {
namespace {

Rational parsed(const std::string& text) {
  Rational value = -999;
  EXPECT_TRUE(parse_rational(text.c_str(), &value)) << text;
  return value;
}

TEST(ParseRational, DecimalsAreExact) {
  EXPECT_EQ(parsed("0"), 0);
  EXPECT_EQ(parsed("007"), 7);
  EXPECT_EQ(parsed("-1.25e-3"), Rational(-1, 800));
  EXPECT_EQ(parsed("+.5"), Rational(1, 2));
  EXPECT_EQ(parsed("3."), 3);
  EXPECT_EQ(parsed("0.1"), Rational(1, 10));
  EXPECT_EQ(parsed("2E+3"), 2000);
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, 400);
  EXPECT_EQ(parsed("1e400"), Rational(power));
  EXPECT_EQ(parsed("-1e-400"), Rational(-1) / Rational(power));
}

TEST(ParseRational, FractionsAreReduced) {
  EXPECT_EQ(parsed("6/4"), Rational(3, 2));
  EXPECT_EQ(parsed("-6/4").get_str(), "-3/2");
}

TEST(ParseRational, RefusesEverythingElse) {
  for (const char* text :
       {"", "-", ".", "e5", "1e", "1e+", "1/0", "1/", "/2", "1/-2", "1.5/2", "nan", "inf", "0x10",
        "1 2", " 1", "1e100001", "1e99999999999999999999"}) {
    Rational value;
    EXPECT_FALSE(parse_rational(text, &value)) << text;
  }
}

TEST(NearestDouble, AgreesWithTheLibraryOnDecimals) {
  for (const char* text :
       {"0.1", "-0.1", "1e300", "123456789.123456789", "4e-320", "1e-400", "1e400", "-1e400",
        "2.2250738585072011e-308", "9007199254740993", "9007199254740995", "1.7976931348623158e308",
        "1.7976931348623159e308", "2.5e-324", "-9007199254740993"})
    EXPECT_EQ(nearest_double(parsed(text)), std::strtod(text, nullptr)) << text;
}

TEST(IntervalEnclose, IsTheTightestPairOfDoubles) {
  const Interval tenth = Interval::enclose(Rational(1, 10));
  EXPECT_EQ(std::nextafter(tenth.lo, 1.0), tenth.hi);
  EXPECT_LT(Rational(tenth.lo), Rational(1, 10));
  EXPECT_GT(Rational(tenth.hi), Rational(1, 10));
  const Interval exact = Interval::enclose(Rational(3, 8));
  EXPECT_EQ(exact.lo, 0.375);
  EXPECT_EQ(exact.hi, 0.375);
  const Interval tiny = Interval::enclose(parsed("1e-400"));
  EXPECT_EQ(tiny.lo, 0);
  EXPECT_EQ(tiny.hi, std::numeric_limits<double>::denorm_min());
  const Interval huge = Interval::enclose(parsed("-1e400"));
  EXPECT_EQ(huge.hi, -std::numeric_limits<double>::max());
  EXPECT_TRUE(std::isinf(huge.lo));
}

}  // namespace
}  // namespace encase
