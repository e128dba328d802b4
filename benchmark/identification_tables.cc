// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "benchmark/mechanisms.h"
#include "benchmark/report.h"
#include "description/study.h"
#include "identification/effort/effort_model.h"
#include "identification/effort/effort_residuals.h"
#include "identification/fit/residual_fit.h"
#include "identification/motion/motion_residuals.h"
#include "identification/motion/segments.h"
#include "math/cpu_timer.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr int kArm = 6;
constexpr double kSeconds = 2.0, kBefore = 0.5, kRate = 100.0, kNoise = 1e-3,
                 kNoisyRate = 10.0;  // noise of positions, and that of velocities over it
const std::vector<int> kFitted = {4, 16};

std::string hinge_name(int k) { return "hinge_" + std::to_string(k); }

/// The chain as an arm: each hinge follows a sine. @returns the block of the study
std::string servos() {
  std::string controllers = "controllers:\n";
  for (int k = 0; k < kArm; ++k)
    controllers += "  servo_" + std::to_string(k) + ": {type: pid, input: " + hinge_name(k) +
                   "/position, output: " + hinge_name(k) +
                   ", setpoint: {type: sine, amplitude: 0.4, offset: 0.5, frequency: " +
                   std::to_string(0.5 + 0.13 * k) + "}, gains: {p: 40.0, d: 3.0}}\n";
  return controllers;
}

/// Positions, velocities and efforts of all hinges, with noise on the first two. @param begin [s]
/// of the run: at its start servos pull with efforts that change between two samples
JointRecording record_arm(const GeneratedCase& arm, double begin) {
  GeneratedCase driven = arm;
  driven.study.text += servos();
  const Problem problem = load_problem(driven.urdf, {}, driven.study);
  std::vector<std::string> signals;
  JointRecording recording;
  recording.element = "identify.data[0]";
  for (int k = 0; k < kArm; ++k) {
    for (const char* quantity : {"/position", "/velocity", "/effort"})
      signals.push_back(hinge_name(k) + quantity);
    recording.joints.push_back({hinge_name(k), {}, {}, {}});
  }
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, kNoise);
  Simulation simulation(problem, problem.parameters(), signals);
  const double duration = begin + kSeconds;
  const Status status = simulate(
      &simulation, duration, static_cast<int>(duration * kRate + 0.5) + 1, [&](const Frame& frame) {
        if (frame.time < begin - 0.5 / kRate) return true;
        recording.times.push_back(frame.time);
        for (std::size_t k = 0; k < recording.joints.size(); ++k) {
          recording.joints[k].position.push_back(frame.signals[3 * k] + normal(random));
          recording.joints[k].velocity.push_back(frame.signals[3 * k + 1] +
                                                 kNoisyRate * normal(random));
          recording.joints[k].effort.push_back(frame.signals[3 * k + 2]);
        }
        return true;
      });
  if (!status.ok()) throw std::runtime_error(status.cause);
  return recording;
}

/// Processor time of the segments simulated without derivatives [s], the least of a few.
double plain_seconds(const MotionResiduals& residuals, const FitVariables& variables) {
  const SegmentSystem& of = residuals.systems().front();
  RosenbrockIntegrator integrator(*of.system);
  double least = std::numeric_limits<double>::infinity();
  for (int repetition = 0; repetition < 5; ++repetition) {
    const CpuTimer timer;
    for (const Segment& segment : residuals.segments().front()) {
      integrator.assembly().begin_at(segment.begin.time, segment.begin.theta);
      Status status = integrator.start(of.parameters(variables, variables.start(), segment.start));
      while (status.ok() && integrator.state().t < segment.times.back())
        status = integrator.advance(segment.times.back());
      if (!status.ok()) throw std::runtime_error(status.cause);
    }
    least = std::min(least, timer.seconds());
  }
  return least;
}

/// Fits from numbers that are off by 3 %: one with known spreads, and a whole one, whose start is
/// judged and whose spreads are found.
/// @returns the cost of an evaluation in the dearer one, in simulations
double add_fit(int fitted, const std::string& name, const JointRecording& recording, Table* table) {
  GeneratedCase arm = parametric_chain(kArm, fitted);
  arm.study.text +=
      "identify:\n  data: [{csv: none.csv}]\n  residual: motion\n  segment: 0.25\n  filter: "
      "{cutoff: 20.0}\n";
  const Problem problem = load_problem(arm.urdf, {}, arm.study);
  const FitVariables variables(study_of(problem));
  Warnings warnings;
  const std::vector<JointRecording> recordings = {recording};
  MotionResiduals residuals(*system_of(problem), variables, *study_of(problem).identification,
                            require_same_joints(recordings), recordings, 1, &warnings);
  FitProblem fit;
  fit.start = 1.03 * variables.start();
  fit.lower = variables.lower();
  fit.upper = variables.upper();
  fit.max_evaluations = 60;
  if (Status status = residuals.begin(fit.start); !status.ok())
    throw std::runtime_error(status.cause);
  const double plain = plain_seconds(residuals, variables);
  Eigen::VectorXd spreads(static_cast<Eigen::Index>(residuals.outputs().size()));
  for (Eigen::Index k = 0; k < spreads.size(); ++k)
    spreads[k] = k % 2 == 0 ? kNoise : kNoisyRate * kNoise;
  const CpuTimer timer;
  const ResidualFit result = fit_with_spreads(fit, spreads, &residuals);
  const double seconds = timer.seconds(), evaluations = result.evaluations;
  if (!result.status.ok()) throw std::runtime_error(result.status.cause);
  const double runs = residuals.runs(), whole_runs = residuals.whole_runs();
  if (Status status = residuals.begin(fit.start); !status.ok())
    throw std::runtime_error(status.cause);
  const CpuTimer whole_timer;
  const ResidualFit whole = fit_residuals(fit, &residuals);
  const double whole_seconds = whole_timer.seconds();
  if (!whole.status.ok()) throw std::runtime_error(whole.status.cause);
  const double in_simulations = seconds / evaluations / plain,
               whole_in_simulations = whole_seconds / whole.evaluations / plain;
  table->rows.push_back({std::to_string(fitted), name, three_digits(1e3 * plain),
                         std::to_string(result.evaluations), three_digits(whole_runs / evaluations),
                         three_digits((runs - whole_runs) / evaluations),
                         three_digits(1e3 * seconds / evaluations), three_digits(in_simulations),
                         std::to_string(whole.evaluations), three_digits(whole_in_simulations)});
  return std::max(in_simulations, whole_in_simulations);
}

/// Every hinge of the arm on a sine of its own for `seconds`, at kRate.
MotionSamples sines(double seconds) {
  constexpr double kAmplitude = 0.4, kOffset = 0.5, kTurn = 6.283185307179586;
  const auto samples = static_cast<Eigen::Index>(seconds * kRate);
  MotionSamples motion;
  for (Eigen::MatrixXd* part : {&motion.position, &motion.velocity, &motion.acceleration})
    part->resize(kArm, samples);
  for (int k = 0; k < kArm; ++k) {
    const double rate = kTurn * (0.5 + 0.13 * k);
    const Eigen::ArrayXd phase =
        Eigen::ArrayXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1)) * (rate / kRate);
    motion.position.row(k) = kOffset + kAmplitude * phase.sin();
    motion.velocity.row(k) = kAmplitude * rate * phase.cos();
    motion.acceleration.row(k) = -kAmplitude * rate * rate * phase.sin();
  }
  return motion;
}

/// Times of the efforts of half a minute. @param coordinates of the study's solver
void add_efforts(const std::string& coordinates, int fitted, Table* table) {
  constexpr double kMotion = 30.0;
  constexpr int kRepetitions = 5;
  GeneratedCase arm = parametric_chain(kArm, fitted);
  const std::string absolute = "coordinates: absolute";
  arm.study.text.replace(arm.study.text.find(absolute), absolute.size(),
                         "coordinates: " + coordinates);
  const Problem problem = load_problem(arm.urdf, {}, arm.study);
  std::vector<MeasuredJoint> joints;
  for (int k = 0; k < kArm; ++k) joints.push_back({hinge_name(k), true, 1.0, {}});
  const CpuTimer setup;
  EffortModel model(*system_of(problem), joints, sines(kMotion));
  if (Status status = model.begin(problem.parameters()); !status.ok())
    throw std::runtime_error(status.cause);
  std::vector<std::string> row = {coordinates, std::to_string(fitted),
                                  three_digits(1e3 * setup.seconds())};
  Eigen::MatrixXd efforts;
  RowJacobian jacobian;
  for (RowJacobian* derivatives : {static_cast<RowJacobian*>(nullptr), &jacobian}) {
    double first = 0.0, least = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < kRepetitions; ++repetition) {
      const CpuTimer timer;
      if (Status status = model.evaluate(problem.parameters(), &efforts, derivatives); !status.ok())
        throw std::runtime_error(status.cause);
      least = std::min(least, timer.seconds());
      if (repetition == 0) first = timer.seconds();
    }
    row.push_back(three_digits(1e3 * first));
    row.push_back(three_digits(1e3 * least));
  }
  table->rows.push_back(row);
}

}  // namespace

void measure_identification(Report* report) {
  Table efforts{
      "efforts",
      "Efforts of 30 s of an arm of six joints with friction that depends on reactions, at 100 Hz",
      {"coordinates", "parameters", "set up and followed, ms", "efforts at first, ms",
       "efforts, ms", "with derivatives at first, ms", "with derivatives, ms"},
      {}};
  for (const std::string coordinates : {"absolute", "joint"})
    for (int fitted : kFitted) add_efforts(coordinates, fitted, &efforts);
  report->tables.push_back(efforts);
  Table table{"motion_residuals",
              "Fit of an arm of six joints in motion, under recorded efforts at 100 Hz: eight "
              "segments of 0.25 s, 12 numbers of each start",
              {"parameters", "recording", "simulation of all segments, ms", "iterations",
               "runs with all derivatives, per iteration", "with those by starts", "iteration, ms",
               "in simulations", "iterations of a whole fit", "in simulations"},
              {}};
  double most = 0.0;
  for (const bool has_start : {false, true}) {
    const JointRecording recording =
        record_arm(parametric_chain(kArm, 0), has_start ? 0.0 : kBefore);
    for (int fitted : kFitted)
      most =
          std::max(most, add_fit(fitted, has_start ? "with the start of the servos" : "in motion",
                                 recording, &table));
  }
  report->findings.push_back(
      {"residuals in motion: an iteration with up to 16 parameters, in simulations", "", most, 20.0,
       false});
  report->tables.push_back(table);
}

}  // namespace codesign
