// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/run_jumps.h"

#include <algorithm>

namespace codesign {

namespace {

void take_change(const ModeChange& change, RunJump* jump) {
  jump->guard = change.guard;
  if (jump->guard < 0) return;
  jump->guard_rate = change.guard_rate;
  jump->rates = change.before.z - change.behind.z;
  jump->integrand_jump = change.g_before - change.g;
}

}  // namespace

RunJump run_jump(int point, const ModeChange& change) {
  RunJump jump;
  jump.point = point;
  jump.mode = change.mode;
  take_change(change, &jump);
  return jump;
}

void RunJumps::append(int point, const RosenbrockIntegrator& run) {
  if (count_ == jumps_.size()) jumps_.emplace_back();
  RunJump& jump = jumps_[count_++];
  jump.point = point;
  jump.mode = run.mode();
  jump.events = run.jump_events();
  take_change(run.mode_change(), &jump);
}

std::size_t RunJumps::after(int point) const {
  const auto begin = jumps_.begin(), end = begin + to_signed(count_);
  return to_index(
      std::upper_bound(begin, end, point,
                       [](int number, const RunJump& jump) { return number < jump.point; }) -
      begin);
}

const RunJump* RunJumps::at(int point) const {
  const std::size_t jumps = after(point);
  return jumps > 0 && jumps_[jumps - 1].point == point ? &jumps_[jumps - 1] : nullptr;
}

}  // namespace codesign
