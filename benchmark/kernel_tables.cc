// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "benchmark/constraint_kernels.h"
#include "benchmark/core_access.h"
#include "benchmark/derived_kernels.h"
#include "benchmark/dual.h"
#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "benchmark/robots.h"
#include "benchmark/slider_crank.h"
#include "benchmark/timing.h"

namespace codesign {
namespace {

constexpr int kWidth = 8;
using Wide = Lanes<kWidth>;

int width_of(const Dual*) { return 1; }
int width_of(const Wide*) { return kWidth; }
double& derivative(Dual* x, int) { return x->d; }
double& derivative(Wide* x, int lane) { return x->v[lane]; }

/// Phi with numbers that carry derivatives, and the memory for it.
template <class T>
struct ForwardMode {
  ForwardMode(const CompiledSystem& system, const Constants<double>& constants)
      : kernels(system, constants),
        q(static_cast<std::size_t>(kernels.columns())),
        v(q.size()),
        Phi(static_cast<std::size_t>(kernels.rows())) {}

  /// Evaluates Phi along the columns of the identity, as many at a time as T carries; calls take(column, row, derivative).
  template <class Take>
  void for_each_derivative(const std::vector<double>& at, const Take& take) {
    const int width = width_of(q.data()), columns = kernels.columns();
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = T(at[k]);
    for (int first = 0; first < columns; first += width) {
      const int count = std::min(width, columns - first);
      for (int lane = 0; lane < count; ++lane) derivative(&q[static_cast<std::size_t>(first + lane)], lane) = 1.0;
      kernels.values(q.data(), Phi.data());
      for (int lane = 0; lane < count; ++lane) {
        derivative(&q[static_cast<std::size_t>(first + lane)], lane) = 0.0;
        for (std::size_t row = 0; row < Phi.size(); ++row) take(first + lane, row, derivative(&Phi[row], lane));
      }
    }
  }

  ConstraintKernels<T> kernels;
  std::vector<T> q, v, Phi;
};

/// Where kernels are evaluated.
struct KernelPoint {
  std::vector<double> q, v, lambda;
};

/// The four operations at one point, in all ways. All results are lists of m, n or entries() numbers.
class KernelBench {
 public:
  KernelBench(const CompiledSystem& system, KernelPoint at)
      : by_hand_(system, constants(system)),
        wide_(system, constants(system)),
        dual_(system, constants(system)),
        n_(by_hand_.columns()),
        m_(by_hand_.rows()),
        entries_(by_hand_.entries()),
        q_(std::move(at.q)),
        v_(std::move(at.v)),
        lambda_(std::move(at.lambda)),
        out_(entries_.size()),
        moved_(q_),
        upper_(static_cast<std::size_t>(m_)),
        lower_(upper_),
        middle_(upper_),
        jacobian_(static_cast<std::size_t>(m_ * n_)) {
    for (int k = 0; k < kKernelOperations; ++k) {
      recorded_.push_back(KernelProgram::recorded(static_cast<KernelOperation>(k), system, constants(system)));
      derived_.push_back(KernelProgram::derived(static_cast<KernelOperation>(k), system, constants(system)));
    }
  }

  int rows() const { return m_; }
  int columns() const { return n_; }
  const std::vector<double>& out() const { return out_; }
  void clear_out() { std::fill(out_.begin(), out_.end(), 0.0); }
  int instructions_recorded(KernelOperation operation) const { return recorded_[static_cast<std::size_t>(operation)].instructions(); }
  int instructions_derived(KernelOperation operation) const { return derived_[static_cast<std::size_t>(operation)].instructions(); }

  void jacobian_by_hand() { by_hand_.jacobian(q_.data(), out_.data()); }
  void product_by_hand() { by_hand_.jacobian_times(q_.data(), v_.data(), out_.data()); }
  void transposed_by_hand() { by_hand_.transposed_times(q_.data(), lambda_.data(), out_.data()); }
  void curvature_by_hand() { by_hand_.curvature(q_.data(), v_.data(), out_.data()); }

  template <KernelOperation operation>
  void recorded() {
    recorded_[static_cast<std::size_t>(operation)].run(q_.data(), v_.data(), lambda_.data(), out_.data());
  }
  template <KernelOperation operation>
  void derived() {
    derived_[static_cast<std::size_t>(operation)].run(q_.data(), v_.data(), lambda_.data(), out_.data());
  }

  template <class T>
  void jacobian_forward() {
    forward<T>().for_each_derivative(
        q_, [this](int column, std::size_t row, double value) { jacobian_[index(static_cast<int>(row), column)] = value; });
    gather();
  }
  template <class T>
  void transposed_forward() {
    std::fill(out_.begin(), out_.begin() + n_, 0.0);
    forward<T>().for_each_derivative(
        q_, [this](int column, std::size_t row, double value) { out_[static_cast<std::size_t>(column)] += lambda_[row] * value; });
  }
  void product_forward() {
    seed_along_v();
    dual_.kernels.values(dual_.q.data(), dual_.Phi.data());
    for (std::size_t row = 0; row < dual_.Phi.size(); ++row) out_[row] = dual_.Phi[row].d;
  }
  void curvature_forward() {
    seed_along_v();
    for (std::size_t k = 0; k < v_.size(); ++k) dual_.v[k] = Dual(v_[k]);
    dual_.kernels.jacobian_times(dual_.q.data(), dual_.v.data(), dual_.Phi.data());
    for (std::size_t row = 0; row < dual_.Phi.size(); ++row) out_[row] = dual_.Phi[row].d;
  }

  void jacobian_by_differences() {
    for_each_difference([this](int column) {
      for (int row = 0; row < m_; ++row) jacobian_[index(row, column)] = difference(row);
    });
    gather();
  }
  void transposed_by_differences() {
    for_each_difference([this](int column) {
      double sum = 0.0;
      for (int row = 0; row < m_; ++row) sum += lambda_[static_cast<std::size_t>(row)] * difference(row);
      out_[static_cast<std::size_t>(column)] = sum;
    });
  }
  void product_by_differences() {
    along_v(kStep, &upper_);
    along_v(-kStep, &lower_);
    for (int row = 0; row < m_; ++row) out_[static_cast<std::size_t>(row)] = difference(row);
  }
  void curvature_by_differences() {
    along_v(kLongStep, &upper_);
    along_v(-kLongStep, &lower_);
    along_v(0.0, &middle_);
    for (std::size_t row = 0; row < middle_.size(); ++row)
      out_[row] = (upper_[row] - 2.0 * middle_[row] + lower_[row]) / (kLongStep * kLongStep);
  }

 private:
  static constexpr double kStep = 1e-6, kLongStep = 1e-4;

  static Constants<double> constants(const CompiledSystem& system) {
    return evaluate_constants(system.robot(), system.topology(), system.parameters());
  }
  std::size_t index(int row, int column) const { return static_cast<std::size_t>(row * n_ + column); }
  double difference(int row) const {
    return (upper_[static_cast<std::size_t>(row)] - lower_[static_cast<std::size_t>(row)]) / (2.0 * kStep);
  }
  void gather() {
    for (std::size_t k = 0; k < entries_.size(); ++k) out_[k] = jacobian_[index(entries_[k].row, entries_[k].column)];
  }

  template <class T>
  ForwardMode<T>& forward() {
    if constexpr (std::is_same_v<T, Dual>)
      return dual_;
    else
      return wide_;
  }
  void seed_along_v() {
    for (std::size_t k = 0; k < q_.size(); ++k) dual_.q[k] = Dual(q_[k], v_[k]);
  }
  template <class Take>
  void for_each_difference(const Take& take) {
    for (std::size_t column = 0; column < q_.size(); ++column) {
      moved_[column] = q_[column] + kStep;
      by_hand_.values(moved_.data(), upper_.data());
      moved_[column] = q_[column] - kStep;
      by_hand_.values(moved_.data(), lower_.data());
      moved_[column] = q_[column];
      take(static_cast<int>(column));
    }
  }
  void along_v(double step, std::vector<double>* Phi) {
    for (std::size_t k = 0; k < q_.size(); ++k) moved_[k] = q_[k] + step * v_[k];
    by_hand_.values(moved_.data(), Phi->data());
    moved_ = q_;
  }

  ConstraintKernels<double> by_hand_;
  ForwardMode<Wide> wide_;
  ForwardMode<Dual> dual_;
  int n_, m_;
  std::vector<ConstraintKernels<double>::Entry> entries_;
  std::vector<double> q_, v_, lambda_, out_, moved_, upper_, lower_, middle_, jacobian_;
  std::vector<KernelProgram> recorded_, derived_;
};

using KernelFunction = void (KernelBench::*)();

struct Kernel {
  const char* name;
  KernelOperation operation;
  double manual, automatic, symbolic;  ///< the paper's Table 1 [us]
  KernelFunction by_hand, recorded, derived, wide, dual, differences;
};

constexpr Kernel kKernels[kKernelOperations] = {
    {"Phi_q", KernelOperation::kJacobian, 22.0, 178.0, 1042.0, &KernelBench::jacobian_by_hand,
     &KernelBench::recorded<KernelOperation::kJacobian>, &KernelBench::derived<KernelOperation::kJacobian>,
     &KernelBench::jacobian_forward<Wide>, &KernelBench::jacobian_forward<Dual>, &KernelBench::jacobian_by_differences},
    {"Phi_q v", KernelOperation::kProduct, 16.6, 152.0, 858.0, &KernelBench::product_by_hand,
     &KernelBench::recorded<KernelOperation::kProduct>, &KernelBench::derived<KernelOperation::kProduct>, nullptr,
     &KernelBench::product_forward, &KernelBench::product_by_differences},
    {"Phi_q^T lambda", KernelOperation::kTransposedProduct, 30.3, 178.0, 996.0, &KernelBench::transposed_by_hand,
     &KernelBench::recorded<KernelOperation::kTransposedProduct>, &KernelBench::derived<KernelOperation::kTransposedProduct>,
     &KernelBench::transposed_forward<Wide>, &KernelBench::transposed_forward<Dual>, &KernelBench::transposed_by_differences},
    {"(Phi_q v)_q v", KernelOperation::kCurvature, 18.2, 159.0, 938.0, &KernelBench::curvature_by_hand,
     &KernelBench::recorded<KernelOperation::kCurvature>, &KernelBench::derived<KernelOperation::kCurvature>, nullptr,
     &KernelBench::curvature_forward, &KernelBench::curvature_by_differences}};

/// A way to compute all kernels, and how near it must come to by hand.
struct Way {
  const char* name;
  KernelFunction Kernel::*function;
  double tolerance;
};

/// What is fast must also be right.
void require_same(KernelBench* bench, const Kernel& kernel, const Way& way) {
  bench->clear_out();
  (bench->*kernel.by_hand)();
  const std::vector<double> expected = bench->out();
  bench->clear_out();
  (bench->*(kernel.*way.function))();
  for (std::size_t k = 0; k < expected.size(); ++k)
    if (!(std::abs(bench->out()[k] - expected[k]) <= way.tolerance * (1.0 + std::abs(expected[k]))))
      throw std::runtime_error(std::string("by hand and ") + way.name + ", " + kernel.name + " differs");
}

/// Microseconds per kernel and way; NaN where a kernel is not computed in this way.
std::vector<std::vector<double>> time_kernels(const std::vector<Way>& ways, KernelBench* bench) {
  std::vector<Job> jobs;
  for (const Kernel& kernel : kKernels)
    for (const Way& way : ways) {
      const KernelFunction function = kernel.*way.function;
      if (!function) continue;
      require_same(bench, kernel, way);
      jobs.push_back(make_job(std::string(kernel.name) + ": " + way.name, [bench, function] {
        (bench->*function)();
        benchmark::DoNotOptimize(bench->out().data());
        benchmark::ClobberMemory();
      }));
    }
  const std::vector<double> seconds = median_cpu_seconds(jobs);
  std::vector<std::vector<double>> times;
  std::size_t next = 0;
  for (const Kernel& kernel : kKernels) {
    times.emplace_back();
    for (const Way& way : ways) times.back().push_back(kernel.*way.function ? 1e6 * seconds[next++] : std::nan(""));
  }
  return times;
}

void compare_ways(Report* report) {
  const std::optional<Problem> problem = with_solver(load_slider_crank(), "rodas4", 1e-8);
  StepProbe probe(problem->system(), 0.3, 1e-3);
  const Layout& layout = problem->system()->layout();
  const State<double>& state = probe.state();
  const double* const z = state.z.data();
  KernelBench bench(
      *problem->system(),
      {{state.q.data(), state.q.data() + layout.n}, {state.v.data(), state.v.data() + layout.n}, {z + layout.n, z + layout.n + layout.m}});
  const std::vector<std::vector<double>> times = time_kernels({{"by hand", &Kernel::by_hand, 0.0},
                                                               {"derived", &Kernel::derived, 1e-12},
                                                               {"lanes", &Kernel::wide, 1e-12},
                                                               {"dual", &Kernel::dual, 1e-12},
                                                               {"differences", &Kernel::differences, 1e-5}},
                                                              &bench);
  Table table{"kernels",
              "Kernels of the slider-crank, microseconds",
              {"operation", "by hand", "derived", "8 lanes", "dual", "differences", "derived / by hand", "dual / by hand", "paper: manual",
               "automatic", "symbolic", "paper's manual / by hand"},
              {}};
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Kernel& kernel = kKernels[k];
    const double by_hand = times[k][0], derived = times[k][1], dual = times[k][3];
    std::vector<std::string> row{kernel.name};
    for (double time : times[k]) row.push_back(three_digits(time));
    for (double figure : {derived / by_hand, dual / by_hand, kernel.manual, kernel.automatic, kernel.symbolic, kernel.manual / by_hand})
      row.push_back(three_digits(figure));
    table.rows.push_back(row);
    report->findings.push_back({std::string("kernel ") + kernel.name, "us", by_hand, 0.2, false});
  }
  report->tables.push_back(table);
}

/// Some numbers that satisfy no constraint: the operations are the same everywhere.
KernelPoint generic_point(const Layout& layout) {
  KernelPoint at;
  for (int k = 0; k < layout.n; ++k) at.q.push_back(std::sin(1.0 + 7.0 * k)), at.v.push_back(std::cos(2.0 + 5.0 * k));
  for (int k = 0; k < layout.m; ++k) at.lambda.push_back(std::sin(3.0 + 11.0 * k));
  return at;
}

/// What it costs that nobody writes derivatives by hand: lengths and times of the programs.
void compare_programs(Report* report) {
  Table table{"kernel_counts",
              "Programs of the kernels: instructions and microseconds",
              {"constraints", "operation", "instructions: by hand", "derived", "derived / by hand", "us: by hand, compiled",
               "by hand, recorded", "derived", "derived / recorded"},
              {}};
  const auto add = [&table](const std::string& name, const Problem& problem) {
    const CompiledSystem& system = *problem.system();
    KernelBench bench(system, generic_point(system.layout()));
    const std::vector<std::vector<double>> times = time_kernels(
        {{"by hand", &Kernel::by_hand, 0.0}, {"recorded", &Kernel::recorded, 1e-12}, {"derived", &Kernel::derived, 1e-12}}, &bench);
    const std::string size = ", " + std::to_string(bench.rows()) + " of " + std::to_string(bench.columns());
    for (std::size_t k = 0; k < times.size(); ++k) {
      const int recorded = bench.instructions_recorded(kKernels[k].operation), derived = bench.instructions_derived(kKernels[k].operation);
      table.rows.push_back({name + size, kKernels[k].name, std::to_string(recorded), std::to_string(derived),
                            three_digits(static_cast<double>(derived) / recorded), three_digits(times[k][0]), three_digits(times[k][1]),
                            three_digits(times[k][2]), three_digits(times[k][2] / times[k][1])});
    }
  };
  const auto generated = [](const GeneratedCase& given) { return load_problem(given.urdf, {}, given.study); };
  add("slider_crank_haug", *with_solver(load_slider_crank(), "rodas4", 1e-8));
  add("Bricard's ring", generated(bricard_ring()));
  add("UR5", generated(robot_case(ur5(), "coordinates: absolute")));
  report->tables.push_back(table);
}

}  // namespace

void measure_kernels(Report* report) {
  compare_ways(report);
  compare_programs(report);
}

}  // namespace codesign
