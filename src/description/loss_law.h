// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "forces/law.h"
#include "math/scalar.h"

namespace codesign {

/// Where a loss has a kink, as a part for name_part().
enum LossKink { kAtReference, kScaleAbove, kScaleBelow };

/// What a loss is a function of: the residual r = signal - reference, and the scale c > 0 of losses
/// that have one; all in the unit of the signal.
template <class T>
struct LossValues {
  T signal{0.0}, reference{0.0};
  T scale{1.0};

  T residual() const { return signal - reference; }
  /// Whether r > kink, a switch. It compares the signal itself, whose size says how much of a
  /// residual near zero is rounding. @param likely see is_below_kink().
  bool is_above(const T& kink, LossKink part, bool likely,
                unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) const {
    name_part(residual(), part);
    return is_below_kink(T(reference + kink), signal, likely, place);
  }
};

/// A function of these values.
template <class T>
using LossFunction = T (*)(const LossValues<T>& x);

/// A loss, one row of the table in loss_law.cc: how much a residual r counts, rho(r) >= 0 with
/// rho(0) = 0, in squared units of the signal or, of `absolute`, in its unit; doc/theory.md (21).
/// Kinks decide by LossValues::is_above(). A row has one of `root` and `value`.
struct LossLaw {
  const char* name = "";  ///< the value of `loss`
  /// rho is the square of this function, so that least squares take the term; theory (22a)
  Law<LossFunction> root{};
  Law<LossFunction> value{};  ///< rho
  bool has_scale = false;     ///< whether it reads LossValues::scale
  /// rho'(r) / (2 r) for a scale c, the weight of a residual in reweighted least squares, theory
  /// (39); null: identification does not offer the loss
  double (*weight)(double r, double c) = nullptr;

  bool is_square() const { return static_cast<bool>(root); }
};

/// The loss of a term of the objective, or of the residuals of an identification.
class LossKind : public RowReference<LossLaw> {
 public:
  using RowReference::RowReference;
  static const LossKind kSquare,  ///< r^2
      kAbsolute,                  ///< |r|
      kHuber,                     ///< r^2 up to |r| = c, and c (2 |r| - c) beyond
      kSoftL1,                    ///< 2 c^2 (sqrt(1 + (r/c)^2) - 1), a smooth Huber loss
      kAbove,                     ///< max(r, 0)^2, a soft upper bound
      kBelow;                     ///< min(r, 0)^2, a soft lower bound
};

/// The library's losses.
std::vector<LossKind> losses();

/// The function whose square rho is, and zero if there is none.
template <class T>
T loss_root(const LossLaw& law, const LossValues<T>& x) {
  return law.is_square() ? law.root.of<T>(x) : T(0.0);
}

/// weight * rho(r).
template <class T>
T weighted_loss(const LossLaw& law, const T& weight, const LossValues<T>& x) {
  if (!law.is_square()) return weight * law.value.of<T>(x);
  const T root = law.root.of<T>(x);
  return weight * root * root;
}

}  // namespace codesign
