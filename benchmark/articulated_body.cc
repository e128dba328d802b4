// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/articulated_body.h"

#include <Eigen/Geometry>
#include <cmath>

namespace codesign {
namespace {

constexpr double kGravity = 9.81, kTransitionVelocity = 0.01;

Eigen::Vector3d vector(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// The matrix of the product x times.
Eigen::Matrix3d cross(const Eigen::Vector3d& x) {
  Eigen::Matrix3d product;
  product << 0.0, -x[2], x[1], x[2], 0.0, -x[0], -x[1], x[0], 0.0;
  return product;
}

Eigen::Matrix3d rotation(const std::array<double, 3>& rpy) {
  return (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

ArticulatedBody::ArticulatedBody(const Robot& robot) {
  for (const RobotLink& from : robot.links) {
    Link& link = links_.emplace_back();
    link.parent = from.parent;
    link.axis = from.axis - 'x';
    link.slides = from.slides;
    link.origin = vector(from.origin);
    link.frame = rotation(from.rpy);
    link.mass = from.mass;
    link.moment = from.mass * vector(from.centre);
    const Matrix c = cross(vector(from.centre));
    link.inertia = -from.mass * c * c;
    link.inertia.diagonal() += vector(codesign::inertia(from));
    link.damping = from.damping;
    link.friction = from.friction;
    link.position = from.position;
  }
}

Eigen::VectorXd ArticulatedBody::start() const {
  Eigen::VectorXd q(joints());
  for (int k = 0; k < joints(); ++k) q[k] = links_[static_cast<std::size_t>(k)].position;
  return q;
}

// Pose and velocity from the parent's, the bias of the acceleration, and the load that the link
// needs for its velocity.
void ArticulatedBody::go_out(Link* link, double q, double v) const {
  Link& l = *link;
  l.turn = l.frame;
  l.arm = l.origin;
  if (l.slides) {
    l.arm += q * l.frame.col(l.axis);
  } else {
    const int i = (l.axis + 1) % 3, j = (l.axis + 2) % 3;
    const double c = std::cos(q), s = std::sin(q);
    l.turn.col(i) = c * l.frame.col(i) + s * l.frame.col(j);
    l.turn.col(j) = c * l.frame.col(j) - s * l.frame.col(i);
  }
  l.motion = {};
  if (l.parent >= 0) {
    const Spatial& parent = links_[static_cast<std::size_t>(l.parent)].motion;
    l.motion.turn.noalias() = l.turn.transpose() * parent.turn;
    l.motion.shift.noalias() = l.turn.transpose() * (parent.shift + parent.turn.cross(l.arm));
  }
  (l.slides ? l.motion.shift : l.motion.turn)[l.axis] += v;
  const Vector along = v * Vector::Unit(l.axis), &w = l.motion.turn, &u = l.motion.shift;
  l.bias.turn = l.slides ? Vector(Vector::Zero()) : w.cross(along);
  l.bias.shift = l.slides ? w.cross(along) : u.cross(along);
  const Vector angular = l.inertia * w + l.moment.cross(u), linear = l.mass * u - l.moment.cross(w);
  l.load.turn = w.cross(angular) + u.cross(linear);
  l.load.shift = w.cross(linear);
  l.I = l.inertia;
  l.H = cross(l.moment);
  l.M = l.mass * Matrix::Identity();
  l.effort = -l.damping * v -
             (l.friction == 0.0 ? 0.0 : l.friction * std::tanh(4.0 * v / kTransitionVelocity));
}

// Articulated inertia and load without what the joint leaves free, added to the parent's.
void ArticulatedBody::come_back(Link* link) {
  Link& l = *link;
  l.push = l.slides ? Spatial{l.H.col(l.axis), l.M.col(l.axis)}
                    : Spatial{l.I.col(l.axis), l.H.row(l.axis)};
  l.inverse = 1.0 / (l.slides ? l.push.shift : l.push.turn)[l.axis];
  l.effort -= (l.slides ? l.load.shift : l.load.turn)[l.axis];
  if (l.parent < 0) return;
  const Vector turn = l.inverse * l.push.turn, shift = l.inverse * l.push.shift;
  l.I.noalias() -= turn * l.push.turn.transpose();
  l.H.noalias() -= turn * l.push.shift.transpose();
  l.M.noalias() -= shift * l.push.shift.transpose();
  const Vector moment = l.load.turn + l.I * l.bias.turn + l.H * l.bias.shift + l.effort * turn;
  const Vector force =
      l.load.shift + l.H.transpose() * l.bias.turn + l.M * l.bias.shift + l.effort * shift;
  Link& parent = links_[static_cast<std::size_t>(l.parent)];
  const Vector turned = l.turn * force;
  parent.load.shift += turned;
  parent.load.turn += l.turn * moment + l.arm.cross(turned);
  const Matrix r = cross(l.arm), M = l.turn * l.M * l.turn.transpose(),
               inner = l.turn * l.H * l.turn.transpose(), H = inner + r * M;
  parent.M += M;
  parent.H += H;
  parent.I += l.turn * l.I * l.turn.transpose() - inner * r + r * H.transpose();
}

double ArticulatedBody::accelerate(Link* link) const {
  Link& l = *link;
  if (l.parent < 0) {
    l.acceleration.turn = l.bias.turn;
    l.acceleration.shift = l.turn.row(2).transpose() * kGravity + l.bias.shift;
  } else {
    const Spatial& parent = links_[static_cast<std::size_t>(l.parent)].acceleration;
    l.acceleration.turn = l.turn.transpose() * parent.turn + l.bias.turn;
    l.acceleration.shift =
        l.turn.transpose() * (parent.shift + parent.turn.cross(l.arm)) + l.bias.shift;
  }
  const double a = l.inverse * (l.effort - l.push.turn.dot(l.acceleration.turn) -
                                l.push.shift.dot(l.acceleration.shift));
  (l.slides ? l.acceleration.shift : l.acceleration.turn)[l.axis] += a;
  return a;
}

void ArticulatedBody::accelerations(const double* q, const double* v, double* acceleration) {
  for (std::size_t k = 0; k < links_.size(); ++k) go_out(&links_[k], q[k], v[k]);
  for (std::size_t k = links_.size(); k-- > 0;) come_back(&links_[k]);
  for (std::size_t k = 0; k < links_.size(); ++k) acceleration[k] = accelerate(&links_[k]);
}

}  // namespace codesign
