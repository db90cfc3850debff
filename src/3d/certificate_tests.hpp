// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "common/bernstein.hpp"
#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "encase/surface_encasement.hpp"

/// What certificates in space claim, proved on single boxes: the search and `verify` both ask here.
/// False means "not proved", never "disproved". docs/error-bounds.md derives the bounds.
namespace encase {

using BoxChart = std::array<Centered, 3>;

/// The coordinates s in which nets on a box are: x = center + half s.
BoxChart chart_of(const Box<3>& box);

/// Polynomials of one degree on the cube [-1,1]^3 in Bernstein form, of which combinations are
/// wanted. The exact coefficients of polynomial i differ from columns[i] by at most radius[i].
template <int M>
struct NetColumns {
  std::array<std::vector<double>, M> columns;
  std::array<double, M> radius{};
  std::array<double, M> largest{};  ///< the largest |columns[i]|

  int count() const { return static_cast<int>(columns[0].size()); }
  std::array<const double*, M> pointers() const {
    std::array<const double*, M> p;
    for (int i = 0; i < M; ++i) p[i] = columns[i].data();
    return p;
  }
};

/// A lower bound for sum weights[i] polynomial i on the cube, for all weights that differ from
/// those given by at most `deviation`; -infinity if there is none.
template <int M>
double lower_bound(const NetColumns<M>& nets, const std::array<double, M>& weights,
                   const std::array<double, M>& deviation);

/// From the net of f, of equal degrees: df/ds_x, df/ds_y, df/ds_z, s . grad f, f.
void field_columns(const Bernstein<3>& net, NetColumns<5>* columns);

/// The same of an inclusion function on a box, with the errors of the derivatives themselves, which
/// are less than those of the net's.
void field_columns(const FilteredInclusion<3>& f, const Box<3>& box, Kernel& kernel,
                   NetColumns<5>* columns);

/// V . grad f + multiplier f > 0 on the chart, as the certificate says; its box counts for nothing.
bool is_graph(const NetColumns<5>& columns, const BoxChart& chart,
              const GraphCertificate& certificate);

/// From expansions on the box in arithmetic of `bits`: the components of grad f x grad g, with
/// derivatives in the coordinates s, and f and g. False if there is no such expansion.
bool pair_columns(const FilteredFunction<3>& f, const FilteredFunction<3>& g, const Box<3>& box,
                  int bits, Kernel& kernel, NetColumns<5>* columns);

/// The inequality of a Local certificate, on the chart.
bool is_monotone(const NetColumns<5>& columns, const BoxChart& chart,
                 const PairCertificate& certificate, double scale_f, double scale_g);

/// alpha f + beta g > 0, from nets of equal degrees on one chart.
bool is_apart(const Bernstein<3>& f, const Bernstein<3>& g, const PairCertificate& certificate,
              double scale_f, double scale_g);

// The certificates' claims on their boxes. These climb the ladder of precisions.

bool holds(const AbsenceCertificate& certificate, const FilteredFunction<3>& f, Kernel& kernel);
bool holds(const GraphCertificate& certificate, const FilteredFunction<3>& f, Kernel& kernel);
/// Only of kinds Apart and Local.
bool holds(const PairCertificate& certificate, const FilteredFunction<3>& f,
           const FilteredFunction<3>& g, Kernel& kernel);

}  // namespace encase
