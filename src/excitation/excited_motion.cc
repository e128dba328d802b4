// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excited_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "assembly/driven_motion.h"
#include "description/study.h"
#include "engine/thread_engine.h"
#include "equations/formulas.h"
#include "identification/effort/effort_tangent.h"
#include "math/arrays.h"
#include "text/cancel.h"

namespace codesign {
namespace {

// Fixed, so that results do not depend on the number of threads.
constexpr Eigen::Index kSamplesInARow = 8;
// Relative step of central differences; their error is about its square.
constexpr double kDifference = 1e-5;

Status at_time_sample(Eigen::Index sample, Status status) {
  status.cause = "sample " + std::to_string(sample) + " of the trajectory: " + status.cause;
  return status;
}

Status cancelled() { return {StatusCode::kCancelled, 0.0, "cancelled"}; }

/// Calls make_driven_system() with messages for this use: they name the study, where
/// make_driven_system() names recordings.
DrivenSystem driven_by(const CompiledSystem& system, const std::vector<MeasuredJoint>& joints) {
  refuse_loads_of_time(system, "a motion is planned without loads that depend on the time");
  try {
    return make_driven_system(system, joints);
  } catch (const InputError& error) {
    throw InputError(in_words_of_study(
        error.fault(), "excite.joints",
        "its motion is not determined: it is not among excite.joints, and does not follow from "
        "them",
        "as many independent joints under excite.joints as there are degrees of freedom"));
  }
}

}  // namespace

/// The workspace of one thread.
struct ExcitedMotion::PathWorker {
  explicit PathWorker(const DrivenSystem& driven) : motion(driven), tangents(*driven.system) {}

  void set_design(const std::vector<double>& parameters) {
    motion.set_design(parameters);
    tangents.for_each([&](auto* group) { group->set_design(parameters); });
  }
  void reset_pivots() {
    motion.reset_pivots();
    tangents.for_each([](auto* group) { group->reset_pivots(); });
  }
  Status differentiate(const State<double>& at, Eigen::Index first_row, RowJacobian* rows) {
    if (Status status = motion.linearize(at); !status.ok()) return status;
    tangents.for_each([&](auto* group) { group->differentiate(motion, at, first_row, rows); });
    return {};
  }

  DrivenMotion motion;
  LaneGroups<EffortTangent> tangents;
  State<double> state;
  Eigen::MatrixXd effort, position, velocity;  // at the two points of a difference
  RowJacobian jacobian;
};

ExcitedMotion::ExcitedMotion(const CompiledSystem& system, std::vector<MeasuredJoint> joints,
                             const std::vector<MeasuredJoint>& followers,
                             std::vector<double> parameters, int threads)
    : system_(system),
      joints_(std::move(joints)),
      driven_(driven_by(system, joints_)),
      parameters_(std::move(parameters)) {
  const System& mechanism = *driven_.system;
  for (const MeasuredJoint& follower : followers)
    for (std::size_t joint = 0; joint < mechanism.robot().joints.size(); ++joint) {
      if (mechanism.robot().joints[joint].name != follower.name) continue;
      const CouplingTerm term =
          drive_of(mechanism.robot(), mechanism.topology(), static_cast<int>(joint)).terms.front();
      followers_.push_back({term.pair, term.element});
    }
  workers_.resize(to_index(std::max(threads, 1)));
}

ExcitedMotion::~ExcitedMotion() = default;

Eigen::Index ExcitedMotion::parameters() const {
  return to_signed(driven_.system->whole_study().tuned.size());
}

Status ExcitedMotion::begin(const Eigen::VectorXd& positions) {
  if (Status status = assemble_driven(system_, joints_, driven_, parameters_, positions, &rest_);
      !status.ok())
    return status;
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(positions.size());
  for (std::unique_ptr<PathWorker>& worker : workers_) {
    worker = std::make_unique<PathWorker>(driven_);
    worker->set_design(parameters_);
    State<double> state = rest_;
    if (Status status = worker->motion.follow({positions, still, still}, &state); !status.ok())
      return status;
    worker->motion.keep_pivots();
    if (worker == workers_.back()) rest_ = state;
  }
  return {};
}

/// Shares blocks of samples among the workers: work(sample, worker) returns a Status.
template <class Work>
Status ExcitedMotion::in_blocks(Eigen::Index samples, const Work& work) {
  const Eigen::Index blocks = (samples + kSamplesInARow - 1) / kSamplesInARow;
  std::vector<Status> statuses(to_index(samples));
  std::atomic<Eigen::Index> next{0};
  side_by_side(workers_.size(), static_cast<int>(workers_.size()), [&](std::size_t k) {
    for (Eigen::Index block = next++; block < blocks && !is_set(cancel_); block = next++) {
      workers_[k]->reset_pivots();
      const Eigen::Index end = std::min(samples, (block + 1) * kSamplesInARow);
      for (Eigen::Index sample = block * kSamplesInARow; sample < end; ++sample)
        statuses[to_index(sample)] = work(sample, workers_[k].get());
    }
  });
  if (is_set(cancel_)) return cancelled();
  for (std::size_t sample = 0; sample < statuses.size(); ++sample)
    if (!statuses[sample].ok()) return at_time_sample(to_signed(sample), statuses[sample]);
  return {};
}

void ExcitedMotion::read(PathWorker* worker, const State<double>& state, Eigen::Index column,
                         Eigen::MatrixXd* effort, Eigen::MatrixXd* position,
                         Eigen::MatrixXd* velocity) const {
  for (Eigen::Index k = 0; k < joints(); ++k)
    (*effort)(k, column) = worker->motion.effort(state, static_cast<int>(k));
  if (followers_.empty()) return;
  Formulas<double>& formulas = worker->motion.equations().formulas();
  formulas.load(state);
  for (std::size_t k = 0; k < followers_.size(); ++k) {
    const CoordinateMotion<double>& at =
        formulas.coordinate(followers_[k].pair, followers_[k].element);
    (*position)(to_signed(k), column) = at.position;
    (*velocity)(to_signed(k), column) = at.rate;
  }
}

Status ExcitedMotion::respond(const DrivePath& path, bool with_jacobian, PathResponse* response) {
  const Eigen::Index samples = path.samples();
  response->effort.resize(joints(), samples);
  response->follower_position.resize(followers(), samples);
  response->follower_velocity.resize(followers(), samples);
  response->jacobian.resize(with_jacobian ? samples * joints() : 0, parameters());
  states_.resize(to_index(samples));
  PathWorker& first = *workers_.front();
  first.reset_pivots();
  State<double> state = rest_;
  for (Eigen::Index sample = 0; sample < samples; ++sample) {
    if (is_set(cancel_)) return cancelled();
    const Eigen::VectorXd q = path.position.col(sample), v = path.velocity.col(sample),
                          a = path.acceleration.col(sample);
    if (Status status = first.motion.follow({q, v, a}, &state); !status.ok())
      return at_time_sample(sample, status);
    read(&first, state, sample, &response->effort, &response->follower_position,
         &response->follower_velocity);
    states_[to_index(sample)] = state;
  }
  if (!with_jacobian) return {};
  return in_blocks(samples, [&](Eigen::Index sample, PathWorker* worker) {
    return worker->differentiate(states_[to_index(sample)], sample * joints(), &response->jacobian);
  });
}

Status ExcitedMotion::differentiate_sample(const DrivePath& path, Eigen::Index sample,
                                           PathWorker* worker, Slopes* slopes) const {
  const Eigen::Index n = joints();
  const bool with_jacobian = slopes->jacobian.rows() > 0;
  worker->effort.resize(n, 2);
  worker->position.resize(followers(), 2);
  worker->velocity.resize(followers(), 2);
  worker->jacobian.resize(2 * n, parameters());
  std::array<Eigen::VectorXd, 3> given = {path.position.col(sample), path.velocity.col(sample),
                                          path.acceleration.col(sample)};
  for (Eigen::Index direction = 0; direction < 3 * n; ++direction) {
    double& moved = given[to_index(direction / n)][direction % n];
    const double here = moved, step = kDifference * std::max(1.0, std::abs(here));
    for (Eigen::Index side = 0; side < 2; ++side) {
      moved = side == 0 ? here - step : here + step;
      worker->state = states_[to_index(sample)];
      if (Status status = worker->motion.solve({given[0], given[1], given[2]}, &worker->state);
          !status.ok())
        return status;
      read(worker, worker->state, side, &worker->effort, &worker->position, &worker->velocity);
      if (!with_jacobian) continue;
      if (Status status = worker->differentiate(worker->state, side * n, &worker->jacobian);
          !status.ok())
        return status;
    }
    moved = here;
    const double factor = 0.5 / step;
    const Eigen::Index column = sample * 3 * n + direction;
    slopes->effort.col(column) = factor * (worker->effort.col(1) - worker->effort.col(0));
    slopes->follower_position.col(column) =
        factor * (worker->position.col(1) - worker->position.col(0));
    slopes->follower_velocity.col(column) =
        factor * (worker->velocity.col(1) - worker->velocity.col(0));
    if (with_jacobian)
      slopes->jacobian.middleRows(column * n, n) =
          factor * (worker->jacobian.bottomRows(n) - worker->jacobian.topRows(n));
  }
  return {};
}

Status ExcitedMotion::differentiate(const DrivePath& path, const PathResponse& response,
                                    Slopes* slopes) {
  const Eigen::Index columns = path.samples() * 3 * joints();
  slopes->effort.resize(joints(), columns);
  slopes->follower_position.resize(followers(), columns);
  slopes->follower_velocity.resize(followers(), columns);
  slopes->jacobian.resize(response.jacobian.rows() > 0 ? columns * joints() : 0, parameters());
  return in_blocks(path.samples(), [&](Eigen::Index sample, PathWorker* worker) {
    return differentiate_sample(path, sample, worker, slopes);
  });
}

}  // namespace codesign
