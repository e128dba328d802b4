// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/applied_work.h"

#include <algorithm>
#include <cassert>

namespace codesign {
namespace {

using Vector3d = Eigen::Vector3d;

/// 2 G(p) r: the angular velocity for r = p', the angular acceleration for r = p''; both in body axes.
Vector3d spin(const double* p, const double* r) {
  return {2.0 * (-p[1] * r[0] + p[0] * r[1] + p[3] * r[2] - p[2] * r[3]), 2.0 * (-p[2] * r[0] - p[3] * r[1] + p[0] * r[2] + p[1] * r[3]),
          2.0 * (-p[3] * r[0] + p[2] * r[1] - p[1] * r[2] + p[0] * r[3])};
}

Vector3d vector(const double* x) { return {x[0], x[1], x[2]}; }

}  // namespace

BodyMotion::Measured::Measured(const CompiledSystem& system) : equations(system), energies(3), bodies(9 * system.layout().bodies) {
  at.resize(system.layout());
}

BodyMotion::BodyMotion(const CompiledSystem& system)
    : gravity_(system.study().gravity.data()),
      bodies_(static_cast<std::size_t>(system.layout().bodies)),
      measured_(system.layout().has_forest() ? std::make_unique<Measured>(system) : nullptr) {}

void BodyMotion::set_design(const Equations<double>& equations) {
  const Constants<double>& constants = equations.constants();
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b] = {constants.bodies[b].mass, constants.bodies[b].J};
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
  if (measured_ && !(measured_->is_known && q == measured_->at.q && v == measured_->at.v)) measure(q, v, {});
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
    power += body.mass * vector(rate).dot(vector(a) - gravity_) + spin(r + 3, rate + 3).dot(body.J * spin(r + 3, a + 3));
    r += kBodySize;
    rate += kBodySize;
    a += kBodySize;
  }
  return power;
}

void StepWork::start(const State<double>& state, const BodyMotion& motion) { power_ = motion.power(state.q, state.v, state.z); }

double StepWork::over(const RosenbrockStep<double>& step, const BodyMotion& motion) {
  const State<double>& to = step.state();
  double psi = 0.0;
  step.interpolate(0.5, &middle_, &psi);
  const double begun = power_, middle = motion.power(middle_.q, middle_.v, middle_.z);
  // The end last: the checks that follow ask for the motion there.
  power_ = motion.power(to.q, to.v, to.z);
  return step.step_size() / 6.0 * (begun + 4.0 * middle + power_);
}

}  // namespace codesign
