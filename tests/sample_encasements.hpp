// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "encase/encasement.hpp"

/// Small encasements made by hand, for tests of what reads encasements.
namespace encase::sample {

inline Polynomial<2> polynomial(std::vector<Polynomial<2>::Term> terms) {
  return Polynomial<2>::from_terms(std::move(terms));
}

inline Region square() {
  return make_region(Rational(-1), Rational(1), Rational(-1), Rational(1)).value();
}

inline Line line(double a, double b, double c) {
  Line line;
  line.normal = {a, b};
  line.offset = c;
  return line;
}

inline Vertex corner(int line_in, int line_out, double x, double y) {
  Vertex vertex;
  vertex.line_in = line_in;
  vertex.line_out = line_out;
  vertex.point = {x, y};
  return vertex;
}

/// The circle x^2 + y^2 = 1/2 and the line y = x/5 + 1/20 in [-1,1]^2, which meet twice. Cut at
/// x = 1/16, and the right part at y = 9/10, so that the left cell has a T-junction.
///
///     +------+--------+
///     |      |   2    |
///     |      +--------+
///     |  0   |   1    |
///     +------+--------+
inline Encasement circle_and_line() {
  Encasement e;
  e.outcome = Outcome::Certified;
  e.input = {
      {"circle", polynomial({{{2, 0}, 1}, {{0, 2}, 1}, {{0, 0}, Rational(-1, 2)}})},
      {"line", polynomial({{{0, 1}, 1}, {{1, 0}, Rational(-1, 5)}, {{0, 0}, Rational(-1, 20)}})}};
  e.curves = {{e.input[0].name, e.input[0].function.polynomial(), {0}},
              {e.input[1].name, e.input[1].function.polynomial(), {1}}};
  e.region = square();
  e.region_used = e.region;
  e.lines = {line(0, -1, -1), line(1, 0, -1),      line(0, 1, -1),
             line(-1, 0, -1), line(1, 0, -0.0625), line(0, 1, -0.9)};
  e.line_crossings = {{1, 1, 0.2, 0.3},
                      {3, 1, -0.2, -0.1},
                      {4, 0, 0.7, 0.71},
                      {4, 0, -0.71, -0.7},
                      {4, 1, 0.06, 0.07}};
  Crossing right;
  right.curves = {0, 1};
  right.box = {{0.681, 0.185}, {0.683, 0.187}};
  right.point = {0.68209072, 0.18641814};
  right.cell = 1;
  Crossing left;
  left.curves = {0, 1};
  left.box = {{-0.702, -0.091}, {-0.701, -0.09}};
  left.point = {-0.70132149, -0.0902643};
  left.cell = 0;
  e.crossings = {right, left};

  Cell zero;
  zero.state = CellState::Certified;
  zero.vertices = {corner(3, 0, -1, -1), corner(0, 4, 0.0625, -1), corner(4, 2, 0.0625, 1),
                   corner(2, 3, -1, 1)};
  zero.word = {3, 4, 2, 1};
  zero.branches = {{0, 3, 2}, {1, 4, 1}};
  zero.crossing = 1;
  zero.loop_certificates = {{0, {0, 0}, {0.0625, 0}}};
  zero.depth = 1;
  Cell one;
  one.state = CellState::Certified;
  one.vertices = {corner(4, 0, 0.0625, -1), corner(0, 1, 1, -1), corner(1, 5, 1, 0.9),
                  corner(5, 4, 0.0625, 0.9)};
  one.word = {0, 2, 4, 3};
  one.branches = {{0, 2, 3}, {1, 0, 4}};
  one.crossing = 0;
  one.depth = 2;
  Cell two;
  two.state = CellState::Certified;
  two.vertices = {corner(4, 5, 0.0625, 0.9), corner(5, 1, 1, 0.9), corner(1, 2, 1, 1),
                  corner(2, 4, 0.0625, 1)};
  two.depth = 2;
  e.cells = {zero, one, two};
  e.history = {{4, ~0, 1}, {5, ~1, ~2}};
  const Box<2> root{{-1, -1}, {1, 1}};
  e.crossing_covers = {{{0, 1}, root, {cover::kSplitX, 1, 0}}};
  const Box<2> center{{-0.03125, -0.03125}, {0.03125, 0.03125}};
  e.critical_covers = {{0, root, {0}}, {1, root, {cover::kExcluded}}};
  e.critical_regions = {{0, Sign::Negative, {center}}};
  e.statistics.splits = 2;
  e.seconds = 0.001;
  return e;
}

/// One curve in [-1,1]^2 (sides y = -1, x = 1, y = 1, x = -1) with one branch.
inline Encasement one_branch(Polynomial<2> curve, LineCrossing from, LineCrossing to) {
  Encasement e;
  e.outcome = Outcome::Certified;
  e.input = {{"c0", std::move(curve)}};
  e.curves = {{e.input[0].name, e.input[0].function.polynomial(), {0}}};
  e.region = square();
  e.region_used = e.region;
  e.lines = {line(0, -1, -1), line(1, 0, -1), line(0, 1, -1), line(-1, 0, -1)};
  e.line_crossings = {from, to};
  Cell cell;
  cell.state = CellState::Certified;
  cell.vertices = {corner(3, 0, -1, -1), corner(0, 1, 1, -1), corner(1, 2, 1, 1),
                   corner(2, 3, -1, 1)};
  cell.word = {0, 1};
  cell.branches = {{0, 0, 1}};
  e.cells = {cell};
  return e;
}

}  // namespace encase::sample
