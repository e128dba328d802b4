// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_beyond_stop.h"

#include <algorithm>
#include <cmath>

#include "elements/energy.h"
#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kTolerated = 0.02;  // of the range between the stops

/// The place of the study that starts a joint; else that of the joint.
SourceLocation place_of(const MotionStudy& study, const JointDescription& joint) {
  for (const InitialJointState& initial : study.initial_state)
    if (initial.joint == joint.name) return initial.where;
  return joint.where;
}

}  // namespace

Warnings starts_beyond_stops(const CompiledSystem& system, const State<double>& state,
                             Equations<double>* equations) {
  Warnings warnings;
  if (system.study().postures > 0) return warnings;
  equations->formulas().load(state);
  const StateView<double>& view = equations->formulas().view();
  for (const JointLoad& load : system.loads()) {
    const auto* stop = load.find<StopLoad>();
    if (!stop) continue;
    const JointDynamicsConstants<double>& d = view.dynamics(load.pair, load.element);
    const double position = view.coordinate_value(load.pair, load.element),
                 beyond = std::max(position - d.upper, d.lower - position);
    if (!(beyond > kTolerated * (d.upper - d.lower))) continue;
    const int joint =
        system.topology().pairs[to_index(load.pair)].chain[to_index(load.element)].joint;
    const JointDescription& description = system.robot().joints[to_index(joint)];
    const char* const unit = description.is_turn() ? " rad" : " m";
    append({warn("start_beyond_stop",
                 {place_of(system.study(), description), "initial_state." + description.name,
                  "the joint starts " + readable(beyond, 3) + unit +
                      " beyond its stop, whose spring holds " +
                      readable(part_energy(view, load, *stop), 4) +
                      " J there and throws it back; start it between its stops, or leave out "
                      "limits.position",
                  readable(position, 6) + unit,
                  readable(d.lower, 6) + " to " + readable(d.upper, 6)})},
           &warnings);
  }
  return warnings;
}

}  // namespace codesign
