// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SYSTEM_STATE_H_
#define MECHANISM_CODESIGN_SYSTEM_STATE_H_

#include <vector>

#include "joints/local_row.h"
#include "math/scalar.h"

namespace codesign {

/// Where everything stands in the vectors of a system.
///
/// Positions are (q, s) and rates are z = (a, lambda, sigma): q' = v, v' = a, s' = sigma. The equations' rows are laid out as the rates:
/// n rows of motion, m of constraint accelerations, one per extra state.
struct Layout {
  int bodies = 0;
  int n = 0;                  ///< 7 per body: r, p
  int m = 0;                  ///< multipliers of the constraints: pairs in order, then couplings, then |p| = 1 per body; then `sharing`
  int couplings = 0;          ///< `<mimic>` and `<coupling>`, one row each
  int sharing = 0;            ///< of m: unknowns behind the constraints' multipliers by which redundant rows share reactions; theory (23)
  int states = 0;             ///< extra first-order states s (integrals of controllers)
  std::vector<int> pair_row;  ///< first constraint row of each pair

  int constraints() const { return m - sharing; }  ///< rows of Phi
  int columns() const { return n + m + states; }
  int positions() const { return n + states; }
  int lambda_column(int row) const { return n + row; }
  int state_column(int k) const { return n + m + k; }  ///< of sigma_k, and its row
  int position_column(int k) const { return n + k; }   ///< of s_k
  /// Of the rate that a position is eliminated by: a_k for q_k, sigma_k for s_k.
  int rate_column(int position) const { return position < n ? position : state_column(position - n); }
  int norm_row(int body) const { return constraints() - bodies + body; }
  int coupling_row(int k) const { return constraints() - bodies - couplings + k; }
  /// One behind the last row of a pair.
  int pair_end(int pair) const {
    const auto next = static_cast<std::size_t>(pair) + 1;
    return next < pair_row.size() ? pair_row[next] : coupling_row(0);
  }
};

/// A point of the differential-algebraic system.
template <class T>
struct State {
  double t = 0.0;   ///< [s]
  VectorX<T> q, v;  ///< coordinates and velocities, n each
  VectorX<T> s;     ///< extra states
  VectorX<T> z;     ///< accelerations, multipliers and rates of s

  void resize(const Layout& layout) {
    q.setZero(layout.n);
    v.setZero(layout.n);
    s.setZero(layout.states);
    z.setZero(layout.columns());
  }
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SYSTEM_STATE_H_
