// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "2d/cell_parts.hpp"
#include "common/expression_program.hpp"
#include "common/filtered_function.hpp"
#include "common/segments.hpp"
#include "encase/arrangement.hpp"

namespace encase {
namespace {

using Feature = Arrangement::Feature;

Feature vertex(int index) { return {Feature::Kind::Vertex, index}; }
Feature edge(int index) { return {Feature::Kind::Edge, index}; }
Feature face(int index) { return {Feature::Kind::Face, index}; }

RationalPoint<2> exact(const Point<2>& point) { return {Rational(point[0]), Rational(point[1])}; }
const RationalPoint<2>& exact(const RationalPoint<2>& point) { return point; }

/// Nothing where the sign of an expression is not proved.
std::optional<Sign> sign_at(const FilteredFunction<2>& f, const RationalPoint<2>& point,
                            Kernel& kernel) {
  const Sign sign = f.sign_at(point, kernel);
  if (f.is_polynomial() || sign != Sign::Zero) return sign;
  if (!f.is_expression()) return std::nullopt;
  // It may be zero provably.
  const ExpressionProgram<2> program(f.expression().exact());
  if (program.sign_at(point, kernel) == PointSign::Zero) return Sign::Zero;
  return std::nullopt;
}
std::optional<Sign> sign_at(const FilteredFunction<2>& f, const Point<2>& point, Kernel& kernel) {
  const auto v = f.evaluate(point, Kernel::kDoubleBits);
  if (std::fabs(v.value) > v.error) return v.value > 0 ? Sign::Positive : Sign::Negative;
  return sign_at(f, exact(point), kernel);
}

/// normal . x + offset in doubles where that is certain to have the right sign, else exactly.
Sign side_of(const Line& line, const Point<2>& point, Kernel& kernel) {
  if (!line.rational) {
    const double x = line.normal[0] * point[0], y = line.normal[1] * point[1];
    const double value = x + y + line.offset;
    const double error =
        0x1p-51 * (std::fabs(x) + std::fabs(y) + std::fabs(line.offset)) + 0x1p-1000;
    if (value > error) return Sign::Positive;
    if (value < -error) return Sign::Negative;
  }
  return side(line, point, kernel);
}
Sign side_of(const Line& line, const RationalPoint<2>& point, Kernel& kernel) {
  return side(line, point, kernel);
}

/// What lies where in a cell, by the signs of the polynomials of its curves: 0 negative, 1
/// positive.
struct CellTable {
  std::array<int, 2> curves{-1, -1};
  int faces[2][2] = {{-1, -1}, {-1, -1}};
  /// edges[i][s]: of curve i where the other curve has sign s.
  int edges[2][2] = {{-1, -1}, {-1, -1}};
  int vertex = -1;
};

int index_of(Sign sign) { return sign == Sign::Positive ? 1 : 0; }

}  // namespace

struct PointLocator::Tables {
  const Encasement* encasement;
  int outside;
  std::vector<FilteredFunction<2>> curves;
  std::vector<CellTable> cells;
  std::vector<int> vertex_at_corner;
  std::map<int, int> vertex_at_line_crossing;
  std::vector<std::vector<int>> on_side;  ///< line crossings of each side in the parameter's order
  std::vector<std::vector<int>> edges_on_side;  ///< and the edges between them, in that order

  template <class P>
  int cell_of(const P& point, Kernel& kernel) const;
  template <class P>
  Feature in_cell(int cell, const P& point, Kernel& kernel) const;
  Feature on_boundary(int side, const Feature& inside, const RationalPoint<2>& point) const;
  template <class P>
  Feature locate(const P& point) const;
};

PointLocator::PointLocator(const Encasement& e, const Arrangement& a) {
  auto tables = std::make_unique<Tables>();
  tables->encasement = &e;
  tables->outside = a.outside;
  for (const Curve& curve : e.curves) tables->curves.emplace_back(curve.function);

  tables->cells.resize(e.cells.size());
  for (std::size_t k = 0; k < e.cells.size(); ++k)
    for (std::size_t b = 0; b < e.cells[k].branches.size(); ++b)
      tables->cells[k].curves[b] = e.cells[k].branches[b].curve;
  for (const Arrangement::Piece& piece : a.pieces) {
    CellTable& cell = tables->cells[piece.cell];
    std::array<int, 2> at{0, 0};
    for (int i = 0; i < 2; ++i)
      if (cell.curves[i] >= 0) at[i] = index_of(a.faces[piece.face].signs[cell.curves[i]]);
    cell.faces[at[0]][at[1]] = piece.face;
  }
  for (std::size_t k = 0; k < a.edges.size(); ++k)
    for (const Arrangement::Strand& strand : a.edges[k].strands) {
      CellTable& cell = tables->cells[strand.cell];
      const int other = cell.curves[1 - strand.branch];
      // Both faces at the edge have this sign of the other curve.
      const int s = other < 0 ? 0 : index_of(a.faces[a.half_edges[2 * k].face].signs[other]);
      cell.edges[strand.branch][s] = static_cast<int>(k);
    }

  const int sides = e.region_used.side_count();
  tables->vertex_at_corner.resize(sides);
  tables->on_side.resize(sides);
  tables->edges_on_side.resize(sides);
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    const Arrangement::Vertex::Kind kind = a.vertices[v].kind;
    const int index = a.vertices[v].index;
    const int id = static_cast<int>(v);
    if (kind == Arrangement::Vertex::Kind::Corner) tables->vertex_at_corner[index] = id;
    if (kind == Arrangement::Vertex::Kind::OnBoundary) {
      tables->vertex_at_line_crossing[index] = id;
      tables->on_side[e.line_crossings[index].line].push_back(index);
    }
    if (kind == Arrangement::Vertex::Kind::Crossing)
      tables->cells[e.crossings[index].cell].vertex = id;
  }
  for (int k = 0; k < sides; ++k) {
    // Counter-clockwise from the corner where the side begins.
    std::vector<int>& edges = tables->edges_on_side[k];
    std::vector<int>& here = tables->on_side[k];
    int h = -1;
    for (const int out : a.around(tables->vertex_at_corner[k]))
      if (a.edges[Arrangement::edge_of(out)].side == k && a.half_edges[out].face != a.outside)
        h = out;
    while (h >= 0) {
      edges.push_back(Arrangement::edge_of(h));
      const int end = a.half_edges[Arrangement::twin(h)].origin;
      if (a.vertices[end].kind == Arrangement::Vertex::Kind::Corner) break;
      // Counter-clockwise around its end, what follows the way back goes on along the boundary.
      h = Arrangement::twin(a.half_edges[Arrangement::twin(h)].prev);
    }
    const auto before = [&](int p, int q) {
      return e.line_crossings[p].lo < e.line_crossings[q].lo;
    };
    std::sort(here.begin(), here.end(), before);
    const int axis = parameter_axis(e.lines[k]);
    if (e.region_used.corners[k][axis] > e.region_used.corners[(k + 1) % sides][axis])
      std::reverse(edges.begin(), edges.end());
  }
  tables_ = std::move(tables);
}

PointLocator::~PointLocator() = default;
PointLocator::PointLocator(PointLocator&&) noexcept = default;
PointLocator& PointLocator::operator=(PointLocator&&) noexcept = default;

/// A cell that holds a point of the region. On a splitting line the cells on both sides do.
template <class P>
int PointLocator::Tables::cell_of(const P& point, Kernel& kernel) const {
  if (encasement->history.empty()) return 0;
  int at = 0;
  while (at >= 0) {
    const Split& split = encasement->history[at];
    const bool positive = side_of(encasement->lines[split.line], point, kernel) == Sign::Positive;
    at = positive ? split.positive : split.negative;
  }
  return ~at;
}

template <class P>
Feature PointLocator::Tables::in_cell(int id, const P& point, Kernel& kernel) const {
  const CellTable& cell = cells[id];
  std::array<Sign, 2> signs{Sign::Negative, Sign::Negative};
  for (int i = 0; i < 2 && cell.curves[i] >= 0; ++i) {
    const std::optional<Sign> sign = sign_at(curves[cell.curves[i]], point, kernel);
    if (!sign) return {Feature::Kind::Undecided, -1};
    signs[i] = *sign;
  }
  if (signs[0] == Sign::Zero && signs[1] == Sign::Zero) return vertex(cell.vertex);
  for (int i = 0; i < 2; ++i)
    if (signs[i] == Sign::Zero) return edge(cell.edges[i][index_of(signs[1 - i])]);
  return face(cell.faces[index_of(signs[0])][index_of(signs[1])]);
}

/// `inside`: what the cell there says of a point on a side.
Feature PointLocator::Tables::on_boundary(int side, const Feature& inside,
                                          const RationalPoint<2>& point) const {
  const std::vector<int>& here = on_side[side];
  const Line& line = encasement->lines[side];
  const Rational& t = point[parameter_axis(line)];
  if (inside.kind == Feature::Kind::Edge)
    for (const int c : here) {
      const LineCrossing& crossing = encasement->line_crossings[c];
      if (crossing.lo < t && t < crossing.hi) return vertex(vertex_at_line_crossing.at(c));
    }
  for (int k : {side, (side + 1) % encasement->region_used.side_count()})
    if (point == encasement->region_used.corners[k]) return vertex(vertex_at_corner[k]);
  const auto before = [&](int c) {
    return comes_before(*encasement, encasement->line_crossings[c], point);
  };
  const auto gap = std::partition_point(here.begin(), here.end(), before) - here.begin();
  return edge(edges_on_side[side][gap]);
}

template <class P>
Feature PointLocator::Tables::locate(const P& point) const {
  Kernel kernel;
  int boundary = -1;
  for (int k = 0; k < encasement->region_used.side_count(); ++k) {
    const Sign where = side_of(encasement->lines[k], point, kernel);
    if (where == Sign::Positive) return face(outside);
    if (where == Sign::Zero) boundary = k;
  }
  const Feature inside = in_cell(cell_of(point, kernel), point, kernel);
  const bool is_known = inside.kind != Feature::Kind::Undecided;
  return boundary < 0 || !is_known ? inside : on_boundary(boundary, inside, exact(point));
}

Feature PointLocator::locate(const Point<2>& point) const {
  if (!std::isfinite(point[0]) || !std::isfinite(point[1])) return face(tables_->outside);
  return tables_->locate(point);
}

Feature PointLocator::locate(const RationalPoint<2>& point) const { return tables_->locate(point); }

}  // namespace encase
