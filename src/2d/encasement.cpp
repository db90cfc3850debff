// SPDX-License-Identifier: MIT
#include "encase/encasement.hpp"

#include <cfenv>

#include "2d/encaser.hpp"

namespace encase {

namespace {

/// The numbers are those of docs/encasement.md; the thesis is J. Masterjohn's (see there).
Result<Encasement> encase(Encaser& run) {
  if (std::fegetround() != FE_TONEAREST)
    return Error{Error::Code::BadInput,
                 "the processor must round to nearest while curves are encased; call "
                 "std::fesetround(FE_TONEAREST)"};

  // 1. Sanity: refuse what is no curve; perturb on demand (thesis 4.1); find repeated and shared
  //    components and take them apart.
  if (const Status bad = run.check_input()) return *bad;
  run.separate_components();

  // 2. A generic polygon, and all crossings of all pairs in it (in place of thesis 3.3).
  if (run.open_region()) {
    // 3. Critical regions, one in every loop (thesis 3.1), and what resists, to be kept apart.
    run.find_critical_regions();
    run.collect_zones();

    // 4. Split cells until all are simple: self-separation (thesis 3.2), crossings apart (3.3.2),
    //    curve separation (3.4, 6.1), subdivision (3.5); loops last (3.1).
    run.split_cells();

    // 5. The cells, with what certifies them.
    run.finish_cells();
  } else {
    run.give_up_on_region();
  }
  run.decide_outcome();
  return run.take_result();
}

}  // namespace

Result<Encasement> encase(const std::vector<NamedCurve>& curves, const Region& region,
                          const EncaseOptions& options) {
  Encaser run(curves, region, options);
  return encase(run);
}

Result<Encasement> add_curves(const Encasement& earlier, const std::vector<NamedCurve>& more,
                              const EncaseOptions& options) {
  Encaser run(earlier, more, options);
  return encase(run);
}

}  // namespace encase
