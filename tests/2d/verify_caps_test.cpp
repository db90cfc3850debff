// SPDX-License-Identifier: MIT
//
// The checker of CAPS results accepts what CAPS answers and objects to every change of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "encase/caps.hpp"
#include "encase/curves_file.hpp"
#include "encased.hpp"
#include "objections.hpp"

namespace encase {
namespace {

using Kind = CapsVertex::Kind;

CapsResult run(const std::vector<std::string>& texts, double epsilon = 1e-3,
               bool self_crossings = true, const CapsOptions& more = {}) {
  std::vector<NamedCurve> curves;
  for (const std::string& text : texts)
    curves.push_back({"c" + std::to_string(curves.size()), parse_function(text).value()});
  CapsOptions options = more;
  options.epsilon = epsilon;
  options.self_crossings = self_crossings;
  return caps(curves, encased::rectangle(-3, 4, -3, 3), options).value();
}

void expect_accepted(const CapsResult& result) {
  const Verification verification = verify(result);
  EXPECT_TRUE(verification.ok()) << text(verification);
  EXPECT_GT(verification.claims, static_cast<std::int64_t>(result.leaves.size()));
}

void expect_objection(CapsResult result, const std::function<void(CapsResult&)>& mutate,
                      const std::string& reason) {
  mutate(result);
  const Verification verification = verify(result);
  EXPECT_FALSE(verification.ok()) << "expected: " << reason;
  EXPECT_NE(text(verification).find(reason), std::string::npos)
      << "expected: " << reason << "\ngot: " << text(verification);
}

/// A circle, a wave and a line: three crossings of the circle with others, one loop alone.
CapsResult exact() {
  return run({"x^2 + y^2 - 2", "y - sin(2x)/2", "x - 1/7", "(x - 3)^2 + (y - 2)^2 - 1/9"});
}
/// Touching circles, a node, three lines through a point.
CapsResult weak() {
  return run({"x^2 + y^2 - 1", "(x - 2)^2 + y^2 - 1", "y^2 - (x + 1)^2 (x + 2)", "y - x/2 - 2",
              "y + x/3 - 2", "y - 2 - 3x"});
}

template <class List, class Predicate>
std::size_t first(const List& list, Predicate holds) {
  const auto found = std::find_if(list.begin(), list.end(), holds);
  EXPECT_NE(found, list.end());
  return static_cast<std::size_t>(found - list.begin());
}
CapsLeaf& leaf_with(CapsResult& r, CapsLabel label) {
  return r.leaves[first(r.leaves, [&](const auto& leaf) { return leaf.label == label; })];
}
CapsVertex& vertex_of(CapsResult& r, Kind kind) {
  return r.vertices[first(r.vertices, [&](const auto& vertex) { return vertex.kind == kind; })];
}

TEST(VerifyCaps, AcceptsAnswers) {
  const CapsResult strict = exact();
  EXPECT_EQ(strict.answer, CapsClass::Exact);
  expect_accepted(strict);
  const CapsResult open = weak();
  EXPECT_EQ(open.answer, CapsClass::DeltaWeak);
  expect_accepted(open);
  for (const bool self_crossings : {false, true})
    for (const double epsilon : {0.3, 1e-2, 1e-5})
      for (const auto& texts : std::vector<std::vector<std::string>>{
               {"x^2 + y^2 - 1"},
               {"y^2 - x^2 (x + 1)", "x^2 + y^2 - 2"},
               {"y - 1/x", "x y - 1/2", "log(x + 1) - y"},
               {"y - sin(3 x)", "x^2 + y^2 - 4", "exp(x) + y - 2"},
               {"y - x", "y + x", "x^2 + y^2 - 4", "x", "y - 1"},
               {"abs(x) + abs(y) - 1", "y - x/3"},
               {"sin(1/x) - y"},
               {"(x - y)^2", "x + y - 1"}}) {
        CapsOptions options;
        options.max_boxes = 20000;
        options.polylines = epsilon != 1e-2;
        expect_accepted(run(texts, epsilon, self_crossings, options));
      }
}

TEST(VerifyCaps, AcceptsTheScenesOfThePaper) {
  for (const std::string name : {"lines", "algebraic", "degenerate_lines", "trigonometric"}) {
    SCOPED_TRACE(name);
    const CurvesFile file =
        load_curves(std::string(ENCASE_TEST_DATA) + "/caps/" + name + ".curves").value();
    CapsOptions options;
    options.self_crossings = true;
    expect_accepted(caps(file.curves, *file.region, options).value());
  }
}

TEST(VerifyCaps, AcceptsWhatIsUndecided) {
  const std::vector<std::string> texts{"x^2 + y^2 - 2", "y - sin(9x)/2"};
  for (const int boxes : {1, 60, 500}) {
    CapsOptions options;
    options.max_boxes = boxes;
    const CapsResult result = run(texts, 1e-6, true, options);
    EXPECT_EQ(result.answer, CapsClass::Undecided);
    expect_accepted(result);
  }
}

TEST(VerifyCaps, OfACancelledGraphWhatIsCalledProvedFollows) {
  int calls = 0;
  CapsOptions options;
  options.progress = [&](const char* stage, double) {
    return std::string(stage) == "subdividing" || ++calls < 2;
  };
  const CapsResult cancelled = run({"x^2 + y^2 - 2", "y - sin(9x)/2"}, 1e-6, true, options);
  EXPECT_EQ(cancelled.answer, CapsClass::Undecided);
  expect_accepted(cancelled);
  const auto proved = [](const CapsEdge& edge) { return edge.proved; };
  EXPECT_TRUE(std::any_of(cancelled.edges.begin(), cancelled.edges.end(), proved));
  expect_objection(
      cancelled, [&](auto& r) { r.edges[first(r.edges, std::not_fn(proved))].proved = true; },
      "does not follow");
}

TEST(VerifyCaps, ObjectsToOtherCurves) {
  expect_objection(
      exact(), [](auto& r) { r.curves[0].function = parse_function("x^2 + y^2 - 2.1").value(); },
      "is not proved absent from leaf");
  expect_objection(
      exact(), [](auto& r) { r.curves[3].function = parse_function("x - 30").value(); },
      "is not proved to have a point in leaf");
  expect_objection(
      exact(), [](auto& r) { r.curves[3].function = Polynomial<2>::constant(2); }, "is a constant");
  expect_objection(
      exact(), [](auto& r) { r.curves.pop_back(); }, "The sets of curves");
}

TEST(VerifyCaps, ObjectsToAnotherQuadtree) {
  expect_objection(
      exact(), [](auto& r) { r.tokens.pop_back(), --r.nodes; }, "not those of the quadtree");
  expect_objection(
      exact(), [](auto& r) { r.tokens.push_back(0), ++r.nodes; }, "not those of the quadtree");
  expect_objection(
      exact(), [](auto& r) { std::swap(r.tokens[1], r.tokens.back()); }, "the quadtree");
  expect_objection(
      exact(), [](auto& r) { r.leaves[7].box.hi[0] += 0x1p-20; }, "the quadtree");
  expect_objection(
      exact(), [](auto& r) { ++r.leaves[7].depth; }, "the quadtree");
  expect_objection(
      exact(), [](auto& r) { ++r.nodes; }, "the quadtree");
  expect_objection(
      exact(), [](auto& r) { r.box.hi[1] = r.box.lo[1]; }, "has no area");
}

TEST(VerifyCaps, ObjectsToOtherLabels) {
  const auto relabel = [](CapsLabel from, CapsLabel to) {
    return [=](CapsResult& r) { leaf_with(r, from).label = to; };
  };
  const std::string unfit = "does not fit its curves or its size";
  expect_objection(exact(), relabel(CapsLabel::Empty, CapsLabel::OneCurve), unfit);
  expect_objection(exact(), relabel(CapsLabel::OneCurve, CapsLabel::Empty), unfit);
  expect_objection(exact(), relabel(CapsLabel::OneCurve, CapsLabel::Several), unfit);
  expect_objection(exact(), relabel(CapsLabel::Several, CapsLabel::OneCurve), unfit);
  expect_objection(exact(), relabel(CapsLabel::Several, CapsLabel::Indeterminate), "Region");
  expect_objection(
      exact(), [](auto& r) { r.epsilon /= 8, r.delta /= 8; }, unfit);
  expect_objection(
      exact(), [](auto& r) { r.delta *= 2; }, "delta");
  expect_objection(
      exact(), [](auto& r) { leaf_with(r, CapsLabel::OneCurve).curves = 0; }, "not proved absent");
  expect_objection(
      exact(),
      [](auto& r) {
        CapsLeaf& leaf = leaf_with(r, CapsLabel::OneCurve);
        leaf.curves = 0, leaf.label = CapsLabel::Empty;
      },
      "not proved absent");
  // The only curve in a leaf of the double line is not proved to change its sign.
  expect_objection(run({"(x - y)^2"}, 0.1), relabel(CapsLabel::Indeterminate, CapsLabel::OneCurve),
                   "is not proved to have a point");
  expect_objection(
      weak(),
      [](auto& r) {
        r.leaves[first(r.leaves, [&](const auto& leaf) {
           return leaf.graph_axis < 0 && leaf.label == CapsLabel::OneCurve;
         })].graph_axis = 0;
      },
      "is not proved to be a graph");
}

TEST(VerifyCaps, ObjectsToOtherRegions) {
  expect_objection(
      exact(), [](auto& r) { r.leaves[5].region = (r.leaves[5].region + 1) % 4; }, "region");
  expect_objection(
      exact(), [](auto& r) { r.regions[3].box.lo[0] -= 0x1p-30; }, "is not what its leaves");
  expect_objection(
      exact(), [](auto& r) { r.regions[3].neighbours.pop_back(); }, "is not what its leaves");
  expect_objection(
      exact(), [](auto& r) { ++r.regions[3].leaves; }, "is not what its leaves");
  expect_objection(
      weak(),
      [](auto& r) {
        r.regions[first(r.regions, [](const auto& region) { return region.singular; })].singular =
            false;
      },
      "is not what its leaves");
  expect_objection(
      exact(),
      [](auto& r) {
        CapsLeaf& leaf = r.leaves[first(r.leaves, [&](const auto& other) {
          return other.label == CapsLabel::Empty && r.regions[other.region].leaves > 1;
        })];
        r.regions.push_back(r.regions[leaf.region]);
        leaf.region = static_cast<int>(r.regions.size()) - 1;
      },
      "parts of larger ones");
  expect_objection(
      exact(), [](auto& r) { r.regions.push_back(r.regions.back()); }, "is not what its leaves");
}

TEST(VerifyCaps, ObjectsToOtherVertices) {
  const auto rename = [](Kind from, Kind to) {
    return [=](CapsResult& r) { vertex_of(r, from).kind = to; };
  };
  expect_objection(weak(), rename(Kind::Even, Kind::Crossing), "is not proved to be one crossing");
  expect_objection(weak(), rename(Kind::Several, Kind::Crossing), "is not proved to be one");
  expect_objection(weak(), rename(Kind::SelfCrossing, Kind::Crossing), "is not proved to be one");
  expect_objection(weak(), rename(Kind::Even, Kind::Odd), "is not what it is called");
  expect_objection(weak(), rename(Kind::Even, Kind::Several), "is not what it is called");
  expect_objection(weak(), rename(Kind::Several, Kind::Even), "is not what it is called");
  expect_objection(exact(), rename(Kind::Crossing, Kind::Even), "is not what it is called");
  expect_objection(exact(), rename(Kind::Crossing, Kind::Odd), "obstacles");
  for (const Kind kind : {Kind::Crossing, Kind::Boundary}) {
    const auto change = [&](const std::function<void(CapsVertex&)>& how) {
      return [=](CapsResult& r) { how(vertex_of(r, kind)); };
    };
    const std::string reason =
        kind == Kind::Boundary ? "leaves the box" : "is not that of its region";
    expect_objection(exact(), change([](auto& v) { v.box.lo[0] -= 0x1p-40; }), reason);
    expect_objection(exact(), change([](auto& v) { v.curves[0] = v.curves[0] == 2 ? 1 : 2; }),
                     reason);
    expect_objection(
        exact(),
        [&](auto& r) {
          // The last one, so that edges keep their vertices.
          while (r.vertices.back().kind != kind)
            std::rotate(r.vertices.begin(), r.vertices.begin() + 1, r.vertices.end());
          r.vertices.pop_back();
          for (CapsEdge& edge : r.edges)
            std::erase(edge.vertices, static_cast<int>(r.vertices.size()));
        },
        kind == Kind::Boundary ? "leaves the box" : "is not either a vertex");
  }
  expect_objection(
      exact(),
      [](auto& r) {
        const CapsVertex& crossing = vertex_of(r, Kind::Crossing);
        r.regions[static_cast<std::size_t>(crossing.region)].apart = true;
      },
      "is not either a vertex");
  expect_objection(
      exact(), [](auto& r) { r.vertices.push_back(vertex_of(r, Kind::Boundary)); }, "there twice");
  expect_objection(
      exact(), [](auto& r) { r.vertices[0].curves.push_back(77); }, "cannot be");
}

TEST(VerifyCaps, ObjectsToOtherEdges) {
  const std::string strange = "does not follow from the leaves";
  const auto mutate_each = [&](const CapsResult& result) {
    for (std::size_t k = 0; k < result.edges.size(); ++k) {
      SCOPED_TRACE(k);
      const auto change = [&](const std::function<void(CapsEdge&)>& how) {
        return [=](CapsResult& r) { how(r.edges[k]); };
      };
      expect_objection(
          result, [=](auto& r) { r.edges.erase(r.edges.begin() + static_cast<int>(k)); },
          "is missing");
      expect_objection(
          result, [=](auto& r) { r.edges.push_back(r.edges[k]); }, strange);
      expect_objection(result, change([](auto& e) { e.proved = !e.proved; }), strange);
      expect_objection(result, change([](auto& e) { e.curve = e.curve == 1 ? 0 : 1; }), strange);
      expect_objection(result, change([](auto& e) {
                         e.vertices.push_back(e.vertices.empty() ? 0 : e.vertices.back());
                       }),
                       strange);
      if (!result.edges[k].proved) continue;
      expect_objection(result,
                       change([](auto& e) { e.polyline[e.polyline.size() / 2][0] += 0x1p-40; }),
                       strange);
      expect_objection(result, change([](auto& e) { e.polyline.erase(e.polyline.begin() + 1); }),
                       strange);
    }
  };
  mutate_each(exact());
  mutate_each(weak());
}

TEST(VerifyCaps, EdgesMayBeWrittenFromEitherEndAndLoopsFromAnyPoint) {
  CapsResult r = exact();
  int loops = 0;
  for (CapsEdge& edge : r.edges) {
    std::reverse(edge.polyline.begin(), edge.polyline.end());
    if (!edge.vertices.empty()) continue;
    ++loops;
    edge.polyline.pop_back();
    std::rotate(edge.polyline.begin(), edge.polyline.begin() + 3, edge.polyline.end());
    edge.polyline.push_back(edge.polyline.front());
  }
  EXPECT_EQ(loops, 1);
  std::reverse(r.edges.begin(), r.edges.end());
  expect_accepted(r);
}

TEST(VerifyCaps, ObjectsToABetterAnswer) {
  expect_objection(
      weak(), [](auto& r) { r.answer = CapsClass::Exact; }, "The answer is not what");
  expect_objection(
      weak(),
      [](auto& r) {
        r.answer = CapsClass::Exact;
        r.obstacles = {};
      },
      "The obstacles are not those");
  expect_objection(
      exact(), [](auto& r) { r.answer = CapsClass::DeltaWeak; }, "The answer is not what");
  expect_objection(
      exact(), [](auto& r) { r.obstacles.open_edges = 1; }, "The obstacles are not those");
}

}  // namespace
}  // namespace encase
