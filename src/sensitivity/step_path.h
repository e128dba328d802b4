// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SRC_SENSITIVITY_STEP_PATH_H_
#define MECHANISM_CODESIGN_SRC_SENSITIVITY_STEP_PATH_H_

#include <vector>

#include "mechanism_codesign/dynamics/state.h"

namespace codesign {

/// The points that an integration passed, to go back along them. Keeps its memory from run to run.
class StepPath {
 public:
  explicit StepPath(const Layout& layout);

  void clear() { numbers_.clear(); }
  /// @param h size of the step [s] that ended here; 0 for the start.
  void append(double h, const State<double>& point);

  int size() const { return static_cast<int>(numbers_.size() / stride_); }
  /// Size [s] of the step that ended at point k.
  double step_size(int k) const { return *numbers_at(k); }
  /// @param state of the layout's sizes.
  void point(int k, State<double>* state) const;

 private:
  const double* numbers_at(int k) const { return numbers_.data() + stride_ * static_cast<std::size_t>(k); }

  std::size_t stride_;
  std::vector<double> numbers_;  ///< h, t, q, v, s, z of each point
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SRC_SENSITIVITY_STEP_PATH_H_
