// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace codesign {

/// Something to be timed, under a name that is unique within one call of median_cpu_seconds().
struct Job {
  std::string name;
  std::function<void(benchmark::State&)> body;
};

/// A job that calls `function()` repeatedly. `prepare()` is called before each repetition and is
/// not timed.
template <class Function, class Prepare>
Job make_job(std::string name, Function function, Prepare prepare) {
  return {std::move(name), [function, prepare](benchmark::State& state) mutable {
            prepare();
            for (auto _ : state) function();
          }};
}
template <class Function>
Job make_job(std::string name, Function function) {
  return make_job(std::move(name), std::move(function), [] {});
}

/// Processor time of one call of each job [s], the median of its repetitions. The repetitions of
/// all jobs are run in random order, so that other load on the machine affects all jobs alike. Each
/// repetition calls its job for at least `shortest` seconds.
std::vector<double> median_cpu_seconds(const std::vector<Job>& jobs, int repetitions = 7,
                                       double shortest = 0.02);

}  // namespace codesign
