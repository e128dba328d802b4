// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/segment_run.h"

#include <algorithm>

#include "math/arrays.h"

namespace codesign {

SegmentRun::SegmentRun(const SegmentSystem& of, const SegmentBegin& first)
    : system_(*of.system),
      starts_(of.starts),
      integrator_(system_),
      groups_(system_, integrator_.step().tableau()) {
  state_.resize(system_.layout());
  groups_.for_each([](auto* group) { group->step.keep_previous(true); });
  const double tolerance = system_.whole_study().solver.sensitivity_tolerance;
  stages_ = [this, tolerance](OneStep<double>* step) {
    double error = 0.0;
    for_each_group([&](auto* group) {
      group->step.attempt(step);
      if (tolerance > 0.0) error = std::max(error, group->step.error(*step, tolerance));
    });
    return error;
  };
  // The first start of an integrator chooses the pivots for all later starts; if this design cannot
  // start, a later start chooses them.
  integrator_.assembly().begin_at(first.time, first.theta);
  static_cast<void>(integrator_.start(system_.parameters()));
}

void SegmentRun::choose(SegmentLanes lanes) {
  const int all = static_cast<int>(system_.whole_study().tuned.size());
  // If the error test includes sensitivities, all derivatives are computed in every run, so that
  // steps do not depend on `lanes`.
  const bool is_whole =
      lanes == SegmentLanes::kAll || system_.whole_study().solver.sensitivity_tolerance > 0.0;
  first_lane_ = is_whole ? 0 : lanes == SegmentLanes::kStart ? all - starts_ : all;
}

Status SegmentRun::start(const std::vector<double>& parameters, const SegmentBegin& begin) {
  integrator_.assembly().begin_at(begin.time, begin.theta);
  if (Status status = integrator_.start(parameters); !status.ok()) return status;
  for_each_group([&](auto* group) {
    group->step.start(group->range.seed(system_, parameters), integrator_.assembly(),
                      integrator_.initial_state(), integrator_.mode());
  });
  reads_rates_ = false;
  for (std::size_t k = 0; k < system_.watched().size(); ++k) {
    integrator_.equations().watched_gradient(k, integrator_.state(), &sparse_);
    reads_rates_ = reads_rates_ || !sparse_.rate.empty();
  }
  return {};
}

Status SegmentRun::run(const std::vector<double>& parameters, const SegmentBegin& begin,
                       const std::vector<double>& times, SegmentLanes lanes) {
  choose(lanes);
  const auto outputs = to_signed(system_.watched().size()), count = to_signed(times.size());
  values_.resize(count, outputs);
  slopes_.resize(count * outputs, to_signed(system_.whole_study().tuned.size()));
  if (Status status = start(parameters, begin); !status.ok()) return status;
  for (Eigen::Index row = 0; row < count; ++row) {
    const double time = times[to_index(row)];
    while (integrator_.state().t < time) {
      if (Status status = advance(times.back()); !status.ok()) return status;
      ++steps_;
    }
    if (Status status = sample(time, row); !status.ok()) return status;
  }
  if (!are_finite(lanes))
    return {StatusCode::kNonFiniteGradient, times.back(),
            "the derivatives of the simulated motion are not finite, though the motion is"};
  return {};
}

Status SegmentRun::advance(double limit) {
  Status status = integrator_.jump();
  if (status.ok() && integrator_.has_jumped())
    for_each_group([this](auto* group) { group->step.jump(&integrator_); });
  if (status.ok()) status = integrator_.advance(limit, stages_);
  if (status.ok()) for_each_group([this](auto* group) { group->step.accept(integrator_.step()); });
  return status;
}

bool SegmentRun::are_finite(SegmentLanes lanes) const {
  if (lanes == SegmentLanes::kAll) return slopes_.allFinite();
  return lanes == SegmentLanes::kNone || slopes_.rightCols(starts_).allFinite();
}

Status SegmentRun::sample(double time, Eigen::Index row) {
  double psi = 0.0;
  integrator_.interpolate(time, &state_, &psi);
  if (reads_rates_)
    if (Status status = integrator_.assembly().rates().solve(&integrator_.equations(), &state_);
        !status.ok())
      return status;
  for (Eigen::Index output = 0; output < values_.cols(); ++output)
    values_(row, output) = integrator_.equations().watched(to_index(output), state_);
  for_each_group([&](auto* group) {
    group->step.all_watched(integrator_.step(), state_, reads_rates_, integrator_.assembly(),
                            &group->outputs);
    for (Eigen::Index output = 0; output < values_.cols(); ++output)
      slopes_.row(output * values_.rows() + row).segment(group->range.first, group->range.count) =
          group->outputs.col(output).head(group->range.count).transpose();
  });
  if (values_.row(row).allFinite()) return {};
  return {StatusCode::kNonFinite, time, "the simulated motion is not finite"};
}

}  // namespace codesign
