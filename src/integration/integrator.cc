// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/integrator.h"

#include "assembly/assembly.h"
#include "equations/formulas.h"
#include "integration/idas_integrator.h"
#include "integration/posture_sequence.h"
#include "integration/rosenbrock_integrator.h"
#include "mechanism/loop_plane.h"
#include "text/number_text.h"

namespace codesign {

void Integrator::obey(const std::atomic<bool>* cancel) {
  cancel_ = cancel;
  assembly().obey(cancel);
}

double Integrator::of_losses(double integral, double terminal) {
  const double psi = integral + terminal;
  if (!(psi < 0.0)) return psi;
  const auto& design = equations().formulas().view().design;
  for (const std::vector<double>* weights : {&design.integral.weights, &design.terminal.weights})
    for (const double weight : *weights)
      if (!(weight >= 0.0)) return psi;
  return 0.0;
}

Status Integrator::check_end(const MotionStudy& study, const std::vector<double>& parameters) {
  if (!study.duration_of_design) return {};
  const double end = duration_at(study, parameters);
  // Rounding alone may lead beyond the bounds.
  constexpr double kRounding = 1e-12;
  if (end > 0.0 && end <= study.duration * (1.0 + kRounding)) return {};
  return {StatusCode::kInvalidDesign, 0.0,
          "duration: " + readable(end) + " s, which must be above 0 s and at most " +
              readable(study.duration) + " s, as the bounds of its parameters allow"};
}

Status Integrator::begin_run(const MotionStudy& study, const std::vector<double>& parameters) {
  is_ended_ = false;
  end_ = duration_at(study, parameters);
  return check_end(study, parameters);
}

void Integrator::go_on_run(const MotionStudy& study, const std::vector<double>& parameters,
                           bool between) {
  end_ = duration_at(study, parameters);
  is_ended_ = is_ended_ && !between;
}

Warnings Integrator::end_warnings(const MotionStudy& study) const {
  if (!study.until || is_ended_ || state().t < end_) return {};
  return {warn("until_not_reached",
               {study.until->where, "until",
                "the condition did not become true within the duration, " + readable(end_) +
                    " s, where the run ended",
                study.until->text, "a longer duration, or a condition that the motion meets"})};
}

std::unique_ptr<Integrator> make_integrator(const CompiledSystem& system) {
  if (system.study().postures > 0) return std::make_unique<PostureSequence>(system);
  if (system.study().solver.integrator == IntegratorKind::kIdas)
    return std::make_unique<IdasIntegrator>(system);
  return std::make_unique<RosenbrockIntegrator>(system);
}

namespace {

/// A scale of a loss that the design makes impossible; empty if there is none.
std::string find_impossible_scale(const CompiledSystem& system, const Design<double>& design) {
  for (const ObjectivePart part : {ObjectivePart::kIntegral, ObjectivePart::kTerminal}) {
    const bool terminal = part == ObjectivePart::kTerminal;
    const std::vector<ResolvedTerm>& terms = terminal ? system.terminal() : system.integral();
    const std::vector<double>& scales = (terminal ? design.terminal : design.integral).scales;
    for (std::size_t k = 0; k < terms.size(); ++k)
      if (terms[k].loss->has_scale && !(scales[k] > 0.0))
        return term_name(system.study(), part, k) + ".scale is " + readable(scales[k]) +
               ", which must be above 0";
  }
  return "";
}

}  // namespace

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
  for (std::size_t c = 0; c < controllers.size(); ++c) {
    std::string fault =
        find_impossible(controllers[c], equations.formulas().view().design.controllers[c]);
    if (fault.empty()) fault = find_impossible_filter(controllers[c], equations.parameters());
    if (fault.empty() && controllers[c].kind->input == ControlInput::kObserved)
      fault = find_impossible_observer(controllers[c], equations.parameters());
    if (!fault.empty()) return {StatusCode::kInvalidDesign, 0.0, fault};
  }
  if (std::string fault = find_impossible_scale(system, equations.formulas().view().design);
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
