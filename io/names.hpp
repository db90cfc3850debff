// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"

/// The words for enumerators in files and reports.
namespace encase {

/// Of the format "encase-result".
inline constexpr int kResultVersion = 1;

template <class E>
struct Name {
  E value;
  const char* text;
};

inline constexpr Name<Outcome> kOutcomes[] = {{Outcome::Certified, "certified"},
                                              {Outcome::Degenerate, "degenerate"},
                                              {Outcome::Undecided, "undecided"}};
inline constexpr Name<Location> kLocations[] = {{Location::Inside, "inside"},
                                                {Location::OnBoundary, "on_boundary"},
                                                {Location::Outside, "outside"}};
inline constexpr Name<CellState> kCellStates[] = {{CellState::Certified, "certified"},
                                                  {CellState::Relaxed, "relaxed"},
                                                  {CellState::Degenerate, "degenerate"},
                                                  {CellState::Undecided, "undecided"}};
inline constexpr Name<Unresolved::Kind> kUnresolvedKinds[] = {
    {Unresolved::Kind::Contact, "contact"},
    {Unresolved::Kind::SingularPoint, "singular_point"},
    {Unresolved::Kind::Concurrency, "concurrency"},
    {Unresolved::Kind::SharedComponent, "shared_component"},
    {Unresolved::Kind::RepeatedComponent, "repeated_component"},
    {Unresolved::Kind::Infinity, "infinity"},
    {Unresolved::Kind::NotAnalytic, "not_analytic"},
    {Unresolved::Kind::Budget, "budget"}};

inline constexpr Name<Arrangement::Vertex::Kind> kVertexKinds[] = {
    {Arrangement::Vertex::Kind::Crossing, "crossing"},
    {Arrangement::Vertex::Kind::OnBoundary, "on_boundary"},
    {Arrangement::Vertex::Kind::Corner, "corner"}};

template <class E, std::size_t N>
const char* name_of(const Name<E> (&names)[N], E value) {
  for (const Name<E>& name : names)
    if (name.value == value) return name.text;
  return "";
}

/// The curves of these are indices of input curves, of the others indices of encased curves.
inline bool names_input_curves(Unresolved::Kind kind) {
  return kind == Unresolved::Kind::SharedComponent || kind == Unresolved::Kind::RepeatedComponent;
}

}  // namespace encase
