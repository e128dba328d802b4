// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_WORKSPACE_H_
#define MECHANISM_CODESIGN_ELEMENTS_WORKSPACE_H_

#include <vector>

#include "joints/pair_rows.h"
#include "sparse/sparsity.h"
#include "system/system.h"

namespace codesign {

/// What elements write while the equations are evaluated: loads on bodies that several elements add to, and memory for gradients.
template <class T>
struct Workspace {
  explicit Workspace(const System& system) {
    loads.resize(static_cast<std::size_t>(system.layout().bodies));
    if (!system.sharing().drops()) return;
    shared_loads = loads;
    displaced.resize(loads.size() + 1);
    displaced.back().at_rest = true;
  }

  /// To be called before the first element adds to the loads.
  void clear_loads() {
    for (BodyLoad<T>& load : loads) {
      load.force.setZero();
      load.W.setZero();
    }
  }
  /// Null for the ground.
  BodyLoad<T>* load_on(int body) { return body < 0 ? nullptr : &loads[static_cast<std::size_t>(body)]; }
  BodyLoad<T>* shared_load_on(int body) { return body < 0 ? nullptr : &shared_loads[static_cast<std::size_t>(body)]; }
  const BodyKinematics<T>& displaced_body(int body) const {
    return body < 0 ? displaced.back() : displaced[static_cast<std::size_t>(body)];
  }

  std::vector<BodyLoad<T>> loads;            ///< per body, of multipliers, springs and constant forces
  std::vector<BodyLoad<T>> shared_loads;     ///< per body, of the loads eta; theory (23)
  std::vector<BodyKinematics<T>> displaced;  ///< bodies at rest with the displacements w as accelerations, the ground last; theory (23)
  SparseGradient<T> gradient;                ///< of the element that is being assembled
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_WORKSPACE_H_
