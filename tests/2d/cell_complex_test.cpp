// SPDX-License-Identifier: MIT
#include "2d/cell_complex.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

Rational area(const CellComplex& complex, const std::vector<int>& cell) {
  Rational twice = 0;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const auto &p = complex.exact[cell[k]], &q = complex.exact[cell[(k + 1) % cell.size()]];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

/// Vertices - edges + cells, after checking that each directed edge occurs once.
int euler_characteristic(const CellComplex& complex) {
  std::set<std::pair<int, int>> directed, edges;
  std::set<int> vertices;
  for (const auto& cell : complex.cells)
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const int from = cell[k], to = cell[(k + 1) % cell.size()];
      EXPECT_TRUE(directed.emplace(from, to).second);
      edges.insert(std::minmax(from, to));
      vertices.insert(from);
    }
  EXPECT_EQ(vertices.size(), complex.exact.size());
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(complex.cells.size());
}

/// Four quadrants of [-1,1]^2 that meet in one point, which they name by three pairs of lines: the
/// left half is cut along y = 0, the right half along y = 2 x (its lower part) ... through (0, 0).
Encasement fan() {
  Encasement e;
  e.region = e.region_used = sample::square();
  e.lines = {sample::line(0, -1, -1), sample::line(1, 0, -1), sample::line(0, 1, -1),
             sample::line(-1, 0, -1), sample::line(1, 0, 0),  sample::line(0, 1, 0),
             sample::line(-1, 1, 0),  sample::line(1, 1, 0)};
  // Cut by x = 0; the left by y = 0; the right by y = x, its lower part by y = -x.
  const auto cell = [](std::vector<Vertex> vertices) {
    Cell c;
    c.vertices = std::move(vertices);
    return c;
  };
  e.cells = {
      cell({sample::corner(3, 0, -1, -1), sample::corner(0, 4, 0, -1), sample::corner(4, 5, 0, 0),
            sample::corner(5, 3, -1, 0)}),
      cell({sample::corner(3, 5, -1, 0), sample::corner(5, 4, 0, 0), sample::corner(4, 2, 0, 1),
            sample::corner(2, 3, -1, 1)}),
      cell({sample::corner(4, 6, 0, 0), sample::corner(6, 2, 1, 1), sample::corner(2, 4, 0, 1)}),
      cell({sample::corner(7, 1, 1, -1), sample::corner(1, 6, 1, 1), sample::corner(6, 7, 0, 0)}),
      cell({sample::corner(4, 0, 0, -1), sample::corner(0, 7, 1, -1), sample::corner(7, 4, 0, 0)})};
  return e;
}

TEST(CellComplex, InsertsTheJunctionIntoTheLongEdge) {
  const auto complex = make_cell_complex(sample::circle_and_line());
  ASSERT_TRUE(complex.ok());
  EXPECT_EQ(complex.value().exact.size(), 8u);
  EXPECT_EQ(complex.value().cells[0].size(), 5u);
  EXPECT_EQ(complex.value().cells[1].size(), 4u);
  EXPECT_EQ(euler_characteristic(complex.value()), 1);
}

TEST(CellComplex, KeepsTheAreaOfTheRegion) {
  for (const Encasement& e : {sample::circle_and_line(), fan()}) {
    const auto complex = make_cell_complex(e);
    ASSERT_TRUE(complex.ok());
    Rational sum = 0;
    for (const auto& cell : complex.value().cells) {
      EXPECT_GT(area(complex.value(), cell), 0);
      sum += area(complex.value(), cell);
    }
    EXPECT_EQ(sum, 4);
  }
}

TEST(CellComplex, KnowsAPointByAllItsLines) {
  const auto complex = make_cell_complex(fan());
  ASSERT_TRUE(complex.ok());
  EXPECT_EQ(complex.value().exact.size(), 8u);  // (0, 0) once
  EXPECT_EQ(euler_characteristic(complex.value()), 1);
}

TEST(CellComplex, KeepsCutsApartThatDoublesCannotTellFromACorner) {
  // The corner (1/16, 9/10 as a double) and a cut of the long edge one unit in the last place
  // above.
  Encasement e = sample::circle_and_line();
  Vertex cut = sample::corner(4, 4, 0.0625, 0.9);
  cut.parameter = std::nextafter(0.9, 1);
  e.cells[0].vertices.insert(e.cells[0].vertices.begin() + 2, cut);
  const auto complex = make_cell_complex(e);
  ASSERT_TRUE(complex.ok());
  EXPECT_EQ(complex.value().exact.size(), 9u);
  EXPECT_EQ(complex.value().cells[0].size(), 6u);
  EXPECT_EQ(complex.value().cells[2].size(), 5u);
  EXPECT_EQ(euler_characteristic(complex.value()), 1);
}

TEST(CellComplex, IsADiscForAComputedEncasement) {
  // (x^2 + y^2)^2 - x^3 + 3 x y^2 = 1/100 and 10 x^2 - 8 x y + 4 y^2 - 2 x + y = 1 meet six times.
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto c = [](const char* value) { return Polynomial<2>::constant(Rational(value)); };
  const std::vector<NamedCurve> curves = {
      {"clover", (x * x + y * y).power(2) - x.power(3) + c("3") * x * y * y - c("1/100")},
      {"ellipse", c("10") * x * x - c("8") * x * y + c("4") * y * y - c("2") * x + y - c("1")}};
  const auto region =
      make_region(Rational(-13, 10), Rational(13, 10), Rational(-13, 10), Rational(13, 10));
  const auto e = encase(curves, region.value());
  ASSERT_TRUE(e.ok());
  ASSERT_EQ(e.value().outcome, Outcome::Certified);
  ASSERT_GT(e.value().cells.size(), 3u);
  const auto complex = make_cell_complex(e.value());
  ASSERT_TRUE(complex.ok());
  EXPECT_EQ(euler_characteristic(complex.value()), 1);
  Rational sum = 0;
  for (const auto& cell : complex.value().cells) sum += area(complex.value(), cell);
  EXPECT_EQ(sum, Rational(169, 25));
}

TEST(CellComplex, RefusesWhatIsNoPolygon) {
  Encasement e = sample::circle_and_line();
  e.cells[2].vertices.resize(2);
  EXPECT_FALSE(make_cell_complex(e).ok());
  e = sample::circle_and_line();
  e.cells[0].vertices[0].line_out = 2;
  e.cells[0].vertices[0].line_in = 0;
  EXPECT_FALSE(make_cell_complex(e).ok());
}

}  // namespace
}  // namespace encase
