// SPDX-License-Identifier: MIT
//
// What the search finds is verified, and what is changed afterwards is refused.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encased.hpp"
#include "mutations.hpp"
#include "objections.hpp"

namespace encase {
namespace {

using encased::expect_verified;

Region square(const Rational& half) { return make_region(-half, half, -half, half).value(); }

std::vector<NamedCurve> random(int degree, int count, int seed, RandomOptions::Kind kind) {
  RandomOptions options;
  options.kind = kind;
  options.degree = degree;
  options.count = count;
  options.seed = static_cast<std::uint64_t>(seed);
  return random_curves(options);
}

class VerifiedPair : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  int degree() const { return std::get<0>(GetParam()); }
  int seed() const { return std::get<1>(GetParam()); }
  std::vector<NamedCurve> curves(RandomOptions::Kind kind = RandomOptions::Kind::Interpolating) {
    return random(degree(), 2, seed(), kind);
  }
};

TEST_P(VerifiedPair, IsVerifiedInASquare) {
  const Encasement e = encase(curves(), square(1)).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_verified(e);
}

TEST_P(VerifiedPair, IsVerifiedInASmallSquare) {
  const Encasement e = encase(curves(), square(Rational(1, 10))).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_verified(e);
}

TEST_P(VerifiedPair, IsVerifiedInATriangle) {
  const Region region = make_region({{Rational(-1), Rational(-9, 10)},
                                     {Rational(8, 9), Rational(-2, 3)},
                                     {Rational(1, 7), Rational(1)}})
                            .value();
  const Encasement e = encase(curves(), region).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_verified(e);
}

TEST_P(VerifiedPair, IsVerifiedInRelaxedCells) {
  EncaseOptions options;
  options.relaxed = true;
  const Encasement e = encase(curves(RandomOptions::Kind::Dense), square(1), options).value();
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_verified(e);
}

TEST_P(VerifiedPair, IsVerifiedWhereTheBudgetRanOut) {
  for (const int cells : {1, 2, 5}) {
    EncaseOptions options;
    options.max_cells = cells;
    expect_verified(encase(curves(), square(1), options).value());
  }
}

INSTANTIATE_TEST_SUITE_P(Verify, VerifiedPair,
                         testing::Combine(testing::Values(1, 2, 3, 4, 5, 6, 8, 10),
                                          testing::Values(1, 2, 3)));

class Mutated : public testing::TestWithParam<int> {};

TEST_P(Mutated, IsRefused) {
  const int seed = GetParam();
  const Encasement e =
      encase(random(2 + seed % 4, 2 + seed % 2, seed, RandomOptions::Kind::Interpolating),
             square(1))
          .value();
  ASSERT_TRUE(verify(e).ok());
  if (e.crossings.empty() || e.cells.size() < 2) GTEST_SKIP() << "too simple to mutate";
  mutations::Mutator mutator(static_cast<std::uint64_t>(seed));
  for (int round = 0; round < 150; ++round) {
    Encasement mutant = e;
    const mutations::Mutation mutation = mutator.apply(mutant);
    const Verification verification = verify(mutant, {848, 1});
    EXPECT_TRUE(mutation.may_hold || !verification.ok()) << mutation.what;
  }
  for (int round = 0; round < 150; ++round) {
    Encasement mutant = e;
    mutator.corrupt(mutant, 1 + round % 3);
    verify(mutant, {848, 1});  // whatever it says, it returns
  }
}

INSTANTIATE_TEST_SUITE_P(Verify, Mutated, testing::Range(1, 13));

Polynomial<2> from(std::vector<Polynomial<2>::Term> terms) {
  return Polynomial<2>::from_terms(std::move(terms));
}
Polynomial<2> circle(const Rational& x, const Rational& y, const Rational& r) {
  const Rational constant = x * x + y * y - r * r;
  return from({{{2, 0}, 1},
               {{0, 2}, 1},
               {{1, 0}, Rational(-2 * x)},
               {{0, 1}, Rational(-2 * y)},
               {{0, 0}, constant}});
}

Encasement encased(const std::vector<Polynomial<2>>& polynomials) {
  std::vector<NamedCurve> curves;
  for (const auto& f : polynomials) curves.push_back({"c" + std::to_string(curves.size()), f});
  return encase(curves, square(1)).value();
}

const auto x = Polynomial<2>::variable(0);
const auto y = Polynomial<2>::variable(1);

TEST(VerifySpecial, DiagonalsThroughTheCorners) {
  const Encasement e = encased({x - y, x + y});
  EXPECT_EQ(e.outcome, Outcome::Certified);
  ASSERT_EQ(e.crossings.size(), 1u);
  EXPECT_EQ(e.crossings[0].location, Location::Inside);
  expect_verified(e);
}

TEST(VerifySpecial, CircleThatTouchesASide) {
  const Encasement e = encased({circle(Rational(1, 2), 0, Rational(1, 2)), y - x});
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_verified(e);
}

TEST(VerifySpecial, CurvesThatMeetOnASide) {
  const Encasement e = encased({circle(0, 0, 1), y + x - Polynomial<2>::constant(1)});
  EXPECT_EQ(e.outcome, Outcome::Certified);
  ASSERT_EQ(e.crossings.size(), 2u);
  for (const Crossing& c : e.crossings) EXPECT_EQ(c.location, Location::OnBoundary);
  expect_verified(e);
}

TEST(VerifySpecial, TangentCircles) {
  const Encasement e = encased(
      {circle(Rational(-1, 4), 0, Rational(1, 4)), circle(Rational(1, 4), 0, Rational(1, 4))});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  expect_verified(e);
}

TEST(VerifySpecial, NodeAndCusp) {
  const Encasement e = encased({y * y - x * x * x - x * x, y * y - (x - y) * (x - y) * (x - y)});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  expect_verified(e);
}

TEST(VerifySpecial, ThreeLinesThroughAPoint) {
  const Encasement e = encased({x - y, x + y, y});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  expect_verified(e);
}

TEST(VerifySpecial, SharedAndRepeatedComponents) {
  const auto c = circle(0, 0, Rational(1, 2)), line = y - x;
  for (const auto& list : std::vector<std::vector<Polynomial<2>>>{
           {c, c}, {c * c, line}, {c * line, c}, {c * line * line, c * (x + y)}}) {
    const Encasement e = encased(list);
    EXPECT_EQ(e.outcome, Outcome::Degenerate);
    expect_verified(e);
  }
}

TEST(VerifySpecial, TinyLoopsAndNoCurves) {
  for (const auto& f : {circle(Rational(1, 3), Rational(1, 7), Rational(1, 1000000)),
                        circle(3, 3, 1), circle(0, 0, 2)}) {
    const Encasement e = encased({f, y - x - Polynomial<2>::constant(Rational(1, 5))});
    EXPECT_EQ(e.outcome, Outcome::Certified);
    expect_verified(e);
  }
}

}  // namespace
}  // namespace encase
