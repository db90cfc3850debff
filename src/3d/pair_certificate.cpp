// SPDX-License-Identifier: MIT
#include "3d/pair_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "3d/separation.hpp"

namespace encase {

std::optional<PairCertificate> find_apart(const Bernstein<3>& f, const Bernstein<3>& g,
                                          const Box<3>& box, double scale_f, double scale_g) {
  const auto weights = separate<2>({f.b.data(), g.b.data()}, static_cast<int>(f.b.size()),
                                   {1 / std::max(largest_coefficient(f), 0x1p-1000),
                                    1 / std::max(largest_coefficient(g), 0x1p-1000)});
  if (!weights) return std::nullopt;
  PairCertificate c;
  c.kind = PairCertificate::Kind::Apart;
  c.box = box;
  const double size = std::max(std::fabs((*weights)[0]), std::fabs((*weights)[1]));
  c.alpha = (*weights)[0] / size / scale_f;
  c.beta = (*weights)[1] / size / scale_g;
  if (!is_apart(f, g, c, scale_f, scale_g)) return std::nullopt;
  return c;
}

std::optional<PairCertificate> find_local(const FilteredFunction<3>& f,
                                          const FilteredFunction<3>& g, const Box<3>& box, int bits,
                                          Kernel& kernel) {
  thread_local NetColumns<5> columns;
  const BoxChart chart = chart_of(box);
  double before = HUGE_VAL;
  for (; bits > 0; bits = kernel.next(bits)) {
    if (!pair_columns(f, g, box, bits, kernel, &columns)) return std::nullopt;
    const double along =
        std::max({columns.largest[0], columns.largest[1], columns.largest[2], 0x1p-1000});
    const std::array<double, 5> scale{1 / along, 1 / along, 1 / along,
                                      1 / std::max(columns.largest[3], 0x1p-1000),
                                      1 / std::max(columns.largest[4], 0x1p-1000)};
    const auto weights = separate<5>(columns.pointers(), columns.count(), scale);
    if (!weights) return std::nullopt;
    PairCertificate c;
    c.kind = PairCertificate::Kind::Local;
    c.box = box;
    double size = 0;
    for (int i = 0; i < 3; ++i) {
      c.direction[i] = (*weights)[i] * chart[(i + 1) % 3].half * chart[(i + 2) % 3].half;
      size = std::max(size, std::fabs(c.direction[i]));
    }
    for (double& component : c.direction) component /= size;
    c.alpha = (*weights)[3] / size * g.scale();
    c.beta = (*weights)[4] / size * f.scale();
    if (is_monotone(columns, chart, c, f.scale(), g.scale())) return c;
    const double radius = *std::max_element(columns.radius.begin(), columns.radius.end());
    if (bits > Kernel::kDoubleBits && !(radius < 0.5 * before)) return std::nullopt;
    before = radius;
  }
  return std::nullopt;
}

}  // namespace encase
