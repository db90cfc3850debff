// SPDX-License-Identifier: MIT
#include "cgal_arrangement.hpp"

#include <CGAL/Arr_algebraic_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_BigInt.h>

#include <cmath>
#include <ctime>
#include <utility>

#include "cgal_polynomial.hpp"

namespace {

using Traits = CGAL::Arr_algebraic_segment_traits_2<CORE::BigInt>;
using Arrangement = CGAL::Arrangement_2<Traits>;
}  // namespace

CgalArrangement cgal_arrangement(const std::vector<encase::Polynomial<2>>& curves,
                                 bool coordinates) {
  std::clock_t last = std::clock();
  const auto lap = [&] {
    const std::clock_t now = std::clock(), passed = now - std::exchange(last, now);
    return static_cast<double>(passed) / CLOCKS_PER_SEC;
  };
  Traits traits;
  Arrangement arrangement(&traits);
  std::vector<Traits::Curve_2> list;
  for (const auto& f : curves)
    list.push_back(traits.construct_curve_2_object()(
        with_integer_coefficients<Traits::Polynomial_2, CORE::BigInt>(f)));
  CGAL::insert(arrangement, list.begin(), list.end());
  CgalArrangement result;
  result.seconds = lap();
  double sum = 0;
  for (auto v = arrangement.vertices_begin(); coordinates && v != arrangement.vertices_end(); ++v) {
    const auto [x, y] = v->point().to_double();
    sum += x + y;
  }
  result.coordinate_seconds = coordinates && std::isfinite(sum) ? lap() : 0;
  result.faces = static_cast<int>(arrangement.number_of_faces());
  for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v)
    result.crossings += !v->is_isolated() && v->degree() > 2;
  return result;
}
