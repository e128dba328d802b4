// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/standstill.h"

#include <algorithm>

#include "assembly/acceleration_block.h"
#include "equations/compiled_system.h"
#include "math/dense.h"

namespace codesign {
namespace {

constexpr std::int64_t kPaceWindow = 100;  // the pace is checked once in this number of steps
constexpr double kNever = 20000.0;         // remaining steps from which a run counts as stalled
// Smallest singular value, relative to its value at the start, below which the position counts as singular: kStalled for a stalled run,
// where reactions are then fifty times as large as at the start; kNearby for a failed one, since friction can lock a mechanism before the
// position.
constexpr double kStalled = 0.02, kNearby = 0.1;
constexpr double kTakesPart = 0.1;     // a pair is named if its load in the self-stress exceeds this fraction of the largest
constexpr int kLargestAnalysed = 400;  // larger numbers of coordinates are not analysed, since the decomposition is dense

bool may_be_singular(StatusCode code) {
  return code == StatusCode::kStepSizeTooSmall || code == StatusCode::kSingularMatrix || code == StatusCode::kConstraintDrift ||
         code == StatusCode::kEnergyError || code == StatusCode::kTooManySteps;
}

/// Largest distance of a free body from the mean of all [m]; 1 if that is zero.
double size_of(const VectorX<double>& q, const Layout& layout) {
  std::vector<Eigen::Vector3d> places;
  for (int b = 0; b < layout.bodies; ++b)
    if (layout.is_free(b)) places.emplace_back(q.segment<3>(layout.column(b)));
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& place : places) middle += place / static_cast<double>(places.size());
  double size = 0.0;
  for (const Eigen::Vector3d& place : places) size = std::max(size, (place - middle).norm());
  return size > 0.0 ? size : 1.0;
}

std::vector<int> enforced_rows(const CompiledSystem& system) {
  const std::vector<int>& dropped = system.dropped_rows();
  std::vector<int> rows;
  for (int row = 0; row < system.layout().constraints(); ++row)
    if (!std::binary_search(dropped.begin(), dropped.end(), row)) rows.push_back(row);
  return rows;
}

/// Phi_q without units: columns of r of free bodies multiplied by the mechanism's size, then all rows normalized.
Eigen::MatrixXd scaled_jacobian(const CompiledSystem& system, const State<double>& state, Equations<double>* equations) {
  Eigen::MatrixXd rows = constraint_jacobian(system, equations, state);
  const Layout& layout = system.layout();
  const double size = size_of(state.q, layout);
  for (int b = 0; b < layout.bodies; ++b)
    if (layout.is_free(b)) rows.middleCols(layout.column(b), 3) *= size;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) rows.row(r).normalize();
  return rows;
}

Eigen::MatrixXd enforced_part(const CompiledSystem& system, const Eigen::MatrixXd& all) {
  const std::vector<int> enforced = enforced_rows(system);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(enforced.size()), all.cols());
  for (std::size_t k = 0; k < enforced.size(); ++k) rows.row(static_cast<Eigen::Index>(k)) = all.row(enforced[k]);
  return rows;
}

/// The singular value number `rank` (from 1) in descending order.
double singular_value(const Eigen::MatrixXd& rows, Eigen::Index rank) { return singular_values(rows).values[rank - 1]; }

void add_name(const std::string& name, std::string* list) { *list += (list->empty() ? "'" : ", '") + name + "'"; }

/// Names of the joints and loops that a self-stress (one multiplier per enforced row) loads.
std::string loaded_pairs(const CompiledSystem& system, const Eigen::VectorXd& stress) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(system.layout().constraints());
  const std::vector<int> enforced = enforced_rows(system);
  for (std::size_t k = 0; k < enforced.size(); ++k) all[enforced[k]] = std::abs(stress[static_cast<Eigen::Index>(k)]);
  const std::vector<Pair>& pairs = system.topology().pairs;
  std::vector<double> loads;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const int first = system.layout().pair_row[p], count = system.layout().pair_end(static_cast<int>(p)) - first;
    loads.push_back(count > 0 ? all.segment(first, count).maxCoeff() : 0.0);
  }
  const double least = kTakesPart * *std::max_element(loads.begin(), loads.end());
  std::string names;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (loads[p] > least) add_name(pairs[p].name, &names);
  return names;
}

std::string frictions_in_loops(const CompiledSystem& system) {
  std::string names;
  for (int p : system.sharing().pairs)
    if (const int joint = system.topology().pairs[static_cast<std::size_t>(p)].friction_joint; joint >= 0)
      add_name(system.robot().joints[static_cast<std::size_t>(joint)].name, &names);
  return names;
}

std::string cause(const CompiledSystem& system, const Eigen::MatrixXd& rows, bool all_lose_rank) {
  const SingularValues svd = singular_values(rows, SingularVectors::kLeft);
  const std::string names = loaded_pairs(system, svd.U.col(svd.values.size() - 1)), frictions = frictions_in_loops(system);
  const std::string rank = std::to_string(rows.rows() - 1), usual = std::to_string(rows.rows());
  if (!all_lose_rank)
    return "the constraints that were independent at the start have rank " + rank + " instead of " + usual +
           " here, although all constraints together keep their rank: rows of " + names +
           " that were dropped as redundant would have to replace others; end the study before this position, or start it nearer to here";
  return "the mechanism approaches a singular position, where its independent constraints have rank " + rank + " instead of " + usual +
         ": reactions of " + names + " grow without bound on the way there" +
         (frictions.empty() ? "" : ", and the friction of " + frictions + " with them, so that the motion beyond it is not determined") +
         "; end the study before this position, or start from another one";
}

}  // namespace

Status judge_standstill(const Status& status, const CompiledSystem& system, const State<double>& initial, const State<double>& state,
                        double step_size, const Statistics& statistics, Equations<double>* equations) {
  if (!system.sharing().drops() || system.layout().n > kLargestAnalysed) return status;
  const bool slow = statistics.steps % kPaceWindow == 0 && system.study().duration - state.t > kNever * step_size;
  if (!(status.ok() ? slow : may_be_singular(status.code)) || !state.q.allFinite()) return status;
  const Eigen::MatrixXd all = scaled_jacobian(system, state, equations), before = scaled_jacobian(system, initial, equations);
  const Eigen::MatrixXd rows = enforced_part(system, all);
  const Eigen::Index rank = rows.rows();
  const double limit = status.ok() ? kStalled : kNearby;
  if (singular_value(rows, rank) > limit * singular_value(enforced_part(system, before), rank)) return status;
  const bool all_lose_rank = singular_value(all, rank) <= 2.0 * limit * singular_value(before, rank);
  return {StatusCode::kSingularConfiguration, state.t, cause(system, rows, all_lose_rank)};
}

}  // namespace codesign
