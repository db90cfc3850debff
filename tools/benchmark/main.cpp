// SPDX-License-Identifier: MIT
//
// The command `encase_benchmark`: times of Encase, beside CGAL's where that is found; one thread,
// CPU time, random pairs as in thesis 5.1. docs/benchmarks.md explains the tables.
#include <fmt/format.h>
#include <hwy/targets.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "chapter5.hpp"
#include "encase/atomic_file.hpp"
#include "newton_floor.hpp"
#include "tables.hpp"

namespace {

using namespace encase::benchmark;

struct Outputs {
  std::string csv, json, markdown;
};

/// A table by its name, and how it is made.
struct Section {
  std::string name;
  std::function<Table(RandomPairs&, const Request&)> make;
};

/// In the order in which they are measured: memory first, as long as the process is small; CGAL
/// last, as it takes the longest.
const std::vector<Section>& sections() {
  static const std::vector<Section> list{
      {"memory", [](RandomPairs&, const Request& r) { return memory_table(r); }},
      {"circles", [](RandomPairs&, const Request& r) { return circles_table(r); }},
      {"floors", floors_table},
      {"work", work_table},
      {"files", [](RandomPairs&, const Request& r) { return files_table(r); }},
      {"tangencies", [](RandomPairs&, const Request& r) { return near_tangency_table(r); }},
      {"caps", [](RandomPairs&, const Request& r) { return caps_table(r); }},
      {"space", [](RandomPairs&, const Request& r) { return space_table(r); }},
      {"surfaces", [](RandomPairs&, const Request& r) { return surfaces_table(r); }},
      {"locality", [](RandomPairs&, const Request& r) { return locality_table(r); }},
      {"growth", growth_table},
      {"arcs", [](RandomPairs&, const Request& r) { return arcs_table(r); }},
      {"arrangements", [](RandomPairs&, const Request& r) { return arrangements_table(r); }},
      {"cgal", cgal_table}};
  return list;
}

/// The instruction sets that Encase can use here, the best first.
std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

/// Lets Encase use one of them only.
void use_instructions(const std::string& name) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (hwy::TargetName(target) != name) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    return;
  }
}

int fail(const std::string& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "encase_benchmark: %s\n", message.c_str());
  return 1;
}

/// What Linux says about the processor under a name like "model name".
std::string processor(const std::string& name) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(name + "\t", 0) == 0) return line.substr(line.find(':') + 2);
  return "?";
}

std::string machine() {
  const std::string cgal = cgal_version();
  return fmt::format(
      "{} (family {}, model {}), {} MHz, {} cores, one used; {}; "
      "compiler {}; {}",
      processor("model name"), processor("cpu family"), processor("model"), processor("cpu MHz"),
      std::thread::hardware_concurrency(), instruction_sets().front(), __VERSION__,
      cgal.empty() ? "without CGAL" : "CGAL " + cgal);
}

void add_options(CLI::App& app, Request& request, Outputs& outputs,
                 std::vector<std::string>& only) {
  app.add_option("--degrees", request.degrees, "of the random pairs")
      ->delimiter(',')
      ->check(CLI::Range(1, encase::kMaxDegree))
      ->capture_default_str();
  app.add_option("--seeds", request.seeds, "of the random pairs")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--cgal-degrees", request.cgal_degrees,
                 "run CGAL up to this degree; 0: not at all")
      ->type_name("D")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--repeat", request.repetitions.count,
                 "time everything so often; 0: as often as takes 50 ms")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--most-curves", request.most_curves, "leave out what has more curves than this")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  std::vector<std::string> names;
  for (const Section& section : sections()) names.push_back(section.name);
  app.add_option("--only", only, "these tables: " + fmt::format("{}", fmt::join(names, ", ")))
      ->type_name("TABLE,...")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option_function<std::string>(
         "--instructions", use_instructions,
         "use these: " + fmt::format("{}", fmt::join(instruction_sets(), ", ")))
      ->type_name("SET")
      ->check(CLI::IsMember(instruction_sets()));
  app.add_option("--curves", request.curves_directory, "the directory of .curves files")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_option("--csv", outputs.csv, "write the tables and every pair with all digits")
      ->type_name("FILE");
  app.add_option("--json", outputs.json, "the same as JSON")->type_name("FILE");
  app.add_option("--markdown", outputs.markdown, "write the tables as they are printed")
      ->type_name("FILE");
}

encase::Status write_outputs(const Outputs& outputs, const std::vector<Table>& tables) {
  if (!outputs.csv.empty())
    if (auto status = encase::write_file(outputs.csv, to_csv(tables))) return status;
  if (!outputs.json.empty())
    if (auto status = encase::write_file(outputs.json, to_json(machine(), tables))) return status;
  if (outputs.markdown.empty()) return {};
  std::string text = machine() + "\n";
  for (const bool beside_cgal : {true, false})  // what readers look for first
    for (const Table& table : tables)
      if (table.printed && (table.name == "cgal") == beside_cgal) text += "\n" + to_markdown(table);
  return encase::write_file(outputs.markdown, text);
}

/// With degrees of its own, unless others were asked for.
Request chapter5_request(Request request, bool default_degrees) {
  if (default_degrees) request.degrees = {2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20};
  return request;
}

/// Prints every table as soon as it is measured.
std::vector<Table> measure(RandomPairs& pairs, const Request& request,
                           const std::vector<std::string>& only) {
  std::vector<Table> tables;
  for (const Section& section : sections()) {
    if (!only.empty() && std::find(only.begin(), only.end(), section.name) == only.end()) continue;
    Table table = section.make(pairs, request);
    if (table.rows.empty()) continue;
    fmt::print("\n{}", to_text(table));
    std::fflush(stdout);
    tables.push_back(std::move(table));
  }
  tables.push_back(every_pair_table(pairs, request));
  return tables;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times of Encase, beside CGAL's", "encase_benchmark");
  app.footer(
      "Times are CPU time of one thread; figures are medians, of random pairs the least of four "
      "rounds'. Exit codes: 0 measured, 1 not.");
  Request request;
  request.curves_directory = ENCASE_BENCHMARK_CURVES;
  request.caps_directory = ENCASE_BENCHMARK_CAPS;
  Outputs outputs;
  std::vector<std::string> only;
  add_options(app, request, outputs, only);
  const CLI::App* tables =
      app.add_subcommand("tables", "print the tables; so does no subcommand")->fallthrough();
  CLI::App* chapter5 = app.add_subcommand("chapter5", "draw figures 5.3 to 5.12 of the thesis");
  std::string directory;
  chapter5->fallthrough();
  chapter5->add_option("-o", directory, "write the plots and their data here")
      ->type_name("DIR")
      ->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    return fail(std::string(e.what()) + "; see encase_benchmark --help");
  }
  try {
    if (cgal_version().empty()) request.cgal_degrees = 0;
    fmt::print("{}\n", machine());
    RandomPairs pairs(request.repetitions);
    encase::Status status;
    if (*tables || !*chapter5) status = write_outputs(outputs, measure(pairs, request, only));
    if (!status && *chapter5)
      status =
          write_chapter5(pairs, chapter5_request(request, app.count("--degrees") == 0), directory);
    if (status) return fail(status->message);
  } catch (const std::exception& e) {
    return fail(e.what());
  }
  return 0;
}
