// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "math/lanes.h"

namespace codesign {

/// The tuned parameters rho_first, ..., rho_(first+count-1), count <= N, each with one of N lanes.
template <int N>
struct LaneRange {
  int first = 0, count = 0;

  /// All named parameters (Study::parameters order), with the derivative 1 of rho_(first+k) in lane k. @param lanes overwritten, its memory
  /// is used again.
  void seed(const CompiledSystem& system, const std::vector<double>& parameters, std::vector<Lanes<N>>* lanes) const {
    lanes->assign(parameters.begin(), parameters.end());
    for (int k = 0; k < count; ++k) {
      const int tuned = system.study().tuned[static_cast<std::size_t>(first + k)];
      (*lanes)[static_cast<std::size_t>(tuned)].v[k] = 1.0;
    }
  }
  std::vector<Lanes<N>> seed(const CompiledSystem& system, const std::vector<double>& parameters) const {
    std::vector<Lanes<N>> lanes;
    seed(system, parameters, &lanes);
    return lanes;
  }
};

/// The lanes `first` .. `first + value - 1` to be divided into groups; each group reserves `reserved` further lanes for its own use.
struct LaneCount {
  int value = 0, reserved = 0, first = 0;
};

/// Divides lanes into groups of eight; a last group of four lanes or fewer is a Group<4>. Without a LaneCount there is one lane per tuned
/// parameter. Group<N> is constructed from (system, LaneRange<N>, further arguments).
template <template <int> class Group>
class LaneGroups {
 public:
  template <class... Arguments>
  explicit LaneGroups(const CompiledSystem& system, const Arguments&... arguments)
      : LaneGroups(LaneCount{static_cast<int>(system.study().tuned.size())}, system, arguments...) {}
  template <class... Arguments>
  LaneGroups(LaneCount lanes, const CompiledSystem& system, const Arguments&... arguments) {
    const int end = lanes.first + lanes.value;
    int first = lanes.first;
    const int wide = 8 - lanes.reserved;
    for (; end - first > 4 - lanes.reserved; first += wide)
      wide_.push_back(std::make_unique<Group<8>>(system, LaneRange<8>{first, std::min(wide, end - first)}, arguments...));
    if (first < end) narrow_.push_back(std::make_unique<Group<4>>(system, LaneRange<4>{first, end - first}, arguments...));
  }

  template <class Action>
  void for_each(const Action& action) {
    for (auto& group : wide_) action(group.get());
    for (auto& group : narrow_) action(group.get());
  }

 private:
  std::vector<std::unique_ptr<Group<8>>> wide_;
  std::vector<std::unique_ptr<Group<4>>> narrow_;
};

}  // namespace codesign
