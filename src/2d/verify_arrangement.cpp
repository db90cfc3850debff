// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "2d/verify_claims.hpp"
#include "encase/arrangement.hpp"

namespace encase {
namespace verification {

void check_arrangement(Claims& claims) {
  const Result<Arrangement> arranged = arrange(claims.result, {false});
  if (!claims.require(arranged.ok(), "The result has no arrangement",
                      arranged ? std::string() : ": " + arranged.error().message + "."))
    return;
  const std::string objection = check(arranged.value());
  claims.require(objection.empty(), "The arrangement contradicts itself: ", objection);
}

namespace {

/// One claim for each entry of a list.
template <class T>
void check_list(Claims& claims, const char* name, const std::vector<T>& stored,
                const std::vector<T>& right) {
  if (!claims.require(stored.size() == right.size(), "The stored arrangement has ", stored.size(),
                      " ", name, ", the encasement ", right.size(), "."))
    return;
  for (std::size_t k = 0; k < stored.size() && !claims.full(); ++k)
    claims.require(stored[k] == right[k], "In the stored arrangement, entry ", k, " of the ", name,
                   " is not that of the encasement.");
}

/// Whether it was made with them (ArrangeOptions).
bool has_boundary_points(const Arrangement& arrangement) {
  return std::any_of(arrangement.vertices.begin(), arrangement.vertices.end(), [](const auto& v) {
    return v.kind == Arrangement::Vertex::Kind::OnBoundary && v.point != Point<2>{};
  });
}

}  // namespace
}  // namespace verification

Verification verify(const Encasement& encasement, const Arrangement& arrangement,
                    const VerifyOptions& options) {
  using namespace verification;
  Facts facts{encasement, options};
  Claims claims(facts);
  claims.report = verify(encasement, options);
  if (!claims.report.ok()) return claims.report;
  const Result<Arrangement> arranged = arrange(encasement, {has_boundary_points(arrangement)});
  if (!claims.require(arranged.ok(), "An arrangement is stored, but the result has none."))
    return claims.report;
  const Arrangement& right = arranged.value();
  check_list(claims, "vertices", arrangement.vertices, right.vertices);
  check_list(claims, "half-edges", arrangement.half_edges, right.half_edges);
  check_list(claims, "edges", arrangement.edges, right.edges);
  check_list(claims, "faces", arrangement.faces, right.faces);
  check_list(claims, "pieces", arrangement.pieces, right.pieces);
  check_list(claims, "components", arrangement.components, right.components);
  check_list(claims, "curve components", arrangement.curve_components, right.curve_components);
  claims.require(arrangement.outside == right.outside,
                 "The outside of the stored arrangement is another face.");
  return claims.report;
}

}  // namespace encase
