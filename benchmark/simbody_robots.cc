// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <Simbody.h>

#include <cmath>

#include "benchmark/robot_peers.h"

namespace codesign {
namespace {

using SimTK::Rotation;
using SimTK::Transform;
using SimTK::Vec3;

constexpr double kTransitionVelocity = 0.01;

Vec3 vector(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// Friction of all joints as in URDF's <dynamics>.
class JointFriction : public SimTK::Force::Custom::Implementation {
 public:
  explicit JointFriction(const Robot& robot) : robot_(robot) {}

  void add(const SimTK::MobilizedBody& body) { bodies_.push_back(body); }
  bool dependsOnlyOnPositions() const override { return false; }
  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>&,
                 SimTK::Vector_<Vec3>&, SimTK::Vector& forces) const override {
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const RobotLink& link = robot_.links[k];
      const double v = bodies_[k].getOneU(state, SimTK::MobilizerUIndex(0));
      const double dry =
          link.friction == 0.0 ? 0.0 : link.friction * std::tanh(4.0 * v / kTransitionVelocity);
      bodies_[k].applyOneMobilityForce(state, SimTK::MobilizerUIndex(0), -link.damping * v - dry,
                                       forces);
    }
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  const Robot& robot_;
  std::vector<SimTK::MobilizedBody> bodies_;
};

SimTK::Body::Rigid body_of(const RobotLink& link) {
  const std::array<double, 3> I = inertia(link);
  const Vec3 centre = vector(link.centre);
  return SimTK::Body::Rigid(SimTK::MassProperties(
      link.mass, centre, SimTK::Inertia(I[0], I[1], I[2]).shiftFromMassCenter(centre, link.mass)));
}

/// Adds a link. Simbody's pin turns about z and its slider slides along x of the joint frame.
SimTK::MobilizedBody add_link(const RobotLink& link, SimTK::MobilizedBody& parent) {
  const Rotation frame(SimTK::BodyRotationSequence, link.rpy[2], SimTK::ZAxis, link.rpy[1],
                       SimTK::YAxis, link.rpy[0], SimTK::XAxis);
  const SimTK::UnitVec3 axis(Vec3(link.axis == 'x', link.axis == 'y', link.axis == 'z'));
  const Rotation to_axis(axis, SimTK::CoordinateAxis(link.slides ? 0 : 2));
  const Transform inboard(frame * to_axis, vector(link.origin)), outboard(to_axis);
  if (link.slides) return SimTK::MobilizedBody::Slider(parent, inboard, body_of(link), outboard);
  return SimTK::MobilizedBody::Pin(parent, inboard, body_of(link), outboard);
}

RobotMotion run(const SimTK::MultibodySystem& system,
                const std::vector<SimTK::MobilizedBody>& bodies, const SimTK::State& start,
                const Robot& robot, double accuracy) {
  RobotMotion motion;
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  integrator.setAllowInterpolation(false);
  integrator.initialize(start);
  for (int k = 1; k <= kInstants; ++k) {
    const double t = k == kInstants ? robot.duration : robot.duration * k / kInstants;
    while (integrator.getTime() < t) integrator.stepTo(t);
    for (const SimTK::MobilizedBody& body : bodies)
      motion.positions.push_back(body.getOneQ(integrator.getState(), SimTK::MobilizerQIndex(0)));
  }
  motion.steps = integrator.getNumStepsTaken();
  return motion;
}

}  // namespace

// Stiff motions need its CPODES, whose functions have the names of those of SUNDIALS, which this
// program is linked with.
std::optional<RobotMotion> run_simbody_robot(const Robot& robot, double accuracy) {
  if (robot.is_stiff()) return std::nullopt;
  SimTK::MultibodySystem system;
  system.setUseUniformBackground(true);
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::Force::UniformGravity gravity(forces, matter, Vec3(0, 0, -9.81));
  auto* friction = new JointFriction(robot);
  SimTK::Force::Custom custom(forces, friction);  // owns it
  std::vector<SimTK::MobilizedBody> bodies;
  for (const RobotLink& link : robot.links) {
    SimTK::MobilizedBody& parent =
        link.parent < 0 ? matter.updGround() : bodies[static_cast<std::size_t>(link.parent)];
    bodies.push_back(add_link(link, parent));
    friction->add(bodies.back());
  }
  SimTK::State start = system.realizeTopology();
  for (std::size_t k = 0; k < bodies.size(); ++k)
    bodies[k].setOneQ(start, SimTK::MobilizerQIndex(0), robot.links[k].position);
  return run(system, bodies, start, robot, accuracy);
}

}  // namespace codesign
