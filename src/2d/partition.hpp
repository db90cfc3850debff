// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory_resource>
#include <optional>
#include <vector>

#include "2d/nested_tiles.hpp"
#include "2d/places.hpp"
#include "2d/recycled_memory.hpp"
#include "common/filtered_function.hpp"
#include "common/line_roots.hpp"
#include "common/segments.hpp"
#include "common/tile.hpp"
#include "encase/encasement.hpp"

/// The growing binary space partition: cells, and how a line cuts one in two.
namespace encase {

/// A cell while it is being worked on. Counter-clockwise: edge k runs on its line from vertex k to
/// vertex k + 1.
struct OpenCell {
  struct Edge {
    int line = -1;
    bool positive = false;  ///< the cell is on the line's positive side
    int end = 0;            ///< where the edge's crossings end in the word
  };
  using Memory = std::pmr::memory_resource;
  explicit OpenCell(Memory* memory = std::pmr::get_default_resource())
      : edges(memory),
        vertices(memory),
        word(memory),
        crossings(memory),
        critical_regions(memory),
        zones(memory),
        saddles(memory) {}

  std::pmr::vector<Edge> edges;
  std::pmr::vector<Place> vertices;
  std::pmr::vector<int> word;              ///< line crossings, counter-clockwise from vertex 0
  std::pmr::vector<int> crossings;         ///< crossings of two curves inside
  std::pmr::vector<int> critical_regions;  ///< those that lie wholly inside
  std::pmr::vector<int> zones;             ///< unresolved zones that it meets
  std::pmr::vector<int> saddles;           ///< about those inside
  int depth = 0;
  int parent = -1;        ///< node of the history that made it, -1 for the region used
  bool positive = false;  ///< on the positive side of that node's line
  int least_cells =
      1 << 30;           ///< the least that `Cut::least_cells` has been for it or its ancestors
  int stall = 0;         ///< levels since that has last fallen
  int earlier_cut = -1;  ///< of the EarlierEncasement, that cut the same cell; -1 for none
  int sketches = -1;     ///< those of `CellAtHand` that were made for an ancestor; -1 for none

  /// Becomes another cell, with nothing in it yet. The arrays keep their memory.
  void clear();
  int size() const { return static_cast<int>(edges.size()); }
  int begin_of(int edge) const { return edge == 0 ? 0 : edges[edge - 1].end; }
};

/// A box that resists, grown by what the search keeps clear around it.
struct Zone {
  Box<2> box;
  Box<2> clearance;        ///< the cell that holds the zone is cut down to about this box
  bool crossable = false;  ///< lines may cut it: a curve's function is not analytic there
};

/// What a line does to a cell.
struct Cut {
  Line line;
  int out = -1;         ///< the edge on which the boundary leaves the negative side
  int in = -1;          ///< the edge on which it comes back
  int word_at_out = 0;  ///< crossings of the cell's word before the cut of edge `out`
  int word_at_in = 0;   ///< and before that of edge `in`
  Place vertex_out, vertex_in;
  struct Root {
    int curve;
    LineRoot root;
  };
  std::vector<Root> roots;           ///< of every curve alive on the chord
  std::vector<char> positive;        ///< for every crossing in the cell, on which side it lies
  std::array<int, 2> least_cells{};  ///< of the negative and the positive part, by counting
  double score = 0;                  ///< the cells to be expected of both, and what else matters
};

/// A saddle of a curve's polynomial, approximately: two branches that nearly meet pass on both
/// sides of one. Along the line with the given normal no branch is near.
struct Saddle {
  int curve = -1;
  Point<2> at{};
  Point<2> normal{};
  double reach = 0;  ///< about how far the branches are
};

/// What is known of the curves before the first cut. Cells name its entries. Partitions of
/// different parts of a region share it; of a crossing they change the cell that holds it.
struct Features {
  std::vector<Crossing> crossings;
  std::vector<Place> crossing_places;  ///< of their boxes; made by `Partition::fill`
  std::vector<CriticalRegion> critical_regions;
  std::vector<Zone> zones;
  std::vector<Saddle> saddles;  ///< those with the nearest branches first
};

class Partition {
 public:
  /// `tiles`: the curves' polynomials over a box that contains the polygon to be opened.
  Partition(const std::vector<FilteredFunction<2>>& curves, NestedTiles& tiles, Features& features,
            Kernel& kernel);

  std::vector<Line> lines;
  std::vector<LineCrossing> line_crossings;
  std::vector<Crossing>& crossings;
  std::vector<Place>& crossing_places;
  std::vector<CriticalRegion>& critical_regions;
  std::vector<Zone>& zones;
  std::vector<Saddle>& saddles;
  std::vector<Split> history;
  std::int64_t lines_tried = 0;

  const std::vector<FilteredFunction<2>>& curves() const { return curves_; }
  NestedTiles& tiles() { return tiles_; }
  Kernel& kernel() { return kernel_; }
  OpenCell::Memory* memory() { return &memory_; }

  /// The polygon with the given sides (its inside negative) as the first cell, its sides crossed by
  /// the curves: nothing if a crossing is not simple, at a corner, or not told from another one.
  std::optional<OpenCell> open(const std::vector<Line>& sides);
  /// Gives the opened cell the crossings, critical regions, zones and saddles inside it.
  void fill(OpenCell* cell);

  /// Makes room for what so many cuts add, about.
  void reserve(std::size_t cuts);

  /// Forgets all cuts of the opened cell.
  void forget_cuts(const OpenCell& opened);

  /// Begins with an open cell of another partition, as the whole of this one: its edges' lines and
  /// the crossings of its word come first here, in their order.
  OpenCell begin(const Partition& whole, const OpenCell& cell);
  /// For each line and line crossing of a partition what it is in another.
  struct Numbers {
    std::vector<int> lines, line_crossings;
  };
  /// Takes over the lines, line crossings and cuts of a partition that was begun with this one's
  /// open cell, half of another, and whose cells will have the numbers from `first_cell` on. Of an
  /// interval that both have refined, the common part.
  Numbers join(const OpenCell& cell, const Partition& part, int first_cell);

  /// Isolates the roots of a curve between two vertices of a line, on both of which it must not
  /// vanish, and appends them to `roots`; false if something is not proved.
  bool isolate_between(int curve, const Line& line, const Interval& from, const Interval& to,
                       int max_nodes, std::vector<Cut::Root>* roots);
  /// How many crossings of an edge come before a vertex on it. Refines them where it must; nothing
  /// if a curve may pass through the vertex.
  std::optional<int> crossings_before(const OpenCell& cell, int edge, const Interval& parameter);

  /// Makes the cut and records it; false (and no change) if the order of the roots on the line
  /// cannot be proved.
  bool apply(const OpenCell& cell, Cut* cut, OpenCell* negative, OpenCell* positive);

  /// About where a line crossing is, and the curve's unit gradient there; heuristics use them.
  struct Spot {
    double parameter = 0;  ///< on the line
    Point<2> at{};
    Point<2> normal{};
    bool known = false;
  };
  const Spot& spot(int line_crossing);

 private:
  bool isolate_in_parts(int curve, const Line& line, double from, double to, int max_nodes);
  bool order_on_line(const Line& line, std::vector<Cut::Root>* roots);
  void add_line_crossings(int line, const std::vector<Cut::Root>& roots);
  void build_child(const OpenCell& cell, const Cut& cut, int first_root, OpenCell* child);
  std::optional<Sign> side_of(const CriticalRegion& region, const Line& line);

  const std::vector<FilteredFunction<2>>& curves_;
  NestedTiles& tiles_;
  Kernel& kernel_;
  RecycledMemory memory_;  ///< of the cells
  std::vector<LineRoot> found_;
  std::vector<double> stops_;
  std::vector<Spot> spots_;  ///< of every line crossing
};

/// A polynomial's value and gradient near or in its box, in doubles: heuristics use them.
struct ValueAndGradient {
  double value;
  Point<2> gradient;
};
ValueAndGradient value_and_gradient(TiledFunction& f, const Point<2>& at);

/// The smallest box around the centres of a cell's vertices.
Box<2> bounds_of(const OpenCell& cell);

}  // namespace encase
