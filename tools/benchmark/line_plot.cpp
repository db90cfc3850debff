// SPDX-License-Identifier: MIT
#include "line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace encase::benchmark {
namespace {

constexpr double kWidth = 760, kHeight = 440;
constexpr double kLeft = 84, kRight = 190, kTop = 48, kBottom = 56;
// Told apart also by the colour-blind (Okabe and Ito).
constexpr std::array<const char*, 6> kColors{"#0072B2", "#D55E00", "#009E73",
                                             "#CC79A7", "#8C6D00", "#56B4E9"};
constexpr int kShapes = 3;

/// One axis: from data to the plot's pixels.
struct Axis {
  bool log = false;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  double from = 0, to = 1;  // pixels

  double scaled(double v) const { return log ? std::log10(v) : v; }
  void include(double v) {
    least = std::min(least, scaled(v));
    most = std::max(most, scaled(v));
  }
  /// Adds a part of the length at both ends, and what is missing from `shortest`.
  void widen(double part, double shortest) {
    if (!std::isfinite(least)) least = most = 0;
    const double length = most - least, room = std::max(part * length, 0.5 * (shortest - length));
    least -= room;
    most += room;
  }
  double at(double v) const { return from + (to - from) * (scaled(v) - least) / (most - least); }
};

struct Tick {
  double value;
  bool labelled;
};

/// The powers of ten with a label each, and between them what the length of the range allows.
std::vector<Tick> log_ticks(const Axis& axis) {
  const double length = axis.most - axis.least;
  const std::vector<double> multiples =
      length < 1 ? std::vector<double>{1, 1.5, 2, 3, 5, 7} : std::vector<double>{1, 2, 5};
  std::vector<Tick> ticks;
  for (int e = static_cast<int>(std::floor(axis.least)); e <= std::ceil(axis.most); ++e)
    for (const double m : multiples) {
      const double value = m * std::pow(10.0, e), l = std::log10(value);
      if (l >= axis.least - 1e-9 && l <= axis.most + 1e-9)
        ticks.push_back({value, m == 1 || length < 2.2});
    }
  return ticks;
}

std::vector<Tick> linear_ticks(const Axis& axis) {
  std::vector<Tick> ticks;
  const double step = axis.most - axis.least > 11 ? 2 : 1;
  for (double v = std::ceil(axis.least / step) * step; v <= axis.most + 1e-9; v += step)
    ticks.push_back({v, true});
  return ticks;
}

/// 0.00002 s is "20 µs".
std::string seconds_label(double seconds) {
  constexpr std::array<std::pair<double, const char*>, 4> kUnits{
      {{1, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {1e-9, "ns"}}};
  for (const auto& [size, name] : kUnits)
    if (seconds >= size * (1 - 1e-9)) return fmt::format("{:.4g} {}", seconds / size, name);
  return fmt::format("{:.0e} s", seconds);
}

std::string number_label(double value) {
  if (value < 1e4) return fmt::format("{:.4g}", value);
  return value < 1e6 ? fmt::format("{:.4g} 000", value / 1e3)
                     : fmt::format("{:.4g} million", value / 1e6);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return result;
}

std::string marker(int series, double x, double y) {
  const char* color = kColors[series % kColors.size()];
  switch (series % kShapes) {
    case 0:
      return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.5' fill='{}'/>\n", x, y, color);
    case 1:
      return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='6.4' height='6.4' fill='{}'/>\n",
                         x - 3.2, y - 3.2, color);
    default:
      return fmt::format("<path d='M{:.1f} {:.1f}l4.4 7.4h-8.8z' fill='{}'/>\n", x, y - 4.6, color);
  }
}

std::string line(int series, const std::string& path) {
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='2'/>\n", path,
                     kColors[series % kColors.size()]);
}

std::string grid(const Axis& x, const Axis& y, const LinePlot& plot) {
  std::string svg;
  for (const Tick& tick : plot.log_x ? log_ticks(x) : linear_ticks(x)) {
    const double at = x.at(tick.value);
    svg += fmt::format("<path d='M{0:.1f} {1:.1f}V{2:.1f}' stroke='#eeeeee'/>\n", at, y.from, y.to);
    if (tick.labelled)
      svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:g}</text>\n", at,
                         y.from + 20, tick.value);
  }
  for (const Tick& tick : log_ticks(y)) {
    const double at = y.at(tick.value);
    svg += fmt::format("<path d='M{1:.1f} {0:.1f}H{2:.1f}' stroke='{3}'/>\n", at, x.from, x.to,
                       tick.labelled ? "#cccccc" : "#eeeeee");
    if (tick.labelled)
      svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{}</text>\n", x.from - 8,
                         at + 4,
                         plot.unit == LinePlot::Unit::Seconds ? seconds_label(tick.value)
                                                              : number_label(tick.value));
  }
  return svg;
}

std::string frame_and_titles(const LinePlot& plot) {
  const double middle = (kLeft + kWidth - kRight) / 2, height = (kTop + kHeight - kBottom) / 2;
  return fmt::format(
             "<path d='M{0} {1}V{2}H{3}' fill='none' stroke='#333333' stroke-width='1.2'/>\n",
             kLeft, kTop, kHeight - kBottom, kWidth - kRight) +
         fmt::format("<text x='{}' y='28' font-size='16' text-anchor='middle'>{}</text>\n",
                     kWidth / 2, escaped(plot.title)) +
         fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", middle, kHeight - 14,
                     escaped(plot.x_label)) +
         fmt::format(
             "<text transform='translate(18 {}) rotate(-90)' text-anchor='middle'>{}</text>\n",
             height, escaped(plot.y_label));
}

std::string curves_and_legend(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  double legend = kTop + 12;
  for (int k = 0; k < static_cast<int>(plot.series.size()); ++k) {
    std::string path, markers;
    for (const auto& [u, v] : plot.series[k].points) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.at(u), y.at(v));
      markers += marker(k, x.at(u), y.at(v));
    }
    svg += line(k, path) + markers;
    const double left = kWidth - kRight + 16;
    svg += line(k, fmt::format("M{} {}h28", left, legend)) + marker(k, left + 14, legend) +
           fmt::format("<text x='{}' y='{}'>{}</text>\n", left + 36, legend + 4,
                       escaped(plot.series[k].name));
    legend += 24;
  }
  return svg;
}

}  // namespace

std::string to_svg(const LinePlot& plot) {
  Axis x, y;
  x.log = plot.log_x;
  y.log = true;
  for (const Series& series : plot.series)
    for (const auto& [u, v] : series.points) {
      x.include(u);
      y.include(v);
    }
  // Room around the lines; at least a power of ten, so that noise does not fill the picture.
  x.widen(0.03, x.log ? 0.1 : 2);
  y.widen(0.06, 1);
  x.from = kLeft;
  x.to = kWidth - kRight;
  y.from = kHeight - kBottom;
  y.to = kTop;
  return fmt::format(
             "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' "
             "viewBox='0 0 {0} {1}' font-family='sans-serif' font-size='13' fill='#222222'>\n"
             "<rect width='{0}' height='{1}' fill='white'/>\n",
             kWidth, kHeight) +
         grid(x, y, plot) + frame_and_titles(plot) + curves_and_legend(plot, x, y) + "</svg>\n";
}

std::string to_csv(const LinePlot& plot) {
  std::map<double, std::vector<std::string>> rows;
  std::string text = plot.x_label;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    text += "," + plot.series[k].name;
    for (const auto& [u, v] : plot.series[k].points) {
      auto& row = rows[u];
      row.resize(plot.series.size());
      row[k] = fmt::format("{:.6g}", v);
    }
  }
  for (const auto& [u, row] : rows) text += fmt::format("\n{},{}", u, fmt::join(row, ","));
  return text + "\n";
}

}  // namespace encase::benchmark
