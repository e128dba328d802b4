// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "control/reference_motion.h"
#include "description/reference.h"
#include "math/taylor.h"

namespace codesign {

/// An expression of the time and of parameters; doc/theory.md (C2c).
template <class T>
class ExpressionReference {
 public:
  /// @param expression must outlive this.
  void set(const TimeExpression& expression, const std::vector<T>& parameters);
  ReferenceMotion<T> at(double t) const;
  void prepare_integral(double duration);
  ReferenceMotion<T> integral_at(double t) const;

 private:
  /// An instant up to which the expression is integrated, and its Taylor polynomial there.
  struct Panel {
    double begin;
    Taylor<T> series;
    T area;  ///< from 0 to `begin`
  };
  Taylor<T> series_at(double t) const;
  /// @param there series_at(t)
  T area_to(double t, const Taylor<T>& there) const;

  const TimeExpression* expression_ = nullptr;
  std::vector<T> used_;        ///< the numbers of the formula's dependencies; of the time: 0
  std::vector<Panel> panels_;  ///< by ascending begin, from 0
};

}  // namespace codesign
