// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/language_seeds.h"

#include <cmath>
#include <sstream>

#include "fuzz/input.h"
#include "paths.h"

namespace codesign::fuzz {
namespace {

const char* const kPendulum = R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="0.5" lower="0.3" upper="0.8" unit="m"/>
  <codesign:parameter name="mu" value="0.2" lower="0" upper="0.6"/>
  <link name="ground"/>
  <link name="rod"><inertial>
    <origin xyz="0 0 -0.25" codesign:xyz="0 0 ${-length/2}"/><mass value="1" codesign:value="${2*length}"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.001" codesign:ixx="${0.16*length**3}" codesign:iyy="${0.16*length**3}"/>
  </inertial></link>
  <joint name="pivot" type="revolute"><parent link="ground"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" velocity="8" effort="20"/>
    <codesign:friction mu_static="0.2" codesign:mu_static="${mu}" mu_dynamic="0.2" codesign:mu_dynamic="${mu}" joint_length="0.05" pin_radius="0.02"/></joint>
</robot>
)";

const char* const kOverlay = R"(<robot name="overlay" xmlns:codesign="urn:mechanism_codesign">
  <codesign:set name="length" value="0.45"/>
  <codesign:set name="mu" value="0.1"/>
</robot>
)";

/// A study that tunes a controller. @param controller further keys of it, with a comma before.
/// @param more further blocks.
std::string tuned(const std::string& setpoint, const std::string& controller,
                  const std::string& more) {
  return "duration: 0.05\ninitial_state: {pivot: {position: 0.5}}\ncontrollers: {c: {type: pid, "
         "input: pivot/position, output: pivot, "
         "setpoint: " +
         setpoint + controller + ", gains: {p: \"${Kp}\", d: \"${Kd}\"}}}\n" +
         "parameters: {Kp: {initial: 20.0, lower: 1.0, upper: 60.0}, Kd: {initial: 3.0, lower: "
         "0.1, upper: 20.0}}\n"
         "objective:\n  integral: [{signal: c/error, weight: 100.0}, {signal: c/output, loss: "
         "huber, "
         "scale: 2.0, weight: 1.0e-3}]\n"
         "optimizer: {algorithm: slsqp, max_evaluations: 3}\n" +
         more;
}

/// A motion of two seconds as a table.
std::string recorded() {
  std::ostringstream text;
  text << "time,pivot/position,pivot/velocity,pivot/effort\n";
  for (int k = 0; k < 200; ++k) {
    const double t = 0.01 * k;
    text << t << ',' << 0.5 * std::cos(3.0 * t) << ',' << -1.5 * std::sin(3.0 * t) << ','
         << 0.4 * std::sin(5.0 * t) << '\n';
  }
  return text.str();
}

/// The bag of a regression with its wrong byte put right.
std::string recorded_bag() {
  std::string bag = load_input(source_dir() + "/test/fuzz/regressions/bag_with_a_wrong_length.yaml")
                        .files.at("m.bag");
  const std::string wrong("\4\0\4\0op=", 7);
  if (const std::size_t place = bag.find(wrong); place != std::string::npos) bag[place + 2] = '\0';
  return bag;
}

Seed seed(const std::string& name, const std::string& study) {
  return {name, kPendulum, study, kOverlay, {}, {}};
}

std::string identified(const std::string& data) {
  return "identify:\n  data:\n    - {" + data + "}\n" +
         "  filter: {cutoff: 20.0, order: 2}\n  joints: {pivot: {effort_scale: {initial: 1.0}, "
         "delay: {lower: 0.0, upper: 0.01}, "
         "offset: {}}}\n  loss: {type: huber}\n  intervals: {level: 0.9}\n"
         "parameters: {length: {initial: 0.45}, mu: {}}\noptimizer: {max_evaluations: 4}\n";
}

}  // namespace

std::vector<Seed> language_seeds() {
  std::vector<Seed> seeds = {
      seed("bounds",
           tuned("0.1", "",
                 "path:\n  - {signal: pivot/effort, between: [-30.0, 30.0], tolerance: 0.01}\n"
                 "  - {signal: pivot/velocity, at_least: \"${-2*Kp}\", after: 0.01, before: 0.04}\n"
                 "final:\n  - {signal: pivot/position, between: [0.0, 0.6]}\n"
                 "constraints:\n  - \"Kp >= 2*Kd\"\n  - {expression: \"${Kp + Kd}\", between: "
                 "[1.0, 90.0]}\n"
                 "  - {peak: pivot/velocity, at_most: 9.0}\n")),
      seed("sampled",
           tuned("{type: waypoints, times: [0.0, 0.02, 0.05], positions: [0.5, 0.4, 0.1]}",
                 ", sample_time: 0.005, delay: 0.002",
                 "hardware: {c: {namespace: /arm/pivot, i_clamp: 1.0, antiwindup: true}}\n")),
      seed("uncertain", tuned("{type: sine, amplitude: 0.1, period: 0.5}", "",
                              "uncertain: {mu: {uniform: [0.1, 0.3]}, length: {normal: [0.5, "
                              "0.01], between: [0.4, 0.6]}}\n"
                              "robust: {measure: cvar, level: 0.5, samples: 4, validate: "
                              "3}\nengine: {type: serial}\n")),
      seed("switches",
           tuned("\"${t < 0.02 ? 0.4 : top}\"", "",
                 "loads:\n  - {joint: pivot, effort: \"${pivot/position < 0.49 ? -2*sign(t - ts) : "
                 "floor(40*t)}\"}\n"
                 "  - {joint: pivot, effort: \"${max(0, abs(pivot/velocity) - 0.1)}\"}\n")),
      seed("starts",
           tuned("0.1", "",
                 "multistart: {starts: 2, screen: 4, sampler: random}\nengine: {workers: 2}\n")),
      seed("table", identified("csv: m.csv")),
      seed("motion",
           "identify: {data: [{csv: m.csv, from: 0.2, to: 1.5}], residual: motion, segment: 0.5}\n"
           "parameters: {mu: {}}\noptimizer: {max_evaluations: 2}\n"),
      seed("bag", identified("bag: m.bag, topic: /joint_states, stamp: receive")),
      seed("excitation",
           "identify: {}\nexcite: {joints: {pivot: {velocity: 3.0, effort: 12.0, position: [-1.0, "
           "1.0], noise: 0.1}}, period: "
           "2.0, harmonics: 2, starts: 1, max_evaluations: 3}\nparameters: {length: {}, mu: {}}\n"),
      seed("statics", tuned("0.1", "",
                            "efforts: {grid: {pivot: {from: -1.0, to: 1.0, count: 3}}}\n"
                            "runs: {heavy: {loads: [{joint: pivot, effort: 0.5}]}}\n"))};
  for (Seed& one : seeds)
    if (one.name == "switches")
      one.study.insert(one.study.find("Kp: {"),
                       "ts: {initial: 0.03, lower: 0, upper: 0.05}, top: {initial: 0.1, lower: 0, "
                       "upper: 0.5}, ");
  // The peak belongs to the objective.
  std::string& study = seeds.front().study;
  study.insert(study.find("optimizer:"), "  peak: [{signal: pivot/acceleration, weight: 0.001}]\n");
  for (Seed& one : seeds) {
    const bool has_recordings = one.study.find("data:") != std::string::npos;
    if (has_recordings)
      one.files = {
          {one.name == "bag" ? "m.bag" : "m.csv", one.name == "bag" ? recorded_bag() : recorded()}};
    if (has_recordings) one.commands = {{"identify"}, {"identify", "--output", "out"}};
    if (one.name == "excitation") one.commands = {{"excite"}, {"excite", "--output", "out"}};
    if (one.name == "statics")
      one.commands = {{"efforts"},
                      {"equilibrium"},
                      {"linearize"},
                      {"linearize", "--at", "0.01"},
                      {"efforts", "--run", "heavy"}};
  }
  return seeds;
}

}  // namespace codesign::fuzz
