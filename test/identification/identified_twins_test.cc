// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Whatever a twin names is found again from a simulated run that begins with other numbers.
#include <cmath>

#include "identification/identify.h"
#include "identification/simulated_recording.h"

namespace codesign {
namespace {

/// A bench of two joints with everything that a joint can have, and a head on three crossing axes
/// that are apart from each other.
constexpr const char* kBench =
    R"(<robot name="bench" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="mu_static" value="0.3"/><codesign:parameter name="mu_dynamic" value="0.2"/>
  <codesign:parameter name="preload" value="20"/><codesign:parameter name="viscous" value="0.1"/>
  <codesign:parameter name="mu_backward" value="0.2"/><codesign:parameter name="viscous_backward" value="0.1"/>
  <codesign:parameter name="stiffness" value="3"/><codesign:parameter name="spring_damping" value="0.2"/>
  <codesign:parameter name="free_position" value="0"/>
  <codesign:parameter name="rotor" value="1e-4"/><codesign:parameter name="gear_coulomb" value="0.5"/>
  <codesign:parameter name="damping" value="0.1"/><codesign:parameter name="dry" value="0.2"/>
  <codesign:parameter name="payload" value="0.5"/><codesign:parameter name="payload_height" value="-0.4"/>
  <codesign:parameter name="strut_stiffness" value="50"/><codesign:parameter name="strut_damping" value="2"/>
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
    <inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0 0 -0.2"/><mass value="1"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.005" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="payload"><inertial><origin xyz="0 0 -0.4" codesign:xyz="0 0 ${payload_height}"/><mass value="0.5" codesign:value="${payload}"/>
    <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <codesign:friction mu_static="0.3" codesign:mu_static="${mu_static}" mu_dynamic="0.2" codesign:mu_dynamic="${mu_dynamic}"
      mu_static_backward="0.2" codesign:mu_static_backward="${mu_backward}" mu_dynamic_backward="0.2"
      codesign:mu_dynamic_backward="${mu_backward}" viscous="0.1" codesign:viscous="${viscous}" viscous_backward="0.1"
      codesign:viscous_backward="${viscous_backward}" preload="20" codesign:preload="${preload}" transition_velocity="0.02"
      joint_length="0.1" pin_radius="0.05"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 -0.6"/><axis xyz="0 1 0"/>
    <dynamics damping="0.1" friction="0.2" codesign:damping="${damping}" codesign:friction="${dry}"/>
    <codesign:torsion_spring stiffness="3" damping="0.2" free_position="0" codesign:stiffness="${stiffness}"
      codesign:damping="${spring_damping}" codesign:free_position="${free_position}"/>
    <codesign:actuator gear_ratio="30" rotor_inertia="1e-4" codesign:rotor_inertia="${rotor}"/>
    <codesign:friction mu_static="0.1" mu_dynamic="0.1" transition_velocity="0.001" preload="250" codesign:preload="${gear_coulomb/0.002}"
      joint_length="0.1" pin_radius="0.02"/></joint>
  <joint name="flange" type="fixed"><parent link="lower"/><child link="payload"/></joint>
  <codesign:spring_damper name="strut" stiffness="50" damping="2" free_length="0.4" codesign:stiffness="${strut_stiffness}"
    codesign:damping="${strut_damping}"><predecessor link="base"><origin xyz="0.3 0 0"/></predecessor>
    <successor link="upper"><origin xyz="0 0 -0.3"/></successor></codesign:spring_damper>
</robot>)";

constexpr const char* kBenchStudy = R"(duration: 8.0
controllers:
  s1: {type: pid, input: shoulder/position, setpoint: {type: sine, amplitude: 0.7, frequency: 0.31}, output: shoulder, gains: {p: 120.0, d: 12.0}}
  s2: {type: pid, input: elbow/position, setpoint: {type: sine, amplitude: 0.9, frequency: 0.47, phase: 0.5}, output: elbow, gains: {p: 60.0, d: 6.0}}
solver: {integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}
identify:
  data: [{csv: run.csv}]
  filter: {cutoff: 60.0, residual_cutoff: 20.0, decimate: 5}
optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}
)";

constexpr const char* kHead = R"(<robot name="head" xmlns:codesign="https://mechanism-codesign.org">
  <link name="base"/>
  <link name="neck"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fork"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="camera"><inertial codesign:inertia="free"><origin xyz="0.05 0.02 -0.04"/><mass value="1.5"/>
    <inertia ixx="0.02" iyy="0.025" izz="0.018" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="pan" type="continuous"><parent link="base"/><child link="neck"/><axis xyz="0 0.2 1"/></joint>
  <joint name="tilt" type="continuous"><parent link="neck"/><child link="fork"/><origin xyz="0.2 0 0.1"/><axis xyz="0 1 0"/></joint>
  <joint name="roll" type="continuous"><parent link="fork"/><child link="camera"/><origin xyz="0.1 0.1 0"/><axis xyz="1 0 0.3"/></joint>
</robot>)";

constexpr const char* kHeadStudy = R"(duration: 6.0
controllers:
  s1: {type: pid, input: pan/position, setpoint: {type: sine, amplitude: 1.3, frequency: 0.5}, output: pan, gains: {p: 60.0, d: 6.0}}
  s2: {type: pid, input: tilt/position, setpoint: {type: sine, amplitude: 1.1, frequency: 0.8, phase: 0.5}, output: tilt, gains: {p: 60.0, d: 6.0}}
  s3: {type: pid, input: roll/position, setpoint: {type: sine, amplitude: 1.5, frequency: 1.1, phase: 1.5}, output: roll, gains: {p: 30.0, d: 3.0}}
solver: {integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}
identify:
  data: [{csv: run.csv}]
  filter: {cutoff: 60.0, residual_cutoff: 20.0, decimate: 5}
optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}
)";

struct TwinCase {
  std::string name;
  const char* urdf;
  const char* study;
  std::vector<std::string> joints;
  std::map<std::string, double> truth;
  double tolerance = 0.002;  ///< relative error that the filters leave
};

void PrintTo(const TwinCase& c, std::ostream* out) { *out << c.name; }

std::vector<TwinCase> twin_cases() {
  const std::vector<std::string> bench = {"shoulder", "elbow"};
  const auto on_bench = [&bench](const std::string& name, std::map<std::string, double> truth,
                                 double tolerance = 0.002) {
    return TwinCase{name, kBench, kBenchStudy, bench, std::move(truth), tolerance};
  };
  return {on_bench("friction_coefficients",
                   {{"mu_static", 0.45}, {"mu_dynamic", 0.28}, {"mu_backward", 0.33}}),
          on_bench("preload_beside_coefficients",
                   {{"mu_dynamic", 0.25}, {"mu_backward", 0.25}, {"preload", 45.0}}),
          on_bench("viscous_friction_by_direction", {{"viscous", 0.8}, {"viscous_backward", 0.3}}),
          on_bench("torsion_spring",
                   {{"stiffness", 5.0}, {"spring_damping", 0.6}, {"free_position", 0.4}}),
          on_bench("spring_damper", {{"strut_stiffness", 80.0}, {"strut_damping", 5.0}}),
          on_bench("payload", {{"payload", 1.3}, {"payload_height", -0.52}}),
          on_bench("motor", {{"rotor", 2.5e-4}, {"gear_coulomb", 1.1}, {"damping", 0.35}}),
          on_bench("stock_friction", {{"dry", 0.6}, {"damping", 0.3}}, 0.005),
          TwinCase{"full_inertia",
                   kHead,
                   kHeadStudy,
                   {"pan", "tilt", "roll"},
                   {{"camera_alpha", 0.35},
                    {"camera_d1", -2.3},
                    {"camera_d2", -2.4},
                    {"camera_d3", -2.2},
                    {"camera_s12", 0.02},
                    {"camera_s23", -0.01},
                    {"camera_s13", 0.015},
                    {"camera_t1", 0.08},
                    {"camera_t2", -0.03},
                    {"camera_t3", 0.05}}}};
}

class IdentifiedTwins : public ::testing::TestWithParam<TwinCase> {};

TEST_P(IdentifiedTwins, AreFoundAgain) {
  const TwinCase& c = GetParam();
  std::string tuned;
  for (const auto& [name, value] : c.truth) tuned += (tuned.empty() ? "" : ", ") + name + ": {}";
  const Problem problem = load_problem({"bench.urdf", c.urdf}, {},
                                       {"study.yaml", c.study + ("parameters: {" + tuned + "}\n")});
  StudyRecordings recordings;
  recordings.data = {record_run(problem, c.truth, c.joints, 500.0)};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.numbers.size(), c.truth.size());
  for (const IdentifiedNumber& number : result.numbers) {
    const double truth = c.truth.at(number.name);
    EXPECT_GT(std::abs(number.start - truth), 5.0 * c.tolerance * std::abs(truth))
        << number.name << ": a start at the truth tests nothing";
    EXPECT_NEAR(number.value, truth, c.tolerance * std::abs(truth)) << number.name;
    EXPECT_TRUE(number.is_determined) << number.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, IdentifiedTwins, ::testing::ValuesIn(twin_cases()),
                         [](const ::testing::TestParamInfo<TwinCase>& of) {
                           return of.param.name;
                         });

}  // namespace
}  // namespace codesign
