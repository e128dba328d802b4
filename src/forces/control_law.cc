// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/control_law.h"

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

}  // namespace

const ControlLaw kPidLaw{"pid", {pid, pid}, I::kSignal, "pid", true, L::kNone, true},
    kPdGravityLaw{"pd_gravity", {pd_gravity, pd_gravity}, I::kOwnPosition, "pd", true, L::kAtRest},
    kComputedTorqueLaw{"computed_torque", {computed_torque, computed_torque}, I::kOwnPosition, "pd", true, L::kDemanded},
    kStateFeedbackLaw{"state_feedback", {as_given, as_given}, I::kFeedback}, kBasisLaw{"basis", {as_given, as_given}, I::kShape};

}  // namespace codesign
