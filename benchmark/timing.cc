// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/timing.h"

#include <algorithm>
#include <map>

namespace codesign {
namespace {

/// Keeps what Google Benchmark measures instead of printing it.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration)
        seconds_[run.run_name.function_name].push_back(run.cpu_accumulated_time /
                                                       static_cast<double>(run.iterations));
  }

  double median(const std::string& name) {
    std::vector<double>& all = seconds_.at(name);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  }

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

void initialize() {
  static std::string program = "benchmarks",
                     interleaving = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {program.data(), interleaving.data()};
  int count = 2;
  benchmark::Initialize(&count, arguments);
}

}  // namespace

std::vector<double> median_cpu_seconds(const std::vector<Job>& jobs, int repetitions,
                                       double shortest) {
  static const bool initialized = (initialize(), true);
  (void)initialized;
  for (const Job& job : jobs)
    benchmark::RegisterBenchmark(job.name.c_str(), job.body)
        ->Repetitions(repetitions)
        ->MinTime(shortest);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, ".");
  benchmark::ClearRegisteredBenchmarks();
  std::vector<double> medians;
  for (const Job& job : jobs) medians.push_back(collector.median(job.name));
  return medians;
}

}  // namespace codesign
