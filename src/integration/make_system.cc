// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/determined_motion.h"
#include "dynamics/mobility.h"
#include "mechanism_codesign/dynamics/assembly.h"
#include "mechanism_codesign/dynamics/redundancy.h"
#include "mechanism_codesign/dynamics/system.h"
#include "mechanism_codesign/integration/simulation.h"
#include "mechanism_codesign/integration/tableau.h"
#include "mechanism_codesign/math/decimal.h"

namespace codesign {
namespace {

/// The start values contradict a loop or a coupling.
[[noreturn]] void refuse_start(const System& system, const Assembly& assembly, const Status& status) {
  const std::string miss = "constraint error " + to_decimal(assembly.nearest_miss()) + " at the nearest", allowed = "0, to rounding";
  for (const Coupling& coupling : system.topology().couplings)
    if (coupling.name == assembly.worst_loop())
      throw InputError({coupling.where, coupling.element(), "the start values contradict it", miss, allowed});
  for (const Pair& pair : system.topology().pairs) {
    if (pair.name != assembly.worst_loop()) continue;
    for (const ChainElement& element : pair.chain)
      if (const JointDescription& loop = system.robot().joints[static_cast<std::size_t>(element.joint)]; loop.is_loop)
        throw InputError({loop.where, "<loop name=\"" + loop.name + "\">", "the loop cannot be closed at the start values", miss, allowed});
  }
  const std::vector<InitialJointState>& given = system.study().initial_state;
  const int root = system.robot().root;
  const SourceLocation where = given.empty() ? system.robot().links[static_cast<std::size_t>(root)].where : given.front().where;
  throw InputError({where, "initial_state", status.cause, "", ""});
}

/// Rank and start of a system at its start values. A design that cannot start is bad input; later ones are trial points.
bool has_redundant_constraints(const System& system) {
  Equations<double> equations(system);
  equations.compiled().allow(false);  // once is not worth the compiling
  equations.set_design(system.parameters());
  Assembly assembly(system);
  State<double> state;
  const Status status = assembly.solve(system.parameters(), &equations, &state);
  if (status.code == StatusCode::kAssemblyFailed || status.code == StatusCode::kInitialVelocityFailed)
    refuse_start(system, assembly, status);
  require_determined_motion(system, system.parameters(), assembly, &equations);
  return !analyse_redundancy(system, equations, constraint_jacobian(system, &equations, state)).rows.empty();
}

/// A billionth of what a body yields to a force: far above rounding, far below what a motion shows; theory (23).
double compliance_of(const System& system) {
  Equations<double> equations(system);
  equations.set_design(system.parameters());
  double mass = 0.0;
  for (const BodyConstants<double>& body : equations.constants().bodies) mass += body.mass;
  if (!(mass > 0.0)) mass = 1.0;  // rotors alone
  return 1e-9 * static_cast<double>(equations.constants().bodies.size()) / mass;
}

}  // namespace

std::shared_ptr<const System> make_system(const RobotDescription& robot, const Study& study) {
  if (!rosenbrock_tableau(study.solver.method))
    throw InputError({{study.file, 0}, "solver.method", "no such Rosenbrock method", study.solver.method, "rodas4, rodas4p2, rodas5p"});
  if (study.solver.integrator != "rosenbrock" && study.solver.integrator != "idas")
    throw InputError({{study.file, 0}, "solver.integrator", "no such integrator", study.solver.integrator, "rosenbrock, idas"});
  auto system = std::make_shared<const System>(robot, study);
  if (has_redundant_constraints(*system)) return std::make_shared<const System>(robot, study, compliance_of(*system));
  return system;
}

Counts count_equations(const std::shared_ptr<const System>& system, const std::vector<double>& parameters, Status* status) {
  const Layout& layout = system->layout();
  Counts counts;
  counts.bodies = layout.bodies;
  counts.coordinates = layout.n;
  counts.first_order_equations = 2 * layout.n;
  counts.controller_states = layout.states;
  counts.constraints = layout.m;
  counts.parameters = static_cast<int>(system->study().tuned.size());
  Equations<double> equations(*system);
  equations.compiled().allow(false);
  equations.set_design(parameters);
  Assembly assembly(*system);
  State<double> state;
  *status = assembly.solve(parameters, &equations, &state);
  if (status->code == StatusCode::kAssemblyFailed) return counts;
  const Redundancy redundancy = analyse_redundancy(*system, equations, constraint_jacobian(*system, &equations, state));
  counts.redundant_rows = redundancy.rows;
  counts.undetermined_reactions = redundancy.undetermined;
  counts.chosen_friction = redundancy.friction_chosen;
  counts.redundant_constraints = static_cast<int>(counts.redundant_rows.size());
  counts.degrees_of_freedom = layout.n - (layout.m - counts.redundant_constraints);
  if (counts.redundant_constraints > 0)
    counts.degrees_of_freedom -= motions_lost_to_curvature(*system, parameters, assembly, &equations);
  counts.dynamic_equations = counts.first_order_equations + counts.constraints;
  counts.sensitivities = counts.parameters * counts.dynamic_equations;
  counts.total_equations = counts.dynamic_equations + counts.sensitivities;
  return counts;
}

}  // namespace codesign
