// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "assembly/loop_newton.h"
#include "assembly/posture.h"
#include "assembly/start_design.h"
#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/scalar.h"

namespace codesign {

/// A line along which a closed position is continued, and how far that came.
struct PostureWay {
  VectorX<double> last;    ///< theta at the last solution on the way; before the walk, at its begin
  VectorX<double> slope;   ///< its change by the part of the way there; zero if no step was made
  VectorX<double> direct;  ///< a solution before it is compared
};

/// One walk along such a line, doc/theory.md (19b): which coordinates close the loops, and how they
/// are closed. The enforced rows count.
/// @tparam PlaceAt (part of the way) -> the design there; sets number and time of the posture.
template <class PlaceAt>
class PostureWalk {
 public:
  /// @param free the coordinates that close the loops. All arguments must outlive this.
  PostureWalk(const TreeLoops& loops, const StartDesign& design, const std::vector<int>& free,
              const PlaceAt& place_at, LoopNewton* newton)
      : loops_(loops), design_(design), free_(free), place_at_(place_at), newton_(*newton) {}

  /// Continues way->last with steps that are halved where Newton's method does not converge at
  /// once, or to another solution than by way of the middle of the step. Where the solution before
  /// is no start from which it converges, as beside a position where several motions meet, the line
  /// through the last two solutions leads on.
  /// @param step the first one, a part of the way. @param arrive called at the end of each step,
  /// where `posture` is the solution. @returns whether the end was reached.
  template <class Arrive>
  bool go(double step, const Arrive& arrive, Posture* posture, PostureWay* way) {
    constexpr double kShortest = 1.0 / 1024;
    double reached = 0.0;
    bool has_slope = false;
    while (reached < 1.0 && step >= kShortest && !design_.cancelled()) {
      const double next = std::min(1.0, reached + step);
      if (continues(reached, next, posture, way) ||
          (has_slope && leads_on(reached, next, posture, way))) {
        way->slope = (posture->theta - way->last) / (next - reached);
        has_slope = true;
        way->last = posture->theta;
        arrive();
        reached = next;
        step *= 2.0;
      } else {
        step *= 0.5;
      }
    }
    if (!has_slope) way->slope.setZero(loops_.tree.size);
    return reached == 1.0;
  }

 private:
  bool arrives(double part, Posture* posture) {
    const StartDesign design = design_.at(place_at_(part));
    set_given_start(loops_.system, loops_.tree, design.parameters, posture->number, &posture->theta,
                    &posture->rate);
    loops_.followers.follow(*design.equations, posture);
    return newton_.converges_at_once(design, free_, LoopRows::kEnforced, posture);
  }

  bool continues(double reached, double next, Posture* posture, PostureWay* way) {
    posture->theta = way->last;
    if (!arrives(next, posture)) return false;
    if (free_.empty()) return true;
    way->direct = posture->theta;
    posture->theta = way->last;
    const bool same = arrives(0.5 * (reached + next), posture) && arrives(next, posture) &&
                      is_same_branch(posture->theta, way->direct);
    posture->theta = way->direct;
    return same;
  }

  bool leads_on(double reached, double next, Posture* posture, PostureWay* way) {
    // Between two solutions the one in the middle is off their mean by this part of their distance.
    constexpr double kBend = 0.25;
    VectorX<double>& theta = posture->theta;
    const double part = next - reached;
    theta = way->last + part * way->slope;
    if (!arrives(next, posture)) return false;
    way->direct = theta;
    theta = way->last + 0.5 * part * way->slope;
    if (!arrives(0.5 * (reached + next), posture)) return false;
    theta = 2.0 * theta - way->last - way->direct;
    const double bend = 0.5 * theta.cwiseAbs().maxCoeff(),
                 moved = (way->direct - way->last).cwiseAbs().maxCoeff();
    theta = way->direct;
    place_at_(next);
    return bend <= kBend * moved;
  }

  const TreeLoops& loops_;
  const StartDesign& design_;
  const std::vector<int>& free_;
  const PlaceAt& place_at_;
  LoopNewton& newton_;
};

}  // namespace codesign
