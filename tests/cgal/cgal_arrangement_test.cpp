// SPDX-License-Identifier: MIT
//
// Arrangements of several curves in the whole plane against CGAL's. This test program links CGAL
// (GPL); nothing of it is part of the library.
#include <gtest/gtest.h>

#include <vector>

#include "cgal_arrangement.hpp"
#include "common/random_polynomials.hpp"
#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"
#include "encase/verify.hpp"

namespace encase {
namespace {

struct Family {
  int degree;
  int curves;
  int bits;
};

void PrintTo(const Family& family, std::ostream* out) {
  *out << family.curves << " of degree " << family.degree;
}

class CgalArrangements : public testing::TestWithParam<Family> {};

/// Random dense curves with integer coefficients (M. Kerber, *Geometric Algorithms for Algebraic
/// Curves and Surfaces*, 2009, table 1: degree 5, 50 bits).
TEST_P(CgalArrangements, HaveTheSameCrossingsAndFaces) {
  RandomOptions options;
  options.kind = RandomOptions::Kind::Dense;
  options.degree = GetParam().degree;
  options.count = GetParam().curves;
  options.bits = GetParam().bits;
  const auto curves = random_curves(options);
  const Result<Encasement> encased = encase(curves, whole_plane());
  ASSERT_TRUE(encased.ok()) << encased.error().message;
  ASSERT_EQ(encased.value().outcome, Outcome::Certified);
  for (const std::string& objection : verify(encased.value()).objections)
    ADD_FAILURE() << objection;
  const Result<Arrangement> arrangement = arrange(encased.value());
  ASSERT_TRUE(arrangement.ok()) << arrangement.error().message;
  EXPECT_EQ(check(arrangement.value()), "");

  std::vector<Polynomial<2>> polynomials;
  for (const NamedCurve& curve : curves) polynomials.push_back(curve.function.polynomial());
  const CgalArrangement theirs = cgal_arrangement(polynomials);
  EXPECT_EQ(static_cast<int>(encased.value().crossings.size()), theirs.crossings);
  // One face is all that lies beyond the rectangle; the arcs to infinity only prolong the others.
  EXPECT_EQ(static_cast<int>(arrangement.value().faces.size()) - 1, theirs.faces);
}

INSTANTIATE_TEST_SUITE_P(Random, CgalArrangements,
                         testing::Values(Family{1, 12, 20}, Family{2, 8, 20}, Family{2, 12, 20},
                                         Family{3, 6, 20}, Family{3, 12, 20}, Family{4, 12, 20},
                                         Family{4, 4, 20}, Family{5, 10, 50}, Family{5, 20, 50}));

}  // namespace
}  // namespace encase
