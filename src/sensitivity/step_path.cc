// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/step_path.h"

namespace codesign {

StepPath::StepPath(const Layout& layout) : stride_(static_cast<std::size_t>(2 + 2 * layout.n + layout.states + layout.columns())) {}

void StepPath::append(double h, const State<double>& point) {
  numbers_.push_back(h);
  numbers_.push_back(point.t);
  for (const VectorX<double>* part : {&point.q, &point.v, &point.s, &point.z})
    numbers_.insert(numbers_.end(), part->data(), part->data() + part->size());
}

void StepPath::point(int k, State<double>* state) const {
  const double* from = numbers_at(k) + 1;
  state->t = *from++;
  for (VectorX<double>* part : {&state->q, &state->v, &state->s, &state->z}) {
    *part = Eigen::Map<const Eigen::VectorXd>(from, part->size());
    from += part->size();
  }
}

}  // namespace codesign
