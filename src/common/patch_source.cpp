// SPDX-License-Identifier: MIT
#include "common/patch_source.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

constexpr int kLevelsOfTree = 36;  // beyond which the function's own tiles are too coarse

/// How far a net may be from its polynomial, beside its size.
double tolerated(int level, double usual) { return level > kUsualLevels ? 0x1p-26 : usual; }

double largest_slope_radius(const Patch& patch) {
  return std::max(patch.slope_radius[0], patch.slope_radius[1]);
}

/// Whether a patch on a box that is halved is not worth trying. (Patches tell by themselves how far
/// they are; of high degrees they are tried on every other level.)
bool hopeless(const Tile& tile, int level) { return tile.degree > 7 && level % 2 == 1; }

/// Whether the sign of an expression is proved, so that its slopes need not be known better.
bool is_settled(const TiledFunction& f, const Patch& patch) {
  return !f.polynomial().is_polynomial() && patch.sign().has_value();
}

}  // namespace

bool coarse(const Patch& patch, int level) {
  const double part = tolerated(level, 0x1p-4);
  return !(patch.radius <= part * patch.magnitude() &&
           largest_slope_radius(patch) <= part * (patch.hi - patch.lo));
}

bool coarse(const SystemNet& net, int level) {
  const double of_value = tolerated(level, 0.06), of_slope = tolerated(level, 4);
  for (const Patch& patch : net.of)
    if (!(patch.radius <= of_value * patch.magnitude() &&
          largest_slope_radius(patch) <= of_slope * (patch.hi - patch.lo)))
      return true;
  return false;
}

/// Whether a smaller box should have the first net.
/// (What nets of two lack must not matter on parts of the box, the more of which there are the
/// larger it is.)
bool PatchSource::too_large(const Patch& patch, int level) const {
  if (!(patch.left_out > 0.5 * patch.radius)) return false;
  return in_system_ ? patch.left_out > std::ldexp(patch.magnitude(), std::min(-10, level - 18))
                    : coarse(patch, level);
}

bool PatchSource::make(const Box<2>& box, int level, Patch* patch, const Tile** used) {
  if (level < kLevelsOfTree || !own_.empty()) {
    const Tile& tile = own_.empty() ? f_->at(box.center()) : *own_.back().tile;
    if (0.5 * box.width(0) > 1.01 * tile.half[0] || 0.5 * box.width(1) > 1.01 * tile.half[1])
      return false;
    if (!in_system_ && !*used && hopeless(tile, level)) return false;
    if (holds(tile, box)) {
      expand(tile, box, count_, patch);
      if (!*used && too_large(*patch, level)) return false;
      *used = &tile;
      // What is lost by the low degree shrinks with the box.
      if (!coarse(*patch, level) || patch->left_out > 0.5 * patch->radius) return true;
    }
  }
  // A tile of the box's own, in double-doubles, then in MPFR.
  for (int bits = kernel_->start_bits; bits > 0; bits = kernel_->next(bits)) {
    if (bits == Kernel::kExtendedBits) continue;
    const double before = *used ? patch->radius : HUGE_VAL;
    *used = own_tile(box, level, bits);
    expand(**used, box, count_, patch);
    if (!coarse(*patch, level) || f_->wants_smaller(**used) || is_settled(*f_, *patch) ||
        (bits > Kernel::kDoubleBits && !(patch->radius < 0.5 * before)))
      break;
  }
  return true;
}

const Tile* PatchSource::own_tile(const Box<2>& box, int level, int bits) {
  if (own_.empty() || own_.back().level != level) own_.push_back({level, std::make_unique<Tile>()});
  Tile* tile = own_.back().tile.get();
  f_->expand(box, bits, tile);
  return tile;
}

}  // namespace encase
