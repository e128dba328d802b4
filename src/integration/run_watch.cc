// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/run_watch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "equations/compiled_system.h"
#include "integration/one_step.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Vector3d = Eigen::Vector3d;

/// 2 G(p) r: the angular velocity for r = p', the angular acceleration for r = p''; both in body
/// axes.
Vector3d spin(const double* p, const double* r) {
  return {2.0 * (-p[1] * r[0] + p[0] * r[1] + p[3] * r[2] - p[2] * r[3]),
          2.0 * (-p[2] * r[0] - p[3] * r[1] + p[0] * r[2] + p[1] * r[3]),
          2.0 * (-p[3] * r[0] + p[2] * r[1] - p[1] * r[2] + p[0] * r[3])};
}

Vector3d vector(const double* x) { return {x[0], x[1], x[2]}; }

// Steps that may exceed the limit before the run fails: a run from rest begins with energies near
// zero and low-order steps, whose relative error may be large.
constexpr int kPatience = 20;

// Relative rounding error of the sums of energy and work, with a margin.
constexpr double kRounding = 1e-9;

/// For messages, where three digits suffice.
std::string rounded(double value) { return readable(value, 3); }

std::string advice(const SolverOptions& options) {
  const std::string other = options.integrator == IntegratorKind::kIdas ? "rosenbrock" : "idas";
  return "Lower solver.relative_tolerance (" + to_decimal(options.relative_tolerance) +
         "), or compare with solver.integrator: " + other;
}

std::string drift_sentence(double drift, double time) {
  return "the step that ends at t = " + rounded(time) + " s violates the constraints by " +
         rounded(drift) + " times the error tolerance";
}

std::string energy_sentence(double error, double time) {
  return "kinetic and potential energy and the work done by all other forces are out of balance "
         "by " +
         rounded(error) + " times the largest energy in the run, at t = " + rounded(time) + " s";
}

}  // namespace

BodyMotion::Measured::Measured(const CompiledSystem& system)
    : equations(system), energies(3), bodies(9 * system.layout().bodies) {
  at.resize(system.layout());
}

BodyMotion::BodyMotion(const CompiledSystem& system)
    : gravity_(system.study().gravity.data()),
      bodies_(to_index(system.layout().bodies)),
      measured_(system.layout().has_forest() ? std::make_unique<Measured>(system) : nullptr) {}

void BodyMotion::set_design(const Equations<double>& equations) {
  const Constants<double>& constants = equations.constants();
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    bodies_[b] = {constants.bodies[b].mass, constants.bodies[b].J};
  if (!measured_) return;
  measured_->equations.set_design(equations.parameters());
  measured_->is_known = false;
}

void BodyMotion::measure(const VectorX<double>& q, const VectorX<double>& v, In<double> a) const {
  Measured& m = *measured_;
  m.at.q = q, m.at.v = v;
  std::copy(a.begin(), a.end(), m.at.z.data());
  m.equations.energies(m.at, &m.energies, &m.bodies);
  m.is_known = true;
}

void BodyMotion::move(const VectorX<double>& q, const VectorX<double>& v) const {
  if (measured_ && !(measured_->is_known && q == measured_->at.q && v == measured_->at.v))
    measure(q, v, {});
}

double BodyMotion::distance(int body, const VectorX<double>& q) const {
  return measured_ ? of_body(body, 0).norm() : q.segment<3>(kBodySize * body).norm();
}

BodySpeed BodyMotion::speed(int body, const VectorX<double>& v) const {
  if (measured_) return {of_body(body, 3).norm(), of_body(body, 6).norm()};
  // |omega| = 2 |p'|, since p' is orthogonal to the unit vector p.
  return {v.segment<3>(kBodySize * body).norm(), 2.0 * v.segment<4>(kBodySize * body + 3).norm()};
}

BodyEnergy BodyMotion::energy(const VectorX<double>& q, const VectorX<double>& v) const {
  if (measured_) {
    move(q, v);
    return {measured_->energies[0], measured_->energies[1]};
  }
  BodyEnergy energy;
  const double *r = q.data(), *rate = v.data();
  for (const Body& body : bodies_) {
    const Vector3d velocity = vector(rate), omega = spin(r + 3, rate + 3);
    energy.kinetic += 0.5 * (body.mass * velocity.squaredNorm() + omega.dot(body.J * omega));
    energy.potential -= body.mass * gravity_.dot(vector(r));
    r += kBodySize;
    rate += kBodySize;
  }
  return energy;
}

// The velocity terms 8 G'^T J G p' of (9) and omega x J omega have no power.
double BodyMotion::power(const VectorX<double>& q, const VectorX<double>& v, In<double> z) const {
  assert(q.size() == v.size() && z.size() >= v.size());
  if (measured_) {
    measure(q, v, z.first(v.size()));
    return measured_->energies[2];
  }
  double power = 0.0;
  const double *r = q.data(), *rate = v.data(), *a = z.data();
  for (const Body& body : bodies_) {
    power += body.mass * vector(rate).dot(vector(a) - gravity_) +
             spin(r + 3, rate + 3).dot(body.J * spin(r + 3, a + 3));
    r += kBodySize;
    rate += kBodySize;
    a += kBodySize;
  }
  return power;
}

void StepWork::start(const State<double>& state, const BodyMotion& motion) {
  power_ = motion.power(state.q, state.v, state.z);
}

double StepWork::over(const OneStep<double>& step, const BodyMotion& motion) {
  const State<double>& to = step.state();
  double psi = 0.0;
  step.interpolate(0.5, &middle_, &psi);
  const double begun = power_, middle = motion.power(middle_.q, middle_.v, middle_.z);
  // The end last: the checks that follow ask for the motion there.
  power_ = motion.power(to.q, to.v, to.z);
  return step.step_size() / 6.0 * (begun + 4.0 * middle + power_);
}

double StepWork::refined(const OneStep<double>& step, const BodyMotion& motion) {
  constexpr std::array<double, 5> kNodes{-0.9061798459386640, -0.5384693101056831, 0.0,
                                         0.5384693101056831, 0.9061798459386640},
      kWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
               0.2369268850561891};
  double work = 0.0, psi = 0.0;
  for (const double centre : {0.25, 0.75})
    for (std::size_t k = 0; k < kNodes.size(); ++k) {
      step.interpolate(centre + 0.25 * kNodes[k], &middle_, &psi);
      work += 0.25 * kWeights[k] * motion.power(middle_.q, middle_.v, middle_.z);
    }
  return step.step_size() * work;
}

RunLimit drift_limit(double relative_tolerance) {
  const double limit = 10.0 / std::sqrt(relative_tolerance);
  return {limit, 3.0 * limit};
}

RunLimit energy_limit(double relative_tolerance) {
  return {std::max(std::clamp(1e3 * relative_tolerance, 1e-5, 1e-2), 10.0 * relative_tolerance),
          std::max(std::clamp(1e4 * relative_tolerance, 1e-3, 2e-2), 50.0 * relative_tolerance)};
}

RunWatch::RunWatch(const CompiledSystem& system)
    : system_(system),
      options_(system.study().solver),
      drift_limit_(drift_limit(options_.relative_tolerance)),
      energy_limit_(energy_limit(options_.relative_tolerance)),
      motion_(system) {}

// Lower limit of the denominator of e in (17a) [J], so that errors within the absolute tolerance or
// the rounding of large sums do not cause a warning.
double RunWatch::smallest_scale(const Constants<double>& constants,
                                const State<double>& initial) const {
  const double g = Eigen::Vector3d(system_.study().gravity.data()).norm(),
               atol = options_.absolute_tolerance;
  double unresolved = 0.0;
  motion_.move(initial.q, initial.v);
  for (std::size_t b = 0; b < constants.bodies.size(); ++b) {
    const double distance = motion_.distance(static_cast<int>(b), initial.q);
    unresolved += constants.bodies[b].mass * (g * (atol + kRounding * distance) + atol * atol);
  }
  return unresolved / energy_limit_.warning;
}

// Of a motion of n error tolerances only one part in n is known, and its energies no better: a
// mechanism at rest within its tolerances has none that could be checked.
void RunWatch::note_reach(const VectorX<double>& change, const VectorX<double>& of) {
  for (Eigen::Index k = 0; k < change.size() && reach_ < 1.0; ++k) {
    const double tolerance =
        options_.absolute_tolerance + options_.relative_tolerance * std::abs(of[k]);
    reach_ =
        std::min(1.0, std::max(reach_, energy_limit_.warning * std::abs(change[k]) / tolerance));
  }
}

void RunWatch::start(const Equations<double>& equations, const State<double>& initial) {
  motion_.set_design(equations);
  smallest_scale_ = smallest_scale(equations.constants(), initial);
  worst_drift_time_ = closed_error_time_ = initial.t;
  closed_error_ = scale_ = 0.0;
  end_ = system_.study().duration;
  begin_balance(initial, motion_.energy(initial.q, initial.v));
}

void RunWatch::begin_balance(const State<double>& state, const BodyEnergy& energy) {
  balance_begin_ = worst_error_time_ = state.t;
  balanced_steps_ = unbalanced_steps_ = 0;
  start_q_ = state.q;
  reach_ = 0.0;
  note_reach(state.v, state.v);
  start_potential_ = potential_ = energy.potential;
  start_energy_ = energy.total();
  work_ = turnover_ = worst_error_ = imbalance_ = 0.0;
  scale_ = std::max({scale_, energy.kinetic, smallest_scale_});
}

// A run of hours would add up errors that are small in each motion, and after each change those of
// a motion that its tolerances hardly resolve. The scale stays the largest energy in the run.
void RunWatch::close_balance(const State<double>& state, const BodyEnergy& energy) {
  if (balance_error() > closed_error_) {
    closed_error_ = balance_error();
    closed_error_time_ = worst_error_time_;
  }
  begin_balance(state, energy);
}

void RunWatch::go_on(const Equations<double>& equations, const State<double>& state) {
  motion_.set_design(equations);
  const BodyEnergy energy = motion_.energy(state.q, state.v);
  if (balanced_steps_ > kPatience) {
    smallest_scale_ = smallest_scale(equations.constants(), state);
    close_balance(state, energy);
    return;
  }
  start_energy_ = energy.total() - work_ - imbalance_;
  // The energy that the change of the design itself adds does not count as turnover.
  start_potential_ += energy.potential - potential_;
  potential_ = energy.potential;
}

double RunWatch::drift(const State<double>& state, const VectorX<double>& position_correction,
                       const VectorX<double>& velocity_correction) const {
  double drift = 0.0;
  const auto add = [&](const VectorX<double>& correction, const VectorX<double>& y) {
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const double size = std::abs(correction[k]),
                   scale =
                       options_.absolute_tolerance + options_.relative_tolerance * std::abs(y[k]);
      if (size > drift * scale) drift = size / scale;  // divides only for a new maximum
    }
  };
  add(position_correction, state.q);
  add(velocity_correction, state.v);
  return drift;
}

bool RunWatch::doubts(const BodyEnergy& energy, double work) const {
  constexpr double kShare = 0.01;
  const double open = energy.total() - start_energy_ - work_ - imbalance_;
  return std::abs(open - work) > kShare * energy_limit_.warning * std::max(scale_, std::abs(work));
}

Status RunWatch::check(const State<double>& state, double drift, double work,
                       Statistics* statistics) {
  return check(state, motion_.energy(state.q, state.v), drift, work, statistics);
}

Status RunWatch::check(const State<double>& state, const BodyEnergy& energy, double drift,
                       double work, Statistics* statistics) {
  if (drift > statistics->constraint_drift) {
    statistics->constraint_drift = drift;
    worst_drift_time_ = state.t;
  }
  potential_ = energy.potential;
  work_ += work;
  turnover_ += std::abs(work);
  scale_ =
      std::max(scale_, energy.kinetic + std::abs(energy.potential - start_potential_) + turnover_);
  imbalance_ = energy.total() - start_energy_ - work_;
  const double error = std::abs(imbalance_);
  if (error > worst_error_) {
    worst_error_ = error;
    worst_error_time_ = state.t;
  }
  if (reach_ < 1.0) {
    moved_ = state.q - start_q_;
    note_reach(moved_, state.q);
  }
  statistics->energy_error = std::max(closed_error_, balance_error());
  if (drift > drift_limit_.failure)
    return {StatusCode::kConstraintDrift, state.t,
            drift_sentence(drift, state.t) + ". " + advice(options_)};
  unbalanced_steps_ = reach_ * error > energy_limit_.failure * scale_ ? unbalanced_steps_ + 1 : 0;
  if (unbalanced_steps_ > kPatience || (unbalanced_steps_ > 0 && state.t >= end_))
    return {StatusCode::kEnergyError, state.t,
            energy_sentence(reach_ * error / scale_, state.t) + ". " + advice(options_)};
  ++balanced_steps_;
  const double span = system_.study().balance_time;
  if (span > 0.0 && state.t - balance_begin_ >= span && balanced_steps_ > kPatience)
    close_balance(state, energy);
  return {};
}

Warnings RunWatch::warnings(const Statistics& statistics) const {
  Warnings warnings;
  if (statistics.constraint_drift > drift_limit_.warning)
    warnings.push_back(
        {"constraint_drift",
         drift_sentence(statistics.constraint_drift, worst_drift_time_) + ". " + advice(options_),
         {}});
  const double time = balance_error() < closed_error_ ? closed_error_time_ : worst_error_time_;
  if (statistics.energy_error > energy_limit_.warning)
    warnings.push_back({"energy_error",
                        energy_sentence(statistics.energy_error, time) + ". " + advice(options_),
                        {}});
  return warnings;
}

}  // namespace codesign
