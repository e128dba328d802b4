// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <stdexcept>

#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "ensemble/ensemble.h"

namespace codesign {
namespace {

/// What one gradient of an ensemble takes, the least of several repetitions: other load on the
/// machine only adds to it.
struct Cost {
  double wall = std::numeric_limits<double>::infinity(), cpu = wall;  ///< [s]
};

double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void repeat(const Ensemble& ensemble, const Eigen::VectorXd& rho, Cost* cost) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = process_seconds();
  const EnsembleEvaluation evaluation = ensemble.evaluate(rho, true);
  if (!evaluation.total.status.ok()) throw std::runtime_error(evaluation.total.status.cause);
  cost->cpu = std::min(cost->cpu, process_seconds() - cpu);
  cost->wall = std::min(
      cost->wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

/// Memory that the program holds [bytes]; that of its main thread alone.
double bytes_held() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

void measure_threads(const Problem& problem, Report* report) {
  constexpr int kSamples = 32, kRepetitions = 15, kMost = 2;
  std::vector<Problem> problems;
  for (int threads = 1; threads <= kMost; ++threads)
    problems.push_back(with_uncertain_masses(
        problem, kSamples, "{type: threads, workers: " + std::to_string(threads) + "}"));
  const std::vector<Ensemble> ensembles(problems.begin(), problems.end());
  std::vector<Cost> costs(ensembles.size());
  for (int repetition = 0; repetition < kRepetitions; ++repetition)
    for (std::size_t k = 0; k < ensembles.size(); ++k)
      repeat(ensembles[k], problem.start(), &costs[k]);
  Table table{"ensemble_threads",
              "Gradient of the slider-crank's mean objective over 32 samples of two masses: the "
              "best of 15 repetitions in turn",
              {"threads", "ms", "processor time, ms", "speed-up", "efficiency"},
              {}};
  for (std::size_t k = 0; k < costs.size(); ++k) {
    const double speed_up = costs[0].wall / costs[k].wall, threads = static_cast<double>(k + 1);
    table.rows.push_back({std::to_string(k + 1), three_digits(1e3 * costs[k].wall),
                          three_digits(1e3 * costs[k].cpu), three_digits(speed_up),
                          three_digits(speed_up / threads)});
  }
  report->tables.push_back(table);
  report->findings.push_back({"efficiency of two threads at 32 samples", "",
                              costs[0].wall / (2.0 * costs[1].wall), 0.95, true});
}

void measure_samples(const Problem& problem, Report* report) {
  Table table{"ensemble_samples",
              "The same gradient over one sample and over a thousand, in one thread; memory beyond "
              "that of the loaded problem",
              {"samples", "ms", "ms per sample", "memory, kB", "kB per sample"},
              {}};
  for (const int samples : {1, 1000}) {
    const Problem sampled = with_uncertain_masses(problem, samples, "{type: serial}");
    const double before = bytes_held();
    const Ensemble ensemble(sampled);
    Cost cost;
    for (int repetition = 0; repetition < (samples == 1 ? 15 : 2); ++repetition)
      repeat(ensemble, problem.start(), &cost);
    const EnsembleEvaluation kept = ensemble.evaluate(problem.start(), true);
    const double kilobytes = 1e-3 * (bytes_held() - before);
    if (kept.values.size() != samples) throw std::runtime_error("not one objective per sample");
    table.rows.push_back({std::to_string(samples), three_digits(1e3 * cost.wall),
                          three_digits(1e3 * cost.wall / samples), three_digits(kilobytes),
                          three_digits(kilobytes / samples)});
  }
  report->tables.push_back(table);
}

}  // namespace

void measure_ensembles(Report* report) {
  const Problem problem = load_slider_crank();
  measure_threads(problem, report);
  measure_samples(problem, report);
  measure_lanes(report);
}

}  // namespace codesign
