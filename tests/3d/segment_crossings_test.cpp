// SPDX-License-Identifier: MIT
#include "3d/segment_crossings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "written.hpp"

namespace encase {
namespace {

std::optional<std::vector<int>> changes(const std::vector<std::string>& texts,
                                        const RationalPoint<3>& from, const RationalPoint<3>& to) {
  std::vector<Function<3>> functions;
  for (const std::string& text : texts) functions.emplace_back(written::polynomial<3>(text));
  std::vector<const Function<3>*> pointers;
  for (const Function<3>& f : functions) pointers.push_back(&f);
  return sign_changes(pointers, from, to);
}

using Order = std::vector<int>;

TEST(SegmentCrossings, AreInOrder) {
  // x^2 = 2 at x = 1.41421356..., x = 1.4142135 just before and 1.4142136 just behind it.
  const std::vector<std::string> near{"x^2-2", "10000000*x-14142135", "10000000*x-14142136"};
  EXPECT_EQ(changes(near, {0, 0, 0}, {3, 1, 2}), (Order{1, 0, 2}));
  EXPECT_EQ(changes(near, {3, 1, 2}, {0, 0, 0}), (Order{2, 0, 1}));
  EXPECT_EQ(changes(near, {-3, 0, 0}, {3, 1, 2}), (Order{0, 1, 0, 2}));
  EXPECT_EQ(changes(near, {0, 0, 0}, {1, 1, 1}), Order{});
}

TEST(SegmentCrossings, OfTouchedSurfacesAreNone) {
  EXPECT_EQ(changes({"x^2-2*x+1", "y-x-1/2"}, {0, 2, 0}, {3, 2, 0}), Order{1});
  // Of odd order they are one.
  EXPECT_EQ(changes({"(x-1)^3"}, {0, 0, 0}, {3, 0, 0}), Order{0});
}

TEST(SegmentCrossings, AtTheSamePlaceAreNotTold) {
  EXPECT_EQ(changes({"x-1", "x+y-1"}, {0, 0, 0}, {3, 0, 0}), std::nullopt);
  EXPECT_EQ(changes({"(x-1)^2", "x+y-1"}, {0, 0, 0}, {3, 0, 0}), std::nullopt);
  EXPECT_EQ(changes({"x-1"}, {1, 0, 0}, {3, 0, 0}), std::nullopt);
  EXPECT_EQ(changes({"x-1"}, {0, 0, 0}, {1, 0, 0}), std::nullopt);
}

}  // namespace
}  // namespace encase
