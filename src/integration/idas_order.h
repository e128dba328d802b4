// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integration/idas_handles.h"

namespace codesign {

/// Keeps the motion from lowering the order of IDAS where its errors are far below the tolerances,
/// as at rest, so that the sensitivities choose the order; doc/theory.md (27).
///
/// IDAS lowers its order if the error of the motion at the next lower order is not larger, which
/// holds if both are zero, and does not ask the sensitivities then. After each solution of the
/// motion it takes the norms of the errors at order k, k - 1 and k - 2, in this order; norms that
/// grow with their number, from a millionth of the tolerance, stand for errors below them.
class OrderFloor {
 public:
  void set_active(bool active) { active_ = active; }
  /// Before each evaluation of the residual.
  void begin() { norms_ = 0; }
  /// The norm that stands for `norm`, in tolerances. Of a norm that is not finite, itself.
  double raise(double norm);

 private:
  bool active_ = false;
  int norms_ = 0;  ///< since begin()
};

/// Makes the masked norms of a vector of N_VNew_Serial(), and of all that IDAS clones from it,
/// those of `floor`, which must outlive them; nullptr: as they are. @throws std::bad_alloc
void set_order_floor(N_Vector vector, OrderFloor* floor);

}  // namespace codesign
