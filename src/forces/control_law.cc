// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/control_law.h"

#include <iterator>
#include <string_view>

#include "codegen/traced.h"

namespace codesign {
namespace {

template <class T>
T pid(const ControlValues<T>& x) {
  return x.pid();
}

template <class T>
T pd_gravity(const ControlValues<T>& x) {
  return x.pid() + x.load;
}

template <class T>
T computed_torque(const ControlValues<T>& x) {
  return x.load;
}

template <class T>
T as_given(const ControlValues<T>& x) {
  return x.given;
}

using I = ControlInput;
using L = ControlLoad;

// name, output, gains, input, load, reads_rate, is_pid
constexpr ControlLaw kControlTable[] = {
    {"basis", {as_given, as_given}, "", I::kShape},
    {"computed_torque",
     {computed_torque, computed_torque},
     "pd",
     I::kOwnPosition,
     L::kDemanded,
     true},
    {"pd_gravity", {pd_gravity, pd_gravity}, "pd", I::kOwnPosition, L::kAtRest, true},
    {"pid", {pid, pid}, "pid", I::kSignal, L::kNone, true, true},
    {"state_feedback", {as_given, as_given}, "", I::kFeedback},
};

}  // namespace

static_assert(std::string_view(kControlTable[0].name) == "basis" &&
                  std::string_view(kControlTable[4].name) == "state_feedback",
              "the constants below count rows: append new ones");
const ControllerKind ControllerKind::kBasis{kControlTable[0]},
    ControllerKind::kComputedTorque{kControlTable[1]}, ControllerKind::kPdGravity{kControlTable[2]},
    ControllerKind::kPid{kControlTable[3]}, ControllerKind::kStateFeedback{kControlTable[4]};

std::vector<ControllerKind> control_laws() {
  return std::vector<ControllerKind>(std::begin(kControlTable), std::end(kControlTable));
}

}  // namespace codesign
