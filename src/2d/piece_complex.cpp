// SPDX-License-Identifier: MIT
#include "2d/piece_complex.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "2d/cell_complex.hpp"
#include "2d/cell_parts.hpp"

namespace encase {
namespace {

/// The points along a strand.
struct Path {
  int from = -1;  ///< the line crossing where it begins, or -1 for the cell's crossing
  int to = -1;    ///< and where it ends
  std::vector<int> points;
};

/// How far a point is from where a curve crosses a line, or a little less.
double distance_from(const LineCrossing& crossing, const Line& line, const Point<2>& p) {
  const double across = line.normal[0] * p[0] + line.normal[1] * p[1] + line.offset;
  const double along = p[parameter_axis(line)];
  return std::fabs(across) / std::hypot(line.normal[0], line.normal[1]) +
         std::max({crossing.lo - along, along - crossing.hi, 0.0});
}

class Maker {
 public:
  Maker(const Encasement& encasement, const Arrangement& arrangement,
        const std::vector<Polyline>& edges, CellComplex cells)
      : e_(encasement), a_(arrangement), edges_(edges), cells_(std::move(cells)) {}

  Result<PieceComplex> run() {
    result_.points = cells_.points;
    paths_.resize(e_.cells.size());
    at_line_crossing_.assign(e_.line_crossings.size(), -1);
    at_crossing_.assign(e_.crossings.size(), -1);
    for (std::size_t k = 0; k < a_.edges.size(); ++k)
      if (!cut_into_strands(k))
        return fail("the polyline along edge " + std::to_string(k) + " is too short");
    int cell = -1;
    for (const Arrangement::Piece& piece : a_.pieces) {
      if (piece.cell != cell && !cut_boundary(piece.cell))
        return fail("the word of cell " + std::to_string(piece.cell) +
                    " does not follow its boundary");
      cell = piece.cell;
      result_.pieces.push_back(polygon(piece));
    }
    return std::move(result_);
  }

 private:
  static Error fail(const std::string& fault) { return {Error::Code::Internal, fault}; }

  int add_point(const Point<2>& p) {
    result_.points.push_back(p);
    return static_cast<int>(result_.points.size()) - 1;
  }

  /// The end of a strand, which other strands share.
  int add_end(int cell, int line_crossing, const Point<2>& p) {
    int& id = line_crossing >= 0 ? at_line_crossing_[line_crossing]
                                 : at_crossing_[e_.cells[cell].crossing];
    if (id < 0) id = add_point(p);
    return id;
  }

  /// Cuts an edge's polyline where it goes from cell to cell: at its points nearest to there.
  bool cut_into_strands(std::size_t edge) {
    const std::vector<Arrangement::Strand>& strands = a_.edges[edge].strands;
    const Polyline& line = edges_[edge];
    if (strands.empty()) return true;
    if (line.size() < strands.size() + 1) return false;
    std::size_t first = 0;
    for (std::size_t s = 0; s < strands.size(); ++s) {
      const Arrangement::Strand& strand = strands[s];
      const std::size_t most = line.size() - (strands.size() - s);
      std::size_t last = most;
      if (s + 1 < strands.size()) {
        const LineCrossing& c = e_.line_crossings[strand.to];
        const auto distance = [&](const Point<2>& p) {
          return distance_from(c, e_.lines[c.line], p);
        };
        last = first + 1;
        double least = distance(line[last]);
        for (std::size_t k = last + 1; k <= most; ++k) {
          const double d = distance(line[k]);
          if (d < least) {
            least = d;
            last = k;
          }
        }
      }
      Path path{strand.from, strand.to, {add_end(strand.cell, strand.from, line[first])}};
      for (std::size_t k = first + 1; k < last; ++k) path.points.push_back(add_point(line[k]));
      path.points.push_back(add_end(strand.cell, strand.to, line[last]));
      paths_[strand.cell].push_back(std::move(path));
      first = last;
    }
    return true;
  }

  /// Finds the corners behind each entry of a cell's word.
  bool cut_boundary(int cell) {
    const std::vector<int>& loop = cells_.cells[cell];
    const std::vector<int>& word = e_.cells[cell].word;
    arcs_.assign(std::max<std::size_t>(word.size(), 1), {});
    std::vector<int> leading;  // before the first entry, so behind the last one
    std::size_t entry = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      (entry == 0 ? leading : arcs_[entry - 1]).push_back(loop[k]);
      const int line = cells_.lines[cell][k], axis = parameter_axis(e_.lines[line]);
      const RationalPoint<2>&from = cells_.exact[loop[k]],
            &to = cells_.exact[loop[(k + 1) % loop.size()]];
      const bool ascending = from[axis] < to[axis];
      while (entry < word.size() && e_.line_crossings[word[entry]].line == line &&
             comes_before(e_, e_.line_crossings[word[entry]], to) == ascending)
        ++entry;
    }
    arcs_.back().insert(arcs_.back().end(), leading.begin(), leading.end());
    return entry == word.size();
  }

  /// Appends the points from a line crossing into the cell, without the last one, and returns the
  /// line crossing at the other end, or -1 for the cell's crossing.
  int append_path(int cell, int from, std::vector<int>* polygon) const {
    const std::vector<Path>& paths = paths_[cell];
    const Path& path = *std::find_if(paths.begin(), paths.end(),
                                     [&](const Path& p) { return p.from == from || p.to == from; });
    if (path.from == from) {
      polygon->insert(polygon->end(), path.points.begin(), path.points.end() - 1);
      return path.to;
    }
    polygon->insert(polygon->end(), path.points.rbegin(), path.points.rend() - 1);
    return path.from;
  }

  std::vector<int> polygon(const Arrangement::Piece& piece) const {
    const Cell& cell = e_.cells[piece.cell];
    const std::size_t size = cell.word.size();
    if (size == 0) return arcs_[0];
    std::vector<int> points;
    if (cell.crossing >= 0) {
      // Along the boundary between two entries, to the crossing, and back to the first.
      std::vector<int> back;
      append_path(piece.cell, cell.word[piece.word], &back);
      points = arcs_[piece.word];
      append_path(piece.cell, cell.word[(piece.word + 1) % size], &points);
      points.push_back(at_crossing_[cell.crossing]);
      points.insert(points.end(), back.rbegin(), back.rend());
      return points;
    }
    // Along the boundary up to an entry, along its branch to the boundary, and so on.
    auto at = static_cast<std::size_t>(piece.word);
    do {
      points.insert(points.end(), arcs_[at].begin(), arcs_[at].end());
      const int other = append_path(piece.cell, cell.word[(at + 1) % size], &points);
      points.push_back(at_line_crossing_[other]);
      at = static_cast<std::size_t>(std::find(cell.word.begin(), cell.word.end(), other) -
                                    cell.word.begin());
    } while (at != static_cast<std::size_t>(piece.word));
    return points;
  }

  const Encasement& e_;
  const Arrangement& a_;
  const std::vector<Polyline>& edges_;
  CellComplex cells_;
  PieceComplex result_;
  std::vector<std::vector<Path>> paths_;  ///< by cell
  std::vector<int> at_line_crossing_;     ///< the point there, -1 for none
  std::vector<int> at_crossing_;
  std::vector<std::vector<int>> arcs_;  ///< of the cell at hand, by entry of its word
};

}  // namespace

Result<PieceComplex> make_piece_complex(const Encasement& encasement,
                                        const Arrangement& arrangement,
                                        const std::vector<Polyline>& edges) {
  Result<CellComplex> cells = make_cell_complex(encasement);
  if (!cells) return cells.error();
  return Maker(encasement, arrangement, edges, std::move(cells).value()).run();
}

std::vector<Polyline> boundaries(const Arrangement& arrangement, const std::vector<Polyline>& edges,
                                 const Arrangement::Face& face) {
  std::vector<int> cycles = {face.outer};
  cycles.insert(cycles.end(), face.holes.begin(), face.holes.end());
  std::vector<Polyline> lines;
  for (const int first : cycles) {
    Polyline line;
    for (const int h : arrangement.cycle(first)) {
      const Polyline& edge = edges[Arrangement::edge_of(h)];
      if (h % 2 == 0)
        line.insert(line.end(), edge.begin(), edge.end());
      else
        line.insert(line.end(), edge.rbegin(), edge.rend());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace encase
