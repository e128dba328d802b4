// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "control/control_clock.h"
#include "description/study.h"
#include "elements/state_view.h"
#include "equations/compiled_system.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"
#include "math/differences.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "sensitivity/end_motion.h"
#include "sensitivity/rosenbrock_gradient.h"
#include "sensitivity/run_steps.h"
#include "sensitivity/signal_watch.h"
#include "text/cancel.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kComplexStep = 1e-30;
constexpr int kMostOfReference = 2000000;

/// A step that a run took.
struct TakenStep {
  double h;  ///< [s]
  const RosenbrockTableau* tableau;
  std::vector<bool> mode;  ///< that its stages held
  ModeChange change = {};  ///< before it; guard -1 if no guard determined its beginning
};

/// Records the steps of an integration.
Status record_steps(const CompiledSystem& system, const std::vector<double>& parameters,
                    Derivatives derivatives, const std::atomic<bool>* cancel,
                    std::vector<TakenStep>* steps, EndMotion* end) {
  RosenbrockGradient run(system);
  run.obey(cancel);
  Status status = run.start(parameters, derivatives);
  while (status.ok() && !run.integrator().has_ended()) {
    const double before = run.time();
    ModeChange change;
    status = run.jump();
    if (status.ok() && run.integrator().has_jumped()) change = run.integrator().mode_change();
    if (status.ok()) status = run.advance(run.integrator().end());
    const double h = run.time() > before ? run.step_size() : 0.0;
    if (status.ok()) steps->push_back({h, &run.tableau(), run.integrator().mode(), change});
  }
  *end = run.end_motion();
  return status;
}

/// The objective and the numbers of the watched signals in complex arithmetic.
struct Replayed {
  Complex objective;
  VectorX<Complex> watched;
};

State<double> real_part(const State<Complex>& state) {
  return {state.t, state.q.real(), state.v.real(), state.s.real(), state.z.real(), state.turns};
}

/// The numbers of watched signals whose times lie in the last step (at the start: at t = 0), at the
/// same times.
void replay_watched(const CompiledSystem& system, const Eigen::VectorXd& times,
                    RosenbrockIntegrator* integrator, RosenbrockStep<Complex>* step,
                    VectorX<Complex>* watched) {
  const double from = step->previous().t, to = step->state().t, h = step->step_size();
  const WatchLayout layout(system.study());
  State<Complex> state;
  Complex psi;
  for (std::size_t k = 0; k < layout.entries().size(); ++k)
    for (int place = layout.entries()[k].first; place < layout.entries()[k].measure(); ++place) {
      const double time = times[place];
      if (h > 0.0 ? !(time > from && time <= to) : time > 0.0) continue;
      step->interpolate(h > 0.0 ? (time - from) / h : 1.0, &state, &psi);
      state.t = time;
      State<double> real = real_part(state);
      if (!integrator->assembly().solve_rates(&integrator->equations(), &real).ok()) continue;
      integrator->assembly().extend_rates(real.z, &step->equations(), &state);
      (*watched)[place] = step->equations().watched(k, state);
    }
}

/// The measures and the terms of the objective that follow from the other numbers of a complex run.
/// Times in a band do not: their studies are checked by differences.
void replay_measures(const MotionStudy& study, const Extremes& extremes, Replayed* run) {
  const WatchLayout layout(study);
  for (std::size_t k = 0; k < study.watched.size(); ++k) {
    const WatchedSignal& watched = study.watched[k];
    const WatchLayout::Entry& entry = layout.entries()[k];
    const RangePlaces range = find_range(entry, extremes.values);
    const bool minimum = watched.measure == WatchedSignal::Measure::kMinimum;
    if (entry.is_measured)
      run->watched[entry.measure()] = run->watched[minimum ? range.smallest : range.largest];
    if (watched.measure == WatchedSignal::Measure::kStroke)
      run->watched[entry.measure()] -= run->watched[range.smallest];
    const Peak peak = find_peak(entry, extremes.values);
    if (watched.role == WatchedSignal::Role::kPeak)
      run->objective += watched.weight * peak.sign * run->watched[peak.place];
    if (watched.role == WatchedSignal::Role::kTerm)
      run->objective += watched.weight * run->watched[entry.measure()];
  }
}

/// Carries a complex run over an instant that a guard determines, theory (18g).
void replay_change(const ModeChange& change, RosenbrockStep<Complex>* step, State<Complex>* state) {
  const Complex tau = complex_guard_time(change.guard, change.guard_rate, step);
  const Eigen::Index n = state->v.size(), states = state->s.size();
  const VectorX<double> jump = change.before.z - change.behind.z;
  state->v += tau * jump.head(n).cast<Complex>();
  state->s += tau * jump.tail(states).cast<Complex>();
  step->add_psi(tau * (change.g_before - change.g));
}

/// Carries a complex run to the beginning of a step: over a change of the mode and over the events
/// of sampled controllers.
void replay_jump(const TakenStep& taken, const std::vector<ControlEvent>& events,
                 RosenbrockIntegrator* integrator, RosenbrockStep<Complex>* step) {
  State<Complex> state = step->state();
  if (taken.change.guard >= 0) replay_change(taken.change, step, &state);
  step->equations().hold(taken.mode);
  integrator->equations().hold(taken.mode);
  if (events.empty() && taken.change.mode.empty()) return;
  if (!events.empty()) step->equations().jump(events, &state);
  State<double> real = real_part(state);
  if (!integrator->assembly().solve_rates(&integrator->equations(), &real).ok()) return;
  integrator->assembly().extend_rates(real.z, &step->equations(), &state);
  step->restart(state);
}

/// The run with steps of the same sizes in complex arithmetic.
/// @param extremes of the real run.
Replayed replay(const CompiledSystem& system, const std::vector<Complex>& parameters,
                const std::vector<TakenStep>& steps, const Extremes& extremes, EndMotion* end,
                RosenbrockIntegrator* integrator, const std::vector<double>& real_parameters,
                const std::atomic<bool>* cancel) {
  RosenbrockStep<Complex> step(system, integrator->step().tableau());
  Replayed result;
  result.watched.setZero(extremes.values.size());
  step.equations().set_design(parameters);
  integrator->start(real_parameters);
  step.equations().hold({});
  State<Complex> state;
  integrator->assembly().extend(parameters, integrator->initial_state(), &step.equations(), &state);
  step.equations().hold(integrator->mode());
  step.start(state);
  if (result.watched.size() > 0)
    replay_watched(system, extremes.times, integrator, &step, &result.watched);
  ControlClock clock(system.study());
  Complex tau = 0.0;
  bool ends_at_jump = false;
  for (const TakenStep& taken : steps) {
    if (is_set(cancel)) break;
    ends_at_jump = taken.h == 0.0;
    if (ends_at_jump && taken.change.guard >= 0)
      tau = complex_guard_time(taken.change.guard, taken.change.guard_rate, &step);
    step.use(*taken.tableau);
    replay_jump(taken, clock.due(step.state().t), integrator, &step);
    if (ends_at_jump) break;
    step.attempt(taken.h);
    step.accept();
    step.track_turns();
    if (result.watched.size() > 0)
      replay_watched(system, extremes.times, integrator, &step, &result.watched);
  }
  result.objective = step.psi() + step.equations().terminal(step.state());
  if (!ends_at_jump) tau = end->complex_time(parameters, &step);
  end->add_change(tau, extremes.times, &integrator->equations(), &result.objective,
                  &result.watched);
  replay_measures(system.study(), extremes, &result);
  return result;
}

/// The directions along which a reference is computed: those given, or each tuned parameter.
Eigen::MatrixXd directions_of(const CompiledSystem& system, const Eigen::MatrixXd& given) {
  const auto count = to_signed(system.study().tuned.size());
  return given.size() > 0 ? given : Eigen::MatrixXd::Identity(count, count);
}

/// parameters + step * direction, with the tuned parameters in the direction.
template <class T>
std::vector<T> moved(const MotionStudy& study, const std::vector<double>& parameters,
                     const Eigen::VectorXd& direction, const T& step) {
  std::vector<T> result(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    result[to_index(study.tuned[k])] += step * direction[to_signed(k)];
  return result;
}

/// The largest step along a direction that changes no tuned parameter by more than its `size`.
template <class Size>
double step_along(const MotionStudy& study, const std::vector<double>& parameters,
                  const Eigen::VectorXd& direction, const Size& size) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    if (const double component = std::abs(direction[to_signed(k)]); component > 0.0)
      step = std::min(step, size(parameters[to_index(study.tuned[k])]) / component);
  return step;
}

/// Sets a failure if a component of the reference is not finite.
void refuse_non_finite(const CompiledSystem& system, GradientCheck* check) {
  for (Eigen::Index k = 0; k < check->reference.size(); ++k) {
    if (std::isfinite(check->reference[k]) && std::isfinite(check->reference_error[k])) continue;
    const MotionStudy& study = system.study();
    const bool along = check->directions.size() > 0;
    const std::string name =
        along ? "along direction " + std::to_string(k + 1)
              : "by \"" + study.parameters[to_index(study.tuned[to_index(k)])].name + "\"";
    check->status = {StatusCode::kNonFiniteGradient, study.duration,
                     "the reference for the gradient " + name + " is not finite"};
    return;
  }
}

/// Derivatives of the objective and of the watched numbers through the steps of a run: one entry
/// and one row per direction.
/// @param derivatives of the run that chooses the steps. @param extremes of the run under check.
Status differentiate_steps(const CompiledSystem& system, const std::vector<double>& parameters,
                           Derivatives derivatives, const Eigen::MatrixXd& directions,
                           const Extremes& extremes, const std::atomic<bool>* cancel,
                           Eigen::VectorXd* objective, Eigen::MatrixXd* watched) {
  RosenbrockIntegrator integrator(system);
  std::vector<TakenStep> steps;
  EndMotion end(system);
  objective->setZero(directions.cols());
  watched->setZero(directions.cols(), extremes.values.size());
  Status status = record_steps(system, parameters, derivatives, cancel, &steps, &end);
  for (Eigen::Index k = 0; status.ok() && k < directions.cols(); ++k) {
    const double h = step_along(system.study(), parameters, directions.col(k), [](double value) {
      return kComplexStep * std::max(1.0, std::abs(value));
    });
    const std::vector<Complex> perturbed =
        moved(system.study(), parameters, directions.col(k), Complex(0.0, h));
    const Replayed run =
        replay(system, perturbed, steps, extremes, &end, &integrator, parameters, cancel);
    (*objective)[k] = run.objective.imag() / h;
    watched->row(k) = run.watched.imag().transpose() / h;
    if (is_set(cancel)) status = {StatusCode::kCancelled, 0.0, "cancelled"};
  }
  return status;
}

/// Reference by Ridders' extrapolated differences [9]. The error of the objective must be far below
/// the differences, so tolerances are tightened, and no pulse may be passed over.
void check_by_differences(const CompiledSystem& system, const std::vector<double>& parameters,
                          const std::atomic<bool>* cancel, GradientCheck* check) {
  Study study =
      with_steps(system.whole_study(), {RunSteps::Method::kRodas5P, false, kMostOfReference});
  study.solver.relative_tolerance = std::min(study.solver.relative_tolerance, 1e-10);
  study.solver.absolute_tolerance = std::min(study.solver.absolute_tolerance, 1e-11);
  // Of postures, too, whose equations are then those of the implicit methods.
  study.solver.integrator = IntegratorKind::kRosenbrock;
  study.solver.method = RosenbrockMethod::kRodas5P;
  Evaluator evaluator =
      evaluator_of(std::make_shared<const CompiledSystem>(system.robot(), study, system.sharing()));
  const Eigen::MatrixXd directions = directions_of(system, check->directions);
  for (Eigen::Index k = 0; check->status.ok() && k < check->reference.size(); ++k) {
    const auto objective = [&](double step) {
      const Evaluation evaluation = evaluator.evaluate_design(
          moved(study, parameters, directions.col(k), step), false, cancel);
      if (!evaluation.status.ok()) check->status = evaluation.status;
      return evaluation.objective;
    };
    const double largest = step_along(study, parameters, directions.col(k), [](double value) {
      return 1e-2 * std::max(std::abs(value), 1e-3);
    });
    const RiddersDerivative derivative = ridders_derivative(objective, 0.0, largest);
    check->reference[k] = derivative.value;
    check->reference_error[k] = derivative.error;
  }
}

}  // namespace

bool can_replay(const MotionStudy& study) {
  return study.postures == 0 && study.solver.integrator == IntegratorKind::kRosenbrock &&
         std::none_of(study.watched.begin(), study.watched.end(), has_band);
}

Status differentiate_finer_steps(const CompiledSystem& system,
                                 const std::vector<double>& parameters,
                                 const Eigen::MatrixXd& directions, const Extremes& extremes,
                                 const std::atomic<bool>* cancel, Eigen::VectorXd* derivatives) {
  Study study = system.whole_study();
  for (double* tolerance : {&study.solver.relative_tolerance, &study.solver.absolute_tolerance})
    *tolerance = std::max(1e-2 * *tolerance, 1e-13);
  study.solver.maximum_steps *= 10;
  const CompiledSystem finer(system.robot(), study, system.sharing());
  Eigen::MatrixXd watched;
  return differentiate_steps(finer, parameters, Derivatives::kGradient,
                             directions_of(finer, directions), extremes, cancel, derivatives,
                             &watched);
}

GradientCheck check_gradient(const Problem& problem, const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel) {
  return check_gradient(system_of(problem), rho, method, cancel);
}

GradientCheck check_gradient(const std::shared_ptr<const CompiledSystem>& system,
                             const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel) {
  return check_design(system, system->parameters(rho), method, cancel);
}

namespace {

/// The largest difference of a gradient from its reference along `directions`, relative to the
/// sizes that gradient.h names.
/// @param floor the smallest size.
double largest_difference(const Eigen::MatrixXd& directions, const Eigen::VectorXd& gradient,
                          const Eigen::VectorXd& reference, double floor) {
  const Eigen::VectorXd along =
      directions.size() > 0 ? Eigen::VectorXd(directions.transpose() * gradient) : gradient;
  double largest = 0.0;
  for (Eigen::Index k = 0; k < reference.size(); ++k) {
    const double difference = std::abs(along[k] - reference[k]);
    const double size = directions.size() > 0
                            ? directions.col(k).cwiseProduct(gradient).cwiseAbs().maxCoeff()
                            : std::abs(reference[k]);
    if (difference > 0.0) largest = std::max(largest, difference / std::max(size, floor));
  }
  return largest;
}

}  // namespace

void compare(GradientCheck* check) {
  if (check->reference.size() == 0) return;
  const auto compare_with = [check](const auto& gradient, const auto& reference, double floor) {
    check->largest_relative_difference =
        std::max(check->largest_relative_difference,
                 largest_difference(check->directions, gradient, reference, floor));
  };
  compare_with(check->evaluation.gradient, check->reference,
               1e-3 * check->reference.cwiseAbs().maxCoeff());
  if (check->finer.size() > 0)
    check->largest_change =
        largest_difference(check->directions, check->evaluation.gradient, check->finer,
                           1e-3 * check->finer.cwiseAbs().maxCoeff());
  // Values at the start may have gradients that are zero within rounding, so that differences are
  // compared with the largest gradient of all.
  const Eigen::MatrixXd& references = check->extreme_reference;
  if (references.size() == 0) return;
  const double floor = 1e-3 * references.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < references.cols(); ++k)
    compare_with(check->evaluation.extremes.gradients.col(k), references.col(k), floor);
}

Eigen::MatrixXd check_directions(const Eigen::VectorXd& gradient, int count) {
  const double floor = gradient.size() > 0 ? 1e-3 * gradient.cwiseAbs().maxCoeff() : 0.0;
  std::mt19937 bits(1);  // its sequence is the same everywhere
  Eigen::MatrixXd directions(gradient.size(), count);
  for (Eigen::Index column = 0; column < count; ++column)
    for (Eigen::Index k = 0; k < gradient.size(); ++k) {
      const double size = floor > 0.0 ? std::max(std::abs(gradient[k]), floor) : 1.0;
      // Not all of one size, so that a common factor does not cancel.
      const double part = 0.5 + static_cast<double>(bits()) / 4294967296.0;
      directions(k, column) = (bits() % 2 == 0 ? part : -part) / size;
    }
  return directions;
}

GradientCheck check_design(const std::shared_ptr<const CompiledSystem>& system,
                           const std::vector<double>& parameters, CheckMethod method,
                           const std::atomic<bool>* cancel, const Eigen::MatrixXd& directions) {
  const auto count =
      directions.size() > 0 ? directions.cols() : to_signed(system->study().tuned.size());
  GradientCheck check;
  check.directions = directions;
  const MotionStudy& study = system->study();
  check.method = can_replay(study) ? method : CheckMethod::kRidders;
  check.reference.setZero(count);
  check.reference_error.setZero(count);
  check.evaluation = evaluator_of(system).evaluate_design(parameters, true, cancel);
  check.status = check.evaluation.status;
  if (!check.status.ok()) return check;
  if (check.method == CheckMethod::kComplexStep) {
    check.status = differentiate_steps(
        *system, parameters, Derivatives::kGradient, directions_of(*system, directions),
        check.evaluation.extremes, cancel, &check.reference, &check.extreme_reference);
  } else {
    check_by_differences(*system, parameters, cancel, &check);
  }
  if (check.status.ok()) refuse_non_finite(*system, &check);
  if (check.status.ok()) compare(&check);
  return check;
}

}  // namespace codesign
