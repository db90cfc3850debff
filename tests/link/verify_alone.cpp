// SPDX-License-Identifier: MIT
//
// Links encase_verify, encase_arrangement and encase_common, and nothing of the search:
// verification stands alone.
#include <cstdio>

#include "encase/verify.hpp"
#include "hand_made_encasement.hpp"

int main() {
  using namespace encase;
  // The lines x = y / 3 + 1 / 7 and x = -y / 5 - 1 / 9.
  hand_made::Recipe recipe;
  recipe.curves = {
      hand_made::polynomial({{{1, 0}, 1}, {{0, 1}, Rational(-1, 3)}, {{0, 0}, Rational(-1, 7)}}),
      hand_made::polynomial({{{1, 0}, 1}, {{0, 1}, Rational(1, 5)}, {{0, 0}, Rational(1, 9)}})};
  recipe.corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  recipe.crossings = {{{0, 1}, {-1.0 / 63, -10.0 / 21}}};
  Encasement encasement = hand_made::build(recipe);

  const Verification verification = verify(encasement);
  for (const std::string& objection : verification.objections) std::puts(objection.c_str());
  if (!verification.ok()) return 1;
  // And it does look: the same result with another word is refused.
  std::swap(encasement.cells[0].word[0], encasement.cells[0].word[1]);
  if (verify(encasement).ok()) return 1;
  return verify(CapsResult{}).ok() ? 1 : 0;
}
