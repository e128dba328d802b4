// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "control/reference_motion.h"
#include "description/reference.h"
#include "math/sampled_function.h"

namespace codesign {

/// scale f(t + delay) - offset, with f through samples; doc/theory.md (C2a).
template <class T>
class SampledReference {
 public:
  void set(const SampledDescription& sampled, const std::vector<T>& parameters);
  ReferenceMotion<T> at(double t) const;

 private:
  std::shared_ptr<const SampledFunction> samples_;
  T scale_{1.0}, delay_{0.0}, offset_{0.0};
};

}  // namespace codesign
