// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "benchmark/constraint_kernels.h"
#include "benchmark/core_access.h"
#include "benchmark/derived_kernels.h"
#include "benchmark/dual.h"
#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "benchmark/timing.h"
#include "problem/load_problem.h"

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

  /// Evaluates Phi along the columns of the identity, as many at a time as T carries; calls
  /// take(column, row, derivative).
  template <class Take>
  void for_each_derivative(const std::vector<double>& at, const Take& take) {
    const int width = width_of(q.data()), columns = kernels.columns();
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = T(at[k]);
    for (int first = 0; first < columns; first += width) {
      const int count = std::min(width, columns - first);
      for (int lane = 0; lane < count; ++lane)
        derivative(&q[static_cast<std::size_t>(first + lane)], lane) = 1.0;
      kernels.values(q.data(), Phi.data());
      for (int lane = 0; lane < count; ++lane) {
        derivative(&q[static_cast<std::size_t>(first + lane)], lane) = 0.0;
        for (std::size_t row = 0; row < Phi.size(); ++row)
          take(first + lane, row, derivative(&Phi[row], lane));
      }
    }
  }

  ConstraintKernels<T> kernels;
  std::vector<T> q, v, Phi;
};

/// One state of the slider-crank on its way, and the four operations at it in five ways. All
/// results are lists of m, n or entries() numbers.
class KernelBench {
 public:
  KernelBench(const CompiledSystem& system, const State<double>& state)
      : by_hand_(system, constants(system)),
        wide_(system, constants(system)),
        dual_(system, constants(system)),
        n_(by_hand_.columns()),
        m_(by_hand_.rows()),
        entries_(by_hand_.entries()),
        derived_(derived_kernels(system, constants(system))) {
    q_.assign(state.q.data(), state.q.data() + n_);
    v_.assign(state.v.data(), state.v.data() + n_);
    lambda_.assign(state.z.data() + n_, state.z.data() + n_ + m_);
    out_.resize(entries_.size());
    moved_ = q_;
    upper_.resize(static_cast<std::size_t>(m_));
    lower_ = middle_ = upper_;
    jacobian_.resize(static_cast<std::size_t>(m_ * n_));
  }

  const std::vector<double>& out() const { return out_; }
  void clear_out() { std::fill(out_.begin(), out_.end(), 0.0); }

  void jacobian_by_hand() { by_hand_.jacobian(q_.data(), out_.data()); }
  void product_by_hand() { by_hand_.jacobian_times(q_.data(), v_.data(), out_.data()); }
  void transposed_by_hand() { by_hand_.transposed_times(q_.data(), lambda_.data(), out_.data()); }
  void curvature_by_hand() { by_hand_.curvature(q_.data(), v_.data(), out_.data()); }

  template <KernelOperation operation>
  void derived() {
    derived_[static_cast<std::size_t>(operation)].run(q_.data(), v_.data(), lambda_.data(),
                                                      out_.data());
  }

  template <class T>
  void jacobian_forward() {
    forward<T>().for_each_derivative(q_, [this](int column, std::size_t row, double value) {
      jacobian_[index(static_cast<int>(row), column)] = value;
    });
    gather();
  }
  template <class T>
  void transposed_forward() {
    std::fill(out_.begin(), out_.begin() + n_, 0.0);
    forward<T>().for_each_derivative(q_, [this](int column, std::size_t row, double value) {
      out_[static_cast<std::size_t>(column)] += lambda_[row] * value;
    });
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
      for (int row = 0; row < m_; ++row)
        sum += lambda_[static_cast<std::size_t>(row)] * difference(row);
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
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row * n_ + column);
  }
  double difference(int row) const {
    return (upper_[static_cast<std::size_t>(row)] - lower_[static_cast<std::size_t>(row)]) /
           (2.0 * kStep);
  }
  void gather() {
    for (std::size_t k = 0; k < entries_.size(); ++k)
      out_[k] = jacobian_[index(entries_[k].row, entries_[k].column)];
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
  std::vector<KernelProgram> derived_;
  std::vector<double> q_, v_, lambda_, out_, moved_, upper_, lower_, middle_, jacobian_;
};

struct Kernel {
  const char* name;
  double manual, automatic, symbolic;  ///< the paper's Table 1 [us]
  void (KernelBench::*by_hand)();
  void (KernelBench::*derived)();
  void (KernelBench::*wide)();
  void (KernelBench::*dual)();
  void (KernelBench::*differences)();
};

constexpr Kernel kKernels[] = {
    {"Phi_q", 22.0, 178.0, 1042.0, &KernelBench::jacobian_by_hand,
     &KernelBench::derived<KernelOperation::kJacobian>, &KernelBench::jacobian_forward<Wide>,
     &KernelBench::jacobian_forward<Dual>, &KernelBench::jacobian_by_differences},
    {"Phi_q v", 16.6, 152.0, 858.0, &KernelBench::product_by_hand,
     &KernelBench::derived<KernelOperation::kProduct>, nullptr, &KernelBench::product_forward,
     &KernelBench::product_by_differences},
    {"Phi_q^T lambda", 30.3, 178.0, 996.0, &KernelBench::transposed_by_hand,
     &KernelBench::derived<KernelOperation::kTransposedProduct>,
     &KernelBench::transposed_forward<Wide>, &KernelBench::transposed_forward<Dual>,
     &KernelBench::transposed_by_differences},
    {"(Phi_q v)_q v", 18.2, 159.0, 938.0, &KernelBench::curvature_by_hand,
     &KernelBench::derived<KernelOperation::kCurvature>, nullptr, &KernelBench::curvature_forward,
     &KernelBench::curvature_by_differences}};

/// What is fast must also be right.
void require_same(KernelBench* bench, const Kernel& kernel, void (KernelBench::*other)(),
                  double tolerance) {
  bench->clear_out();
  (bench->*kernel.by_hand)();
  const std::vector<double> expected = bench->out();
  bench->clear_out();
  (bench->*other)();
  for (std::size_t k = 0; k < expected.size(); ++k)
    if (!(std::abs(bench->out()[k] - expected[k]) <= tolerance * (1.0 + std::abs(expected[k]))))
      throw std::runtime_error(std::string("two ways to compute ") + kernel.name + " disagree");
}

Job kernel_job(const std::string& name, KernelBench* bench, void (KernelBench::*operation)()) {
  return make_job(name, [bench, operation] {
    (bench->*operation)();
    benchmark::DoNotOptimize(bench->out().data());
    benchmark::ClobberMemory();
  });
}

}  // namespace

void measure_kernels(Report* report) {
  const std::optional<Problem> problem = with_solver(load_slider_crank(), "rodas4", 1e-8);
  StepProbe probe(system_of(*problem), 0.3, 1e-3);
  KernelBench bench(*system_of(*problem), probe.state());
  std::vector<Job> jobs;
  for (const Kernel& kernel : kKernels) {
    const std::string name = kernel.name;
    jobs.push_back(kernel_job(name + ": by hand", &bench, kernel.by_hand));
    for (const auto& [way, operation, tolerance] :
         {std::make_tuple("derived", kernel.derived, 1e-12),
          std::make_tuple("lanes", kernel.wide, 1e-12), std::make_tuple("dual", kernel.dual, 1e-12),
          std::make_tuple("differences", kernel.differences, 1e-5)}) {
      if (!operation) continue;
      require_same(&bench, kernel, operation, tolerance);
      jobs.push_back(kernel_job(name + ": " + way, &bench, operation));
    }
  }
  const std::vector<double> seconds = median_cpu_seconds(jobs);
  Table table{
      "kernels",
      "Kernels of the slider-crank, microseconds",
      {"operation", "by hand", "derived", "8 lanes", "dual", "differences", "derived / by hand",
       "dual / by hand", "paper: manual", "automatic", "symbolic", "paper's manual / by hand"},
      {}};
  std::size_t next = 0;
  for (const Kernel& kernel : kKernels) {
    const double by_hand = 1e6 * seconds[next++], derived = 1e6 * seconds[next++],
                 wide = kernel.wide ? 1e6 * seconds[next++] : std::nan(""),
                 dual = 1e6 * seconds[next++], differences = 1e6 * seconds[next++];
    table.rows.push_back({kernel.name, three_digits(by_hand), three_digits(derived),
                          three_digits(wide), three_digits(dual), three_digits(differences),
                          three_digits(derived / by_hand), three_digits(dual / by_hand),
                          three_digits(kernel.manual), three_digits(kernel.automatic),
                          three_digits(kernel.symbolic), three_digits(kernel.manual / by_hand)});
    report->findings.push_back({std::string("kernel ") + kernel.name, "us", by_hand, 0.2, false});
  }
  report->tables.push_back(table);
  measure_kernel_programs(report);
}

}  // namespace codesign
