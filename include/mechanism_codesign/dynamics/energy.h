// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DYNAMICS_ENERGY_H_
#define MECHANISM_CODESIGN_DYNAMICS_ENERGY_H_

#include "mechanism_codesign/dynamics/equations.h"
#include "mechanism_codesign/forces/spring_damper.h"

namespace codesign {

/// Mechanical energy of a state [J].
struct Energy {
  double kinetic = 0.0;    ///< sum of m v.v/2 + omega'.J omega'/2, omega' = 2 G p'
  double potential = 0.0;  ///< sum of -m g.r, and of the spring-dampers' elastic energy

  double total() const { return kinetic + potential; }
};

inline Energy mechanical_energy(const System& system, const Constants<double>& constants, const State<double>& state) {
  Energy energy;
  const Eigen::Vector3d g(system.study().gravity.data());
  for (std::size_t b = 0; b < constants.bodies.size(); ++b) {
    const auto c = static_cast<Eigen::Index>(kBodySize * b);
    const BodyConstants<double>& body = constants.bodies[b];
    const Eigen::Vector3d velocity = state.v.segment<3>(c);
    const Vector4<double> p = state.q.segment<4>(c + 3), pd = state.v.segment<4>(c + 3);
    const Eigen::Vector3d omega = 2.0 * (body_rate_matrix(p) * pd);
    energy.kinetic += 0.5 * body.mass * velocity.squaredNorm() + 0.5 * omega.dot(body.J * omega);
    energy.potential -= body.mass * g.dot(state.q.segment<3>(c));
  }
  const auto point = [&state](int body, const Eigen::Vector3d& s) {
    return body < 0
               ? s
               : Eigen::Vector3d(state.q.segment<3>(kBodySize * body) + rotation<double>(state.q.segment<4>(kBodySize * body + 3)) * s);
  };
  for (const SpringDamperConstants<double>& spring : constants.springs)
    energy.potential +=
        spring_energy<double>(point(spring.body_j, spring.s_j) - point(spring.body_i, spring.s_i), spring.stiffness, spring.free_length);
  return energy;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DYNAMICS_ENERGY_H_
