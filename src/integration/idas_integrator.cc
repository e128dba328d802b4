// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_integrator.h"

#include <algorithm>
#include <cmath>

#include "assembly/assembly.h"
#include "integration/idas_setup.h"
#include "math/arrays.h"

namespace codesign {
namespace {

/// The drift d of (17a) beyond which the run is projected and restarted. It grows as the tolerance
/// shrinks, because next to a singular position the drift in units of the tolerance is large even
/// right after a projection.
double restart_drift(double relative_tolerance) {
  return std::max(100.0, 0.03 / std::sqrt(relative_tolerance));
}

constexpr double kDefaultDelta = -1.0;  // IDAS takes a negative value for its default

}  // namespace

IdasIntegrator::IdasIntegrator(const CompiledSystem& system)
    : system_(system),
      options_(system.study().solver),
      restart_drift_(restart_drift(options_.relative_tolerance)),
      breaks_(system.study()),
      clock_(system.study()),
      assembly_(system),
      watch_(system),
      run_watch_(system),
      singularity_(system),
      context_(make_context()),
      newton_(system, context_.get()),
      equations_(system, &newton_),
      projection_(system),
      continuation_(system),
      y_(make_vector(equations_.size(), context_.get())),
      y_dot_(make_vector(equations_.size(), context_.get())),
      dense_(make_vector(equations_.size(), context_.get())),
      dense_dot_(make_vector(equations_.size(), context_.get())),
      psi_(make_vector(2, context_.get())),
      ida_(IDACreate(context_.get())) {
  if (!ida_) throw std::bad_alloc();
  state_.resize(system.layout());
  equations_.set_motion(&run_watch_.motion());
  set_up_idas({ida_.get(), context_.get(), &message_}, system, &equations_, &newton_,
              {y_.get(), y_dot_.get(), psi_.get()});
}

Warnings IdasIntegrator::warnings() const {
  Warnings all = assembly_.warnings();
  append(run_watch_.warnings(statistics_), &all);
  append(singularity_.warnings(), &all);
  append(restart_warnings_, &all);
  return all;
}

void IdasIntegrator::carry(IdasSensitivities* sensitivities) {
  carried_ = sensitivities;
  equations_.set_sensitivities(sensitivities);
}

// Newton's matrix has the pattern of the matrix that the assembly factors.
Status IdasIntegrator::assemble(const std::vector<double>& parameters) {
  return repeatable_start_.start(
      system_, parameters,
      [this](const std::vector<double>& design) {
        return assemble_start(system_, design, &assembly_, &equations(), &initial_);
      },
      [this] {
        assembly_.rates().keep_pivots();
        newton_.keep_pivots_of(assembly_.rates().matrix());
      });
}

Status IdasIntegrator::start(const std::vector<double>& parameters) {
  begin_methods("idas");
  statistics_ = before_restart_ = {};
  has_stepped_ = false;
  clock_.start();
  largest_drift_ = drift_size_ = 0.0;
  message_.clear();
  restart_warnings_.clear();
  equations_.start();
  if (Status status = begin_run(system_.study(), parameters); !status.ok()) return status;
  if (Status status = assemble(parameters); !status.ok()) return status;
  equations_.count_turns_from(initial_);
  equations_.pack(initial_, span_of(y_.get()), span_of(y_dot_.get()));
  N_VConst(0.0, psi_.get());
  state_ = initial_;
  start_sensitivities(parameters);
  restart_solver();
  watch_.start(equations(), initial_);
  run_watch_.start(equations(), initial_);
  run_watch_.end_at(end());
  singularity_.start(watch_singularities_, initial_);
  work_ = 0.0;
  pace_.start(initial_.t);
  return {};
}

void IdasIntegrator::start_sensitivities(const std::vector<double>& parameters) {
  equations_.order_floor().set_active(with_sensitivities());
  if (!with_sensitivities()) {
    if (y_rho_) require(IDASensToggleOff(ida_.get()), "IDASensToggleOff");
    if (y_rho_) require(IDASetDeltaCjLSetup(ida_.get(), kDefaultDelta), "IDASetDeltaCjLSetup");
    return;
  }
  const int count = carried_->count();
  const bool first = !y_rho_;
  if (first) {
    y_rho_ = std::make_unique<VectorArray>(count, y_.get());
    y_dot_rho_ = std::make_unique<VectorArray>(count, y_.get());
    psi_rho_ = std::make_unique<VectorArray>(count, psi_.get());
    for (int k = 0; k < count; ++k) {
      set_order_floor(y_rho_->get()[k], nullptr);
      set_order_floor(y_dot_rho_->get()[k], nullptr);
    }
    directions_.resize(to_index(count), initial_);
    scales_.resize(to_index(count));
  }
  carried_->start(parameters, initial_, this, &directions_, &scales_);
  for (int k = 0; k < count; ++k) {
    equations_.pack(directions_[to_index(k)], y_rho_->span(k), y_dot_rho_->span(k));
    psi_rho_->span(k)[0] = 0.0;
  }
  if (!first) return;
  // The simultaneous corrector fails in the first steps, and without the error test the
  // sensitivities are inaccurate at the higher orders.
  require(IDASensInit(ida_.get(), count, IDA_STAGGERED, IdasEquations::sensitivity_residual,
                      y_rho_->get(), y_dot_rho_->get()),
          "IDASensInit");
  require(IDAQuadSensInit(ida_.get(), IdasEquations::sensitivity_integrand, psi_rho_->get()),
          "IDAQuadSensInit");
  require(IDASensEEtolerances(ida_.get()), "IDASensEEtolerances");
  require(IDAQuadSensEEtolerances(ida_.get()), "IDAQuadSensEEtolerances");
}

/// Restarts IDAS at state_ and its sensitivities, at order one.
void IdasIntegrator::restart_solver() {
  void* ida = ida_.get();
  require(IDAReInit(ida, state_.t, y_.get(), y_dot_.get()), "IDAReInit");
  require(IDAQuadReInit(ida, psi_.get()), "IDAQuadReInit");
  if (!with_sensitivities()) return;
  require(IDASensReInit(ida, IDA_STAGGERED, y_rho_->get(), y_dot_rho_->get()), "IDASensReInit");
  require(IDAQuadSensReInit(ida, psi_rho_->get()), "IDAQuadSensReInit");
  // A matrix for another c_j would not be exact, see IdasEquations::visit_to_solve().
  require(IDASetDeltaCjLSetup(ida, 0.0), "IDASetDeltaCjLSetup");
  // A run without sensitivities in between switches this error test off.
  require(IDASetSensErrCon(ida, SUNTRUE), "IDASetSensErrCon");
  require(IDASetQuadSensErrCon(ida, SUNTRUE), "IDASetQuadSensErrCon");
  require(IDASetSensParams(ida, nullptr, scales_.data(), nullptr), "IDASetSensParams");
}

/// Restarts at state_, which has changed. @param change () -> changes directions_ alike; false if a
/// matrix is singular.
template <class Change>
Status IdasIntegrator::begin_anew(const Change& change) {
  equations_.pack(state_, span_of(y_.get()), span_of(y_dot_.get()));
  if (with_sensitivities()) {
    for (int k = 0; k < carried_->count(); ++k) sensitivity(k, &directions_[to_index(k)]);
    if (!change())
      return {StatusCode::kSingularMatrix, state_.t,
              "the augmented matrix of the equations of motion is singular"};
    for (int k = 0; k < carried_->count(); ++k)
      equations_.pack(directions_[to_index(k)], y_rho_->span(k), y_dot_rho_->span(k));
  }
  before_restart_ = statistics_;
  restart_solver();
  return {};
}

// A multistep method interpolates the points before, so that it has to begin again where the
// efforts jump.
Status IdasIntegrator::jump() {
  const std::vector<ControlEvent>& events = clock_.due(state_.t);
  if (events.empty()) return {};
  before_jump_ = state_;
  equations().jump(events, &state_);
  if (Status status = assembly_.rates().solve(&equations(), &state_); !status.ok()) return status;
  return begin_anew(
      [&] { return carried_->jump(events, before_jump_, state_, &equations(), &directions_); });
}

Status IdasIntegrator::go_on(double time, const std::vector<double>& parameters) {
  if (Status status = check_end(system_.study(), parameters); !status.ok()) return status;
  const bool between = time < state_.t;
  State<double> behind;
  double reached = 0.0;
  interpolate(std::min(time, state_.t), &behind, &reached);
  if (!between) behind = state_;
  if (Status status = continuation_.cross(parameters, between, &assembly_, &equations(), &behind);
      !status.ok())
    return status;
  go_on_run(system_.study(), parameters, between);
  state_ = behind;
  span_of(psi_.get())[0] = reached;
  equations_.start();
  equations_.count_turns_from(state_);
  run_watch_.go_on(equations(), state_);
  run_watch_.end_at(end());
  drift_size_ = 0.0;
  has_stepped_ = false;
  return begin_anew([] { return true; });
}

// Projects state and sensitivities and restarts, since a multistep method interpolates the points
// before. Near a singular position this keeps the mechanism on its branch: the smaller the smallest
// singular value of Phi_q, the farther a given drift displaces the mechanism.
Status IdasIntegrator::project() {
  if (!projection_.apply(&equations(), &state_))
    return {StatusCode::kSingularMatrix, state_.t,
            "the augmented matrix of the equations of motion is singular"};
  if (Status status = assembly_.rates().solve(&equations(), &state_); !status.ok()) return status;
  if (with_sensitivities()) warn_of_restart();
  const auto project = [this] { return carried_->project(state_, &equations(), &directions_); };
  if (Status status = begin_anew(project); !status.ok()) return status;
  drift_size_ = 0.0;
  pace_.count_restart();
  return {};
}

/// A projection corrects the state, but the sensitivities keep the error of the steps that had
/// drifted off the constraints.
void IdasIntegrator::warn_of_restart() {
  if (restart_warnings_.empty())
    restart_warnings_.push_back(sensitivities_restarted(state_.t, drift_size_));
}

Status IdasIntegrator::advance(double limit) {
  if (cancelled()) return {StatusCode::kCancelled, state_.t, "cancelled"};
  const double before = state_.t;
  const Status status = take_step(limit);
  return judge_standstill(watch_.judge_failure(status, state_), system_, initial_, state_,
                          state_.t - before, statistics_, &equations());
}

Status IdasIntegrator::take_step(double limit) {
  if (statistics_.steps + statistics_.rejected_steps >= options_.maximum_steps)
    return {
        StatusCode::kTooManySteps, state_.t,
        "more than " + std::to_string(options_.maximum_steps) + " steps (solver.maximum_steps)"};
  // At the beginning of the next step, since dense output within the last one needs its history.
  if (drift_size_ > restart_drift_)
    if (Status status = project(); !status.ok()) return status;
  if (!clock_.is_empty())
    if (Status status = jump(); !status.ok()) return status;
  void* ida = ida_.get();
  double time = state_.t;
  const double stop = end_of_step(clock_.next(breaks_.next(state_.t, limit)), limit,
                                  smallest_step(state_.t, system_.study().duration));
  require(IDASetStopTime(ida, stop), "IDASetStopTime");
  const int flag = IDASolve(ida, stop, &time, y_.get(), y_dot_.get(), IDA_ONE_STEP);
  count_steps();
  if (flag < 0)
    return idas_status(flag, state_.t, newton_.singular(),
                       equations_.failure().empty() ? message_ : equations_.failure());
  take_over(time);
  if (Status status = check_run(); !status.ok()) return status;
  if (Status status = pace_.check(state_.t, statistics_.steps); !status.ok()) return status;
  return watch_.check(state_, statistics_.steps + statistics_.rejected_steps);
}

void IdasIntegrator::take_over(double time) {
  equations_.unpack(time, span_of(y_.get()), span_of(y_dot_.get()), &state_);
  has_stepped_ = true;
  double reached = time;
  require(IDAGetQuad(ida_.get(), &reached, psi_.get()), "IDAGetQuad");
  if (with_sensitivities()) {
    require(IDAGetSensDky(ida_.get(), time, 0, y_rho_->get()), "IDAGetSensDky");
    require(IDAGetSensDky(ida_.get(), time, 1, y_dot_rho_->get()), "IDAGetSensDky");
    require(IDAGetQuadSens(ida_.get(), &reached, psi_rho_->get()), "IDAGetQuadSens");
  }
  equations_.count_turns(&state_);
  equations().track_turns(&state_);
  equations_.count_turns_from(state_);
  equations().constraint_errors(state_, &drift_, &drift_rate_);
  if (drift_.size() > 0) largest_drift_ = std::max(largest_drift_, drift_.cwiseAbs().maxCoeff());
}

// The corrections use the last Newton matrix, which differs from G_z of the projection (17) by
// terms of the order of the step.
Status IdasIntegrator::check_run() {
  const double before = work_;
  work_ = span_of(psi_.get())[1];
  newton_.correct(drift_, &position_correction_);
  newton_.correct(drift_rate_, &velocity_correction_);
  drift_size_ = run_watch_.drift(state_, position_correction_, velocity_correction_);
  singularity_.look(state_, drift_size_, &equations());
  return run_watch_.check(state_, drift_size_, work_ - before, &statistics_);
}

void IdasIntegrator::count_steps() {
  const IdasCounts counts = count_idas(ida_.get(), with_sensitivities());
  statistics_.steps = before_restart_.steps + counts.steps;
  statistics_.rejected_steps = before_restart_.rejected_steps + counts.rejected;
}

void IdasIntegrator::interpolate_rates(double time, State<double>* rates) {
  require(IDAGetDky(ida_.get(), time, 1, dense_dot_.get()), "IDAGetDky");
  equations_.unpack(time, span_of(dense_dot_.get()), span_of(dense_dot_.get()), rates);
}

void IdasIntegrator::interpolate_sensitivities(double time,
                                               std::vector<State<double>>* directions) {
  const int count = carried_->count();
  directions->resize(to_index(count), state_);
  const bool has_stepped = statistics_.steps > 0;
  if (!dense_rho_) dense_rho_ = std::make_unique<VectorArray>(count, y_.get());
  if (has_stepped) require(IDAGetSensDky(ida_.get(), time, 0, dense_rho_->get()), "IDAGetSensDky");
  for (int k = 0; k < count; ++k) {
    const Span<double> y = (has_stepped ? *dense_rho_ : *y_rho_).span(k);
    equations_.unpack(time, y, y, &(*directions)[to_index(k)]);
  }
}

void IdasIntegrator::interpolate(double time, State<double>* state, double* psi) {
  *psi = this->psi();
  *state = state_;
  if (!has_stepped_) return;
  require(IDAGetDky(ida_.get(), time, 0, dense_.get()), "IDAGetDky");
  require(IDAGetDky(ida_.get(), time, 1, dense_dot_.get()), "IDAGetDky");
  equations_.unpack(time, span_of(dense_.get()), span_of(dense_dot_.get()), state);
  equations_.count_turns(state);
  double at_end = this->psi();
  require(IDAGetQuadDky(ida_.get(), time, 0, psi_.get()), "IDAGetQuadDky");
  std::swap(*psi, at_end);
  const Span<double> integrals = span_of(psi_.get());
  *psi = integrals[0];
  integrals[0] = at_end;
  integrals[1] = work_;
}

}  // namespace codesign
