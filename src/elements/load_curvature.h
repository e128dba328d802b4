// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_LOAD_CURVATURE_H_
#define MECHANISM_CODESIGN_ELEMENTS_LOAD_CURVATURE_H_

#include "elements/state_view.h"
#include "joints/coordinate_load.h"

namespace codesign {

/// Adds L theta_qq, the derivative of J^T L by positions at a fixed load L, theory (8), to the rows of motion of a pair.
/// @param index the pair. @param load L [N or N m].
template <class T, class Sink>
void assemble_load_curvature(const StateView<T>& view, int index, const CoordinateConstants<T>& coordinate, const T& load, Sink* sink) {
  const Pair& pair = view.system.topology().pairs[static_cast<std::size_t>(index)];
  coordinate_load_gradient(view.design.constants.pairs[static_cast<std::size_t>(index)], coordinate, view.body(pair.body_i),
                           view.body(pair.body_j), load, [&](int r, int local_column, const T& entry) {
                             const int row = view.column(index, r), global_column = view.column(index, local_column);
                             if (row >= 0 && global_column >= 0) sink->position(row, global_column, entry);
                           });
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_LOAD_CURVATURE_H_
