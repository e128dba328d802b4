// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rosenbrock_integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integration/event_names.h"
#include "integration/run_ends.h"

namespace codesign {

namespace {

/// The condition that is to end a run holds where it begins.
Status begins_at_end(const MotionStudy& study) {
  const InputError error({study.until->where, "until", "the condition is true at the start",
                          study.until->text, "a condition that becomes true during the motion"});
  return {StatusCode::kInvalidDesign, 0.0, error.what()};
}

}  // namespace

RosenbrockIntegrator::RosenbrockIntegrator(const CompiledSystem& system)
    : system_(system),
      options_(system.study().solver),
      breaks_(system.study()),
      clock_(system.study()),
      step_(system, rosenbrock_tableau(options_.method)),
      assembly_(system),
      controller_(step_.tableau().order),
      choice_(system),
      stability_(system),
      watch_(system),
      run_watch_(system),
      work_(system),
      singularity_(system),
      mode_watch_(system),
      expression_watch_(system),
      continuation_(system) {}

Status RosenbrockIntegrator::start(const std::vector<double>& parameters) {
  if (Status status = begin_run(system_.study(), parameters); !status.ok()) return status;
  return repeatable_start_.start(
      system_, parameters, [this](const std::vector<double>& design) { return begin(design); },
      [this] {
        assembly_.rates().keep_pivots();
        step_.keep_pivots();
      });
}

Status RosenbrockIntegrator::begin(const std::vector<double>& parameters) {
  statistics_ = {};
  clock_.start();
  jump_events_.clear();
  step_.equations().hold({});
  step_.use(choice_.start());
  stability_.start();
  begin_methods(step_.tableau().name);
  log_.start(system_.has_switches());
  chooses_ = false;
  controller_ = StepController(step_.tableau().order);
  if (Status status =
          assemble_start(system_, parameters, &assembly_, &step_.equations(), &initial_);
      !status.ok())
    return status;
  mode_watch_.start(initial_, &step_.equations());
  expression_watch_.start(initial_, &step_.equations());
  step_.start(initial_);
  watch_.start(step_.equations(), initial_);
  run_watch_.start(step_.equations(), initial_);
  run_watch_.end_at(end());
  work_.start(initial_, run_watch_.motion());
  singularity_.start(watch_singularities_, initial_);
  proposal_ = options_.initial_step > 0.0 ? options_.initial_step : first_step();
  step_.choose_pivots(proposal_);
  return {};
}

Warnings RosenbrockIntegrator::warnings() const {
  Warnings all = assembly_.warnings();
  append(run_watch_.warnings(statistics_), &all);
  append(singularity_.warnings(), &all);
  append(end_warnings(system_.study()), &all);
  append(grazing_warnings(system_, log_), &all);
  return all;
}

// The first step size: a hundredth of the time in which the state, scaled by the tolerances,
// changes by its own size (Hairer, Norsett and Wanner, Solving ODE I, II.4).
double RosenbrockIntegrator::first_step() const {
  double size = 0.0, rate = 0.0;
  for (Eigen::Index k = 0; k < initial_.q.size(); ++k) {
    const double q_scale =
        options_.absolute_tolerance + options_.relative_tolerance * std::abs(initial_.q[k]);
    const double v_scale =
        options_.absolute_tolerance + options_.relative_tolerance * std::abs(initial_.v[k]);
    size += std::pow(initial_.q[k] / q_scale, 2) + std::pow(initial_.v[k] / v_scale, 2);
    rate += std::pow(initial_.v[k] / q_scale, 2) + std::pow(initial_.z[k] / v_scale, 2);
  }
  const double h = rate > 0.0 && size > 0.0 ? 0.01 * std::sqrt(size / rate) : 1e-6;
  return std::min(h, 0.01 * system_.study().duration);
}

void RosenbrockIntegrator::interpolate(double time, State<double>* state, double* psi) {
  const double h = step_.step_size();
  step_.interpolate(h > 0.0 ? (time - step_.previous().t) / h : 1.0, state, psi);
  state->t = time;
}

void RosenbrockIntegrator::interpolate_rates(double time, State<double>* rates) {
  step_.interpolate_rates((time - step_.previous().t) / step_.step_size(), rates);
}

// At the beginning of the next step, since the dense output of the last one ends with the state
// before the jump. Accelerations and multipliers jump with the efforts, and a Rosenbrock method
// needs them consistent.
Status RosenbrockIntegrator::jump() {
  has_jumped_ = false;
  mode_change_.guard = -1;
  jump_events_.clear();
  if (Status status = change_mode(&mode_change_); !status.ok()) return status;
  if (clock_.is_empty()) return {};
  if (Status status = sample(); !status.ok() || jump_events_.empty()) return status;
  mode_watch_.look_again();
  return change_mode(&second_change_);
}

Status RosenbrockIntegrator::change_mode(ModeChange* change) {
  if (!mode_watch_.is_due()) return {};
  if (Status status = mode_watch_.cross(step_.state(), &assembly_, &step_.equations(), change);
      !status.ok())
    return status;
  has_jumped_ = true;
  if (change->origin)
    log_.add(
        {change->end.t, change->origin, change->becomes_true, change->is_jump, change->is_touched});
  step_.restart(change->behind);
  work_.start(change->behind, run_watch_.motion());
  return look_for_end(change->behind);
}

// Accelerations and efforts jump with the mode, so that the condition of the end may hold at once.
// At the start it counts a little behind it: a ball on the ground may be thrown.
Status RosenbrockIntegrator::look_for_end(const State<double>& behind) {
  if (!system_.until()) return {};
  const bool is_start = behind.t == 0.0;
  if (!system_.ends_run(is_start ? mode_watch_.mode()
                                 : step_.equations().compiled().mode_of(behind)))
    return {};
  if (is_start) return begins_at_end(system_.study());
  end_run();
  return {};
}

Status RosenbrockIntegrator::judge_end(double rate) {
  if (!mode_watch_.grazes(rate)) return {};
  const EventLog::Entry entry = mode_watch_.touch_at(step_.state().t, &step_.equations());
  log_.touch(entry);
  if (rate != 0.0) return {};
  return {StatusCode::kNonFiniteGradient, entry.time,
          "the run ends where it only touches the guard of " +
              describe_switch(system_, entry.origin) + ": the time of its end has no derivative"};
}

Status RosenbrockIntegrator::sample() {
  jump_events_ = clock_.due(step_.state().t);
  if (jump_events_.empty()) return {};
  has_jumped_ = true;
  before_jump_ = step_.state();
  State<double>& behind = behind_jump_ = before_jump_;
  step_.equations().jump(jump_events_, &behind);
  if (Status status = assembly_.rates().solve(&step_.equations(), &behind); !status.ok())
    return status;
  step_.restart(behind);
  work_.start(behind, run_watch_.motion());
  return {};
}

Status RosenbrockIntegrator::go_on(double time, const std::vector<double>& parameters) {
  if (Status status = check_end(system_.study(), parameters); !status.ok()) return status;
  const bool between = time < step_.state().t,
             changes = parameters != step_.equations().parameters();
  State<double>& behind = behind_jump_;
  double reached = 0.0;
  interpolate(std::min(time, step_.state().t), &behind, &reached);
  if (!between) behind = step_.state();
  if (Status status =
          continuation_.cross(parameters, between, &assembly_, &step_.equations(), &behind);
      !status.ok())
    return status;
  go_on_run(system_.study(), parameters, between);
  step_.start(behind, reached);
  mode_watch_.restart(&step_.equations());
  if (changes) step_.choose_pivots(proposal_);
  run_watch_.go_on(step_.equations(), behind);
  run_watch_.end_at(end());
  work_.start(behind, run_watch_.motion());
  return {};
}

void RosenbrockIntegrator::choose_method() {
  if (chooses_) {
    const RosenbrockTableau& next = choice_.next(&step_, stability_.limits());
    if (&next != &step_.tableau()) change_method(step_.state().t, next.name);
    step_.use(next);
  }
  chooses_ = false;
}

bool RosenbrockIntegrator::is_stable(double h) {
  if (stability_.allows(&step_)) return true;
  ++statistics_.rejected_steps;
  proposal_ = stability_.shorten(h);
  return false;
}

double RosenbrockIntegrator::own_error() const {
  return std::max(step_.error(options_.relative_tolerance, options_.absolute_tolerance),
                  step_.psi_error(options_.relative_tolerance, options_.absolute_tolerance));
}

// Infinite where a step that was cut at a guard cannot be computed. The cut one is another step:
// the longer one may have had all stages beyond what it went through.
double RosenbrockIntegrator::further_error(const BeforeAccept& before_accept) {
  if (!mode_watch_.cut(&step_)) return std::numeric_limits<double>::infinity();
  const double of_cut = mode_watch_.guard() >= 0 ? own_error() : 0.0,
               error = std::max(of_cut, expression_watch_.error(options_, &step_, &assembly_));
  return error <= 1.0 && before_accept ? std::max(error, before_accept(&step_)) : error;
}

// Stretches the step by up to a tenth or halves the remaining time, so that no tiny step is left
// before its end.
RosenbrockIntegrator::NextStep RosenbrockIntegrator::next_step(double t, double limit,
                                                               double smallest) const {
  double h = proposal_;
  if (options_.maximum_step > 0.0) h = std::min(h, options_.maximum_step);
  const double end = end_of_step(clock_.next(breaks_.next(t, limit)), limit, smallest),
               rest = end - t;
  const bool last = h >= rest / 1.1;
  if (last) h = rest;
  while (last && t + h < end) h = std::nextafter(h, end);
  if (!last && h > 0.5 * rest) h = 0.5 * rest;
  // All stages see functions of time as they are before a break, where guards may jump.
  const bool breaks = last && mode_watch_.is_active() && breaks_.contains(end);
  if (breaks) h = std::nextafter(end, t) - t;
  return {h, end, last, breaks};
}

Status RosenbrockIntegrator::advance(double limit, const BeforeAccept& before_accept) {
  if (Status status = jump(); !status.ok() || is_ended()) return status;
  choose_method();
  const double t = step_.state().t;
  const double smallest = smallest_step(t, system_.study().duration);
  bool singular = false;
  const auto judged = [&](const Status& status) {
    if (Status undefined = mode_watch_.undefined_guard(t); !status.ok() && !undefined.ok())
      return undefined;
    return judge_standstill(watch_.judge_failure(status, step_.state()), system_, initial_,
                            step_.state(), step_.step_size(), statistics_, &step_.equations());
  };
  for (;;) {
    if (statistics_.steps + statistics_.rejected_steps >= options_.maximum_steps)
      return judged({StatusCode::kTooManySteps, t,
                     "more than " + std::to_string(options_.maximum_steps) +
                         " steps (solver.maximum_steps)"});
    if (cancelled()) return {StatusCode::kCancelled, t, "cancelled"};
    const NextStep next = next_step(t, limit, smallest);
    const double h = next.h;
    if (!(h >= smallest))
      return judged(singular
                        ? Status{StatusCode::kSingularMatrix, t,
                                 singular_sentence(system_, step_.state(), &step_.equations())}
                        : Status{StatusCode::kStepSizeTooSmall, t,
                                 "the step size fell below " + std::to_string(smallest * 1e12) +
                                     " ps: the motion is not resolvable"});
    if (!step_.attempt(h)) {
      singular = true;
      ++statistics_.rejected_steps;
      proposal_ = controller_.back_off(h);
      continue;
    }
    const double kept = proposal_;
    double error = own_error();
    if (error <= 1.0 && !is_stable(h)) continue;
    if (error <= 1.0) error = std::max(error, further_error(before_accept));
    if (!controller_.accept(h, error, &proposal_)) {
      ++statistics_.rejected_steps;
      continue;
    }
    // After a step that the limit cut short, the earlier proposal is the better one.
    if (next.is_last && h < 0.5 * kept) proposal_ = std::max(proposal_, kept);
    proposal_ = stability_.shorten(proposal_);
    if (!step_.accept())
      return {StatusCode::kSingularMatrix, t + step_.step_size(),
              "the augmented matrix of the equations of motion is singular"};
    if (next.ends_at_break && step_.step_size() == h) cross_break(next.end);
    return judged(look());
  }
}

// Accelerations may jump with a function of time, and guards with them. A jump of G is compared
// with its loads, which are left without accelerations and multipliers.
void RosenbrockIntegrator::cross_break(double t) {
  constexpr double kSame = 1e-9;
  Equations<double>& equations = step_.equations();
  double g_before = 0.0, g_behind = 0.0, unused = 0.0;
  equations.residual(step_.state(), &residual_before_, &g_before);
  step_.set_time(t);
  equations.residual(step_.state(), &residual_behind_, &g_behind);
  const double jump = (residual_before_ - residual_behind_).lpNorm<Eigen::Infinity>();
  behind_jump_ = step_.state();
  behind_jump_.z.setZero();
  equations.residual(behind_jump_, &residual_behind_, &unused);
  if (jump > kSame * residual_behind_.lpNorm<Eigen::Infinity>() ||
      std::abs(g_before - g_behind) > kSame * std::abs(g_behind))
    mode_watch_.look_again();
}

Status RosenbrockIntegrator::look() {
  if (mode_watch_.guard() >= 0 && system_.ends_run(mode_watch_.next_mode())) {
    end_run();
    run_watch_.end_at(step_.state().t);
  }
  ++statistics_.steps;
  if (step_.tableau().is_explicit()) ++statistics_.explicit_steps;
  chooses_ = true;
  step_.track_turns();
  if (EventLog::Entry entry; mode_watch_.has_touched(&assembly_, &step_.equations(), &entry))
    log_.touch(entry);
  const double drift =
      run_watch_.drift(step_.state(), step_.position_correction(), step_.velocity_correction());
  singularity_.look(step_.state(), drift, &step_.equations());
  const BodyMotion& motion = run_watch_.motion();
  double work = work_.over(step_, motion);
  const BodyEnergy energy = motion.energy(step_.state().q, step_.state().v);
  if (run_watch_.doubts(energy, work)) work = work_.refined(step_, motion);
  Status status = run_watch_.check(step_.state(), energy, drift, work, &statistics_);
  if (status.ok())
    status = watch_.check(step_.state(), statistics_.steps + statistics_.rejected_steps);
  return status;
}

}  // namespace codesign
