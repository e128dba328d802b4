// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/QR>

#include "mechanism_codesign/dynamics/assembly.h"
#include "mechanism_codesign/dynamics/system.h"
#include "mechanism_codesign/integration/simulation.h"
#include "mechanism_codesign/integration/tableau.h"
#include "mechanism_codesign/math/decimal.h"

namespace codesign {
namespace {

constexpr double kRankTolerance = 1e-9;

/// Phi_q at a state, dense.
Eigen::MatrixXd constraint_jacobian(const System& system, Equations<double>* equations, const State<double>& state) {
  Linearization<double> d;
  d.resize(system.patterns());
  equations->linearize(state, &d);
  const Layout& layout = system.layout();
  const Sparsity& G_z = system.patterns().rate;
  Eigen::MatrixXd Phi_q = Eigen::MatrixXd::Zero(layout.m, layout.n);
  for (int row = 0; row < layout.m; ++row)
    for (int e = G_z.first(layout.lambda_column(row)); e < G_z.first(layout.lambda_column(row) + 1); ++e)
      if (G_z.column(e) < layout.n) Phi_q(row, G_z.column(e)) = d.rate[static_cast<std::size_t>(e)];
  return Phi_q;
}

/// Rows that depend on the others, each described by its joint.
std::vector<std::string> redundant_rows(const System& system, const Eigen::MatrixXd& Phi_q) {
  std::vector<std::string> names;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kRankTolerance);
  qr.compute(Phi_q.transpose());
  for (Eigen::Index k = qr.rank(); k < Phi_q.rows(); ++k) {
    const int row = static_cast<int>(qr.colsPermutation().indices()[k]);
    std::size_t pair = system.layout().pair_row.size();
    while (pair > 0 && system.layout().pair_row[pair - 1] > row) --pair;
    names.push_back("row " + std::to_string(row - system.layout().pair_row[pair - 1] + 1) + " of joint '" +
                    system.topology().pairs[pair - 1].name + "'");
  }
  return names;
}

const JointDescription* loop_of(const System& system, const std::string& pair_name) {
  for (const Pair& pair : system.topology().pairs)
    if (pair.name == pair_name)
      for (const ChainElement& element : pair.chain)
        if (system.robot().joints[static_cast<std::size_t>(element.joint)].is_loop)
          return &system.robot().joints[static_cast<std::size_t>(element.joint)];
  return nullptr;
}

/// Rank and start of a system at its start values. A design that cannot start is bad input; later ones are trial points.
bool has_redundant_constraints(const System& system) {
  Equations<double> equations(system);
  equations.set_design(system.parameters());
  Assembly assembly(system);
  State<double> state;
  const Status status = assembly.solve(system.parameters(), &equations, &state);
  if (status.code != StatusCode::kAssemblyFailed && status.code != StatusCode::kInitialVelocityFailed)
    return !redundant_rows(system, constraint_jacobian(system, &equations, state)).empty();
  const JointDescription* loop = loop_of(system, assembly.worst_loop());
  if (loop)
    throw InputError({loop->where, "<loop name=\"" + loop->name + "\">", "the loop cannot be closed at the start values",
                      "constraint error " + to_decimal(assembly.nearest_miss()) + " at the nearest", "0, to rounding"});
  throw InputError({{system.study().file, 0}, "initial_state", status.cause, "", ""});
}

/// A billionth of what a body yields to a force: far above rounding, far below what a motion shows; theory (23).
double compliance_of(const System& system) {
  Equations<double> equations(system);
  equations.set_design(system.parameters());
  double mass = 0.0;
  for (const BodyConstants<double>& body : equations.constants().bodies) mass += body.mass;
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
  equations.set_design(parameters);
  Assembly assembly(*system);
  State<double> state;
  *status = assembly.solve(parameters, &equations, &state);
  if (status->code == StatusCode::kAssemblyFailed) return counts;
  counts.redundant_rows = redundant_rows(*system, constraint_jacobian(*system, &equations, state));
  counts.redundant_constraints = static_cast<int>(counts.redundant_rows.size());
  counts.degrees_of_freedom = layout.n - (layout.m - counts.redundant_constraints);
  counts.dynamic_equations = counts.first_order_equations + counts.constraints;
  counts.sensitivities = counts.parameters * counts.dynamic_equations;
  counts.total_equations = counts.dynamic_equations + counts.sensitivities;
  return counts;
}

}  // namespace codesign
