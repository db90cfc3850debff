// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// Finds room for labels in a picture, in pixels: no two of them overlap. What finds no room has no
/// label: these functions return an SVG text, or nothing.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Box<2>& picture) : picture_(picture) {}

  /// No label may cover the square around a point.
  void keep_clear(const Point<2>& at, double half_width);

  /// Where the face is widest.
  std::string in_face(const std::string& text, const std::vector<std::vector<Point<2>>>& boundaries,
                      const std::string& paint);
  /// Beside a point.
  std::string at_point(const std::string& text, const Point<2>& at, const std::string& paint);
  /// Beside a polyline, about its middle.
  std::string along(const std::string& text, const std::vector<Point<2>>& line,
                    const std::string& paint);

 private:
  bool is_free(const Box<2>& box) const;
  std::string put(const std::string& text, const Point<2>& center, double font,
                  const std::string& paint);

  Box<2> picture_;
  std::vector<Box<2>> taken_;
};

}  // namespace encase
