// SPDX-License-Identifier: MIT
//
// In place of what measures CGAL, where that is missing.
#include <stdexcept>

#include "cgal_arrangement.hpp"
#include "cgal_rival.hpp"

CgalArrangement cgal_arrangement(const std::vector<encase::Polynomial<2>>&, bool) {
  throw std::logic_error("this program was built without CGAL");
}

namespace encase::benchmark {

std::string cgal_version() { return {}; }

CgalFigures run_cgal(const Polynomial<2>&, const Polynomial<2>&, const Box<2>&) {
  throw std::logic_error("this program was built without CGAL");
}

CgalFigures run_cgal_in_box(const Polynomial<2>& f, const Polynomial<2>& g, const Box<2>& box) {
  return run_cgal(f, g, box);
}

}  // namespace encase::benchmark
