// SPDX-License-Identifier: MIT
#include "2d/locate.hpp"

#include <algorithm>
#include <cmath>

#include "common/components.hpp"
#include "common/segments.hpp"
#include "common/substitute.hpp"
#include "encase/crossing.hpp"

namespace encase {

std::optional<Region> enlarged(const Region& region, int attempt) {
  const int n = region.side_count();
  Point<2> center{0, 0};
  std::vector<Point<2>> corners(n);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < 2; ++i) {
      corners[k][i] = region.corners[k][i].get_d();
      center[i] += corners[k][i] / n;
    }
  std::vector<RationalPoint<2>> moved(n);
  for (int k = 0; k < n; ++k) {
    // Fractions by the golden ratio: different for every corner, coordinate and attempt.
    for (int i = 0; i < 2; ++i) {
      const double turn = std::fmod(0.6180339887498949 * (7 * attempt + 3 * k + i), 1.0);
      const double growth = std::ldexp(1 + 0.2 * turn, -33 - (attempt - 1) % 3);
      moved[k][i] = Rational(corners[k][i] + growth * (corners[k][i] - center[i]));
    }
  }
  auto result = make_region(std::move(moved));
  if (!result || result.value().side_count() != n) return std::nullopt;
  Kernel kernel;
  for (int k = 0; k < n; ++k)
    for (const auto& corner : region.corners)
      if (side(result.value().side(k), corner, kernel) != Sign::Negative) return std::nullopt;
  return std::move(result).value();
}

namespace {

bool are_polynomials(const Encasement& encasement, const Crossing& crossing) {
  return encasement.curves[crossing.curves[0]].function.is_polynomial() &&
         encasement.curves[crossing.curves[1]].function.is_polynomial();
}

/// Whether the pair's only common point in the crossing's box lies on the line: the restrictions of
/// both curves, polynomials, to the line have a common root there. Exact.
bool on_line(const Encasement& encasement, const Crossing& crossing, const Line& line) {
  const Polynomial<1> common =
      gcd(restrict_exactly(encasement.curves[crossing.curves[0]].function.polynomial(), line),
          restrict_exactly(encasement.curves[crossing.curves[1]].function.polynomial(), line));
  if (common.is_zero() || common.is_constant()) return false;
  // The part of the line in the box, in its parameter p; the other coordinate is q = u p + v.
  const auto c = line.exact();
  const int p = parameter_axis(line), q = 1 - p;
  const Rational u = -c[p] / c[q], v = -c[2] / c[q];
  Rational lo(crossing.box.lo[p]), hi(crossing.box.hi[p]);
  const Rational low(crossing.box.lo[q]), high(crossing.box.hi[q]);
  if (u == 0) {
    if (v < low || v > high) return false;
  } else {
    Rational first((low - v) / u), last((high - v) / u);
    if (first > last) std::swap(first, last);
    lo = std::max(lo, first);
    hi = std::min(hi, last);
  }
  return lo <= hi && count_real_roots(common, lo, hi) > 0;
}

/// Up to how many bits of a crossing are computed to tell it from a line: a crossing of polynomials
/// that is not on the line is told some time; of others it is not known whether it is.
long most_bits(bool polynomials) { return polynomials ? 1 << 20 : 1 << 11; }

/// The side of a line on which a crossing lies; nothing if it cannot be told. Its box may be
/// narrowed to what tells it.
std::optional<Sign> tell_side(Encasement& encasement, int id, const Line& line, Kernel& kernel) {
  Crossing& crossing = encasement.crossings[id];
  if (const auto where = side(line, crossing.box, kernel)) return where;
  const bool polynomials = are_polynomials(encasement, crossing);
  if (polynomials && on_line(encasement, crossing, line)) return Sign::Zero;
  for (int bits = 64; bits <= most_bits(polynomials); bits *= 2) {
    const auto exact = refine(encasement, id, bits);
    if (!exact) return std::nullopt;
    // Some room around the common point, the same in both coordinates, so that the box is easily
    // proved to hold it.
    const RationalBox& tight = exact.value();
    Rational room = 0;
    for (int i = 0; i < 2; ++i)
      room = std::max(room, Rational(4 * (tight.hi[i] - tight.lo[i]) +
                                     Rational(0x1p-46 * std::fabs(nearest_double(tight.lo[i])))));
    Box<2> box;
    for (int i = 0; i < 2; ++i) {
      box.lo[i] = Interval::enclose(Rational(tight.lo[i] - room)).lo;
      box.hi[i] = Interval::enclose(Rational(tight.hi[i] + room)).hi;
    }
    const auto where = side(line, box, kernel);
    if (where && crossing.box.contains(box)) {
      crossing.box = box;
      crossing.point = box.center();
      crossing.rounded = false;
    }
    if (where) return where;
  }
  return std::nullopt;
}

/// Where the crossing is stays open, and so does what there is in its cell.
void leave_open(Encasement& encasement, int id) {
  const Crossing& crossing = encasement.crossings[id];
  Unresolved entry;
  entry.kind = Unresolved::Kind::Budget;
  entry.box = crossing.box;
  entry.has_box = true;
  entry.curves = {crossing.curves[0], crossing.curves[1]};
  entry.reason = "crossing " + std::to_string(id) +
                 " lies on the region's boundary or too close to it to be told from it";
  encasement.undecided.push_back(std::move(entry));
  if (crossing.cell < 0) return;
  Cell& cell = encasement.cells[crossing.cell];
  cell.state = CellState::Undecided;
  cell.branches.clear();
}

}  // namespace

void locate_crossings(Encasement& encasement, Kernel& kernel) {
  if (encasement.region.plane || encasement.region_used.corners == encasement.region.corners)
    return;
  std::vector<Line> sides;
  for (int k = 0; k < encasement.region.side_count(); ++k)
    sides.push_back(encasement.region.side(k));
  for (std::size_t id = 0; id < encasement.crossings.size(); ++id) {
    Crossing& crossing = encasement.crossings[id];
    if (crossing.location == Location::Outside) continue;
    for (const Line& line : sides) {
      const std::optional<Sign> where = tell_side(encasement, static_cast<int>(id), line, kernel);
      if (where == Sign::Positive) {
        crossing.location = Location::Outside;
        break;
      }
      if (where == Sign::Zero) crossing.location = Location::OnBoundary;
      if (!where) {
        leave_open(encasement, static_cast<int>(id));
        break;
      }
    }
  }
}

}  // namespace encase
