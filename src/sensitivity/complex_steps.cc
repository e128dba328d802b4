// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/complex_steps.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "control/control_clock.h"
#include "elements/state_view.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"
#include "sensitivity/end_motion.h"
#include "sensitivity/rosenbrock_gradient.h"
#include "sensitivity/signal_watch.h"
#include "text/cancel.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kComplexStep = 1e-30;

/// A step that a run took.
struct TakenStep {
  double h, end;  ///< [s]
  const RosenbrockTableau* tableau;
  std::vector<bool> mode;  ///< that its stages held
  ModeChange change;       ///< before it; guard -1 if no guard determined its beginning
  RosenbrockGradient::Switch end_switch{};  ///< at whose zero it ends, where watched signals move
};

/// A run as it is repeated in complex arithmetic.
struct TakenRun {
  std::vector<TakenStep> steps;
  EndMotion end;
  Extremes extremes;
  Eigen::VectorXd slopes;  ///< SignalWatch::slopes()
};

/// Records an integration.
Status record_run(const CompiledSystem& system, const std::vector<double>& parameters,
                  Derivatives derivatives, const std::atomic<bool>* cancel, TakenRun* taken) {
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
    if (status.ok())
      taken->steps.push_back({h, run.time(), &run.tableau(), run.integrator().mode(),
                              std::move(change), run.last_switch()});
  }
  taken->end = run.end_motion();
  taken->extremes = run.extremes();
  taken->slopes = run.slopes();
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

/// i tau' of both ends of a step.
struct Ends {
  Complex begin, end;
};

/// The numbers of watched signals whose times lie in the last step (at the start: at t = 0), at the
/// same times, or along with the guard that is zero at one of its ends.
void replay_watched(const CompiledSystem& system, const TakenRun& taken, const Ends& ends,
                    RosenbrockIntegrator* integrator, OneStep<Complex>* step,
                    VectorX<Complex>* watched) {
  const double from = step->previous().t, to = step->state().t, h = step->step_size();
  const WatchLayout layout(system.study());
  State<Complex> state;
  Complex psi;
  for (std::size_t k = 0; k < system.watched().size(); ++k)
    for (int place = layout.entries()[k].first; place < layout.entries()[k].measure(); ++place) {
      const double time = taken.extremes.times[place];
      if (h > 0.0 ? !(time > from && time <= to) : time > 0.0) continue;
      step->interpolate(h > 0.0 ? (time - from) / h : 1.0, &state, &psi);
      state.t = time;
      State<double> real = real_part(state);
      if (!integrator->assembly().rates().solve(&integrator->equations(), &real).ok()) continue;
      integrator->assembly().rates().extend(real.z, &step->equations(), &state);
      (*watched)[place] = step->equations().watched(k, state) +
                          taken.slopes[place] * (time - from < to - time ? ends.begin : ends.end);
    }
}

/// The measures and the terms of the objective that follow from the other numbers of a complex run.
/// Times in a band do not: their studies are checked by differences.
void replay_measures(const MotionStudy& study, const Extremes& extremes, Replayed* run) {
  const WatchLayout layout(study);
  for (std::size_t k = 0; k < study.watched.size(); ++k) {
    const WatchedSignal& watched = study.watched[k];
    if (watched.linear) continue;
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
void replay_change(const ModeChange& change, OneStep<Complex>* step, State<Complex>* state) {
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
                 RosenbrockIntegrator* integrator, OneStep<Complex>* step) {
  State<Complex> state = step->state();
  if (taken.change.guard >= 0) replay_change(taken.change, step, &state);
  step->equations().hold(taken.mode);
  integrator->equations().hold(taken.mode);
  if (events.empty() && taken.change.mode.empty()) return;
  if (!events.empty()) step->equations().jump(events, &state);
  State<double> real = real_part(state);
  if (!integrator->assembly().rates().solve(&integrator->equations(), &real).ok()) return;
  integrator->assembly().rates().extend(real.z, &step->equations(), &state);
  step->restart(state);
}

/// The run with steps of the same sizes in complex arithmetic.
Replayed replay(const CompiledSystem& system, const std::vector<Complex>& parameters, TakenRun* run,
                RosenbrockIntegrator* integrator, const std::vector<double>& real_parameters,
                const std::atomic<bool>* cancel) {
  OneStep<Complex> step(system, integrator->step().tableau());
  Replayed result;
  const bool is_watched = run->extremes.values.size() > 0;
  result.watched.setZero(run->extremes.values.size());
  step.equations().set_design(parameters);
  integrator->start(real_parameters);
  step.equations().hold({});
  State<Complex> state;
  integrator->assembly().extend(parameters, integrator->initial_state(), &step.equations(), &state);
  step.equations().hold(integrator->mode());
  step.start(state);
  if (is_watched) replay_watched(system, *run, {}, integrator, &step, &result.watched);
  ControlClock clock(system.study());
  Complex tau = 0.0;
  Ends ends;
  bool ends_at_jump = false;
  for (const TakenStep& taken : run->steps) {
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
    step.set_time(taken.end);
    const auto& [guard, rate] = taken.end_switch;
    ends = {ends.end, guard >= 0 ? complex_guard_time(guard, rate, &step) : 0.0};
    if (is_watched) replay_watched(system, *run, ends, integrator, &step, &result.watched);
  }
  result.objective = step.psi() + step.equations().terminal(step.state());
  if (!ends_at_jump) tau = run->end.complex_time(parameters, &step);
  run->end.add_change(tau, run->extremes.times, &integrator->equations(), &result.objective,
                      &result.watched);
  replay_measures(system.study(), run->extremes, &result);
  return result;
}

}  // namespace

Status differentiate_steps(const CompiledSystem& system, const std::vector<double>& parameters,
                           Derivatives derivatives, const Eigen::MatrixXd& directions,
                           const std::atomic<bool>* cancel, Eigen::VectorXd* objective,
                           Eigen::MatrixXd* watched) {
  RosenbrockIntegrator integrator(system);
  TakenRun taken{{}, EndMotion(system), {}, {}};
  Status status = record_run(system, parameters, derivatives, cancel, &taken);
  objective->setZero(directions.cols());
  watched->setZero(directions.cols(), taken.extremes.values.size());
  for (Eigen::Index k = 0; status.ok() && k < directions.cols(); ++k) {
    const double h = step_along(system.study(), parameters, directions.col(k), [](double value) {
      return kComplexStep * std::max(1.0, std::abs(value));
    });
    const std::vector<Complex> perturbed =
        moved(system.study(), parameters, directions.col(k), Complex(0.0, h));
    const Replayed run = replay(system, perturbed, &taken, &integrator, parameters, cancel);
    (*objective)[k] = run.objective.imag() / h;
    watched->row(k) = run.watched.imag().transpose() / h;
    if (is_set(cancel)) status = {StatusCode::kCancelled, 0.0, "cancelled"};
  }
  return status;
}

}  // namespace codesign
