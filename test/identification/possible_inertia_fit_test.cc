// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Arms whose true inertias lie on the border of the possible ones: points, rods and plates. The
// reference is the semidefinite problem, solved here by a barrier in the inertial numbers.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>

#include "description/study.h"
#include "engine/thread_engine.h"
#include "identification/effort/effort_residuals.h"
#include "identification/fit/inertial_numbers.h"
#include "identification/identify.h"
#include "math/dense.h"
#include "mechanism/mass_properties.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr int kArmLinks = 3, kArmSamples = 400;
constexpr double kSampling = 0.05;

class RandomArm {
 public:
  /// @param more lines of the study
  explicit RandomArm(unsigned seed, const std::string& more = "")
      : random_(seed), problem_(make_problem(more)) {
    measure();
    fill_efforts();
  }
  const Problem& problem() const { return problem_; }
  StudyRecordings recordings() const { return {{recording_}, {}}; }

  /// Residuals of the start, and their derivatives by inertial numbers and friction.
  LinearNumbers linear(Eigen::MatrixXd* residuals) const {
    const FitVariables variables(study_of(problem_), &robot_of(problem_));
    const auto source = residuals_of(variables);
    Eigen::MatrixXd jacobian;
    EXPECT_TRUE(source->begin(variables.start()).ok());
    EXPECT_TRUE(source->evaluate(variables.start(), residuals, &jacobian).ok());
    return with_inertial_numbers(variables.names(), variables.start(), jacobian);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double normal() { return std::normal_distribution<double>()(random_); }

  Problem make_problem(const std::string& more) {
    std::ostringstream urdf, study;
    urdf << "<robot name=\"a\" xmlns:codesign=\"urn:t\"><link name=\"l0\"/>";
    study << "identify: {data: [{csv: none.csv}], filter: {cutoff: 0}}\nparameters: {";
    for (int k = 1; k <= kArmLinks; ++k) {
      const Eigen::Vector3d axis = Eigen::Vector3d(normal(), normal(), normal()).normalized();
      urdf << "<codesign:parameter name=\"b" << k << "\" value=\"1\" lower=\"0\" upper=\"50\"/>"
           << "<link name=\"l" << k
           << "\"><inertial codesign:inertia=\"free\"><origin xyz=\"0.1 0 0"
           << "\"/><mass value=\"3\"/><inertia ixx=\"0.03\" iyy=\"0.03\" izz=\"0.03\" ixy=\"0\" "
           << "ixz=\"0\" iyz=\"0\"/></inertial></link><joint name=\"q" << k
           << "\" type=\"continuous\"><parent link=\"l" << k - 1 << "\"/><child link=\"l" << k
           << "\"/><origin xyz=\"" << uniform(0.1, 0.4) << " " << uniform(-0.1, 0.1) << " "
           << uniform(-0.1, 0.1) << "\"/><axis xyz=\"" << axis.transpose()
           << "\"/><dynamics damping=\"1\" friction=\"0\" codesign:damping=\"${b" << k
           << "}\"/></joint>";
      study << "b" << k << ": {}, ";
      for (const char* number : kLogCholeskyNames) study << "l" << k << "_" << number << ": {}, ";
    }
    urdf << "</robot>";
    study << "}\n" << more;
    return load_problem({"arm.urdf", urdf.str()}, {}, {"study.yaml", study.str()});
  }

  void measure() {
    recording_.file = "none.csv";
    recording_.element = "identify.data[0]";
    for (int j = 0; j < kArmLinks; ++j) {
      JointSamples joint{"q" + std::to_string(j + 1), {}, {}, {}};
      std::array<double, 9> wave;
      for (std::size_t k = 0; k < 9; ++k) wave[k] = k < 3 ? uniform(0.2, 0.8) : uniform(0.5, 3.0);
      for (int n = 0; n < kArmSamples; ++n) {
        double position = 0.0, velocity = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          position += wave[k] * std::sin(wave[3 + k] * kSampling * n + wave[6 + k]);
          velocity += wave[k] * wave[3 + k] * std::cos(wave[3 + k] * kSampling * n + wave[6 + k]);
        }
        joint.position.push_back(position);
        joint.velocity.push_back(velocity);
        joint.effort.push_back(1.0);
      }
      recording_.joints.push_back(joint);
    }
    for (int n = 0; n < kArmSamples; ++n) {
      recording_.times.push_back(kSampling * n);
      recording_.places.push_back(static_cast<std::size_t>(n) + 2);
    }
  }

  std::unique_ptr<EffortResiduals> residuals_of(const FitVariables& variables) const {
    const FilterOptions& filter = study_of(problem_).identification->filter;
    Warnings warnings;
    return std::make_unique<EffortResiduals>(
        *system_of(problem_), variables, require_same_joints({recording_}),
        std::vector<MeasuredMotion>{measured_motion(recording_, filter, &warnings)}, filter, 1);
  }

  /// Points, rods or plates of 0.1 mm; one joint in three has no friction.
  Eigen::VectorXd truth(const FitVariables& variables) {
    Eigen::VectorXd x = variables.start();
    for (int l = 0; l < kArmLinks; ++l) {
      const int flat = 1 + static_cast<int>(uniform(0.0, 2.999));
      const auto damping = std::find(variables.names().begin(), variables.names().end(),
                                     "b" + std::to_string(l + 1));
      x[damping - variables.names().begin()] = l == 0 ? 0.0 : uniform(0.5, 2.0);
      for (const auto& [link, columns] : free_inertias(variables.names())) {
        if (link != "l" + std::to_string(l + 1)) continue;
        x[columns[0]] = 0.5 * std::log(uniform(1.0, 6.0));
        for (std::size_t k = 1; k < 10; ++k)
          x[columns[k]] = k <= 3 ? std::log(static_cast<int>(k) <= flat ? 1e-4 : uniform(0.05, 0.2))
                                 : uniform(-0.15, 0.15) * (k < 7 && flat == 3 ? 1e-3 : 1.0);
      }
    }
    return x;
  }

  void fill_efforts() {
    const FitVariables variables(study_of(problem_), &robot_of(problem_));
    const auto source = residuals_of(variables);
    Eigen::MatrixXd residuals;
    const Eigen::VectorXd x = truth(variables);
    ASSERT_TRUE(source->begin(x).ok());
    ASSERT_TRUE(source->evaluate(x, &residuals, nullptr).ok());
    const Eigen::Index first = (kArmSamples - residuals.rows()) / 2;
    for (int j = 0; j < kArmLinks; ++j) {
      const Eigen::VectorXd effort = residuals.col(j).array() + 1.0;
      const double noise = 0.02 * effort.norm() / std::sqrt(static_cast<double>(effort.size()));
      for (Eigen::Index n = 0; n < effort.size(); ++n)
        recording_.joints[static_cast<std::size_t>(j)].effort[static_cast<std::size_t>(first + n)] =
            effort[n] + noise * normal();
    }
  }

  std::mt19937 random_;
  Problem problem_;
  JointRecording recording_;
};

Eigen::Matrix4d pseudo_inertia(const Eigen::VectorXd& n) {
  const double half = 0.5 * (n[4] + n[5] + n[6]);
  Eigen::Matrix4d P;
  P << half - n[4], -n[7], -n[9], n[1], -n[7], half - n[5], -n[8], n[2], -n[9], -n[8], half - n[6],
      n[3], n[1], n[2], n[3], n[0];
  return P;
}

/// Minimizes |A u + b|^2 with possible inertias in columns `first` ... + 9 and all other numbers
/// above zero, by a barrier that falls to nothing.
class SemidefiniteReference {
 public:
  SemidefiniteReference(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, std::vector<int> firsts)
      : H_(2.0 * A.transpose() * A), g_(2.0 * A.transpose() * b), firsts_(std::move(firsts)) {
    H_.diagonal().array() += 1e-12 * H_.diagonal().maxCoeff();
    for (int k = 0; k < A.cols(); ++k)
      if (std::none_of(firsts_.begin(), firsts_.end(),
                       [k](int first) { return k >= first && k < first + 10; }))
        positive_.push_back(k);
  }

  Eigen::VectorXd solve(Eigen::VectorXd u) const {
    double mu = 1e3;
    for (int fall = 0; fall < 8; ++fall) {
      mu *= 0.1;
      for (int k = 0; k < 100; ++k) {
        Eigen::MatrixXd H = H_;
        Eigen::VectorXd slope = H_ * u + g_;
        add_barrier(u, mu, &H, &slope);
        const Eigen::VectorXd s = H.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::VectorXd p = -s.cwiseProduct(
            solve_positive_definite(s.asDiagonal() * H * s.asDiagonal(), s.cwiseProduct(slope)));
        if (-slope.dot(p) < 1e-8 * mu) break;
        double t = 1.0;
        const double here = value(u, mu);
        while (t > 1e-12 && !(value(u + t * p, mu) < here + 1e-4 * t * slope.dot(p))) t *= 0.5;
        if (t <= 1e-12) break;
        u += t * p;
      }
    }
    return u;
  }

 private:
  double value(const Eigen::VectorXd& u, double mu) const {
    double sum = 0.5 * u.dot(H_ * u) + g_.dot(u);
    for (const int first : firsts_) {
      const Eigen::VectorXd eigenvalues =
          symmetric_eigen(pseudo_inertia(u.segment(first, 10))).values;
      if (!(eigenvalues[0] > 0.0)) return std::numeric_limits<double>::infinity();
      sum -= mu * eigenvalues.array().log().sum();
    }
    for (const int k : positive_) {
      if (!(u[k] > 0.0)) return std::numeric_limits<double>::infinity();
      sum -= mu * std::log(u[k]);
    }
    return sum;
  }

  void add_barrier(const Eigen::VectorXd& u, double mu, Eigen::MatrixXd* H,
                   Eigen::VectorXd* slope) const {
    for (const int first : firsts_) {
      const Eigen::Matrix4d inverse = pseudo_inertia(u.segment(first, 10)).inverse();
      std::array<Eigen::Matrix4d, 10> products;
      for (int k = 0; k < 10; ++k)
        products[static_cast<std::size_t>(k)] =
            inverse * pseudo_inertia(Eigen::VectorXd::Unit(10, k));
      for (int i = 0; i < 10; ++i) {
        const Eigen::Matrix4d& one = products[static_cast<std::size_t>(i)];
        (*slope)[first + i] -= mu * one.trace();
        for (int k = 0; k < 10; ++k)
          (*H)(first + i, first + k) +=
              mu * one.transpose().cwiseProduct(products[static_cast<std::size_t>(k)]).sum();
      }
    }
    for (const int k : positive_) {
      (*slope)[k] -= mu / u[k];
      (*H)(k, k) += mu / (u[k] * u[k]);
    }
  }

  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
  std::vector<int> firsts_, positive_;
};

/// The least sum of squares of the residuals, each joint's divided by its spread.
double least_cost(const RandomArm& arm, const std::vector<OutputFit>& spreads) {
  Eigen::MatrixXd residuals;
  const LinearNumbers numbers = arm.linear(&residuals);
  Eigen::MatrixXd A = numbers.jacobian;
  Eigen::VectorXd b = residuals.reshaped();
  for (Eigen::Index j = 0; j < residuals.cols(); ++j) {
    const double spread = spreads[static_cast<std::size_t>(j)].rms;
    A.middleRows(j * residuals.rows(), residuals.rows()) /= spread;
    b.segment(j * residuals.rows(), residuals.rows()) /= spread;
  }
  std::vector<int> firsts;
  for (std::size_t k = 0; k < numbers.names.size(); ++k)
    if (numbers.names[k].size() == 4 && numbers.names[k].substr(2) == "_m")
      firsts.push_back(static_cast<int>(k));
  b -= A * numbers.x;
  return (A * SemidefiniteReference(A, b, firsts).solve(numbers.x) + b).squaredNorm();
}

TEST(PossibleInertiaFit, ReachesTheSemidefiniteOptimumOnTheBorder) {
  side_by_side(20, 2, [](std::size_t run) {
    const auto seed = static_cast<unsigned>(run) + 1;
    const RandomArm arm(seed);
    const IdentificationResult result = identify(arm.problem(), arm.recordings(), {}, nullptr);
    ASSERT_EQ(result.data.size(), static_cast<std::size_t>(kArmLinks)) << result.status.cause;
    EXPECT_LE(result.evaluations, 12) << seed;
    EXPECT_TRUE(result.termination == "success" ||
                result.termination == "objective_tolerance_reached")
        << result.termination;
    const double found = static_cast<double>(result.samples * kArmLinks),
                 least = least_cost(arm, result.data);
    EXPECT_LE(found, 1.001 * least) << seed << ": " << found / least - 1.0;
    EXPECT_GE(found, (1.0 - 1e-6) * least) << "the reference is no reference";
  });
}

TEST(PossibleInertiaFit, EndsEarlierWithALargerTolerance) {
  const RandomArm tight(3, "optimizer: {relative_tolerance: 1.0e-8}\n"),
      loose(3, "optimizer: {relative_tolerance: 0.5}\n");
  const IdentificationResult fine = identify(tight.problem(), tight.recordings(), {}, nullptr),
                             coarse = identify(loose.problem(), loose.recordings(), {}, nullptr);
  EXPECT_LT(coarse.evaluations, fine.evaluations);
  EXPECT_LE(least_cost(tight, fine.data) * (1.0 - 1e-6),
            static_cast<double>(fine.samples * kArmLinks));
}

}  // namespace
}  // namespace codesign
