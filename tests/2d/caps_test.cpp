// SPDX-License-Identifier: MIT
#include "encase/caps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "2d/curve_bounds.hpp"
#include "common/expression_program.hpp"
#include "encase/curves_file.hpp"
#include "encased.hpp"

namespace encase {
namespace {

using Kind = CapsVertex::Kind;

std::vector<NamedCurve> written_curves(const std::vector<std::string>& texts) {
  std::vector<NamedCurve> curves;
  for (const std::string& text : texts)
    curves.push_back({"c" + std::to_string(curves.size()), parse_function(text).value()});
  return curves;
}

CapsResult run(const std::vector<std::string>& texts, double epsilon = 1e-6,
               bool self_crossings = true,
               const Region& region = encased::rectangle(-3, 4, -3, 3)) {
  CapsOptions options;
  options.epsilon = epsilon;
  options.self_crossings = self_crossings;
  return caps(written_curves(texts), region, options).value();
}

int count(const CapsResult& result, Kind kind) {
  return static_cast<int>(std::count_if(result.vertices.begin(), result.vertices.end(),
                                        [&](const auto& v) { return v.kind == kind; }));
}
int count(const CapsResult& result, CapsLabel label) {
  return static_cast<int>(std::count_if(result.leaves.begin(), result.leaves.end(),
                                        [&](const auto& leaf) { return leaf.label == label; }));
}
const std::vector<int>& curves_of(const CapsResult& result, const CapsLeaf& leaf) {
  return result.curve_sets[leaf.curves];
}

/// The leaves tile the box: their areas add up, the tokens lead to them, and each has its depth.
void expect_quadtree(const CapsResult& r) {
  struct Node {
    Box<2> box;
    int depth;
  };
  std::vector<Node> stack{{r.box, 0}};
  std::size_t leaves = 0;
  for (const int token : r.tokens) {
    ASSERT_FALSE(stack.empty());
    const auto [box, depth] = stack.back();
    stack.pop_back();
    if (token >= 0) {
      const CapsLeaf& leaf = r.leaves[token];
      EXPECT_EQ(leaf.box, box);
      EXPECT_EQ(leaf.depth, depth);
      ++leaves;
      continue;
    }
    for (int k = 3; k >= 0; --k) {
      Box<2> part = box;
      for (int i = 0; i < 2; ++i) {
        const double cut = box.lo[i] + kCapsCut[i] * (box.hi[i] - box.lo[i]);
        ((i == 0 ? k / 2 : k % 2) ? part.lo : part.hi)[i] = cut;
      }
      stack.push_back({part, depth + 1});
    }
  }
  EXPECT_TRUE(stack.empty());
  EXPECT_EQ(leaves, r.leaves.size());
  EXPECT_EQ(static_cast<std::int64_t>(r.tokens.size()), r.nodes);
}

/// A curve that is not in a leaf's list has a sign at random points of the leaf, by MPFR at 200
/// bits, and always the same; a curve of a proved leaf has both.
void expect_labels(const CapsResult& r, int points) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<ExpressionProgram<2>> programs;
  for (const NamedCurve& curve : r.curves)
    programs.emplace_back(curve.function.is_polynomial() ? Expression(curve.function.polynomial())
                                                         : curve.function.expression());
  ExpressionProgram<2>::Workspace<MpfrInterval> workspace;
  for (const CapsLeaf& leaf : r.leaves)
    for (std::size_t c = 0; c < programs.size(); ++c) {
      const std::vector<int>& here = curves_of(r, leaf);
      if (std::binary_search(here.begin(), here.end(), static_cast<int>(c))) continue;
      std::optional<Sign> sign;
      for (int k = 0; k < points; ++k) {
        Point<2> p;
        for (int i = 0; i < 2; ++i)
          p[i] = k < 4 ? ((k >> i) % 2 ? leaf.box.lo : leaf.box.hi)[i]
                       : leaf.box.lo[i] + part(generator) * leaf.box.width(i);
        const auto at = programs[c].value(intervals(Box<2>{p, p}, 200), workspace);
        if (!at.continuous()) continue;
        const std::optional<Sign> now = at.range().sign();
        ASSERT_TRUE(now && *now != Sign::Zero) << r.curves[c].name << " in an empty leaf";
        ASSERT_TRUE(!sign || *sign == *now) << r.curves[c].name;
        sign = now;
      }
    }
}

TEST(Caps, LabelsAreRightAtSampledPoints) {
  for (const auto& texts :
       std::vector<std::vector<std::string>>{{"x^2 + y^2 - 4", "y - x^3 + x - 1/7"},
                                             {"y - sin(3 x)", "x^2 + y^2 - 4", "exp(x) + y - 2"},
                                             {"y - 1/x", "x y - 1/2", "log(x + 1) - y"}}) {
    const CapsResult result = run(texts, 1e-4, false);
    expect_quadtree(result);
    expect_labels(result, 8);
  }
}

TEST(Caps, FindsTheCrossingsOfLines) {
  const CapsResult result = run({"x - 2y", "x + 3y - 2", "y - 1"}, 1e-6, false);
  EXPECT_EQ(result.answer, CapsClass::Exact);
  EXPECT_EQ(count(result, Kind::Crossing), 3);
  EXPECT_EQ(count(result, Kind::Boundary), 6);
  EXPECT_EQ(result.edges.size(), 9U);
  const auto at = [&](double x, double y) {
    return std::any_of(result.vertices.begin(), result.vertices.end(), [&](const CapsVertex& v) {
      return v.kind == Kind::Crossing && v.box.contains(Point<2>{x, y}) &&
             v.box.largest_width() < 1e-5;
    });
  };
  EXPECT_TRUE(at(0.8, 0.4) && at(2, 1) && at(-1, 1));
}

TEST(Caps, SymmetricCurvesAreInGeneralPosition) {
  const CapsResult result = run({"y - x", "y + x", "x^2 + y^2 - 4", "x", "y - 1"}, 1e-6, true,
                                encased::rectangle(-4, 4, -3, 3));
  EXPECT_GE(count(result, Kind::Several), 1);
  EXPECT_EQ(count(result, Kind::Crossing), 11);
  EXPECT_EQ(result.obstacles.open_vertices, count(result, Kind::Several));
  EXPECT_EQ(result.obstacles.open_edges, 0);
}

TEST(Caps, TouchingCirclesAreInContact) {
  const CapsResult result = run({"x^2 + y^2 - 1", "(x - 2)^2 + y^2 - 1"});
  EXPECT_EQ(result.answer, CapsClass::DeltaWeak);
  EXPECT_EQ(result.delta, 2e-6);
  EXPECT_EQ(count(result, Kind::Crossing), 0);
  EXPECT_EQ(count(result, Kind::Even), 1);
  EXPECT_EQ(result.obstacles.open_vertices, 1);
}

TEST(Caps, TwoCrossingsWithinEpsilonAreAnEvenMeeting) {
  // They cross at x = -0.01 and 0.01.
  const std::vector<std::string> texts{"y - x^2", "y - 1/10000"};
  const CapsResult coarse = run(texts, 1e-2);
  EXPECT_EQ(coarse.answer, CapsClass::DeltaWeak);
  EXPECT_EQ(count(coarse, Kind::Even), 1);
  const CapsResult fine = run(texts, 1e-6);
  EXPECT_EQ(fine.answer, CapsClass::Exact);
  EXPECT_EQ(count(fine, Kind::Crossing), 2);
}

TEST(Caps, AnOddMeetingInOneBoxIsNotCalledACrossing) {
  // y = x^3 meets y = 0 three times in one point.
  const CapsResult result = run({"y - x^3", "y"}, 1e-3);
  EXPECT_EQ(result.answer, CapsClass::DeltaWeak);
  EXPECT_EQ(count(result, Kind::Odd), 1);
  EXPECT_EQ(count(result, Kind::Crossing), 0);
}

TEST(Caps, ParallelLinesNearerThanEpsilonAreNotToldApart) {
  const CapsResult near = run({"y - x/3", "y - x/3 - 1/100000"}, 1e-3);
  EXPECT_EQ(near.answer, CapsClass::DeltaWeak);
  EXPECT_EQ(count(near, Kind::Crossing), 0);
  EXPECT_GT(count(near, CapsLabel::Several), 5000);
  const CapsResult apart = run({"y - x/3", "y - x/3 - 1/10"}, 1e-3);
  EXPECT_EQ(apart.answer, CapsClass::Exact);
  EXPECT_EQ(apart.edges.size(), 2U);
}

TEST(Caps, ConcurrentLinesAreOneVertexOfSeveralCurves) {
  const CapsResult result = run({"y - x", "y - 2x", "y + x/3"});
  EXPECT_EQ(result.answer, CapsClass::DeltaWeak);
  EXPECT_GE(count(result, Kind::Several), 1);
  EXPECT_EQ(count(result, Kind::Crossing), 0);
}

TEST(Caps, AVertexOfACurveWithItselfIsFoundIfAskedFor) {
  const std::vector<std::string> node{"y^2 - x^2 (x + 1)"};
  const CapsResult asked = run(node, 1e-4, true);
  EXPECT_EQ(asked.answer, CapsClass::DeltaWeak);
  ASSERT_EQ(count(asked, Kind::SelfCrossing), 1);
  for (const CapsVertex& v : asked.vertices)
    EXPECT_TRUE(v.kind != Kind::SelfCrossing || v.box.contains(Point<2>{0, 0}));
  EXPECT_EQ(asked.edges.size(), 3U);  // the loop and two arcs to the boundary
  const CapsResult not_asked = run(node, 1e-4, false);
  EXPECT_EQ(count(not_asked, Kind::SelfCrossing), 0);
  EXPECT_EQ(not_asked.answer, CapsClass::DeltaWeak);
  EXPECT_GT(not_asked.obstacles.unexamined_leaves, 0);
  EXPECT_LT(not_asked.nodes, asked.nodes);
}

TEST(Caps, ALoopWithoutVerticesIsAnEdge) {
  const CapsResult result = run({"x^2 + y^2 - 1"});
  EXPECT_EQ(result.answer, CapsClass::Exact);
  EXPECT_TRUE(result.vertices.empty());
  ASSERT_EQ(result.edges.size(), 1U);
  EXPECT_TRUE(result.edges[0].vertices.empty());
  EXPECT_EQ(result.edges[0].polyline.front(), result.edges[0].polyline.back());
}

TEST(Caps, ASignChangeAcrossAPoleIsNoCurve) {
  // 1 / x changes its sign and has no zero.
  const CapsResult result = run({"1/x + y/100"}, 1e-3, false);
  EXPECT_GT(count(result, CapsLabel::Empty) + count(result, CapsLabel::Indeterminate), 0);
  for (const CapsLeaf& leaf : result.leaves)
    if (leaf.label == CapsLabel::OneCurve) ADD_FAILURE() << "1/x + y/100 has no zero here";
}

TEST(Caps, ProvedLeavesHoldTheirCurve) {
  const CapsResult result = run({"y - sin(1/x)"}, 1e-3, true);
  EXPECT_GT(count(result, CapsLabel::OneCurve), 20);
  CurveBounds curve(parse_function("y - sin(1/x)").value());
  for (const CapsLeaf& leaf : result.leaves) {
    if (leaf.label != CapsLabel::OneCurve || leaf.graph_axis < 0) continue;
    EXPECT_EQ(curve.look(leaf.box).sign, std::nullopt);
    EXPECT_TRUE(curve.look(leaf.box).continuous);
  }
}

TEST(Caps, RegionsAreConnectedSetsOfEqualLeaves) {
  const CapsResult r = run({"x^2 + y^2 - 1", "x - y/3"});
  int leaves = 0, empty = 0;
  for (std::size_t k = 0; k < r.regions.size(); ++k) {
    leaves += r.regions[k].leaves;
    empty += r.regions[k].label == CapsLabel::Empty;
    for (const int other : r.regions[k].neighbours) {
      const auto& back = r.regions[other].neighbours;
      EXPECT_TRUE(std::binary_search(back.begin(), back.end(), static_cast<int>(k)));
      EXPECT_NE(r.regions[k].curves, r.regions[other].curves);
    }
  }
  EXPECT_EQ(leaves, static_cast<int>(r.leaves.size()));
  EXPECT_GE(empty, 4);  // the faces
  for (const CapsLeaf& leaf : r.leaves) EXPECT_EQ(r.regions[leaf.region].curves, leaf.curves);
}

TEST(Caps, PolylinesRunThroughLeavesOfTheirCurve) {
  const CapsResult r = run({"x^2 + y^2 - 2", "y - x^2/2"});
  ASSERT_EQ(r.answer, CapsClass::Exact);
  for (const CapsEdge& edge : r.edges) {
    ASSERT_GE(edge.polyline.size(), 2U);
    for (std::size_t k = 1; k < edge.polyline.size(); ++k) {
      const Point<2> a = edge.polyline[k - 1], b = edge.polyline[k];
      const bool shared = std::any_of(r.leaves.begin(), r.leaves.end(), [&](const CapsLeaf& leaf) {
        const auto& here = curves_of(r, leaf);
        return leaf.box.contains(a) && leaf.box.contains(b) &&
               std::binary_search(here.begin(), here.end(), edge.curve);
      });
      const bool at_vertex = std::any_of(edge.vertices.begin(), edge.vertices.end(), [&](int v) {
        return r.vertices[v].box.contains(a) && r.vertices[v].box.contains(b);
      });
      EXPECT_TRUE(shared || at_vertex);
    }
  }
}

TEST(Caps, IsUndecidedWhereABudgetRunsOut) {
  CapsOptions options;
  options.max_boxes = 60;
  const CapsResult few =
      caps(written_curves({"x - y", "x + y - 1"}), encased::square(), options).value();
  EXPECT_EQ(few.answer, CapsClass::Undecided);
  EXPECT_LE(few.nodes, 60);
  EXPECT_GT(few.obstacles.indeterminate_leaves, 0);
  expect_quadtree(few);
  options = {};
  options.epsilon = 1e-9;
  options.progress = [](const char*, double) { return false; };
  const CapsResult cancelled =
      caps(written_curves({"y - x/3", "y - x/3 - 1/1000000000000"}), encased::square(), options)
          .value();
  EXPECT_EQ(cancelled.answer, CapsClass::Undecided);
}

TEST(Caps, RefusesWhatItCannotAnswer) {
  const auto refused = [](const std::vector<std::string>& texts, const Region& region,
                          double epsilon, const std::string& part) {
    CapsOptions options;
    options.epsilon = epsilon;
    const auto result = caps(written_curves(texts), region, options);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, Error::Code::BadInput);
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  };
  const Region square = encased::square();
  refused({}, square, 1e-3, "no curves");
  refused({"x"}, square, 0, "positive");
  refused({"x"}, square, -1, "positive");
  refused({"x"}, square, std::nan(""), "positive");
  refused({"x"}, square, 3, "larger than the region");
  refused({"x"}, whole_plane(), 1e-3, "rectangle");
  refused({"x"}, parse_region("polygon (0,0) (1,0) (0,1)").value(), 1e-3, "rectangle");
  refused({"x - x"}, square, 1e-3, "zero polynomial");
  const auto steep = caps({{"f", Polynomial<2>::variable(0).power(61)}}, square);
  ASSERT_FALSE(steep.ok());
  EXPECT_EQ(steep.error().message, "curve 'f' has degree 61, above the limit of 60");
  const auto in_space = caps({{"f", Function<2>(Expression::variable(2))}}, square);
  ASSERT_FALSE(in_space.ok());
  EXPECT_EQ(in_space.error().message, "curve 'f' is a constant: it has no x and no y");
}

TEST(Caps, OfItsFilesHasTheClassesOfThePaper) {
  const auto load = [](const std::string& name) {
    return load_curves(std::string(ENCASE_TEST_DATA) + "/caps/" + name + ".curves").value();
  };
  const CurvesFile lines = load("lines"), algebraic = load("algebraic");
  CapsOptions options;
  options.self_crossings = true;
  EXPECT_EQ(caps(lines.curves, *lines.region, options).value().answer, CapsClass::Exact);
  EXPECT_EQ(caps(algebraic.curves, *algebraic.region, options).value().answer, CapsClass::Exact);
  const CurvesFile degenerate = load("degenerate_lines");
  const CapsResult result = caps(degenerate.curves, *degenerate.region, options).value();
  EXPECT_EQ(result.answer, CapsClass::DeltaWeak);
  EXPECT_GE(count(result, Kind::Several), 1);
}

}  // namespace
}  // namespace encase
