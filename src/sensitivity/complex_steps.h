// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "description/motion_study.h"
#include "math/arrays.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

class CompiledSystem;

/// Derivatives of the objective and of the watched numbers by a complex step through the steps of a
/// run, doc/theory.md (22): one entry and one row per direction.
/// @param derivatives of the run that chooses the steps. @param directions one column each.
/// @returns a failure of that run.
Status differentiate_steps(const CompiledSystem& system, const std::vector<double>& parameters,
                           Derivatives derivatives, const Eigen::MatrixXd& directions,
                           const std::atomic<bool>* cancel, Eigen::VectorXd* objective,
                           Eigen::MatrixXd* watched);

/// parameters + step * direction, with the tuned parameters in the direction.
template <class T>
std::vector<T> moved(const MotionStudy& study, const std::vector<double>& parameters,
                     const Eigen::VectorXd& direction, const T& step) {
  std::vector<T> result(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    result[to_index(study.tuned[k])] += step * direction[to_signed(k)];
  return result;
}

/// The largest step along a direction that changes no tuned parameter by more than its `size`.
template <class Size>
double step_along(const MotionStudy& study, const std::vector<double>& parameters,
                  const Eigen::VectorXd& direction, const Size& size) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    if (const double component = std::abs(direction[to_signed(k)]); component > 0.0)
      step = std::min(step, size(parameters[to_index(study.tuned[k])]) / component);
  return step;
}

}  // namespace codesign
