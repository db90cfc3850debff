// SPDX-License-Identifier: MIT
#include "encase/svg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "tests/encased.hpp"
#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

/// What is wrong with the nesting of an XML text, or nothing.
std::string nesting_error(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "unclosed tag";
    const std::string tag = text.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "'<' in " + tag;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag[0] == '/') {
      if (open.empty() || "/" + open.back() != tag) return "unexpected " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "unclosed " + open.back();
}

struct Dot {
  double x, y, r;
};

std::vector<Dot> dots(const std::string& svg) {
  static const std::regex circle("cx=\"([^\"]*)\" cy=\"([^\"]*)\" r=\"([^\"]*)\"");
  std::vector<Dot> found;
  for (std::sregex_iterator k(svg.begin(), svg.end(), circle), end; k != end; ++k)
    found.push_back({std::stod((*k)[1]), std::stod((*k)[2]), std::stod((*k)[3])});
  return found;
}

SvgOptions bare() {
  SvgOptions options;
  options.size = 400;
  options.legend = options.axes = false;
  return options;
}

Unresolved place(const Box<2>& box, const std::string& reason) {
  Unresolved p;
  p.kind = Unresolved::Kind::Contact;
  p.box = box;
  p.has_box = true;
  p.reason = reason;
  return p;
}

TEST(Svg, PutsCrossingsWhereTheyAreWithYUp) {
  const Encasement e = sample::circle_and_line();
  const auto found = dots(to_svg(e, bare()));
  ASSERT_EQ(found.size(), 2u);
  // 400 pixels for [-1,1], a margin of 8.
  EXPECT_NEAR(found[0].x, 8 + 200 * (e.crossings[0].point[0] + 1), 0.01);
  EXPECT_NEAR(found[0].y, 8 + 200 * (1 - e.crossings[0].point[1]), 0.01);
  EXPECT_NEAR(found[1].y, 8 + 200 * (1 - e.crossings[1].point[1]), 0.01);
}

TEST(Svg, DrawsTheCircleAsAClosedSmoothPath) {
  const std::string svg = to_svg(sample::circle_and_line(), bare());
  const std::size_t start = svg.find(" d=\"", svg.find("<g id=\"curves\">")) + 4;
  const std::string path = svg.substr(start, svg.find('"', start) - start);
  EXPECT_EQ(path.back(), 'Z');
  static const std::regex point("[ML]([0-9.]+) ([0-9.]+)");
  int points = 0;
  for (std::sregex_iterator k(path.begin(), path.end(), point), end; k != end; ++k, ++points) {
    const double x = std::stod((*k)[1]) - 208, y = std::stod((*k)[2]) - 208;
    EXPECT_NEAR(std::hypot(x, y), 200 * std::sqrt(0.5), 0.05);
  }
  EXPECT_GT(points, 30);
}

TEST(Svg, EscapesNames) {
  Encasement e = sample::circle_and_line();
  e.curves[0].name = "a<b & \"c\" > d\x01";
  e.degenerate = {place({{0, 0}, {0.5, 0.5}}, "1 < 2 & so on")};
  const std::string svg = to_svg(e);
  EXPECT_EQ(nesting_error(svg), "");
  EXPECT_NE(svg.find("a&lt;b &amp; &quot;c&quot; &gt; d "), std::string::npos);
  EXPECT_NE(svg.find("1 &lt; 2 &amp; so on"), std::string::npos);
  EXPECT_EQ(svg.find('\x01'), std::string::npos);
}

TEST(Svg, RingsAPlaceTooSmallToSee) {
  Encasement e = sample::circle_and_line();
  e.outcome = Outcome::Degenerate;
  e.degenerate = {place({{0.5, 0.5}, {0.5 + 1e-12, 0.5 + 1e-12}}, "contact")};
  const auto found = dots(to_svg(e, bare()));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[2].x, 308, 0.01);
  EXPECT_NEAR(found[2].y, 108, 0.01);
  EXPECT_GE(found[2].r, 5);
}

TEST(Svg, RingsTinyCellsThatAreNotCertifiedOnceAPlace) {
  Encasement e = sample::circle_and_line();
  Cell tiny = e.cells[2];
  tiny.state = CellState::Undecided;
  for (Vertex& vertex : tiny.vertices)
    for (int axis = 0; axis < 2; ++axis) vertex.point[axis] = 0.5 + 1e-3 * vertex.point[axis];
  e.cells.insert(e.cells.end(), 5, tiny);
  EXPECT_EQ(dots(to_svg(e, bare())).size(), 3u);
}

TEST(Svg, LeavesOutCrossingsBeyondTheRegionUsed) {
  Encasement e = sample::circle_and_line();
  e.crossings[0].location = Location::Outside;
  EXPECT_EQ(dots(to_svg(e, bare())).size(), 2u);
  e.crossings[0].cell = -1;
  EXPECT_EQ(dots(to_svg(e, bare())).size(), 1u);
}

TEST(Svg, NamesInTheLegendWhatIsDrawnAndNothingElse) {
  Encasement e = sample::circle_and_line();
  std::string svg = to_svg(e);
  for (const char* text : {">circle<", ">line<", ">crossing<", ">critical region<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  for (const char* text : {"relaxed", "degenerate", "undecided", "outside"})
    EXPECT_EQ(svg.find(text), std::string::npos) << text;
  e.cells[0].state = CellState::Relaxed;
  e.cells[1].state = CellState::Degenerate;
  e.cells[2].state = CellState::Undecided;
  e.crossings[0].location = Location::Outside;
  e.critical_regions.clear();
  svg = to_svg(e);
  EXPECT_EQ(nesting_error(svg), "");
  for (const char* text :
       {">relaxed cell<", ">degenerate<", ">undecided<", ">outside the region<", ">crossing<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(svg.find(">critical region<"), std::string::npos);
}

TEST(Svg, StaysInBoundsForRegionsOfAnySizeAndShape) {
  const Rational tiny("1/1000000000000"), huge("100000000000000000000");
  const std::vector<std::vector<RationalPoint<2>>> regions = {
      {{0, 0}, {tiny, 0}, {tiny, tiny}, {0, tiny}},
      {{-huge, -huge}, {huge, -huge}, {huge, huge}, {-huge, huge}},
      {{0, 0}, {1000, 0}, {1000, 1}, {0, 1}},
      {{0, 0}, {1, 0}, {1, 1000}, {0, 1000}},
      {{1000000000, 0}, {1000000001, 0}, {1000000001, 1}},
      {{0, 0}, {3, 1}, {2, 4}, {-1, 3}}};
  for (const auto& corners : regions) {
    Encasement e = sample::circle_and_line();
    e.region = e.region_used = make_region(corners).value();
    for (Cell& cell : e.cells) cell.branches.clear();
    const Box<2> box = e.region.bounding_box();
    e.crossings[0].point = {box.hi[0], box.hi[1]};
    e.crossings[1].point = {box.lo[0], box.lo[1]};
    const std::string svg = to_svg(e);
    EXPECT_EQ(nesting_error(svg), "");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    std::smatch size;
    ASSERT_TRUE(
        std::regex_search(svg, size, std::regex("width=\"([0-9.]+)\" height=\"([0-9.]+)\"")));
    const double width = std::stod(size[1]), height = std::stod(size[2]);
    EXPECT_LE(std::max(width, height), 1000);
    EXPECT_GE(std::min(width, height), 60);
    for (const Dot& dot : dots(svg)) {
      EXPECT_GE(dot.x, 0);
      EXPECT_LE(dot.x, width);
      EXPECT_GE(dot.y, 0);
      EXPECT_LE(dot.y, height);
    }
    // Every axis has at least two marks.
    static const std::regex mark("text-anchor");
    EXPECT_GE(
        std::distance(std::sregex_iterator(svg.begin(), svg.end(), mark), std::sregex_iterator()),
        4);
  }
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Svg, FillsTheFacesOfTheArrangement) {
  SvgOptions options = bare();
  options.faces = true;
  const std::string svg = to_svg(sample::circle_and_line(), options);
  EXPECT_EQ(nesting_error(svg), "");
  EXPECT_EQ(svg.find("id=\"cells\""), std::string::npos);
  static const std::regex face("<path fill=\"([^\"]*)\" d=\"[^\"]*\"><title>face");
  std::set<std::string> tints;
  int faces = 0;
  for (std::sregex_iterator k(svg.begin(), svg.end(), face), end; k != end; ++k, ++faces)
    tints.insert((*k)[1]);
  EXPECT_EQ(faces, 4);
  EXPECT_EQ(tints.size(), 4u);
  // Two edges on the circle, three on the line; two of its ends and four corners.
  EXPECT_EQ(count(svg, "<title>edge "), 5);
  EXPECT_EQ(count(svg, " of circle: faces "), 2);
  EXPECT_EQ(count(svg, "<title>vertex "), 6);
  EXPECT_EQ(svg.find("id=\"curves\""), std::string::npos);
  // Not certified: cells as always.
  Encasement e = sample::circle_and_line();
  e.outcome = Outcome::Undecided;
  EXPECT_NE(to_svg(e, options).find("id=\"cells\""), std::string::npos);
}

TEST(Svg, LeavesHolesInFaces) {
  SvgOptions options = bare();
  options.faces = true;
  const std::string svg = to_svg(encased::run({"x^2 + y^2 - 1/2", "x^2 + y^2 - 1/8"}), options);
  EXPECT_NE(svg.find("<g id=\"faces\" fill-rule=\"evenodd\">"), std::string::npos);
  // The region with one hole, a ring, and a disc without.
  std::vector<int> boundaries;
  static const std::regex face(" d=\"([^\"]*)\"><title>face");
  for (std::sregex_iterator k(svg.begin(), svg.end(), face), end; k != end; ++k)
    boundaries.push_back(count((*k)[1], "M"));
  std::sort(boundaries.begin(), boundaries.end());
  EXPECT_EQ(boundaries, (std::vector<int>{1, 2, 2}));
}

struct Label {
  double x, y;
  std::string text;
};

std::vector<Label> labels(const std::string& svg) {
  static const std::regex text("<text x=\"([^\"]*)\" y=\"([^\"]*)\" font-size[^>]*>([fev][0-9]+)<");
  std::vector<Label> found;
  for (std::sregex_iterator k(svg.begin(), svg.end(), text), end; k != end; ++k)
    found.push_back({std::stod((*k)[1]), std::stod((*k)[2]), (*k)[3]});
  return found;
}

TEST(Svg, LabelsWhatHasRoom) {
  SvgOptions options = bare();
  options.labels = true;
  const Encasement e = sample::circle_and_line();
  const std::string svg = to_svg(e, options);
  EXPECT_EQ(nesting_error(svg), "");
  EXPECT_NE(svg.find("id=\"cells\""), std::string::npos);
  const std::vector<Label> found = labels(svg);
  std::set<std::string> texts;
  for (const Label& label : found) texts.insert(label.text);
  const Arrangement a = arrange(e).value();
  EXPECT_EQ(texts.size(), found.size());
  EXPECT_EQ(found.size(), a.faces.size() - 1 + a.edges.size() + a.vertices.size());
  // Faces are labelled inside.
  const PointLocator locator(e, a);
  for (const Label& label : found)
    if (label.text[0] == 'f') {
      const Point<2> at = {(label.x - 208) / 200, (208 - label.y + 4) / 200};
      EXPECT_EQ("f" + std::to_string(locator.locate(at).index), label.text);
    }
  // None where nothing is certified, and only those that find room in a small picture.
  Encasement undecided = e;
  undecided.outcome = Outcome::Undecided;
  EXPECT_TRUE(labels(to_svg(undecided, options)).empty());
  options.size = 50;
  EXPECT_LT(labels(to_svg(e, options)).size(), found.size());
}

TEST(Svg, LabelsDoNotOverlap) {
  SvgOptions options = bare();
  options.labels = true;
  for (const int size : {50, 100, 200, 400}) {
    options.size = size;
    const std::vector<Label> found = labels(to_svg(sample::circle_and_line(), options));
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(std::max(std::fabs(found[i].x - found[j].x), std::fabs(found[i].y - found[j].y)),
                  6)
            << found[i].text << " on " << found[j].text << " at size " << size;
  }
}

TEST(Svg, MarksRoundCoordinates) {
  const std::string svg = to_svg(sample::circle_and_line());
  for (const char* text : {">\u22121.0<", ">\u22120.5<", ">0.0<", ">0.5<", ">1.0<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Svg, IsDeterministicAndDrawsNothingForNothing) {
  EXPECT_EQ(to_svg(sample::circle_and_line()), to_svg(sample::circle_and_line()));
  Encasement empty;
  empty.region = empty.region_used = sample::square();
  EXPECT_EQ(nesting_error(to_svg(empty)), "");
}

}  // namespace
}  // namespace encase
