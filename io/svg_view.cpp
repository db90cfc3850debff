// SPDX-License-Identifier: MIT
#include "svg_view.hpp"

#include <fmt/format.h>

#include <cmath>

namespace encase {
namespace {

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

}  // namespace encase
