// SPDX-License-Identifier: MIT
#include "2d/cell_parts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/segments.hpp"
#include "common/union_find.hpp"

namespace encase {
namespace {

/// An edge of a cell with all its collinear parts, counter-clockwise.
struct Edge {
  int line = -1;
  int line_before = -1;    ///< that of the edge before, which it meets where it begins
  bool ascending = false;  ///< the line's parameter grows along it
  /// Places in the cell's word, which has no more than four.
  std::array<int, 4> entry{};
  int entries = 0;
  int first() const { return entry[0]; }
  int last() const { return entry[static_cast<std::size_t>(entries) - 1]; }
};

class Maker {
 public:
  explicit Maker(const Encasement& encasement) : e_(encasement) {}

  Result<CellParts> run() {
    if (check_indices() && sort_lines() && cut_cells() && walk_history()) {
      number_regions();
      return std::move(parts_);
    }
    return Error{Error::Code::Internal, "the encasement's parts do not fit together: " + fault_};
  }

 private:
  bool fail(const std::string& fault) {
    fault_ = fault;
    return false;
  }
  static std::string name(std::size_t cell) { return "cell " + std::to_string(cell); }

  bool check_indices() {
    const auto in = [](int index, const auto& list) {
      return index >= 0 && index < static_cast<int>(list.size());
    };
    const int sides = e_.region_used.side_count();
    if (sides < 3 || static_cast<int>(e_.lines.size()) < sides) return fail("a side has no line");
    for (const Line& line : e_.lines)
      if (!std::isfinite(line.normal[0]) || !std::isfinite(line.normal[1]) ||
          !std::isfinite(line.offset) || (line.normal[0] == 0 && line.normal[1] == 0))
        return fail("a line is none");
    for (const LineCrossing& c : e_.line_crossings)
      if (!in(c.line, e_.lines) || !in(c.curve, e_.curves) || !std::isfinite(c.lo) ||
          !std::isfinite(c.hi) || !(c.lo < c.hi))
        return fail("a line crossing names no line, no curve or no interval");
    for (std::size_t k = 0; k < e_.cells.size(); ++k) {
      const Cell& cell = e_.cells[k];
      bool right = cell.vertices.size() >= 3;
      for (const Vertex& v : cell.vertices)
        right = right && in(v.line_in, e_.lines) && in(v.line_out, e_.lines);
      for (const int c : cell.word) right = right && in(c, e_.line_crossings);
      for (const Branch& b : cell.branches)
        right = right && in(b.curve, e_.curves) && in(b.from, e_.line_crossings) &&
                in(b.to, e_.line_crossings);
      right = right &&
              (cell.crossing == -1 || (in(cell.crossing, e_.crossings) &&
                                       e_.crossings[cell.crossing].cell == static_cast<int>(k)));
      if (!right) return fail(name(k) + " names what does not exist");
    }
    return true;
  }

  bool sort_lines() {
    parts_.on_line.resize(e_.lines.size());
    rank_.resize(e_.line_crossings.size());
    std::vector<std::size_t> count(e_.lines.size(), 0);
    for (const LineCrossing& c : e_.line_crossings) ++count[c.line];
    for (std::size_t k = 0; k < e_.lines.size(); ++k) parts_.on_line[k].reserve(count[k]);
    for (std::size_t k = 0; k < e_.line_crossings.size(); ++k)
      parts_.on_line[e_.line_crossings[k].line].push_back(static_cast<int>(k));
    first_gap_.push_back(0);
    for (std::vector<int>& here : parts_.on_line) {
      std::sort(here.begin(), here.end(), [&](int a, int b) {
        const LineCrossing &p = e_.line_crossings[a], &q = e_.line_crossings[b];
        return std::pair(p.lo, p.hi) < std::pair(q.lo, q.hi);
      });
      for (std::size_t k = 0; k < here.size(); ++k) {
        rank_[here[k]] = static_cast<int>(k);
        if (k > 0 && !(e_.line_crossings[here[k - 1]].hi <= e_.line_crossings[here[k]].lo))
          return fail("line crossings overlap");
      }
      first_gap_.push_back(first_gap_.back() + static_cast<int>(here.size()) + 1);
    }
    return true;
  }

  /// Makes the pieces of each cell, from the order of its word alone.
  bool cut_cells() {
    for (std::size_t k = 0; k < e_.cells.size(); ++k) {
      const Cell& cell = e_.cells[k];
      const std::size_t size = cell.word.size();
      if (size > 4 || size % 2 != 0 || cell.branches.size() != size / 2)
        return fail("the word of " + name(k) + " is not that of its branches");
      for (const int c : cell.word) {
        const int ends = static_cast<int>(
            std::count_if(cell.branches.begin(), cell.branches.end(), [&](const Branch& b) {
              return b.curve == e_.line_crossings[c].curve && b.from != b.to &&
                     (b.from == c || b.to == c);
            }));
        if (ends != 1) return fail("the word of " + name(k) + " is not that of its branches");
      }
      if (size == 4 && cell.branches[0].curve == cell.branches[1].curve)
        return fail(name(k) + " has two branches of one curve");
      const bool cross = branches_cross(e_, cell);
      if (cross != (cell.crossing >= 0))
        return fail(name(k) + " names a crossing without branches that cross, or the reverse");
      std::array<int, 4> behind{-1, -1, -1, -1};
      int between = -1;  // the piece between two branches that do not cross
      for (std::size_t i = 0; i < std::max<std::size_t>(size, 1); ++i) {
        const bool is_between = size == 4 && !cross &&
                                e_.line_crossings[cell.word[i]].curve !=
                                    e_.line_crossings[cell.word[(i + 1) % size]].curve;
        if (is_between && between >= 0) {
          behind[i] = between;
          continue;
        }
        behind[i] = static_cast<int>(parts_.pieces.size());
        if (is_between) between = behind[i];
        parts_.pieces.push_back({static_cast<int>(k), static_cast<int>(i), -1});
      }
      parts_.piece_behind.push_back(behind);
    }
    return true;
  }

  /// Joins pieces with the gaps that they meet, cell by cell. The history tells on which side of
  /// each line a cell lies; each line cuts one polygon.
  bool walk_history() {
    joined_ = UnionFind(parts_.pieces.size() + static_cast<std::size_t>(first_gap_.back()));
    positive_.assign(e_.lines.size(), false);
    std::vector<bool> line_used(e_.lines.size(), false), cell_seen(e_.cells.size(), false);
    for (int k = 0; k < e_.region_used.side_count(); ++k) line_used[k] = true;
    struct Step {
      int child;
      int line;
      bool positive;
    };
    std::vector<Step> stack = {{e_.history.empty() ? ~0 : 0, -1, false}};
    std::size_t seen = 0;
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      if (step.line >= 0) positive_[step.line] = step.positive;
      if (step.child >= 0) {
        if (step.child >= static_cast<int>(e_.history.size())) return fail("a split is missing");
        const Split& split = e_.history[step.child];
        if (split.line < 0 || split.line >= static_cast<int>(e_.lines.size()) ||
            line_used[split.line])
          return fail("a split has no line of its own");
        line_used[split.line] = true;
        stack.push_back({split.negative, split.line, false});
        stack.push_back({split.positive, split.line, true});
        continue;
      }
      const auto cell = static_cast<std::size_t>(~step.child);
      if (cell >= e_.cells.size() || cell_seen[cell]) return fail("a cell has no place of its own");
      cell_seen[cell] = true;
      ++seen;
      if (!join_along(cell)) return false;
    }
    return seen == e_.cells.size() || fail("a cell is not in the history");
  }

  /// The edges of a cell with their entries, which must follow each other as in its word.
  bool edges_of(std::size_t k) {
    const Cell& cell = e_.cells[k];
    const int size = static_cast<int>(cell.word.size());
    edges_.clear();
    bool right = true;
    int found = 0, last = -1;  // entries
    for (const Vertex& v : cell.vertices) {
      if (v.line_in == v.line_out) continue;
      Edge& edge = edges_.emplace_back();
      edge.line = v.line_out;
      edge.line_before = v.line_in;
      edge.ascending = parameter_grows(e_.lines[edge.line], positive_[edge.line]);
      for (int i = 0; i < size; ++i)
        if (e_.line_crossings[cell.word[i]].line == edge.line) edge.entry[edge.entries++] = i;
      std::sort(edge.entry.begin(), edge.entry.begin() + edge.entries, [&](int a, int b) {
        return (rank_[cell.word[a]] < rank_[cell.word[b]]) == edge.ascending;
      });
      for (int i = 0; i < edge.entries; ++i) {
        right = right && (found++ == 0 || edge.entry[i] == (last + 1) % size);
        last = edge.entry[i];
      }
    }
    right = right && edges_.size() >= 3 && found == size;
    return right || fail("the word of " + name(k) + " does not follow its boundary");
  }

  bool join_along(std::size_t k) {
    const Cell& cell = e_.cells[k];
    const int size = static_cast<int>(cell.word.size());
    if (!edges_of(k)) return false;
    int last = 0;  // the entry passed last
    for (const Edge& edge : edges_)
      if (edge.entries > 0) last = edge.last();
    for (const Edge& edge : edges_) {
      if (edge.entries == 0) {
        const int gap = gap_at(edge.line, edge.line_before);
        if (gap < 0) return fail("neighbouring edges of " + name(k) + " are parallel");
        join(k, last, edge.line, gap);
        continue;
      }
      join(k, (edge.first() + size - 1) % size, edge.line,
           rank_[cell.word[edge.first()]] + (edge.ascending ? 0 : 1));
      for (int i = 0; i < edge.entries; ++i) {
        const int rank = rank_[cell.word[edge.entry[i]]];
        if (i > 0 && rank - rank_[cell.word[last]] != (edge.ascending ? 1 : -1))
          return fail("the word of " + name(k) + " lacks a line crossing");
        last = edge.entry[i];
        join(k, last, edge.line, rank + (edge.ascending ? 1 : 0));
      }
    }
    return true;
  }

  void join(std::size_t cell, int entry, int line, int gap) {
    joined_.join(parts_.piece_behind[cell][entry],
                 static_cast<int>(parts_.pieces.size()) + first_gap_[line] + gap);
  }

  static bool are_parallel(const Line& first, const Line& second) {
    const auto a = first.exact(), b = second.exact();
    return a[0] * b[1] == a[1] * b[0];
  }

  /// The gap of a line in which it meets another line; -1 if they are parallel.
  int gap_at(int line, int other) const {
    const std::vector<int>& here = parts_.on_line[line];
    if (here.empty()) return 0;
    const Line &first = e_.lines[line], &second = e_.lines[other];
    const Interval near = meet(first, second)[parameter_axis(first)];
    // (Parallel lines meet in infinite intervals.)
    if (!(std::isfinite(near.lo) && std::isfinite(near.hi)) && are_parallel(first, second))
      return -1;
    const auto before = [&](int k) {
      const LineCrossing& c = e_.line_crossings[k];
      if (c.hi <= near.lo) return true;
      if (near.hi <= c.lo) return false;
      return comes_before(e_, c, exact_meet(first, second));
    };
    return static_cast<int>(std::partition_point(here.begin(), here.end(), before) - here.begin());
  }

  void number_regions() {
    std::vector<int> number(parts_.pieces.size() + static_cast<std::size_t>(first_gap_.back()), -1);
    const auto region = [&](std::size_t k) {
      int& n = number[joined_.find(static_cast<int>(k))];
      if (n < 0) n = parts_.regions++;
      return n;
    };
    for (std::size_t k = 0; k < parts_.pieces.size(); ++k)
      parts_.region_of_piece.push_back(region(k));
    parts_.region_of_gap.reserve(e_.lines.size());
    for (std::size_t line = 0; line < e_.lines.size(); ++line) {
      std::vector<int>& regions = parts_.region_of_gap.emplace_back();
      regions.reserve(parts_.on_line[line].size() + 1);
      for (int gap = first_gap_[line]; gap < first_gap_[line + 1]; ++gap)
        regions.push_back(number[joined_.find(static_cast<int>(parts_.pieces.size()) + gap)]);
    }
  }

  const Encasement& e_;
  CellParts parts_;
  std::vector<int> rank_;       ///< of every line crossing on its line
  std::vector<int> first_gap_;  ///< of every line, in the numbers of all gaps
  std::vector<bool> positive_;  ///< for every line above the cell at hand, its side
  std::vector<Edge> edges_;     ///< of the cell at hand
  UnionFind joined_{0};         ///< pieces, then gaps
  std::string fault_;
};

}  // namespace

bool branches_cross(const Encasement& encasement, const Cell& cell) {
  if (cell.word.size() != 4) return false;
  const auto curve = [&](int k) { return encasement.line_crossings[cell.word[k]].curve; };
  return curve(0) == curve(2);
}

bool comes_before(const Encasement& encasement, const LineCrossing& crossing,
                  const RationalPoint<2>& point) {
  const Line& line = encasement.lines[crossing.line];
  const Rational& at = point[parameter_axis(line)];
  if (at >= crossing.hi) return true;
  if (at <= crossing.lo) return false;
  // The one root in the interval lies before the point if the sign has changed.
  const Function<2>& function = encasement.curves[crossing.curve].function;
  if (!function.is_polynomial()) {
    const FilteredFunction<2> f(function);
    Kernel kernel;
    return f.sign_at(point, kernel) != sign_on_line(f, line, crossing.lo, kernel);
  }
  const Polynomial<2>& f = function.polynomial();
  return sgn(f(point)) != sgn(f(point_on_line(line, Rational(crossing.lo))));
}

Result<CellParts> make_cell_parts(const Encasement& encasement) { return Maker(encasement).run(); }

}  // namespace encase
