// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "common/patch.hpp"
#include "common/system_net.hpp"
#include "common/tile.hpp"

namespace encase {

/// Boxes of a subdivision that come from more halvings are small: there curves touch or nearly
/// touch, and only the last digits tell them apart.
constexpr int kUsualLevels = 18;

/// Whether nets are too far from their polynomials for a box that comes from `level` halvings.
bool coarse(const Patch& patch, int level);
bool coarse(const SystemNet& net, int level);

/// The patches of one function on the boxes of a subdivision, from its tiles, or from tiles of
/// their own for boxes on which those are too coarse.
class PatchSource {
 public:
  PatchSource() = default;
  /// Patches have `count` coefficients in either variable. `in_system`: they go into nets of two.
  PatchSource(TiledFunction* f, int count, bool in_system, Kernel* kernel)
      : f_(f), count_(count), in_system_(in_system), kernel_(kernel) {}

  /// The patch on a box that comes from `level` halvings; false where a smaller box should have
  /// one. `*used`: the tile that serves the box so far, if there is one (`patch->radius` is that of
  /// its patch), then the one that this patch comes from.
  bool make(const Box<2>& box, int level, Patch* patch, const Tile** used);

  /// Forgets the boxes' own tiles but for those of the ancestors of boxes of this level.
  void leave(int level) {
    while (!own_.empty() && own_.back().level >= level) own_.pop_back();
  }

 private:
  /// A tile of one box; also for what becomes of that.
  struct Own {
    int level;
    std::unique_ptr<Tile> tile;
  };

  bool too_large(const Patch& patch, int level) const;
  const Tile* own_tile(const Box<2>& box, int level, int bits);

  TiledFunction* f_ = nullptr;
  int count_ = 0;
  bool in_system_ = false;
  Kernel* kernel_ = nullptr;
  std::vector<Own> own_;
};

}  // namespace encase
