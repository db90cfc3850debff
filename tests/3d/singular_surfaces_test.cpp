// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surfaces_file.hpp"
#include "written.hpp"

namespace encase {
namespace {

using Kind = Unresolved::Kind;
using Curve = std::function<Point<3>(double)>;  ///< of a parameter from -1 to 1

struct Scene {
  std::string name;
  std::vector<std::string> surfaces;
  int half;  ///< of the region's side
  Kind kind;
  std::vector<Curve> curves;  ///< along which the surfaces are not in general position
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

Curve axis(std::size_t i, double reach) {
  return [=](double t) {
    Point<3> p{};
    p[i] = reach * t;
    return p;
  };
}

/// One of the four arcs in which z > 0 or z < 0 and x > 0 or x < 0 on Hunt's cuspidal edges, where
/// x^2 + y^2 + z^2 = 13 and 3 x^2 + y^2 - 4 z^2 = 12.
Curve cuspidal_edge(double sign_x, double sign_z) {
  return [=](double t) {
    const double y = std::sqrt(12.8) * t, z2 = (27 - 2 * y * y) / 7, x2 = (64 - 5 * y * y) / 7;
    return Point<3>{sign_x * std::sqrt(std::max(0.0, x2)), y, sign_z * std::sqrt(z2)};
  };
}

Curve unit_circle() {
  return [](double t) { return Point<3>{std::cos(M_PI * t), std::sin(M_PI * t), 0}; };
}

NamedSurface named(const std::string& text, std::size_t k) {
  return {"s" + std::to_string(k), written::polynomial<3>(text)};
}

SurfaceEncasement encased(const std::vector<std::string>& texts, int half,
                          const SurfaceOptions& options = {}) {
  std::vector<NamedSurface> surfaces;
  for (const std::string& text : texts) surfaces.push_back(named(text, surfaces.size()));
  auto result =
      encase(surfaces, make_box({-half, -half, -half}, {half, half, half}).value(), options);
  EXPECT_TRUE(result) << result.error().message;
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return std::move(result).value();
}

/// Whether a box, made wider on all sides by so many of its widths, holds a point.
bool is_near(const Box<3>& box, const Point<3>& p, double margin) {
  for (int i = 0; i < 3; ++i)
    if (!(box.lo[i] - margin * box.largest_width() <= p[i] &&
          p[i] <= box.hi[i] + margin * box.largest_width()))
      return false;
  return true;
}

class SingularCurves : public testing::TestWithParam<Scene> {};

/// All of the curve lies in cells that are reported, as what they are; all else is certified, and
/// proved again.
TEST_P(SingularCurves, AreReportedAndAllElseIsCertified) {
  const Scene& scene = GetParam();
  const SurfaceEncasement e = encased(scene.surfaces, scene.half);
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  EXPECT_LT(e.seconds, 10);
  std::vector<Point<3>> points;
  for (const Curve& curve : scene.curves)
    for (int k = -2000; k <= 2000; ++k) points.push_back(curve(k / 2000.0));
  std::vector<const Box<3>*> open;
  for (const SpaceCell& cell : e.cells) {
    EXPECT_NE(cell.state, CellState::Undecided);
    if (cell.state == CellState::Degenerate) open.push_back(&cell.box);
  }
  for (const Point<3>& p : points)
    ASSERT_TRUE(std::any_of(open.begin(), open.end(),
                            [&](const Box<3>* box) { return is_near(*box, p, 1e-9); }))
        << p[0] << ' ' << p[1] << ' ' << p[2];
  double volume = 0;
  for (const Box<3>* box : open) volume += box->width(0) * box->width(1) * box->width(2);
  EXPECT_LT(volume, 0.002 * std::pow(2.0 * scene.half, 3));
  std::vector<int> named(e.cells.size(), 0);
  for (const UnresolvedInSpace& place : e.degenerate) {
    EXPECT_EQ(place.kind, scene.kind);
    EXPECT_FALSE(place.surfaces.empty());
    for (const int cell : place.cells) {
      ++named[cell];
      const Box<3>& box = e.cells[cell].box;
      EXPECT_TRUE(place.box.contains(box));
      // (Hunt's surface has two nodes besides its curves.)
      if (box.largest_width() < 1e-6 * scene.half) continue;
      EXPECT_LE(box.largest_width(), 2.0 * scene.half / 64);
      EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                              [&](const Point<3>& p) { return is_near(box, p, 1); }));
    }
  }
  for (std::size_t c = 0; c < e.cells.size(); ++c)
    EXPECT_EQ(named[c], e.cells[c].state == CellState::Certified ? 0 : 1);
}

INSTANTIATE_TEST_SUITE_P(
    All, SingularCurves,
    testing::Values(Scene{"whitneys_umbrella", {"x^2-y^2*z"}, 1, Kind::SingularPoint, {axis(2, 1)}},
                    Scene{"three_planes_in_one",
                          {"x*y*z"},
                          1,
                          Kind::SingularPoint,
                          {axis(0, 1), axis(1, 1), axis(2, 1)}},
                    Scene{"steiners_roman_surface",
                          {"x^2*y^2+y^2*z^2+z^2*x^2-x*y*z"},
                          1,
                          Kind::SingularPoint,
                          {axis(0, 1), axis(1, 1), axis(2, 1)}},
                    Scene{"hunts_surface",
                          {"4*(x^2+y^2+z^2-13)^3+27*(3*x^2+y^2-4*z^2-12)^2"},
                          4,
                          Kind::SingularPoint,
                          {cuspidal_edge(1, 1), cuspidal_edge(-1, 1), cuspidal_edge(1, -1),
                           cuspidal_edge(-1, -1)}},
                    Scene{"cuspidal_edge", {"x^2-y^3"}, 1, Kind::SingularPoint, {axis(2, 1)}},
                    Scene{"sphere_in_a_cylinder",
                          {"x^2+y^2+z^2-1", "x^2+y^2-1"},
                          2,
                          Kind::Contact,
                          {unit_circle()}},
                    Scene{"plane_on_a_trough", {"z-x^2", "z"}, 1, Kind::Contact, {axis(1, 1)}},
                    Scene{"three_surfaces_with_a_common_line",
                          {"x", "y", "x+y-x*y*z"},
                          1,
                          Kind::Concurrency,
                          {axis(2, 1)}}),
    [](const auto& scene) { return scene.param.name; });

TEST(SingularCurve, IsFollowedInCellsOfTheWidthAskedFor) {
  std::size_t before = 0;
  for (const double width : {0x1p-4, 0x1p-6, 0x1p-8}) {
    SurfaceOptions options;
    options.singular_width = width;
    const SurfaceEncasement e = encased({"x^2-y^2*z"}, 1, options);
    EXPECT_EQ(e.outcome, Outcome::Degenerate);
    for (const SpaceCell& cell : e.cells)
      if (cell.state != CellState::Certified) {
        EXPECT_LE(cell.box.largest_width(), 2 * width);
      }
    EXPECT_GT(e.cells.size(), 2 * before);
    before = e.cells.size();
  }
}

/// Single points are not left in coarse cells.
TEST(SingularPoint, IsReportedInATinyBox) {
  struct Place {
    std::vector<std::string> surfaces;
    Kind kind;
    std::size_t count;
  };
  for (const Place& scene : {Place{{"x^2+y^2-z^2"}, Kind::SingularPoint, 1},
                             Place{{"x^2+z^2-1", "y^2+z^2-1"}, Kind::Contact, 2},
                             Place{{"x^2+y^2+z^2-1", "(x-2)^2+y^2+z^2-1"}, Kind::Contact, 1}}) {
    const SurfaceEncasement e = encased(scene.surfaces, 3);
    EXPECT_EQ(e.outcome, Outcome::Degenerate);
    ASSERT_EQ(e.degenerate.size(), scene.count);
    for (const UnresolvedInSpace& place : e.degenerate) {
      EXPECT_EQ(place.kind, scene.kind);
      EXPECT_LT(place.box.largest_width(), 1e-5);
    }
  }
}

/// Equal cylinders that cross at right angles meet in two ellipses that cross; perturbed, in one or
/// two loops.
TEST(SingularPoint, OfTwoCylindersIsResolvedByAPerturbation) {
  SurfaceOptions options;
  options.perturbation = 1e-3;
  options.seed = 5;
  const SurfaceEncasement e = encased({"x^2+z^2-1", "y^2+z^2-1"}, 2, options);
  EXPECT_EQ(e.outcome, Outcome::Certified);
  EXPECT_EQ(e.perturbation, 1e-3);
  EXPECT_EQ(e.seed, 5u);
  const auto curves = intersection_curves(e);
  EXPECT_GE(curves.size(), 1u);
  EXPECT_LE(curves.size(), 2u);
  for (const IntersectionCurve& curve : curves) EXPECT_TRUE(curve.closed);
}

/// Surfaces that nearly have a singular curve are resolved, not left.
TEST(SingularCurve, ThatIsNearlyOneIsCertified) {
  for (const auto& texts : std::vector<std::vector<std::string>>{
           {"x*y-1/10000"}, {"z-x^2-1/10000", "z"}, {"z-x^2+1/10000", "z"}}) {
    const SurfaceEncasement e = encased(texts, 1);
    EXPECT_EQ(e.outcome, Outcome::Certified) << texts[0];
  }
}

/// A result that hides an open cell, or names one twice, is no proof.
TEST(SingularCurve, NamesEveryOpenCellOnce) {
  const SurfaceEncasement good = encased({"x*y"}, 1);
  ASSERT_EQ(good.outcome, Outcome::Degenerate);
  ASSERT_FALSE(good.degenerate[0].cells.empty());
  EXPECT_TRUE(verify(good).ok());
  SurfaceEncasement hidden = good;
  hidden.degenerate[0].cells.pop_back();
  EXPECT_FALSE(verify(hidden).ok());
  SurfaceEncasement twice = good;
  twice.degenerate.push_back(good.degenerate[0]);
  EXPECT_FALSE(verify(twice).ok());
}

TEST(SingularCurve, OfBadOptionsIsRefused) {
  SurfaceOptions options;
  options.singular_width = 0;
  const auto region = make_box({-1, -1, -1}, {1, 1, 1}).value();
  EXPECT_FALSE(encase({named("x", 0)}, region, options));
  options.singular_width = 0.1;
  options.perturbation = -1;
  EXPECT_FALSE(encase({named("x", 0)}, region, options));
}

}  // namespace
}  // namespace encase
