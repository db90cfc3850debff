// SPDX-License-Identifier: MIT
#include "2d/critical_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/box_tests.hpp"
#include "common/random_polynomials.hpp"
#include "proved_by_parts.hpp"
#include "written.hpp"

namespace encase {
namespace {

const Box<2> kSquare{{-1, -1}, {1, 1}};

struct Found {
  FilteredFunction<2> f;
  CriticalRegions regions;
};

Found find(const Polynomial<2>& exact, const Box<2>& box = kSquare,
           const std::vector<Line>& half_planes = {}) {
  Found found{FilteredFunction<2>(exact), {}};
  Kernel kernel;
  found.regions = critical_regions(found.f, 3, box, half_planes, SubdivisionLimits{}, kernel);
  return found;
}
Found find(const std::string& text, const Box<2>& box = kSquare,
           const std::vector<Line>& half_planes = {}) {
  return find(written::polynomial<2>(text), box, half_planes);
}

/// The index of the region that contains a point, -1 if none does.
int region_at(const CriticalRegions& regions, const Point<2>& point) {
  for (std::size_t k = 0; k < regions.regions.size(); ++k)
    for (const Box<2>& box : regions.regions[k].boxes)
      if (box.contains(point)) return static_cast<int>(k);
  return -1;
}

/// Proves again what is claimed of every leaf and every region.
void expect_proved(const Found& found) {
  const CriticalRegions& r = found.regions;
  Kernel kernel;
  EXPECT_EQ(static_cast<int>(r.tokens.size()), r.boxes);
  EXPECT_EQ(leaves<2>(r.root_box, r.tokens, cover::kUnresolved), r.unresolved);
  for (const Box<2>& leaf : leaves<2>(r.root_box, r.tokens, cover::kExcluded))
    EXPECT_TRUE(proved_by_parts(leaf, [&](const Box<2>& part) {
      return no_relevant_critical_point(found.f, part, kernel);
    }));
  for (std::size_t k = 0; k < r.regions.size(); ++k) {
    EXPECT_EQ(r.regions[k].curve, 3);
    EXPECT_EQ(leaves<2>(r.root_box, r.tokens, static_cast<int>(k)), r.regions[k].boxes);
    for (const Box<2>& box : r.regions[k].boxes)
      EXPECT_EQ(sign_on_box<2>(found.f, box, kernel), r.regions[k].sign);
    // One component each, which no other one touches.
    for (const int c : connected_components(r.regions[k].boxes)) EXPECT_EQ(c, 0);
    for (std::size_t j = 0; j < k; ++j)
      for (const Box<2>& a : r.regions[j].boxes)
        for (const Box<2>& b : r.regions[k].boxes) EXPECT_FALSE(a.meets(b));
  }
}

TEST(CriticalRegions, EllipseHasOneAroundItsCentre) {
  const Found found = find("(x - 1/3)^2 + 3 (y + 1/7)^2 - 1/10");
  ASSERT_EQ(found.regions.regions.size(), 1u);
  EXPECT_EQ(found.regions.regions[0].sign, Sign::Negative);
  EXPECT_EQ(region_at(found.regions, {1.0 / 3, -1.0 / 7}), 0);
  EXPECT_TRUE(found.regions.unresolved.empty());
  expect_proved(found);
}

TEST(CriticalRegions, TinyLoopHasOneWithinTheLoop) {
  const Found found = find("(x - 3/10)^2 + (y - 1/5)^2 - 1/10^12");
  ASSERT_EQ(found.regions.regions.size(), 1u);
  EXPECT_EQ(region_at(found.regions, {0.3, 0.2}), 0);
  for (const Box<2>& box : found.regions.regions[0].boxes)
    for (const double x : {box.lo[0], box.hi[0]})
      for (const double y : {box.lo[1], box.hi[1]}) EXPECT_LT(std::hypot(x - 0.3, y - 0.2), 1e-6);
  EXPECT_TRUE(found.regions.unresolved.empty());
  expect_proved(found);
}

TEST(CriticalRegions, EveryOvalOfAFamilyHasItsOwn) {
  const Found found = find("(x^2 - 1/9) (x^2 - 1) (y^2 - 1/9) (y^2 - 1) - 1/1000");
  EXPECT_TRUE(found.regions.unresolved.empty());
  expect_proved(found);
  // The maxima of |f| are at the critical points of the factors: x, y in {0, +-sqrt(5)/3}.
  const double c = std::sqrt(5.0) / 3;
  for (const double x : {-c, 0.0, c})
    for (const double y : {-c, 0.0, c}) EXPECT_GE(region_at(found.regions, {x, y}), 0);
}

TEST(CriticalRegions, CurvesWithoutLoopsHaveNone) {
  for (const std::string text :
       {"y - x/3", "y - x^3 + x", "x y - 1/10", "x^2 - y^2 - 1/5", "x^2 + y^2 + 1"}) {
    const Found found = find(text);
    EXPECT_TRUE(found.regions.regions.empty()) << text;
    EXPECT_TRUE(found.regions.unresolved.empty()) << text;
    expect_proved(found);
  }
}

TEST(CriticalRegions, SingularPointsStayUnresolved) {
  for (const std::string text :
       {"(x - 1/3)^2 - (y - 1/5)^2", "(y - 1/5)^2 - (x - 1/3)^3", "(x - 1/3)^2 + (y - 1/5)^2"}) {
    const Found found = find(text);
    ASSERT_FALSE(found.regions.unresolved.empty()) << text;
    EXPECT_LT(found.regions.unresolved.size(), 500u) << text;
    bool holds = false;
    for (const Box<2>& box : found.regions.unresolved) {
      holds = holds || box.contains(Point<2>{1.0 / 3, 0.2});
      EXPECT_LT(std::hypot(box.lo[0] - 1.0 / 3, box.lo[1] - 0.2), 1e-3) << text;
    }
    EXPECT_TRUE(holds) << text;
    expect_proved(found);
  }
}

TEST(CriticalRegions, WholeCurveOfMaximaIsOneRegion) {
  // |f| is largest along the circle of radius 1/2.
  const Found found = find("(x^2 + y^2 - 1/4)^2 - 1/100");
  EXPECT_TRUE(found.regions.unresolved.empty());
  expect_proved(found);
  const int ring = region_at(found.regions, {0.5, 0});
  EXPECT_GE(ring, 0);
  for (int k = 1; k < 12; ++k)
    EXPECT_EQ(region_at(found.regions, {0.5 * std::cos(0.5 * k), 0.5 * std::sin(0.5 * k)}), ring);
}

TEST(CriticalRegions, HalfPlanesLeaveOutWhatIsBeyond) {
  const std::string two = "((x + 1/2)^2 + y^2 - 1/50) ((x - 1/2)^2 + (y - 1/9)^2 - 1/50)";
  const auto near = [](const Found& found, const Point<2>& point) {
    int count = 0;
    for (const CriticalRegion& region : found.regions.regions) {
      const Point<2> at = region.boxes.front().center();
      count += std::hypot(at[0] - point[0], at[1] - point[1]) < 0.1;
    }
    return count;
  };
  const Found both = find(two);
  EXPECT_EQ(near(both, {-0.5, 0}), 1);
  EXPECT_EQ(near(both, {0.5, 0.111}), 1);
  const Found right = find(two, kSquare, {Line::from_rationals({-1, 0, Rational(1, 10)})});
  EXPECT_EQ(near(right, {-0.5, 0}), 0);
  EXPECT_EQ(near(right, {0.5, 0.111}), 1);
  expect_proved(right);
}

TEST(CriticalRegions, RandomCurvesAreCovered) {
  for (const int degree : {3, 6, 9}) {
    RandomOptions options;
    options.degree = degree;
    options.count = 2;
    for (const Polynomial<2>& f : random_polynomials<2>(options)) {
      const Found found = find(f);
      EXPECT_TRUE(found.regions.unresolved.empty());
      expect_proved(found);
    }
  }
}

TEST(CriticalRegions, LimitOnBoxesLeavesUnresolvedLeaves) {
  const FilteredFunction<2> f(written::polynomial<2>("x^2 + y^2 - 1/10"));
  SubdivisionLimits limits;
  limits.max_boxes = 3;
  Kernel kernel;
  EXPECT_FALSE(critical_regions(f, 0, kSquare, {}, limits, kernel).unresolved.empty());
}

TEST(ConnectedComponents, BoxesThatTouchAreJoined) {
  const auto unit_box = [](double x, double y) { return Box<2>{{x, y}, {x + 1, y + 1}}; };
  // A corner, a side, and a gap; a chain whose ends meet late in the sweep.
  EXPECT_EQ(connected_components({unit_box(0, 0), unit_box(1, 1), unit_box(5, 5), unit_box(2, 1)}),
            (std::vector<int>{0, 0, 1, 0}));
  EXPECT_EQ(connected_components({unit_box(0, 0), unit_box(0, 4), unit_box(0, 2), unit_box(0, 1),
                                  unit_box(0, 3), unit_box(1.5, 0)}),
            (std::vector<int>{0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(connected_components({}), std::vector<int>{});
  // A long box bridges others.
  EXPECT_EQ(connected_components({unit_box(0, 0), unit_box(8, 0), Box<2>{{0.5, 1}, {9, 1.5}}}),
            (std::vector<int>{0, 0, 0}));
}

TEST(CriticalRegions, FollowARidgeBetweenCloseBranches) {
  // Two arcs as close as 4e-8 along y = x^-4, and no critical point between them: along the field
  // (-x, 4 y) the derivative is 40 y^10. Boxes as small as the gap would be ten millions.
  const Found found = find("y^10 - 2*(x^4*y - 1)^2", {{1.1, -4}, {2, 4}});
  EXPECT_TRUE(found.regions.unresolved.empty());
  EXPECT_LT(found.regions.boxes, 5000);
  expect_proved(found);
}

}  // namespace
}  // namespace encase
