// SPDX-License-Identifier: MIT
#include "3d/surface_encaser.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "3d/arc_direction.hpp"
#include "3d/edge_lines.hpp"
#include "3d/pair_certificate.hpp"
#include "3d/pair_critical_points.hpp"
#include "3d/solid_region.hpp"
#include "3d/solid_sides.hpp"
#include "common/isolate_roots.hpp"
#include "common/parallel.hpp"
#include "common/wording.hpp"

namespace encase {

namespace {

/// Directions that nobody has reason to put curves at right angles to.
Point<3> generic_direction(int number) {
  const double turn = std::fmod(0.6180339887498949 * (number + 1), 1.0),
               height = 0.35 + 0.3 * std::fmod(0.4142135623730951 * (number + 1), 1.0);
  const double angle = 6.283185307179586 * turn, radius = std::sqrt(1 - height * height);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// For how many directions critical points are listed for two surfaces with this sum of degrees. A
/// cell needs one list without a point in it, so more lists save cells; but to make lists of a
/// higher degree costs more than those cells.
int most_lists(int degrees) { return degrees <= 4 ? 2 : 1; }

/// The side of the plane on which the whole box lies, as far as intervals tell.
std::optional<Sign> side(const HalfSpace& half_space, const Box<3>& box) {
  Interval value = Interval::enclose(half_space[3]);
  for (int i = 0; i < 3; ++i)
    value = value + Interval::enclose(half_space[i]) * Interval(box.lo[i], box.hi[i]);
  return value.sign();
}

}  // namespace

SurfaceEncaser::SurfaceEncaser(const std::vector<NamedSurface>& input, const Polyhedron& region,
                               const SurfaceOptions& options)
    : options_(options), clock_(std::max(options.threads, 1)) {
  kernel_.start_bits = std::max(options.start_bits, Kernel::kDoubleBits);
  kernel_.max_bits = std::max(options.max_bits, kernel_.start_bits);
  result_.input = input;
  result_.perturbation = options.perturbation;
  result_.seed = options.seed;
  result_.region = region;
}

bool SurfaceEncaser::out_of_budget() {
  if (is_stopped_) return true;
  if (clock_.exceeds(options_.max_seconds)) {
    budget_ = "the limit of " + decimal(options_.max_seconds) + " CPU seconds was reached";
    is_stopped_ = true;
  }
  return is_stopped_;
}

bool SurfaceEncaser::stop(const char* stage) {
  const std::lock_guard lock(mutex_);
  if (!is_stopped_ && options_.progress && !options_.progress(stage, -1)) {
    budget_ = "the computation was cancelled";
    is_stopped_ = true;
  }
  return out_of_budget();
}

/// Calls work(i, kernel) for 0 <= i < count, each once, on as many threads as may work, with
/// kernels of their own.
void SurfaceEncaser::share_out(int count, const std::function<void(int, Kernel&)>& work) {
  std::vector<Kernel> kernels(static_cast<std::size_t>(count), kernel_.fresh());
  const RunClock::SharedOut shared_out(clock_);
  parallel_for(count, options_.threads, [&](int i) {
    const RunClock::Shift shift(clock_);
    work(i, kernels[static_cast<std::size_t>(i)]);
  });
  for (const Kernel& kernel : kernels) kernel_.add(kernel);
}

SubdivisionLimits SurfaceEncaser::limits(const char* stage) {
  SubdivisionLimits limits;
  limits.max_boxes = 50000;
  limits.stop = [this, stage] { return stop(stage); };
  return limits;
}

void SurfaceEncaser::use_region(int attempt) {
  auto region = usable_region(result_.region, attempt);
  if (!region) region = usable_region(result_.region, 0);
  partition_.reset();
  encaser_.reset();
  facets_.clear();
  cells_.clear();
  region_ = std::move(*region);
  sides_ = planes_of(region_.polyhedron);
  result_.degenerate.resize(notes_);
  result_.undecided.clear();
}

/// Two surfaces that a combination of their functions proves to be apart in the whole region have
/// no points in common, and no cell asks for a list of any.
void SurfaceEncaser::find_apart_pairs() {
  const Box<3> box = region_.polyhedron.bounding_box();
  apart_.clear();
  for (std::size_t f = 0; f < surfaces_.size(); ++f)
    for (std::size_t g = f + 1; g < surfaces_.size(); ++g) {
      const int degree = std::max(surfaces_[f].degree(), surfaces_[g].degree());
      Bernstein<3> nets[2];
      surfaces_[f].expand(box, degree, kernel_.start_bits, kernel_, &nets[0]);
      surfaces_[g].expand(box, degree, kernel_.start_bits, kernel_, &nets[1]);
      if (find_apart(nets[0], nets[1], box, surfaces_[f].scale(), surfaces_[g].scale()))
        apart_.insert({static_cast<int>(f), static_cast<int>(g)});
    }
}

bool SurfaceEncaser::isolate_triple_points() {
  find_apart_pairs();
  result_.triple_points.clear();
  result_.triple_point_covers.clear();
  inside_.clear();
  bool is_generic = true;
  const Box<3> box = region_.polyhedron.bounding_box();
  std::vector<std::array<int, 3>> triples;
  const int n = static_cast<int>(surfaces_.size());
  for (int f = 0; f < n; ++f)
    for (int g = f + 1; g < n; ++g)
      for (int h = g + 1; h < n; ++h)
        if (apart_.count({f, g}) + apart_.count({f, h}) + apart_.count({g, h}) == 0)
          triples.push_back({f, g, h});
  std::vector<RootIsolation<3>> roots(triples.size());
  share_out(static_cast<int>(triples.size()), [&](int i, Kernel& kernel) {
    const auto at = [&](std::size_t k) {
      return &surfaces_[static_cast<std::size_t>(triples[static_cast<std::size_t>(i)][k])];
    };
    roots[static_cast<std::size_t>(i)] = isolate_roots<3>(
        {at(0), at(1), at(2)}, box, sides_, limits("isolating triple points"), kernel);
  });
  for (std::size_t k = 0; k < triples.size(); ++k)
    is_generic = add_triple_points(std::move(roots[k]), triples[k]) && is_generic;
  return is_generic;
}

/// False if a point is not told to be inside or outside of the region.
bool SurfaceEncaser::add_triple_points(RootIsolation<3> roots, const std::array<int, 3>& surfaces) {
  result_.statistics.point_boxes += roots.boxes;
  const int first = static_cast<int>(result_.triple_points.size());
  bool is_generic = true;
  std::array<const Function<3>*, 3> functions;
  for (std::size_t i = 0; i < 3; ++i)
    functions[i] = &result_.surfaces[static_cast<std::size_t>(surfaces[i])].function;
  for (std::size_t k = 0; k < roots.roots.size(); ++k) {
    TriplePoint point;
    point.surfaces = surfaces;
    point.box = roots.roots[k];
    point.point = point.box.center();
    point.rounded = k < roots.rounded.size() && roots.rounded[k];
    bool inside = true, outside = false;
    for (const HalfSpace& half_space : region_.polyhedron.sides) {
      const std::optional<Sign> at = side(half_space, point.box);
      inside = inside && at == Sign::Negative;
      outside = outside || at == Sign::Positive;
    }
    is_generic = is_generic && (inside || outside);
    point.location = location_of(functions, point.rounded ? neighbours_of(point.point) : point.box,
                                 point.point, result_.region);
    inside_.push_back(inside ? 1 : 0);
    result_.triple_points.push_back(point);
  }
  UnresolvedInSpace entry;
  entry.kind = Unresolved::Kind::Concurrency;
  entry.surfaces.assign(surfaces.begin(), surfaces.end());
  report_boxes(roots.unresolved, entry,
               "three surfaces touch, nearly touch or have a curve in common");
  for (int& token : roots.tokens)
    if (token >= 0) token += first;
  result_.triple_point_covers.push_back({surfaces, roots.root_box, std::move(roots.tokens)});
  return is_generic;
}

/// Whether the gradients of two surfaces are parallel everywhere, as those of concentric spheres:
/// then every common point is critical.
bool SurfaceEncaser::gradients_are_parallel(int f, int g) const {
  const auto at = [&](int s) -> const Surface& {
    return result_.surfaces[static_cast<std::size_t>(s)];
  };
  const Point<3> center = region_.polyhedron.bounding_box().center();
  const Point<3> p = generic_direction(0), x{center[0] + p[0], center[1] + p[1], center[2] + p[2]},
                 a = surfaces_[static_cast<std::size_t>(f)].gradient(x),
                 b = surfaces_[static_cast<std::size_t>(g)].gradient(x);
  // Nearly always one point tells that they are not.
  double cross = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    cross = std::max(cross, std::fabs(a[j] * b[k] - a[k] * b[j]));
    size = std::max(size, std::fabs(a[j] * b[k]) + std::fabs(a[k] * b[j]));
  }
  if (cross > 1e-9 * size) return false;
  for (int i = 0; i < 3; ++i) {
    Point<3> axis{};
    axis[static_cast<std::size_t>(i)] = 1;
    const auto along = arc_direction(at(f).function, at(g).function, axis);
    if (!along || !along->is_zero()) return false;
  }
  return true;
}

void SurfaceEncaser::isolate_critical_points() {
  result_.critical_points.clear();
  directions_.clear();
  std::vector<std::array<int, 2>> pairs;
  for (int f = 0; f < static_cast<int>(surfaces_.size()); ++f)
    for (int g = f + 1; g < static_cast<int>(surfaces_.size()); ++g)
      if (apart_.count({f, g}) == 0) pairs.push_back({f, g});
  const int count = static_cast<int>(pairs.size());
  struct List {
    Point<3> w;
    PairCriticalPoints found;
  };
  std::vector<std::vector<List>> lists(pairs.size());
  share_out(count, [&](int i, Kernel& kernel) {
    const auto [f, g] = pairs[static_cast<std::size_t>(i)];
    if (gradients_are_parallel(f, g)) return;
    const FilteredFunction<3>&a = surfaces_[static_cast<std::size_t>(f)],
          &b = surfaces_[static_cast<std::size_t>(g)];
    for (int k = 0; k < most_lists(a.degree() + b.degree()); ++k) {
      const Point<3> w = generic_direction(i + k * count);
      auto found = pair_critical_points(a, b, w, region_.polyhedron.bounding_box(), sides_,
                                        limits("isolating critical points"), kernel);
      if (!found) break;
      const bool is_final = found->points.roots.empty() && found->points.unresolved.empty();
      lists[static_cast<std::size_t>(i)].push_back({w, std::move(*found)});
      if (is_final) break;
    }
  });
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (auto& [w, found] : lists[k]) {
      result_.statistics.critical_boxes += found.points.boxes;
      result_.critical_points.push_back({pairs[k], w, std::move(found.points.roots),
                                         found.points.root_box, std::move(found.points.tokens)});
      directions_.push_back(std::move(found.direction));
    }
}

void SurfaceEncaser::partition() {
  scene_.reset(new SpaceScene{surfaces_, region_.polyhedron, result_.triple_points,
                              result_.triple_point_covers, result_.critical_points});
  PartitionLimits limits;
  limits.max_leaves = options_.max_cells;
  limits.singular_width = options_.singular_width;
  limits.stop = [this] { return stop("splitting cells"); };
  partition_ = std::make_unique<SpacePartition>(*scene_, limits, kernel_);
  partition_->certify();

  EncaseOptions plane_options;
  plane_options.relaxed = true;
  plane_options.fast = true;
  plane_options.max_seconds = options_.max_seconds;
  plane_options.max_bits = kernel_.max_bits;
  plane_options.start_bits = kernel_.start_bits;
  plane_options.progress = [this](const char*, double) { return !stop("encasing facets"); };
  encaser_ = std::make_unique<FacetEncaser>(result_.surfaces, partition_->planes(), plane_options,
                                            kernel_);
}

bool SurfaceEncaser::read_cells(bool last) {
  while (true) {
    encase_facets();
    if (!last && !is_stopped_ && facets_fail()) return false;
    if (read_all()) return true;
  }
}

/// Encases the facets of all cells, and numbers the points on them.
void SurfaceEncaser::encase_facets() {
  BoxPartition boxes{partition_->planes(),
                     partition_->history(),
                     region_.polyhedron.bounding_box(),
                     {-1, -1, -1, -1, -1, -1}};
  if (region_.is_box) boxes.root_planes = {0, 1, 2, 3, 4, 5};
  encaser_->recycle(std::move(facets_));
  facets_.clear();
  const auto& leaves = partition_->leaves();
  cells_.resize(leaves.size());
  for (Cell& cell : cells_) {
    cell.facets.clear();
    cell.is_current = false;
  }
  const auto is_open = [&](int cell) {
    return cell < 0 || leaves[static_cast<std::size_t>(cell)].state != CellState::Certified ||
           cells_[static_cast<std::size_t>(cell)].trouble;
  };
  for (FacetPlace& place : facet_places(boxes, region_, encaser_->charts())) {
    const int index = static_cast<int>(facets_.size());
    std::vector<int> surfaces;
    if (!is_open(place.cells[0]) || !is_open(place.cells[1]))
      for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        const auto may_meet = [&](int cell) {
          return cell < 0 || leaves[static_cast<std::size_t>(cell)].signs[s] == Sign::Zero;
        };
        if (may_meet(place.cells[0]) && may_meet(place.cells[1]))
          surfaces.push_back(static_cast<int>(s));
      }
    for (const int cell : place.cells)
      if (cell >= 0) cells_[static_cast<std::size_t>(cell)].facets.push_back(index);
    facets_.push_back(encaser_->facet_at(std::move(place), surfaces));
  }
  encaser_->encase(facets_, [this](int count, const std::function<void(int)>& work) {
    share_out(count, [&](int i, Kernel&) { work(i); });
  });
  std::vector<Facet*> facets;
  for (EncasedFacet& encased : facets_) facets.push_back(&encased.facet);
  points_ = number_facet_points(surfaces_, partition_->planes(), encaser_->charts(), facets);
}

/// Whether a facet of a certified leaf failed, and other planes could help: one on the region's
/// boundary, or any where no leaf resists by itself.
bool SurfaceEncaser::facets_fail() const {
  const auto& leaves = partition_->leaves();
  const auto certified = [](const SpacePartition::Leaf& leaf) {
    return leaf.state == CellState::Certified;
  };
  const bool all_certified = std::all_of(leaves.begin(), leaves.end(), certified);
  return std::any_of(facets_.begin(), facets_.end(), [&](const EncasedFacet& encased) {
    const std::array<int, 2>& cells = encased.facet.cells;
    return encased.trouble && (all_certified || cells[0] < 0 || cells[1] < 0) &&
           std::any_of(cells.begin(), cells.end(), [&](int cell) {
             return cell >= 0 && certified(leaves[static_cast<std::size_t>(cell)]);
           });
  });
}

void SurfaceEncaser::leave(int index, Outcome outcome, std::string reason) {
  Cell& cell = cells_[static_cast<std::size_t>(index)];
  cell.reading = {};
  cell.trouble = outcome;
  cell.reason = std::move(reason);
}

bool SurfaceEncaser::read_all() {
  std::vector<const Facet*> facets;
  for (const EncasedFacet& encased : facets_) facets.push_back(&encased.facet);
  const FacetComplex complex{surfaces_, partition_->planes(), facets, encaser_->charts(), kernel_};
  const ReadingScene scene{complex,
                           points_,
                           result_.triple_points,
                           inside_,
                           partition_->graphs(),
                           partition_->pairs(),
                           directions_};
  const int n = static_cast<int>(cells_.size());
  for (int k = 0; k < n; ++k)
    if (!cells_[static_cast<std::size_t>(k)].is_settled) read(scene, k);
  if (split_ambiguous()) return false;
  for (int k = 0; k < n; ++k)
    if (!cells_[static_cast<std::size_t>(k)].is_current) read(scene, k);
  return !split_ambiguous();
}

void SurfaceEncaser::read(const ReadingScene& scene, int index) {
  Cell& cell = cells_[static_cast<std::size_t>(index)];
  const SpacePartition::Leaf& leaf = partition_->leaves()[static_cast<std::size_t>(index)];
  cell.is_settled = cell.is_current = true;
  if (cell.trouble || leaf.state != CellState::Certified) return;
  for (const int f : cell.facets)
    if (const auto& trouble = facets_[static_cast<std::size_t>(f)].trouble) {
      leave(index, trouble->outcome, trouble->reason);
      return;
    }
  cell.reading = read_cell(scene, index, leaf, cell.facets);
  if (cell.reading.kind == Reading::Kind::Ambiguous) cell.is_settled = false;
  if (cell.reading.kind == Reading::Kind::Inconsistent)
    leave(index, Outcome::Undecided, cell.reading.reason);
}

bool SurfaceEncaser::split_ambiguous() {
  bool any = false;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    if (cells_[k].is_settled) continue;
    any = true;
    const int index = static_cast<int>(k);
    const Reading reading = cells_[k].reading;
    ++result_.statistics.splits_after_reading;
    if (out_of_budget() || !partition_->split(index, reading.hint))
      leave(index, Outcome::Undecided, reading.reason);
  }
  return any;
}

}  // namespace encase
