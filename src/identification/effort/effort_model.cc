// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/effort/effort_model.h"

#include <algorithm>
#include <stdexcept>

#include "description/study.h"
#include "engine/thread_engine.h"
#include "identification/effort/motion_projection.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "text/cancel.h"

namespace codesign {
namespace {

// Samples evaluated in a row by one thread; fixed, so that results do not depend on the number of
// threads.
constexpr int kBlock = 64;

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<int>& rows) {
  Eigen::MatrixXd part(to_signed(rows.size()), all.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) part.row(to_signed(k)) = all.row(rows[k]);
  return part;
}

void require_shape(const MotionSamples& motion, std::size_t joints) {
  for (const Eigen::MatrixXd* part : {&motion.position, &motion.velocity, &motion.acceleration})
    if (part->rows() != to_signed(joints) || part->cols() != motion.position.cols())
      throw std::invalid_argument(
          "a measured motion needs one row per joint and one column per sample");
  for (const std::size_t given : {motion.times.size(), motion.numbers.size()})
    if (given > 0 && to_signed(given) != motion.position.cols())
      throw std::invalid_argument("a measured motion needs one time per sample");
  if (motion.begins.empty() || motion.begins.front() != 0 ||
      !std::is_sorted(motion.begins.begin(), motion.begins.end()))
    throw std::invalid_argument("the first samples of the recordings begin with 0 and ascend");
}

/// The index of the drive of each shifted joint. @throws InputError
std::vector<int> drives_of(const std::vector<int>& shifted,
                           const std::vector<MeasuredJoint>& joints, const DrivenSystem& driven) {
  std::vector<int> drives;
  for (int joint : shifted) {
    const MeasuredJoint& measured = joints[to_index(joint)];
    const auto found = std::find(driven.drives.begin(), driven.drives.end(), joint);
    if (found == driven.drives.end() || !driven.surplus.empty())
      throw InputError(
          {measured.where, "identify",
           "a start can be fitted only if no more joints are measured than there are degrees of "
           "freedom",
           measured.name,
           "a known start, or recordings without the positions and velocities of other joints"});
    drives.push_back(static_cast<int>(found - driven.drives.begin()));
  }
  return drives;
}

/// Measured positions at a few instants.
Eigen::MatrixXd some_positions(const MotionSamples& motion) {
  constexpr int kInstants = 4;
  const Eigen::Index samples = motion.position.cols();
  if (samples == 0) return {};
  Eigen::MatrixXd some(motion.position.rows(), kInstants);
  for (int k = 0; k < kInstants; ++k)
    some.col(k) = motion.position.col(k * (samples - 1) / kInstants);
  return some;
}

}  // namespace

/// The workspace of one thread.
struct EffortModel::EffortWorker {
  EffortWorker(const DrivenSystem& driven, const std::vector<int>& shifted)
      : motion(driven),
        tangents(
            LaneCount{static_cast<int>(driven.system->whole_study().tuned.size() + shifted.size())},
            *driven.system, shifted) {}

  void reset_pivots() {
    motion.reset_pivots();
    tangents.for_each([](auto* group) { group->reset_pivots(); });
  }

  DrivenMotion motion;
  LaneGroups<EffortTangent> tangents;
  State<double> state;
};

EffortModel::EffortModel(const CompiledSystem& system, std::vector<MeasuredJoint> joints,
                         MotionSamples motion, int threads,
                         const std::vector<SignalDescription>& signals)
    : system_(system),
      joints_(std::move(joints)),
      motion_(std::move(motion)),
      driven_(make_driven_system(system, joints_, some_positions(motion_), signals)),
      unshifted_(rows_of(motion_.position, motion_.shifted)) {
  require_shape(motion_, joints_.size());
  shifted_drives_ = drives_of(motion_.shifted, joints_, driven_);
  for (int k : driven_.drives) names_.push_back(joints_[to_index(k)].name);
  position_ = rows_of(motion_.position, driven_.drives);
  velocity_ = rows_of(motion_.velocity, driven_.drives);
  acceleration_ = rows_of(motion_.acceleration, driven_.drives);
  states_.resize(to_index(samples()));
  workers_.resize(to_index(std::max(threads, 1)));
}

EffortModel::~EffortModel() = default;

DriveMotion EffortModel::given(int sample) const {
  const Eigen::Index drives = position_.rows();
  const auto column = [&](const Eigen::MatrixXd& of) {
    return In<double>(of.data() + sample * drives, drives);
  };
  return {column(position_), column(velocity_), column(acceleration_)};
}

Status EffortModel::at_sample(int sample, Status status) const {
  const int number = motion_.numbers.empty() ? sample : motion_.numbers[to_index(sample)];
  status.cause = "sample " + std::to_string(number) + ": " + status.cause;
  return status;
}

Status EffortModel::prepare(const std::vector<double>& parameters, EffortWorker* worker) const {
  worker->motion.set_design(parameters);
  const std::string fault = find_impossible(driven_.system->robot(), driven_.system->topology(),
                                            worker->motion.equations().constants());
  return fault.empty() ? Status() : Status{StatusCode::kInvalidDesign, 0.0, fault};
}

Status EffortModel::follow(const MotionProjection& projection, int sample, EffortWorker* worker) {
  worker->state.t = time(sample);
  if (projection.empty()) return worker->motion.follow(given(sample), &worker->state);
  const Eigen::VectorXd measured[] = {motion_.position.col(sample), motion_.velocity.col(sample),
                                      motion_.acceleration.col(sample)};
  Eigen::VectorXd drives[3];
  for (int order = 0; order < 3; ++order) drives[order] = rows_of(measured[order], driven_.drives);
  if (Status status = projection.project(measured, &drives, &worker->motion, &worker->state);
      !status.ok())
    return status;
  position_.col(sample) = drives[0];
  velocity_.col(sample) = drives[1];
  acceleration_.col(sample) = drives[2];
  return {};
}

void EffortModel::shift(const Eigen::MatrixXd& shifts) {
  for (std::size_t s = 0; s < motion_.shifted.size(); ++s)
    for (std::size_t k = 0; k < motion_.begins.size(); ++k) {
      const auto row = to_signed(s);
      const Eigen::Index first = motion_.begins[k];
      const Eigen::Index count =
          (k + 1 < motion_.begins.size() ? motion_.begins[k + 1] : Eigen::Index{samples()}) - first;
      auto position = motion_.position.row(motion_.shifted[s]).segment(first, count);
      position = unshifted_.row(row).segment(first, count).array() + shifts(row, to_signed(k));
      position_.row(shifted_drives_[s]).segment(first, count) = position;
    }
}

Status EffortModel::begin(const std::vector<double>& parameters) {
  for (std::unique_ptr<EffortWorker>& each : workers_) each.reset();
  EffortWorker worker(driven_, shifted_drives_);
  if (Status status = prepare(parameters, &worker); !status.ok()) return status;
  const MotionProjection projection(driven_, joints_);
  for (int sample = 0; sample < samples(); ++sample) {
    if (is_set(cancel_)) return {StatusCode::kCancelled, 0.0, "cancelled"};
    const bool first = std::binary_search(motion_.begins.begin(), motion_.begins.end(), sample);
    Status status;
    if (first)
      status = assemble_driven(system_, joints_, driven_, parameters, motion_.position.col(sample),
                               &worker.state);
    if (status.ok()) status = follow(projection, sample, &worker);
    if (!status.ok()) return at_sample(sample, status);
    states_[to_index(sample)] = worker.state;
  }
  // All workers begin with the same pivots, chosen here, so that the results do not depend on the
  // worker that evaluates a sample.
  for (std::unique_ptr<EffortWorker>& each : workers_) {
    each = std::make_unique<EffortWorker>(driven_, shifted_drives_);
    each->motion.set_design(parameters);
    if (samples() == 0) continue;
    if (Status status = each->motion.linearize(states_.front()); !status.ok())
      return at_sample(0, status);
    each->motion.keep_pivots();
  }
  return {};
}

EffortModel::Failure EffortModel::evaluate_block(int block, EffortWorker* worker,
                                                 Eigen::MatrixXd* efforts,
                                                 RowJacobian* jacobian) const {
  worker->reset_pivots();
  const int end = std::min(samples(), (block + 1) * kBlock),
            drives = static_cast<int>(position_.rows());
  for (int sample = block * kBlock; sample < end; ++sample) {
    State<double>& state = worker->state;
    state = states_[to_index(sample)];
    if (Status status = worker->motion.solve(given(sample), &state); !status.ok())
      return {sample, status};
    for (int k = 0; k < drives; ++k) (*efforts)(k, sample) = worker->motion.effort(state, k);
    for (int k = drives; k < static_cast<int>(outputs()); ++k)
      (*efforts)(k, sample) = worker->motion.equations().watched(to_index(k - drives), state);
    if (jacobian == nullptr) continue;
    if (Status status = worker->motion.linearize(state); !status.ok()) return {sample, status};
    worker->tangents.for_each([&](auto* group) {
      group->differentiate(worker->motion, state, sample * outputs(), jacobian);
    });
  }
  return {};
}

Status EffortModel::evaluate(const std::vector<double>& parameters, Eigen::MatrixXd* efforts,
                             RowJacobian* jacobian) {
  if (!workers_.back())
    throw std::logic_error("EffortModel::begin() must succeed before evaluate()");
  efforts->resize(outputs(), samples());
  if (jacobian != nullptr)
    jacobian->resize(outputs() * samples(), this->parameters() + to_signed(shifted_drives_.size()));
  const int blocks = (samples() + kBlock - 1) / kBlock;
  std::vector<Failure> failures(to_index(blocks));
  if (Status status = prepare(parameters, workers_.front().get()); !status.ok()) return status;
  std::atomic<int> next{0};
  side_by_side(workers_.size(), static_cast<int>(workers_.size()), [&](std::size_t k) {
    EffortWorker& worker = *workers_[k];
    if (k > 0) worker.motion.set_design(parameters);
    if (jacobian != nullptr)
      worker.tangents.for_each([&](auto* group) { group->set_design(parameters); });
    for (int block = next++; block < blocks && !is_set(cancel_); block = next++)
      failures[to_index(block)] = evaluate_block(block, &worker, efforts, jacobian);
  });
  if (is_set(cancel_)) return {StatusCode::kCancelled, 0.0, "cancelled"};
  for (const Failure& failure : failures)
    if (failure.sample >= 0) return at_sample(failure.sample, failure.status);
  return {};
}

}  // namespace codesign
