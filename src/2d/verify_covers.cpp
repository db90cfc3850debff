// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "common/box_tests.hpp"
#include "common/segments.hpp"
#include "verify_claims.hpp"

namespace encase::verification {

namespace {

/// Into how many parts a leaf may be cut to prove what does not show on the whole of it.
constexpr int kLeafParts = 2000;
/// And how often the parts may be halved: at a pole it would go on and on.
constexpr int kLeafDepth = 40;

/// Halves a closed box at the double next to its middle: two closed boxes whose union it is. False
/// if there is no double in between.
bool halves(const Box<2>& box, std::size_t axis, Box<2>* lower, Box<2>* upper) {
  const double cut = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
  if (!(box.lo[axis] < cut && cut < box.hi[axis])) return false;
  *lower = *upper = box;
  lower->hi[axis] = upper->lo[axis] = cut;
  return true;
}

/// Whether `proves` holds on every part of some subdivision of a box on which it does not. Uses up
/// `parts`.
template <class Proves>
bool by_halves(const Box<2>& box, int depth, int* parts, const Proves& proves) {
  if (--*parts < 0 || depth == kLeafDepth) return false;
  // Across the longer side, unless only the other way gets somewhere.
  std::size_t axis = box.width(1) > box.width(0) ? 1 : 0;
  std::array<Box<2>, 2> half;
  std::array<bool, 2> proved{};
  for (int attempt = 0; attempt < 2 && !proved[0] && !proved[1]; ++attempt) {
    if (attempt > 0) axis = 1 - axis;
    if (!halves(box, axis, &half[0], &half[1])) return false;
    proved = {proves(half[0]), proves(half[1])};
  }
  if (!proved[0] && !proved[1]) halves(box, 1 - axis, &half[0], &half[1]);
  return (proved[0] || by_halves(half[0], depth + 1, parts, proves)) &&
         (proved[1] || by_halves(half[1], depth + 1, parts, proves));
}

template <class Proves>
bool by_parts(const Box<2>& box, const Proves& proves) {
  int parts = kLeafParts;
  return proves(box) || by_halves(box, 0, &parts, proves);
}

bool contains_region(const Box<2>& box, const Region& region) {
  for (const auto& corner : region.corners)
    for (std::size_t i = 0; i < 2; ++i)
      if (corner[i] < Rational(box.lo[i]) || corner[i] > Rational(box.hi[i])) return false;
  return true;
}

bool outside_region_used(Claims& claims, const Box<2>& box) {
  const Encasement& e = claims.result;
  for (int k = 0; k < e.region_used.side_count(); ++k)
    if (side(e.lines[static_cast<std::size_t>(k)], box, claims.kernel) == Sign::Positive)
      return true;
  return false;
}

/// Whether the box lies in that of an unresolved entry which names all the curves. A budget that
/// names none concerns all of them, and where one curve's function is not analytic its pairs are
/// not resolved.
bool unresolved(const Encasement& e, const Box<2>& box, const std::vector<int>& curves) {
  for (const auto* list : {&e.degenerate, &e.undecided})
    for (const Unresolved& u : *list) {
      if (!u.has_box || u.kind == Unresolved::Kind::SharedComponent ||
          u.kind == Unresolved::Kind::RepeatedComponent || !u.box.contains(box))
        continue;
      if (u.kind == Unresolved::Kind::Budget && u.curves.empty()) return true;
      if (std::includes(u.curves.begin(), u.curves.end(), curves.begin(), curves.end()))
        return true;
      if (u.kind == Unresolved::Kind::NotAnalytic &&
          std::any_of(curves.begin(), curves.end(), [&](int c) {
            return std::binary_search(u.curves.begin(), u.curves.end(), c);
          }))
        return true;
    }
  return false;
}

/// Replays a subdivision from its tokens. `check(token, box)` re-proves a leaf: nothing, or why
/// not. Returns whether the tokens describe a subdivision.
template <class Check>
bool replay(Claims& claims, const std::string& name, const Box<2>& root,
            const std::vector<int>& tokens, const Check& check) {
  std::vector<Box<2>> stack{root};
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (claims.full()) return false;
    if (!claims.require(!stack.empty(), name, " has tokens left after its last leaf."))
      return false;
    const Box<2> box = stack.back();
    stack.pop_back();
    const int token = tokens[i];
    if (token == cover::kSplitX || token == cover::kSplitY) {
      Box<2> lower, upper;
      if (!claims.require(halves(box, token == cover::kSplitX ? 0 : 1, &lower, &upper), name,
                          " splits a box that doubles cannot split, at token ", i, "."))
        return false;
      stack.push_back(upper);
      stack.push_back(lower);
      continue;
    }
    const char* objection = nullptr;
    if (token == cover::kOutside) {
      if (!outside_region_used(claims, box)) objection = "is not outside the region used";
    } else {
      objection = check(token, box);
    }
    claims.require(!objection, name, ": the leaf at token ", i, " ", objection ? objection : "",
                   ".");
  }
  return claims.require(stack.empty(), name, " ends before its last leaf.");
}

struct Less {
  bool operator()(const Box<2>& a, const Box<2>& b) const {
    return std::pair(a.lo, a.hi) < std::pair(b.lo, b.hi);
  }
};

/// Whether the union of closed boxes is connected.
bool connected(std::vector<Box<2>> boxes) {
  std::sort(boxes.begin(), boxes.end(), Less());
  std::vector<std::size_t> parent(boxes.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::size_t components = boxes.size();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lo[0] <= boxes[i].hi[0]; ++j) {
      if (!boxes[i].meets(boxes[j])) continue;
      const std::size_t a = find(i), b = find(j);
      if (a == b) continue;
      parent[a] = b;
      --components;
    }
  return components == 1;
}

bool splits(int token) { return token == cover::kSplitX || token == cover::kSplitY; }

/// For every split token of a subdivision the token at which its upper half begins.
std::vector<std::size_t> upper_halves(const std::vector<int>& tokens) {
  std::vector<std::size_t> upper(tokens.size()), stack;  // where subtrees begin, the next on top
  for (std::size_t i = tokens.size(); i-- > 0;) {
    if (splits(tokens[i])) {
      stack.pop_back();
      upper[i] = stack.back();
      stack.pop_back();
    }
    stack.push_back(i);
  }
  return upper;
}

/// For every token of a subdivision how many of the leaves below have a token k >= 0.
std::vector<int> named_leaves_below(const std::vector<int>& tokens,
                                    const std::vector<std::size_t>& upper_half) {
  std::vector<int> count(tokens.size());
  for (std::size_t i = tokens.size(); i-- > 0;)
    count[i] = splits(tokens[i]) ? count[i + 1] + count[upper_half[i]] : tokens[i] >= 0;
  return count;
}

/// Every curve has no zero in the leaves in whose lists it is not. Proved on the largest boxes of
/// the subdivision that have no other leaves, or else on smaller ones.
void check_absent_curves(Claims& claims) {
  const SharedCover& cover = claims.result.shared_cover;
  const std::vector<int> below = named_leaves_below(cover.tokens, claims.upper_half);
  std::vector<std::vector<int>> leaves_of(claims.curves.size());
  for (std::size_t k = 0; k < cover.alive.size(); ++k)
    for (int c : cover.alive[k])
      leaves_of[static_cast<std::size_t>(c)].push_back(static_cast<int>(k));
  struct Open {
    Box<2> box;
    std::vector<int> curves;  // not proved to have no zero in the box
  };
  std::vector<Open> stack(1);
  stack[0].box = cover.root;
  for (std::size_t c = 0; c < claims.curves.size(); ++c)
    stack[0].curves.push_back(static_cast<int>(c));
  int leaf = 0;  // the first that is not in a box left behind
  for (std::size_t i = 0; i < cover.tokens.size() && !claims.full(); ++i) {
    Open here = std::move(stack.back());
    stack.pop_back();
    const int token = cover.tokens[i];
    const auto keeps_sign = [&](int c, const Box<2>& box) {
      return sign_on_box(claims.curves[static_cast<std::size_t>(c)], box, claims.kernel)
          .has_value();
    };
    if (below[i] > 0)
      std::erase_if(here.curves, [&](int c) {
        const std::vector<int>& leaves = leaves_of[static_cast<std::size_t>(c)];
        const auto next = std::lower_bound(leaves.begin(), leaves.end(), leaf);
        return (next == leaves.end() || *next >= leaf + below[i]) && keeps_sign(c, here.box);
      });
    if (splits(token)) {
      Open lower, upper;
      halves(here.box, token == cover::kSplitX ? 0 : 1, &lower.box, &upper.box);
      lower.curves = here.curves;
      upper.curves = std::move(here.curves);
      stack.push_back(std::move(upper));
      stack.push_back(std::move(lower));
    } else if (token >= 0) {
      const std::vector<int>& alive = cover.alive[static_cast<std::size_t>(token)];
      for (int c : here.curves) {
        if (std::binary_search(alive.begin(), alive.end(), c)) continue;
        const bool proved =
            by_parts(here.box, [&](const Box<2>& box) { return keeps_sign(c, box); });
        claims.require(proved, "Curve ", c, " is not proved absent from leaf ", token,
                       " of the shared cover.");
      }
      ++leaf;
    }
  }
}

/// The root of a cover of the curves `key`, which are alive together in leaves of the shared cover
/// with the hull hulls[key], if there is one.
template <class Key>
void check_root(Claims& claims, const std::string& name, const Box<2>& root,
                const std::map<Key, Box<2>>& hulls, const Key& key) {
  if (claims.result.shared_cover.tokens.empty()) {
    claims.require(contains_region(root, claims.result.region_used), name,
                   " does not cover the region used.");
  } else if (const auto found = hulls.find(key); found != hulls.end()) {
    claims.require(root.contains(found->second), name,
                   " does not cover the shared cover's leaves.");
  }
}

template <class Key>
void join(std::map<Key, Box<2>>* hulls, const Key& key, const Box<2>& box) {
  Box<2>& known = hulls->try_emplace(key, box).first->second;
  known = hull(known, box);
}

}  // namespace

void check_shared_cover(Claims& claims) {
  const SharedCover& cover = claims.result.shared_cover;
  if (cover.tokens.empty()) return;
  const std::string name = "The shared cover";
  claims.require(contains_region(cover.root, claims.result.region_used), name,
                 " does not cover the region used.");
  std::vector<int> all(claims.curves.size());
  std::iota(all.begin(), all.end(), 0);
  const auto check = [&](int token, const Box<2>& leaf) -> const char* {
    if (token == cover::kUnresolved)
      return unresolved(claims.result, leaf, all) ? nullptr
                                                  : "is in no unresolved box of all curves";
    claims.shared_leaves.push_back(leaf);
    return nullptr;
  };
  const bool whole = replay(claims, name, cover.root, cover.tokens, check);
  if (!whole) return;
  claims.upper_half = upper_halves(cover.tokens);
  check_absent_curves(claims);
}

namespace {

/// Calls `visit` with the tokens of the shared cover's leaves, but for those in boxes of which
/// `misses` is true, until it returns false; tells whether it never did.
template <class Misses, class Visit>
bool for_shared_leaves(const Claims& claims, Misses misses, Visit visit) {
  const SharedCover& cover = claims.result.shared_cover;
  struct Item {
    std::size_t token;
    Box<2> box;
  };
  std::vector<Item> stack{{0, cover.root}};
  while (!stack.empty()) {
    const Item item = stack.back();
    stack.pop_back();
    if (misses(item.box)) continue;
    const int token = cover.tokens[item.token];
    if (splits(token)) {
      Box<2> lower, upper;
      halves(item.box, token == cover::kSplitX ? 0 : 1, &lower, &upper);
      stack.push_back({claims.upper_half[item.token], upper});
      stack.push_back({item.token + 1, lower});
    } else if (!visit(token)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<int> curves_near(Claims& claims, const Line& line, const Box<2>& box) {
  const SharedCover& cover = claims.result.shared_cover;
  std::vector<int> all(claims.curves.size()), curves;
  std::iota(all.begin(), all.end(), 0);
  if (claims.upper_half.empty()) return all;
  const auto misses = [&](const Box<2>& part) {
    // (Bounds of `box` that are no numbers exclude nothing.)
    bool apart = side(line, part, claims.kernel).has_value();
    for (std::size_t i = 0; i < 2; ++i)
      apart = apart || box.hi[i] < part.lo[i] || part.hi[i] < box.lo[i];
    return apart;
  };
  const auto collect = [&](int token) {
    if (token < 0) return token != cover::kUnresolved;
    const std::vector<int>& alive = cover.alive[static_cast<std::size_t>(token)];
    curves.insert(curves.end(), alive.begin(), alive.end());
    return true;
  };
  if (!for_shared_leaves(claims, misses, collect)) return all;
  std::sort(curves.begin(), curves.end());
  curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
  return curves;
}

namespace {

bool overlap(const Box<2>& a, const Box<2>& b) {
  for (std::size_t i = 0; i < 2; ++i)
    if (!(a.lo[i] < b.hi[i] && b.lo[i] < a.hi[i])) return false;
  return true;
}

/// Whether no leaf of the shared cover that overlaps the box has both curves, or may have them.
/// (These closed leaves cover the closed box; what only touches it is not needed.)
bool apart_in_shared_cover(const Claims& claims, const std::array<int, 2>& curves,
                           const Box<2>& box) {
  if (claims.upper_half.empty()) return false;
  return for_shared_leaves(
      claims, [&](const Box<2>& part) { return !overlap(part, box); },
      [&](int token) {
        if (token < 0) return token != cover::kUnresolved;
        const std::vector<int>& alive =
            claims.result.shared_cover.alive[static_cast<std::size_t>(token)];
        return !std::all_of(curves.begin(), curves.end(), [&](int c) {
          return std::binary_search(alive.begin(), alive.end(), c);
        });
      });
}

}  // namespace

void check_crossing_covers(Claims& claims) {
  const Encasement& e = claims.result;
  const std::size_t n = e.curves.size();
  const bool shared = !e.shared_cover.tokens.empty();
  std::map<std::array<int, 2>, Box<2>> hulls;  // of the leaves in which both are alive
  for (std::size_t k = 0; k < claims.shared_leaves.size(); ++k) {
    const std::vector<int>& alive = e.shared_cover.alive[k];
    for (std::size_t i = 0; i < alive.size(); ++i)
      for (std::size_t j = i + 1; j < alive.size(); ++j)
        join(&hulls, {alive[i], alive[j]}, claims.shared_leaves[k]);
  }
  std::set<std::array<int, 2>> pairs;
  for (const CrossingCover& c : e.crossing_covers)
    claims.require(pairs.insert(c.curves).second, "Curves ", c.curves[0], " and ", c.curves[1],
                   " have two crossing covers.");
  for_each(claims, e.crossing_covers.size(), [&](Claims& part, std::size_t i) {
    const CrossingCover& c = e.crossing_covers[i];
    const System<2> pair{&part.curves[static_cast<std::size_t>(c.curves[0])],
                         &part.curves[static_cast<std::size_t>(c.curves[1])]};
    const auto check = [&](int token, const Box<2>& leaf) -> const char* {
      if (token == cover::kUnresolved)
        return unresolved(e, leaf, {c.curves[0], c.curves[1]})
                   ? nullptr
                   : "is in no unresolved box of the pair";
      if (token == cover::kExcluded)
        return by_parts(leaf,
                        [&](const Box<2>& box) {
                          return apart_in_shared_cover(part, c.curves, box) ||
                                 no_common_zero<2>(pair, box, part.kernel);
                        })
                   ? nullptr
                   : "is not proved free of crossings";
      const Crossing& crossing = e.crossings[static_cast<std::size_t>(token)];
      if (crossing.curves != c.curves) return "names a crossing of other curves";
      // At most one zero in a box with the whole box of the crossing, which has one: what the leaf
      // can hold is that crossing.
      const auto proves = [&](const Box<2>& box) {
        return crossing.box.contains(box) ||
               at_most_one_zero<2>(pair, hull(box, crossing.box), part.kernel) ||
               no_common_zero<2>(pair, box, part.kernel);
      };
      return by_parts(leaf, proves) ? nullptr : "is not proved to hold only its crossing";
    };
    const std::string name = "Crossing cover " + std::to_string(i);
    check_root(part, name, c.root, hulls, c.curves);
    replay(part, name, c.root, c.tokens, check);
  });
  const bool complete =
      shared ? std::all_of(hulls.begin(), hulls.end(),
                           [&](const auto& pair) { return pairs.count(pair.first) > 0; })
             : pairs.size() == n * (n - (n > 0)) / 2;
  claims.require(complete, "Some pair of curves has no crossing cover.");
}

void check_critical_regions(Claims& claims) {
  const Encasement& e = claims.result;
  for_each(claims, e.critical_regions.size(), [&](Claims& part, std::size_t i) {
    const CriticalRegion& region = e.critical_regions[i];
    const auto& f = part.curves[static_cast<std::size_t>(region.curve)];
    bool proved = true;
    for (const Box<2>& box : region.boxes) {
      proved = by_parts(box, [&](const Box<2>& inner) {
        return sign_on_box(f, inner, part.kernel) == region.sign;
      });
      if (!proved) break;
    }
    part.require(proved, "Curve ", region.curve,
                 " is not proved to have its sign on critical region ", i, ".");
    if (proved)
      part.require(connected(region.boxes), "The boxes of critical region ", i,
                   " do not hang together.");
  });
}

void check_critical_covers(Claims& claims) {
  const Encasement& e = claims.result;
  using Boxes = std::set<Box<2>, Less>;
  std::vector<Boxes> boxes;
  for (const CriticalRegion& region : e.critical_regions)
    boxes.emplace_back(region.boxes.begin(), region.boxes.end());
  const bool shared = !e.shared_cover.tokens.empty();
  std::map<int, Box<2>> hulls;  // of the leaves in which a curve is alive
  for (std::size_t k = 0; k < claims.shared_leaves.size(); ++k)
    for (int c : e.shared_cover.alive[k]) join(&hulls, c, claims.shared_leaves[k]);
  std::set<int> curves;
  for (const CriticalCover& c : e.critical_covers)
    claims.require(curves.insert(c.curve).second, "Curve ", c.curve, " has two critical covers.");
  for_each(claims, e.critical_covers.size(), [&](Claims& part, std::size_t i) {
    const CriticalCover& c = e.critical_covers[i];
    const auto& f = part.curves[static_cast<std::size_t>(c.curve)];
    const auto check = [&](int token, const Box<2>& leaf) -> const char* {
      if (token == cover::kUnresolved)
        return unresolved(e, leaf, {c.curve}) ? nullptr : "is in no unresolved box of the curve";
      if (token == cover::kExcluded)
        return by_parts(leaf,
                        [&](const Box<2>& box) {
                          return no_relevant_critical_point(f, box, part.kernel);
                        })
                   ? nullptr
                   : "is not proved free of critical points";
      // The sign on it is checked with the other boxes of its region.
      const auto k = static_cast<std::size_t>(token);
      if (e.critical_regions[k].curve != c.curve) return "names a critical region of another curve";
      return boxes[k].contains(leaf) ? nullptr : "is not a box of its critical region";
    };
    const std::string name = "Critical cover " + std::to_string(i);
    check_root(part, name, c.root, hulls, c.curve);
    replay(part, name, c.root, c.tokens, check);
  });
  const bool complete =
      shared ? std::all_of(hulls.begin(), hulls.end(),
                           [&](const auto& curve) { return curves.count(curve.first) > 0; })
             : curves.size() == e.curves.size();
  claims.require(complete, "Some curve has no critical cover.");
}

}  // namespace encase::verification
