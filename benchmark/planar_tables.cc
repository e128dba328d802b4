// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "benchmark/timing.h"
#include "description/study.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// A run of a study with the method that it chooses.
class Run {
 public:
  explicit Run(const GeneratedCase& generated)
      : problem_(load_problem(generated.urdf, {}, generated.study)),
        simulation_(std::make_unique<Simulation>(problem_, problem_.parameters())) {
    run();
  }

  void run() {
    Status status = simulation_->start();
    if (status.ok()) status = simulation_->advance(study_of(problem_).duration);
    if (!status.ok()) throw std::runtime_error(status.cause);
  }
  std::string unknowns() const {
    const Layout& layout = system_of(problem_)->layout();
    return std::to_string(layout.n) + " + " + std::to_string(layout.m);
  }
  std::string steps() const { return std::to_string(simulation_->statistics().steps); }

 private:
  const Problem problem_;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace

void measure_planar(Report* report) {
  Table table{"planar",
              "Processor time of a run of 0.5 s of planar linkages, code already generated",
              {"linkage", "out of the plane", "coordinates + rows", "steps", "time [ms]", "ratio"},
              {}};
  const std::vector<PlanarCase> shared = planar_linkages(false), held = planar_linkages(true);
  for (std::size_t k = 0; k < shared.size(); ++k) {
    Run all(shared[k].texts), plane(held[k].texts);
    const std::vector<double> seconds = median_cpu_seconds(
        {make_job("shared", [&] { all.run(); }), make_job("zero", [&] { plane.run(); })}, 5);
    table.rows.push_back({shared[k].name, "shared", all.unknowns(), all.steps(),
                          three_digits(1e3 * seconds[0]), "1"});
    table.rows.push_back({"", "zero", plane.unknowns(), plane.steps(),
                          three_digits(1e3 * seconds[1]), three_digits(seconds[1] / seconds[0])});
  }
  report->tables.push_back(table);
}

}  // namespace codesign
