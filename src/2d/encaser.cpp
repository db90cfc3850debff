// SPDX-License-Identifier: MIT
#include "2d/encaser.hpp"

#include <algorithm>
#include <utility>

#include "2d/locate.hpp"
#include "common/parallel.hpp"
#include "common/wording.hpp"

namespace encase {
namespace {

/// The part of the region's width beyond which boxes are not halved. Curves a tiny gap apart take
/// boxes of its size; where several branches of one curve meet, smaller boxes only become more.
double smallest_part(Unresolved::Kind kind) {
  return kind == Unresolved::Kind::Contact ? 0x1p-44 : 0x1p-40;
}

}  // namespace

Encaser::Encaser(const std::vector<NamedCurve>& input, const Region& region,
                 const EncaseOptions& options)
    : options_(options), threads_(std::max(options.threads, 1)), clock_(threads_) {
  kernel_.start_bits = std::max(options.start_bits, Kernel::kDoubleBits);
  kernel_.max_bits = std::max(options.max_bits, kernel_.start_bits);
  result_.input = input;
  result_.region = region;
  result_.seed = options.seed;
  result_.perturbation = options.perturbation;
}

Encaser::Encaser(const Encasement& earlier, const std::vector<NamedCurve>& more,
                 const EncaseOptions& options)
    : Encaser(earlier.input, earlier.region, options) {
  earlier_ = EarlierEncasement(earlier);
  perturbed_ = earlier.input.size();
  result_.input.insert(result_.input.end(), more.begin(), more.end());
  result_.seed = earlier.seed;
  result_.perturbation = earlier.perturbation;
}

void Encaser::use_up_budget(const std::string& reason) {
  std::lock_guard lock(budget_mutex_);
  if (is_used_up_) return;
  budget_ = reason;
  is_used_up_ = true;
}

void Encaser::progress(const char* stage, double done) {
  if (!options_.progress || is_used_up_) return;
  const std::unique_lock lock(progress_mutex_, std::try_to_lock);
  if (!lock || is_used_up_) return;  // another thread is telling, or was told to stop
  if (!options_.progress(stage, done)) use_up_budget("the computation was cancelled");
}

std::function<bool()> Encaser::stop(const char* stage) {
  return [this, stage] {
    progress(stage, -1);
    return out_of_budget();
  };
}

void Encaser::run(Tasks& tasks, const std::function<void(int)>& task) {
  if (threads_ == 1 || tasks.count <= 1) {
    for (int i = 0; i < tasks.count; ++i, ++tasks.done) task(i);
    return;
  }
  const RunClock::SharedOut shared_out(clock_);
  parallel_for(tasks.count, threads_, [&](int i) {
    const RunClock::Shift shift(clock_);
    try {
      task(i);
    } catch (...) {
      use_up_budget(
          "something failed");  // so that the others end soon; what was thrown is the answer
      throw;
    }
    ++tasks.done;
  });
}

SubdivisionLimits Encaser::limits(Tasks& tasks, Unresolved::Kind kind, const Box<2>& root) {
  SubdivisionLimits limits;
  // A root may be smaller than the whole; the smallest boxes are not.
  const double whole = tiled_.front().box().largest_width();
  limits.smallest = smallest_part(kind) * (whole / root.largest_width());
  limits.stop = [this, &tasks] {
    progress(tasks.stage, tasks.count > 2 ? tasks.part_done() : -1);
    return out_of_budget();
  };
  return limits;
}

bool Encaser::out_of_budget() {
  if (is_used_up_) return true;
  if (clock_.exceeds(options_.max_seconds))
    use_up_budget("the limit of " + decimal(options_.max_seconds) + " CPU seconds was reached");
  return is_used_up_;
}

void Encaser::count_pairs() {
  Statistics& s = result_.statistics;
  s.pairs_met = static_cast<std::int64_t>(result_.crossing_covers.size());
  s.filter_failures = s.pairs_isolated;
  for (const CrossingCover& cover : result_.crossing_covers)
    s.filter_failures -= std::any_of(cover.tokens.begin(), cover.tokens.end(), [&](int token) {
      return token == cover::kUnresolved ||
             (token >= 0 && result_.crossings[token].location != Location::Outside);
    });
}

void Encaser::decide_outcome() {
  locate_crossings(result_, kernel_);
  count_pairs();
  result_.outcome = !result_.undecided.empty()    ? Outcome::Undecided
                    : !result_.degenerate.empty() ? Outcome::Degenerate
                                                  : Outcome::Certified;
  for (const Cell& cell : result_.cells)
    if (cell.state == CellState::Undecided) result_.outcome = Outcome::Undecided;
  for (const Kernel& kernel : tile_kernels_) kernel_.add(kernel);
  tiles_->add_counts_to(&kernel_);
  Statistics& s = result_.statistics;
  s.candidate_lines = partition_->lines_tried;
  s.decisions = kernel_.decisions;
  s.restrictions = kernel_.restrictions;
  s.expansions = kernel_.expansions;
  s.mpfr_expansions = kernel_.mpfr_expansions;
  result_.seconds = clock_.seconds();
}

}  // namespace encase
