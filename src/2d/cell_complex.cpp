// SPDX-License-Identifier: MIT
#include "2d/cell_complex.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "common/segments.hpp"

namespace encase {
namespace {

/// What a vertex is made of; equal keys mean equal points, equal points may have several keys.
using Key = std::tuple<int, int, double>;

Key key_of(const Vertex& vertex) {
  if (vertex.line_in == vertex.line_out) return {vertex.line_in, vertex.line_in, vertex.parameter};
  return {std::min(vertex.line_in, vertex.line_out), std::max(vertex.line_in, vertex.line_out), 0};
}

bool meet_in_a_point(const std::vector<Line>& lines, const Vertex& vertex) {
  if (vertex.line_in == vertex.line_out) return true;
  const auto a = lines[vertex.line_in].exact(), b = lines[vertex.line_out].exact();
  return a[0] * b[1] != a[1] * b[0];
}

}  // namespace

RationalPoint<2> exact_point(const std::vector<Line>& lines, const Vertex& vertex) {
  if (vertex.line_in == vertex.line_out)
    return point_on_line(lines[vertex.line_in], Rational(vertex.parameter));
  return exact_meet(lines[vertex.line_in], lines[vertex.line_out]);
}

Result<CellComplex> make_cell_complex(const Encasement& encasement) {
  const std::vector<Line>& lines = encasement.lines;

  // Each key's exact point, computed once; then keys with equal points get one number.
  std::map<Key, int> numbers;
  std::vector<RationalPoint<2>> points;
  std::vector<Key> keys;
  for (std::size_t k = 0; k < encasement.cells.size(); ++k) {
    const Cell& cell = encasement.cells[k];
    if (cell.vertices.size() < 3)
      return Error{Error::Code::Internal, "cell " + std::to_string(k) + " is not a polygon"};
    for (const Vertex& vertex : cell.vertices) {
      const auto [entry, is_new] =
          numbers.try_emplace(key_of(vertex), static_cast<int>(keys.size()));
      if (!is_new) continue;
      if (!meet_in_a_point(lines, vertex))
        return Error{Error::Code::Internal,
                     "neighbouring edges of cell " + std::to_string(k) + " are parallel"};
      keys.push_back(entry->first);
      points.push_back(exact_point(lines, vertex));
    }
  }
  std::vector<int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return points[a] < points[b]; });
  CellComplex complex;
  std::vector<int> number(keys.size());
  for (const int k : order) {
    if (complex.exact.empty() || complex.exact.back() != points[k]) {
      complex.exact.push_back(points[k]);
      complex.points.push_back({nearest_double(points[k][0]), nearest_double(points[k][1])});
    }
    number[k] = static_cast<int>(complex.exact.size()) - 1;
  }

  // The vertices on each line in ascending order: by number, since points are in lexicographic
  // order and along a line that order is monotone. Both cells at a piece of an edge know its line,
  // so a vertex within an edge of one is on this line in the other's account too.
  std::vector<std::vector<int>> on_line(lines.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    on_line[std::get<0>(keys[k])].push_back(number[k]);
    on_line[std::get<1>(keys[k])].push_back(number[k]);
  }
  for (std::vector<int>& here : on_line) {
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
  }

  for (const Cell& cell : encasement.cells) {
    std::vector<int> loop, on;
    const std::size_t size = cell.vertices.size();
    for (std::size_t k = 0; k < size; ++k) {
      const int from = number[numbers.at(key_of(cell.vertices[k]))];
      const int to = number[numbers.at(key_of(cell.vertices[(k + 1) % size]))];
      loop.push_back(from);
      const std::vector<int>& here = on_line[cell.vertices[k].line_out];
      const auto first = std::upper_bound(here.begin(), here.end(), std::min(from, to));
      const auto last = std::lower_bound(here.begin(), here.end(), std::max(from, to));
      if (first < last && from < to)
        loop.insert(loop.end(), first, last);
      else if (first < last)
        loop.insert(loop.end(), std::make_reverse_iterator(last),
                    std::make_reverse_iterator(first));
      on.resize(loop.size(), cell.vertices[k].line_out);
    }
    complex.cells.push_back(std::move(loop));
    complex.lines.push_back(std::move(on));
  }
  return complex;
}

}  // namespace encase
