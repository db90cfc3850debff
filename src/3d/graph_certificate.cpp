// SPDX-License-Identifier: MIT
#include "3d/graph_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "3d/separation.hpp"

namespace encase {

namespace {

/// With weights for the columns, in the chart's coordinates.
GraphCertificate certificate_of(const std::array<double, 5>& weights, const BoxChart& chart,
                                const Box<3>& box) {
  GraphCertificate c;
  c.box = box;
  double size = 0;  // of V
  for (int i = 0; i < 3; ++i)
    size = std::max(
        {size, std::fabs(weights[i] * chart[i].half), std::fabs(weights[3] * chart[i].half)});
  for (int i = 0; i < 3; ++i) {
    c.direction[i] = weights[i] * chart[i].half / size;
    c.center[i] = chart[i].center;
  }
  c.spread = weights[3] / size;
  c.multiplier = weights[4] / size;
  return c;
}

}  // namespace

std::optional<GraphCertificate> find_graph(const NetColumns<5>& columns, const Box<3>& box) {
  // The four columns of V are one field's, in the same units.
  const double field = 1 / std::max({columns.largest[0], columns.largest[1], columns.largest[2],
                                     columns.largest[3], 0x1p-1000}),
               value = 1 / std::max(columns.largest[4], 0x1p-1000);
  const auto all =
      separate<5>(columns.pointers(), columns.count(), {field, field, field, field, value});
  if (!all) return std::nullopt;
  const BoxChart chart = chart_of(box);
  const auto p = columns.pointers();
  if (const auto parallel =
          separate<4>({p[0], p[1], p[2], p[4]}, columns.count(), {field, field, field, value})) {
    const auto& w = *parallel;
    const GraphCertificate c = certificate_of({w[0], w[1], w[2], 0, w[3]}, chart, box);
    if (is_graph(columns, chart, c)) return c;
  }
  const GraphCertificate c = certificate_of(*all, chart, box);
  if (is_graph(columns, chart, c)) return c;
  return std::nullopt;
}

}  // namespace encase
