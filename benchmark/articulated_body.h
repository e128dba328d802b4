// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "benchmark/robots.h"

namespace codesign {

/// The articulated-body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 7.3)
/// as one would write it for one program: a reference that shares nothing with the library. Vectors
/// of a link are in its own axes, moments about its origin. Allocates nothing after the
/// constructor.
class ArticulatedBody {
 public:
  explicit ArticulatedBody(const Robot& robot);

  int joints() const { return static_cast<int>(links_.size()); }
  Eigen::VectorXd start() const;  ///< positions at the start

  /// The accelerations at positions q and rates v, under gravity along -z and friction as in URDF's
  /// <dynamics>.
  void accelerations(const double* q, const double* v, double* acceleration);

 private:
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  /// A spatial vector: (angular, linear) of motions, (moment, force) of loads.
  struct Spatial {
    Vector turn = Vector::Zero(), shift = Vector::Zero();
  };

  struct Link {
    int parent, axis;
    bool slides;
    Vector origin;
    Matrix frame;  ///< joint axes to parent axes at position 0
    double mass;
    Vector moment;   ///< mass times centre
    Matrix inertia;  ///< about the link's origin
    double damping, friction, position;

    Matrix turn;  ///< link axes to parent axes
    Vector arm;   ///< the link's origin in the parent
    Spatial motion, bias, load, push, acceleration;
    Matrix I, H,
        M;  ///< articulated inertia: moment = I angular + H linear, force = H^T angular + M linear
    double inverse, effort;
  };

  void go_out(Link* link, double q, double v) const;
  void come_back(Link* link);
  double accelerate(Link* link) const;

  std::vector<Link> links_;
};

}  // namespace codesign
