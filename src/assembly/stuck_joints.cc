// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/stuck_joints.h"

#include <cmath>
#include <complex>
#include <limits>

#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "equations/iteration_matrix.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

StuckJoints::StuckJoints(const CompiledSystem& system) : system_(system), stuck_(system) {}

Status StuckJoints::require_rest(const State<double>& state, Equations<double>* equations,
                                 std::vector<std::size_t>* contradicting) const {
  if (system_.stuck().empty()) return {};
  constexpr double kNoSlip = 1e-9;
  const double allowed =
      kNoSlip * (1.0 + (state.v.size() > 0 ? state.v.cwiseAbs().maxCoeff() : 0.0));
  equations->formulas().load(state);
  for (const StuckContact& stuck : system_.stuck()) {
    const BristleContact& contact = system_.bristles()[stuck.bristle];
    const ContactSlip<double> slip = bristle_slip(equations->formulas().view(), contact);
    for (int k = 0; k < contact.size; ++k)
      if (std::abs(slip.motion[to_index(k)].rate) > allowed) {
        contradicting->push_back(stuck.start);
        return {StatusCode::kInitialVelocityFailed, 0.0,
                "joint '" + system_.study().initial_state[stuck.start].joint +
                    "' shall start stuck, but moves with the velocities that are given"};
      }
  }
  return {};
}

/// Slip accelerations at the last solution of `rates` and their derivatives by the deflections,
/// which change the rates by -G_z^-1 G_zeta.
void StuckJoints::find_response(const State<double>& state, const RateSolution& rates,
                                Equations<double>* equations) {
  VectorX<double> a, limits, moved_a, unused, change;
  equations->stuck_slips(state, &a, &limits);
  Linearization<double> derivatives;
  derivatives.resize(system_.patterns());
  equations->linearize(state, &derivatives);
  Eigen::MatrixXd response(a.size(), a.size());
  State<double> moved = state, direction;
  direction.resize(system_.layout());
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    direction.s.setZero();
    direction.s[stuck_.state(k)] = 1.0;
    directional_derivative(system_, derivatives, direction, &change);
    change.conservativeResize(state.z.size());
    rates.solve_linear(change);
    moved.z = state.z - change;
    equations->stuck_slips(moved, &moved_a, &unused);
    response.col(k) = moved_a - a;
  }
  stuck_.set_slips(a, response, limits);
}

Status StuckJoints::hold(Equations<double>* equations, State<double>* state, RateSolution* rates,
                         Warnings* warnings) {
  if (stuck_.is_empty()) return rates->solve(equations, state);
  constexpr int kIterations = 50;
  const double converged = system_.compliance() == 0.0 ? 1e-11 : 1e-7;
  double previous = std::numeric_limits<double>::infinity();
  stuck_.begin();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (Status status = rates->solve(equations, state); !status.ok()) return status;
    find_response(*state, *rates, equations);
    const double change = stuck_.improve();
    if (!std::isfinite(change)) break;
    for (Eigen::Index k = 0; k < stuck_.size(); ++k)
      state->s[stuck_.state(k)] = stuck_.deflections()[k];
    if (change < 1e-15 || (change < converged && change >= 0.5 * previous)) {
      if (Status status = rates->solve(equations, state); !status.ok()) return status;
      find_response(*state, *rates, equations);
      warn_of_slides(warnings);
      return {};
    }
    previous = change;
  }
  return {StatusCode::kInitialReactionsFailed, 0.0,
          "no deflections of the bristles were found with which the joints that start stuck rest "
          "or begin to slide"};
}

void StuckJoints::warn_of_slides(Warnings* warnings) const {
  for (const std::size_t start : stuck_.sliding()) {
    const InitialJointState& initial = system_.study().initial_state[start];
    append({warn("start_slides",
                 {initial.where, "initial_state." + initial.joint + ".stuck",
                  "friction cannot hold this joint at the start: its bristles start with their "
                  "largest deflection, and it slides",
                  "true", "a smaller load, more friction, or no `stuck`"})},
           warnings);
  }
}

template <class T>
void StuckJoints::extend(const State<double>& start, const RateSolution& rates,
                         Equations<T>* equations, ExtensionWorkspace<T>* workspace,
                         State<T>* state) const {
  if (stuck_.is_empty()) return;
  for (Eigen::Index k = 0; k < stuck_.size(); ++k)
    state->s[stuck_.state(k)] = T(start.s[stuck_.state(k)]);
  rates.extend(start.z, equations, &workspace->rates, state);
  VectorX<T> a(stuck_.size()), limits(stuck_.size()), zeta(stuck_.size());
  equations->stuck_slips(*state, &a, &limits);
  for (Eigen::Index k = 0; k < stuck_.size(); ++k) zeta[k] = state->s[stuck_.state(k)];
  add_directions(stuck_.derivatives(directions_of(a), directions_of(limits)), &zeta);
  for (Eigen::Index k = 0; k < stuck_.size(); ++k) state->s[stuck_.state(k)] = zeta[k];
}

#define CODESIGN_INSTANTIATE(T)                                                                  \
  template void StuckJoints::extend<T>(const State<double>&, const RateSolution&, Equations<T>*, \
                                       ExtensionWorkspace<T>*, State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
