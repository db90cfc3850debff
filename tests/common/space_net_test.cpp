// SPDX-License-Identifier: MIT
#include "common/space_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/random_polynomials.hpp"
#include "common/space_roots.hpp"
#include "exact_bernstein.hpp"

namespace encase {
namespace {

using Random = std::mt19937_64;

Polynomial<3> random_polynomial(int degree, Random& random) {
  std::vector<Polynomial<3>::Term> terms;
  for (const auto& e : dense_exponents<3>(degree))
    terms.push_back({e, Rational(symmetric_random(random))});
  return Polynomial<3>::from_terms(std::move(terms));
}

/// Rows for one net.
struct alignas(64) Rows {
  std::array<double, SpaceNet::kMaxCount * SpaceNet::kMaxCount * SpaceNet::kMaxCount> rows{};
};

/// The net as one of the general kind.
Bernstein<3> general(const SpaceNet& net, const std::array<int, 3>& order) {
  Bernstein<3> result;
  const int n = net.count;
  result.degree = {n - 1, n - 1, n - 1};
  result.radius = net.radius;
  result.b.resize(static_cast<std::size_t>(n * n * n));
  std::array<int, 3> index{};
  for (index[0] = 0; index[0] < n; ++index[0])
    for (index[1] = 0; index[1] < n; ++index[1])
      for (index[2] = 0; index[2] < n; ++index[2])
        result.b[static_cast<std::size_t>((index[0] * n + index[1]) * n + index[2])] =
            net.rows[SpaceNet::lanes(n) * (index[order[0]] * n + index[order[1]]) +
                     index[order[2]]];
  return result;
}

/// De Casteljau's algorithm at 1/2 along one axis of n x n x n coefficients, exactly: one half.
std::vector<Rational> half_of(std::vector<Rational> b, int n, int axis, bool upper) {
  const int stride = axis == 0 ? n * n : axis == 1 ? n : 1;
  for (int first = 0; first < n * n * n; ++first) {
    if (first / stride % n != 0) continue;
    const auto at = [&](int j) -> Rational& {
      return b[static_cast<std::size_t>(first + (upper ? j : n - 1 - j) * stride)];
    };
    for (int r = 1; r < n; ++r)
      for (int j = 0; j < n - r; ++j) at(j) = (at(j) + at(j + 1)) / 2;
  }
  return b;
}

TEST(SpaceNet, HalvesEncloseThePolynomial) {
  Random random(1);
  for (const int degree : {1, 2, 3, 4, 5, 6, 7, 8, 12, 15}) {
    // Exactly known: all of the radius is that of the halvings.
    Bernstein<3> net;
    net.degree = {degree, degree, degree};
    for (int k = 0; k < net.size(); ++k) net.b.push_back(symmetric_random(random));
    std::vector<Rational> exact(net.b.begin(), net.b.end());
    auto at_rows = std::make_unique<Rows>(), lower_rows = std::make_unique<Rows>(),
         upper_rows = std::make_unique<Rows>();
    SpaceNet at, lower, upper;
    at.rows = at_rows->rows.data();
    lower.rows = lower_rows->rows.data();
    upper.rows = upper_rows->rows.data();
    std::array<int, 3> order{2, 0, 1};
    copy(net, order, &at);
    for (int step = 0; step < (degree < 6 ? 12 : 3); ++step) {
      const int position = step % 3;
      const bool take_upper = random() % 2;
      halve(at, position, &lower, &upper);
      const int axis = order[static_cast<std::size_t>(position)];
      exact = half_of(std::move(exact), degree + 1, axis, take_upper);
      order = order_of_halves(order, position);
      const SpaceNet& half = take_upper ? upper : lower;
      const Bernstein<3> as_general = general(half, order);
      for (std::size_t k = 0; k < exact.size(); ++k)
        ASSERT_LE(abs(Rational(Rational(as_general.b[k]) - exact[k])), Rational(half.radius))
            << degree << ", " << step;
      const auto [lo, hi] = std::minmax_element(as_general.b.begin(), as_general.b.end());
      EXPECT_EQ(half.lo, *lo);
      EXPECT_EQ(half.hi, *hi);
      EXPECT_LT(half.radius, 3e-14);
      at = half;
      *at_rows = take_upper ? *upper_rows : *lower_rows;
      at.rows = at_rows->rows.data();
    }
  }
}

/// A system of random polynomials of given degrees on the box `center +- half`.
struct OnBox {
  OnBox(const std::array<int, 3>& degrees, const RationalPoint<3>& zero, double half,
        Random& random) {
    Kernel kernel;
    Box<3> box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[i] = -half;
      box.hi[i] = half;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      Polynomial<3> f = random_polynomial(degrees[k], random);
      f = f - Polynomial<3>::constant(f(zero));
      const FilteredFunction<3> filtered(f);
      Bernstein<3> net;
      filtered.expand(box, degrees[k], 53, kernel, &net);
      system.nets[k].rows = rows[k].rows.data();
      copy(net, system.order, &system.nets[k]);
      const Rational h(half);
      exact[k] = exact_bernstein::compose<3>(
          Polynomial<3>::constant(1 / Rational(filtered.scale())) * f, {0, 0, 0}, {h, h, h});
    }
  }
  std::array<Rows, 3> rows;
  SpaceSystem system;
  std::array<Polynomial<3>, 3> exact;  ///< in the coordinates of the box
};

RationalPoint<3> random_point(Random& random) {
  RationalPoint<3> p;
  for (Rational& c : p) c = Rational(static_cast<int>(random() % 201) - 100, 100);
  return p;
}

TEST(SpaceNet, VerdictsAreTrue) {
  Random random(2);
  int contractions = 0, narrowed = 0;
  for (int round = 0; round < 120; ++round) {
    const int d = 1 + round % 4, e = round % 3 == 0 ? d : 1 + round % 10;
    const double half = std::ldexp(1.0, -static_cast<int>(random() % 8));
    RationalPoint<3> zero = random_point(random);  // in the coordinates of the box
    RationalPoint<3> there;
    for (std::size_t i = 0; i < 3; ++i) there[i] = zero[i] * Rational(half);
    const OnBox on_box({d, d, e}, there, half, random);
    SpaceVerdict verdict;
    test_system(on_box.system, SpaceRoots::kQuality, &verdict);
    ASSERT_FALSE(verdict.excluded) << round;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(Rational(verdict.zeros.lo[i]), zero[i]);
      EXPECT_GE(Rational(verdict.zeros.hi[i]), zero[i]);
      narrowed += verdict.zeros.hi[i] - verdict.zeros.lo[i] < 1;
    }
    if (!verdict.contracts) continue;
    ++contractions;
    // |Y J - I| <= E at random points, exactly.
    const Contraction<3>& c = verdict.contraction;
    for (int sample = 0; sample < 5; ++sample) {
      const RationalPoint<3> p = random_point(random);
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) {
          Rational sum = i == j ? -1 : 0;
          for (std::size_t k = 0; k < 3; ++k)
            sum += Rational(c.preconditioner[i][k]) *
                   on_box.exact[k].derivative(static_cast<int>(j))(p);
          EXPECT_LE(abs(sum), Rational(c.bound[i][j])) << round;
        }
    }
  }
  EXPECT_GT(contractions, 20);
  EXPECT_GT(narrowed, 100);
}

/// a[0] + a[1] s_0 + a[2] s_1 + a[3] s_2, in few bits, as a net of degree 1 without an error.
Bernstein<3> linear_net(const std::array<double, 4>& a) {
  Bernstein<3> net;
  net.degree = {1, 1, 1};
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) net.b.push_back(a[0] + a[1] * x + a[2] * y + a[3] * z);
  return net;
}

TEST(SpaceNet, ClaimsHoldForLinearSystems) {
  // What is left is nothing but rounding: an error bound that is forgotten would show.
  Random random(3);
  int tested = 0;
  for (int round = 0; round < 2000; ++round) {
    std::array<Rows, 3> rows;
    SpaceSystem system;
    std::array<std::array<double, 4>, 3> a;
    for (std::size_t k = 0; k < 3; ++k) {
      for (double& c : a[k])
        c = std::ldexp(std::floor(std::ldexp(symmetric_random(random), 20)), -20);
      system.nets[k].rows = rows[k].rows.data();
      copy(linear_net(a[k]), system.order, &system.nets[k]);
    }
    // Cramer's rule: with the constants in place of a column.
    const auto determinant = [&](int replaced) {
      const auto at = [&](std::size_t k, int c) {
        return c == replaced ? Rational(-a[k][0]) : Rational(a[k][static_cast<std::size_t>(c) + 1]);
      };
      Rational sum = 0;
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        sum += at(0, c) * (at(1, d) * at(2, e) - at(1, e) * at(2, d));
      }
      return sum;
    };
    const Rational all = determinant(-1);
    if (all == 0) continue;
    RationalPoint<3> zero;
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      zero[static_cast<std::size_t>(i)] = determinant(i) / all;
      inside = inside && abs(zero[static_cast<std::size_t>(i)]) <= 1;
    }
    SpaceVerdict verdict;
    test_system(system, SpaceRoots::kQuality, &verdict);
    EXPECT_EQ(verdict.excluded, !inside);
    if (!inside) continue;
    ++tested;
    ASSERT_TRUE(verdict.contracts);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(Rational(verdict.zeros.lo[i]), zero[i]);
      EXPECT_GE(Rational(verdict.zeros.hi[i]), zero[i]);
      EXPECT_LT(verdict.zeros.hi[i] - verdict.zeros.lo[i], 1e-8);
      for (std::size_t j = 0; j < 3; ++j) {
        Rational sum = i == j ? -1 : 0;
        for (std::size_t k = 0; k < 3; ++k)
          sum += Rational(verdict.contraction.preconditioner[i][k]) * Rational(a[k][j + 1]);
        EXPECT_LE(abs(sum), Rational(verdict.contraction.bound[i][j]));
      }
    }
  }
  EXPECT_GT(tested, 50);
}

TEST(PreciseSpacePolynomial, ErrorBoundsHold) {
  Random random(4);
  for (int round = 0; round < 60; ++round) {
    const int degree = 1 + round % 9;
    Polynomial<3> f = random_polynomial(degree, random);
    if (round % 2)  // coefficients that are no doubles
      f = f * Polynomial<3>::constant(Rational(1, 3));
    const FilteredPolynomial<3> filtered(f);
    Point<3> p, magnitude;
    RationalPoint<3> exact;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = 2 * symmetric_random(random);
      exact[i] = p[i];
      magnitude[i] = std::fabs(p[i]);
    }
    // Near a zero: the constant term is changed.
    const FilteredPolynomial<3> near_zero(
        f - Polynomial<3>::constant(round % 3 ? Rational(f(exact)) : Rational(0)));
    for (const FilteredPolynomial<3>* g : {&filtered, &near_zero}) {
      const auto v = PreciseSpacePolynomial(*g).value(p, g->absolute(magnitude));
      const Rational value = g->exact()(exact) / Rational(g->scale());
      EXPECT_LE(abs(Rational(v.value) - value), Rational(v.error)) << round;
      EXPECT_LE(v.error, 0x1p-52 * std::fabs(v.value) + 1e-24);
    }
  }
}

}  // namespace
}  // namespace encase
