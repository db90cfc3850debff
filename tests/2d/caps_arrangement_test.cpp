// SPDX-License-Identifier: MIT
//
// Where both apply, CAPS and the encasement give the same arrangement graph.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encase/arrangement.hpp"
#include "encase/caps.hpp"
#include "encased.hpp"

namespace encase {
namespace {

/// An edge of an arrangement: its curve and the CAPS vertices at its ends, ascending; none (-1) for
/// a loop without vertices.
using EdgeKey = std::tuple<int, int, int>;

/// The edges of the graph by CAPS.
std::vector<EdgeKey> edges_of(const CapsResult& result) {
  std::vector<EdgeKey> edges;
  for (const CapsEdge& edge : result.edges) {
    EXPECT_TRUE(edge.proved);
    if (edge.vertices.empty()) {
      edges.emplace_back(edge.curve, -1, -1);
      continue;
    }
    EXPECT_EQ(edge.vertices.size(), 2U);
    edges.emplace_back(edge.curve, edge.vertices.front(), edge.vertices.back());
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// The vertex of CAPS that is a vertex of the arrangement: its curves meet in its box. -1: none.
int matching_vertex(const CapsResult& result, const Encasement& encasement,
                    const Arrangement::Vertex& vertex) {
  constexpr double kNear = 1e-9;
  std::vector<int> curves;
  Box<2> box{vertex.point, vertex.point};
  if (vertex.kind == Arrangement::Vertex::Kind::Crossing) {
    const Crossing& crossing = encasement.crossings[vertex.index];
    curves = {crossing.curves[0], crossing.curves[1]};
    box = crossing.box;
  } else {
    curves = {encasement.line_crossings[vertex.index].curve};
    for (int i = 0; i < 2; ++i) box.lo[i] -= kNear, box.hi[i] += kNear;
  }
  int found = -1;
  for (std::size_t v = 0; v < result.vertices.size(); ++v) {
    if (result.vertices[v].curves != curves || !result.vertices[v].box.meets(box)) continue;
    EXPECT_EQ(found, -1) << "two vertices at one place";
    found = static_cast<int>(v);
  }
  EXPECT_NE(found, -1) << "no vertex at " << vertex.point[0] << ' ' << vertex.point[1];
  return found;
}

/// The edges of the arrangement, between the vertices of CAPS that theirs are.
std::vector<EdgeKey> edges_of(const CapsResult& result, const Encasement& encasement,
                              const Arrangement& arrangement) {
  std::vector<int> match;
  for (const Arrangement::Vertex& vertex : arrangement.vertices)
    match.push_back(vertex.kind == Arrangement::Vertex::Kind::Corner
                        ? -1
                        : matching_vertex(result, encasement, vertex));
  std::vector<EdgeKey> edges;
  for (std::size_t k = 0; k < arrangement.edges.size(); ++k) {
    const int curve = arrangement.edges[k].curve;
    if (curve < 0) continue;
    const int from = arrangement.half_edges[2 * k].origin,
              to = arrangement.half_edges[2 * k + 1].origin;
    if (from < 0) {
      edges.emplace_back(curve, -1, -1);
      continue;
    }
    edges.emplace_back(curve, std::min(match[from], match[to]), std::max(match[from], match[to]));
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// True if both are certified and agree; false if the encasement is not certified.
bool agree(const std::vector<NamedCurve>& curves, const Region& region) {
  const Encasement encasement = encase(curves, region).value();
  if (encasement.outcome != Outcome::Certified) return false;
  const Arrangement arrangement = arrange(encasement).value();
  CapsOptions options;
  options.epsilon = 1e-7;
  options.self_crossings = true;
  const CapsResult result = caps(curves, region, options).value();
  EXPECT_EQ(result.answer, CapsClass::Exact);
  if (result.answer != CapsClass::Exact) return false;
  const std::size_t inner =
      std::count_if(arrangement.vertices.begin(), arrangement.vertices.end(),
                    [](const auto& v) { return v.kind != Arrangement::Vertex::Kind::Corner; });
  EXPECT_EQ(result.vertices.size(), inner);
  EXPECT_EQ(edges_of(result), edges_of(result, encasement, arrangement));
  return true;
}

TEST(CapsArrangement, IsThatOfTheEncasementOfRandomPolynomials) {
  int compared = 0;
  for (int degree = 1; degree <= 5; ++degree)
    for (int count = 2; count <= 4; ++count)
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        RandomOptions options;
        options.degree = degree;
        options.count = count;
        options.seed = 100 * static_cast<std::uint64_t>(count) + seed;
        SCOPED_TRACE("degree " + std::to_string(degree) + ", curves " + std::to_string(count) +
                     ", seed " + std::to_string(options.seed));
        compared += agree(random_curves(options), encased::square());
      }
  EXPECT_EQ(compared, 5 * 3 * 6);
}

TEST(CapsArrangement, IsThatOfTheEncasementOfDensePolynomials) {
  int compared = 0;
  for (int degree = 2; degree <= 4; ++degree)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      RandomOptions options;
      options.kind = RandomOptions::Kind::Dense;
      options.degree = degree;
      options.count = 3;
      options.seed = seed;
      options.bits = 12;
      SCOPED_TRACE("degree " + std::to_string(degree) + ", seed " + std::to_string(seed));
      compared += agree(random_curves(options), encased::rectangle(-2, 3, -2, 2));
    }
  EXPECT_EQ(compared, 15);
}

TEST(CapsArrangement, HasLoopsWithAndWithoutVertices) {
  EXPECT_TRUE(agree(encased::curves({"x^2+y^2-1/2", "x^2+y^2-1/4", "x-1/7"}), encased::square()));
  EXPECT_TRUE(agree(encased::curves({"(x-1/3)^2+y^2-1/17", "(x+1/3)^2+y^2-1/18", "y^2-3/4-x/9"}),
                    encased::square()));
}

}  // namespace
}  // namespace encase
