// SPDX-License-Identifier: MIT
#include "encase/region.hpp"

#include <charconv>
#include <string>

#include "common/dyadic.hpp"
#include "common/interval.hpp"

namespace encase {

namespace {

/// Coordinates are limited so that no double computed from them overflows at once.
constexpr double kMaxCoordinate = 1e300;

std::string decimal(const Rational& value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, nearest_double(value));
  return {buffer, end.ptr};
}

struct Corner {
  RationalPoint<2> point;
  int number = 0;  // as the user counts, from 1

  std::string name() const {
    return "corner " + std::to_string(number) + " (" + decimal(point[0]) + ", " +
           decimal(point[1]) + ")";
  }
};

using Vector = std::array<Rational, 2>;

Vector operator-(const Corner& a, const Corner& b) {
  return {a.point[0] - b.point[0], a.point[1] - b.point[1]};
}
int cross_sign(const Vector& u, const Vector& v) {
  return cmp(Rational(u[0] * v[1]), Rational(u[1] * v[0]));
}
int dot_sign(const Vector& u, const Vector& v) { return sgn(Rational(u[0] * v[0] + u[1] * v[1])); }
/// The direction's angle lies in [pi, 2 pi).
bool points_down(const Vector& u) { return u[1] < 0 || (u[1] == 0 && u[0] < 0); }

/// The line of a side from p to q that is parallel to an axis, if its coordinates are doubles: with
/// a unit normal and so without a rounding.
std::optional<Line> axis_parallel_side(const RationalPoint<2>& p, const RationalPoint<2>& q) {
  for (int i = 0; i < 2; ++i) {
    if (p[i] != q[i]) continue;
    const auto at = quick_double(p[i]);
    if (!at) return std::nullopt;
    // The inside lies to the left of the direction from p to q.
    const int along = cmp(q[1 - i], p[1 - i]);
    Line line;
    line.normal[i] = (along > 0) == (i == 0) ? 1 : -1;
    line.offset = 0.0 - line.normal[i] * *at;
    return line;
  }
  return std::nullopt;
}

Error bad(std::string message) { return {Error::Code::BadInput, std::move(message)}; }

}  // namespace

Line Region::side(int k) const {
  const auto& p = corners[static_cast<std::size_t>(k)];
  const auto& q = corners[static_cast<std::size_t>(k + 1) % corners.size()];
  if (const auto simple = axis_parallel_side(p, q)) return *simple;
  // The inside lies to the left of the direction from p to q; the normal points to the right.
  std::array<Rational, 3> line{q[1] - p[1], p[0] - q[0], 0};
  if (line[0] == 0 || line[1] == 0) {
    // Sides parallel to an axis get a unit normal, so that they are exact where corners are
    // doubles.
    const Rational length = line[0] == 0 ? abs(line[1]) : abs(line[0]);
    line[0] /= length;
    line[1] /= length;
  } else {
    // A power of two brings the normal near 1: no double overflows, and none is rounded for it.
    const Rational length = abs(line[0]) > abs(line[1]) ? abs(line[0]) : abs(line[1]);
    const long bits = static_cast<long>(mpz_sizeinbase(length.get_num_mpz_t(), 2)) -
                      static_cast<long>(mpz_sizeinbase(length.get_den_mpz_t(), 2));
    for (int i = 0; i < 2; ++i) {
      if (bits > 0)
        mpq_div_2exp(line[i].get_mpq_t(), line[i].get_mpq_t(), static_cast<unsigned long>(bits));
      else
        mpq_mul_2exp(line[i].get_mpq_t(), line[i].get_mpq_t(), static_cast<unsigned long>(-bits));
    }
  }
  line[2] = -(line[0] * p[0] + line[1] * p[1]);
  return Line::from_rationals(line);
}

Box<2> Region::bounding_box() const {
  Box<2> box;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Box<2> corner;
    for (int i = 0; i < 2; ++i) {
      const Interval around = Interval::enclose(corners[k][i]);
      corner.lo[i] = around.lo;
      corner.hi[i] = around.hi;
    }
    box = k == 0 ? corner : hull(box, corner);
  }
  return box;
}

Result<Region> make_region(std::vector<RationalPoint<2>> points) {
  if (points.size() < 3)
    return bad("a polygon needs at least three corners, this region has " +
               std::to_string(points.size()));
  std::vector<Corner> corners;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Corner corner{std::move(points[k]), static_cast<int>(k) + 1};
    for (const Rational& c : corner.point)
      if (abs(c) > Rational(kMaxCoordinate))
        return bad("corner " + std::to_string(corner.number) +
                   " of the region is too far away: coordinates are limited to 1e300");
    if (corners.empty() || corners.back().point != corner.point)
      corners.push_back(std::move(corner));
  }
  while (corners.size() > 1 && corners.front().point == corners.back().point) corners.pop_back();

  Rational twice_area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& p = corners[k].point;
    const auto& q = corners[(k + 1) % corners.size()].point;
    twice_area += p[0] * q[1] - p[1] * q[0];
  }
  if (twice_area < 0) corners = {corners.rbegin(), corners.rend()};

  // A closed polygon that turns left at every corner and once around in total is the boundary of a
  // convex polygon: its edges' directions increase through one full turn.
  Region region;
  int turns = 0;
  bool has_area = false;
  const Corner* reflex = nullptr;
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector in = corners[k] - corners[(k + n - 1) % n];
    const Vector out = corners[(k + 1) % n] - corners[k];
    const int turn = cross_sign(in, out);
    has_area = has_area || turn != 0;
    if (turn < 0 || (turn == 0 && dot_sign(in, out) < 0)) {
      if (!reflex) reflex = &corners[k];
    } else if (turn > 0) {
      region.corners.push_back(corners[k].point);
    }
    if (points_down(in) && !points_down(out)) ++turns;
  }
  if (!has_area) return bad("the region has no area: all its corners lie on one line");
  if (reflex)
    return bad("the region is not convex: its boundary turns the wrong way at " + reflex->name());
  if (turns != 1) return bad("the region is not convex: its boundary crosses itself");
  return region;
}

Result<Region> make_region(const Rational& xmin, const Rational& xmax, const Rational& ymin,
                           const Rational& ymax) {
  if (xmin >= xmax || ymin >= ymax) {
    const bool in_x = xmin >= xmax;
    return bad(std::string("the region has no area: ") + (in_x ? "xmin = " : "ymin = ") +
               decimal(in_x ? xmin : ymin) + " is not less than " + (in_x ? "xmax = " : "ymax = ") +
               decimal(in_x ? xmax : ymax));
  }
  return make_region({{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}});
}

}  // namespace encase
