// SPDX-License-Identifier: MIT
//
// The command `encase`: options in, one of the subcommands called. docs/command.md is its contract.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "caps.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "encase/version.hpp"
#include "output.hpp"
#include "random_curves.hpp"
#include "slice.hpp"
#include "surfaces.hpp"
#include "validators.hpp"

namespace {

constexpr int kMostThreads = 1024;

constexpr char kExitCodes[] =
    "Exit codes: 0 certified, 1 usage or bad input, 2 files, 3 something degenerate is reported,\n"
    "4 something is undecided, 5 internal error.";

constexpr char kSolidRegion[] = "\"box x0 x1 y0 y1 z0 z1\" or \"halfspaces (a,b,c,d) ...\"";

constexpr char kSurfacesFile[] =
    "FILE has lines `name: expression` or `expression` in x, y, z and `region: box x0 x1 y0 y1 z0\n"
    "z1` or `region: halfspaces (a,b,c,d) ...`, each a x + b y + c z + d <= 0; # starts a\n"
    "comment.\n\n";

void add_threads(CLI::App& command, int& threads, const char* meaning) {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  threads = std::clamp(processors, 1, kMostThreads);
  command.add_option("--threads", threads, meaning)
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads))
      ->default_str("all processors");
}

/// `Options`: EncaseOptions or SurfaceOptions.
template <class Options>
void add_budgets(CLI::App& command, Options& options) {
  command.add_option("--max-cells", options.max_cells, "stop at so many cells")
      ->type_name("N")
      ->check(encase::kPositive)
      ->capture_default_str();
  command
      .add_option("--max-seconds", options.max_seconds,
                  "stop after so much CPU time, of all threads together")
      ->type_name("S")
      ->check(encase::kPositive)
      ->capture_default_str();
  command.add_option("--max-bits", options.max_bits, "the highest precision to try")
      ->type_name("N")
      ->check(CLI::Range(53, 1 << 20))
      ->capture_default_str();
  command
      .add_option("--start-bits", options.start_bits, "the precision to start with; 53: doubles")
      ->type_name("N")
      ->check(CLI::Range(53, 1 << 20))
      ->capture_default_str();
}

/// The FILE of `things`, one `thing`, or -e, and --region as `region_text` says.
void add_input(CLI::App& command, encase::Request& r, const std::string& things,
               const std::string& thing, const std::string& region_text) {
  command.add_option("FILE", r.file, things + " and region, as text or JSON; - is standard input");
  command.add_option("-e", r.expressions, thing + ", instead of FILE: an expression or lhs = rhs")
      ->type_name("EXPR")
      ->expected(1)
      ->take_all();
  command.add_option("--region", r.region, region_text + "; overrides the file's")
      ->type_name("REGION");
}

void add_json(CLI::App& command, encase::Request& r, const char* meaning) {
  command.add_option("--json", r.json, meaning)->type_name("FILE");
}

void add_vtk(CLI::App& command, encase::Request& r, const char* meaning) {
  command.add_option("-o", r.vtk_directory, meaning)->type_name("DIR");
}

void add_perturbation(CLI::App& command, double& delta, std::uint64_t& seed) {
  command.add_option("--perturb", delta, "perturb every coefficient c by up to DELTA (1 + |c|)")
      ->type_name("DELTA")
      ->check(encase::kPositive);
  command.add_option("--seed", seed, "of the perturbation")
      ->check(encase::kNatural)
      ->type_name("N")
      ->capture_default_str();
}

void add_reports(CLI::App& command, encase::Request& r) {
  command.add_flag("--summary", r.summary, "print one JSON object of counts and nothing else");
  command.add_flag("-q", r.quiet, "print no report");
  command.add_flag("-v", r.verbose, "report what each step did");
}

void add_curves(CLI::App& app, encase::CurvesRequest& r) {
  CLI::App* c = app.add_subcommand("curves", "Encase plane curves in a convex region");
  add_input(*c, r, "curves", "a curve",
            "\"xmin xmax ymin ymax\", \"polygon (x,y) (x,y) ...\" or \"plane\"");
  c->add_option("--onto", r.onto, "add the curves to those of an earlier result, in its region")
      ->type_name("RESULT");
  add_json(*c, r, "write the result, everything that proves it included");
  c->add_option("--svg", r.svg, "write a picture")->type_name("FILE");
  c->add_flag("--faces", r.faces, "with --svg, --mesh: faces of the arrangement, not cells");
  c->add_flag("--labels", r.labels, "with --svg: the numbers of faces, edges and vertices");
  c->add_option("--mesh", r.mesh, "write the cells for OpenMesh: .om, .off, .obj or .ply")
      ->type_name("FILE");
  add_vtk(*c, r, "write VTK files for ParaView");
  c->add_flag("--history", r.history, "with -o: the splitting as a .pvd with time steps");
  c->add_flag("--fast", r.options.fast, "try fewer splitting lines: less time, more cells");
  c->add_flag("--relaxed", r.options.relaxed, "accept cells with two branches that do not cross");
  add_perturbation(*c, r.options.perturbation, r.options.seed);
  add_budgets(*c, r.options);
  add_threads(*c, r.options.threads,
              "how many may work, of more than two curves; the result is the same for any number");
  add_reports(*c, r);
  c->footer(
      "FILE has lines `name: expression` or `expression`, with ^ for powers and exact decimals or\n"
      "fractions, and `region: xmin xmax ymin ymax`, `region: polygon (x,y) (x,y) ...` or\n"
      "`region: plane`; # starts a comment. With - for FILE of --json or --svg it goes to "
      "standard\n"
      "output and the report to standard error.\n\n" +
      std::string(kExitCodes));
}

void add_caps(CLI::App& app, encase::CapsRequest& r) {
  CLI::App* c = app.add_subcommand(
      "caps",
      "The arrangement of curves by a quadtree of a given depth (CAPS), also of curves "
      "with an inclusion function only");
  add_input(*c, r, "curves", "a curve", "\"xmin xmax ymin ymax\"");
  c->add_option("--epsilon", r.options.epsilon, "divide boxes until they are no wider than this")
      ->type_name("E")
      ->capture_default_str();
  c->add_flag("--self-crossings", r.options.self_crossings,
              "divide also where one curve may cross itself: for an exact answer");
  add_json(*c, r, "write the result: the quadtree, its regions, the graph");
  c->add_option("--svg", r.svg, "write a picture")->type_name("FILE");
  add_vtk(*c, r, "write VTK files for ParaView");
  c->add_option("--max-boxes", r.options.max_boxes, "stop at so many nodes of the quadtree")
      ->type_name("N")
      ->check(encase::kPositive)
      ->capture_default_str();
  c->add_option("--max-seconds", r.options.max_seconds, "stop after so much CPU time")
      ->type_name("S")
      ->check(encase::kPositive)
      ->capture_default_str();
  add_reports(*c, r);
  c->footer(
      "Exit codes: 0 exact (proved), 1 usage or bad input, 2 files, 3 delta-weak only, 4 a budget\n"
      "ran out, 5 internal error.");
}

void add_slice(CLI::App& app, encase::SliceRequest& r) {
  CLI::App* c = app.add_subcommand("slice", "Encase what surfaces have on a plane");
  add_input(*c, r, "surfaces", "a surface", kSolidRegion);
  c->add_option("--plane", r.plane, "\"a b c d\": the plane a x + b y + c z + d = 0")
      ->type_name("PLANE");
  c->add_option("--count", r.count, "so many planes parallel to it, evenly through the region")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  add_json(*c, r, "write the result, everything that proves it included");
  c->add_option("--svg", r.svg, "write a picture, in the plane's coordinates")->type_name("FILE");
  add_vtk(*c, r, "write VTK files for ParaView, in space; of --count as time steps");
  c->add_flag("--fast", r.options.fast, "try fewer splitting lines: less time, more cells");
  c->add_flag("--relaxed", r.options.relaxed, "accept cells with two branches that do not cross");
  add_budgets(*c, r.options);
  add_threads(*c, r.options.threads, "how many may work, of more than two curves on a plane");
  add_reports(*c, r);
  c->footer(std::string(kSurfacesFile) + kExitCodes);
}

void add_surfaces(CLI::App& app, encase::SurfacesRequest& r) {
  CLI::App* c = app.add_subcommand("surfaces", "Encase surfaces in a convex polyhedron");
  add_input(*c, r, "surfaces", "a surface", kSolidRegion);
  add_json(*c, r, "write the result, everything that proves it included");
  c->add_option("--mesh", r.mesh, "write the surfaces for OpenMesh: .om, .off, .obj or .ply")
      ->type_name("FILE");
  add_vtk(*c, r, "write VTK files for ParaView");
  c->add_flag("--history", r.history, "with -o: the splitting as a .pvd with time steps");
  c->add_option("--tolerance", r.tolerance,
                "of curves and meshes, in input units; by default 1/1000 of the region's size")
      ->type_name("T")
      ->check(encase::kPositive);
  c->add_option("--angle", r.angle, "of meshes: between normals of triangles and surfaces, radians")
      ->type_name("A")
      ->capture_default_str();
  add_perturbation(*c, r.options.perturbation, r.options.seed);
  c->add_option("--singular-width", r.options.singular_width,
                "of the cells along singular curves, in parts of the region's size")
      ->type_name("PART")
      ->check(encase::kPositive)
      ->capture_default_str();
  add_budgets(*c, r.options);
  add_threads(*c, r.options.threads, "how many may work; the result is the same for any number");
  add_reports(*c, r);
  c->footer(std::string(kSurfacesFile) + kExitCodes);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace encase;
  CLI::App app("Certified encasements and arrangements of curves and surfaces", "encase");
  app.set_version_flag("--version", std::string("encase ") + kVersion);
  app.require_subcommand(1);
  app.footer(kExitCodes);

  CurvesRequest curves;
  add_curves(app, curves);

  CapsRequest caps;
  add_caps(app, caps);

  SliceRequest slices;
  add_slice(app, slices);

  SurfacesRequest surfaces;
  add_surfaces(app, surfaces);

  CheckRequest proof;
  CLI::App* check = app.add_subcommand("check", "Prove a result again from its own facts");
  check->add_option("RESULT", proof.file, "what --json wrote; - is standard input")->required();
  check->add_flag("-q", proof.quiet, "print nothing but errors");
  add_threads(*check, proof.options.threads, "how many may work");
  check->footer(kExitCodes);

  RandomRequest random;
  CLI::App* generate = app.add_subcommand("random", "Print random curves");
  add_random_options(*generate, random);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    std::string message = e.what();
    const auto parsed = app.get_subcommands();
    message += "; see encase " + (parsed.empty() ? "" : parsed[0]->get_name() + " ") + "--help";
    return fail({Error::Code::BadInput, message});
  }
  try {
    if (*check) return run_check(proof);
    if (*generate) return run_random(random);
    if (app.got_subcommand("caps")) return run_caps(caps);
    if (app.got_subcommand("slice")) return run_slice(slices);
    if (app.got_subcommand("surfaces")) return run_surfaces(surfaces);
    return run_curves(curves);
  } catch (const std::bad_alloc&) {
    return fail({Error::Code::Undecided, "memory ran out"});
  } catch (const std::exception& e) {
    return fail({Error::Code::Internal, std::string("internal error: ") + e.what()});
  }
}
