// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "equations/equations.h"
#include "system/system.h"

namespace codesign {

/// Carries the turn references of cut pairs, State::turns, from one state to another between which
/// a joint may turn by any number of turns; doc/theory.md (8).
///
/// The angle of a cut pair follows from the positions of two bodies, which say nothing about whole
/// turns. On the straight line between the coordinates q of both states it is a continuous
/// function, whose whole turns can be counted: the first point of the line is so near that no pair
/// can turn by half a turn, and further points are as far as the angles change in proportion to the
/// way. In joint coordinates with parallel axes they do so, and a few points suffice for thousands
/// of turns.
///
/// The line is that of the stages of a step, of its end and of its dense output, so that references
/// are right in each of them, however long the step is. Not thread-safe. No allocation.
template <class T>
class TurnFollower {
 public:
  /// @param system must outlive the object.
  explicit TurnFollower(const System& system);

  /// Sets to->turns: the references of turns to positions less than half a turn from those of `to`,
  /// all other entries to those of `from`.
  /// @param from its references of turns are those of its positions, Equations::track_turns().
  /// @param equations must hold the design.
  void follow(const State<T>& from, Equations<T>* equations, State<T>* to) {
    to->turns = from.turns;
    if (ways_.empty() || !(farthest_ * largest_change(from, *to) > kSure)) return;
    const double way = longest_way(from, *to);
    if (way > kSure) count(from, way, equations, to);
  }

 private:
  /// What turns the bodies of a cut pair relative to each other.
  struct Way {
    std::vector<int> turns;  ///< in q, of joints that turn
    std::vector<int> free;   ///< in q, first Euler parameter of free bodies
  };
  /// [rad] A pair that turns by no more needs no points in between: less than half a turn, with a
  /// margin for stages that violate the constraints.
  static constexpr double kSure = 1.5;

  void add_ways();
  void note_ways(int body, Way* way) const;
  static double largest_change(const State<T>& from, const State<T>& to) {
    return (to.q - from.q).real().cwiseAbs().maxCoeff();
  }
  /// Upper bound [rad] of the turn of any cut pair on the line.
  double longest_way(const State<T>& from, const State<T>& to) const;
  void count(const State<T>& from, double way, Equations<T>* equations, State<T>* to);
  void place(const State<T>& from, const State<T>& to, double part);
  double look(double part, Equations<T>* equations, const State<T>& to);

  const System& system_;
  std::vector<Way> ways_;
  double farthest_ = 0.0;   ///< longest_way() is at most this times the largest change of q
  std::vector<int> slots_;  ///< entries of State::turns that are references of turns
  std::vector<int> free_;   ///< in q, first Euler parameter of every free body
  State<T> between_;        ///< on the line
  /// per slot: change of the angle [rad] over the whole line, if it changes as over its last part
  std::vector<double> slope_;
};

extern template class TurnFollower<double>;
extern template class TurnFollower<std::complex<double>>;

}  // namespace codesign
