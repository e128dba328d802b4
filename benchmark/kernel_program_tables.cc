// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "benchmark/constraint_kernels.h"
#include "benchmark/derived_kernels.h"
#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "benchmark/robots.h"
#include "benchmark/slider_crank.h"
#include "benchmark/timing.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr const char* kNames[kKernelOperations] = {"Phi_q", "Phi_q v", "Phi_q^T lambda",
                                                   "(Phi_q v)_q v"};

/// One operation on the constraints of one mechanism: compiled as it was written by hand, the same
/// as a program, and the derived program.
class ProgramBench {
 public:
  ProgramBench(KernelOperation operation, const CompiledSystem& system,
               const Constants<double>& constants)
      : operation_(operation),
        kernels_(system, constants),
        recorded_(KernelProgram::recorded(operation, system, constants)),
        derived_(KernelProgram::derived(operation, system, constants)),
        out_(kernels_.entries().size()) {
    // Some numbers that satisfy no constraint: the operations are the same everywhere.
    for (int k = 0; k < kernels_.columns(); ++k)
      q_.push_back(std::sin(1.0 + 7.0 * k)), v_.push_back(std::cos(2.0 + 5.0 * k));
    for (int k = 0; k < kernels_.rows(); ++k) lambda_.push_back(std::sin(3.0 + 11.0 * k));
    run_by_hand();
    const std::vector<double> expected = out_;
    for (KernelProgram* program : {&recorded_, &derived_}) {
      std::fill(out_.begin(), out_.end(), 0.0);
      run(program);
      for (std::size_t k = 0; k < out_.size(); ++k)
        if (!(std::abs(out_[k] - expected[k]) <= 1e-12 * (1.0 + std::abs(expected[k]))))
          throw std::runtime_error(std::string("a program of ") +
                                   kNames[static_cast<std::size_t>(operation)] + " is wrong");
    }
  }

  /// The cells from the name of the operation on.
  std::vector<std::string> row() {
    // Many repetitions: the programs differ by less than other load changes a short measurement.
    const std::vector<double> seconds = median_cpu_seconds(
        {job("compiled", [this] { run_by_hand(); }), job("recorded", [this] { run(&recorded_); }),
         job("derived", [this] { run(&derived_); })},
        31);
    const int by_hand = recorded_.instructions(), derived = derived_.instructions();
    std::vector<std::string> cells{kNames[static_cast<std::size_t>(operation_)],
                                   std::to_string(by_hand), std::to_string(derived),
                                   three_digits(static_cast<double>(derived) / by_hand)};
    for (double time : seconds) cells.push_back(three_digits(1e6 * time));
    cells.push_back(three_digits(seconds[2] / seconds[1]));
    return cells;
  }

 private:
  void run_by_hand() {
    switch (operation_) {
      case KernelOperation::kJacobian:
        return kernels_.jacobian(q_.data(), out_.data());
      case KernelOperation::kProduct:
        return kernels_.jacobian_times(q_.data(), v_.data(), out_.data());
      case KernelOperation::kTransposedProduct:
        return kernels_.transposed_times(q_.data(), lambda_.data(), out_.data());
      case KernelOperation::kCurvature:
        return kernels_.curvature(q_.data(), v_.data(), out_.data());
    }
  }
  void run(KernelProgram* program) {
    program->run(q_.data(), v_.data(), lambda_.data(), out_.data());
  }

  template <class Function>
  Job job(const char* name, const Function& function) {
    return make_job(name, [this, function] {
      function();
      benchmark::DoNotOptimize(out_.data());
      benchmark::ClobberMemory();
    });
  }

  KernelOperation operation_;
  ConstraintKernels<double> kernels_;
  KernelProgram recorded_, derived_;
  std::vector<double> q_, v_, lambda_, out_;
};

}  // namespace

void measure_kernel_programs(Report* report) {
  Table table{"kernel_programs",
              "Programs of the kernels",
              {"constraints", "operation", "instructions: by hand", "derived", "derived / by hand",
               "us: by hand, compiled", "by hand, recorded", "derived", "derived / recorded"},
              {}};
  const auto add = [&table](const std::string& name, const Problem& problem) {
    const CompiledSystem& system = *system_of(problem);
    const Constants<double> constants =
        evaluate_constants(system.robot(), system.topology(), system.parameters());
    const std::string size =
        ", " + std::to_string(system.layout().m) + " of " + std::to_string(system.layout().n);
    for (int k = 0; k < kKernelOperations; ++k) {
      table.rows.push_back({name + size});
      for (const std::string& cell :
           ProgramBench(static_cast<KernelOperation>(k), system, constants).row())
        table.rows.back().push_back(cell);
    }
  };
  const auto generated = [](const GeneratedCase& given) {
    return load_problem(given.urdf, {}, given.study);
  };
  add("slider_crank_haug", *with_solver(load_slider_crank(), "rodas4", 1e-8));
  add("Bricard's ring", generated(bricard_ring()));
  add("UR5", generated(robot_case(ur5(), "coordinates: absolute")));
  report->tables.push_back(table);
}

}  // namespace codesign
