// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "encase/cover.hpp"
#include "encase/encasement.hpp"
#include "encase/polyhedron.hpp"
#include "io/function_json.hpp"
#include "io/json_node.hpp"
#include "io/json_writer.hpp"
#include "io/names.hpp"

/// What results of the format "encase-result" have in common (docs/json.md).
namespace encase {

/// The opening brace and the first four keys; further ones begin with JsonWriter::section.
void put_head(JsonWriter& w, const char* command, const char* status);

/// Each with its name, its function and the indices of the inputs that it is part of.
template <class Functions>
void put_encased(JsonWriter& w, const Functions& functions) {
  w.lines(functions, [&](const auto& encased) {
    w.raw("{");
    w.field("name", encased.name);
    put_function(w, encased.function);
    w.field("sources", encased.sources);
    w.raw("}");
  });
}

void put_polygon(JsonWriter& w, const Region& polygon);
Region read_polygon(const JsonNode& corners);

void put_solid_region(JsonWriter& w, const Polyhedron& region);
Polyhedron read_solid_region(const JsonNode& node);
HalfSpace read_half_space(const JsonNode& node);

/// The keys of a cover after those that say what it lists.
template <int D>
void put_cover(JsonWriter& w, const Box<D>& root, const std::vector<int>& tokens) {
  w.field("root", root);
  w.field("tokens", tokens);
}
/// The tokens of a cover of a box of dimension D that lists `items`.
template <int D>
std::vector<int> read_tokens(const JsonNode& node, std::size_t items) {
  return node.map([&](const JsonNode& token) {
    const auto value = token.integer(cover::kUnresolved, static_cast<std::int64_t>(items) - 1);
    if (D == 2 && value == cover::kSplitZ) token.fail("a plane cover is not cut in z");
    return static_cast<int>(value);
  });
}

/// N indices of `functions`, ascending.
template <std::size_t N>
std::array<int, N> read_ascending(const JsonNode& node, std::size_t functions) {
  node.of_size(static_cast<int>(N));
  std::array<int, N> read;
  for (std::size_t k = 0; k < N; ++k) {
    read[k] = node.item(static_cast<int>(k)).index(functions);
    if (k > 0 && read[k] <= read[k - 1]) node.fail("expected different indices in ascending order");
  }
  return read;
}

void put_history(JsonWriter& w, const std::vector<Split>& history);
/// Children come after their parents and each has one parent, so that walks down the history end.
std::vector<Split> read_history(const JsonNode& node, std::size_t cuts, std::size_t cells);

/// Places of results of curves or surfaces, with the list `Place::*functions` under the key `of`.
/// `put_rest` puts what else there is of a place.
template <class Place, class PutRest>
void put_unresolved(JsonWriter& w, const std::vector<Place>& places, const char* of,
                    std::vector<int> Place::*functions, const PutRest& put_rest) {
  w.lines(places, [&](const Place& place) {
    w.raw("{");
    w.field("kind", name_of(kUnresolvedKinds, place.kind));
    w.key("box");
    if (place.has_box)
      w.put(place.box);
    else
      w.raw("null");
    w.field(of, place.*functions);
    w.field("proved", place.proved);
    w.field("reason", place.reason);
    put_rest(place);
    w.raw("}");
  });
}

/// `input`, `encased`: how many functions there are that the place may name.
template <class Place>
std::vector<Place> read_unresolved(const JsonNode& node, const char* of,
                                   std::vector<int> Place::*functions, std::size_t input,
                                   std::size_t encased) {
  return node.map([&](const JsonNode& item) {
    Place place;
    place.kind = item.member("kind").one_of(kUnresolvedKinds);
    const JsonNode box = item.member("box");
    place.has_box = !box.is_null();
    if (place.has_box)
      place.box = box.box<static_cast<int>(std::tuple_size_v<decltype(place.box.lo)>)>();
    place.*functions = item.member(of).indices(names_input_curves(place.kind) ? input : encased);
    place.proved = item.member("proved").boolean();
    place.reason = item.member("reason").text();
    return place;
  });
}

void put_decisions(JsonWriter& w, const DecisionCounts& decisions);
DecisionCounts read_decisions(const JsonNode& node);

}  // namespace encase
