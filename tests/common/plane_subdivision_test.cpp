// SPDX-License-Identifier: MIT
#include "common/plane_subdivision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/isolate_roots.hpp"
#include "written.hpp"

namespace encase {
namespace {

/// The leaves of the tokens tile the box: as many tokens as the tree has, and the areas add up.
void expect_tiles(const Box<2>& root, const std::vector<int>& tokens) {
  Rational area = 0;
  std::vector<Box<2>> stack{root};
  for (const int token : tokens) {
    ASSERT_FALSE(stack.empty());
    const Box<2> box = stack.back();
    stack.pop_back();
    if (token <= cover::kSplitX && token >= cover::kSplitZ) {
      Box<2> lower, upper;
      ASSERT_TRUE(halve_box(box, cover::kSplitX - token, &lower, &upper));
      stack.push_back(upper);
      stack.push_back(lower);
    } else {
      EXPECT_GE(token, cover::kUnresolved);
      area +=
          (Rational(box.hi[0]) - Rational(box.lo[0])) * (Rational(box.hi[1]) - Rational(box.lo[1]));
    }
  }
  EXPECT_TRUE(stack.empty());
  EXPECT_EQ(area, (Rational(root.hi[0]) - Rational(root.lo[0])) *
                      (Rational(root.hi[1]) - Rational(root.lo[1])));
}

class Subdivided {
 public:
  explicit Subdivided(const std::string& text, const Box<2>& root = {{-1, -1}, {1, 1}})
      : f_(written::polynomial<2>(text)), root_(root), tiled_(f_, root, kernel_) {}

  template <class Visit>
  std::vector<int> run(const SubdivisionLimits& limits, Visit visit,
                       const std::vector<Line>& half_planes = {}) {
    PlaneSubdivision<1> subdivision({&tiled_}, root_, half_planes, limits, kernel_);
    const std::vector<int> tokens = subdivision.run(visit);
    unresolved = subdivision.unresolved();
    expect_tiles(root_, tokens);
    return tokens;
  }
  const Box<2>& root() const { return root_; }
  bool unresolved = false;

 private:
  FilteredFunction<2> f_;
  Box<2> root_;
  Kernel kernel_;
  TiledFunction tiled_;
};

using Node = PlaneSubdivision<1>::Node;

TEST(PlaneSubdivision, LeavesTileTheBoxOverSeveralBands) {
  Subdivided s("x^2 + y^3 - 1/5");
  // Down to a point, deeper than two bands.
  const Point<2> point{0.3, -0.7};
  int deepest = 0;
  const auto tokens = s.run({}, [&](const Node& node) {
    deepest = std::max(deepest, node.level);
    for (int i = 0; i < 2; ++i)
      EXPECT_GE(node.tile[0]->half[i] * Tile::kReach,
                std::fabs(node.box.lo[i] - node.tile[0]->center[i]));
    if (!node.box.contains(point) || node.level >= 60) return cover::kExcluded;
    return wider_axis(node.box);
  });
  EXPECT_EQ(deepest, 60);
  EXPECT_FALSE(s.unresolved);
  EXPECT_EQ(tokens.size(), 121u);
}

TEST(PlaneSubdivision, WidthsEndAtTheSmallest) {
  Subdivided s("x + y");
  SubdivisionLimits limits;
  limits.smallest = 0x1p-4;
  const auto tokens = s.run(limits, [](const Node& node) { return wider_axis(node.box); });
  EXPECT_TRUE(s.unresolved);
  const auto left = leaves(s.root(), tokens, cover::kUnresolved);
  EXPECT_EQ(left.size(), 256u);
  for (const Box<2>& box : left) EXPECT_EQ(box.largest_width(), 0.125);
}

TEST(PlaneSubdivision, ABudgetIsSharedAndKept) {
  for (const int budget : {0, 1, 2, 7, 100, 1000}) {
    Subdivided s("x + y^2");
    SubdivisionLimits limits;
    limits.max_boxes = budget;
    int visits = 0;
    s.run(limits, [&](const Node& node) {
      ++visits;
      return wider_axis(node.box);
    });
    EXPECT_TRUE(s.unresolved);
    EXPECT_LE(visits, 2 * budget + 40);
  }
}

TEST(PlaneSubdivision, StoppingLeavesTheRestUnresolved) {
  Subdivided s("x + y^2");
  SubdivisionLimits limits;
  int asked = 0;
  limits.stop = [&] { return ++asked == 3; };
  int visits = 0;
  s.run(limits, [&](const Node& node) {
    ++visits;
    return wider_axis(node.box);
  });
  EXPECT_TRUE(s.unresolved);
  EXPECT_LT(visits, 200);
}

TEST(PlaneSubdivision, WhatLiesOutsideALineIsNotVisited) {
  Subdivided s("x + y");
  Line line;
  line.normal = {1, 0};
  line.offset = 0;  // x <= 0
  const auto tokens = s.run({},
                            [&](const Node& node) {
                              EXPECT_LE(node.box.lo[0], 0);
                              return node.level < 6 ? wider_axis(node.box) : cover::kExcluded;
                            },
                            {line});
  for (const Box<2>& box : leaves(s.root(), tokens, cover::kOutside)) EXPECT_GT(box.hi[0], 0);
  EXPECT_FALSE(leaves(s.root(), tokens, cover::kOutside).empty());
}

TEST(PlaneSubdivision, PartsWithoutZerosAreExcluded) {
  const FilteredFunction<2> f(written::polynomial<2>("x - 1/3")),
      g(written::polynomial<2>("y + 1/7"));
  const Box<2> root{{-1, -1}, {1, 1}};
  Kernel kernel;
  TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
  const SubdivisionLimits limits;
  const std::vector<Line> none;
  PlaneSubdivision<2> subdivision({&of_f, &of_g}, root, none, limits, kernel);
  const Point<2> zero{1 / 3.0, -1 / 7.0};
  const auto tokens = subdivision.run([&](PlaneSubdivision<2>::Node& node) {
    EXPECT_TRUE(node.box.contains(zero));
    if (node.level >= 24) return 0;
    for (int i = 0; i < 2; ++i) {
      const double s = (zero[i] - node.box.center()[i]) / (0.5 * node.box.width(i));
      node.part.lo[i] = std::max(-1.0, s - 0.01);
      node.part.hi[i] = std::min(1.0, s + 0.01);
    }
    return wider_axis(node.box);
  });
  expect_tiles(root, tokens);
  const auto kept = leaves(root, tokens, 0);
  ASSERT_FALSE(kept.empty());
  for (const Box<2>& box : kept) EXPECT_TRUE(box.contains(zero));
}

/// Boxes lie across the borders of the tiles of a tree where they are not halves of the same box.
TEST(PlaneSubdivision, TilesHoldOnAllBoxes) {
  const FilteredFunction<2> f(written::polynomial<2>("x^20 + y^18 - (x + y/3)^17 + x*y - 1/9"));
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  const Box<2> root{{-0.65625, -0.59375}, {0.53125, 0.9375}};
  const SubdivisionLimits limits;
  const std::vector<Line> none;
  PlaneSubdivision<1> subdivision({&tiled}, root, none, limits, kernel);
  int nets = 0;
  subdivision.run([&](const Node& node) {
    ++nets;
    for (int i = 0; i < 2; ++i)
      for (const double end : {node.box.lo[i], node.box.hi[i]})
        EXPECT_LE(std::fabs(end - node.tile[0]->center[i]), node.tile[0]->half[i] * Tile::kReach);
    return node.level < 8 ? wider_axis(node.box) : cover::kExcluded;
  });
  EXPECT_GT(nets, 100);
}

TEST(PlaneSubdivision, LeavesOfABegunSubdivisionAreSubdivided) {
  const FilteredFunction<2> f(written::polynomial<2>("x - 1/3")),
      g(written::polynomial<2>("y + 1/7"));
  Kernel kernel;
  const Box<2> root{{-1, -1}, {1, 1}}, left{{-1, -1}, {0, 1}}, high{{0, 0}, {1, 1}},
      low{{0, -1}, {1, 0}};
  TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
  Sought<2> sought;
  sought.root = root;
  // The zero is at (1/3, -1/7): in the last quarter.
  sought.tokens = {cover::kSplitX, cover::kExcluded, cover::kSplitY, Sought<2>::kLeaf,
                   Sought<2>::kLeaf};
  sought.leaves = {{low, {&of_f, &of_g}}, {high, {&of_f, &of_g}}};
  const auto result = isolate_roots(sought, {}, SubdivisionLimits{}, kernel);
  EXPECT_EQ(result.root_box, root);
  expect_tiles(root, result.tokens);
  ASSERT_EQ(result.roots.size(), 1u);
  EXPECT_TRUE(low.contains(result.roots[0]));
  EXPECT_EQ(leaves(root, result.tokens, cover::kExcluded)[0], left);
  EXPECT_LT(result.boxes, 10);
  // Without that leaf it is not found.
  sought.tokens = {cover::kSplitX, cover::kExcluded, cover::kSplitY, cover::kExcluded,
                   Sought<2>::kLeaf};
  sought.leaves.erase(sought.leaves.begin());
  EXPECT_TRUE(isolate_roots(sought, {}, SubdivisionLimits{}, kernel).roots.empty());
}

/// Zeros at points that are no doubles, far from the origin: the boxes are some doubles wide, the
/// centres of the last ones are no doubles, and what is excluded must still be free of the zero.
TEST(PlaneSubdivision, ZerosBetweenDoublesAreNotLost) {
  for (int e = 8; e <= 50; e += 3) {
    const Rational far(std::ldexp(1.0, e));
    const RationalPoint<2> zero{far + Rational(1, 3), far + Rational(2, 7)};
    const auto offset = [&](int i) {
      return Polynomial<2>::variable(i) + Polynomial<2>::constant(-zero[i]);
    };
    const Polynomial<2> u = offset(0), v = offset(1);
    // They touch there, so that no box of the zero can be settled.
    const FilteredFunction<2> f(v + Polynomial<2>::constant(Rational(-1)) * u * u), g(v + u * u);
    const System<2> system{&f, &g};
    const double at = std::ldexp(1.0, e);
    Kernel kernel;
    const auto result = isolate_roots<2>(system, {{at - 1, at - 2}, {at + 1, at + 1}}, {},
                                         SubdivisionLimits{}, kernel);
    expect_tiles(result.root_box, result.tokens);
    for (const Box<2>& leaf : leaves(result.root_box, result.tokens, cover::kExcluded))
      EXPECT_FALSE(Rational(leaf.lo[0]) <= zero[0] && zero[0] <= Rational(leaf.hi[0]) &&
                   Rational(leaf.lo[1]) <= zero[1] && zero[1] <= Rational(leaf.hi[1]))
          << e;
    EXPECT_FALSE(result.unresolved.empty());
    EXPECT_TRUE(result.roots.empty());
  }
}

TEST(PlaneSubdivision, DegreesZeroOneAndSixtyAreSubdivided) {
  Kernel kernel;
  const Box<2> box{{-1, -1}, {1, 1}};
  const FilteredFunction<2> constant(written::polynomial<2>("3")),
      line(written::polynomial<2>("x - y/3 + 1/10")),
      high(written::polynomial<2>("x^60 + y^60 - (x + y)^7 + 1/9"));
  const auto roots = [&](const FilteredFunction<2>& f, const FilteredFunction<2>& g) {
    const auto result = isolate_roots<2>(System<2>{&f, &g}, box, {}, SubdivisionLimits{}, kernel);
    expect_tiles(result.root_box, result.tokens);
    EXPECT_TRUE(result.unresolved.empty());
    return result.roots;
  };
  EXPECT_TRUE(roots(constant, line).empty());
  const FilteredFunction<2> other(written::polynomial<2>("x + y/2 - 1/5"));
  ASSERT_EQ(roots(line, other).size(), 1u);
  EXPECT_FALSE(roots(line, high).empty());
}

}  // namespace
}  // namespace encase
