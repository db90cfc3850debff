// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encase/surface_encasement.hpp"
#include "written.hpp"

namespace encase {
namespace {

const std::string kTorus = "(x^2+y^2+z^2+3)^2-16*(x^2+y^2)";  // radii 2 and 1

Polyhedron cube(Rational half) {
  return make_box({-half, -half, -half}, {half, half, half}).value();
}

SurfaceEncasement encased(const std::vector<std::string>& texts, const Polyhedron& region,
                          const SurfaceOptions& options = {}) {
  std::vector<NamedSurface> surfaces;
  for (const std::string& text : texts)
    surfaces.push_back({"s" + std::to_string(surfaces.size()), written::polynomial<3>(text)});
  return encase(surfaces, region, options).value();
}

SurfaceEncasement random_encasement(int degree, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.count = 3;
  options.seed = seed;
  std::vector<NamedSurface> surfaces;
  for (const auto& f : random_polynomials<3>(options))
    surfaces.push_back({"s" + std::to_string(surfaces.size()), f});
  return encase(surfaces, cube(1)).value();
}

std::string objections(const SurfaceEncasement& e) {
  std::string text;
  for (const std::string& objection : verify(e).objections) text += objection + "\n";
  return text;
}

TEST(VerifySurfaces, CertifiedEncasementsAreProved) {
  const struct {
    std::vector<std::string> surfaces;
    Rational half;
  } scenes[] = {{{"x^2+y^2+z^2-1"}, 2},
                {{"x^2+y^2-1"}, 2},
                {{"x-y+3*z-1"}, 2},
                {{kTorus}, 4},
                {{"x^2+y^2+z^2-1", "(x-1)^2+y^2+z^2-1"}, 3},
                {{"x^2+y^2-1", "4*x^2+4*z^2-1"}, 2},
                {{"x^2+y^2+z^2-1", "x^2+y^2+z^2-2"}, 2},
                {{"x^2+y^2+z^2-1", "(2*x-1)^2+4*y^2+4*z^2-4", "4*x^2+(2*y-1)^2+4*z^2-4"}, 3}};
  for (const auto& scene : scenes) {
    const SurfaceEncasement e = encased(scene.surfaces, cube(scene.half));
    EXPECT_EQ(e.outcome, Outcome::Certified) << scene.surfaces[0];
    EXPECT_EQ(objections(e), "") << scene.surfaces[0];
  }
  for (int degree = 2; degree <= 3; ++degree) {
    const SurfaceEncasement e = random_encasement(degree, 1);
    EXPECT_EQ(e.outcome, Outcome::Certified);
    EXPECT_EQ(objections(e), "");
  }
}

TEST(VerifySurfaces, ObliqueRegionsAreProved) {
  const Polyhedron tetrahedron =
      make_polyhedron({{-1, 0, 0, -1}, {0, -1, 0, -1}, {0, 0, -1, -1}, {1, 1, 1, -1}}).value();
  for (const char* text : {"x^2+y^2+z^2-1/2", "x*y-z-1/7"}) {
    const SurfaceEncasement e = encased({text}, tetrahedron);
    EXPECT_EQ(e.outcome, Outcome::Certified);
    EXPECT_EQ(objections(e), "");
  }
}

TEST(VerifySurfaces, ExpressionsAreProved) {
  const Expression x = Expression::variable(0), y = Expression::variable(1),
                   z = Expression::variable(2);
  const std::vector<NamedSurface> surfaces{{"wave", z - Expression::apply(Operation::Sin, x + y)},
                                           {"plane", written::polynomial<3>("x-y/3+z-1/7")}};
  const SurfaceEncasement e = encase(surfaces, cube(1)).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  EXPECT_EQ(objections(e), "");
}

TEST(VerifySurfaces, DegenerateAndUndecidedEncasementsAreProved) {
  SurfaceOptions options;
  options.max_cells = 300;
  for (const std::vector<std::string>& surfaces : {std::vector<std::string>{"x^2+y^2-z^2"},
                                                   {"x^2-y^2*z"},
                                                   {"(x-1/3)^2*(y+z)"},
                                                   {"x^2+y^2+z^2-1", "(x-2)^2+y^2+z^2-1"}}) {
    const SurfaceEncasement e = encased(surfaces, cube(Rational(5, 2)), options);
    EXPECT_NE(e.outcome, Outcome::Certified) << surfaces[0];
    EXPECT_EQ(objections(e), "") << surfaces[0];
  }
}

/// Something to change, and what it is called.
struct Change {
  const char* name;
  std::function<void(SurfaceEncasement&)> apply;
};

TEST(VerifySurfaces, ChangedFactsAreRefused) {
  const SurfaceEncasement good = random_encasement(3, 2);
  ASSERT_EQ(good.outcome, Outcome::Certified);
  ASSERT_EQ(objections(good), "");
  ASSERT_FALSE(good.triple_points.empty());
  // Cells that have what is to be changed.
  const auto cell_with = [](SurfaceEncasement& e, const auto& has) -> SpaceCell& {
    return *std::find_if(e.cells.begin(), e.cells.end(), has);
  };
  const auto has_arcs = [](const SpaceCell& c) { return !c.arcs.empty(); };
  const auto has_absence = [](const SpaceCell& c) { return !c.absences.empty(); };
  const auto has_patches = [](const SpaceCell& c) { return c.patches.size() > 1; };
  const auto facet_of = [](SurfaceEncasement& e) -> Facet& {
    return *std::find_if(e.facets.begin(), e.facets.end(), [](const Facet& f) {
      return f.surfaces.size() > 1 && !f.encasement.crossings.empty();
    });
  };
  using Kind = PairCertificate::Kind;
  const auto pair_of = [](SurfaceEncasement& e, Kind kind) -> PairCertificate& {
    return *std::find_if(e.pair_certificates.begin(), e.pair_certificates.end(),
                         [&](const PairCertificate& c) { return c.kind == kind; });
  };
  const std::vector<Change> changes{
      {"outcome", [](auto& e) { e.outcome = Outcome::Degenerate; }},
      {"surface", [](auto& e) { std::swap(e.surfaces[0].function, e.surfaces[1].function); }},
      {"surface missing",
       [](auto& e) {
         e.input.push_back({"more", written::polynomial<3>("x")});
       }},
      {"sources", [](auto& e) { e.surfaces[0].sources = {1}; }},
      {"region", [](auto& e) { e.region = cube(2); }},
      {"region used", [](auto& e) { e.region_used = cube(2); }},
      {"corners", [](auto& e) { e.region.corners[0][0] += 1; }},
      {"plane", [](auto& e) { e.planes.back().offset += 0.01; }},
      {"plane's side",
       [](auto& e) {
         e.planes.back().offset = -e.planes.back().offset;
         for (double& n : e.planes.back().normal) n = -n;
       }},
      {"region's plane", [](auto& e) { std::swap(e.planes[0], e.planes[1]); }},
      {"split", [](auto& e) { std::swap(e.history[0].negative, e.history[0].positive); }},
      {"split twice", [](auto& e) { e.history.back().negative = e.history.back().positive; }},
      {"depth", [](auto& e) { ++e.cells[3].depth; }},
      {"cell's box", [](auto& e) { e.cells[3].box.hi[0] -= 0.01; }},
      {"sign",
       [&](auto& e) {
         SpaceCell& c = cell_with(e, has_absence);
         for (Sign& s : c.signs)
           if (s != Sign::Zero) s = -s;
       }},
      {"sign unproved",
       [&](auto& e) {
         SpaceCell& c = cell_with(e, has_arcs);
         *std::find(c.signs.begin(), c.signs.end(), Sign::Zero) = Sign::Positive;
       }},
      {"absence dropped", [&](auto& e) { cell_with(e, has_absence).absences.pop_back(); }},
      {"absence",
       [](auto& e) { e.absence_certificates[0].sign = -e.absence_certificates[0].sign; }},
      {"absence's box",
       [](auto& e) { e.absence_certificates[0].box = e.region_used.bounding_box(); }},
      {"graph",
       [](auto& e) {
         for (double& v : e.graph_certificates[0].direction) v = -v;
       }},
      {"graph's surface",
       [](auto& e) {
         e.graph_certificates[0].surface = (e.graph_certificates[0].surface + 1) % 3;
       }},
      {"graph dropped", [&](auto& e) { cell_with(e, has_patches).graphs.pop_back(); }},
      {"graph of elsewhere",
       [](auto& e) {
         e.graph_certificates[0].box.lo[0] = e.graph_certificates[0].box.hi[0] - 0x1p-20;
       }},
      {"list's direction", [](auto& e) { e.critical_points[0].direction[0] += 0.1; }},
      {"critical point", [](auto& e) { e.critical_points[0].points.pop_back(); }},
      {"critical token",
       [](auto& e) {
         auto& tokens = e.critical_points[0].tokens;
         *std::find(tokens.begin(), tokens.end(), 0) = cover::kExcluded;
       }},
      {"listed near a point",
       [&](auto& e) {
         PairCertificate& c = pair_of(e, Kind::Listed);
         const auto& list = e.critical_points[static_cast<std::size_t>(c.critical)];
         c.box = hull(c.box, list.points.at(0));
       }},
      {"local",
       [&](auto& e) {
         for (double& w : pair_of(e, Kind::Local).direction) w = -w;
       }},
      {"local as apart", [&](auto& e) { pair_of(e, Kind::Local).kind = Kind::Apart; }},
      {"pair dropped", [&](auto& e) { cell_with(e, has_arcs).pairs.pop_back(); }},
      {"triple point's cell",
       [](auto& e) {
         for (TriplePoint& p : e.triple_points)
           if (p.cell >= 0) p.cell = p.cell == 0 ? 1 : 0;
       }},
      {"triple point outside",
       [](auto& e) {
         for (TriplePoint& p : e.triple_points) p.cell = -1;
       }},
      {"triple point's box",
       [](auto& e) {
         e.triple_points[0].box.lo[0] -= 0.1;
         e.triple_points[0].box.hi[0] -= 0.1;
         e.triple_points[0].point[0] -= 0.1;
       }},
      {"triple point missing",
       [](auto& e) {
         auto& tokens = e.triple_point_covers[0].tokens;
         for (int& token : tokens)
           if (token >= 0) token = cover::kExcluded;
       }},
      {"triple points' cover", [](auto& e) { e.triple_point_covers.clear(); }},
      {"facet's cells", [](auto& e) { std::swap(e.facets[9].cells[0], e.facets[9].cells[1]); }},
      {"facet's polygon", [](auto& e) { e.facets[9].polygon.corners[0][0] += Rational(1, 100); }},
      {"facet missing", [](auto& e) { e.facets.pop_back(); }},
      {"facet's surfaces",
       [&](auto& e) {
         Facet& f = facet_of(e);
         f.surfaces.pop_back();
         f.encasement.curves.pop_back();
         f.encasement.input.pop_back();
       }},
      {"facet's crossing", [&](auto& e) { facet_of(e).encasement.crossings.clear(); }},
      {"facet's curve",
       [&](auto& e) {
         auto& curves = facet_of(e).encasement.curves;
         std::swap(curves[0].function, curves[1].function);
       }},
      {"facet's arrangement",
       [&](auto& e) {
         auto& a = facet_of(e).arrangement;
         Arrangement::Face& face = a.faces[a.outside == 0 ? 1 : 0];
         face.signs[0] = -face.signs[0];
       }},
      {"facet's points",
       [&](auto& e) {
         auto& points = facet_of(e).points;
         std::swap(*std::find_if(points.begin(), points.end(), [](int p) { return p >= 0; }),
                   *std::find_if(points.rbegin(), points.rend(), [](int p) { return p >= 0; }));
       }},
      {"facet point", [](auto& e) { e.facet_points[0].point[0] += 0.5; }},
      {"loop", [&](auto& e) { cell_with(e, has_patches).patches[0].loop.pop_back(); }},
      {"loop reversed",
       [&](auto& e) {
         for (FacetEdge& edge : cell_with(e, has_patches).patches[0].loop) edge.half_edge ^= 1;
       }},
      {"patch missing",
       [](auto& e) {
         for (SpaceCell& c : e.cells)
           if (c.arcs.empty() && !c.patches.empty()) {
             c.patches.pop_back();
             return;
           }
       }},
      {"closed sphere", [&](auto& e) { cell_with(e, has_patches).patches[0].loop.clear(); }},
      {"arc reversed",
       [&](auto& e) {
         auto& ends = cell_with(e, has_arcs).arcs[0].ends;
         std::swap(ends[0], ends[1]);
       }},
      {"arc missing", [&](auto& e) { cell_with(e, has_arcs).arcs.pop_back(); }},
      {"arc's patches",
       [&](auto& e) {
         auto& patches = cell_with(e, has_arcs).arcs[0].patches;
         std::swap(patches[0], patches[1]);
       }},
      {"order of triple points",
       [](auto& e) {
         for (SpaceCell& c : e.cells)
           for (SurfaceArc& arc : c.arcs)
             if (!arc.triple_points.empty()) {
               arc.triple_points.pop_back();
               return;
             }
       }},
      {"index", [](auto& e) { e.cells[0].facets.push_back(1 << 20); }},
      {"number", [](auto& e) { e.graph_certificates[0].spread = std::nan(""); }},
  };
  for (const Change& change : changes) {
    SurfaceEncasement bad = good;
    change.apply(bad);
    EXPECT_FALSE(verify(bad).ok()) << change.name;
  }
}

}  // namespace
}  // namespace encase
