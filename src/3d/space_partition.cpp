// SPDX-License-Identifier: MIT
#include "3d/space_partition.hpp"

#include <algorithm>
#include <utility>

#include "3d/singular_places.hpp"
#include "3d/space_partition_state.hpp"
#include "common/subdivision.hpp"

namespace encase {

void SpacePartition::State::prepare() {
  for (const HalfSpace& side : scene.region.sides)
    planes.push_back(Plane::from_rationals({side[0], side[1], side[2], side[3]}));
  for (std::size_t k = 0; k < scene.critical_points.size(); ++k) {
    const CurveCriticalPoints& list = scene.critical_points[k];
    lists_of[list.surfaces].push_back(static_cast<int>(k));
    obstacles.push_back(list.points);
    const auto open = encase::leaves<3>(list.root, list.tokens, cover::kUnresolved);
    obstacles.back().insert(obstacles.back().end(), open.begin(), open.end());
  }
  for (const TriplePointCover& cover : scene.triple_point_covers)
    unresolved_triples[cover.surfaces] =
        encase::leaves<3>(cover.root, cover.tokens, cover::kUnresolved);
  Leaf leaf;
  leaf.box = root;
  leaf.signs.assign(scene.surfaces.size(), Sign::Zero);
  for (std::size_t k = 0; k < scene.triple_points.size(); ++k)
    if (scene.triple_points[k].box.meets(root)) leaf.triple_points.push_back(static_cast<int>(k));
  leaves.push_back(std::move(leaf));
  parent.push_back(-1);
}

/// What is known of a leaf, with fresh nets.
LeafAtHand SpacePartition::State::item_of(int index) {
  const Leaf& leaf = leaves[static_cast<std::size_t>(index)];
  LeafAtHand item;
  item.leaf = index;
  for (std::size_t f = 0; f < leaf.signs.size(); ++f)
    if (leaf.signs[f] == Sign::Zero) item.alive.push_back(static_cast<int>(f));
  item.nets.resize(item.size());
  item.bits.assign(item.size(), kernel.start_bits);
  item.graph.assign(item.size(), -1);
  item.pair.assign(item.size() * item.size(), -1);
  const auto place = [&](int surface) {
    return static_cast<std::size_t>(
        std::lower_bound(item.alive.begin(), item.alive.end(), surface) - item.alive.begin());
  };
  for (const int g : leaf.graphs)
    item.graph[place(graphs[static_cast<std::size_t>(g)].surface)] = g;
  for (const int p : leaf.pairs) {
    const auto& surfaces = pairs[static_cast<std::size_t>(p)].surfaces;
    item.pair_of(place(surfaces[0]), place(surfaces[1])) = p;
  }
  for (std::size_t a = 0; a < item.size(); ++a) expand(item, a);
  bool empty;
  item.sides = region_sides.across(leaf.box, region_sides.all(), &empty);
  return item;
}

/// Leaves the small boxes that lie in rows along which surfaces seem to be singular: to go on would
/// double their number again and again.
void SpacePartition::State::leave_rows(std::vector<LeafAtHand>* open) {
  std::vector<std::size_t> places;
  std::vector<Box<3>> boxes;
  for (std::size_t k = 0; k < open->size() && !stopped; ++k) {
    const Box<3>& box = leaves[static_cast<std::size_t>((*open)[k].leaf)].box;
    if (box.largest_width() > limits.singular_width * root.largest_width() ||
        !seems_singular((*open)[k]))
      continue;
    places.push_back(k);
    boxes.push_back(box);
  }
  if (boxes.empty()) return;
  const std::vector<bool> left = in_rows(boxes, rows);
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (!left[k]) continue;
    LeafAtHand& item = (*open)[places[k]];
    leaves[static_cast<std::size_t>(item.leaf)].in_row = true;
    rows.push_back(boxes[k]);
    settle(item, CellState::Undecided);
    item.leaf = -1;
  }
  std::erase_if(*open, [](const LeafAtHand& item) { return item.leaf < 0; });
}

void SpacePartition::State::settle(LeafAtHand& item, CellState state) {
  Leaf& leaf = leaves[static_cast<std::size_t>(item.leaf)];
  leaf.state = state;
  leaf.graphs.clear();
  leaf.pairs.clear();
  for (const int g : item.graph)
    if (g >= 0) leaf.graphs.push_back(g);
  for (std::size_t a = 0; a < item.size(); ++a)
    for (std::size_t b = a + 1; b < item.size(); ++b)
      if (item.pair_of(a, b) >= 0) leaf.pairs.push_back(item.pair_of(a, b));
  give_back(item);
}

void SpacePartition::State::give_back(LeafAtHand& item) {
  for (Bernstein<3>& net : item.nets) pool.push_back(std::move(net));
  item.nets.clear();
}

void SpacePartition::State::run(std::vector<LeafAtHand> level) {
  while (!level.empty()) {
    std::vector<LeafAtHand> open, next;
    for (LeafAtHand& item : level) {
      if (++visited % 16 == 0 && !stopped) stopped = limits.stop && limits.stop();
      if (!stopped && certify(item))
        settle(item, CellState::Certified);
      else if (const int s = undefined_surface(item); s >= 0) {
        leaves[static_cast<std::size_t>(item.leaf)].without_model = s;
        settle(item, CellState::Undecided);
      } else
        open.push_back(std::move(item));
    }
    leave_rows(&open);
    for (LeafAtHand& item : open)
      if (stopped || static_cast<int>(leaves.size()) >= limits.max_leaves || !halve(item, &next))
        settle(item, CellState::Undecided);
    level.swap(next);
  }
}

SpacePartition::SpacePartition(const SpaceScene& scene, const PartitionLimits& limits,
                               Kernel& kernel)
    : state_(std::make_unique<State>(scene, limits, kernel)) {
  state_->prepare();
}

SpacePartition::~SpacePartition() = default;

void SpacePartition::certify() {
  std::vector<LeafAtHand> level;
  level.push_back(state_->item_of(0));
  state_->run(std::move(level));
}

bool SpacePartition::split(int leaf, const std::optional<CutHint>& hint) {
  std::vector<LeafAtHand> parts;
  parts.push_back(state_->item_of(leaf));
  for (std::size_t a = 0; a < parts[0].size(); ++a) state_->sharpen(parts[0], a);
  const std::optional<double> at =
      hint ? state_->choose_cut(parts[0], *hint) : std::optional<double>();
  if (at) {
    LeafAtHand item = std::move(parts[0]);
    parts.clear();
    state_->cut_at(item, hint->axis, *at, &parts);
  }
  // (A cut that leaves nothing on one side is none.)
  while (parts.size() < 2) {
    LeafAtHand item = std::move(parts[0]);
    parts.clear();
    if (static_cast<int>(leaves().size()) >= state_->limits.max_leaves ||
        !state_->halve(item, &parts))
      return false;
  }
  state_->run(std::move(parts));
  return true;
}

const std::vector<SpacePartition::Leaf>& SpacePartition::leaves() const { return state_->leaves; }
const std::vector<Plane>& SpacePartition::planes() const { return state_->planes; }
const std::vector<Split>& SpacePartition::history() const { return state_->history; }
const std::vector<AbsenceCertificate>& SpacePartition::absences() const { return state_->absences; }
const std::vector<GraphCertificate>& SpacePartition::graphs() const { return state_->graphs; }
const std::vector<PairCertificate>& SpacePartition::pairs() const { return state_->pairs; }
std::int64_t SpacePartition::tests() const { return state_->tests; }

}  // namespace encase
