// SPDX-License-Identifier: MIT
#include "encase/surface_encasement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "common/random_polynomials.hpp"
#include "surface_topology.hpp"

namespace encase {
namespace {

using topology::cube;
using topology::curve_components;
using topology::CurveComponents;
using topology::euler_characteristic;
using topology::surface;
using topology::triple_points;

/// The encasement of scenes that must be certified, proved again.
SurfaceEncasement certified_scene(const std::vector<NamedSurface>& surfaces,
                                  const Polyhedron& region) {
  auto result = encase(surfaces, region);
  EXPECT_TRUE(result) << result.error().message;
  SurfaceEncasement& e = result.value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  for (const auto* list : {&e.degenerate, &e.undecided})
    for (const UnresolvedInSpace& entry : *list) ADD_FAILURE() << entry.reason;
  const Verification proof = verify(e);
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return std::move(e);
}

SurfaceEncasement certified(const std::vector<std::string>& texts, const Polyhedron& region) {
  std::vector<NamedSurface> surfaces;
  for (const std::string& text : texts)
    surfaces.push_back(surface("s" + std::to_string(surfaces.size()), text));
  return certified_scene(surfaces, region);
}

const std::string kSphere = "x^2+y^2+z^2-1";
const std::string kTorus = "(x^2+y^2+z^2+3)^2-16*(x^2+y^2)";  // radii 2 and 1

TEST(SurfaceEncasement, ASphereInsideIsOneClosedPatch) {
  const SurfaceEncasement e = certified({kSphere}, cube(2));
  ASSERT_EQ(e.cells.size(), 1u);
  ASSERT_EQ(e.cells[0].patches.size(), 1u);
  EXPECT_TRUE(e.cells[0].patches[0].loop.empty());
  EXPECT_EQ(euler_characteristic(e, 0), 2);
}

TEST(SurfaceEncasement, ASphereAcrossTheBoundaryHasACircleForEverySideItCrosses) {
  // A sphere without six caps; without one; and what a corner cuts off.
  EXPECT_EQ(euler_characteristic(certified({kSphere}, cube(Rational(4, 5))), 0), 2 - 6);
  EXPECT_EQ(euler_characteristic(certified({"(x-1)^2+y^2+z^2-1"}, cube(Rational(3, 2))), 0), 2 - 1);
  EXPECT_EQ(euler_characteristic(certified({"(x-1)^2+(y-1)^2+(z-1)^2-1/2"}, cube(1)), 0), 1);
}

TEST(SurfaceEncasement, ATorusHasEulerCharacteristicZero) {
  EXPECT_EQ(euler_characteristic(certified({kTorus}, cube(4)), 0), 0);
}

TEST(SurfaceEncasement, HandlesAreCountedAsOnAGrid) {
  // Each number is that of the surface of sign changes on a grid of tetrahedra, too.
  const std::string two_holes = "(x*(x-1)^2*(x-2)+y^2)^2+z^2-1/100";
  EXPECT_EQ(euler_characteristic(certified({two_holes}, cube(3)), 0), -2);
  EXPECT_EQ(euler_characteristic(certified({two_holes}, cube(2)), 0), -3);  // without an end
  const std::string clebsch = "x^3+y^3+z^3+1-(x+y+z+1)^3";
  EXPECT_EQ(euler_characteristic(certified({clebsch}, cube(5)), 0), -2);
}

TEST(SurfaceEncasement, TwoSpheresMeetInACircle) {
  const SurfaceEncasement e = certified({"x^2+y^2+z^2-13/10", "(x-1)^2+y^2+z^2-1"}, cube(3));
  EXPECT_EQ(curve_components(e, 0, 1), (CurveComponents{0, 1}));
  for (int s = 0; s < 2; ++s) EXPECT_EQ(euler_characteristic(e, s), 2);
}

TEST(SurfaceEncasement, SpheresThatDoNotMeetHaveNoCurve) {
  const SurfaceEncasement e =
      certified({kSphere, "(x-2)^2+(y-1/10)^2+z^2-1", "x^2+y^2+z^2-1/2"}, cube(4));
  EXPECT_EQ(curve_components(e, 0, 1), (CurveComponents{0, 0}));
  EXPECT_EQ(curve_components(e, 0, 2), (CurveComponents{0, 0}));
  for (int s = 0; s < 3; ++s) EXPECT_EQ(euler_characteristic(e, s), 2);
}

TEST(SurfaceEncasement, CylindersCrossInOneLoopOrTwo) {
  const Polyhedron region = cube(Rational(3, 2));
  // Axes that meet: the thin one runs through the thick one. Axes apart: one loop.
  const SurfaceEncasement through = certified({"x^2+y^2-1/4", "x^2+z^2-1/3"}, region);
  EXPECT_EQ(curve_components(through, 0, 1), (CurveComponents{0, 2}));
  const SurfaceEncasement beside = certified({"x^2+y^2-1/4", "(x-1/2)^2+z^2-1/3"}, region);
  EXPECT_EQ(curve_components(beside, 0, 1), (CurveComponents{0, 1}));
  for (int s = 0; s < 2; ++s) EXPECT_EQ(euler_characteristic(through, s), 0);
}

TEST(SurfaceEncasement, VivianisCurvePerturbedIsOneLoopOrTwo) {
  const std::string sphere = "x^2+y^2+z^2-4";
  const Polyhedron region = cube(Rational(5, 2));
  EXPECT_EQ(curve_components(certified({sphere, "(x-101/100)^2+y^2-1"}, region), 0, 1),
            (CurveComponents{0, 1}));
  EXPECT_EQ(curve_components(certified({sphere, "(x-99/100)^2+y^2-1"}, region), 0, 1),
            (CurveComponents{0, 2}));
}

TEST(SurfaceEncasement, ThreeQuadricsMeetInEightPoints) {
  // (+-2/3, +-2/3, +-1/3)
  const SurfaceEncasement e =
      certified({"x^2+y^2+z^2-1", "2*x^2-y^2+z^2-5/9", "x^2+2*y^2-5*z^2-7/9"}, cube(2));
  EXPECT_EQ(triple_points(e), 8);
  int on_arcs = 0;
  for (const SpaceCell& cell : e.cells)
    for (const SurfaceArc& arc : cell.arcs) on_arcs += static_cast<int>(arc.triple_points.size());
  EXPECT_EQ(on_arcs, 3 * 8);
}

TEST(SurfaceEncasement, FourSpheresOverlap) {
  const SurfaceEncasement e =
      certified({"x^2+y^2+z^2-1", "(x-4/5)^2+y^2+z^2-1", "(x-2/5)^2+(y-7/10)^2+z^2-1",
                 "(x-2/5)^2+(y-1/4)^2+(z-2/3)^2-1"},
                cube(3));
  EXPECT_EQ(triple_points(e), 4 * 2);
  for (int f = 0; f < 4; ++f) {
    EXPECT_EQ(euler_characteristic(e, f), 2);
    for (int g = f + 1; g < 4; ++g) EXPECT_EQ(curve_components(e, f, g), (CurveComponents{0, 1}));
  }
}

TEST(SurfaceEncasement, PlanesAndAParabolicCylinderOrderTheirPoints) {
  const SurfaceEncasement e = certified({"x", "y", "x+y+z^2-3/10"}, cube(2));
  EXPECT_EQ(triple_points(e), 2);
  EXPECT_EQ(curve_components(e, 0, 1), (CurveComponents{1, 0}));
}

TEST(SurfaceEncasement, RandomTriplesAreCertified) {
  for (int degree = 2; degree <= 4; ++degree)
    for (std::uint64_t seed = 1; seed <= (degree == 4 ? 2u : 4u); ++seed) {
      SCOPED_TRACE("degree " + std::to_string(degree) + ", seed " + std::to_string(seed));
      RandomOptions options;
      options.degree = degree;
      options.seed = seed;
      options.count = 3;
      std::vector<NamedSurface> surfaces;
      for (Polynomial<3>& f : random_polynomials<3>(options))
        surfaces.push_back({"s" + std::to_string(surfaces.size()), std::move(f)});
      const SurfaceEncasement e = certified_scene(surfaces, cube(1));
      int listed = 0;
      for (const TriplePoint& point : e.triple_points)
        listed += e.region_used.bounding_box().contains(point.box) ? 1 : 0;
      EXPECT_EQ(triple_points(e), listed);
    }
}

TEST(SurfaceEncasement, HalfSpacesCutTheRegion) {
  // An octahedron around a sphere that reaches through all of its eight sides, and a tetrahedron.
  std::vector<HalfSpace> sides;
  for (const int a : {-1, 1})
    for (const int b : {-1, 1})
      for (const int c : {-1, 1}) sides.push_back({a, b, c, Rational(-3, 2)});
  const Polyhedron octahedron = make_polyhedron(sides).value();
  EXPECT_EQ(euler_characteristic(certified({kSphere}, octahedron), 0), 2 - 8);
  const Polyhedron tetrahedron = make_polyhedron({{1, 1, 1, -1},
                                                  {-1, Rational(1, 3), 0, -1},
                                                  {0, -1, Rational(1, 5), -1},
                                                  {Rational(1, 7), 0, -1, -1}})
                                     .value();
  const SurfaceEncasement e = certified({"x^2+y^2+z^2-1/4", "(x-1/3)^2+y^2+z^2-1/4"}, tetrahedron);
  EXPECT_EQ(curve_components(e, 0, 1), (CurveComponents{0, 1}));
}

TEST(SurfaceEncasement, ARegionThatASurfaceTouchesIsEnlarged) {
  const SurfaceEncasement e = certified({kSphere}, cube(1));
  EXPECT_NE(e.region_used.sides, e.region.sides);
  // With and without tiny caps: both are right for the region used.
  const long caps = 2 - euler_characteristic(e, 0);
  EXPECT_GE(caps, 0);
  EXPECT_LE(caps, 6);
}

/// Two surfaces that meet in a closed curve of a diameter, about, at a random place.
std::vector<NamedSurface> needle(double diameter, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::array<Polynomial<3>, 3> offset;
  for (std::size_t i = 0; i < 3; ++i)
    offset[i] = Polynomial<3>::variable(static_cast<int>(i)) -
                Polynomial<3>::constant(Rational(0.4 * uniform(generator)));
  // A sphere, and a saddle through its centre.
  Polynomial<3> saddle =
                    Polynomial<3>::constant(Rational(1, 3)) * offset[0] * offset[1] + offset[2],
                sphere = Polynomial<3>::constant(Rational(-0.25 * diameter * diameter));
  for (std::size_t i = 0; i < 3; ++i) {
    sphere = sphere + offset[i] * offset[i];
    saddle = saddle + Polynomial<3>::constant(Rational(uniform(generator))) * offset[i];
  }
  return {{"saddle", saddle}, {"sphere", sphere}};
}

TEST(SurfaceEncasement, NeedlesAreFound) {
  std::mt19937_64 generator(7);
  for (const double diameter : {1e-3, 1e-6})
    for (int place = 0; place < 100; ++place) {
      const SurfaceEncasement e = certified_scene(needle(diameter, generator), cube(1));
      EXPECT_EQ(euler_characteristic(e, 1), 2);
      EXPECT_EQ(curve_components(e, 0, 1), (CurveComponents{0, 1}));
    }
}

TEST(SurfaceEncasement, RefusesWhatIsNoSurface) {
  EXPECT_EQ(encase({surface("f", "0")}, cube(1)).error().code, Error::Code::BadInput);
  EXPECT_EQ(encase({surface("f", "3")}, cube(1)).error().code, Error::Code::BadInput);
}

TEST(SurfaceEncasement, SharedComponentsAreReportedAndEncasedOnce) {
  const auto result =
      encase({surface("a", "x*(x^2+y^2+z^2-1/2)"), surface("b", "x*(y-1/3)")}, cube(1));
  ASSERT_TRUE(result);
  EXPECT_EQ(result.value().surfaces.size(), 3u);
  EXPECT_EQ(result.value().outcome, Outcome::Degenerate);
  ASSERT_EQ(result.value().degenerate.size(), 1u);
  EXPECT_EQ(result.value().degenerate[0].kind, Unresolved::Kind::SharedComponent);
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
}

TEST(SurfaceEncasement, ASingularPointIsDegenerateWithItsBox) {
  const auto result = encase({surface("cone", "x^2+y^2-z^2")}, cube(2));
  ASSERT_TRUE(result);
  const SurfaceEncasement& e = result.value();
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  ASSERT_EQ(e.degenerate.size(), 1u);
  EXPECT_EQ(e.degenerate[0].kind, Unresolved::Kind::SingularPoint);
  EXPECT_TRUE(e.degenerate[0].box.contains(Point<3>{0, 0, 0}));
  EXPECT_LT(e.degenerate[0].box.largest_width(), 1e-6);
  const Verification proof = verify(e);
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
}

TEST(SurfaceEncasement, ContactsAreDegenerateWithTheirBoxes) {
  // Spheres that touch in (1, 0, 0), and cylinders of equal radii: their curve crosses itself
  // twice.
  const auto spheres = encase({surface("a", kSphere), surface("b", "(x-2)^2+y^2+z^2-1")}, cube(3));
  const auto cylinders =
      encase({surface("a", "x^2+y^2-1/4"), surface("b", "x^2+z^2-1/4")}, cube(Rational(3, 2)));
  std::size_t places = 1;
  for (const auto* result : {&spheres, &cylinders}) {
    ASSERT_TRUE(*result);
    const SurfaceEncasement& e = result->value();
    EXPECT_EQ(e.outcome, Outcome::Degenerate);
    EXPECT_EQ(e.degenerate.size(), places++);
    for (const UnresolvedInSpace& place : e.degenerate) {
      EXPECT_EQ(place.kind, Unresolved::Kind::Contact);
      EXPECT_LT(place.box.largest_width(), 1e-6);
    }
    const Verification proof = verify(e);
    EXPECT_TRUE(proof.ok()) << proof.objections.front();
  }
}

TEST(SurfaceEncasement, IsTheSameEveryTime) {
  const std::vector<NamedSurface> surfaces{surface("a", kTorus), surface("b", "x+y/3+z/5-1/2")};
  const SurfaceEncasement first = certified_scene(surfaces, cube(4)),
                          second = certified_scene(surfaces, cube(4));
  ASSERT_EQ(first.cells.size(), second.cells.size());
  ASSERT_EQ(first.facet_points.size(), second.facet_points.size());
  for (std::size_t k = 0; k < first.facet_points.size(); ++k)
    EXPECT_EQ(first.facet_points[k].point, second.facet_points[k].point);
}

TEST(SurfaceEncasement, ABudgetLeavesTheRestUndecided) {
  SurfaceOptions options;
  options.max_cells = 5;
  const auto result = encase({surface("torus", kTorus)}, cube(4), options);
  ASSERT_TRUE(result);
  EXPECT_EQ(result.value().outcome, Outcome::Undecided);
  EXPECT_FALSE(result.value().undecided.empty());
  options.max_cells = 20000;
  options.progress = [](const char*, double) { return false; };
  EXPECT_EQ(encase({surface("torus", kTorus)}, cube(4), options).value().outcome,
            Outcome::Undecided);
}

TEST(SurfaceEncasement, ADenominatorMayBeNegative) {
  // On some planes it is a constant, and its numerator there is not that in space.
  const auto x = Expression::variable(0), y = Expression::variable(1), z = Expression::variable(2);
  const Expression three(3), third(Rational(1, 3));
  const Expression negative = Expression(1) / (x - three) + y * z + third,
                   positive = Expression(-1) / (three - x) + y * z + third;
  for (const Expression& f : {negative, positive}) {
    const SurfaceEncasement e =
        certified_scene({{"quotient", f}, surface("sphere", "x^2+y^2+z^2-2")}, cube(2));
    EXPECT_EQ(euler_characteristic(e, 0), 1);
    EXPECT_EQ(euler_characteristic(e, 1), 2);
  }
}

/// A triple point on the region's boundary is found, since the region used is larger, and told to
/// be there.
TEST(SurfaceEncasement, TriplePointsAreLocatedInTheRegionAsked) {
  const auto e = encase({surface("a", "x+y-1"), surface("b", "x-y"), surface("c", "z*(z-1/3)")},
                        make_box({0, 0, 0}, {1, 1, 1}).value());
  ASSERT_TRUE(e);
  ASSERT_EQ(e.value().triple_points.size(), 2u);
  for (const TriplePoint& point : e.value().triple_points)
    EXPECT_EQ(point.location, point.point[2] < 0.1 ? Location::OnBoundary : Location::Inside);
  const Verification proof = verify(e.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  SurfaceEncasement wrong = e.value();
  wrong.triple_points[0].location = Location::Outside;
  EXPECT_FALSE(verify(wrong).ok());
}

}  // namespace
}  // namespace encase
