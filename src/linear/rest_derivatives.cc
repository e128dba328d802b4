// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/rest_derivatives.h"

#include <algorithm>

#include "elements/sampled_control.h"
#include "linear/sampled_motion.h"
#include "linear/scaled_solution.h"
#include "math/arrays.h"

namespace codesign {

RestDerivatives::RestDerivatives(const CompiledSystem& system, const LinearStudy& study)
    : system_(system),
      study_(study),
      tuned_(study.study.tuned.size()),
      unknowns_(system.layout().n + system.layout().states + system.layout().m),
      dropped_(to_index(system.layout().constraints())),
      lanes_(system) {
  lanes_.compiled().allow(false);
  for (const int row : system.dropped_rows()) dropped_[to_index(row)] = true;
}

/// A sampled controller rests if its sample leaves its memory, and its output, as they are.
void RestDerivatives::add_samples(VectorX<Number>* rows) {
  const Layout& layout = system_.layout();
  for (std::size_t c = 0; c < system_.controllers().size(); ++c) {
    const ControlRealization& realization = system_.study().controllers[c].realization;
    if (!realization.is_sampled()) continue;
    const ControllerStates& states = system_.controllers()[c].states;
    const ControlEvent event{ControlEvent::Kind::kSample, static_cast<int>(c),
                             first_sample(realization)};
    sampled_ = state_;
    lanes_.jump({event}, &sampled_);
    const auto set = [&](int state, int from) {
      if (state >= 0) (*rows)[layout.state_column(state)] = state_.s[state] - sampled_.s[from];
    };
    const int output = output_state(system_, event);
    for (const int state : {system_.controllers()[c].state, states.filter, states.last})
      set(state, state);
    // A model at rest needs no correction: both are zero.
    const double per_time = 1.0 / realization.sample_time;
    for (int k = states.estimate; k >= 0 && k < states.estimate + states.estimates; ++k)
      (*rows)[layout.state_column(k)] += per_time * (state_.s[k] - sampled_.s[k]);
    for (const std::vector<FilterPlace>& chain : states.inputs)
      for (const FilterPlace& place : chain)
        for (int k = 0; k < place.order; ++k) set(place.state + k, place.state + k);
    set(states.held, output);
    set(states.computed, output);
    for (int k = 0; k < realization.queued(); ++k) set(states.queue + k, output);
  }
}

/// The rows' derivatives by eight of the unknowns and parameters.
void RestDerivatives::evaluate(const State<double>& rest, const std::vector<double>& design,
                               Eigen::Index first, Eigen::MatrixXd* rows) {
  const Layout& layout = system_.layout();
  const Eigen::Index count = std::min<Eigen::Index>(kLanes, rows->cols() - first);
  std::vector<Number> parameters(design.begin(), design.end());
  cast_state(rest, &state_);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index at = first + k, s = at - layout.n, z = s - layout.states;
    Number& number = at < layout.n       ? state_.q[at]
                     : s < layout.states ? state_.s[s]
                     : z < layout.m
                         ? state_.z[layout.n + z]
                         : parameters[to_index(study_.study.tuned[to_index(z - layout.m)])];
    number.v[static_cast<int>(k)] = 1.0;
  }
  lanes_.set_design(study_.parameters_at(parameters));
  VectorX<Number> G, Phi, Phi_rate;
  Number g(0.0);
  lanes_.residual(state_, &G, &g);
  lanes_.constraint_errors(state_, &Phi, &Phi_rate);
  for (int row = 0; row < layout.constraints(); ++row)
    if (!dropped_[to_index(row)]) G[layout.lambda_column(row)] = Phi[row];
  add_samples(&G);
  for (Eigen::Index row = 0; row < G.size(); ++row)
    for (Eigen::Index k = 0; k < count; ++k)
      (*rows)(row, first + k) = G[row].v[static_cast<int>(k)];
}

std::vector<RestDerivatives::Change> RestDerivatives::at(const State<double>& rest,
                                                         const std::vector<double>& design) {
  const Layout& layout = system_.layout();
  Eigen::MatrixXd rows(layout.columns(), unknowns_ + to_signed(tuned_));
  for (Eigen::Index first = 0; first < rows.cols(); first += kLanes)
    evaluate(rest, design, first, &rows);
  const ScaledSolution solution(rows.leftCols(unknowns_));
  const Eigen::MatrixXd by_parameters = solution.solve(-rows.rightCols(to_signed(tuned_)));
  const Eigen::MatrixXd undetermined = solution.null_vectors();
  std::vector<Change> changes;
  for (const Eigen::MatrixXd* all : {&by_parameters, &undetermined})
    for (Eigen::Index k = 0; k < all->cols(); ++k) {
      const Eigen::VectorXd x = all->col(k);
      Change change{x.head(layout.n), x.segment(layout.n, layout.states),
                    Eigen::VectorXd::Zero(layout.columns())};
      change.z.segment(layout.n, layout.m) = x.tail(layout.m);
      changes.push_back(std::move(change));
    }
  return changes;
}

}  // namespace codesign
