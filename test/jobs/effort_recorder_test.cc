// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/effort_recorder.h"

#include <cmath>
#include <map>
#include <set>

#include "statics/statics_cases.h"

namespace codesign {
namespace {

using Rows = std::vector<std::vector<double>>;

EffortSummary record(const Problem& problem, const std::vector<std::string>& signals, int samples,
                     Rows* rows) {
  std::vector<SignalDescription> descriptions;
  for (const std::string& signal : signals)
    descriptions.push_back(parse_signal(signal, {"test", 0}, "signals"));
  const EffortSummary summary =
      record_efforts(problem, problem.parameters(), descriptions, samples,
                     [&](const std::vector<double>& row) { rows->push_back(row); });
  EXPECT_TRUE(summary.status.ok()) << summary.status.cause;
  for (const std::vector<double>& row : *rows)
    EXPECT_EQ(row.size(), effort_columns(problem, descriptions).size());
  return summary;
}

const std::string kSwings =
    "duration: 2\ninitial_state: {shoulder: {position: 0.3, velocity: 1.2}, elbow: {position: "
    "-0.2}}\ncontrollers: {a: {type: computed_torque, output: shoulder, gains: {p: 100, d: 20}, "
    "setpoint: {type: sine, amplitude: 0.4, frequency: \"${3/(2*pi)}\", offset: 0.3}}, b: {type: "
    "computed_torque, output: elbow, gains: {p: 100, d: 20}, setpoint: -0.2}}\n";

// The closed form of two links of 2 kg and 0.05 kg m^2, their centres 0.2 m from their joints, the
// joints 0.4 m apart; damping 0.3, dry friction 0.5 tanh(400 v).
TEST(EffortRecorder, IsTheInverseDynamicsOfTwoLinks) {
  Rows rows;
  const EffortSummary summary = record(loaded(arm_urdf(), kSwings),
                                       {"shoulder/friction", "shoulder/actuator_power"}, 21, &rows);
  ASSERT_EQ(rows.size(), 21U);
  const double inertia = 0.05 + 2.0 * 0.04, coupling = 2.0 * 0.4 * 0.2;
  for (const std::vector<double>& row : rows) {
    const double q1 = row[1], v1 = row[2], a1 = row[3], q2 = -0.2;
    EXPECT_NEAR(q1, 0.3 + 0.4 * std::sin(3.0 * row[0]), 1e-13);
    const double M11 = 2.0 * inertia + 2.0 * 0.16 + 2.0 * coupling * std::cos(q2),
                 M21 = inertia + coupling * std::cos(q2);
    const double fore = 2.0 * kGravity * 0.2 * std::sin(q1 + q2);
    const double weight = 2.0 * kGravity * 0.6 * std::sin(q1) + fore;
    const double friction = 0.5 * std::tanh(400.0 * v1);
    EXPECT_NEAR(row[4], M11 * a1 + weight + 0.3 * v1 + friction, 1e-10);
    EXPECT_NEAR(row[8], M21 * a1 + coupling * std::sin(q2) * v1 * v1 + fore, 1e-10);
    EXPECT_NEAR(row[9], -friction, 1e-12);
    EXPECT_NEAR(row[10], row[4] * v1, 1e-10) << "the power of a drive is that of its effort";
  }
  ASSERT_EQ(summary.drives.size(), 2U);
  const DriveNeeds& shoulder = summary.drives[0];
  double largest = 0.0, squares = 0.0, work = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (std::abs(rows[k][4]) > std::abs(largest)) largest = rows[k][4];
    squares += rows[k][4] * rows[k][4];
    if (k > 0) work += 0.05 * (rows[k][10] + rows[k - 1][10]);
  }
  EXPECT_EQ(shoulder.extremes[0].second.value, largest);
  EXPECT_NEAR(shoulder.totals[0].second, std::sqrt(squares / 21.0), 1e-12);
  EXPECT_NEAR(shoulder.totals[1].second, work, 1e-12);
}

// A controller that tracks without an error, in a model without friction, applies the same efforts.
TEST(EffortRecorder, AgreesWithASimulationThatTracks) {
  std::string study = kSwings +
                      "parameters: {upper_viscous: {tune: false, initial: 0}, "
                      "upper_coulomb: {tune: false, initial: 0}, fore_viscous: {tune: "
                      "false, initial: 0}, fore_coulomb: {tune: false, initial: 0}}\n"
                      "solver: {relative_tolerance: 1e-11, absolute_tolerance: 1e-12}\n";
  const Problem problem = loaded(arm_urdf(), study);
  Rows needed, simulated;
  record(problem, {}, 11, &needed);
  std::vector<SignalDescription> signals;
  for (const char* signal : {"shoulder/position", "shoulder/effort", "elbow/effort"})
    signals.push_back(parse_signal(signal, {"test", 0}, "signals"));
  const RunSummary run =
      record_run(problem, problem.parameters(), signals, 11,
                 [&](const std::vector<double>& row) { simulated.push_back(row); });
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  ASSERT_EQ(simulated.size(), needed.size());
  for (std::size_t k = 0; k < needed.size(); ++k) {
    EXPECT_NEAR(simulated[k][1], needed[k][1], 1e-9);
    EXPECT_NEAR(simulated[k][2], needed[k][4], 1e-7);
    EXPECT_NEAR(simulated[k][3], needed[k][8], 1e-7);
  }
}

// A loop follows its one drive; the reaction of the guide and the friction by it are those of the
// closed form: the slider's acceleration comes from the rod's force alone.
TEST(EffortRecorder, FollowsALoopWithFriction) {
  const Problem problem =
      loaded(planar_slider_crank(R"(<codesign:friction mu_static="0.2" mu_dynamic="0.2"
          transition_velocity="1e-4" joint_length="0.1" joint_width="0.05" smoothing="1e-9"/>)"),
             "duration: 1\ngravity: [0, 0, 0]\ninitial_state: {crank_joint: {position: 0.2}, "
             "slider_joint: "
             "{guess: 0.35}}\ncontrollers: {turn: {type: pid, input: crank_joint/position, output: "
             "crank_joint, gains: {p: 1}, setpoint: {type: waypoints, times: [0, 1], positions: "
             "[0.2, 2.2], "
             "interpolation: linear}}}\n");
  Rows rows;
  record(problem,
         {"slider_joint/acceleration", "slider_joint/friction", "slider_joint/normal_force",
          "slider_joint/velocity", "slider_joint/reaction_force/z"},
         9, &rows);
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const std::vector<double>& row = rows[k];
    const double angle = 0.2 + 2.0 * row[0], sine = std::sin(angle) / 3.0, phi = std::asin(sine),
                 rate = 2.0 * std::cos(angle) / (3.0 * std::cos(phi));
    const double x_rate = -0.1 * std::sin(angle + phi) * 2.0 / std::cos(phi);
    const double acceleration =
        -0.4 * std::cos(angle) +
        0.3 * (-rate * rate * std::cos(phi) -
               std::sin(phi) *
                   ((-4.0 * std::sin(angle) / 3.0 + rate * rate * std::sin(phi)) / std::cos(phi)));
    EXPECT_NEAR(row[8], x_rate, 1e-10);
    EXPECT_NEAR(row[5], acceleration, 1e-8);
    // The slider moves to -x, its friction acts along +x: S cos(phi) + 0.2 |S| sin(phi) = m x''.
    const double sign = acceleration > 0.0 ? 1.0 : -1.0;
    const double rod = acceleration / (std::cos(phi) + sign * 0.2 * std::sin(phi));
    EXPECT_NEAR(row[7], std::abs(rod) * std::sin(phi), 1e-6);
    EXPECT_NEAR(row[6], 0.2 * std::abs(rod) * std::sin(phi), 1e-6);
    EXPECT_NEAR(row[9], rod * std::sin(phi), 1e-6) << "the guide keeps the rod's force across it";
    EXPECT_NEAR(row[4], -0.1 * rod * std::sin(angle + phi), 1e-7);
  }
}

TEST(EffortRecorder, TellsLimitsThatTheMotionExceeds) {
  const std::string urdf = arm_urdf();
  const Problem problem = loaded(
      urdf,
      "duration: 1\nlimits: {effort: true}\ncontrollers: {a: {type: pd_gravity, output: "
      "shoulder, gains: {p: 1, d: 0}, setpoint: {type: sine, amplitude: 2.5, frequency: 1}}, "
      "b: {type: pd_gravity, output: elbow, gains: {p: 1, d: 0}, setpoint: 0}}\n");
  Rows rows;
  const EffortSummary summary = record(problem, {}, 41, &rows);
  std::set<std::string> limits;
  for (const LimitCrossing& crossing : summary.crossings)
    if (crossing.joint == "shoulder") limits.insert(crossing.limit);
  EXPECT_EQ(limits, (std::set<std::string>{"effort", "lower", "upper", "velocity"}));
}

TEST(EffortRecorder, PosturesOutOfReachHaveNoEffort) {
  const Problem problem = loaded(
      planar_slider_crank(),
      "duration: 1\ninitial_state: {slider_joint: {position: 0.3}, crank_joint: {guess: 1.0}}\n"
      "efforts: {grid: {slider_joint: [0.5, 0.3, 0.35, 0.45]}}\n");
  Rows rows;
  const EffortSummary summary = record(problem, {"crank_joint/position"}, 2, &rows);
  EXPECT_EQ(summary.rows, 4U);
  EXPECT_EQ(summary.unreachable, 2U);
  EXPECT_TRUE(std::isnan(rows[0][1]) && std::isnan(rows[0][5]) && std::isnan(rows[3][1]));
  const double crank = rows[2][5];
  EXPECT_NEAR(0.35, 0.1 * std::cos(crank) + std::sqrt(0.09 - std::pow(0.1 * std::sin(crank), 2)),
              1e-10);
  // The crank's centre is in its axis and gravity acts across the guide: nothing has to be held.
  EXPECT_NEAR(rows[2][1], 0.0, 1e-9);
}

// The same motion given in place of controlled, with a torque that the time drives on the elbow.
TEST(EffortRecorder, FollowsMotionsThatAreGivenUnderLoadsOfTheTime) {
  Rows controlled, given;
  record(loaded(arm_urdf(), kSwings), {}, 11, &controlled);
  record(loaded(arm_urdf(),
                "duration: 2\nmotion: {shoulder: {position: \"${0.3 + 0.4*sin(3*t)}\"}, elbow: "
                "{position: -0.2}}\nloads: [{joint: elbow, effort: \"${1.5*t}\"}]\n"),
         {}, 11, &given);
  ASSERT_EQ(given.size(), 11U);
  for (std::size_t k = 0; k < given.size(); ++k)
    for (std::size_t column = 0; column < 9; ++column) {
      const double load = column == 8 ? 1.5 * given[k][0] : 0.0;
      EXPECT_NEAR(given[k][column], controlled[k][column] - load, 1e-10) << k << ' ' << column;
    }
}

TEST(EffortRecorder, NamesJointsThatNoControllerMoves) {
  const Problem problem =
      loaded(arm_urdf(),
             "duration: 1\ncontrollers: {a: {type: pid, input: shoulder/position, output: "
             "shoulder, setpoint: 0, gains: {p: 1}}}\n");
  Rows rows;
  const std::string message = refused([&] { record(problem, {}, 2, &rows); });
  EXPECT_NE(message.find("<joint name=\"elbow\">: its motion is not determined: neither"),
            std::string::npos)
      << message;
}

TEST(EffortRecorder, WritesNeedsAsJson) {
  const std::vector<DriveNeeds> drives = {
      {"hinge", {{"effort", {-2.0, {0.5}}}}, {{"rms_effort", 1.0}}}};
  const Json object = to_json(drives);
  EXPECT_EQ(object["hinge"]["effort"]["value"], -2.0);
  EXPECT_EQ(object["hinge"]["effort"]["at"][0], 0.5);
  EXPECT_EQ(object["hinge"]["rms_effort"], 1.0);
}

/// A press: a crank of 0.1 m, a rod of 0.3 m and a slider along z, driven at the slider.
std::string driven_press() {
  const std::string end = "<limit lower=\"-1\" upper=\"1\" effort=\"1e6\" velocity=\"10\"/>";
  return R"(<robot name="press" xmlns:codesign="urn:mechanism_codesign"><link name="base"/>)" +
         body("crank", 1.0, "0 0 0.05") + body("rod", 1.0, "0 0 0.15") + body("slider", 2.0) +
         joint("crank_joint", "continuous", "base", "crank", "0 0 0", "0 1 0") +
         joint("knee", "continuous", "crank", "rod", "0 0 0.1", "0 1 0") +
         joint("slide", "prismatic", "base", "slider", "0 0 0", "0 0 1", end) +
         R"(<loop name="pin" type="revolute" codesign:out_of_plane="zero"><predecessor link="rod">
            <origin xyz="0 0 0.3"/></predecessor><successor link="slider"/><axis xyz="0 1 0"/></loop>
            </robot>)";
}

// At 0.4 m crank and rod are in line: a dead centre.
TEST(EffortRecorder, TheOrderOfPosturesAroundADeadCentreDoesNotMatter) {
  const auto efforts = [](const std::string& grid, Warnings* warnings) {
    const Problem problem =
        loaded(driven_press(),
               "duration: 1\ninitial_state: {slide: {position: 0.39}, crank_joint: {guess: 0.3}, "
               "knee: {guess: -0.4}}\nloads: [{joint: slide, effort: -1000}]\nefforts: {grid: "
               "{slide: " +
                   grid + "}}\n");
    Rows rows;
    const EffortSummary summary = record(problem, {}, 2, &rows);
    EXPECT_EQ(summary.unreachable, 0U) << grid;
    *warnings = summary.warnings;
    std::map<double, double> by_position;
    for (const std::vector<double>& row : rows) by_position[row[0]] = row[1];
    return by_position;
  };
  Warnings warnings;
  const std::map<double, double> first = efforts("[0.39, 0.38]", &warnings);
  EXPECT_TRUE(warnings.empty());
  for (const char* grid : {"[0.4, 0.39, 0.38]", "[0.39, 0.4, 0.38]", "[0.38, 0.4, 0.39]"}) {
    const std::map<double, double> other = efforts(grid, &warnings);
    for (const auto& [position, effort] : first)
      EXPECT_NEAR(other.at(position), effort, 1e-6 * std::abs(effort)) << grid << " " << position;
    ASSERT_EQ(warnings.size(), 1U) << grid;
    EXPECT_EQ(warnings[0].code, "singular_posture");
    EXPECT_NE(warnings[0].message.find("slide = 0.4"), std::string::npos) << warnings[0].message;
  }
}

}  // namespace
}  // namespace codesign
