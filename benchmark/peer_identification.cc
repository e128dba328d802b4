// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/peer_identification.h"

#include <memory>
#include <stdexcept>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/fit/residual_fit.h"
#include "identification/motion/motion_residuals.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

JointRecording recording_of(const PeerCase& of) {
  const std::vector<std::vector<double>> rows = peer_recording(of);
  JointRecording recording;
  recording.element = "identify.data[0]";
  const std::size_t joints = of.robot.links.size();
  for (const RobotLink& link : of.robot.links)
    recording.joints.push_back({link.name + "_joint", {}, {}, {}});
  for (std::size_t row = 0; row < rows.size(); ++row) {
    recording.times.push_back(static_cast<double>(row) / kPeerRate);
    for (std::size_t k = 0; k < joints; ++k) {
      recording.joints[k].position.push_back(rows[row][k]);
      recording.joints[k].velocity.push_back(rows[row][joints + k]);
      recording.joints[k].effort.push_back(0.0);
    }
  }
  return recording;
}

/// What a fit needs while it runs.
struct Identification {
  Identification(const PeerCase& of, const std::string& solver)
      : problem(
            peer_problem(of, solver,
                         "identify:\n  data: [{csv: none.csv}]\n  residual: motion\n  segment: " +
                             to_decimal(of.robot.duration) + "\n")),
        variables(study_of(problem)),
        recordings{recording_of(of)},
        residuals(*system_of(problem), variables, *study_of(problem).identification,
                  require_same_joints(recordings), recordings, 1, &warnings) {
    fit.start = kPeerStart * variables.start();
    fit.lower = variables.lower();
    fit.upper = variables.upper();
    fit.relative_tolerance = 1e-10;  // what is compared is the error, not when one ends
  }

  Problem problem;
  FitVariables variables;
  Warnings warnings;
  std::vector<JointRecording> recordings;
  MotionResiduals residuals;
  FitProblem fit;
};

}  // namespace

PeerRun identification(const PeerCase& of, const std::string& solver) {
  const auto work = std::make_shared<Identification>(of, solver);
  return [work] {
    if (Status status = work->residuals.begin(work->fit.start); !status.ok())
      throw std::runtime_error(status.cause);
    // Without noise there are no spreads to be found.
    const Eigen::VectorXd spreads =
        Eigen::VectorXd::Ones(static_cast<Eigen::Index>(work->residuals.outputs().size()));
    const ResidualFit result = fit_with_spreads(work->fit, spreads, &work->residuals);
    if (!result.status.ok()) throw std::runtime_error(result.status.cause);
    return PeerAnswer{result.evaluations, {result.x.data(), result.x.data() + result.x.size()}};
  };
}

}  // namespace codesign
