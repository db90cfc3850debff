// SPDX-License-Identifier: MIT
//
// Two curves from their coefficients: encase them within a budget, prove the result again, and
// print every crossing with 40 digits after the point.
#include <encase/crossing.hpp>
#include <encase/encasement.hpp>
#include <encase/verify.hpp>
#include <iostream>
#include <string>

namespace {

/// The number rounded down to `digits` decimals, as text.
std::string decimals(const encase::Rational& number, int digits) {
  encase::Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, digits);
  encase::Integer scaled;
  const encase::Rational shifted = abs(number) * power;
  mpz_fdiv_q(scaled.get_mpz_t(), shifted.get_num_mpz_t(), shifted.get_den_mpz_t());
  std::string text = scaled.get_str();
  if (static_cast<int>(text.size()) <= digits) text.insert(0, digits + 1 - text.size(), '0');
  text.insert(text.size() - digits, ".");
  return (number < 0 ? "-" : "") + text;
}

}  // namespace

int main() {
  using encase::Polynomial;
  // x^3 - 3 x y^2 + 1/10 = 0 and x^2 + x y + 2 y^2 - 1 = 0; a term is {exponents, coefficient}.
  const auto cubic =
      Polynomial<2>::from_terms({{{3, 0}, 1}, {{1, 2}, -3}, {{0, 0}, encase::Rational(1, 10)}});
  const auto ellipse =
      Polynomial<2>::from_terms({{{2, 0}, 1}, {{1, 1}, 1}, {{0, 2}, 2}, {{0, 0}, -1}});
  const auto region = encase::make_region({{{-2, -2}, {2, -1}, {1, 2}, {-2, 1}}});
  if (!region) {
    std::cerr << region.error().message << '\n';
    return 1;
  }

  encase::EncaseOptions options;
  options.max_seconds = 10;
  const auto result =
      encase::encase({{"cubic", cubic}, {"ellipse", ellipse}}, region.value(), options);
  if (!result) {
    std::cerr << result.error().message << '\n';
    return 1;
  }
  const encase::Encasement& encasement = result.value();
  if (encasement.outcome != encase::Outcome::Certified || !encase::verify(encasement).ok()) {
    std::cerr << "not certified\n";
    return 1;
  }
  for (int id = 0; id < static_cast<int>(encasement.crossings.size()); ++id) {
    const auto box = encase::refine(encasement, id, 140);
    if (!box) {
      std::cerr << box.error().message << '\n';
      return 1;
    }
    std::cout << decimals(box.value().lo[0], 40) << "  " << decimals(box.value().lo[1], 40) << '\n';
  }
}
