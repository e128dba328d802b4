// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forces/friction_law.h"

namespace codesign {

/// A contact whose friction has states. In the vector of extra states it has one zeta per slip coordinate, then s_dw if the law has it.
struct BristleContact {
  FrictionModel model = FrictionModel::kGonthier;
  int pair = -1, element = -1;  ///< element -1: the pair slips isotropically
  int first = 0;                ///< index of the first state
  int size = 1;                 ///< number of slip coordinates

  bool dwells() const { return model->dwells; }
  int states() const { return size + (dwells() ? 1 : 0); }
  int dwell_state() const { return first + size; }
};

/// Evaluates the friction law of a contact. @param u slip velocity [m/s]. @param s all extra states, of which it reads its own.
template <class T>
Bristle<T> bristle_law(const BristleContact& contact, const Vector3<T>& u, const VectorX<T>& s, const FrictionConstants<T>& c) {
  BristleState<T> state;
  for (int k = 0; k < contact.size; ++k) state.zeta[k] = s[contact.first + k];
  if (contact.dwells()) state.dwell = s[contact.dwell_state()];
  return contact.model->bristle.of<T>(u, state, c);
}

}  // namespace codesign
