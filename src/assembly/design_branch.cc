// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/design_branch.h"

#include <cmath>

#include "assembly/guess_text.h"
#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"

namespace codesign {

void DesignBranch::begin(const Posture& own) {
  // If all open coordinates had to move, the position has no dependent coordinates that other
  // designs could share.
  is_known_ = loops_.jacobian.rows() > 0 && own.moved.size() <= own.dependent.size();
  theta_ = own.theta;
  free_ = own.moved;
  rank_tolerance_ = own.rank_tolerance;
  // Of their size already, so that later designs ask for no memory.
  between_ = own_design_;
  plain_ = own;
  way_ = {own.theta, own.theta, own.theta};
}

Status DesignBranch::keep(const Status& plain, const StartDesign& design, Posture* posture,
                          Warnings* warnings) {
  if (design.cancelled()) return plain;
  plain_ = *posture;
  const bool reached = follow(design, posture);
  posture->rate = plain_.rate;
  const bool same = plain.ok() && is_same_branch(posture->theta, plain_.theta);
  if (reached && !same) {
    warn_of("branch_continued",
            "the guesses of the study lead to another position of the loop than its "
            "position at the study's own values, continued to this design; the continued "
            "position is used, so that the objective does not jump; to find it where this "
            "design is simulated by itself",
            posture->theta, plain_.theta, design.parameters, warnings);
    return {};
  }
  *posture = plain_;
  if (!reached && plain.ok() && !design.cancelled())
    warn_of("branch_lost",
            "the position of the loop at the study's own values cannot be continued to this "
            "design, since the loop cannot be closed or is in a singular position on the "
            "way; the position found from the study's guesses is used, and the objective "
            "may jump here; to stay near the position reached on the way",
            way_.last, posture->theta, design.parameters, warnings);
  return plain;
}

/// Continues the own posture along the straight line to `design`, whose equations hold it again
/// afterwards. True if `posture` is the solution there.
bool DesignBranch::follow(const StartDesign& design, Posture* posture) {
  posture->rank_tolerance = rank_tolerance_;
  way_.last = theta_;
  bool is_held = true;  // whether the equations hold `design`
  const auto place_at = [&](double part) -> const std::vector<double>& {
    between_ = design.parameters;
    if (part < 1.0)
      for (std::size_t k = 0; k < own_design_.size(); ++k)
        between_[k] = own_design_[k] + part * (design.parameters[k] - own_design_[k]);
    if (part < 1.0 || !is_held) design.equations->set_design(between_);
    is_held = part == 1.0;
    return between_;
  };
  const bool reached = PostureWalk<decltype(place_at)>(loops_, design, free_, place_at, &newton_)
                           .go(
                               1.0, [] {}, posture, &way_);
  if (!is_held) design.equations->set_design(design.parameters);
  return reached;
}

/// Warns of a start at a design whose position is not the one that the study leads to. @param
/// message what was done, and why to write guesses. @param theta the guesses. @param other the
/// coordinates that these are to replace.
void DesignBranch::warn_of(const char* code, const std::string& message,
                           const VectorX<double>& theta, const VectorX<double>& other,
                           const std::vector<double>& parameters, Warnings* warnings) const {
  const MotionStudy& study = loops_.system.study();
  const double most = (theta - other).cwiseAbs().maxCoeff();
  std::vector<int> moved;
  std::string loop;
  for (const int c : free_) {
    if (loops_.followers.follows(c) || !(std::abs(theta[c] - other[c]) >= 0.01 * most)) continue;
    moved.push_back(c);
    if (loop.empty()) loop = loops_.jacobian.first_owner(c);
  }
  const std::vector<InitialJointState>& given = study.initial_state;
  const std::string guesses = guess_text(loops_.system.robot(), loops_.tree, theta, moved);
  warnings->push_back(warn(
      code,
      {given.empty() ? SourceLocation{study.file, 1} : given.front().where,
       "initial_state, loop '" + loop + "'", message + ", write initial_state: {" + guesses + "}",
       design_text(study, parameters), ""}));
}

}  // namespace codesign
