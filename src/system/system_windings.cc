// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The windings of a system's motors, theory (9d).
#include "description/study.h"
#include "math/arrays.h"
#include "mechanism/motor_sides.h"
#include "system/system.h"

namespace codesign {
namespace {

/// Index of the initial state that gives a current of the joint; -1: none.
int start_of(const MotionStudy& study, const std::string& joint) {
  for (std::size_t k = 0; k < study.initial_state.size(); ++k)
    if (study.initial_state[k].joint == joint && study.initial_state[k].current)
      return static_cast<int>(k);
  return -1;
}

}  // namespace

void System::collect_windings() {
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const JointDescription& joint = robot_.joints[j];
    const int pair = topology_.joint_pair[j];
    if (!joint.has_winding() || joint.motor >= 0 || pair < 0) continue;
    Winding winding;
    winding.pair = pair;
    winding.joint = joint_of_motor(robot_, joint.name);
    const std::vector<ChainElement>& chain = topology_.pairs[to_index(pair)].chain;
    for (std::size_t e = 0; e < chain.size(); ++e)
      if (chain[e].joint == static_cast<int>(j)) winding.element = static_cast<int>(e);
    if (!has_coordinate_[to_index(pair)][to_index(winding.element)])
      refuse_load(pair, winding.element);
    bool has_effort = false;
    for (std::size_t c = 0; c < controllers_.size(); ++c) {
      if (!(motor_of(controllers_[c].pair, controllers_[c].element) ==
            CoordinateIndex{pair, winding.element}))
        continue;
      if (study().controllers[c].gives_effort)
        has_effort = true;
      else
        winding.controllers.push_back(static_cast<int>(c));
    }
    // A recorded effort is the motor's whole effort.
    winding.acts = !study().rigid_gears && study().postures == 0 &&
                   !has_given_motion(study(), joint.name) &&
                   !(has_effort && winding.controllers.empty());
    if (winding.acts && joint.actuator->winding->has_state()) {
      winding.state = layout_.states++;
      winding.start = start_of(study(), winding.joint);
    }
    windings_.push_back(std::move(winding));
  }
}

}  // namespace codesign
