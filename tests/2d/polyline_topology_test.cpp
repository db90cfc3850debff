// SPDX-License-Identifier: MIT
#include "2d/polyline_topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "encase/tracing.hpp"
#include "tests/encased.hpp"

namespace encase {
namespace {

using encased::run;

struct Traced {
  Arrangement arrangement;
  EdgePolylines lines;

  std::vector<PieceConflict> meeting() const {
    std::vector<std::vector<char>> all;
    for (const auto& line : lines) all.emplace_back(line.size(), 1);
    return meeting_pieces(arrangement, lines, all);
  }
  std::size_t misplaced() const {
    std::size_t count = 0;
    for (int f = 0; f < static_cast<int>(arrangement.faces.size()); ++f)
      count += misplaced_cycles(arrangement, lines, f).size();
    return count;
  }
  int edge_of(int curve) const {
    for (int k = 0;; ++k)
      if (arrangement.edges[k].curve == curve) return k;
  }
};

Traced traced(const std::vector<std::string>& texts) {
  const Encasement e = run(texts);
  Traced result{arrange(e).value(), {}};
  TraceOptions options;
  options.tolerance = 0.01;
  const Tracing tracing = trace(e, result.arrangement, options).value();
  EXPECT_TRUE(tracing.same_topology);
  for (const TracedEdge& edge : tracing.edges) result.lines.push_back(edge.points);
  EXPECT_TRUE(result.meeting().empty());
  EXPECT_TRUE(misplaced_around_vertices(result.arrangement, result.lines).empty());
  EXPECT_EQ(result.misplaced(), 0u);
  return result;
}

TEST(Orientation, IsExact) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  int zeros = 0;
  for (int n = 0; n < 20000; ++n) {
    const double scale = n % 3 == 0 ? 1e-200 : n % 3 == 1 ? 1 : 1e200;
    Point<2> p = {scale * place(random), scale * place(random)}, q = p, r = p;
    // Nearly on a line, some ulps away, or on one of slope 1.
    const double along = scale * place(random);
    for (int i = 0; i < 2; ++i) {
      q[i] += along;
      r[i] += 0.37 * along;
      if (n % 2 == 0) r[i] = std::nextafter(r[i], place(random) > 0 ? HUGE_VAL : -HUGE_VAL);
    }
    const Rational x(r[0]), y(r[1]);
    const int exact = sgn((Rational(p[0]) - x) * (Rational(q[1]) - y) -
                          (Rational(p[1]) - y) * (Rational(q[0]) - x));
    EXPECT_EQ(static_cast<int>(orientation(p, q, r)), exact);
    zeros += exact == 0;
  }
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {0.5, 0.5}), Sign::Zero);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), Sign::Positive);
  EXPECT_LT(zeros, 20000);
}

TEST(MeetingPieces, AreFound) {
  const Traced good = traced({"x^2 + y^2 - 1/4", "x^2 + y^2 - 1/9", "y - x/3 - 1/10"});
  for (std::size_t e = 0; e < good.lines.size(); ++e)
    for (std::size_t k = 1; k + 1 < good.lines[e].size(); ++k) {
      // Across everything.
      Traced bad = good;
      bad.lines[e][k] = {-3, 2.5};
      EXPECT_FALSE(bad.meeting().empty());
      // Onto its neighbour; back onto the way it came.
      bad = good;
      bad.lines[e][k] = bad.lines[e][k - 1];
      EXPECT_FALSE(bad.meeting().empty());
      if (k + 2 < good.lines[e].size()) {
        bad = good;
        const Point<2>&before = good.lines[e][k - 1], &here = good.lines[e][k];
        if (before[0] == here[0]) continue;
        bad.lines[e][k - 1][1] = here[1];
        bad.lines[e][k + 1] = {0.5 * (before[0] + here[0]), here[1]};
        EXPECT_FALSE(bad.meeting().empty());
      }
    }
  // Two edges on one another.
  Traced bad = good;
  const int circle = good.edge_of(0), other = good.edge_of(1);
  bad.lines[circle] = bad.lines[other];
  EXPECT_FALSE(bad.meeting().empty());
  // A vertex that is touched by what does not end there.
  bad = good;
  bad.lines[circle][bad.lines[circle].size() / 2] = bad.lines[other].front();
  EXPECT_FALSE(bad.meeting().empty());
}

TEST(MeetingPieces, AreLookedForWhereSomethingIsNew) {
  const Traced good = traced({"x^2 + y^2 - 1/4", "x^2 + y^2 - 1/9"});
  Traced bad = good;
  const int circle = good.edge_of(0);
  bad.lines[circle][3] = {0, 0};
  const std::vector<PieceConflict> all = bad.meeting();
  ASSERT_FALSE(all.empty());
  std::vector<std::vector<char>> is_new;
  for (const auto& line : bad.lines) is_new.emplace_back(line.size(), 0);
  EXPECT_TRUE(meeting_pieces(bad.arrangement, bad.lines, is_new).empty());
  is_new[circle][2] = is_new[circle][3] = 1;
  EXPECT_EQ(meeting_pieces(bad.arrangement, bad.lines, is_new), all);
}

TEST(MisplacedAroundVertices, AreFoundInALensTurnedOver) {
  // Two parabolas with a lens between them: its two edges change places.
  Traced t = traced({"y - x^2 + 1/4", "y + x^2 - 1/4"});
  std::vector<int> lens;
  for (int k = 0; k < static_cast<int>(t.lines.size()); ++k) {
    const auto crossing = [&](int h) {
      return t.arrangement.vertices[t.arrangement.half_edges[h].origin].kind ==
             Arrangement::Vertex::Kind::Crossing;
    };
    if (crossing(2 * k) && crossing(2 * k + 1)) lens.push_back(k);
  }
  ASSERT_EQ(lens.size(), 2u);
  std::swap(t.lines[lens[0]], t.lines[lens[1]]);
  for (const int k : lens)
    if (t.lines[k].front() != t.lines[lens[0]].front() ||
        t.arrangement.half_edges[2 * k].origin != t.arrangement.half_edges[2 * lens[0]].origin)
      std::reverse(t.lines[k].begin(), t.lines[k].end());
  if (t.arrangement.half_edges[2 * lens[0]].origin != t.arrangement.half_edges[2 * lens[1]].origin)
    std::reverse(t.lines[lens[0]].begin(), t.lines[lens[0]].end());
  EXPECT_TRUE(t.meeting().empty());
  EXPECT_FALSE(misplaced_around_vertices(t.arrangement, t.lines).empty());
}

TEST(MisplacedCycles, AreFound) {
  const Traced good =
      traced({"x^2 + y^2 - 1/4", "x^2 + y^2 - 1/9", "(x - 3/4)^2 + (y - 3/4)^2 - 1/100"});
  const int large = good.edge_of(0), small = good.edge_of(1), other = good.edge_of(2);
  const auto moved = [](std::vector<Point<2>> line, double x, double y, double scale) {
    for (Point<2>& p : line) p = {scale * p[0] + x, scale * p[1] + y};
    return line;
  };
  Traced bad = good;
  std::reverse(bad.lines[large].begin(), bad.lines[large].end());
  EXPECT_GT(bad.misplaced(), 0u);
  bad = good;
  std::swap(bad.lines[large], bad.lines[small]);
  EXPECT_TRUE(bad.meeting().empty());
  EXPECT_GT(bad.misplaced(), 0u);
  bad = good;  // out of the circle in which it lies
  bad.lines[small] = moved(bad.lines[small], -0.8, -0.8, 0.1);
  EXPECT_TRUE(bad.meeting().empty());
  EXPECT_GT(bad.misplaced(), 0u);
  bad = good;  // into a circle in which it does not lie
  bad.lines[other] = moved(bad.lines[other], -0.02, 0, 0.01);
  EXPECT_TRUE(bad.meeting().empty());
  EXPECT_GT(bad.misplaced(), 0u);
  bad = good;  // out of the region
  bad.lines[other] = moved(bad.lines[other], 5, 5, 1);
  EXPECT_TRUE(bad.meeting().empty());
  EXPECT_GT(bad.misplaced(), 0u);
}

}  // namespace
}  // namespace encase
