// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SYSTEM_STATE_H_
#define MECHANISM_CODESIGN_SYSTEM_STATE_H_

#include <vector>

#include <type_traits>

#include "codegen/traced.h"
#include "joints/local_row.h"
#include "math/scalar.h"

namespace codesign {

/// The type of a turn reference: turns are counted with values alone, and are inputs while equations are traced.
template <class T>
using TurnReference = std::conditional_t<std::is_same_v<T, Traced>, Traced, double>;

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

  std::vector<int> turn_slot;         ///< first of State::turns of each pair; one per chain element
  int drop_slot = 0;                  ///< first of State::turns that are flags of dropped rows; theory (23)
  std::vector<double> initial_turns;  ///< State::turns of a state that was not assembled yet

  int turn(int pair, int element) const { return turn_slot[static_cast<std::size_t>(pair)] + element; }
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
  /// Counts whole turns: the position of a turning joint is continued from the value nearest to its entry [rad]. The entries behind the
  /// joints' are flags of redundant rows: 1 for a row that is dropped, 0 for one that holds; theory (23).
  std::vector<TurnReference<T>> turns;

  void resize(const Layout& layout) {
    q.setZero(layout.n);
    v.setZero(layout.n);
    s.setZero(layout.states);
    z.setZero(layout.columns());
    turns.assign(layout.initial_turns.begin(), layout.initial_turns.end());
  }
};

/// Copies a state of numbers into one of another scalar, without derivatives.
template <class To>
void cast_state(const State<double>& from, State<To>* to) {
  to->t = from.t;
  to->q = from.q.template cast<To>();
  to->v = from.v.template cast<To>();
  to->s = from.s.template cast<To>();
  to->z = from.z.template cast<To>();
  to->turns = from.turns;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SYSTEM_STATE_H_
