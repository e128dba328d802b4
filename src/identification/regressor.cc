// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/regressor.h"

#include <algorithm>
#include <utility>

#include "description/study.h"
#include "identification/effort/compared_recordings.h"
#include "identification/effort/driven_system.h"
#include "identification/fit/given_motion.h"
#include "identification/fit/inertial_numbers.h"
#include "identification/residuals_of_recordings.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "problem/load_problem.h"
#include "statistics/identifiability.h"

namespace codesign {
namespace {

/// The recorded joints whose motion follows from that of the others, as in loops.
std::vector<std::string> dependent_joints(const Problem& problem,
                                          const std::vector<MeasuredJoint>& joints,
                                          const JointRecording& recording) {
  constexpr int kInstants = 4;
  Eigen::MatrixXd positions(to_signed(joints.size()), kInstants);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::vector<double>& recorded = recording.find(joints[j].name)->position;
    if (recorded.empty()) {
      positions.resize(0, 0);  // velocities were recorded
      break;
    }
    for (int k = 0; k < kInstants; ++k)
      positions(to_signed(j), k) = recorded[to_index(k) * (recorded.size() - 1) / kInstants];
  }
  std::vector<std::string> names;
  for (int k : make_driven_system(*system_of(problem), joints, positions).surplus)
    names.push_back(joints[to_index(k)].name);
  return names;
}

/// The efforts of all joints that determine the motion are computed, recorded or not: each gets a
/// column of ones. Residuals are computed minus recorded, so that it does not matter which one if
/// it is constant; of another one a sensor's delay would leave a difference.
void set_efforts(const std::vector<std::string>& dependent,
                 std::vector<JointRecording>* recordings) {
  for (JointRecording& recording : *recordings)
    for (JointSamples& samples : recording.joints) {
      samples.least_speed = 0.0;  // of a row that does not count in a fit, too, there is a row
      samples.effort.clear();
      if (std::find(dependent.begin(), dependent.end(), samples.joint) == dependent.end())
        samples.effort.assign(recording.times.size(), 1.0);
    }
}

/// What a sensor shows beyond the effort is no effort, unless it is one of the numbers.
void subtract_offsets(const FitVariables& variables, const Eigen::VectorXd& x, Regressor* of) {
  for (std::size_t k = 0; k < of->outputs.size(); ++k)
    if (variables.columns(of->outputs[k]).offset < 0)
      of->computed.col(to_signed(k)).array() -= variables.sensor(of->outputs[k], x).offset;
}

void find_base(Regressor* of) {
  const Identifiability found = find_identifiable(upper_factor(of->matrix));
  const auto is_dependent = [&found](int k) {
    return std::find(found.dependent.begin(), found.dependent.end(), k) != found.dependent.end();
  };
  for (int k = 0; k < static_cast<int>(of->names.size()); ++k)
    if (!is_dependent(k)) of->base_columns.push_back(k);
  of->base_values.resize(to_signed(of->base_columns.size()));
  for (std::size_t k = 0; k < of->base_columns.size(); ++k) {
    const int column = of->base_columns[k];
    of->base_names.push_back(combination_of(found, of->names, column));
    of->base_values[to_signed(k)] = combination_value(found, of->values, column);
  }
}

}  // namespace

Regressor find_regressor(const Problem& problem, const Eigen::VectorXd& x,
                         std::vector<JointRecording> recordings, const std::atomic<bool>* cancel) {
  const IdentificationDescription& options = *study_of(problem).identification;
  if (options.residual != ResidualKind::kEffort)
    throw InputError(
        {options.where, "identify.residual", "a regressor is one of efforts", "motion", "effort"});
  StudyRecordings given{std::move(recordings), {}};
  if (std::optional<StudyRecordings> completed = with_given_motions(problem, given))
    given = std::move(*completed);
  const std::vector<MeasuredJoint> recorded = require_same_joints(given.data);
  require_same_signals(given.data);
  set_efforts(dependent_joints(problem, recorded, given.data.front()), &given.data);
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const Eigen::VectorXd point = x.size() > 0 ? x : variables.start();
  Regressor result;
  Warnings known_warnings;
  const auto source = make_residuals(problem, variables, require_same_joints(given.data),
                                     given.data, cancel, &known_warnings);
  result.status = {StatusCode::kCancelled, 0.0, "cancelled"};
  if (!source) return result;
  source->obey(cancel);
  Eigen::MatrixXd residuals, jacobian;
  result.status = source->begin(point);
  if (result.status.ok()) result.status = source->evaluate(point, &residuals, &jacobian);
  if (!result.status.ok()) return result;
  clear_rounding(point, &jacobian);
  LinearNumbers numbers = with_inertial_numbers(variables.names(), point, jacobian);
  result.outputs = source->outputs();
  result.lengths = source->lengths();
  result.times = source->times();
  result.computed = source->recorded() + residuals;
  subtract_offsets(variables, point, &result);
  result.names = std::move(numbers.names);
  result.values = std::move(numbers.x);
  result.matrix = std::move(numbers.jacobian);
  find_base(&result);
  return result;
}

}  // namespace codesign
