// SPDX-License-Identifier: MIT
#include "svg_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "2d/clearing.hpp"
#include "svg_view.hpp"

namespace encase {
namespace {

constexpr double kLabelFont = 10.5;
constexpr double kSmallFont = 8;

/// The room that a text takes.
Box<2> box_of(const std::string& text, const Point<2>& center, double font) {
  const double x = 0.5 * kLetter / kFont * font * letters(text) + 1, y = 0.4 * font + 1;
  return {{center[0] - x, center[1] - y}, {center[0] + x, center[1] + y}};
}

}  // namespace

void LabelPlacer::keep_clear(const Point<2>& at, double half_width) {
  taken_.push_back(
      {{at[0] - half_width, at[1] - half_width}, {at[0] + half_width, at[1] + half_width}});
}

std::string LabelPlacer::in_face(const std::string& text,
                                 const std::vector<std::vector<Point<2>>>& boundaries,
                                 const std::string& paint) {
  const Clearing clearing = largest_clearing(boundaries, 1);
  for (const double font : {kLabelFont, kSmallFont}) {
    const Box<2> box = box_of(text, clearing.center, font);
    if (0.5 * std::hypot(box.width(0), box.width(1)) <= clearing.radius && is_free(box))
      return put(text, clearing.center, font, paint);
  }
  return {};
}

std::string LabelPlacer::at_point(const std::string& text, const Point<2>& at,
                                  const std::string& paint) {
  const Box<2> box = box_of(text, at, kSmallFont);
  const double x = 0.5 * box.width(0) + 4.5, y = 0.5 * box.width(1) + 4.5;
  for (const Point<2>& d : {Point<2>{x, -y},
                            {-x, -y},
                            {x, y},
                            {-x, y},
                            {0, -y - 2},
                            {x + 2, 0},
                            {-x - 2, 0},
                            {0, y + 2}})
    if (is_free(box_of(text, {at[0] + d[0], at[1] + d[1]}, kSmallFont)))
      return put(text, {at[0] + d[0], at[1] + d[1]}, kSmallFont, paint);
  return {};
}

std::string LabelPlacer::along(const std::string& text, const std::vector<Point<2>>& line,
                               const std::string& paint) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k)
    length += std::hypot(line[k][0] - line[k - 1][0], line[k][1] - line[k - 1][1]);
  const Box<2> size = box_of(text, {0, 0}, kSmallFont);
  if (length < 1.5 * size.width(0)) return {};
  for (const double part : {0.5, 0.4, 0.6, 0.3, 0.7}) {
    double left = part * length;
    for (std::size_t k = 1; k < line.size(); ++k) {
      const Point<2> d = {line[k][0] - line[k - 1][0], line[k][1] - line[k - 1][1]};
      const double here = std::hypot(d[0], d[1]);
      if (left > here || !(here > 0)) {
        left -= here;
        continue;
      }
      const double at = left / here;
      const Point<2> normal = {-d[1] / here, d[0] / here};
      const double off =
          2 + 0.5 * (std::fabs(normal[0]) * size.width(0) + std::fabs(normal[1]) * size.width(1));
      for (const double side : {off, -off}) {
        const Point<2> center = {line[k - 1][0] + at * d[0] + side * normal[0],
                                 line[k - 1][1] + at * d[1] + side * normal[1]};
        if (is_free(box_of(text, center, kSmallFont))) return put(text, center, kSmallFont, paint);
      }
      break;
    }
  }
  return {};
}

bool LabelPlacer::is_free(const Box<2>& box) const {
  return picture_.contains(box) &&
         std::none_of(taken_.begin(), taken_.end(), [&](const Box<2>& b) { return b.meets(box); });
}

std::string LabelPlacer::put(const std::string& text, const Point<2>& center, double font,
                             const std::string& paint) {
  taken_.push_back(box_of(text, center, font));
  return fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\">{}</text>\n",
                     pixels(center[0]), pixels(center[1] + 0.36 * font), pixels(font), paint, text);
}

}  // namespace encase
