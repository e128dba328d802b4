// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stop_watch.h"

#include <algorithm>
#include <cmath>

#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {

StopWatch::StopWatch(const CompiledSystem& system) : system_(system) {
  const std::vector<JointLoad>& loads = system.loads();
  has_stops_ = std::any_of(loads.begin(), loads.end(),
                           [](const JointLoad& load) { return load.find<StopLoad>() != nullptr; });
}

void StopWatch::look(const Formulas<double>& formulas, double t) {
  for (const JointLoad& load : system_.loads()) {
    if (!load.find<StopLoad>()) continue;
    const JointDynamicsConstants<double>& d =
        formulas.view().design.constants.pairs[to_index(load.pair)].dynamics[to_index(
            load.element)];
    const double position = formulas.coordinate(load.pair, load.element).position,
                 margin = kStopGivesWay * (d.upper - d.lower);
    if (position > d.upper + margin) note(load, true, d.upper, position, t);
    if (position < d.lower - margin) note(load, false, d.lower, position, t);
  }
}

void StopWatch::note(const JointLoad& load, bool is_upper, double bound, double position,
                     double time) {
  const int joint =
      system_.topology().pairs[to_index(load.pair)].chain[to_index(load.element)].joint;
  const std::string& name = system_.robot().joints[to_index(joint)].name;
  const auto known =
      std::find_if(excesses_.begin(), excesses_.end(), [&](const StopExcess& excess) {
        return excess.joint == name && excess.is_upper == is_upper;
      });
  if (known == excesses_.end()) {
    excesses_.push_back({name, is_upper, bound, position, time});
  } else if (std::abs(position - bound) > std::abs(known->worst - bound)) {
    known->worst = position;
  }
}

}  // namespace codesign
