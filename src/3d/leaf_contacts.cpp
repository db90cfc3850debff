// SPDX-License-Identifier: MIT
#include "3d/leaf_contacts.hpp"

#include <utility>

namespace encase {

namespace {

int axis_of(const Plane& plane) { return plane.normal[0] != 0 ? 0 : plane.normal[1] != 0 ? 1 : 2; }

/// A box whose sides lie in named planes.
struct NamedBox {
  Box<3> box;
  std::array<int, 6> bounds;

  /// Keeps the part below or above a cut; false if nothing is left.
  bool keep(int axis, bool upper, double at, int plane) {
    if (upper && at > box.lo[axis]) {
      box.lo[axis] = at;
      bounds[static_cast<std::size_t>(2 * axis)] = plane;
    } else if (!upper && at < box.hi[axis]) {
      box.hi[axis] = at;
      bounds[static_cast<std::size_t>(2 * axis + 1)] = plane;
    }
    return box.lo[axis] < box.hi[axis];
  }
};

class ContactFinder {
 public:
  explicit ContactFinder(const BoxPartition& partition) : p_(partition) {}

  std::vector<LeafContact> run() {
    const NamedBox root{p_.root, p_.root_planes};
    for (int side = 0; side < 6; ++side) {
      const int plane = p_.root_planes[static_cast<std::size_t>(side)], axis = side / 2;
      if (plane < 0) continue;
      // The root lies on the negative side of its sides.
      NamedBox rectangle = root;
      (side % 2 == 0 ? rectangle.box.hi : rectangle.box.lo)[axis] =
          (side % 2 == 0 ? rectangle.box.lo : rectangle.box.hi)[axis];
      touch({plane, axis, side % 2 == 0}, root_node(), kOutside, rectangle);
    }
    visit(root_node(), root);
    return std::move(contacts_);
  }

  std::vector<BoundedLeaf> leaves() const {
    std::vector<BoundedLeaf> result(p_.history.size() + 1);
    std::vector<std::pair<int, NamedBox>> stack{{root_node(), {p_.root, p_.root_planes}}};
    while (!stack.empty()) {
      const auto [node, box] = stack.back();
      stack.pop_back();
      if (!is_node(node)) {
        result[static_cast<std::size_t>(~node)] = {box.box, box.bounds};
        continue;
      }
      const Split& split = p_.history[static_cast<std::size_t>(node)];
      const int axis = axis_of(p_.planes[static_cast<std::size_t>(split.line)]);
      for (const bool upper : {false, true}) {
        NamedBox part = box;
        part.keep(axis, upper, cut(split, axis), split.line);
        stack.emplace_back(child(split, axis, upper), part);
      }
    }
    return result;
  }

 private:
  static constexpr int kOutside = 1 << 30;  ///< in place of a node
  struct Side {
    int plane, axis;
    bool reversed;  ///< what has the larger coordinates lies on the plane's negative side
  };

  int root_node() const { return p_.history.empty() ? ~0 : 0; }
  bool is_node(int node) const { return node >= 0 && node != kOutside; }
  double cut(const Split& split, int axis) const {
    const Plane& plane = p_.planes[static_cast<std::size_t>(split.line)];
    return -plane.offset / plane.normal[axis];  // exact: the normal is a unit one
  }
  /// The child with the smaller coordinates, or that with the larger ones.
  int child(const Split& split, int axis, bool upper) const {
    const bool along = p_.planes[static_cast<std::size_t>(split.line)].normal[axis] > 0;
    return upper == along ? split.positive : split.negative;
  }

  /// All contacts within a node.
  void visit(int node, const NamedBox& box) {
    if (!is_node(node)) return;
    const Split& split = p_.history[static_cast<std::size_t>(node)];
    const Plane& coefficients = p_.planes[static_cast<std::size_t>(split.line)];
    const int axis = axis_of(coefficients);
    const double at = cut(split, axis);
    for (const bool upper : {false, true}) {
      NamedBox part = box;
      if (part.keep(axis, upper, at, split.line)) visit(child(split, axis, upper), part);
    }
    NamedBox rectangle = box;
    rectangle.box.lo[axis] = rectangle.box.hi[axis] = at;
    touch({split.line, axis, coefficients.normal[axis] < 0}, split.negative, split.positive,
          rectangle);
  }

  /// The contacts of the leaves of two nodes, on both sides of a plane, that lie in a rectangle.
  void touch(const Side& side, int negative, int positive, const NamedBox& rectangle) {
    for (const bool second : {false, true}) {
      const int node = second ? positive : negative;
      if (!is_node(node)) continue;
      const Split& split = p_.history[static_cast<std::size_t>(node)];
      const int axis = axis_of(p_.planes[static_cast<std::size_t>(split.line)]);
      const double at = cut(split, axis);
      for (const bool upper : {false, true}) {
        NamedBox part = rectangle;
        if (axis == side.axis) {
          // Only the child next to the plane touches it.
          if (upper != (second == side.reversed)) continue;
        } else if (!part.keep(axis, upper, at, split.line)) {
          continue;
        }
        const int next = child(split, axis, upper);
        touch(side, second ? negative : next, second ? next : positive, part);
      }
      return;
    }
    const auto leaf = [](int node) { return node == kOutside ? -1 : ~node; };
    contacts_.push_back(
        {side.plane, {leaf(negative), leaf(positive)}, rectangle.box, rectangle.bounds});
  }

  const BoxPartition& p_;
  std::vector<LeafContact> contacts_;
};

}  // namespace

std::vector<BoundedLeaf> bounded_leaves(const BoxPartition& partition) {
  return ContactFinder(partition).leaves();
}

std::vector<LeafContact> leaf_contacts(const BoxPartition& partition) {
  return ContactFinder(partition).run();
}

}  // namespace encase
