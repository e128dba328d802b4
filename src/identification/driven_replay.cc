// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/driven_replay.h"

#include <algorithm>
#include <utility>

#include "assembly/start_workspace.h"
#include "math/to_index.h"

namespace codesign {

DrivenReplay::DrivenReplay(const CompiledSystem& system, std::vector<MeasuredJoint> joints, const Eigen::MatrixXd& positions,
                           const std::vector<double>& parameters)
    : system_(system),
      joints_(std::move(joints)),
      parameters_(parameters),
      driven_(make_driven_system(system, joints_, positions)),
      motion_(driven_),
      projection_(driven_, joints_),
      observer_(*driven_.system, {}) {
  motion_.set_design(parameters_);
  const std::vector<std::string>& names = observer_.names().joints;
  for (const int k : driven_.drives)
    drives_.push_back(static_cast<std::size_t>(std::find(names.begin(), names.end(), joints_[to_index(k)].name) - names.begin()));
}

Status DrivenReplay::begin(const Eigen::VectorXd& positions) {
  StartWorkspace usual(system_, parameters_);
  if (Status status = usual.solve_positions(); !status.ok()) return status;
  theta_ = usual.assembly.theta();
  return assemble_driven(system_, joints_, driven_, parameters_, positions, &state_);
}

Status DrivenReplay::show(const Eigen::VectorXd (&measured)[3], Frame* frame) {
  Eigen::VectorXd drives[3];
  for (int order = 0; order < 3; ++order) {
    drives[order].resize(static_cast<Eigen::Index>(driven_.drives.size()));
    for (std::size_t k = 0; k < driven_.drives.size(); ++k)
      drives[order][static_cast<Eigen::Index>(k)] = measured[order][driven_.drives[k]];
  }
  const auto part = [&](int order) { return In<double>(drives[order].data(), drives[order].size()); };
  Status status = projection_.empty() ? motion_.follow({part(0), part(1), part(2)}, &state_)
                                      : projection_.project(measured, &drives, &motion_, &state_);
  if (!status.ok()) return status;
  observer_.observe(state_, 0.0, theta_, &motion_.equations(), frame);
  for (std::size_t k = 0; k < drives_.size(); ++k) frame->joints[drives_[k]].effort = motion_.effort(state_, static_cast<int>(k));
  return {};
}

}  // namespace codesign
