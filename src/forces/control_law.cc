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

constexpr ControlLaw make_row(const char* name, Law<ControlFunction> output, ControlInput input) {
  ControlLaw law;
  law.name = name;
  law.output = output;
  law.input = input;
  return law;
}

constexpr ControlLaw computed_torque_law() {
  ControlLaw law =
      make_row("computed_torque", {computed_torque, computed_torque}, ControlInput::kOwnPosition);
  law.gains = "pd";
  law.load = ControlLoad::kDemanded;
  law.reads_rate = true;
  return law;
}

constexpr ControlLaw pd_gravity_law() {
  ControlLaw law = make_row("pd_gravity", {pd_gravity, pd_gravity}, ControlInput::kOwnPosition);
  law.gains = "pd";
  law.load = ControlLoad::kAtRest;
  law.reads_rate = true;
  return law;
}

constexpr ControlLaw pid_law() {
  ControlLaw law = make_row("pid", {pid, pid}, ControlInput::kSignal);
  law.gains = "pid";
  law.reads_rate = true;
  law.is_pid = true;
  return law;
}

constexpr ControlLaw kControlTable[] = {
    make_row("basis", {as_given, as_given}, ControlInput::kShape),
    computed_torque_law(),
    pd_gravity_law(),
    pid_law(),
    make_row("state_feedback", {as_given, as_given}, ControlInput::kFeedback),
    make_row("observer", {as_given, as_given}, ControlInput::kObserved),
};

}  // namespace

static_assert(std::string_view(kControlTable[0].name) == "basis" &&
                  std::string_view(kControlTable[5].name) == "observer",
              "the constants below count rows: append new ones");
const ControllerKind ControllerKind::kBasis{kControlTable[0]},
    ControllerKind::kComputedTorque{kControlTable[1]}, ControllerKind::kPdGravity{kControlTable[2]},
    ControllerKind::kPid{kControlTable[3]}, ControllerKind::kStateFeedback{kControlTable[4]},
    ControllerKind::kObserver{kControlTable[5]};

std::vector<ControllerKind> control_laws() {
  return std::vector<ControllerKind>(std::begin(kControlTable), std::end(kControlTable));
}

}  // namespace codesign
