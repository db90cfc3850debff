// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cgal_rival.hpp"
#include "encase/encasement.hpp"
#include "stopwatch.hpp"

namespace encase::benchmark {

/// A way to encase that is measured.
struct Setting {
  std::string name;
  EncaseOptions options;
};

/// All settings; the first is the one that tables show where there is room for one.
std::vector<Setting> settings();

/// Two curves of one degree through random points of [-1,1]^2 (thesis 5.1), their coefficients
/// rounded to doubles and then taken exactly.
std::vector<NamedCurve> random_pair(int degree, std::uint64_t seed);

/// The square [-1,1]^2.
Region unit_region();

/// One encasement and the median CPU seconds it takes.
struct TimedEncasement {
  double seconds = 0;
  Encasement result;
  bool certified() const { return result.outcome == Outcome::Certified; }
};

TimedEncasement timed_encasement(const std::vector<NamedCurve>& curves, const Region& region,
                                 const EncaseOptions& options, const Repetitions& repetitions);

/// "certified", "degenerate" or "undecided".
std::string to_string(Outcome outcome);

/// CPU seconds of the three stages of thesis 5.1 that an encasement consists of.
struct Stages {
  double curves = 0;       ///< sanity and critical regions: what is found of each curve alone
  double roots = 0;        ///< the polygon, all crossings, the splitting, the certificates
  double coordinates = 0;  ///< to 2^-53, where the encasement does not know them so well
  double total() const { return curves + roots + coordinates; }
};

Stages stages_of(const std::vector<NamedCurve>& curves, const Region& region,
                 const Repetitions& repetitions);

/// What is measured of a random pair without CGAL.
struct PairFigures {
  std::vector<TimedEncasement> encasements;  ///< one a setting
  double isolation = 0;                      ///< isolate_roots<2>, made ready before
  double isolation_with_setup = 0;           ///< with the FilteredFunctions made each time
  double floor = 0;                          ///< four Newton steps at each crossing
  double floor_together = 0;                 ///< the same, eight crossings at a time
  double newton_error = 0;  ///< how far the steps end from a certified crossing, at most
};

/// Random pairs and what was measured of them in this run of the program. Pairs are measured in
/// rounds, and the least of the rounds' medians counts: what else a machine does slows everything
/// down for seconds or minutes, and never speeds anything up.
class RandomPairs {
 public:
  explicit RandomPairs(Repetitions repetitions) : repetitions_(repetitions) {}

  const Repetitions& repetitions() const { return repetitions_; }
  /// Measures the pairs of these degrees and seeds that have not been, with CGAL too if asked to:
  /// several together, so that their rounds are some time apart.
  void measure(const std::vector<int>& degrees, const std::vector<std::uint64_t>& seeds,
               int cgal_degrees);
  const PairFigures& ours(int degree, std::uint64_t seed);
  const Stages& stages(int degree, std::uint64_t seed);
  /// Requires that the program was built with CGAL.
  const CgalFigures& cgal(int degree, std::uint64_t seed);
  /// Null where CGAL has not been run.
  const CgalFigures* measured_cgal(int degree, std::uint64_t seed) const;

 private:
  using Key = std::pair<int, std::uint64_t>;
  int rounds() const;
  void measure_ours(const std::vector<Key>& pairs);
  void measure_cgal(const std::vector<Key>& pairs);
  CgalFigures cgal_once(const Key& key) const;
  Repetitions repetitions_;
  std::map<Key, PairFigures> ours_;
  std::map<Key, Stages> stages_;
  std::map<Key, CgalFigures> cgal_;
};

}  // namespace encase::benchmark
