// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "codegen/traced.h"
#include "control/reference_motion.h"
#include "description/reference.h"
#include "math/scalar.h"

namespace codesign {

/// A shaped input u(t) = sum_k c_k B_k(t) for one design; theory (C8). T as for Reference.
template <class T>
class ShapedInput {
 public:
  ShapedInput() = default;
  /// @param basis must outlive the object.
  ShapedInput(const BasisDescription& basis, const std::vector<T>& parameters) {
    set(basis, parameters);
  }
  /// Becomes what the constructor makes; uses its memory again.
  void set(const BasisDescription& basis, const std::vector<T>& parameters);

  const std::vector<T>& coefficients() const { return coefficients_; }

  /// u and u' at time t [s]; higher derivatives are not computed (zero).
  ReferenceMotion<T> at(double t) const;

 private:
  const BasisDescription* basis_ = nullptr;
  std::vector<T> coefficients_;
};

/// For recorded equations: inputs that are supplied for each instant (Recording::timed()).
template <>
class ShapedInput<Traced> {
 public:
  ShapedInput() = default;
  ShapedInput(const BasisDescription& basis, const std::vector<Traced>& parameters) {
    set(basis, parameters);
  }
  void set(const BasisDescription& basis, const std::vector<Traced>& parameters);

  ReferenceMotion<Traced> at(double) const { return motion_; }

 private:
  ReferenceMotion<Traced> motion_;
};

}  // namespace codesign
