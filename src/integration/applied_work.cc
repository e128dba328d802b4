// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/applied_work.h"

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

BodyMotion::BodyMotion(const CompiledSystem& system)
    : system_(system),
      gravity_(system.study().gravity.data()),
      bodies_(static_cast<std::size_t>(system.layout().bodies)),
      forest_(system.layout()),
      rest_(Eigen::VectorXd::Zero(system.layout().n)) {}

void BodyMotion::set_design(const Constants<double>& constants) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b] = {constants.bodies[b].mass, constants.bodies[b].J};
  if (!system_.layout().has_forest()) return;
  constants_ = constants;
  is_known_ = false;
}

void BodyMotion::sweep(const VectorX<double>& q, const VectorX<double>& v, const double* a) const {
  const Layout& layout = system_.layout();
  q_ = q, v_ = v;
  is_known_ = true;
  for (int b = 0; b < layout.bodies; ++b) {
    if (!layout.is_free(b)) continue;
    const int c = layout.column(b);
    BodyKinematics<double> k;
    k.r = q.segment<3>(c), k.p = q.segment<4>(c + 3);
    k.rd = v.segment<3>(c), k.pd = v.segment<4>(c + 3);
    k.rdd = Vector3d(a + c), k.pdd = Eigen::Vector4d(a + c + 3);
    k.A = rotation(k.p);
    set_free_motion<double>(k, gravity_, &forest_.body(b));
  }
  sweep_out<double>(system_, constants_, gravity_, q.data(), v.data(), a, &forest_);
}

void BodyMotion::move(const VectorX<double>& q, const VectorX<double>& v) const {
  if (system_.layout().has_forest() && !(is_known_ && q == q_ && v == v_)) sweep(q, v, rest_.data());
}

double BodyMotion::distance(int body, const VectorX<double>& q) const {
  return system_.layout().has_forest() ? forest_.body(body).r.norm() : q.segment<3>(kBodySize * body).norm();
}

BodySpeed BodyMotion::speed(int body, const VectorX<double>& v) const {
  if (system_.layout().has_forest()) return {forest_.body(body).velocity.norm(), forest_.body(body).omega.norm()};
  // |omega| = 2 |p'|, since p' is orthogonal to the unit vector p.
  return {v.segment<3>(kBodySize * body).norm(), 2.0 * v.segment<4>(kBodySize * body + 3).norm()};
}

BodyEnergy BodyMotion::energy(const VectorX<double>& q, const VectorX<double>& v) const {
  BodyEnergy energy;
  const auto add = [&](const Body& body, const Vector3d& r, const Vector3d& velocity, const Vector3d& omega) {
    energy.kinetic += 0.5 * (body.mass * velocity.squaredNorm() + omega.dot(body.J * omega));
    energy.potential -= body.mass * gravity_.dot(r);
  };
  if (system_.layout().has_forest()) {
    move(q, v);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      add(bodies_[b], forest_.bodies[b].r, forest_.bodies[b].velocity, forest_.bodies[b].omega);
    return energy;
  }
  const double *r = q.data(), *rate = v.data();
  for (const Body& body : bodies_) {
    add(body, vector(r), vector(rate), spin(r + 3, rate + 3));
    r += kBodySize;
    rate += kBodySize;
  }
  return energy;
}

// The velocity terms 8 G'^T J G p' of (9) and omega x J omega have no power.
double BodyMotion::power(const VectorX<double>& q, const VectorX<double>& v, In<double> z) const {
  assert(q.size() == v.size() && z.size() >= v.size());
  double power = 0.0;
  if (system_.layout().has_forest()) {
    sweep(q, v, z.data());
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const AxesMotion<double>& m = forest_.bodies[b];
      power += bodies_[b].mass * m.velocity.dot(m.acceleration) + m.omega.dot(bodies_[b].J * m.alpha);
    }
    return power;
  }
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
