// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/constraint_kernels.h"

#include <gtest/gtest.h>

#include <complex>

#include "benchmark/derived_kernels.h"
#include "benchmark/mechanisms.h"
#include "equations/equations.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// Each kernel against the equations of motion, at a generic point that does not satisfy the
/// constraints.
class ConstraintKernelsTest : public testing::TestWithParam<std::string> {
 protected:
  ConstraintKernelsTest()
      : problem_(load()),
        constants_(evaluate_constants(robot_of(problem_), system_of(problem_)->topology(),
                                      problem_.parameters())),
        kernels_(*system_of(problem_), constants_),
        n_(kernels_.columns()),
        m_(kernels_.rows()),
        q_(n_),
        v_(n_),
        lambda_(m_),
        Phi_q_(m_, n_) {
    for (int k = 0; k < n_; ++k) q_[k] = std::sin(1.0 + 7.0 * k), v_[k] = std::cos(2.0 + 5.0 * k);
    for (int k = 0; k < m_; ++k) lambda_[k] = std::sin(3.0 + 11.0 * k);
    for (int k = 0; k < n_; ++k)
      Phi_q_.col(k) = errors<double>(q_, Eigen::VectorXd::Unit(n_, k)).second;
  }

  static Problem load() {
    if (GetParam() == "chain") return load(open_chain(3));
    if (GetParam() == "ladder") return load(ladder(2));
    if (GetParam() == "ring") return load(bricard_ring());
    const std::string source = source_dir();
    SourceText study = read_source(source + "/config/" + GetParam() + ".yaml");
    const std::string solver = "solver: {";
    study.text.replace(study.text.find(solver), solver.size(), solver + "coordinates: absolute, ");
    return load({read_source(source + "/urdf/" + GetParam() + ".urdf"), study});
  }
  static Problem load(const GeneratedCase& generated) {
    return load_problem(generated.urdf, {}, generated.study);
  }

  /// Phi and Phi_q v by the equations of motion.
  template <class T>
  std::pair<VectorX<T>, VectorX<T>> errors(const VectorX<T>& q, const VectorX<T>& v) const {
    Equations<T> equations(*system_of(problem_));
    const std::vector<double> parameters = problem_.parameters();
    equations.set_design(std::vector<T>(parameters.begin(), parameters.end()));
    VectorX<T> Phi, rate;
    State<T> state;
    state.resize(system_of(problem_)->layout());
    state.q = q;
    state.v = v;
    equations.constraint_errors(state, &Phi, &rate);
    return {Phi, rate};
  }
  template <class Vector>
  static void expect_near(const Vector& actual, const Vector& expected) {
    EXPECT_LT((actual - expected).cwiseAbs().maxCoeff(),
              1e-12 * (1.0 + expected.cwiseAbs().maxCoeff()));
  }

  Problem problem_;
  Constants<double> constants_;
  ConstraintKernels<double> kernels_;
  int n_, m_;
  Eigen::VectorXd q_, v_, lambda_;
  Eigen::MatrixXd Phi_q_;
};

TEST_P(ConstraintKernelsTest, Values) {
  Eigen::VectorXd Phi(m_);
  kernels_.values(q_.data(), Phi.data());
  expect_near(Phi, errors<double>(q_, v_).first);
}

TEST_P(ConstraintKernelsTest, Jacobian) {
  const auto entries = kernels_.entries();
  std::vector<double> values(entries.size());
  kernels_.jacobian(q_.data(), values.data());
  Eigen::MatrixXd Phi_q = Eigen::MatrixXd::Zero(m_, n_);
  for (std::size_t k = 0; k < entries.size(); ++k)
    Phi_q(entries[k].row, entries[k].column) += values[k];
  expect_near(Phi_q, Phi_q_);
}

TEST_P(ConstraintKernelsTest, JacobianTimesVelocity) {
  Eigen::VectorXd product(m_);
  kernels_.jacobian_times(q_.data(), v_.data(), product.data());
  expect_near<Eigen::VectorXd>(product, Phi_q_ * v_);
}

TEST_P(ConstraintKernelsTest, TransposedTimesMultipliers) {
  Eigen::VectorXd product(n_);
  kernels_.transposed_times(q_.data(), lambda_.data(), product.data());
  expect_near<Eigen::VectorXd>(product, Phi_q_.transpose() * lambda_);
}

TEST_P(ConstraintKernelsTest, Curvature) {
  constexpr double kStep = 1e-30;
  const VectorX<std::complex<double>> q = q_ + std::complex<double>(0.0, kStep) * v_, v = v_;
  Eigen::VectorXd product(m_);
  kernels_.curvature(q_.data(), v_.data(), product.data());
  expect_near<Eigen::VectorXd>(product, errors<std::complex<double>>(q, v).second.imag() / kStep);
}

TEST_P(ConstraintKernelsTest, ProgramsRecordedAndDerived) {
  const auto entries = static_cast<Eigen::Index>(kernels_.entries().size());
  std::vector<Eigen::VectorXd> expected = {Eigen::VectorXd(entries), Eigen::VectorXd(m_),
                                           Eigen::VectorXd(n_), Eigen::VectorXd(m_)};
  kernels_.jacobian(q_.data(), expected[0].data());
  kernels_.jacobian_times(q_.data(), v_.data(), expected[1].data());
  kernels_.transposed_times(q_.data(), lambda_.data(), expected[2].data());
  kernels_.curvature(q_.data(), v_.data(), expected[3].data());
  for (int k = 0; k < kKernelOperations; ++k)
    for (const auto make : {&KernelProgram::recorded, &KernelProgram::derived}) {
      Eigen::VectorXd results = Eigen::VectorXd::Zero(expected[static_cast<std::size_t>(k)].size());
      make(static_cast<KernelOperation>(k), *system_of(problem_), constants_)
          .run(q_.data(), v_.data(), lambda_.data(), results.data());
      expect_near(results, expected[static_cast<std::size_t>(k)]);
    }
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, ConstraintKernelsTest,
                         testing::Values("slider_crank_haug", "chain", "ladder", "ring"));

}  // namespace
}  // namespace codesign
