// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/make_system.h"

#include <algorithm>
#include <optional>

#include "assembly/assembly.h"
#include "assembly/change_point.h"
#include "assembly/determined_motion.h"
#include "assembly/reaction_advice.h"
#include "assembly/redundancy.h"
#include "assembly/start_beyond_stop.h"
#include "assembly/start_overlap.h"
#include "description/study.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/signal_catalog.h"
#include "text/number_text.h"

namespace codesign {
namespace {

std::string miss_text(const LoopMiss& miss) {
  return to_decimal(1e3 * miss.length) + " mm and " + to_decimal(miss.angle) +
         " rad at the closest position found";
}

/// Where in the input a loop or coupling of this name stands; the root link's place if there is
/// none.
InputFault fault_of(const CompiledSystem& system, std::string_view name) {
  for (const Coupling& coupling : system.topology().couplings)
    if (coupling.name == name) return {coupling.where, coupling.element(), "", "", ""};
  for (const Pair& pair : system.topology().pairs)
    for (const ChainElement& element : pair.chain)
      if (const JointDescription& loop = system.robot().joints[to_index(element.joint)];
          pair.name == name && loop.is_loop)
        return {loop.where, loop.element(), "", "", ""};
  const int root = system.robot().root;
  return {system.robot().links[to_index(root)].where, "initial_state", "", "", ""};
}

/// Throws for a start whose positions or velocities contradict a loop or coupling.
void require_start(const CompiledSystem& system, const Assembly& assembly, const Status& status) {
  if (status.code != StatusCode::kAssemblyFailed &&
      status.code != StatusCode::kInitialVelocityFailed)
    return;
  InputFault fault =
      fault_of(system, status.code == StatusCode::kAssemblyFailed ? assembly.worst_miss().owner
                                                                  : std::string_view());
  fault.message = status.cause;
  const std::vector<InitialJointState>& given = system.study().initial_state;
  const std::vector<std::size_t>& contradicting = assembly.contradicting();
  if (!given.empty() && fault.element == "initial_state")
    fault.where = given[contradicting.empty() ? 0 : contradicting.front()].where;
  if (status.code != StatusCode::kAssemblyFailed) throw InputError(fault);
  const std::string tolerance = to_decimal(system.study().solver.closure_tolerance);
  fault.message = fault.element.rfind("<loop", 0) == 0
                      ? "the loop cannot be closed at the start values"
                      : "the start values contradict it";
  fault.value = "misses by " + miss_text(assembly.worst_miss());
  fault.allowed = to_decimal(1e3 * system.study().solver.closure_tolerance) + " mm and " +
                  tolerance +
                  " rad, solver.closure_tolerance; correct the origins and axes on the way around "
                  "the loop, give joints another "
                  "initial_state guess or fewer positions, or allow a larger miss";
  const double tolerated = system.study().solver.closure_tolerance;
  if (assembly.worst_miss().length <= tolerated && assembly.worst_miss().angle <= tolerated) {
    // Redundant rows are dropped, and the others must close to rounding.
    fault.message = "the positions of initial_state leave no joint free to close the loop";
    fault.allowed =
        "0, to rounding; of the joints around the loop give only as many a position as it has "
        "degrees of freedom, the others a guess";
  }
  throw InputError(fault);
}

/// Warns of a loop that closes within the tolerance but not to rounding, as with rounded angles in
/// the file.
void warn_of_miss(const CompiledSystem& system, const LoopMiss& miss, Warnings* warnings) {
  constexpr double kRounding = 1e-9;
  if (!(std::max(miss.length, miss.angle) > kRounding)) return;
  InputFault fault = fault_of(system, miss.owner);
  fault.message =
      "the origins and axes around the loop do not close it exactly; redundant constraints are not "
      "enforced and stay violated by about "
      "this amount; to remove the warning, write lengths and angles with all their digits, a right "
      "angle as 1.5707963267948966";
  fault.value = miss_text(miss);
  fault.allowed = "0, to rounding; solver.closure_tolerance " +
                  to_decimal(system.study().solver.closure_tolerance);
  append({warn("inexact_loop", fault)}, warnings);
}

/// Compliance epsilon of the redundant rows [1/kg], doc/theory.md (23): 1e-9 over the mean mass of
/// the bodies. Far above rounding, and its effect on a motion is far below any tolerance.
double compliance_of(const Equations<double>& equations) {
  double mass = 0.0;
  for (const BodyConstants<double>& body : equations.constants().bodies) mass += body.mass;
  if (!(mass > 0.0)) mass = 1.0;  // all inertia is in rotors
  return 1e-9 * static_cast<double>(equations.constants().bodies.size()) / mass;
}

/// Whether redundant rows must be dropped: if they contradict each other by more than rounding, or
/// if friction depends on reactions that are not unique, where rounding divided by the compliance
/// would change the motion. Otherwise all rows stay enforced, which remains right at positions far
/// from the start.
bool must_drop(const LoopMiss& miss, const Redundancy& redundancy) {
  // [m and rad] a smaller miss, divided by a compliance of 1e-9, gives a negligible load.
  constexpr double kExact = 1e-12;
  return std::max(miss.length, miss.angle) > kExact || !redundancy.friction_chosen.empty();
}

/// Warns of friction that depends on reactions that rigid bodies do not determine. @param system
/// with the sharing that was chosen.
Warning undetermined_friction(const CompiledSystem& system, const Redundancy& redundancy) {
  constexpr double kNoEffect = 1e-3;
  StartWorkspace start(system, system.parameters());
  const bool starts = start.solve().ok();
  const double effect =
      starts ? effect_of_sharing(system, redundancy, start.state, &start.equations) : -1.0;
  const std::vector<Release> releases =
      releases_for_friction(system, redundancy, start.state, &start.equations);
  const RobotDescription& robot = system.robot();
  const JointDescription& first = robot.joints[to_index(redundancy.chosen_joints.front())];
  std::string message =
      "friction of " + name_list(robot, redundancy.chosen_joints) +
      " depends on reactions that are not unique, because their loops have redundant constraints; ";
  message += effect >= 0.0 && effect < kNoEffect
                 ? "under the loads at the start the part that is not unique changes friction by "
                   "less than 1e-3 of the largest, however "
                   "bearings share it, so that nothing needs to be done unless loads across the "
                   "mechanism's plane come later; "
                 : "the reactions of least norm are used; ";
  return warn(
      "undetermined_friction",
      {first.where, first.element(),
       message + advice_of(robot, releases) + plane_advice(system, redundancy.sharing), "", ""});
}

/// Between the steps of idas a compliance of 1e-9 turns violations of redundant rows, which are
/// within its tolerance, into forces. Free mechanisms give way to them, driven ones cannot.
void refuse_idas(const MotionStudy& study, const Redundancy& redundancy) {
  if (study.motion.empty() || study.solver.integrator != IntegratorKind::kIdas ||
      !redundancy.sharing.dropped.empty())
    return;
  throw InputError({study.motion.front().where, "motion." + study.motion.front().joint,
                    "idas cannot give the motion of a mechanism with redundant constraints",
                    redundancy.rows.front().joint, "solver: {integrator: rosenbrock}"});
}

/// How redundant constraints are handled, Redundancy::sharing, doc/theory.md (23); nothing if there
/// are none. @param start positions at which they are found.
std::optional<Redundancy> find_sharing(const CompiledSystem& system, StartWorkspace* start,
                                       Warnings* warnings) {
  const LoopMiss& miss = start->assembly.worst_miss();
  warn_of_miss(system, miss, warnings);
  Redundancy redundancy = analyse_redundancy(system, &start->equations, start->assembly,
                                             start->parameters, start->state);
  if (redundancy.rows.empty()) return std::nullopt;
  append(warn_of_open_reactions(system, redundancy, start->state, signals_of(system.study()),
                                &start->equations),
         warnings);
  if (!must_drop(miss, redundancy)) redundancy.sharing.dropped.clear();
  refuse_idas(system.study(), redundancy);
  redundancy.sharing.compliance = compliance_of(start->equations);
  return redundancy;
}

/// A compliance of all loops where a given motion passes a position in which several motions meet,
/// with a warning; else nothing. Without it the equations are singular there.
std::optional<ReactionSharing> find_change_point(const CompiledSystem& system, Warnings* warnings) {
  StartWorkspace start(system, system.parameters());
  if (system.study().motion.empty() || !start.solve_positions().ok()) return std::nullopt;
  const std::optional<double> time = first_change_point(system, &start);
  if (!time) return std::nullopt;
  const GivenMotion& motion = system.study().motion.front();
  append({warn("change_point",
               {motion.where, "motion." + motion.joint,
                "the given motion passes a singular position, such as a linkage that lies flat, "
                "where several motions of its loops meet; the run goes on along the motion before "
                "it, with a compliance of the loops of 1e-9 over their mean mass, and efforts and "
                "reactions are not determined in the position itself; end the study before it to "
                "silence this",
                "near t = " + readable(*time, 3) + " s", ""})},
         warnings);
  return ReactionSharing(compliance_of(start.equations));
}

/// The same study in absolute coordinates, for couplings that imply each other: the reactions of
/// all joints between them are shared, (23).
/// @throws InputError if the study asks for joint coordinates.
Study in_absolute_coordinates(const Study& study, bool is_chosen, const Redundancy& redundancy) {
  if (!is_chosen)
    throw InputError({study.solver.coordinates_where, "solver.coordinates",
                      "couplings with redundant constraints, whose reactions are shared among all "
                      "joints: not available in joint coordinates",
                      redundancy.rows.front().joint, "auto or absolute"});
  Study absolute = study;
  absolute.solver.coordinates = CoordinatesKind::kAbsolute;
  return absolute;
}

/// @param is_chosen whether the coordinates were chosen for the study, which then may have others.
/// @param known pairs whose reactions are shared, so that they have rows
std::shared_ptr<const CompiledSystem> make_system(const RobotDescription& robot, const Study& study,
                                                  bool is_chosen, const ReactionSharing& known,
                                                  Warnings* warnings) {
  Warnings found;
  const auto system = std::make_shared<const CompiledSystem>(robot, study, known);
  StartWorkspace start(*system, system->parameters());
  const Status positions = start.solve_positions();
  require_free_drives(*system, start.parameters, start.assembly, start.equations);
  require_start(*system, start.assembly, positions);
  append(start.assembly.warnings(), &found);
  if (positions.ok()) {
    append(starts_beyond_stops(*system, start.state, &start.equations), &found);
    append(find_overlaps(*system, start.state, &start.equations), &found);
  }
  require_determined_motion(*system, start.parameters, start.assembly, &start.equations);
  if (const Layout& layout = system->layout(); layout.has_forest()) {
    const Redundancy in_loops = analyse_redundancy(*system, &start.equations, start.assembly,
                                                   start.parameters, start.state);
    if (!in_loops.sharing.couplings.empty())
      return make_system(robot, in_absolute_coordinates(study, is_chosen, in_loops), false, {},
                         warnings);
    ReactionSharing loops;
    loops.pairs = in_loops.sharing.pairs;
    if (!std::all_of(loops.pairs.begin(), loops.pairs.end(),
                     [&](int pair) { return layout.is_cut(pair); }))
      return make_system(robot, study, is_chosen, loops, warnings);
  }
  const std::optional<Redundancy> redundancy = find_sharing(*system, &start, &found);
  std::shared_ptr<const CompiledSystem> result = system;
  if (redundancy)
    result = std::make_shared<const CompiledSystem>(system->robot(), system->whole_study(),
                                                    redundancy->sharing);
  else if (const std::optional<ReactionSharing> yields = find_change_point(*system, &found))
    result =
        std::make_shared<const CompiledSystem>(system->robot(), system->whole_study(), *yields);
  if (result->sharing().drops()) {
    // With fewer rows enforced, other positions can start, and other velocities contradict.
    StartWorkspace enforced(*result, result->parameters());
    require_start(*result, enforced.assembly, enforced.solve_motion());
  } else {
    require_start(*system, start.assembly, start.solve_velocities());
  }
  if (redundancy && !redundancy->chosen_joints.empty())
    append({undetermined_friction(*result, *redundancy)}, &found);
  if (warnings) append(found, warnings);
  return result;
}

/// As the public one, with the integrator that the study names.
std::shared_ptr<const CompiledSystem> make_chosen(const RobotDescription& robot, const Study& study,
                                                  Warnings* warnings) {
  if (study.solver.coordinates == CoordinatesKind::kAuto) {
    Study chosen = study;
    chosen.solver.coordinates = System(robot, study).best_coordinates();
    return make_system(robot, chosen, true, {}, warnings);
  }
  return make_system(robot, study, false, {}, warnings);
}

Warning other_integrator(const Study& study) {
  return warn("other_integrator",
              {{study.file, 1},
               "solver.integrator",
               "idas does not locate the instants at which expressions switch, and gradients would "
               "lose what happens there: the runs of this study take rosenbrock",
               "idas",
               "rosenbrock; or expressions without comparisons, sign, abs, min, max and floor, and "
               "terms with the loss square or soft_l1"});
}

}  // namespace

// The study's own design must start; a later design that cannot is a trial point with a failed
// status.
std::shared_ptr<const CompiledSystem> make_system(const RobotDescription& robot, const Study& study,
                                                  Warnings* warnings) {
  Warnings found;
  std::shared_ptr<const CompiledSystem> system = make_chosen(robot, study, &found);
  if (study.solver.integrator == IntegratorKind::kIdas && system->has_switches()) {
    Study located = study;
    located.solver.integrator = IntegratorKind::kRosenbrock;
    found = {other_integrator(study)};
    system = make_chosen(robot, located, &found);
  }
  if (warnings) append(found, warnings);
  return system;
}

}  // namespace codesign
