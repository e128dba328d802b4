// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/integrator.h"

#include "assembly/assembly.h"
#include "equations/formulas.h"
#include "integration/idas_integrator.h"
#include "integration/posture_sequence.h"
#include "integration/rosenbrock_integrator.h"
#include "mechanism/loop_plane.h"

namespace codesign {

void Integrator::obey(const std::atomic<bool>* cancel) {
  cancel_ = cancel;
  assembly().obey(cancel);
}

std::unique_ptr<Integrator> make_integrator(const CompiledSystem& system) {
  if (system.study().postures > 0) return std::make_unique<PostureSequence>(system);
  if (system.study().solver.integrator == IntegratorKind::kIdas)
    return std::make_unique<IdasIntegrator>(system);
  return std::make_unique<RosenbrockIntegrator>(system);
}

Status check_design(const CompiledSystem& system, const Equations<double>& equations) {
  if (std::string fault = find_impossible(system.robot(), system.topology(), equations.constants());
      !fault.empty())
    return {StatusCode::kInvalidDesign, 0.0, fault};
  for (const Pair& pair : system.topology().pairs) {
    if (pair.around.empty()) continue;
    if (const PlaneFault fault =
            find_plane_fault(system.robot(), system.topology(), pair, equations.parameters());
        !fault.message.empty())
      return {StatusCode::kInvalidDesign, 0.0,
              "loop '" + pair.name + "' is not planar: " + fault.message + ", " + fault.value};
  }
  const std::vector<ControllerDescription>& controllers = system.study().controllers;
  for (std::size_t c = 0; c < controllers.size(); ++c)
    if (std::string fault =
            find_impossible(controllers[c], equations.formulas().view().design.controllers[c]);
        !fault.empty())
      return {StatusCode::kInvalidDesign, 0.0, fault};
  return {};
}

Status assemble_start(const CompiledSystem& system, const std::vector<double>& parameters,
                      Assembly* assembly, Equations<double>* equations, State<double>* initial) {
  equations->set_design(parameters);
  if (Status status = check_design(system, *equations); !status.ok()) return status;
  Status status = assembly->solve(parameters, equations, initial);
  if (status.ok()) equations->track_turns(initial);
  return status;
}

}  // namespace codesign
