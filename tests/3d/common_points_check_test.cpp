// SPDX-License-Identifier: MIT
//
// Common points of random triples beside those that others find.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "encase/common_points.hpp"
#include "random_triples.hpp"

namespace encase {
namespace {

CommonPoints certified(const std::array<Polynomial<3>, 3>& triple, const Polyhedron& region) {
  auto result = common_points(named(triple), region).value();
  EXPECT_EQ(result.outcome, Outcome::Certified);
  const Verification proof = verify(result);
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return result;
}

/// What PARI/GP prints when it runs a script; nothing where it is not installed.
std::string run_gp(const std::string& script) {
  const std::string file = testing::TempDir() + "encase_common_points.gp";
  std::ofstream(file) << script;
  FILE* pipe = popen(
      ("gp -q -f --default parisizemax=2000000000 '" + file + "' </dev/null 2>/dev/null").c_str(),
      "r");
  std::string output;
  if (!pipe) return output;
  char part[256];
  while (fgets(part, sizeof part, pipe)) output += part;
  pclose(pipe);
  std::remove(file.c_str());
  return output;
}

std::string for_gp(const Polynomial<3>& f) {
  std::string text = "0";
  for (const auto& term : f.terms())
    text += "+(" + term.coefficient.get_str() + ")*x^" + std::to_string(term.exponent[0]) + "*y^" +
            std::to_string(term.exponent[1]) + "*z^" + std::to_string(term.exponent[2]);
  return text;
}

/// By resultants: how many real solutions have x in [-1,1], how many there are, and bounds on the
/// other coordinates of all real ones.
struct Eliminated {
  int degree = 0;
  bool square_free = false;
  int between = 0;
  double reach_y = 0, reach_z = 0;
};

bool eliminate(const std::array<Polynomial<3>, 3>& triple, Eliminated* result) {
  // The points on which f and g, f and h, g and h agree in one unknown each are more than the
  // common ones, but not the points on which all three do.
  std::ostringstream script;
  script << "f=" << for_gp(triple[0]) << ";\ng=" << for_gp(triple[1])
         << ";\nh=" << for_gp(triple[2]) << ";\n"
         << "eliminant(u,v)={my(a=polresultant(f,g,u),b=polresultant(f,h,u),"
            "c=polresultant(g,h,u));gcd(polresultant(a,b,v),polresultant(a,c,v))};\n"
            "reach(e,v)=1+ceil(vecmax(concat([0],abs(polrootsreal(subst(e,v,'t))))));\n"
            "ex=subst(eliminant('z,'y),'x,'t);\n"
            "print(poldegree(ex),\" \",issquarefree(ex),\" \",polsturm(ex,[-1,1]),\" \","
            "reach(eliminant('z,'x),'y),\" \",reach(eliminant('y,'x),'z));\n";
  std::istringstream output(run_gp(script.str()));
  return static_cast<bool>(output >> result->degree >> result->square_free >> result->between >>
                           result->reach_y >> result->reach_z);
}

TEST(CommonPointsCheck, AsManyAsResultantsHave) {
  if (run_gp("print(6*7)").rfind("42", 0) != 0) GTEST_SKIP() << "PARI/GP is not installed";
  int total = 0;
  for (const int degree : {2, 3})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto triple = random_triple(degree, seed);
      Eliminated e;
      ASSERT_TRUE(eliminate(triple, &e)) << degree << ", " << seed;
      ASSERT_EQ(e.degree, degree * degree * degree);
      ASSERT_TRUE(e.square_free);
      // In a box with all solutions that have x in [-1,1].
      const Rational y = e.reach_y, z = e.reach_z;
      const auto all = certified(triple, make_box({-1, -y, -z}, {1, y, z}).value());
      int between = 0, in_cube = 0;
      for (const CommonPoint& c : all.points) {
        if (c.location != Location::Inside) continue;
        ++between;
        in_cube += std::fabs(c.point[1]) < 1 && std::fabs(c.point[2]) < 1;
      }
      EXPECT_EQ(between, e.between) << degree << ", " << seed;
      int inside = 0;
      for (const CommonPoint& c : certified(triple, cube(1)).points)
        inside += c.location == Location::Inside;
      EXPECT_EQ(inside, in_cube) << degree << ", " << seed;
      total += inside;
    }
  EXPECT_GT(total, 20);
}

/// A polynomial as a list of terms, evaluated one by one.
struct Terms {
  explicit Terms(const Polynomial<3>& f) {
    for (const auto& term : f.terms()) {
      exponents.push_back(term.exponent);
      coefficients.push_back(nearest_double(term.coefficient));
    }
  }
  /// The value and the gradient.
  std::array<double, 4> operator()(const Point<3>& p) const {
    std::array<std::array<double, 16>, 3> power;
    for (std::size_t i = 0; i < 3; ++i) {
      power[i][0] = 1;
      for (std::size_t k = 1; k < 16; ++k) power[i][k] = power[i][k - 1] * p[i];
    }
    std::array<double, 4> sum{};
    for (std::size_t t = 0; t < exponents.size(); ++t) {
      std::array<std::size_t, 3> e;
      for (std::size_t i = 0; i < 3; ++i) e[i] = static_cast<std::size_t>(exponents[t][i]);
      sum[0] += coefficients[t] * power[0][e[0]] * power[1][e[1]] * power[2][e[2]];
      for (std::size_t i = 0; i < 3; ++i) {
        if (e[i] == 0) continue;
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        sum[i + 1] += coefficients[t] * static_cast<double>(e[i]) * power[i][e[i] - 1] *
                      power[j][e[j]] * power[k][e[k]];
      }
    }
    return sum;
  }
  std::vector<Exponent<3>> exponents;
  std::vector<double> coefficients;
};

/// The determinant of three columns.
double determinant(const std::array<double, 3>& a, const std::array<double, 3>& b,
                   const std::array<double, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Newton's iteration from a grid of starting points; the zeros in [-1,1]^3 that it ends in.
std::vector<Point<3>> by_newton(const std::array<Polynomial<3>, 3>& triple, int grid) {
  const std::array<Terms, 3> f{Terms(triple[0]), Terms(triple[1]), Terms(triple[2])};
  std::vector<Point<3>> zeros;
  for (int start = 0; start < grid * grid * grid; ++start) {
    Point<3> p{};
    for (int i = 0, rest = start; i < 3; ++i, rest /= grid)
      p[static_cast<std::size_t>(i)] = -1 + (2 * (rest % grid) + 1.0) / grid;
    double size = 1;
    for (int step = 0; step < 30 && size > 1e-14 && size < 1e3; ++step) {
      std::array<double, 3> value;
      std::array<std::array<double, 3>, 3> column;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto v = f[i](p);
        value[i] = v[0];
        for (std::size_t k = 0; k < 3; ++k) column[k][i] = v[k + 1];
      }
      const double d = determinant(column[0], column[1], column[2]);
      const Point<3> move{determinant(value, column[1], column[2]) / d,
                          determinant(column[0], value, column[2]) / d,
                          determinant(column[0], column[1], value) / d};
      size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] -= move[k];
        size = std::max(size, std::fabs(move[k]));
      }
    }
    if (!(size < 1e-9)) continue;
    bool known = false;
    for (const Point<3>& z : zeros) {
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k) distance = std::max(distance, std::fabs(z[k] - p[k]));
      known = known || distance < 1e-8;
    }
    bool inside = true;
    for (const double c : p) inside = inside && std::fabs(c) < 1;
    if (inside && !known) zeros.push_back(p);
  }
  return zeros;
}

TEST(CommonPointsCheck, TheSameAsNewtonFindsFromADenseGrid) {
  std::size_t total = 0;
  for (const int degree : {2, 3, 4, 5})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto triple = random_triple(degree, seed);
      const auto result = certified(triple, cube(1));
      std::vector<Point<3>> ours;
      for (const CommonPoint& c : result.points)
        if (c.location == Location::Inside) ours.push_back(c.point);
      const std::vector<Point<3>> theirs = by_newton(triple, 16);
      EXPECT_EQ(ours.size(), theirs.size()) << degree << ", " << seed;
      for (const Point<3>& z : theirs) {
        double nearest = HUGE_VAL;
        for (const Point<3>& p : ours) {
          double distance = 0;
          for (std::size_t k = 0; k < 3; ++k) distance = std::max(distance, std::fabs(z[k] - p[k]));
          nearest = std::min(nearest, distance);
        }
        EXPECT_LT(nearest, 1e-9) << degree << ", " << seed;
      }
      total += ours.size();
    }
  EXPECT_GT(total, 150u);
}

}  // namespace
}  // namespace encase
