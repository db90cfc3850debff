// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "caps_json.hpp"
#include "expression_parser.hpp"
#include "names.hpp"

namespace encase {
namespace {

NamedCurve read_curve(const JsonNode& node) {
  const JsonNode text = node.member("expression");
  auto function = parse_function<2>(text.text());
  if (const auto* e = std::get_if<SyntaxError>(&function))
    text.fail("at character " + std::to_string(e->offset + 1) + ": " + e->message);
  return {node.member("name").text(), std::move(std::get<Function<2>>(function))};
}

CapsObstacles read_obstacles(const JsonNode& node) {
  const auto count = [&](const char* key) {
    return static_cast<int>(node.member(key).integer(0, std::numeric_limits<int>::max()));
  };
  return {count("unexamined_leaves"), count("indeterminate_leaves"), count("open_vertices"),
          count("open_edges")};
}

CapsLeaf read_leaf(const JsonNode& node, std::size_t sets, std::size_t regions) {
  node.of_size(5);
  CapsLeaf leaf;
  leaf.label = node.item(0).one_of(kCapsLabels);
  leaf.depth = static_cast<int>(node.item(1).integer(0, std::numeric_limits<int>::max()));
  leaf.curves = node.item(2).index(sets);
  leaf.region = node.item(3).index(regions);
  leaf.graph_axis = node.item(4).index_or_null(2);
  return leaf;
}

/// Reads the tokens and gives the leaves the boxes to which they lead.
std::vector<int> read_tree(const JsonNode& node, const Box<2>& root,
                           std::vector<CapsLeaf>* leaves) {
  std::vector<Box<2>> stack{root};
  std::vector<bool> seen(leaves->size());
  auto tokens = node.map([&](const JsonNode& item) {
    const int token = static_cast<int>(
        item.integer(CapsResult::kDivided, static_cast<std::int64_t>(leaves->size()) - 1));
    if (stack.empty()) item.fail("the quadtree has ended");
    const Box<2> box = stack.back();
    stack.pop_back();
    if (token == CapsResult::kDivided) {
      const std::array<Box<2>, 4> parts = caps_quarters(box);
      stack.insert(stack.end(), parts.rbegin(), parts.rend());
      return token;
    }
    const auto k = static_cast<std::size_t>(token);
    if (seen[k]) item.fail("the leaf is there twice");
    seen[k] = true;
    (*leaves)[k].box = box;
    return token;
  });
  if (!stack.empty() || std::find(seen.begin(), seen.end(), false) != seen.end())
    node.fail("the quadtree is not complete");
  return tokens;
}

CapsRegion read_region(const JsonNode& node, std::size_t sets, std::size_t regions) {
  CapsRegion region;
  region.label = node.member("label").one_of(kCapsLabels);
  region.curves = node.member("curves").index(sets);
  region.singular = node.member("singular").boolean();
  region.leaves =
      static_cast<int>(node.member("leaves").integer(0, std::numeric_limits<int>::max()));
  region.box = node.member("box").box();
  region.neighbours = node.member("neighbours").indices(regions);
  region.apart = node.member("apart").boolean();
  return region;
}

}  // namespace

CapsResult read_caps(const JsonNode& root) {
  if (root.member("command").text() != "caps")
    root.member("command").fail("expected a result of 'caps'");
  CapsResult r;
  r.answer = root.member("status").one_of(kCapsClasses);
  r.epsilon = root.member("epsilon").number();
  r.delta = root.member("delta").number();
  r.self_crossings = root.member("self_crossings").boolean();
  r.obstacles = read_obstacles(root.member("obstacles"));
  r.curves = root.member("curves").map(read_curve);
  r.box = root.member("box").box();
  if (root.member("cut").point() != kCapsCut)
    root.member("cut").fail("boxes are cut elsewhere by this version of encase");
  r.curve_sets = root.member("curve_sets").map([&](const JsonNode& set) {
    return set.indices(r.curves.size());
  });
  const auto regions = static_cast<std::size_t>(root.member("regions").size());
  r.leaves = root.member("leaves").map(
      [&](const JsonNode& leaf) { return read_leaf(leaf, r.curve_sets.size(), regions); });
  r.tokens = read_tree(root.member("tokens"), r.box, &r.leaves);
  r.regions = root.member("regions").map(
      [&](const JsonNode& region) { return read_region(region, r.curve_sets.size(), regions); });
  r.vertices = root.member("vertices").map([&](const JsonNode& node) {
    return CapsVertex{node.member("kind").one_of(kCapsVertexKinds),
                      node.member("region").index_or_null(regions),
                      node.member("curves").indices(r.curves.size()), node.member("box").box()};
  });
  r.edges = root.member("edges").map([&](const JsonNode& node) {
    return CapsEdge{node.member("curve").index(r.curves.size()),
                    node.member("vertices").indices(r.vertices.size()),
                    node.member("proved").boolean(),
                    node.member("polyline").map([](const JsonNode& p) { return p.point(); })};
  });
  r.nodes = root.member("statistics").member("nodes").count();
  r.evaluations = root.member("statistics").member("evaluations").count();
  return r;
}

}  // namespace encase
