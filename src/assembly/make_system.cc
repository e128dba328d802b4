// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/make_system.h"

#include <algorithm>

#include "assembly/determined_motion.h"
#include "assembly/redundancy.h"
#include "assembly/signal_warnings.h"
#include "assembly/start_workspace.h"
#include "mechanism/signal_catalog.h"
#include "text/decimal.h"

namespace codesign {
namespace {

std::string miss_text(const LoopMiss& miss) {
  return to_decimal(1e3 * miss.length) + " mm and " + to_decimal(miss.angle) + " rad at the nearest";
}

/// The loop or coupling of a name, with its place.
InputFault fault_of(const CompiledSystem& system, const std::string& name) {
  for (const Coupling& coupling : system.topology().couplings)
    if (coupling.name == name) return {coupling.where, coupling.element(), "", "", ""};
  for (const Pair& pair : system.topology().pairs)
    for (const ChainElement& element : pair.chain)
      if (const JointDescription& loop = system.robot().joints[static_cast<std::size_t>(element.joint)]; pair.name == name && loop.is_loop)
        return {loop.where, "<loop name=\"" + loop.name + "\">", "", "", ""};
  const int root = system.robot().root;
  return {system.robot().links[static_cast<std::size_t>(root)].where, "initial_state", "", "", ""};
}

/// The start values contradict a loop or a coupling.
[[noreturn]] void refuse_start(const CompiledSystem& system, const Assembly& assembly, const Status& status) {
  InputFault fault = fault_of(system, status.code == StatusCode::kAssemblyFailed ? assembly.worst_miss().owner : "");
  fault.message = status.cause;
  const std::vector<InitialJointState>& given = system.study().initial_state;
  const std::vector<std::size_t>& contradicting = assembly.contradicting();
  if (!given.empty() && fault.element == "initial_state") fault.where = given[contradicting.empty() ? 0 : contradicting.front()].where;
  if (status.code != StatusCode::kAssemblyFailed) throw InputError(fault);
  const std::string tolerance = to_decimal(system.study().solver.closure_tolerance);
  fault.message = fault.element.rfind("<loop", 0) == 0 ? "the loop cannot be closed at the start values" : "the start values contradict it";
  fault.value = "misses by " + miss_text(assembly.worst_miss());
  fault.allowed = to_decimal(1e3 * system.study().solver.closure_tolerance) + " mm and " + tolerance +
                  " rad, solver.closure_tolerance; correct the origins and axes on the way around the loop, give joints another "
                  "initial_state guess or fewer positions, or allow a larger miss";
  throw InputError(fault);
}

/// A loop that closes only nearly, as one with rounded angles does.
void warn_of_miss(const CompiledSystem& system, const LoopMiss& miss, Warnings* warnings) {
  constexpr double kRounding = 1e-9;
  if (!(std::max(miss.length, miss.angle) > kRounding)) return;
  InputFault fault = fault_of(system, miss.owner);
  fault.message =
      "the origins and axes around the loop do not close it exactly; the constraints that follow from the others are left to miss by about "
      "as much; to silence this, write lengths and angles with all their digits, a right angle as 1.5707963267948966";
  fault.value = miss_text(miss);
  fault.allowed = "0, to rounding; solver.closure_tolerance " + to_decimal(system.study().solver.closure_tolerance);
  append({warn("inexact_loop", fault)}, warnings);
}

void warn_of_friction(const CompiledSystem& system, const Redundancy& redundancy, Warnings* warnings) {
  for (int joint : redundancy.chosen_joints) {
    const JointDescription& description = system.robot().joints[static_cast<std::size_t>(joint)];
    append(
        {warn(
            "undetermined_friction",
            {description.where, (description.is_loop ? "<loop name=\"" : "<joint name=\"") + description.name + "\">",
             "friction rests on a reaction that nothing determines, because constraints of the loop follow from each other; the reactions "
             "of least norm are taken; to silence this, give one joint of the loop the freedom that it has in fact, as "
             "codesign:spherical or codesign:cylindrical",
             "", ""})},
        warnings);
  }
}

/// A billionth of what a body yields to a force: far above rounding, far below what a motion shows; theory (23).
double compliance_of(const Equations<double>& equations) {
  double mass = 0.0;
  for (const BodyConstants<double>& body : equations.constants().bodies) mass += body.mass;
  if (!(mass > 0.0)) mass = 1.0;  // rotors alone
  return 1e-9 * static_cast<double>(equations.constants().bodies.size()) / mass;
}

/// Whether redundant rows must be dropped: where they contradict each other a little, or where friction follows from the reactions that
/// they leave open, so that rounding divided by a compliance would be felt. Elsewhere all rows stay, which holds however far the mechanism
/// turns.
bool must_drop(const LoopMiss& miss, const Redundancy& redundancy) {
  constexpr double kExact = 1e-12;  // [m and rad] a miss that a compliance of 1e-9 turns into no load worth speaking of
  return std::max(miss.length, miss.angle) > kExact || !redundancy.friction_chosen.empty();
}

/// The system with its redundant constraints handled. A design that cannot start is bad input; later designs are trial points.
std::shared_ptr<const CompiledSystem> with_sharing(std::shared_ptr<const CompiledSystem> system, Warnings* warnings) {
  StartWorkspace start(*system, system->parameters());
  const Status status = start.solve_positions();
  if (!status.ok()) refuse_start(*system, start.assembly, status);
  require_determined_motion(*system, start.parameters, start.assembly, &start.equations);
  const LoopMiss& miss = start.assembly.worst_miss();
  warn_of_miss(*system, miss, warnings);
  Redundancy redundancy = analyse_redundancy(*system, &start.equations, start.assembly, start.parameters, start.state);
  if (redundancy.rows.empty()) return system;
  warn_of_friction(*system, redundancy, warnings);
  append(warn_of_open_reactions(*system, redundancy, start.state, signals_of(system->study()), &start.equations), warnings);
  if (!must_drop(miss, redundancy)) redundancy.sharing = ReactionSharing();
  redundancy.sharing.compliance = compliance_of(start.equations);
  return std::make_shared<const CompiledSystem>(system->robot(), system->study(), redundancy.sharing);
}

void check_start(const CompiledSystem& system) {
  StartWorkspace start(system, system.parameters());
  const Status status = start.solve_motion();
  if (status.code == StatusCode::kAssemblyFailed || status.code == StatusCode::kInitialVelocityFailed)
    refuse_start(system, start.assembly, status);
}

}  // namespace

std::shared_ptr<const CompiledSystem> make_system(const RobotDescription& robot, const Study& study, Warnings* warnings) {
  Warnings found;
  std::shared_ptr<const CompiledSystem> system = with_sharing(std::make_shared<const CompiledSystem>(robot, study), &found);
  check_start(*system);
  if (warnings) append(found, warnings);
  return system;
}

}  // namespace codesign
