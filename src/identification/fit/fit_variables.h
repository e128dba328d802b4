// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "description/robot.h"
#include "description/study.h"
#include "identification/fit/fit_prior.h"
#include "math/arrays.h"
#include "math/sampled_function.h"

namespace codesign {

/// The recorded effort of one joint; outside the recording its first and last values hold.
using RecordedEffort = SampledFunction;

/// The effort sensor of a joint, often a motor current. From the effort tau on the child it records
/// the number r(t + delay) = (tau(t) + offset) / scale; doc/theory.md (28c).
struct EffortSensor {
  /// N m (or N) per unit of the recorded number: the torque constant, gear included
  double scale = 1.0;
  double offset = 0.0;  ///< recorded in addition to the effort that the mechanism needs [N m or N]
  /// delay of the recorded effort relative to the recorded motion [s]; negative: the effort is
  /// early
  double delay = 0.0;
  /// scale at the start of the identification; it gives residuals their unit
  double start_scale = 1.0;
};

/// The residual of one joint at one instant and its derivatives.
struct EffortResidual {
  double value = 0.0;      ///< start_scale ((tau + offset) / scale - r(t + delay)) [N m or N]
  double by_effort = 0.0;  ///< derivative by tau, and by the offset [-]
  double by_scale = 0.0;   ///< [N m or N per unit of the scale]
  double by_delay = 0.0;   ///< [N m/s or N/s]
};

/// @param effort tau of the model at `time`.
EffortResidual effort_residual(const EffortSensor& sensor, const RecordedEffort& recorded,
                               double time, double effort);

/// The unknowns x of an identification: the tuned parameters in the order of Study::tuned, then the
/// fitted numbers of effort sensors, joint by joint in the order of the study: scale, delay,
/// offset; then the fitted start positions, recording by recording.
class FitVariables {
 public:
  /// Indices of the numbers of one sensor in x; -1: known.
  struct SensorColumns {
    int scale = -1, delay = -1, offset = -1;
  };

  /// @param study with a block `identify`; must outlive this. @param robot its joints determine the
  /// units of starts and offsets; null: no units. @param settings values of parameters in the
  /// recordings that the variables are for
  explicit FitVariables(const Study& study, const RobotDescription* robot = nullptr,
                        std::vector<RecordedSetting> settings = {});

  Eigen::Index size() const { return start_.size(); }
  Eigen::Index tuned() const { return to_signed(study_.tuned.size()); }
  /// `mu_slider`, `elbow_joint/effort_scale`
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& units() const { return units_; }  ///< for display; may be empty
  const Eigen::VectorXd& start() const { return start_; }
  const Eigen::VectorXd& lower() const { return lower_; }  ///< -infinity: none
  const Eigen::VectorXd& upper() const { return upper_; }

  /// What is known before the fit, doc/theory.md (39b): of whole free inertias their weak prior,
  /// and what the study states.
  FitPrior prior() const;

  /// All named parameters, in the order of Study::parameters.
  std::vector<double> parameters(const Eigen::VectorXd& x) const;
  /// The effort sensor of a joint. The sensor of a joint that the study does not name has scale 1,
  /// no offset and no delay.
  EffortSensor sensor(const std::string& joint, const Eigen::VectorXd& x) const;
  SensorColumns columns(const std::string& joint) const;
  /// Index of the start position of a joint in a recording in x; -1: known. @param recording
  /// `identify.data[0]`
  int start_column(const std::string& recording, const std::string& joint) const;

 private:
  int add(const std::string& name, const FittedNumber& number, const std::string& unit);
  int find(const std::string& joint) const;

  const Study& study_;
  const std::vector<RecordedSetting> settings_;
  std::vector<std::string> names_, units_;
  std::vector<SensorColumns> columns_;  ///< one per entry of IdentificationDescription::joints
  struct StartColumn {
    std::string recording, joint;
    int column = -1;
  };
  std::vector<StartColumn> start_columns_;
  Eigen::VectorXd start_, lower_, upper_;
};

/// The free inertias of which all ten numbers are among `names`: link and indices in the order of
/// kLogCholeskyNames.
std::vector<std::pair<std::string, std::array<int, 10>>> free_inertias(
    const std::vector<std::string>& names);

}  // namespace codesign
