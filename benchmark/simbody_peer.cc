// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/simbody_peer.h"

#include <Simbody.h>

#include <cmath>

#include "benchmark/slider_crank.h"

namespace codesign {
namespace {

using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Transform;
using SimTK::Vec3;

constexpr double kReferenceSpeed = -10.0, kTorqueWeight = 0.01, kTransitionVelocity = 0.01,
                 kDuration = 2.0;

/// The crank's controller, the slider's friction, and the integral of the objective.
class Loads : public SimTK::Force::Custom::Implementation {
 public:
  Loads(const SimTK::SimbodyMatterSubsystem& matter, const MobilizedBody& crank,
        const MobilizedBody& slider, double Kp)
      : matter_(matter), crank_(crank), slider_(slider), Kp_(Kp) {}

  void realizeTopology(SimTK::State& state) const override {
    psi_ = matter_.allocateZ(state, SimTK::Vector(1, 0.0));
  }
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>&,
                 SimTK::Vector_<Vec3>&, SimTK::Vector& forces) const override {
    crank_.applyOneMobilityForce(state, SimTK::MobilizerUIndex(0), -Kp_ * error(state), forces);
    const double speed = slider_.getOneU(state, SimTK::MobilizerUIndex(0));
    slider_.applyOneMobilityForce(state, SimTK::MobilizerUIndex(0),
                                  -kDryFriction * std::tanh(4.0 * speed / kTransitionVelocity),
                                  forces);
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }
  void realizeAcceleration(const SimTK::State& state) const override {
    const double e = error(state);
    matter_.updZDot(state)[psi_] = e * e * (1.0 + kTorqueWeight * Kp_ * Kp_);
  }
  double psi(const SimTK::State& state) const { return matter_.getZ(state)[psi_]; }

 private:
  double error(const SimTK::State& state) const {
    return crank_.getOneU(state, SimTK::MobilizerUIndex(0)) - kReferenceSpeed;
  }

  const SimTK::SimbodyMatterSubsystem& matter_;
  const MobilizedBody &crank_, &slider_;
  double Kp_;
  mutable SimTK::ZIndex psi_;
};

SimTK::Body::Rigid rigid_body(double mass, double x, double y, double z) {
  return SimTK::Body::Rigid(SimTK::MassProperties(mass, Vec3(0), SimTK::Inertia(x, y, z)));
}

/// Axes of the rod at the start: y from the slider to the crank pin, x normal to the slider's pin.
Rotation rod_axes(const Vec3& slider, const Vec3& crank_pin) {
  const SimTK::UnitVec3 along(crank_pin - slider);
  return Rotation(along, SimTK::YAxis, Vec3(SimTK::cross(along, Vec3(0, 0, 1))), SimTK::XAxis);
}

}  // namespace

SimbodyResult run_simbody(double crank_length, double rod_length, double Kp, double accuracy) {
  SimTK::MultibodySystem system;
  system.setUseUniformBackground(true);
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::Force::UniformGravity gravity(forces, matter, Vec3(0, 0, -9.81));
  const Vec3 centre(0, 0.1, 0.12);
  const Rotation upright(SimTK::Pi / 2, SimTK::XAxis),
      z_to_x(SimTK::Pi / 2, SimTK::YAxis);  // a pin turns about z
  MobilizedBody::Pin crank(matter.Ground(), Transform(upright * z_to_x, centre),
                           rigid_body(0.12, 1e-4, 1e-5, 1e-4), Transform(z_to_x));
  MobilizedBody::Ball rod(crank, Transform(Vec3(0, crank_length, 0)),
                          rigid_body(0.5, 4e-3, 4e-4, 4e-3), Transform(Vec3(0, rod_length / 2, 0)));
  MobilizedBody::Slider slider(matter.Ground(), Transform(), rigid_body(2.0, 1e-4, 1e-4, 1e-4),
                               Transform());
  SimTK::Constraint::Ball pin(rod, Vec3(0, -rod_length / 2, 0), slider, Vec3(0));
  SimTK::Constraint::ConstantAngle right_angle(rod, SimTK::UnitVec3(SimTK::XAxis), slider,
                                               SimTK::UnitVec3(SimTK::ZAxis), SimTK::Pi / 2);
  auto* loads = new Loads(matter, crank, slider, Kp);
  SimTK::Force::Custom custom(forces, loads);  // owns them

  SimTK::State state = system.realizeTopology();
  const Vec3 crank_pin = centre + Vec3(0, 0, crank_length);
  const Vec3 start(std::sqrt(rod_length * rod_length - crank_pin[1] * crank_pin[1] -
                             crank_pin[2] * crank_pin[2]),
                   0, 0);
  slider.setOneQ(state, SimTK::MobilizerQIndex(0), start[0]);
  rod.setQToFitRotation(state, ~upright * rod_axes(start, crank_pin));
  system.realize(state, SimTK::Stage::Velocity);
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  integrator.setFinalTime(kDuration);
  integrator.initialize(state);
  while (integrator.getTime() < kDuration) integrator.stepTo(kDuration);
  return {loads->psi(integrator.getState()), integrator.getNumStepsTaken()};
}

}  // namespace codesign
