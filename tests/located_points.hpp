// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "common/expression_program.hpp"
#include "common/random_polynomials.hpp"
#include "common/segments.hpp"
#include "encase/arrangement.hpp"

/// Locating points in arrangements, compared with exact signs.
namespace encase::located_points {

inline Arrangement arranged(const Encasement& e) {
  const Result<Arrangement> result = arrange(e);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_EQ(check(result.value()), "");
  return result.value();
}

inline int count(const Arrangement& a, Arrangement::Vertex::Kind kind) {
  return static_cast<int>(std::count_if(a.vertices.begin(), a.vertices.end(),
                                        [&](const auto& v) { return v.kind == kind; }));
}

/// Curves of the degrees 1, 2, 3, 4, 1, ...
inline std::vector<NamedCurve> mixed_curves(int count, std::uint64_t seed) {
  std::vector<NamedCurve> curves;
  for (int k = 0; k < count; ++k) {
    RandomOptions options;
    options.degree = 1 + k % 4;
    options.count = 1;
    options.seed = 100 * seed + static_cast<std::uint64_t>(k);
    curves.push_back({"c" + std::to_string(k), random_polynomials<2>(options)[0]});
  }
  return curves;
}

inline RationalPoint<2> exactly(const Point<2>& p) { return {Rational(p[0]), Rational(p[1])}; }

inline Sign exact_sign(const Polynomial<2>& f, const RationalPoint<2>& p) {
  return sign_of(sgn(f(p)));
}

/// Of an expression the sign where MPFR intervals tell it.
inline Sign exact_sign(const Function<2>& f, const RationalPoint<2>& p, bool* known) {
  if (f.is_polynomial()) return exact_sign(f.polynomial(), p);
  Kernel kernel;
  const PointSign sign = ExpressionProgram<2>(f.expression()).sign_at(p, kernel);
  *known = *known && sign != PointSign::Unknown && sign != PointSign::NoValue;
  return sign == PointSign::Positive   ? Sign::Positive
         : sign == PointSign::Negative ? Sign::Negative
                                       : Sign::Zero;
}

/// The located feature has the exact signs at the point on it.
inline void expect_right(const Encasement& e, const Arrangement& a,
                         const Arrangement::Feature& feature, const RationalPoint<2>& point) {
  Kernel kernel;
  bool outside = false, boundary = false;
  for (int k = 0; k < e.region_used.side_count(); ++k) {
    const Sign s = side(e.region_used.side(k), point, kernel);
    outside = outside || s == Sign::Positive;
    boundary = boundary || s == Sign::Zero;
  }
  if (outside) {
    EXPECT_EQ(feature, (Arrangement::Feature{Arrangement::Feature::Kind::Face, a.outside}));
    return;
  }
  std::vector<Sign> signs;
  std::vector<int> zeros;
  bool known = true;
  for (std::size_t c = 0; c < e.curves.size(); ++c) {
    signs.push_back(exact_sign(e.curves[c].function, point, &known));
    if (signs.back() == Sign::Zero) zeros.push_back(static_cast<int>(c));
  }
  if (!known) {
    EXPECT_EQ(feature.kind, Arrangement::Feature::Kind::Undecided);
    return;
  }
  ASSERT_GE(feature.index, 0);
  if (feature.kind == Arrangement::Feature::Kind::Face) {
    EXPECT_TRUE(zeros.empty());
    EXPECT_FALSE(boundary);
    EXPECT_EQ(a.faces[feature.index].signs, signs);
  } else if (feature.kind == Arrangement::Feature::Kind::Edge) {
    const int curve = a.edges[feature.index].curve;
    EXPECT_EQ(curve < 0, boundary);
    EXPECT_EQ(zeros, curve < 0 ? std::vector<int>{} : std::vector<int>{curve});
    for (const int f : a.faces_at(feature.index))
      for (std::size_t c = 0; c < signs.size() && f != a.outside; ++c)
        if (static_cast<int>(c) != curve) {
          EXPECT_EQ(a.faces[f].signs[c], signs[c]);
        }
  } else {
    const Arrangement::Vertex& v = a.vertices[feature.index];
    if (v.kind == Arrangement::Vertex::Kind::Crossing)
      EXPECT_EQ(zeros, std::vector<int>(e.crossings[v.index].curves.begin(),
                                        e.crossings[v.index].curves.end()));
    else if (v.kind == Arrangement::Vertex::Kind::OnBoundary)
      EXPECT_EQ(zeros, std::vector<int>{e.line_crossings[v.index].curve});
    else
      EXPECT_EQ(point, e.region_used.corners[v.index]);
  }
}

/// Random points, some outside, some of few bits, and points of splitting lines.
inline void expect_locates(const Encasement& e, const Arrangement& a, int points, unsigned seed) {
  const PointLocator locator(e, a);
  const Box<2> box = e.region_used.bounding_box();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-0.05, 1.05);
  for (int k = 0; k < points; ++k) {
    Point<2> p;
    for (int i = 0; i < 2; ++i) {
      p[i] = box.lo[i] + part(random) * box.width(i);
      if (k % 3 == 0) p[i] = std::round(8 * p[i]) / 8;
    }
    const Arrangement::Feature feature = locator.locate(p);
    expect_right(e, a, feature, exactly(p));
    if (k % 10 == 0) {
      EXPECT_EQ(locator.locate(exactly(p)), feature);
    }
    const Line& line = e.lines[random() % e.lines.size()];
    const RationalPoint<2> on_line = point_on_line(line, Rational(p[parameter_axis(line)]));
    if (k % 5 == 0) expect_right(e, a, locator.locate(on_line), on_line);
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace encase::located_points
