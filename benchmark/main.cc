// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <set>
#include <thread>

#include "benchmark/rank_program.h"
#include "benchmark/report.h"

namespace codesign {
namespace {

struct Part {
  const char* name;
  void (*measure)(Report*);
};
constexpr Part kParts[] = {{"kernels", measure_kernels},
                           {"steps", measure_steps},
                           {"work_precision", measure_work_precision},
                           {"parameters", measure_parameters},
                           {"optimization", measure_optimization},
                           {"stops", measure_stops},
                           {"scaling", measure_scaling},
                           {"setup", measure_setup},
                           {"planar", measure_planar},
                           {"ensembles", measure_ensembles},
                           {"identification", measure_identification},
                           {"ranks", measure_ranks},
                           {"robots", measure_robots},
                           {"simbody", measure_simbody}};

constexpr const char* kUsage =
    "usage: benchmarks [--markdown] [PART...]\n"
    "Run it where urdf/ and config/ are. PART: kernels, steps, work_precision, parameters, "
    "optimization, stops, scaling, setup, "
    "planar, ensembles, identification, ranks, robots, simbody; all by default.\n";

Table summary(const std::vector<Finding>& findings) {
  Table table{"summary",
              "What the package sets out to reach, and what was measured",
              {"figure", "measured", "target", "reached"},
              {}};
  for (const Finding& f : findings) {
    const std::string unit = f.unit.empty() ? "" : " " + f.unit;
    const bool reached = f.at_least ? f.measured >= f.target : f.measured <= f.target;
    table.rows.push_back({f.what, three_digits(f.measured) + unit,
                          (f.at_least ? "at least " : "at most ") + three_digits(f.target) + unit,
                          reached ? "yes" : "no"});
  }
  return table;
}

/// The processor and the compiler.
Table machine() {
  Table table{"machine", "Machine", {"", ""}, {}};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    table.rows.push_back({"processor", line.substr(line.find(':') + 2)});
    break;
  }
  table.rows.push_back({"cores", std::to_string(std::thread::hardware_concurrency())});
  table.rows.push_back({"compiler", std::string("GCC ") + __VERSION__});
  table.rows.push_back({"options", CODESIGN_BENCHMARK_OPTIONS});
  return table;
}

int run(bool markdown, const std::set<std::string>& chosen) {
  Report report;
  const auto print = [markdown](const Table& table) {
    std::printf("%s\n", (markdown ? to_markdown(table) : to_text(table)).c_str());
    std::fflush(stdout);
  };
  print(machine());
  for (const Part& part : kParts) {
    if (!chosen.empty() && chosen.count(part.name) == 0) continue;
    const std::size_t first = report.tables.size();
    part.measure(&report);
    for (std::size_t k = first; k < report.tables.size(); ++k) print(report.tables[k]);
  }
  // Of some parts only, it would be no summary.
  if (chosen.empty()) print(summary(report.findings));
  return 0;
}

}  // namespace
}  // namespace codesign

int main(int argc, char** argv) {
  bool markdown = false;
  std::set<std::string> chosen, known;
  for (const codesign::Part& part : codesign::kParts) known.insert(part.name);
  const bool is_rank = argc == 3 && std::strcmp(argv[1], codesign::kRankProgram) == 0;
  for (int k = 1; k < argc && !is_rank; ++k) {
    if (std::strcmp(argv[k], "--markdown") == 0) {
      markdown = true;
    } else if (known.count(argv[k]) != 0) {
      chosen.insert(argv[k]);
    } else {
      std::fprintf(stderr, "%s", codesign::kUsage);
      return 2;
    }
  }
  try {
    if (is_rank) return codesign::run_rank_program(argv[2]);
    return codesign::run(markdown, chosen);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmarks: %s\n", error.what());
    return 1;
  }
}
