// SPDX-License-Identifier: MIT
#include "encase/common_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "random_triples.hpp"
#include "written.hpp"

namespace encase {
namespace {

std::array<NamedSurface, 3> surfaces(const std::string& f, const std::string& g,
                                     const std::string& h) {
  return named({written::polynomial<3>(f), written::polynomial<3>(g), written::polynomial<3>(h)});
}

CommonPoints found(const std::array<NamedSurface, 3>& triple, const Polyhedron& region,
                   const CommonPointsOptions& options = {}) {
  auto result = common_points(triple, region, options);
  EXPECT_TRUE(result) << result.error().message;
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  EXPECT_GT(proof.claims, 0);
  return std::move(result).value();
}

int count(const CommonPoints& points, Location location) {
  int n = 0;
  for (const CommonPoint& c : points.points) n += c.location == location;
  return n;
}

TEST(CommonPoints, ThreeQuadricsMeetInEightPoints) {
  const auto result =
      found(surfaces("x^2 + y z/10 - 1/4", "y^2 + x z/10 - 1/5", "z^2 + x y/10 - 1/3"), cube(1));
  EXPECT_EQ(result.outcome, Outcome::Certified);
  EXPECT_EQ(count(result, Location::Inside), 8);
  for (const CommonPoint& c : result.points) {
    EXPECT_TRUE(c.rounded);
    EXPECT_TRUE(c.box.contains(c.point));
    EXPECT_LT(c.box.largest_width(), 1e-13);
  }
}

TEST(CommonPoints, PointsAreCorrectlyRounded) {
  // x^2 = 2, y^2 = 3, z^3 = 5.
  const auto result = found(surfaces("x^2 - 2", "y^2 + x^2 - 5", "z^3 + y^2 - 8"), cube(2));
  ASSERT_EQ(result.points.size(), 4u);
  for (const CommonPoint& c : result.points) {
    EXPECT_TRUE(c.rounded);
    EXPECT_EQ(std::fabs(c.point[0]), std::sqrt(2.0));
    EXPECT_EQ(std::fabs(c.point[1]), std::sqrt(3.0));
    EXPECT_EQ(c.point[2], std::cbrt(5.0));
  }
}

TEST(CommonPoints, LocationsAreTold) {
  // Zeros at x, y, z = +-1/2; one side passes through four of them.
  const auto triple = surfaces("4x^2 - 1", "4y^2 - 1", "4z^2 - 1");
  auto region = make_polyhedron({{1, 0, 0, -1},
                                 {-1, 0, 0, -1},
                                 {0, 1, 0, -1},
                                 {0, -1, 0, -1},
                                 {0, 0, 1, Rational(-1, 2)},
                                 {0, 0, -1, -1},
                                 {1, 1, 1, Rational(-11, 10)}});
  const auto result = found(triple, region.value());
  EXPECT_EQ(result.outcome, Outcome::Certified);
  EXPECT_EQ(count(result, Location::Inside), 4);
  EXPECT_EQ(count(result, Location::OnBoundary), 3);
  // The eighth, (1/2, 1/2, 1/2), is beyond the oblique side.
  EXPECT_EQ(result.points.size() - 7, static_cast<std::size_t>(count(result, Location::Outside)));
}

TEST(CommonPoints, AThirdIsOnTheBoundaryThoughNoDouble) {
  const auto triple = surfaces("3x - 1", "y - x^2", "z - y + 1/9");
  const auto region = make_box({0, -1, -1}, {Rational(1, 3), 1, 1}).value();
  const auto result = found(triple, region);
  // (1/3, 1/9, 0): y is no double, and no side tells it.
  EXPECT_EQ(result.outcome, Outcome::Undecided);
  const auto smaller = make_box({0, -1, 0}, {Rational(1, 3), Rational(1, 9), 1}).value();
  const auto at_corner = found(triple, smaller);
  EXPECT_EQ(at_corner.outcome, Outcome::Certified);
  EXPECT_EQ(count(at_corner, Location::OnBoundary), 1);
}

TEST(CommonPoints, DegreesMayDiffer) {
  // A plane, a sphere and a surface of degree six; of degree nine; of
  // degree 17, by the general search.
  const auto six =
      found(surfaces("x + y + z", "x^2 + y^2 + z^2 - 1", "x^6 - y^6 + z^5 x - 1/100"), cube(2));
  EXPECT_EQ(six.outcome, Outcome::Certified);
  EXPECT_EQ(six.points.size() % 2, 0u);
  const auto nine = found(surfaces("x + y + z", "x^2 + y^2 + z^2 - 1", "x^9 - y^9/2"), cube(2));
  EXPECT_EQ(nine.outcome, Outcome::Certified);
  EXPECT_EQ(nine.points.size(), 2u);
  const auto general = found(surfaces("x + y + z", "x - y/3 + z/7", "x^17 - z - 1/2"), cube(2));
  EXPECT_EQ(general.outcome, Outcome::Certified);
  EXPECT_EQ(general.points.size(), 1u);
}

TEST(CommonPoints, ExpressionsHaveThem) {
  const Expression x = Expression::variable(0), y = Expression::variable(1),
                   z = Expression::variable(2);
  const auto sine = [](const Expression& f) { return Expression::apply(Operation::Sin, f); };
  const std::array<NamedSurface, 3> triple{
      NamedSurface{"wave", z - sine(x + x + x)},
      NamedSurface{"plane", written::polynomial<3>("y - x/2")},
      NamedSurface{"sphere", written::polynomial<3>("x^2 + y^2 + z^2 - 1")}};
  const auto result = found(triple, cube(2));
  EXPECT_EQ(result.outcome, Outcome::Certified);
  ASSERT_EQ(result.points.size(), 2u);
  for (const CommonPoint& c : result.points)
    EXPECT_NEAR(c.point[2], std::sin(3 * c.point[0]), 1e-14);
}

TEST(CommonPoints, ClosePointsAreTold) {
  // Two points at a distance of 2 e.
  for (const std::string e : {"1e-3", "1e-6", "1e-9"}) {
    const auto result = found(
        surfaces("y - x/3", "z + x - y/7", "y - x/3 + x^2 + y^2 + z^2 - " + e + "^2"), cube(1));
    EXPECT_EQ(result.outcome, Outcome::Certified) << e;
    EXPECT_EQ(result.points.size(), 2u) << e;
  }
}

TEST(CommonPoints, ContactsAreDegenerateInSmallBoxes) {
  // The line through the spheres' circle touches it at (0, 0, 1).
  const auto touching =
      found(surfaces("x^2 + y^2 + z^2 - 1", "x - y/2", "z - 1 + x^3 + x y"), cube(2));
  EXPECT_EQ(touching.outcome, Outcome::Degenerate);
  ASSERT_FALSE(touching.degenerate.empty());
  for (const Box<3>& box : touching.degenerate) {
    EXPECT_LT(box.largest_width(), 1e-3);
    EXPECT_NEAR(box.center()[2], 1, 1e-3);
  }
  // A triple zero at the origin.
  const auto triple = found(surfaces("x - y^3", "y - z^2 x + y^3", "z - x"), cube(1));
  EXPECT_EQ(triple.outcome, Outcome::Certified);  // the Jacobian is regular there
  const auto flat = found(surfaces("x - y^3", "x + y^3 - z^5", "z - x"), cube(1));
  EXPECT_NE(flat.outcome, Outcome::Certified);
  for (const auto* list : {&flat.degenerate, &flat.undecided})
    for (const Box<3>& box : *list) EXPECT_LT(box.largest_width(), 0.1);
}

TEST(CommonPoints, ACommonCurveEndsWithinTheBudget) {
  CommonPointsOptions options;
  options.max_boxes = 20000;
  const auto result =
      found(surfaces("x^2 + y^2 - 1/2", "x^2 + y^2 - 1/2 + z", "z (x - y + 2)"), cube(1), options);
  EXPECT_EQ(result.outcome, Outcome::Undecided);
  EXPECT_LE(result.boxes, options.max_boxes);
  EXPECT_LE(result.undecided.size() + result.degenerate.size(), 256u);
  for (const Box<3>& box : result.undecided) {
    EXPECT_LE(box.lo[2], 0);
    EXPECT_GE(box.hi[2], 0);
  }
}

TEST(CommonPoints, OneContactDoesNotUseUpWhatOthersNeed) {
  // The planes meet in a line that touches a sphere, and six lines cross it.
  CommonPointsOptions options;
  options.max_boxes = 3000;
  const auto result =
      found(surfaces("(y - 1) (y - 1/3) (y + 2/5)", "z - x^2/50", "x^2 + y^2 + z^2 - 1"), cube(2),
            options);
  EXPECT_NE(result.outcome, Outcome::Certified);
  EXPECT_EQ(result.points.size(), 4u);
}

TEST(CommonPoints, BadInputIsNamed) {
  const auto error = [](const Polynomial<3>& f) {
    const auto result = common_points(
        named({f, written::polynomial<3>("x - y"), written::polynomial<3>("z")}), cube(1));
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().code, Error::Code::BadInput);
    return result.error().message;
  };
  EXPECT_EQ(error({}), "surface 'f' is the zero polynomial: every point lies on it");
  EXPECT_EQ(error(Polynomial<3>::constant(7)), "surface 'f' is a constant: no point lies on it");
  EXPECT_EQ(error(Polynomial<3>::variable(0).power(61)),
            "surface 'f' has degree 61, above the limit of 60");
}

/// Changes one fact; false if this one has none to change.
bool change(CommonPoints* points, int kind) {
  auto& tokens = points->tokens;
  const auto token = [&](int from, int to) {
    const auto at = std::find(tokens.begin(), tokens.end(), from);
    if (at == tokens.end()) return false;
    *at = to;
    return true;
  };
  switch (kind) {
    case 0:
      return token(0, cover::kExcluded);
    case 1:
      return token(0, cover::kOutside);
    case 2:
      return token(0, 1);
    case 3:
      return token(cover::kSplitX, cover::kExcluded);
    case 4:
      tokens.pop_back();
      return true;
    case 5:
      tokens.push_back(cover::kExcluded);
      return true;
    case 6:
      return token(0, static_cast<int>(points->points.size()));
    case 7:
      return token(0, cover::kUnresolved);
    case 8:
      points->root.hi[1] = points->root.center()[1];
      return true;
    case 9:
      points->points[0].box.lo[2] += 1e-3;
      points->points[0].box.hi[2] += 1e-3;
      points->points[0].point[2] = points->points[0].box.center()[2];
      return true;
    case 10:
      points->points[1].point[0] = std::nextafter(points->points[1].point[0], 2);
      return true;
    case 11:  // the zero is still in the box, but the centre is another double
      points->points[0].box.hi[0] += 8 * (points->points[0].box.hi[0] - points->points[0].point[0]);
      points->points[0].point = points->points[0].box.center();
      return true;
    case 12:
      points->points[0].location = Location::Outside;
      return true;
    case 13:
      points->points[1] = points->points[0];
      return true;
    case 14:
      points->outcome = Outcome::Degenerate;
      return true;
    case 15:
      points->surfaces[2].function =
          points->surfaces[2].function.polynomial() + Polynomial<3>::constant(Rational(1, 1000));
      return true;
    case 16:
      points->region.corners[0][0] -= 3;
      return true;
    case 17:
      points->region = cube(2);
      return true;
    case 18:
      points->points[0].box.hi[0] = std::nan("");
      return true;
    case 19:
      points->root.lo[0] = -HUGE_VAL;
      return true;
    case 20:
      points->points.pop_back();
      return true;
    default:
      return false;
  }
}

TEST(CommonPoints, VerificationNoticesWhatIsChanged) {
  const auto intact = found(named(random_triple(3, 2)), cube(1));
  ASSERT_GE(intact.points.size(), 2u);
  int kinds = 0;
  for (int kind = 0;; ++kind) {
    CommonPoints changed = intact;
    if (!change(&changed, kind)) break;
    EXPECT_FALSE(verify(changed).ok()) << "change " << kind;
    ++kinds;
  }
  EXPECT_EQ(kinds, 21);
}

}  // namespace
}  // namespace encase
