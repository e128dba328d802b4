// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/count_equations.h"

#include <algorithm>
#include <random>

#include "assembly/assembly.h"
#include "assembly/redundancy.h"
#include "description/study.h"
#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

// Smaller singular values, relative to the largest, count as zero.
constexpr double kRankOfLoops = 1e-9;
// Forms below this times the largest count as zero: the error of the differences.
constexpr double kNothing = 1e-7;
constexpr double kStep = 1e-4;  // of central differences [rad or m]
constexpr int kStarts = 16;     // random starts of the search for branches; fewer within a branch

using Forms = std::vector<Eigen::MatrixXd>;

double size_of(const Forms& forms) {
  double size = 0.0;
  for (const Eigen::MatrixXd& form : forms)
    size = std::max(size, form.size() > 0 ? form.cwiseAbs().maxCoeff() : 0.0);
  return size;
}

/// The rows 2 y^T H_k.
Eigen::MatrixXd gradients(const Forms& forms, const Eigen::VectorXd& y) {
  Eigen::MatrixXd rows(to_signed(forms.size()), y.size());
  for (std::size_t k = 0; k < forms.size(); ++k)
    rows.row(to_signed(k)) = 2.0 * (forms[k] * y).transpose();
  return rows;
}

/// A unit vector that solves all equations, by the Gauss-Newton method from `y`; empty if it does
/// not converge.
Eigen::VectorXd root_from(const Forms& forms, Eigen::VectorXd y) {
  y.normalize();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Eigen::MatrixXd rows = gradients(forms, y);
    const Eigen::VectorXd values = 0.5 * (rows * y);
    if (values.cwiseAbs().maxCoeff() < 1e-14) return y;
    y -= least_norm(rows).solve(values);
    if (!(y.norm() > 1e-3)) return {};
    y.normalize();
  }
  return (0.5 * (gradients(forms, y) * y)).cwiseAbs().maxCoeff() < kNothing ? y : Eigen::VectorXd();
}

/// Orthonormal basis of the vectors in the null space of `rows` that are normal to `y`.
Eigen::MatrixXd tangents_beside(const Eigen::MatrixXd& rows, const Eigen::VectorXd& y,
                                double threshold) {
  Eigen::MatrixXd stacked(rows.rows() + 1, rows.cols());
  stacked << rows, y.transpose();
  const SingularValues svd = singular_values(stacked, SingularVectors::kRight);
  const Eigen::Index rank = (svd.values.array() > threshold).count();
  return svd.V.rightCols(rows.cols() - rank);
}

int dimension(const Forms& forms, Eigen::Index size, int starts);

/// Dimension of the solutions near the root y: one for its own direction, plus the dimension of the
/// solutions, among the tangents normal to y, of the equations whose gradients vanish at y.
int dimension_at(const Forms& forms, const Eigen::VectorXd& y, int starts) {
  constexpr double kVanishes = 1e-5;  // a double root is found to the square root of rounding
  const Eigen::MatrixXd rows = gradients(forms, y);
  const Eigen::MatrixXd tangents = tangents_beside(rows, y, kVanishes);
  const SingularValues svd = singular_values(rows, SingularVectors::kLeft);
  const Eigen::Index rank = (svd.values.array() > kVanishes).count();
  Forms left;
  for (Eigen::Index c = rank; c < rows.rows(); ++c) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(y.size(), y.size());
    for (std::size_t k = 0; k < forms.size(); ++k) sum += svd.U(to_signed(k), c) * forms[k];
    left.push_back(product(transposed_product(tangents, sum), tangents));
  }
  return 1 + dimension(left, tangents.cols(), std::max(4, starts / 4));
}

int dimension(const Forms& forms, Eigen::Index size, int starts) {
  if (size == 0 || size_of(forms) < 1e-4) return static_cast<int>(size);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int largest = 0;
  for (int start = 0; start < starts; ++start) {
    const Eigen::VectorXd y =
        root_from(forms, Eigen::VectorXd::NullaryExpr(size, [&] { return normal(random); }));
    if (y.size() > 0) largest = std::max(largest, dimension_at(forms, y, starts));
  }
  return largest;
}

Counts count_absolute(const CompiledSystem& system, const std::vector<double>& parameters,
                      Status* status) {
  const Layout& layout = system.layout();
  Counts counts;
  counts.bodies = layout.bodies;
  counts.coordinates = layout.n;
  counts.first_order_equations = 2 * layout.n;
  counts.controller_states = layout.states;
  counts.constraints = layout.constraints();
  counts.parameters = static_cast<int>(system.study().tuned.size());
  StartWorkspace start(system, parameters);
  *status = start.solve();
  if (status->code == StatusCode::kAssemblyFailed) return counts;
  const Redundancy redundancy =
      analyse_redundancy(system, &start.equations, start.assembly, parameters, start.state);
  counts.redundant_rows = redundancy.rows;
  counts.undetermined_reactions = redundancy.undetermined;
  counts.chosen_friction = redundancy.friction_chosen;
  counts.redundant_constraints = static_cast<int>(counts.redundant_rows.size());
  counts.degrees_of_freedom = layout.n - (counts.constraints - counts.redundant_constraints);
  if (redundancy.rows.size() > redundancy.sharing.dropped.size())
    counts.degrees_of_freedom -=
        motions_lost_to_curvature(parameters, start.assembly, start.equations);
  counts.dynamic_equations = counts.first_order_equations + counts.constraints;
  counts.sensitivities = counts.parameters * counts.dynamic_equations;
  counts.total_equations = counts.dynamic_equations + counts.sensitivities;
  return counts;
}

}  // namespace

int dimension_of_cone(const std::vector<Eigen::MatrixXd>& forms) {
  if (forms.empty()) return 0;
  const double size = size_of(forms);
  Forms scaled;
  for (const Eigen::MatrixXd& form : forms)
    if (form.cwiseAbs().maxCoeff() > kNothing * std::max(1.0, size))
      scaled.emplace_back(form / size);
  return dimension(scaled, forms.front().rows(), kStarts);
}

int motions_lost_to_curvature(const std::vector<double>& parameters, const Assembly& assembly,
                              const Equations<double>& equations) {
  const LoopJacobian& loops = assembly.loops();
  if (loops.rows() == 0) return 0;
  const auto jacobian = [&](const VectorX<double>& theta) {
    return Eigen::MatrixXd(loops.evaluate(parameters, theta, equations));
  };
  const VectorX<double> theta = assembly.theta();
  const Eigen::MatrixXd J = jacobian(theta);
  const SingularValues svd = singular_values(J, SingularVectors::kBoth);
  const Eigen::VectorXd& values = svd.values;
  const Eigen::Index rank = (values.array() > kRankOfLoops * std::max(values[0], 1e-300)).count();
  const Eigen::MatrixXd N = svd.V.rightCols(J.cols() - rank), U = svd.U.rightCols(J.rows() - rank);
  if (N.cols() == 0 || U.cols() == 0) return 0;
  Forms forms(to_index(U.cols()), Eigen::MatrixXd(N.cols(), N.cols()));
  for (Eigen::Index a = 0; a < N.cols(); ++a) {
    const VectorX<double> ahead = theta + kStep * N.col(a), behind = theta - kStep * N.col(a);
    const Eigen::MatrixXd products =
        product(transposed_product(U, jacobian(ahead) - jacobian(behind)), N) / (2.0 * kStep);
    for (Eigen::Index u = 0; u < U.cols(); ++u) forms[to_index(u)].row(a) = products.row(u);
  }
  for (Eigen::MatrixXd& form : forms) form = Eigen::MatrixXd(0.5 * (form + form.transpose()));
  return static_cast<int>(N.cols()) - dimension_of_cone(forms);
}

// The paper's counts are those of absolute coordinates.
Counts count_equations(const CompiledSystem& system, const std::vector<double>& parameters,
                       Status* status) {
  const Layout& layout = system.layout();
  Counts counts;
  if (layout.has_forest()) {
    Study study = system.whole_study();
    study.solver.coordinates = CoordinatesKind::kAbsolute;
    counts = count_absolute(CompiledSystem(system.robot(), study), parameters, status);
  } else {
    counts = count_absolute(system, parameters, status);
  }
  counts.in_joint_coordinates = layout.has_forest();
  counts.solved_coordinates = layout.n;
  counts.solved_constraints = layout.constraints();
  return counts;
}

}  // namespace codesign
