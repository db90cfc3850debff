// SPDX-License-Identifier: MIT
#include "common/isolate_roots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/components.hpp"
#include "common/random_polynomials.hpp"
#include "proved_by_parts.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

template <int D>
RootIsolation<D> isolate(const std::vector<FilteredFunction<D>>& polynomials, const Box<D>& box,
                         const std::vector<Hyperplane<D>>& half_spaces = {}) {
  System<D> system;
  for (std::size_t i = 0; i < D; ++i) system[i] = &polynomials[i];
  Kernel kernel;
  return isolate_roots<D>(system, box, half_spaces, SubdivisionLimits{}, kernel);
}

template <int D>
std::vector<FilteredFunction<D>> filtered(const std::vector<std::string>& texts) {
  std::vector<FilteredFunction<D>> result;
  for (const std::string& text : texts) result.emplace_back(polynomial<D>(text));
  return result;
}

/// Proves again what the result claims: the boxes, and the cover leaf by leaf.
template <int D>
void expect_proved(const RootIsolation<D>& result,
                   const std::vector<FilteredFunction<D>>& polynomials) {
  System<D> system;
  for (std::size_t i = 0; i < D; ++i) system[i] = &polynomials[i];
  Kernel kernel;
  for (std::size_t i = 0; i < result.roots.size(); ++i) {
    EXPECT_TRUE(exactly_one_zero<D>(system, result.roots[i], kernel)) << "root " << i;
    for (std::size_t j = i + 1; j < result.roots.size(); ++j)
      EXPECT_FALSE(result.roots[i].meets(result.roots[j])) << "roots " << i << " and " << j;
    const auto own = leaves<D>(result.root_box, result.tokens, static_cast<int>(i));
    EXPECT_FALSE(own.empty());
    for (const Box<D>& leaf : own)
      EXPECT_TRUE(proved_by_parts(leaf,
                                  [&](const Box<D>& part) {
                                    return at_most_one_zero<D>(
                                               system, hull<D>(part, result.roots[i]), kernel) ||
                                           no_common_zero<D>(system, part, kernel);
                                  }))
          << "root " << i;
  }
  for (const Box<D>& leaf : leaves<D>(result.root_box, result.tokens, cover::kExcluded))
    EXPECT_TRUE(proved_by_parts(
        leaf, [&](const Box<D>& part) { return no_common_zero<D>(system, part, kernel); }));
  EXPECT_EQ(leaves<D>(result.root_box, result.tokens, cover::kUnresolved), result.unresolved);
  EXPECT_EQ(static_cast<int>(result.tokens.size()), result.boxes);
}

TEST(IsolateRoots, FindsAsManyAsTheResultantsHave) {
  // For generic curves every real root of the resultant is the coordinate of one real zero.
  int total = 0;
  for (int degree = 1; degree <= 5; ++degree)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      RandomOptions options;
      options.kind = seed % 2 ? RandomOptions::Kind::Interpolating : RandomOptions::Kind::Dense;
      options.degree = degree;
      options.seed = seed;
      const auto exact = random_polynomials<2>(options);
      const Polynomial<1> in_x = resultant(exact[0], exact[1], 1),
                          in_y = resultant(exact[0], exact[1], 0);
      ASSERT_EQ(square_free_part(in_x).degree(), in_x.degree());
      const Rational far = 1 << 30;
      const int all = count_real_roots(in_y, -far, far);
      int reach = 1;
      while (count_real_roots(in_y, -reach, reach) < all) reach *= 2;
      const Box<2> box{{-1, -1.0 * reach}, {1, 1.0 * reach}};
      const std::vector<FilteredFunction<2>> curves{FilteredFunction<2>(exact[0]),
                                                    FilteredFunction<2>(exact[1])};
      const auto result = isolate<2>(curves, box);
      EXPECT_TRUE(result.unresolved.empty());
      int inside = 0;
      for (const Box<2>& root : result.roots) {
        EXPECT_EQ(count_real_roots(in_x, Rational(root.lo[0]), Rational(root.hi[0])), 1);
        EXPECT_EQ(count_real_roots(in_y, Rational(root.lo[1]), Rational(root.hi[1])), 1);
        EXPECT_TRUE(root.hi[0] < -1 || root.lo[0] > -1);
        EXPECT_TRUE(root.hi[0] < 1 || root.lo[0] > 1);
        inside += -1 < root.lo[0] && root.hi[0] < 1;
      }
      EXPECT_EQ(inside, count_real_roots(in_x, -1, 1)) << "degree " << degree << ", seed " << seed;
      expect_proved<2>(result, curves);
      total += inside;
    }
  EXPECT_GT(total, 50);
}

TEST(IsolateRoots, ThreeQuadricsMeetInEightPoints) {
  const auto quadrics =
      filtered<3>({"x^2 + y z/10 - 1/4", "y^2 + x z/10 - 1/5", "z^2 + x y/10 - 1/3"});
  const auto result = isolate<3>(quadrics, Box<3>{{-1, -1, -1}, {1, 1, 1}});
  EXPECT_TRUE(result.unresolved.empty());
  ASSERT_EQ(result.roots.size(), 8u);
  expect_proved<3>(result, quadrics);
  std::array<int, 8> octants{};
  for (const Box<3>& root : result.roots) {
    int octant = 0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(root.width(i), 1e-12);
      octant = 2 * octant + (root.lo[i] > 0);
    }
    ++octants[static_cast<std::size_t>(octant)];
  }
  EXPECT_EQ(octants, (std::array<int, 8>{1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST(IsolateRoots, SpheresAndAPlaneMeetInTwoPoints) {
  const auto spheres = filtered<3>({"x^2 + y^2 + z^2 - 1", "(x - 1)^2 + y^2 + z^2 - 1", "y - z/3"});
  const auto result = isolate<3>(spheres, Box<3>{{-2, -2, -2}, {2, 2, 2}});
  EXPECT_TRUE(result.unresolved.empty());
  ASSERT_EQ(result.roots.size(), 2u);
  expect_proved<3>(result, spheres);
  for (const Box<3>& root : result.roots) {
    EXPECT_LE(root.lo[0], 0.5);
    EXPECT_GE(root.hi[0], 0.5);
  }
}

TEST(IsolateRoots, HalfSpacesKeepWhatIsInside) {
  const auto curves = filtered<2>({"(4x^2 - 1) (x^2 - 1/9)", "(4y^2 - 1) (y - 1/7)"});
  const Box<2> box{{-1, -1}, {1, 1}};
  const auto all = isolate<2>(curves, box);
  EXPECT_EQ(all.roots.size(), 12u);
  const Line diagonal = Line::from_rationals({1, 1, Rational(-1, 10)});
  const auto below = isolate<2>(curves, box, {diagonal});
  expect_proved<2>(below, curves);
  const auto inside = [&](const RootIsolation<2>& result) {
    std::vector<Box<2>> boxes;
    for (const Box<2>& root : result.roots)
      if (root.hi[0] + root.hi[1] < 0.1) boxes.push_back(root);
    return boxes.size();
  };
  EXPECT_EQ(inside(below), inside(all));
  EXPECT_EQ(inside(all), 7u);
  EXPECT_LT(below.roots.size(), 12u);
  for (const Box<2>& leaf : leaves<2>(below.root_box, below.tokens, cover::kOutside))
    EXPECT_GT(leaf.lo[0] + leaf.lo[1], 0.1);
}

TEST(IsolateRoots, RootsAtCornersAndOnCutsAreFoundOnce) {
  // Zeros on a grid, among them the box's centre, corners and sides.
  const auto curves = filtered<2>({"x (x^2 - 1) (x^2 - 1/4)", "y (y^2 - 1) (y^2 - 1/4)"});
  const auto result = isolate<2>(curves, Box<2>{{-1, -1}, {1, 1}});
  EXPECT_TRUE(result.unresolved.empty());
  EXPECT_EQ(result.roots.size(), 25u);
  expect_proved<2>(result, curves);
}

TEST(IsolateRoots, RootsNextToCutsAreFoundOnce) {
  // From both boxes beside a cut: of so many roots some lie that close to one.
  std::size_t total = 0;
  for (const int degree : {4, 6, 10})
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      RandomOptions options;
      options.degree = degree;
      options.seed = seed;
      std::vector<FilteredFunction<2>> curves;
      for (const auto& p : random_polynomials<2>(options)) curves.emplace_back(p);
      const auto result = isolate<2>(curves, Box<2>{{-1, -1}, {1, 1}});
      for (std::size_t i = 0; i < result.roots.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_FALSE(result.roots[i].meets(result.roots[j]))
              << "degree " << degree << ", seed " << seed << ", roots " << i << " and " << j;
      total += result.roots.size();
    }
  EXPECT_GT(total, 5000u);
}

TEST(IsolateRoots, CloseRootsAreTold) {
  // The circle x^2 + y^2 = e^2 and a line through its centre.
  for (const std::string e : {"1e-3", "1e-6", "1e-9"}) {
    const auto curves = filtered<2>({"y - x/3", "y - x/3 - x^2 - y^2 + " + e + "^2"});
    const auto result = isolate<2>(curves, Box<2>{{-1, -1}, {1, 1}});
    EXPECT_TRUE(result.unresolved.empty()) << e;
    EXPECT_EQ(result.roots.size(), 2u) << e;
    expect_proved<2>(result, curves);
  }
}

TEST(IsolateRoots, TangencyStaysUnresolvedInASmallCluster) {
  const auto curves = filtered<2>({"y - x^2", "y + (x - 1) x^2"});  // touch at (0, 0)
  const auto result = isolate<2>(curves, Box<2>{{-1, -1}, {1, 1}});
  ASSERT_FALSE(result.unresolved.empty());
  EXPECT_LT(result.unresolved.size(), 1000u);
  for (const Box<2>& box : result.unresolved) {
    EXPECT_LT(std::fabs(box.center()[0]), 1e-3);
    EXPECT_LT(std::fabs(box.center()[1]), 1e-3);
  }
  expect_proved<2>(result, curves);
}

TEST(IsolateRoots, CurvesThatDoNotMeetHaveNone) {
  const auto curves = filtered<2>({"y - x^2", "y - x^2 - 1/1000"});
  const auto result = isolate<2>(curves, Box<2>{{-1, -1}, {1, 1}});
  EXPECT_TRUE(result.roots.empty());
  EXPECT_TRUE(result.unresolved.empty());
  expect_proved<2>(result, curves);
}

TEST(IsolateRoots, LimitOnBoxesLeavesUnresolvedLeaves) {
  const auto curves = filtered<2>({"x^2 + y^2 - 1/2", "x^3 - y/3"});
  System<2> system{&curves[0], &curves[1]};
  SubdivisionLimits limits;
  limits.max_boxes = 4;
  Kernel kernel;
  const auto result = isolate_roots<2>(system, Box<2>{{-1, -1}, {1, 1}}, {}, limits, kernel);
  EXPECT_FALSE(result.unresolved.empty());
  expect_proved<2>(result, curves);
}

}  // namespace
}  // namespace encase
