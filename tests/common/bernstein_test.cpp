// SPDX-License-Identifier: MIT
#include "common/bernstein.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/random_polynomials.hpp"
#include "exact_bernstein.hpp"

namespace encase {
namespace {

using exact_bernstein::encloses;

/// A net of random doubles of very different sizes, exact: its radius is zero.
template <int K>
Bernstein<K> random_net(const std::array<int, K>& degree, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Bernstein<K> net;
  net.degree = degree;
  for (int i = 0; i < net.size(); ++i)
    net.b.push_back(std::ldexp(symmetric_random(generator), -static_cast<int>(generator() % 12)));
  return net;
}

template <int K>
std::array<int, K> degrees();
template <>
std::array<int, 1> degrees<1>() {
  return {7};
}
template <>
std::array<int, 2> degrees<2>() {
  return {4, 6};
}
template <>
std::array<int, 3> degrees<3>() {
  return {2, 4, 3};
}

template <class Dimension>
class BernsteinOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BernsteinOf, Dimensions);

TYPED_TEST(BernsteinOf, NetOfDoublesIsItsOwnPolynomialsNet) {
  // The two halves of the oracle agree.
  constexpr int K = TypeParam::value;
  const auto net = random_net<K>(degrees<K>(), 3);
  EXPECT_TRUE(encloses<K>(net, exact_bernstein::polynomial<K>(net)));
}

TYPED_TEST(BernsteinOf, HalvesAreTheRestrictionsToHalfCubes) {
  constexpr int K = TypeParam::value;
  const auto net = random_net<K>(degrees<K>(), 1);
  const auto f = exact_bernstein::polynomial<K>(net);
  for (int axis = 0; axis < K; ++axis) {
    Bernstein<K> lower, upper;
    halve(net, axis, &lower, &upper);
    for (const int sign : {-1, 1}) {
      const Bernstein<K>& half = sign < 0 ? lower : upper;
      RationalPoint<K> offset, scale;
      scale.fill(1);
      offset[axis] = Rational(sign, 2);
      scale[axis] = Rational(1, 2);
      EXPECT_EQ(half.degree, net.degree);
      EXPECT_TRUE(encloses<K>(half, exact_bernstein::compose<K>(f, offset, scale)));
      EXPECT_LT(half.radius, 0x1p-48 * largest_coefficient(net));
    }
  }
}

TYPED_TEST(BernsteinOf, RadiusHoldsAfterManyHalvings) {
  constexpr int K = TypeParam::value;
  std::mt19937_64 generator(5);
  auto net = random_net<K>(degrees<K>(), 2);
  const auto f = exact_bernstein::polynomial<K>(net);
  RationalPoint<K> offset, scale;
  scale.fill(1);
  for (int round = 0; round < 20; ++round) {
    const int axis = static_cast<int>(generator() % K);
    const bool up = generator() % 2;
    Bernstein<K> lower, upper;
    halve(net, axis, &lower, &upper);
    net = up ? upper : lower;
    scale[axis] /= 2;
    offset[axis] += up ? scale[axis] : Rational(-scale[axis]);
  }
  EXPECT_TRUE(encloses<K>(net, exact_bernstein::compose<K>(f, offset, scale)));
}

TYPED_TEST(BernsteinOf, DerivativeIsThePolynomialsDerivative) {
  constexpr int K = TypeParam::value;
  const auto net = random_net<K>(degrees<K>(), 4);
  const auto f = exact_bernstein::polynomial<K>(net);
  for (int axis = 0; axis < K; ++axis) {
    Bernstein<K> derivative;
    differentiate(net, axis, &derivative);
    EXPECT_EQ(derivative.degree[axis], net.degree[axis] - 1);
    EXPECT_TRUE(encloses<K>(derivative, f.derivative(axis)));
    EXPECT_LT(derivative.radius, 0x1p-48 * largest_coefficient(net));
  }
}

TYPED_TEST(BernsteinOf, OperationsCarryTheRadiusAlong) {
  // Coefficients of the net off by the whole radius, in opposite directions.
  constexpr int K = TypeParam::value;
  auto net = random_net<K>(degrees<K>(), 6);
  const auto f = exact_bernstein::polynomial<K>(net);
  for (std::size_t i = 0; i < net.b.size(); ++i) net.b[i] += i % 2 ? 0x1p-20 : -0x1p-20;
  net.radius = 0x1p-20 + 0x1p-50;
  ASSERT_TRUE(encloses<K>(net, f));
  for (int axis = 0; axis < K; ++axis) {
    Bernstein<K> out, other;
    differentiate(net, axis, &out);
    EXPECT_TRUE(encloses<K>(out, f.derivative(axis)));
    elevate(net, axis, &out);
    EXPECT_TRUE(encloses<K>(out, f));
    multiply_by_coordinate(net, axis, &out);
    EXPECT_EQ(out.degree[axis], net.degree[axis] + 1);
    EXPECT_TRUE(encloses<K>(out, f * Polynomial<K>::variable(axis)));
    halve(net, axis, &out, &other);
    RationalPoint<K> offset, scale;
    scale.fill(1);
    offset[axis] = Rational(-1, 2);
    scale[axis] = Rational(1, 2);
    EXPECT_TRUE(encloses<K>(out, exact_bernstein::compose<K>(f, offset, scale)));
  }
}

TYPED_TEST(BernsteinOf, DerivativeOfDegreeZeroIsZero) {
  constexpr int K = TypeParam::value;
  auto degree = degrees<K>();
  degree[K - 1] = 0;
  auto net = random_net<K>(degree, 7);
  net.radius = 1;  // of the constant: its derivative is zero all the same
  Bernstein<K> derivative;
  differentiate(net, K - 1, &derivative);
  EXPECT_EQ(derivative.degree, degree);
  EXPECT_EQ(largest_coefficient(derivative), 0);
  EXPECT_EQ(derivative.radius, 0);
}

TYPED_TEST(BernsteinOf, ElevatedNetIsTheSamePolynomial) {
  constexpr int K = TypeParam::value;
  const auto net = random_net<K>(degrees<K>(), 8);
  const auto f = exact_bernstein::polynomial<K>(net);
  for (int axis = 0; axis < K; ++axis) {
    Bernstein<K> raised;
    elevate(net, axis, &raised);
    EXPECT_EQ(raised.degree[axis], net.degree[axis] + 1);
    EXPECT_TRUE(encloses<K>(raised, f));
    EXPECT_LT(raised.radius, 0x1p-48 * largest_coefficient(net));
  }
}

TYPED_TEST(BernsteinOf, CombinationIsTheCombination) {
  constexpr int K = TypeParam::value;
  const auto f = random_net<K>(degrees<K>(), 9), g = random_net<K>(degrees<K>(), 10);
  const auto exact = [](double c) { return Polynomial<K>::constant(Rational(c)); };
  for (const auto& [alpha, beta] :
       {std::pair{0.1, -3.7}, {1.0, 1.0}, {-1e10, 0.3}, {0.0, 2.0}, {1.0 / 3, 0.0}}) {
    Bernstein<K> sum;
    combine(alpha, f, beta, g, &sum);
    EXPECT_TRUE(encloses<K>(sum, exact(alpha) * exact_bernstein::polynomial<K>(f) +
                                     exact(beta) * exact_bernstein::polynomial<K>(g)));
    EXPECT_LT(sum.radius, 0x1p-48 * (std::fabs(alpha) + std::fabs(beta)));
  }
}

TYPED_TEST(BernsteinOf, CombinationCarriesBothRadiiAlong) {
  constexpr int K = TypeParam::value;
  auto f = random_net<K>(degrees<K>(), 11), g = random_net<K>(degrees<K>(), 12);
  const auto exact_f = exact_bernstein::polynomial<K>(f);
  const auto exact_g = exact_bernstein::polynomial<K>(g);
  for (double& b : f.b) b += 0x1p-20;
  for (double& b : g.b) b -= 0x1p-30;
  f.radius = 0x1.00001p-20;
  g.radius = 0x1.00001p-30;
  Bernstein<K> sum;
  combine(2.0, f, -512.0, g, &sum);
  EXPECT_TRUE(encloses<K>(
      sum, Polynomial<K>::constant(2) * exact_f - Polynomial<K>::constant(512) * exact_g));
}

TYPED_TEST(BernsteinOf, VariationIsTheLargestStepAlongAnAxis) {
  constexpr int K = TypeParam::value;
  const auto net = random_net<K>(degrees<K>(), 13);
  double largest = 0;
  for (const double b : net.b) largest = std::max(largest, std::fabs(b));
  EXPECT_EQ(largest_coefficient(net), largest);
  for (int axis = 0; axis < K; ++axis) {
    int stride = 1;
    for (int i = axis + 1; i < K; ++i) stride *= net.degree[i] + 1;
    double step = 0;
    for (int i = 0; i + stride < net.size(); ++i)
      if (i / stride % (net.degree[axis] + 1) < net.degree[axis])
        step = std::max(step, std::fabs(net.b[i + stride] - net.b[i]));
    EXPECT_EQ(variation(net, axis), step);
  }
}

TEST(Bernstein, HalvesOfASquareAreExact) {
  const Bernstein<1> square{{2}, {1, -1, 1}, 0};
  Bernstein<1> lower, upper;
  halve(square, 0, &lower, &upper);
  EXPECT_EQ(lower.b, (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(upper.b, (std::vector<double>{0, 0, 1}));
  Bernstein<1> derivative;
  differentiate(square, 0, &derivative);
  EXPECT_EQ(derivative.b, (std::vector<double>{-2, 2}));
}

TEST(Bernstein, SignIsProvedOnlyBeyondTheRadius) {
  Bernstein<2> net{{1, 1}, {1, 2, 3, 4}, 0.5};
  EXPECT_EQ(sign_on_cube(net), Sign::Positive);
  EXPECT_FALSE(drowned(net));
  net.radius = 1;  // the smallest coefficient may be zero
  EXPECT_EQ(sign_on_cube(net), std::nullopt);
  EXPECT_TRUE(drowned(net));
  for (double& b : net.b) b = -b;
  EXPECT_EQ(sign_on_cube(net), std::nullopt);
  net.radius = 0.99;
  EXPECT_EQ(sign_on_cube(net), Sign::Negative);
}

TEST(Bernstein, BothSignsBeyondTheRadiusAreNotDrowned) {
  Bernstein<1> net{{2}, {-1, 0, 1}, 0.5};
  EXPECT_EQ(sign_on_cube(net), std::nullopt);
  EXPECT_FALSE(drowned(net));
  net.radius = 1;
  EXPECT_TRUE(drowned(net));
}

TEST(Bernstein, InfiniteAndNanRadiusClaimNothing) {
  for (const double radius :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const Bernstein<1> net{{1}, {1e300, 1e300}, radius};
    EXPECT_EQ(sign_on_cube(net), std::nullopt);
    EXPECT_TRUE(drowned(net));
    Bernstein<1> lower, upper;
    halve(net, 0, &lower, &upper);
    EXPECT_EQ(sign_on_cube(upper), std::nullopt);
    differentiate(Bernstein<1>{{1}, {1, 2}, radius}, 0, &lower);
    EXPECT_EQ(sign_on_cube(lower), std::nullopt);
    combine(1.0, net, 1.0, net, &lower);
    EXPECT_EQ(sign_on_cube(lower), std::nullopt);
  }
}

TEST(Bernstein, OverflowInACombinationClaimsNothing) {
  const Bernstein<1> net{{1}, {1e308, 1e308}, 0};
  Bernstein<1> sum;
  combine(10.0, net, 0.0, net, &sum);
  EXPECT_EQ(sign_on_cube(sum), std::nullopt);
}

}  // namespace
}  // namespace encase
