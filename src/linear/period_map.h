// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "linear/sampled_motion.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "math/linear_systems.h"

namespace codesign {

/// Sample k writes to place k mod the length of a queue; the next period begins with another place.
/// @param map of which the rows of queues change places: those of states from `motions` on.
template <class Matrix>
void renumber_queues(const System& system, const SamplePattern& pattern, Eigen::Index motions,
                     Matrix* map) {
  for (std::size_t c = 0; c < pattern.samples.size(); ++c) {
    const int queued = system.study().controllers[c].realization.queued();
    if (queued == 0) continue;
    const Eigen::Index first = motions + system.controllers()[c].states.queue;
    const Matrix places = map->middleRows(first, queued);
    for (int k = 0; k < queued; ++k)
      map->row(first + k) = places.row((k + pattern.samples[c]) % queued);
  }
}

/// The map of [x | u | w] over one period, theory (68), w only where a loop is opened: one entry
/// per sample of its controller. T: double, or std::complex<double>, whose imaginary parts are
/// derivatives.
template <class T>
class PeriodMap {
 public:
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  /// events at one instant -> the states s behind them by x and u
  using Jump = std::function<Matrix(const std::vector<ControlEvent>&)>;

  /// @param A, B of the flow between events. @param motions number of states x before s. @param
  /// opened the controller whose loop is opened at its output; -1: none.
  PeriodMap(const Matrix& A, const Matrix& B, const System& system, Eigen::Index motions,
            const SamplePattern& pattern, int opened, Jump jump)
      : system_(system),
        motions_(motions),
        pattern_(pattern),
        opened_(opened),
        jump_(std::move(jump)),
        states_(A.rows()),
        inputs_(B.cols()),
        opened_samples_(opened >= 0 ? pattern.samples[to_index(opened)] : 0),
        total_(states_ + inputs_ + opened_samples_) {
    map_ = Matrix::Identity(total_, total_);
    rate_ = Matrix::Zero(total_, total_);
    rate_.topLeftCorner(states_, states_) = A;
    rate_.block(0, states_, states_, inputs_) = B;
    output_ = Matrix::Zero(opened_samples_, total_);
    for (std::size_t k = 0; k < pattern_.instants.size(); ++k) {
      cross(pattern_.instants[k].events);
      const bool is_last = k + 1 == pattern_.instants.size();
      const double end = is_last ? pattern_.period : pattern_.instants[k + 1].time;
      flow(end - pattern_.instants[k].time);
    }
    renumber_queues(system_, pattern_, motions_, &map_);
  }

  Matrix by_states() const { return map_.topLeftCorner(states_, states_); }
  Matrix by_inputs() const { return map_.block(0, states_, states_, inputs_); }
  /// Of the opened loop: the states by w, and the outputs that the controller computes by the
  /// states and by w of earlier samples.
  Matrix by_opened() const { return map_.topRightCorner(states_, opened_samples_); }
  Matrix output() const { return output_.leftCols(states_); }
  Matrix direct() const { return output_.rightCols(opened_samples_); }

 private:
  void apply(const std::vector<ControlEvent>& events) {
    if (events.empty()) return;
    const Matrix after = jump_(events);
    Matrix jump = Matrix::Identity(total_, total_);
    jump.block(motions_, 0, after.rows(), after.cols()) = after;
    map_ = product(jump, map_);
  }

  int place_of(const ControlEvent& event) const {
    const auto c = to_index(event.controller);
    const ControllerStates& states = system_.controllers()[c].states;
    const int queued = system_.study().controllers[c].realization.queued();
    return queued == 0 ? states.held : states.queue + static_cast<int>(event.sample % queued);
  }

  void cross(const std::vector<ControlEvent>& events) {
    std::vector<ControlEvent> waiting;
    for (const ControlEvent& event : events) {
      waiting.push_back(event);
      if (event.controller != opened_ || event.kind != ControlEvent::Kind::kSample) continue;
      apply(waiting);
      waiting.clear();
      const Eigen::Index place = motions_ + place_of(event);
      output_.row(sampled_) = map_.row(place);
      map_(place, total_ - opened_samples_ + sampled_++) += 1.0;
    }
    apply(waiting);
  }

  void flow(double time) {
    if (!(time > 0.0)) return;
    const auto known = flows_.find(time);
    if (known == flows_.end()) flows_[time] = matrix_exponential(Matrix(rate_ * T(time)));
    map_ = product(flows_[time], map_);
  }

  const System& system_;
  const Eigen::Index motions_;
  const SamplePattern& pattern_;
  const int opened_;
  const Jump jump_;
  Eigen::Index states_, inputs_, opened_samples_, total_;
  Eigen::Index sampled_ = 0;  ///< samples of the opened controller so far
  Matrix map_, rate_, output_;
  std::map<double, Matrix> flows_;
};

}  // namespace codesign
