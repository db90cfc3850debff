// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "encase/caps.hpp"
#include "encase/curves_file.hpp"
#include "tables.hpp"

namespace encase::benchmark {
namespace {

/// A row of table 1 of the paper: one class of curves, on a 3.6 GHz Xeon (2006).
struct PublishedClass {
  const char* file;
  const char* name;
  int nodes;
  double seconds;
};

constexpr PublishedClass kClasses[] = {
    {"lines", "lines (5)", 12097, 0.8},
    {"algebraic", "algebraic curves (5)", 32875, 1.3},
    {"degenerate_lines", "degenerate (7 lines)", 19546, 1.9},
    {"degenerate_polynomials", "degenerate (5 polynomials)", 251440, 2.8},
    {"trigonometric", "trigonometric functions (3)", 12271, 0.2},
    {"inverse_sine", "inverse sine (2)", 20800, 12.6},
    {"arbitrary", "arbitrary curves (10)", 78736, 7.5}};

const char* to_string(CapsClass answer) {
  switch (answer) {
    case CapsClass::Exact:
      return "exact";
    case CapsClass::DeltaWeak:
      return "delta-weak";
    case CapsClass::Undecided:
      return "undecided";
  }
  return "";
}

}  // namespace

Table caps_table(const Request& request) {
  Table table{"caps",
              "CAPS, table 1 re-created: our quadtrees and times beside the published ones",
              {"curves", "self-crossings", "answer", "nodes", "published nodes", "part",
               "quadtree ms", "ms", "published ms", "ratio", "vertices", "edges"},
              {}};
  for (const PublishedClass& published : kClasses) {
    const CurvesFile file =
        load_curves(request.caps_directory + "/" + published.file + ".curves").value();
    for (const bool self_crossings : {false, true}) {
      CapsOptions options;
      options.self_crossings = self_crossings;
      options.polylines = false;
      std::vector<double> tree_seconds;
      CapsResult result;
      const double seconds = time_of(request.repetitions, [&] {
        result = caps(file.curves, *file.region, options).value();
        tree_seconds.push_back(result.tree_seconds);
      });
      table.add({published.name, self_crossings ? "too" : "no", to_string(result.answer),
                 result.nodes, std::int64_t{published.nodes},
                 static_cast<double>(result.nodes) / published.nodes, 1e3 * median(tree_seconds),
                 1e3 * seconds, 1e3 * published.seconds, published.seconds / seconds,
                 static_cast<std::int64_t>(result.vertices.size()),
                 static_cast<std::int64_t>(result.edges.size())});
    }
  }
  return table;
}

}  // namespace encase::benchmark
