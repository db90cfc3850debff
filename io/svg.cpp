// SPDX-License-Identifier: MIT
#include "encase/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "2d/piece_complex.hpp"
#include "2d/trace.hpp"
#include "encase/arrangement.hpp"
#include "svg_labels.hpp"
#include "svg_view.hpp"

namespace encase {
namespace {

// Faces: light enough for the curves' colours.
constexpr std::array<const char*, 8> kTints = {"#fbe8c8", "#d6e8f5", "#e2f0d9", "#f6dde6",
                                               "#e6e0f2", "#fdf6c9", "#d5efec", "#ececec"};
constexpr const char* kDegenerate = "#c1121f";
constexpr const char* kUndecided = "#7b2cbf";
constexpr double kRing = 7;         ///< radius of a ring around what is small
constexpr double kVisible = 8;      ///< an extent that needs no ring
constexpr double kTolerance = 0.1;  ///< pixels between a curve and what is drawn

class Picture {
 public:
  Picture(const Encasement& encasement, const SvgOptions& options)
      : e_(encasement), options_(options) {
    if (!options_.faces && !options_.labels) return;
    Result<Arrangement> arranged = arrange(e_);
    if (!arranged) return;
    arrangement_ = std::move(arranged).value();
    if (options_.faces) options_.cells = options_.critical_regions = false;
  }

  std::string draw() {
    lay_out();
    for (const Cell& cell : e_.cells)
      hatched_ |= options_.cells && cell.state == CellState::Relaxed;
    open();
    const bool faces = options_.faces && arrangement_;
    if (arrangement_)
      edges_ = trace_edges(e_, *arrangement_, kTolerance / std::max(view_.scale_x, view_.scale_y));
    if (faces) draw_faces();
    if (options_.cells) draw_cells();
    if (options_.critical_regions) draw_critical_regions();
    draw_region();
    if (faces)
      draw_edges();
    else
      draw_curves();
    if (faces) draw_vertices();
    draw_crossings();
    draw_unresolved();
    if (options_.labels && arrangement_) draw_labels();
    if (options_.axes) out_ += axes(frame_);
    if (options_.legend) out_ += legend(legend_rows_, frame_);
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  using Entry = LegendEntry;

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  void lay_out() {
    frame_ = Frame(e_.region_used.bounding_box(), options_.size, options_.axes);
    if (options_.legend) {
      make_legend();
      frame_.add_legend(legend_rows_);
    }
    // Where cells are crowded, their outlines must not fill the picture.
    std::vector<double> extents;
    for (const Cell& cell : e_.cells) extents.push_back(view_.extent(bounds(cell)));
    if (!extents.empty()) {
      std::nth_element(extents.begin(), extents.begin() + extents.size() / 2, extents.end());
      cell_stroke_ = std::clamp(0.02 * extents[extents.size() / 2], 0.35, 0.75);
    }
    crowded_ = e_.crossings.size() > 150 || e_.cells.size() > 3000;
  }

  static Box<2> bounds(const Cell& cell) {
    Box<2> box;
    if (cell.vertices.empty()) return box;
    box = {cell.vertices[0].point, cell.vertices[0].point};
    for (const Vertex& vertex : cell.vertices) box = hull(box, {vertex.point, vertex.point});
    return box;
  }

  void open() {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" "
        "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{2}\">\n",
        pixels(frame_.width()), pixels(frame_.height()), pixels(kFont));
    std::string names;
    for (const Curve& curve : e_.curves) names += (names.empty() ? "" : ", ") + curve.name;
    add("<title>{}</title>\n", escaped("Encasement of " + names));
    std::string region;
    for (const auto& corner : e_.region_used.corners) {
      const Point<2> p = {corner[0].get_d(), corner[1].get_d()};
      region += (region.empty() ? "M" : "L") + view_.point(p);
    }
    region_ = region + "Z";
    add("<defs>\n<clipPath id=\"encase-region\"><path d=\"{}\"/></clipPath>\n", region_);
    if (hatched_)
      add("<pattern id=\"encase-relaxed\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
          "patternTransform=\"rotate(45)\"><path d=\"M0 0V6\" stroke=\"#8d99ae\" "
          "stroke-width=\"1\"/></pattern>\n");
    add("</defs>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
  }

  static std::string tint(const Cell& cell) {
    if (cell.state == CellState::Degenerate) return "fill=\"#fce3e0\"";
    if (cell.state == CellState::Undecided) return "fill=\"#efe7f7\"";
    if (cell.crossing >= 0) return "fill=\"#fff7dc\"";
    if (cell.branches.empty()) return "fill=\"#fff\"";
    if (cell.branches.size() > 1) return "fill=\"#eef0f3\"";
    return fmt::format("fill=\"{}\" fill-opacity=\"0.07\"", colour(cell.branches[0].curve));
  }

  void draw_cells() {
    // One path a tint keeps files small; the order is that of first appearance.
    std::vector<std::pair<std::string, std::string>> fills;
    std::string outlines, relaxed;
    for (const Cell& cell : e_.cells) {
      std::vector<Point<2>> points;
      for (const Vertex& vertex : cell.vertices) points.push_back(vertex.point);
      const std::string path = view_.path(points, true);
      outlines += path;
      if (cell.state == CellState::Relaxed) relaxed += path;
      const std::string fill = tint(cell);
      auto found = std::find_if(fills.begin(), fills.end(),
                                [&](const auto& entry) { return entry.first == fill; });
      if (found == fills.end()) found = fills.insert(found, {fill, {}});
      found->second += path;
    }
    add("<g id=\"cells\">\n");
    for (const auto& [fill, path] : fills) add("<path {} d=\"{}\"/>\n", fill, path);
    if (!relaxed.empty())
      add("<path fill=\"url(#encase-relaxed)\" opacity=\"0.45\" d=\"{}\"/>\n", relaxed);
    add("<path fill=\"none\" stroke=\"#8f959c\" stroke-width=\"{}\" stroke-linejoin=\"round\" "
        "d=\"{}\"/>\n</g>\n",
        pixels(cell_stroke_), outlines);
  }

  /// Where a curve is negative its code is added without carry: faces with equal signs have the
  /// same tint, neighbours have different ones, and up to three curves give each face's signs a
  /// tint of their own.
  static const char* face_tint(const std::vector<Sign>& signs) {
    constexpr std::array<unsigned, 7> kCodes = {1, 2, 4, 7, 3, 5, 6};
    unsigned code = 0;
    for (std::size_t curve = 0; curve < signs.size(); ++curve)
      if (signs[curve] == Sign::Negative) code ^= kCodes[curve % kCodes.size()];
    return kTints[code];
  }

  void draw_faces() {
    add("<g id=\"faces\" fill-rule=\"evenodd\">\n");
    for (std::size_t f = 0; f < arrangement_->faces.size(); ++f) {
      const Arrangement::Face& face = arrangement_->faces[f];
      if (face.outer < 0) continue;
      std::string path, signs;
      for (const Polyline& points : boundaries(*arrangement_, edges_, face))
        path += view_.path(points, true);
      for (const Sign sign : face.signs) signs += sign == Sign::Positive ? "+" : "\u2212";
      add("<path fill=\"{}\" d=\"{}\"><title>face {}: {}</title></path>\n", face_tint(face.signs),
          path, f, signs);
    }
    add("</g>\n");
  }

  /// The curves edge by edge.
  void draw_edges() {
    add("<g id=\"edges\">\n");
    for (int curve = 0; curve < static_cast<int>(e_.curves.size()); ++curve) {
      add("<g {}>\n", stroke(curve));
      for (std::size_t k = 0; k < edges_.size(); ++k) {
        if (arrangement_->edges[k].curve != curve) continue;
        const bool loop = arrangement_->half_edges[2 * k].origin < 0;
        const auto [left, right] = arrangement_->faces_at(static_cast<int>(k));
        add("<path d=\"{}\"><title>edge {} of {}: faces {} and {}</title></path>\n",
            view_.path(edges_[k], loop), k, escaped(e_.curves[curve].name), left, right);
      }
      add("</g>\n");
    }
    add("</g>\n");
  }

  /// The vertices on the region's boundary; the others are the crossings.
  void draw_vertices() {
    add("<g id=\"vertices\" fill=\"#444\">\n");
    for (std::size_t v = 0; v < arrangement_->vertices.size(); ++v) {
      const Arrangement::Vertex& vertex = arrangement_->vertices[v];
      if (vertex.kind == Arrangement::Vertex::Kind::Crossing) continue;
      add("<path d=\"M{} {}h5v5h-5Z\"><title>vertex {}</title></path>\n",
          pixels(view_.x(vertex.point[0]) - 2.5), pixels(view_.y(vertex.point[1]) - 2.5), v);
    }
    add("</g>\n");
  }

  std::vector<Point<2>> in_pixels(const std::vector<Point<2>>& points) const {
    std::vector<Point<2>> result;
    for (const Point<2>& p : points) result.push_back({view_.x(p[0]), view_.y(p[1])});
    return result;
  }

  void draw_labels() {
    const Arrangement& a = *arrangement_;
    LabelPlacer placer({{view_.left - 1, view_.top - 1},
                        {view_.left + view_.width + 1, view_.top + view_.height + 1}});
    for (const Arrangement::Vertex& v : a.vertices)
      placer.keep_clear({view_.x(v.point[0]), view_.y(v.point[1])}, 4);
    std::string texts;
    for (std::size_t f = 0; f < a.faces.size(); ++f) {
      if (a.faces[f].outer < 0) continue;
      std::vector<std::vector<Point<2>>> all;
      for (const Polyline& points : boundaries(a, edges_, a.faces[f]))
        all.push_back(in_pixels(points));
      texts += placer.in_face("f" + std::to_string(f), all, "#555");
    }
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
      texts += placer.at_point("v" + std::to_string(v), in_pixels({a.vertices[v].point}).front(),
                               "#111");
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const int curve = a.edges[k].curve;
      texts += placer.along("e" + std::to_string(k), in_pixels(edges_[k]),
                            curve < 0 ? "#444" : colour(curve));
    }
    add("<g id=\"labels\" text-anchor=\"middle\" stroke=\"#fff\" stroke-width=\"2.5\" "
        "stroke-linejoin=\"round\" paint-order=\"stroke\">\n{}</g>\n",
        texts);
  }

  void draw_critical_regions() {
    if (e_.critical_regions.empty()) return;
    add("<g id=\"critical-regions\" clip-path=\"url(#encase-region)\">\n");
    for (const CriticalRegion& region : e_.critical_regions) {
      if (region.boxes.empty()) continue;
      Box<2> all = region.boxes.front();
      std::string path;
      for (const Box<2>& box : region.boxes) {
        all = hull(all, box);
        path += view_.rectangle(box);
      }
      const char* paint = colour(region.curve);
      if (view_.extent(all) >= 4) {
        add("<path fill=\"{0}\" fill-opacity=\"0.25\" stroke=\"{0}\" stroke-opacity=\"0.3\" "
            "stroke-width=\"0.4\" d=\"{1}\"/>\n",
            paint, path);
      } else {
        const Point<2> c = view_.center(all);
        add("<path fill=\"{0}\" fill-opacity=\"0.3\" stroke=\"{0}\" stroke-opacity=\"0.7\" "
            "stroke-width=\"0.8\" d=\"M{1} {2}h5v5h-5Z\"/>\n",
            paint, pixels(c[0] - 2.5), pixels(c[1] - 2.5));
      }
    }
    add("</g>\n");
  }

  void draw_region() {
    add("<path id=\"region\" fill=\"none\" stroke=\"#444\" stroke-width=\"1\" "
        "stroke-linejoin=\"miter\" d=\"{}\"/>\n",
        region_);
  }

  std::string stroke(int curve) const {
    std::string text =
        fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                    colour(curve), crowded_ ? "1.3" : "2");
    if (*dash(curve)) text += fmt::format(" stroke-dasharray=\"{}\"", dash(curve));
    return text;
  }

  /// Where a cell is not certified: dots where the curve seems to be.
  void draw_sketch(int curve) {
    std::string path;
    for (int k = 0; k < static_cast<int>(e_.cells.size()); ++k) {
      const Cell& cell = e_.cells[k];
      if (cell.state != CellState::Degenerate && cell.state != CellState::Undecided) continue;
      if (view_.extent(bounds(cell)) < kVisible) continue;
      for (const auto& segment :
           sketch_curve(e_, k, curve, 3 / std::max(view_.scale_x, view_.scale_y)))
        path += view_.path(segment, false);
    }
    if (!path.empty())
      add("<path fill=\"none\" stroke=\"{}\" stroke-opacity=\"0.45\" stroke-width=\"1.2\" "
          "d=\"{}\"/>\n",
          colour(curve), path);
  }

  void draw_curves() {
    const double tolerance = kTolerance / std::max(view_.scale_x, view_.scale_y);
    add("<g id=\"curves\">\n");
    for (int curve = 0; curve < static_cast<int>(e_.curves.size()); ++curve) {
      std::string path;
      for (const auto& chain : trace_curve(e_, curve, tolerance)) {
        const bool closed = chain.size() > 2 && chain.front() == chain.back();
        path += view_.path(chain, closed);
      }
      draw_sketch(curve);
      if (path.empty()) continue;
      add("<path {} d=\"{}\"><title>{}</title></path>\n", stroke(curve), path,
          escaped(e_.curves[curve].name));
    }
    add("</g>\n");
  }

  std::string dot(double x, double y, bool filled) const {
    return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>", pixels(x), pixels(y),
                       crowded_ ? "2.2" : "3.4",
                       filled ? "fill=\"#1a1a1a\" stroke=\"#fff\" stroke-width=\"1.1\""
                              : "fill=\"#fff\" stroke=\"#1a1a1a\" stroke-width=\"1.1\"");
  }

  /// Crossings are known a little beyond the region used, too.
  static bool is_drawn(const Crossing& crossing) {
    return crossing.location != Location::Outside || crossing.cell >= 0;
  }

  void draw_crossings() {
    if (e_.crossings.empty()) return;
    add("<g id=\"crossings\">\n");
    for (const Crossing& crossing : e_.crossings)
      if (is_drawn(crossing))
        add("{}\n", dot(view_.x(crossing.point[0]), view_.y(crossing.point[1]),
                        crossing.location != Location::Outside));
    add("</g>\n");
  }

  /// A ring around what may be too small to see, unless one is there already.
  void draw_ring(const Box<2>& box, const char* paint, const std::string& title) {
    const Point<2> c = view_.center(box);
    for (const auto& [at, its_paint] : rings_)
      if (its_paint == paint && std::hypot(at[0] - c[0], at[1] - c[1]) < kRing) return;
    rings_.emplace_back(c, paint);
    add("<circle fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" cx=\"{}\" cy=\"{}\" r=\"{}\">"
        "<title>{}</title></circle>\n",
        paint, pixels(c[0]), pixels(c[1]), pixels(kRing), escaped(title));
  }

  void draw_places(const std::vector<Unresolved>& places, CellState state, const char* paint) {
    for (const Unresolved& place : places) {
      if (!place.has_box) continue;
      if (view_.extent(place.box) < kVisible) {
        draw_ring(place.box, paint, place.reason);
        continue;
      }
      add("<path fill=\"{0}\" fill-opacity=\"0.12\" stroke=\"{0}\" stroke-width=\"1.2\" "
          "stroke-dasharray=\"4 2\" clip-path=\"url(#encase-region)\" "
          "d=\"{1}\"><title>{2}</title></path>\n",
          paint, view_.rectangle(place.box), escaped(place.reason));
    }
    for (const Cell& cell : e_.cells)
      if (cell.state == state && view_.extent(bounds(cell)) < kVisible)
        draw_ring(bounds(cell), paint,
                  state == CellState::Degenerate ? "degenerate cell" : "undecided cell");
  }

  void draw_unresolved() {
    add("<g id=\"unresolved\">\n");
    draw_places(e_.undecided, CellState::Undecided, kUndecided);
    draw_places(e_.degenerate, CellState::Degenerate, kDegenerate);
    add("</g>\n");
  }

  static std::string swatch(const std::string& fill, const std::string& outline) {
    return fmt::format(
        "<rect x=\"-9\" y=\"-6\" width=\"18\" height=\"12\" {} stroke=\"{}\" "
        "stroke-width=\"0.8\"/>",
        fill, outline);
  }

  void make_legend() {
    std::vector<Entry> entries;
    constexpr int kMost = 24;
    const int curves = static_cast<int>(e_.curves.size());
    for (int curve = 0; curve < std::min(curves, kMost); ++curve)
      entries.push_back({fmt::format("<path {} d=\"M-11 0H11\"/>", stroke(curve)),
                         shortened(e_.curves[curve].name, 40)});
    if (curves > kMost) entries.push_back({"", fmt::format("and {} more", curves - kMost)});
    const auto any_location = [&](bool outside) {
      return std::any_of(e_.crossings.begin(), e_.crossings.end(), [&](const Crossing& c) {
        return is_drawn(c) && (c.location == Location::Outside) == outside;
      });
    };
    const auto any_state = [&](CellState state) {
      return options_.cells && std::any_of(e_.cells.begin(), e_.cells.end(),
                                           [&](const Cell& cell) { return cell.state == state; });
    };
    if (any_location(false)) entries.push_back({dot(0, 0, true), "crossing"});
    if (any_location(true)) entries.push_back({dot(0, 0, false), "outside the region"});
    if (options_.critical_regions && !e_.critical_regions.empty()) {
      // In the colours of the curves that have some.
      std::string mark;
      std::vector<bool> has(e_.curves.size());
      for (const CriticalRegion& region : e_.critical_regions) has[region.curve] = true;
      const auto count = std::min<std::ptrdiff_t>(2, std::count(has.begin(), has.end(), true));
      double x = -6.5 * static_cast<double>(count);
      for (int curve = 0, seen = 0; curve < curves && seen < count; ++curve) {
        if (!has[curve]) continue;
        ++seen;
        mark += fmt::format(
            "<rect x=\"{0}\" y=\"-5.5\" width=\"11\" height=\"11\" fill=\"{1}\" "
            "fill-opacity=\"0.25\" "
            "stroke=\"{1}\" stroke-opacity=\"0.3\" stroke-width=\"0.4\"/>",
            pixels(x + 1), colour(curve));
        x += 13;
      }
      entries.push_back({mark, "critical region"});
    }
    if (any_state(CellState::Relaxed))
      entries.push_back({swatch("fill=\"#eef0f3\"", "#a3a8ae") +
                             "<rect x=\"-9\" y=\"-6\" width=\"18\" height=\"12\" "
                             "fill=\"url(#encase-relaxed)\" opacity=\"0.45\"/>",
                         "relaxed cell"});
    if (any_state(CellState::Degenerate) || !e_.degenerate.empty())
      entries.push_back({swatch("fill=\"#fce3e0\"", kDegenerate), "degenerate"});
    if (any_state(CellState::Undecided) || !e_.undecided.empty())
      entries.push_back({swatch("fill=\"#efe7f7\"", kUndecided), "undecided"});

    legend_rows_ = legend_rows(std::move(entries), frame_.width() - view_.left - 8);
  }

  const Encasement& e_;
  SvgOptions options_;
  std::optional<Arrangement> arrangement_;  ///< where faces are drawn or labelled
  std::vector<Polyline> edges_;             ///< of the arrangement
  Frame frame_;
  const View& view_ = frame_.view;
  double cell_stroke_ = 0.7;
  bool crowded_ = false;
  bool hatched_ = false;
  std::string region_;  ///< path of the region
  std::vector<std::pair<Point<2>, const char*>> rings_;
  std::vector<std::vector<Entry>> legend_rows_;
  std::string out_;
};

}  // namespace

std::string to_svg(const Encasement& encasement, const SvgOptions& options) {
  return Picture(encasement, options).draw();
}

}  // namespace encase
