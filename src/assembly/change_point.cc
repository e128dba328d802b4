// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/change_point.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "assembly/assembly.h"
#include "control/reference.h"
#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kMostCoordinates = 40;
constexpr int kFewest = 100, kMost = 2000;  // instants at which the loops are assembled
constexpr double kStride = 0.1;             // [rad or m] between two of them

/// How far the given motions go, all together [rad or m].
double travel(const CompiledSystem& system, const Equations<double>& equations) {
  double way = 0.0;
  const double duration = system.study().duration;
  for (const Reference<double>& motion : equations.formulas().view().design.motion)
    for (int k = 0; k < kMost; ++k)
      way += std::abs(motion.at(duration * (k + 1) / kMost).value -
                      motion.at(duration * k / kMost).value);
  return way;
}

/// The determinant of the Jacobian of loops and couplings by their coordinates, with rows of one
/// length; zero if it is not square.
double determinant(const StartWorkspace& start) {
  const LoopJacobian& loops = start.assembly.loops();
  const std::vector<int>& columns = loops.coordinates();
  if (loops.rows() != static_cast<int>(columns.size())) return 0.0;
  const Eigen::MatrixXd all =
      loops.evaluate(start.parameters, start.assembly.theta(), start.equations);
  Eigen::MatrixXd square(loops.rows(), loops.rows());
  for (std::size_t k = 0; k < columns.size(); ++k) square.col(to_signed(k)) = all.col(columns[k]);
  square.rowwise().normalize();
  return square.partialPivLu().determinant();
}

}  // namespace

std::optional<double> first_change_point(const CompiledSystem& system, StartWorkspace* start) {
  const MotionStudy& study = system.study();
  const LoopJacobian& loops = start->assembly.loops();
  if (study.motion.empty() || study.postures > 0 || loops.first_coupling_row() == 0 ||
      loops.rows() > kMostCoordinates || system.sharing().drops())
    return std::nullopt;
  double side = determinant(*start);
  if (side == 0.0) return std::nullopt;
  const double wanted = travel(system, start->equations) / kStride;
  const int count = std::clamp(wanted < kMost ? static_cast<int>(wanted) : kMost, kFewest, kMost);
  VectorX<double> before = start->assembly.theta(), last = before;
  for (int k = 1; k <= count; ++k) {
    const double time = study.duration * k / count;
    start->assembly.begin_at(time, k == 1 ? last : VectorX<double>(2.0 * last - before));
    if (!start->solve_positions().ok()) return std::nullopt;
    before = last;
    last = start->assembly.theta();
    const double now = determinant(*start);
    if (now * side < 0.0) return time - 0.5 * study.duration / count;
    if (now != 0.0) side = now;
  }
  return std::nullopt;
}

}  // namespace codesign
