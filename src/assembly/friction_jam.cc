// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/friction_jam.h"

#include <cmath>

#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {
namespace {

/// Whether the joint with the friction of a pair slides at the loaded state; true if it has no
/// single coordinate.
bool slides(const CompiledSystem& system, int pair, Equations<double>* equations) {
  constexpr double kStill = 1e-9;  // [rad/s or m/s]
  const Pair& p = system.topology().pairs[to_index(pair)];
  const auto& coordinates = equations->constants().pairs[to_index(pair)].coordinates;
  for (std::size_t e = 0; e < p.chain.size() && e < coordinates.size(); ++e) {
    if (p.chain[e].joint != p.friction_joint) continue;
    if (coordinates[e].kind == CoordinateConstants<double>::Kind::kNone) return true;
    const double rate = equations->formulas().coordinate(pair, static_cast<int>(e)).rate;
    return !(std::abs(rate) < kStill);
  }
  return true;
}

}  // namespace

std::string rubbing_joints(const CompiledSystem& system, const State<double>& state,
                           Equations<double>* equations) {
  std::string sliding, all;
  const auto add = [](const std::string& name, std::string* list) {
    *list += (list->empty() ? "'" : ", '") + name + "'";
  };
  equations->formulas().load(state);
  const std::vector<Pair>& pairs = system.topology().pairs;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (pairs[p].friction_joint < 0 || pairs[p].friction_is_direct) continue;
    const std::string& name = system.robot().joints[to_index(pairs[p].friction_joint)].name;
    add(name, &all);
    if (slides(system, static_cast<int>(p), equations)) add(name, &sliding);
  }
  return sliding.empty() ? all : sliding;
}

std::string jam_advice(const CompiledSystem& system, const State<double>& state,
                       Equations<double>* equations) {
  const std::string joints = rubbing_joints(system, state, equations);
  if (joints.empty()) return "";
  return "the friction of " + joints +
         " grows faster with the reactions there than they can balance it (a jam): smaller "
         "mu_static and mu_dynamic, a bearing with a longer joint_length or smaller pin_radius, "
         "or a start that rests, moves the other way or has another posture";
}

}  // namespace codesign
