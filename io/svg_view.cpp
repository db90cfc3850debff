// SPDX-License-Identifier: MIT
#include "svg_view.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace encase {
namespace {

// Okabe and Ito's colours, which people with any colour vision can tell apart, without yellow.
constexpr std::array<const char*, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                 "#cc79a7", "#56b4e9", "#e69f00"};
// More curves than colours: the same colours with other strokes.
constexpr std::array<const char*, 4> kDashes = {"", "7 3", "2 3", "9 3 2 3"};
constexpr double kLegendRow = 20;

bool continues_letter(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

std::string pixels(double value) {
  if (!std::isfinite(value)) return "0";
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return out;
}

int letters(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues_letter(c); }));
}

std::string shortened(const std::string& text, int most) {
  if (letters(text) <= most) return text;
  std::size_t end = 0;
  for (int seen = 0; end < text.size(); ++end)
    if (!continues_letter(text[end]) && ++seen == most) break;
  return text.substr(0, end) + "…";
}

Ticks make_ticks(double lo, double hi, double length) {
  Ticks ticks;
  const double wanted = std::clamp(length / 90, 2.0, 9.0);
  const double raw = (hi - lo) / wanted;
  if (!(raw > 0) || !std::isfinite(raw)) return ticks;
  const int exponent = static_cast<int>(std::floor(std::log10(raw)));
  const double power = std::pow(10.0, exponent);
  double step = 10 * power;
  for (const double unit : {1.0, 2.0, 5.0})
    if (unit * power >= raw) {
      step = unit * power;
      break;
    }
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step * 1.000001))));
  const double largest = std::max(std::fabs(lo), std::fabs(hi));
  const double slack = 1e-6 * step;
  for (double k = std::ceil((lo - slack) / step); k * step <= hi + slack; ++k) {
    const double value = k * step;
    if (value == ticks.values.size() && ticks.values.size() > 50) break;
    ticks.values.push_back(value);
    std::string text;
    if (largest < 1e6 && decimals <= 6)
      text = fmt::format("{:.{}f}", std::fabs(value), decimals);
    else
      text = fmt::format(
          "{:.{}g}", std::fabs(value),
          std::clamp(static_cast<int>(std::ceil(std::log10(largest / step))) + 2, 2, 17));
    // The sign of a number, not a hyphen.
    ticks.texts.push_back(
        (value < 0 && text.find_first_of("123456789") != text.npos ? "\u2212" : "") + text);
    if (ticks.values.size() > 50) break;
  }
  return ticks;
}

Frame::Frame(const Box<2>& box, int wanted_size, bool with_axes) {
  View& v = view;
  v.box = box;
  double w = v.box.width(0), h = v.box.width(1);
  if (!(w > 0)) w = 1;
  if (!(h > 0)) h = 1;
  const double size = std::max(wanted_size, 50);
  v.width = w >= h ? size : std::max(size * (w / h), size / 12);
  v.height = h >= w ? size : std::max(size * (h / w), size / 12);
  v.scale_x = v.width / w;
  v.scale_y = v.height / h;
  v.left = v.top = 8;
  if (!with_axes) return;
  x_ticks = make_ticks(v.box.lo[0], v.box.hi[0], v.width);
  y_ticks = make_ticks(v.box.lo[1], v.box.hi[1], v.height);
  int widest = 1;
  for (const std::string& text : y_ticks.texts) widest = std::max(widest, letters(text));
  v.left = 18 + kLetter * widest;
  right = 18;
  bottom = 30;
  if (!x_ticks.texts.empty()) {
    v.left = std::max(v.left, 4 + 0.5 * kLetter * letters(x_ticks.texts.front()));
    right = std::max(right, 4 + 0.5 * kLetter * letters(x_ticks.texts.back()));
  }
}

void Frame::add_legend(const std::vector<std::vector<LegendEntry>>& rows) {
  view.top = 14 + kLegendRow * static_cast<double>(rows.size());
  // A name wider than the picture.
  for (const auto& row : rows)
    for (const LegendEntry& entry : row)
      least_width = std::max(least_width, view.left + entry.width);
}

std::string axes(const Frame& frame) {
  const View& v = frame.view;
  const double bottom = v.top + v.height;
  std::string out;
  const auto add = std::back_inserter(out);
  out += "<g id=\"axes\" fill=\"#333\" stroke=\"none\">\n";
  // The frame of a region that is not a rectangle is only a reference.
  fmt::format_to(add,
                 "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                 "stroke=\"#bbb\" stroke-width=\"0.6\"/>\n",
                 pixels(v.left), pixels(v.top), pixels(v.width), pixels(v.height));
  std::string marks;
  for (const double value : frame.x_ticks.values)
    marks += "M" + pixels(v.x(value)) + " " + pixels(bottom) + "v5";
  for (const double value : frame.y_ticks.values)
    marks += "M" + pixels(v.left) + " " + pixels(v.y(value)) + "h-5";
  fmt::format_to(add, "<path fill=\"none\" stroke=\"#444\" stroke-width=\"0.8\" d=\"{}\"/>\n",
                 marks);
  for (std::size_t k = 0; k < frame.x_ticks.values.size(); ++k)
    fmt::format_to(add, "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                   pixels(v.x(frame.x_ticks.values[k])), pixels(bottom + 19),
                   frame.x_ticks.texts[k]);
  for (std::size_t k = 0; k < frame.y_ticks.values.size(); ++k)
    fmt::format_to(add, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
                   pixels(v.left - 9), pixels(v.y(frame.y_ticks.values[k]) + 4.2),
                   frame.y_ticks.texts[k]);
  return out + "</g>\n";
}

std::vector<std::vector<LegendEntry>> legend_rows(std::vector<LegendEntry> entries, double room) {
  std::vector<std::vector<LegendEntry>> rows;
  double used = 0;
  for (LegendEntry& entry : entries) {
    entry.width = 24 + 7 + kLetter * letters(entry.text) + 20;
    if (rows.empty() || used + entry.width - 20 > room) {
      rows.emplace_back();
      used = 0;
    }
    used += entry.width;
    rows.back().push_back(std::move(entry));
  }
  return rows;
}

std::string legend(const std::vector<std::vector<LegendEntry>>& rows, const Frame& frame) {
  std::string out = "<g id=\"legend\" fill=\"#222\">\n";
  const auto add = std::back_inserter(out);
  double y = 15;
  for (const auto& row : rows) {
    double x = frame.view.left;
    for (const LegendEntry& entry : row) {
      if (!entry.mark.empty())
        fmt::format_to(add, "<g transform=\"translate({} {})\">{}</g>\n", pixels(x + 12), pixels(y),
                       entry.mark);
      fmt::format_to(add, "<text x=\"{}\" y=\"{}\">{}</text>\n", pixels(x + 31), pixels(y + 4.2),
                     escaped(entry.text));
      x += entry.width;
    }
    y += kLegendRow;
  }
  return out + "</g>\n";
}

const char* colour(int curve) { return kColours[curve % kColours.size()]; }
const char* dash(int curve) { return kDashes[curve / kColours.size() % kDashes.size()]; }

}  // namespace encase
