// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FORCES_BRISTLE_LAW_H_
#define MECHANISM_CODESIGN_FORCES_BRISTLE_LAW_H_

#include "description/robot.h"
#include "forces/gonthier.h"
#include "forces/lugre.h"

namespace codesign {

/// One contact whose friction has states, and where they stand among the extra states: zeta per slip coordinate, then s_dw.
struct BristleContact {
  FrictionModel model = FrictionModel::kGonthier;
  int pair = -1, element = -1;  ///< element -1: the pair slips isotropically
  int first = 0;                ///< index of the first state
  int size = 1;                 ///< slip coordinates

  bool dwells() const { return model == FrictionModel::kGonthier; }
  int states() const { return size + (dwells() ? 1 : 0); }
  int dwell_state() const { return first + size; }
};

/// The law of a contact at slip velocity u [m/s], with its states read from the extra states s.
template <class T>
Bristle<T> bristle_law(const BristleContact& contact, const Vector3<T>& u, const VectorX<T>& s, const FrictionConstants<T>& c) {
  BristleState<T> state;
  for (int k = 0; k < contact.size; ++k) state.zeta[k] = s[contact.first + k];
  if (!contact.dwells()) return lugre<T>(u, state, c);
  state.dwell = s[contact.dwell_state()];
  return gonthier<T>(u, state, c);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FORCES_BRISTLE_LAW_H_
