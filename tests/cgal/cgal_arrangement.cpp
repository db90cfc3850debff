// SPDX-License-Identifier: MIT
#include "cgal_arrangement.hpp"

#include <CGAL/Arr_algebraic_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_BigInt.h>

#include "cgal_polynomial.hpp"

namespace {

using Traits = CGAL::Arr_algebraic_segment_traits_2<CORE::BigInt>;
using Arrangement = CGAL::Arrangement_2<Traits>;
}  // namespace

CgalArrangement cgal_arrangement(const std::vector<encase::Polynomial<2>>& curves) {
  Traits traits;
  Arrangement arrangement(&traits);
  std::vector<Traits::Curve_2> list;
  for (const auto& f : curves)
    list.push_back(traits.construct_curve_2_object()(
        with_integer_coefficients<Traits::Polynomial_2, CORE::BigInt>(f)));
  CGAL::insert(arrangement, list.begin(), list.end());
  CgalArrangement result;
  result.faces = static_cast<int>(arrangement.number_of_faces());
  for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v)
    result.crossings += !v->is_isolated() && v->degree() > 2;
  return result;
}
