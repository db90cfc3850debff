// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "2d/curve_bounds.hpp"
#include "encase/caps_output.hpp"
#include "svg_view.hpp"

namespace encase {
namespace {

constexpr const char* kSeveral = "#c1121f";
constexpr const char* kOpen = "#7b2cbf";
constexpr double kVisible = 0.6;     ///< smaller leaves, in pixels, have no outlines
constexpr double kSample = 2;        ///< pixels between the points at which curves are sampled
constexpr double kFineSample = 0.6;  ///< where a curve may oscillate
constexpr double kApart = 5;         ///< marks of equal kind nearer than this, in pixels, are one

using Kind = CapsVertex::Kind;

// Sampled curves cannot have dashes: further colours, darker than the first ones.
constexpr std::array<const char*, 6> kMoreColours = {"#08306b", "#7f2704", "#00441b",
                                                     "#67001f", "#3f007d", "#665200"};

const char* colour_of(int curve) {
  const int k = curve % 12;
  return k < 6 ? colour(k) : kMoreColours[static_cast<std::size_t>(k - 6)];
}

/// How a kind of vertex is marked, in the order of its enumerators.
struct Mark {
  const char* shape;  ///< of a path around (0, 0), or empty for a dot
  const char* style;
  const char* text;
};
constexpr std::array<Mark, 7> kMarks = {{
    {"", "fill=\"#1a1a1a\" stroke=\"#fff\" stroke-width=\"1.1\"", "crossing"},
    {"", "fill=\"#fff\" stroke=\"#1a1a1a\" stroke-width=\"1.4\"", "odd meeting"},
    {"", "fill=\"none\" stroke=\"#c1121f\" stroke-width=\"1.6\"", "even meeting or contact"},
    {"M-3.5 -3.5H3.5V3.5H-3.5Z", "fill=\"#c1121f\" stroke=\"#fff\" stroke-width=\"1\"",
     "three or more curves"},
    {"M0 -4.8L4.8 0L0 4.8L-4.8 0Z", "fill=\"#7b2cbf\" stroke=\"#fff\" stroke-width=\"1\"",
     "self-crossing"},
    {"M0 -4.8L4.2 3L-4.2 3Z", "fill=\"none\" stroke=\"#7b2cbf\" stroke-width=\"1.4\"",
     "indeterminate"},
    {"M-2.5 -2.5H2.5V2.5H-2.5Z", "fill=\"#444\"", "leaves the box"},
}};

const Mark& mark_of(Kind kind) { return kMarks[static_cast<std::size_t>(kind)]; }

class CapsPicture {
 public:
  CapsPicture(const CapsResult& result, const CapsSvgOptions& options)
      : r_(result), frame_(result.box, options.size, options.axes) {
    if (options.legend) {
      legend_ = legend_rows(legend_entries(), frame_.width() - view_.left - 8);
      frame_.add_legend(legend_);
    }
  }

  std::string draw(const CapsSvgOptions& options) {
    open();
    draw_leaves();
    draw_curves();
    draw_vertices();
    if (options.axes) out_ += axes(frame_);
    if (options.legend) out_ += legend(legend_, frame_);
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  const std::vector<int>& curves_in(const CapsLeaf& leaf) const {
    return r_.curve_sets[static_cast<std::size_t>(leaf.curves)];
  }

  void open() {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{2}\">\n",
        pixels(frame_.width()), pixels(frame_.height()), pixels(kFont));
    std::string names;
    for (const NamedCurve& curve : r_.curves) names += (names.empty() ? "" : ", ") + curve.name;
    add("<title>{}</title>\n", escaped("CAPS of " + names));
    add("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
  }

  std::string tint(const CapsLeaf& leaf) const {
    const bool one = curves_in(leaf).size() == 1;
    if (leaf.label == CapsLabel::Empty) return "";
    if (leaf.label == CapsLabel::OneCurve || one)
      return fmt::format("fill=\"{}\" fill-opacity=\"{}\"", colour_of(curves_in(leaf)[0]),
                         leaf.label == CapsLabel::OneCurve ? "0.12" : "0.3");
    return fmt::format("fill=\"{}\"", leaf.label == CapsLabel::Several ? kSeveral : kOpen);
  }

  /// Leaves too small to see are marked by a pixel, each of which is marked once.
  std::string pixel_of(const CapsLeaf& leaf, std::set<std::array<int, 3>>* seen) const {
    const Point<2> c = view_.center(leaf.box);
    const int x = static_cast<int>(c[0]), y = static_cast<int>(c[1]);
    if (!seen->insert({leaf.curves, x, y}).second) return "";
    return fmt::format("M{} {}h1v1h-1Z", x, y);
  }

  void draw_leaves() {
    std::vector<std::pair<std::string, std::string>> fills;
    std::string outlines;
    std::set<std::array<int, 3>> seen;
    for (const CapsLeaf& leaf : r_.leaves) {
      const bool visible = view_.extent(leaf.box) >= kVisible;
      if (visible) outlines += view_.rectangle(leaf.box);
      const std::string fill = tint(leaf);
      if (fill.empty()) continue;
      const std::string path = visible ? view_.rectangle(leaf.box) : pixel_of(leaf, &seen);
      auto found = std::find_if(fills.begin(), fills.end(),
                                [&](const auto& entry) { return entry.first == fill; });
      if (found == fills.end()) found = fills.insert(found, {fill, {}});
      found->second += path;
    }
    add("<g id=\"leaves\">\n");
    for (const auto& [fill, path] : fills) add("<path {} d=\"{}\"/>\n", fill, path);
    add("<path fill=\"none\" stroke=\"#9aa0a6\" stroke-width=\"0.35\" d=\"{}\"/>\n</g>\n",
        outlines);
  }

  /// The zeros of a curve in a leaf, sampled: where its sign changes on a grid of squares.
  std::string sampled(CurveBounds& curve, const CapsLeaf& leaf) const {
    const Box<2>& box = leaf.box;
    const NamedCurve& name = r_.curves[static_cast<std::size_t>(curves_in(leaf)[0])];
    const bool calm = leaf.graph_axis >= 0 && name.function.is_polynomial();
    const double step = calm ? kSample : kFineSample;
    std::array<int, 2> count;
    for (int i = 0; i < 2; ++i) {
      const double length = box.width(i) * (i == 0 ? view_.scale_x : view_.scale_y);
      count[i] = std::clamp(static_cast<int>(std::ceil(length / step)), 1, 2000);
    }
    const auto at = [&](int i, int j) -> Point<2> {
      return {box.lo[0] + box.width(0) * i / count[0], box.lo[1] + box.width(1) * j / count[1]};
    };
    const auto column = [&](int i) {
      std::vector<double> values;
      for (int j = 0; j <= count[1]; ++j) values.push_back(curve.value_at(at(i, j)).mid());
      return values;
    };
    std::string path;
    std::vector<double> left = column(0), right;
    for (int i = 0; i < count[0]; ++i, std::swap(left, right)) {
      right = column(i + 1);
      for (int j = 0; j < count[1]; ++j) {
        // Counter-clockwise.
        const std::array<Point<2>, 4> corner{at(i, j), at(i + 1, j), at(i + 1, j + 1),
                                             at(i, j + 1)};
        const std::size_t k = static_cast<std::size_t>(j);
        const std::array<double, 4> value{left[k], right[k], right[k + 1], left[k + 1]};
        std::vector<Point<2>> zeros;
        for (int s = 0; s < 4; ++s) {
          const double a = value[s], b = value[(s + 1) % 4];
          if (!std::isfinite(a) || !std::isfinite(b) || (a < 0) == (b < 0)) continue;
          const double t = a / (a - b);
          const Point<2>&p = corner[s], &q = corner[(s + 1) % 4];
          zeros.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
        }
        if (zeros.size() < 2 || !curve.look({corner[0], corner[2]}).continuous) continue;
        for (std::size_t z = 0; z + 1 < zeros.size(); z += 2)
          path += view_.path({zeros[z], zeros[z + 1]}, false);
      }
    }
    return path;
  }

  static std::string stroke(int curve) {
    std::string text =
        fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-linecap=\"round\"",
                    colour_of(curve));
    return text;
  }

  void draw_curves() {
    add("<g id=\"curves\">\n");
    for (int c = 0; c < static_cast<int>(r_.curves.size()); ++c) {
      CurveBounds curve(r_.curves[static_cast<std::size_t>(c)].function);
      std::string path;
      for (const CapsLeaf& leaf : r_.leaves)
        if (curves_in(leaf) == std::vector<int>{c} && view_.extent(leaf.box) >= kVisible)
          path += sampled(curve, leaf);
      if (!path.empty())
        add("<path {} d=\"{}\"><title>{}</title></path>\n", stroke(c), path,
            escaped(r_.curves[static_cast<std::size_t>(c)].name));
    }
    add("</g>\n");
  }

  static std::string marked(Kind kind, double x, double y) {
    const Mark& mark = mark_of(kind);
    if (!*mark.shape)
      return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3.4\" {}/>", pixels(x), pixels(y),
                         mark.style);
    return fmt::format("<path transform=\"translate({} {})\" d=\"{}\" {}/>", pixels(x), pixels(y),
                       mark.shape, mark.style);
  }

  void draw_vertices() {
    add("<g id=\"vertices\">\n");
    std::array<std::vector<Point<2>>, kMarks.size()> drawn;
    for (const bool open : {false, true})
      for (const CapsVertex& vertex : r_.vertices)
        if (open != (vertex.kind == Kind::Crossing || vertex.kind == Kind::Boundary))
          draw_vertex(vertex, &drawn);
    add("</g>\n");
  }

  void draw_vertex(const CapsVertex& vertex,
                   std::array<std::vector<Point<2>>, kMarks.size()>* drawn) {
    const Point<2> c = view_.center(vertex.box);
    std::vector<Point<2>>& others = (*drawn)[static_cast<std::size_t>(vertex.kind)];
    const bool near = std::any_of(others.begin(), others.end(), [&](const Point<2>& p) {
      return std::hypot(p[0] - c[0], p[1] - c[1]) < kApart;
    });
    if (near && vertex.kind != Kind::Crossing) return;
    others.push_back(c);
    add("{}\n", marked(vertex.kind, c[0], c[1]));
  }

  std::vector<LegendEntry> legend_entries() const {
    std::vector<LegendEntry> entries;
    constexpr std::size_t kMost = 24;
    for (std::size_t c = 0; c < std::min(r_.curves.size(), kMost); ++c)
      entries.push_back({fmt::format("<path {} d=\"M-11 0H11\"/>", stroke(static_cast<int>(c))),
                         shortened(r_.curves[c].name, 40)});
    if (r_.curves.size() > kMost)
      entries.push_back({"", fmt::format("and {} more", r_.curves.size() - kMost)});
    for (std::size_t kind = 0; kind < kMarks.size(); ++kind)
      if (std::any_of(r_.vertices.begin(), r_.vertices.end(), [&](const CapsVertex& vertex) {
            return static_cast<std::size_t>(vertex.kind) == kind;
          }))
        entries.push_back({marked(static_cast<Kind>(kind), 0, 0), kMarks[kind].text});
    return entries;
  }

  const CapsResult& r_;
  Frame frame_;
  const View& view_ = frame_.view;
  std::vector<std::vector<LegendEntry>> legend_;
  std::string out_;
};

}  // namespace

std::string to_svg(const CapsResult& result, const CapsSvgOptions& options) {
  return CapsPicture(result, options).draw(options);
}

}  // namespace encase
