// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "encase/geometry.hpp"

/// What pictures are written with: texts, marks of axes, and the map to pixels.
namespace encase {

inline constexpr double kFont = 12;
inline constexpr double kLetter = 6.7;  ///< about how wide a letter of that size is

/// A coordinate in pixels: a hundredth is finer than anyone sees.
std::string pixels(double value);

/// Text for XML: markup escaped, what XML does not allow replaced.
std::string escaped(std::string_view text);

/// How many letters a text in UTF-8 has.
int letters(std::string_view text);

/// The first letters of a text, for legends.
std::string shortened(const std::string& text, int most);

/// The marks of an axis: multiples of 1, 2 or 5 times a power of ten, with texts of equal
/// precision.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> texts;
};

/// For an axis from `lo` to `hi` that is `length` pixels long.
Ticks make_ticks(double lo, double hi, double length);

/// The map from input coordinates to pixels.
struct View {
  Box<2> box;
  double scale_x = 1, scale_y = 1;
  double left = 0, top = 0;
  double width = 0, height = 0;

  double x(double value) const { return left + (value - box.lo[0]) * scale_x; }
  double y(double value) const { return top + (box.hi[1] - value) * scale_y; }
  std::string point(const Point<2>& p) const { return pixels(x(p[0])) + " " + pixels(y(p[1])); }

  /// "M x y L ..." without points that fall on the one before.
  std::string path(const std::vector<Point<2>>& points, bool closed) const {
    std::string out, last;
    for (const Point<2>& p : points) {
      std::string here = point(p);
      if (here == last) continue;
      out += last.empty() ? "M" : "L";
      out += here;
      last = std::move(here);
    }
    if (closed && !out.empty()) out += "Z";
    return out;
  }
  std::string rectangle(const Box<2>& b) const {
    const double x0 = x(b.lo[0]), y0 = y(b.hi[1]);
    return "M" + pixels(x0) + " " + pixels(y0) + "h" + pixels(x(b.hi[0]) - x0) + "v" +
           pixels(y(b.lo[1]) - y0) + "h" + pixels(x0 - x(b.hi[0])) + "Z";
  }
  /// The larger side of a box in pixels.
  double extent(const Box<2>& b) const {
    return std::max(b.width(0) * scale_x, b.width(1) * scale_y);
  }
  Point<2> center(const Box<2>& b) const { return {x(b.center()[0]), y(b.center()[1])}; }
};

/// The picture of a box, with room around it: for axes, if there are any, and for a legend above.
struct Frame {
  Frame() = default;
  /// `size`: the length of the box' longer side in pixels.
  Frame(const Box<2>& box, int size, bool with_axes);
  void add_legend(const std::vector<std::vector<struct LegendEntry>>& rows);
  double width() const { return std::max(least_width, view.left + view.width + right); }
  double height() const { return view.top + view.height + bottom; }

  View view;
  double right = 8, bottom = 8;
  double least_width = 0;  ///< of the picture: a legend may be wider than the box
  Ticks x_ticks, y_ticks;
};

/// The axes as an SVG group.
std::string axes(const Frame& frame);

/// What a legend shows.
struct LegendEntry {
  std::string mark;  ///< drawn with its middle at (0, 0), 24 pixels wide
  std::string text;
  double width = 0;  ///< the room it takes
};

/// In rows of the given width.
std::vector<std::vector<LegendEntry>> legend_rows(std::vector<LegendEntry> entries, double room);

/// The legend as an SVG group.
std::string legend(const std::vector<std::vector<LegendEntry>>& rows, const Frame& frame);

/// The colour of a curve, and the dashes of its stroke ("" for none): with more curves than colours
/// the same colours with other strokes.
const char* colour(int curve);
const char* dash(int curve);

}  // namespace encase
