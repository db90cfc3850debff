// SPDX-License-Identifier: MIT
#include "encase/surface_encasement.hpp"

#include <cfenv>

#include "3d/surface_encaser.hpp"

namespace encase {

/// The numbers are those of docs/surfaces.md.
Result<SurfaceEncasement> encase(const std::vector<NamedSurface>& surfaces,
                                 const Polyhedron& region, const SurfaceOptions& options) {
  if (std::fegetround() != FE_TONEAREST)
    return Error{Error::Code::BadInput,
                 "the processor must round to nearest while surfaces are encased; call "
                 "std::fesetround(FE_TONEAREST)"};
  SurfaceEncaser run(surfaces, region, options);

  // 1. Sanity: refuse what is no surface; perturb on demand; take repeated and shared components
  //    apart.
  if (const Status bad = run.check_input()) return *bad;
  run.separate_components();

  constexpr int kAttempts = 4;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const bool is_last = attempt + 1 == kAttempts;

    // 2. The region, or one that is slightly larger, if surfaces touch its sides or its edges.
    run.use_region(attempt);

    // 3. The common points of three surfaces, and the points where the curves of two turn back.
    if (!run.isolate_triple_points() && !is_last) continue;
    run.isolate_critical_points();

    // 4. Split until every cell has its certificates.
    run.partition();

    // 5. Encase the facets; read off patches, arcs and the order of points.
    if (run.read_cells(is_last)) break;
  }

  // 6. The answer.
  run.finish();
  return run.take_result();
}

}  // namespace encase
