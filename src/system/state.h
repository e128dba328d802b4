// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <type_traits>

#include "joints/body_kinematics.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "mechanism/forest.h"

namespace codesign {

class Traced;

/// The scalar of a turn reference. Whole turns are counted from values and have no derivative, so
/// that it is double for every T; while the equations are traced it is Traced, so that the compiled
/// code takes the references as inputs.
template <class T>
using TurnReference = std::conditional_t<std::is_same_v<T, Traced>, Traced, double>;

/// The places of all unknowns and equations of a system in its vectors.
///
/// Every body is free, with its centre of mass r and Euler parameters p as coordinates, or hangs on
/// its parent by a pair of the forest, with that pair's joint coordinates; theory (56). All other
/// pairs are cut: they have constraint rows and multipliers.
///
/// Positions are (q, s), rates are z = (a, lambda, sigma), with q' = v, v' = a, s' = sigma. The
/// rows of G have the places of the rates: n rows of motion, m rows of constraint accelerations,
/// one row per extra state.
struct Layout {
  int bodies = 0;
  /// number of coordinates: 7 per free body (r, p), and those of the pairs of the forest
  int n = 0;
  /// number of multipliers: rows of cut pairs, then couplings, then |p| = 1 per free body; then
  /// `sharing` and `gears`
  int m = 0;
  int couplings = 0;  ///< number of `<mimic>` and `<coupling>`, one row each
  /// in m after those: unknowns w, eta, mu of shared reactions; theory (23b), SharingLayout
  int sharing = 0;
  int gears = 0;  ///< the last ones of m: torques that gears of cut pairs transmit; theory (9b)
  /// number of extra first-order states s: integrals of controllers, then states of friction laws
  int states = 0;
  /// first constraint row of each pair; a pair of the forest has no rows
  std::vector<int> pair_row;

  Forest forest;  ///< which pairs give coordinates
  /// per body: its first coordinate in q; empty if all bodies are free
  std::vector<int> body_column;
  /// per body: its row |p| = 1, counted from the first such row; -1 for a body of the forest; or
  /// empty
  std::vector<int> body_norm_row;

  /// per pair, its first entry of State::turns; one follows for each element of its chain
  std::vector<int> turn_slot;
  /// first entry of State::turns that is a flag of a row that can be dropped; theory (23)
  int drop_slot = 0;
  /// first entry of State::turns that is the sign of a body's Euler parameters, with a forest only
  int sign_slot = 0;
  std::vector<double> initial_turns;  ///< State::turns before a start is assembled

  int turn(int pair, int element) const { return turn_slot[to_index(pair)] + element; }
  int constraints() const { return m - sharing - gears; }  ///< number of rows of Phi
  int columns() const { return n + m + states; }           ///< size of z and of G
  int positions() const { return n + states; }             ///< size of (q, s)
  int lambda_column(int row) const {
    return n + row;
  }  ///< in z of the multiplier of a row of Phi; also the row Phi'' in G
  int gear_column(int k) const { return n + m - gears + k; }  ///< in z of the k-th; also its row
  int state_column(int k) const { return n + m + k; }  ///< in z of sigma_k; also its row in G
  int position_column(int k) const { return n + k; }   ///< in (q, s) of s_k
  /// The place in z of the rate by which a position of (q, s) is eliminated, theory (16): a_k for
  /// q_k, sigma_k for s_k.
  int rate_column(int position) const {
    return position < n ? position : state_column(position - n);
  }
  bool has_forest() const { return !forest.order.empty(); }
  /// Whether a body has the coordinates r and p.
  bool is_free(int body) const {
    return forest.order.empty() || forest.pair_above[to_index(body)] < 0;
  }
  /// Whether a pair has constraint rows and multipliers.
  bool is_cut(int pair) const {
    return forest.order.empty() || forest.body_below[to_index(pair)] < 0;
  }
  /// Whether there are such pairs, or may be: in absolute coordinates all pairs are.
  bool has_cuts() const {
    return forest.order.empty() || forest.order.size() < forest.body_below.size();
  }
  /// The first coordinate of a body in q: of r of a free body, else of the pair on which it hangs.
  int column(int body) const {
    return body_column.empty() ? kBodySize * body : body_column[to_index(body)];
  }
  /// The coordinate in q of an element of a pair's chain; -1 for a cut pair, and for an element
  /// with several coordinates.
  int element_column(int pair, int element) const {
    return is_cut(pair) || forest.has_several[to_index(pair)]
               ? -1
               : column(forest.body_below[to_index(pair)]) + element;
  }
  int norms() const {
    return bodies - static_cast<int>(forest.order.size());
  }  ///< number of rows |p| = 1
  /// Row |p| = 1 of Phi of a free body.
  int norm_row(int body) const {
    return constraints() - norms() + (body_norm_row.empty() ? body : body_norm_row[to_index(body)]);
  }
  int coupling_row(int k) const {
    return constraints() - norms() - couplings + k;
  }  ///< row of Phi of a coupling
  /// The index after the last row of Phi of a pair.
  int pair_end(int pair) const {
    const auto next = to_index(pair) + 1;
    return next < pair_row.size() ? pair_row[next] : coupling_row(0);
  }
};

/// The time and all unknowns of the equations of motion (14); coordinates and their units are
/// described in doc/notation.md.
template <class T>
struct State {
  double t = 0.0;   ///< [s]
  VectorX<T> q, v;  ///< coordinates and velocities, n each
  VectorX<T> s;     ///< extra states, Layout::states
  VectorX<T> z;     ///< accelerations, multipliers and rates of s, Layout::columns()
  /// Turn references: the position [rad] of a turning joint is reported in the whole turn nearest
  /// to its entry. They are followed by the flags of redundant rows: 1 for a dropped row, 0 for an
  /// enforced one; theory (23), and with a forest by the signs, 1 or -1, with which
  /// body_parameters() multiplies. They have no derivative.
  std::vector<TurnReference<T>> turns;

  /// Sets all vectors to zero with the sizes of a layout.
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
