// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "encase/encasement.hpp"

/// Random changes of certified encasements, for tests that verification notices them.
namespace encase::mutations {

struct Mutation {
  std::string what;
  /// Whether the changed fact can be true as well, so that verification may accept it: an excluded
  /// leaf that belongs to a crossing, say, or an interval that is wider.
  bool may_hold = false;
};

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// Changes one fact of a certified encasement with at least two cells and one crossing.
  Mutation apply(Encasement& e) {
    using Kind = std::optional<Mutation> (Mutator::*)(Encasement&);
    static constexpr Kind kKinds[] = {
        &Mutator::word,       &Mutator::branch,          &Mutator::vertex,
        &Mutator::cell,       &Mutator::history,         &Mutator::line,
        &Mutator::interval,   &Mutator::crossing_box,    &Mutator::crossing,
        &Mutator::token,      &Mutator::cover,           &Mutator::certificate,
        &Mutator::region_box, &Mutator::critical_region, &Mutator::curve,
        &Mutator::whole,
    };
    for (;;)
      if (const auto mutation = (this->*kKinds[below(std::size(kKinds))])(e)) return *mutation;
  }

  /// Changes one fact of the shared cover, of at least two leaves.
  Mutation change_shared_cover(Encasement& e) {
    SharedCover& cover = e.shared_cover;
    const std::size_t k = below(cover.alive.size());
    std::vector<int>& alive = cover.alive[k];
    const std::string where = name("leaf", cover.alive, alive);
    switch (below(6)) {
      case 0: {
        int& token = any(cover.tokens);
        const int before = token;
        token = other(token + 6, cover.alive.size() + 6) - 6;
        // A box halved the other way may have the same curves in its halves.
        const bool split = before >= cover::kSplitY && before < 0;
        return {"shared token " + std::to_string(before) + " to " + std::to_string(token),
                split && token >= cover::kSplitY && token < 0};
      }
      case 1:
        cover.root.hi[below(2)] -= 0.5 * cover.root.largest_width();
        return {"the shared cover's root made smaller"};
      case 2:
        cover.alive.pop_back();
        return {"the last list of curves dropped"};
      case 3:
        alive.push_back(static_cast<int>(e.curves.size()));
        return {where + ": a curve that is not there"};
      case 4:
        std::swap(alive, cover.alive[(k + 1) % cover.alive.size()]);
        return {where + ": curves exchanged with the next", true};
      default:
        // It may have no zero there that the search could tell.
        if (!alive.empty())
          alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(below(alive.size())));
        return {where + ": a curve less", true};
    }
  }

  /// Overwrites numbers and indices anywhere with the most awkward values.
  void corrupt(Encasement& e, int count) {
    for (int k = 0; k < count; ++k) {
      switch (below(12)) {
        case 0:
          junk(any(e.line_crossings).lo), junk(any(e.line_crossings).hi);
          break;
        case 1:
          junk(any(e.line_crossings).line), junk(any(e.line_crossings).curve);
          break;
        case 2:
          junk(any(any(e.cells).vertices).line_in), junk(any(e.cells).crossing);
          break;
        case 3:
          junk(any(any(e.cells).vertices).point[0]);
          break;
        case 4:
          junk(any(e.history).negative), junk(any(e.history).line);
          break;
        case 5:
          junk(any(e.lines).normal[below(2)]), junk(any(e.lines).offset);
          break;
        case 6:
          junk(any(e.crossings).box.lo[below(2)]), junk(any(e.crossings).point[0]);
          break;
        case 7:
          junk(any(any(e.crossing_covers).tokens));
          break;
        case 8:
          junk(any(any(e.critical_covers).tokens));
          break;
        case 9:
          junk(any(e.crossing_covers).root.hi[below(2)]);
          break;
        case 10:
          junk(any(e.crossings).cell), junk(any(e.crossings).curves[0]);
          break;
        default:
          junk(any(any(e.cells).vertices).parameter);
          break;
      }
    }
  }

 private:
  using Changed = std::optional<Mutation>;

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  bool coin() { return below(2) == 0; }
  template <class T>
  T& any(std::vector<T>& list) {
    return list[below(list.size())];
  }
  template <class T>
  static std::string name(const char* kind, const std::vector<T>& list, const T& item) {
    return std::string(kind) + " " + std::to_string(&item - list.data());
  }
  /// Another value in [0, n).
  int other(int value, std::size_t n) {
    const int shift = 1 + static_cast<int>(below(n - 1));
    return (value + shift) % static_cast<int>(n);
  }

  void junk(int& value) {
    constexpr int kValues[] = {-1,
                               0,
                               1,
                               -2,
                               -5,
                               -6,
                               7,
                               1000000,
                               std::numeric_limits<int>::max(),
                               std::numeric_limits<int>::min()};
    value = kValues[below(std::size(kValues))];
  }
  void junk(double& value) {
    const double values[] = {0.0,
                             -0.0,
                             1,
                             -1,
                             5e-324,
                             -2.5e-310,
                             1e308,
                             -1e308,
                             1e160,
                             std::nan(""),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(),
                             value * (1 + 0x1p-52),
                             -value,
                             value + 1};
    value = values[below(std::size(values))];
  }

  Changed word(Encasement& e) {
    Cell& cell = any(e.cells);
    if (cell.word.size() < 2) return std::nullopt;
    const std::string where = name("word of cell", e.cells, cell);
    switch (below(4)) {
      case 0: {
        const std::size_t k = below(cell.word.size() - 1);
        std::swap(cell.word[k], cell.word[k + 1]);
        return Mutation{where + ": two places exchanged"};
      }
      case 1:
        cell.word.pop_back();
        return Mutation{where + ": shortened"};
      case 2:
        cell.word.push_back(cell.word[0]);
        return Mutation{where + ": lengthened"};
      default:
        int& place = any(cell.word);
        place = other(place, e.line_crossings.size());
        return Mutation{where + ": another line crossing"};
    }
  }

  Changed branch(Encasement& e) {
    Cell& cell = any(e.cells);
    if (cell.branches.empty()) return std::nullopt;
    const std::string where = name("branches of cell", e.cells, cell);
    if (coin()) {
      cell.branches.pop_back();
      return Mutation{where + ": one less"};
    }
    Branch& b = any(cell.branches);
    int& end = coin() ? b.from : b.to;
    end = other(end, e.line_crossings.size());
    return Mutation{where + ": another end"};
  }

  Changed vertex(Encasement& e) {
    Cell& cell = any(e.cells);
    const std::string where = name("vertices of cell", e.cells, cell);
    const std::size_t k = below(cell.vertices.size());
    switch (below(4)) {
      case 0:
        cell.vertices[k].line_in = other(cell.vertices[k].line_in, e.lines.size());
        break;
      case 1:
        cell.vertices[k].point[below(2)] += 1e-3;
        break;
      case 2:
        cell.vertices.erase(cell.vertices.begin() + static_cast<std::ptrdiff_t>(k));
        break;
      default:
        cell.vertices.push_back(cell.vertices[k]);
        break;
    }
    return Mutation{where};
  }

  Changed cell(Encasement& e) {
    Cell& cell = any(e.cells);
    const std::string where = name("cell", e.cells, cell);
    switch (below(4)) {
      case 0:
        cell.state = static_cast<CellState>(other(static_cast<int>(cell.state), 4));
        return Mutation{where + ": state"};
      case 1:
        ++cell.depth;
        return Mutation{where + ": depth"};
      case 2: {
        // Also from -1, and to -1.
        cell.crossing = other(cell.crossing + 1, e.crossings.size() + 1) - 1;
        return Mutation{where + ": crossing"};
      }
      default: {
        const std::size_t k = below(e.cells.size());
        if (&e.cells[k] == &cell) return std::nullopt;
        std::swap(e.cells[k], cell);
        return Mutation{where + ": exchanged with cell " + std::to_string(k)};
      }
    }
  }

  Changed history(Encasement& e) {
    Split& split = any(e.history);
    const std::string where = name("split", e.history, split);
    switch (below(4)) {
      case 0:
        std::swap(split.negative, split.positive);
        break;
      case 1:
        split.line = other(split.line, e.lines.size());
        break;
      case 2:
        split.negative = static_cast<int>(below(e.history.size()));
        break;
      default:
        split.positive = split.negative;
        break;
    }
    // A child may have been drawn again.
    return Mutation{where, true};
  }

  Changed line(Encasement& e) {
    Line& l = any(e.lines);
    const std::string where = name("line", e.lines, l);
    const double size = std::fabs(l.normal[0]) + std::fabs(l.normal[1]) + std::fabs(l.offset);
    (coin() ? l.offset : l.normal[below(2)]) += 0.01 * size;
    l.rational = nullptr;
    return Mutation{where};
  }

  Changed interval(Encasement& e) {
    LineCrossing& c = any(e.line_crossings);
    const std::string where = name("line crossing", e.line_crossings, c);
    const double width = c.hi - c.lo;
    switch (below(5)) {
      case 0:
        c.lo += width;
        c.hi += 2 * width;
        return Mutation{where + ": moved"};
      case 1:
        c.line = other(c.line, e.lines.size());
        return Mutation{where + ": line"};
      case 2:
        if (e.curves.size() < 2) return std::nullopt;
        c.curve = other(c.curve, e.curves.size());
        return Mutation{where + ": curve"};
      case 3:
        c.hi += 0.01 * width;
        return Mutation{where + ": widened", true};
      default:
        std::swap(c.lo, c.hi);
        return Mutation{where + ": reversed"};
    }
  }

  Changed crossing_box(Encasement& e) {
    Crossing& c = any(e.crossings);
    const std::string where = name("crossing", e.crossings, c);
    const std::size_t axis = below(2);
    const double width = c.box.width(static_cast<int>(axis));
    switch (below(4)) {
      case 0:
        c.box.lo[axis] += 2 * width;
        c.box.hi[axis] += 2 * width;
        c.point[axis] += 2 * width;
        return Mutation{where + ": box moved"};
      case 1:
        c.box.hi[axis] += 1e3;
        return Mutation{where + ": box widened past its cell"};
      case 2:
        c.box.hi[axis] = c.box.lo[axis];
        return Mutation{where + ": box flattened"};
      default:
        if (!c.rounded) return std::nullopt;
        c.point[axis] = std::nextafter(c.point[axis], 1e9);
        return Mutation{where + ": point rounded up"};
    }
  }

  Changed crossing(Encasement& e) {
    Crossing& c = any(e.crossings);
    const std::string where = name("crossing", e.crossings, c);
    switch (below(4)) {
      case 0:
        c.cell = other(c.cell + 1, e.cells.size() + 1) - 1;
        return Mutation{where + ": cell"};
      case 1:
        c.location = static_cast<Location>(other(static_cast<int>(c.location), 3));
        return Mutation{where + ": location"};
      case 2:
        e.crossings.push_back(c);
        return Mutation{where + ": repeated"};
      default:
        if (e.curves.size() < 3) return std::nullopt;
        c.curves[0] = other(c.curves[0], e.curves.size());
        return Mutation{where + ": curves"};
    }
  }

  Changed token(Encasement& e) {
    const bool crossings = coin();
    auto& tokens = crossings ? any(e.crossing_covers).tokens : any(e.critical_covers).tokens;
    const std::size_t items = crossings ? e.crossings.size() : e.critical_regions.size();
    int& t = any(tokens);
    const int before = t;
    switch (below(4)) {
      case 0:
        t = cover::kExcluded;
        break;
      case 1:
        t = cover::kOutside;
        break;
      case 2:
        t = coin() ? cover::kSplitX : cover::kSplitY;
        break;
      default:
        t = items > 0 ? static_cast<int>(below(items)) : cover::kUnresolved;
        break;
    }
    if (t == before) return std::nullopt;
    const auto splits = [](int token) {
      return token == cover::kSplitX || token == cover::kSplitY;
    };
    // What changes the tree's shape cannot hold; what a leaf claims instead may.
    return Mutation{"token " + std::to_string(&t - tokens.data()) + ": " + std::to_string(before) +
                        " to " + std::to_string(t),
                    splits(before) == splits(t)};
  }

  Changed cover(Encasement& e) {
    switch (below(5)) {
      case 0:
        e.crossing_covers.pop_back();
        return Mutation{"a crossing cover dropped"};
      case 1:
        e.critical_covers.pop_back();
        return Mutation{"a critical cover dropped"};
      case 2: {
        CriticalCover& c = any(e.critical_covers);
        c.tokens.push_back(cover::kExcluded);
        return Mutation{"a token added"};
      }
      case 3: {
        CrossingCover& c = any(e.crossing_covers);
        c.root.hi[below(2)] -= 0.5 * c.root.largest_width();
        return Mutation{"a cover's root made smaller"};
      }
      default: {
        // Every leaf of one crossing claims to be empty.
        CrossingCover& c = any(e.crossing_covers);
        const int k = static_cast<int>(below(e.crossings.size()));
        if (e.crossings[static_cast<std::size_t>(k)].curves != c.curves) return std::nullopt;
        for (int& t : c.tokens) t = t == k ? cover::kExcluded : t;
        return Mutation{"crossing " + std::to_string(k) + " left out of its cover"};
      }
    }
  }

  Changed certificate(Encasement& e) {
    Cell& cell = any(e.cells);
    if (cell.loop_certificates.empty()) return std::nullopt;
    const std::string where = name("loop certificates of cell", e.cells, cell);
    LoopCertificate& c = any(cell.loop_certificates);
    switch (below(3)) {
      // More than are needed may be there, and another end may do as well.
      case 0:
        cell.loop_certificates.pop_back();
        return Mutation{where + ": one less", true};
      case 1:
        c.to = c.from;
        return Mutation{where + ": a point", true};
      default:
        c.from[below(2)] += 1e6;
        return Mutation{where + ": from elsewhere"};
    }
  }

  Changed region_box(Encasement& e) {
    if (e.critical_regions.empty()) return std::nullopt;
    CriticalRegion& r = any(e.critical_regions);
    const std::string where = name("critical region", e.critical_regions, r);
    r.boxes.erase(r.boxes.begin() + static_cast<std::ptrdiff_t>(below(r.boxes.size())));
    return Mutation{where + ": a box less"};
  }

  Changed critical_region(Encasement& e) {
    if (e.critical_regions.empty()) return std::nullopt;
    CriticalRegion& r = any(e.critical_regions);
    const std::string where = name("critical region", e.critical_regions, r);
    if (coin()) {
      r.sign = -r.sign;
      return Mutation{where + ": sign"};
    }
    if (e.curves.size() < 2) return std::nullopt;
    r.curve = other(r.curve, e.curves.size());
    return Mutation{where + ": curve"};
  }

  Changed curve(Encasement& e) {
    Curve& c = any(e.curves);
    const std::string where = name("curve", e.curves, c);
    const Rational constant(1, 1000);
    if (c.function.is_polynomial())
      c.function = c.function.polynomial() + Polynomial<2>::constant(constant);
    else
      c.function = c.function.expression() + Expression(constant);
    if (coin()) return Mutation{where + ": constant term"};
    // The input as well: a correct description of another problem, with the same crossings.
    e.input[static_cast<std::size_t>(c.sources[0])].function = c.function;
    return Mutation{where + ": constant term of the input"};
  }

  Changed whole(Encasement& e) {
    switch (below(5)) {
      case 0:
        e.outcome = static_cast<Outcome>(other(static_cast<int>(e.outcome), 3));
        return Mutation{"outcome"};
      case 1:
        any(e.region.corners)[below(2)] *= 2;
        return Mutation{"region"};
      case 2:
        any(e.region_used.corners)[below(2)] *= 2;
        return Mutation{"region used"};
      case 3:
        e.cells.pop_back();
        return Mutation{"a cell dropped"};
      default:
        e.line_crossings.pop_back();
        return Mutation{"a line crossing dropped"};
    }
  }

  std::mt19937_64 random_;
};

}  // namespace encase::mutations
