// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace encase::benchmark {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< ascending x, positive y
};

/// A plot of lines with a logarithmic y axis.
struct LinePlot {
  enum class Unit { Seconds, None };  ///< of y
  std::string title;
  std::string x_label;
  std::string y_label;
  Unit unit = Unit::Seconds;
  bool log_x = false;
  std::vector<Series> series;
};

/// A picture of its own: white background, axes with a grid, a legend.
std::string to_svg(const LinePlot& plot);

/// A column for x and one for each series; empty where a series has no point.
std::string to_csv(const LinePlot& plot);

}  // namespace encase::benchmark
