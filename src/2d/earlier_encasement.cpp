// SPDX-License-Identifier: MIT
#include "2d/earlier_encasement.hpp"

#include <algorithm>

namespace encase {
namespace {

bool settles(const std::vector<int>& tokens) {
  return std::find(tokens.begin(), tokens.end(), cover::kUnresolved) == tokens.end();
}

/// Appends a cover with the things that its leaves name, numbered anew; `tokens` names them in
/// `from`.
template <class Thing, class Cover>
void append_cover(Cover cover, const std::vector<Thing>& from, std::vector<Thing>* things,
                  std::vector<Cover>* covers) {
  std::map<int, int> renumbered;
  for (int& token : cover.tokens) {
    if (token < 0) continue;
    const auto [place, is_new] = renumbered.try_emplace(token, static_cast<int>(things->size()));
    if (is_new) things->push_back(from[token]);
    token = place->second;
  }
  covers->push_back(std::move(cover));
}

}  // namespace

void EarlierEncasement::match(const std::vector<Curve>& curves, const Region& region_used) {
  crossing_covers_.clear();
  critical_covers_.clear();
  if (!from_ || from_->region_used.corners != region_used.corners) return;
  const std::size_t count = std::min(curves.size(), from_->curves.size());
  std::vector<char> same(from_->curves.size(), false);
  for (std::size_t c = 0; c < count; ++c) same[c] = curves[c].function == from_->curves[c].function;
  for (std::size_t k = 0; k < from_->crossing_covers.size(); ++k) {
    const CrossingCover& cover = from_->crossing_covers[k];
    if (same[cover.curves[0]] && same[cover.curves[1]] && settles(cover.tokens))
      crossing_covers_.emplace(cover.curves, static_cast<int>(k));
  }
  for (std::size_t k = 0; k < from_->critical_covers.size(); ++k) {
    const CriticalCover& cover = from_->critical_covers[k];
    if (same[cover.curve] && settles(cover.tokens))
      critical_covers_.emplace(cover.curve, static_cast<int>(k));
  }
}

bool EarlierEncasement::append_crossings(const std::array<int, 2>& curves, const Box<2>& box,
                                         std::vector<Crossing>* crossings,
                                         std::vector<CrossingCover>* covers) const {
  const auto known = crossing_covers_.find(curves);
  if (known == crossing_covers_.end()) return false;
  const CrossingCover& cover = from_->crossing_covers[known->second];
  if (!cover.root.contains(box)) return false;
  const std::size_t first = crossings->size();
  append_cover(cover, from_->crossings, crossings, covers);
  for (std::size_t k = first; k < crossings->size(); ++k) {
    (*crossings)[k].cell = -1;
    (*crossings)[k].location = Location::Inside;
  }
  return true;
}

bool EarlierEncasement::append_critical_regions(int curve, const Box<2>& box,
                                                std::vector<CriticalRegion>* regions,
                                                std::vector<CriticalCover>* covers) const {
  const auto known = critical_covers_.find(curve);
  if (known == critical_covers_.end()) return false;
  const CriticalCover& cover = from_->critical_covers[known->second];
  if (!cover.root.contains(box)) return false;
  append_cover(cover, from_->critical_regions, regions, covers);
  return true;
}

}  // namespace encase
