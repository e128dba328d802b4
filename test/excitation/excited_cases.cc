// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/excited_cases.h"

#include <fstream>
#include <sstream>
#include <string>

namespace codesign {

std::string pendulum_urdf(const std::string& axis, const std::string& other_centre) {
  const std::string centre = !other_centre.empty() ? other_centre
                             : axis == "0 0 1"     ? "0.5 0 0"
                                                   : "0 0 -0.5";
  return R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mass" value="2" lower="0.1" upper="10"/>
  <codesign:parameter name="inertia" value="0.1" lower="0.001" upper="5"/>
  <codesign:parameter name="viscous" value="0.3" lower="0" upper="10"/>
  <codesign:parameter name="coulomb" value="0.5" lower="0" upper="10"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz=")" +
         centre + R"("/><mass value="2" codesign:value="${mass}"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" codesign:ixx="${inertia}" codesign:iyy="${inertia}" codesign:izz="${inertia}"/>
  </inertial></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="bar"/><axis xyz=")" +
         axis + R"("/>
    <limit lower="-1.2" upper="1.2" velocity="4" effort="14"/>
    <dynamics damping="0.3" friction="0.5" codesign:damping="${viscous}" codesign:friction="${coulomb}"/></joint>
</robot>)";
}

Problem excited_pendulum(const std::string& excite, const std::string& more,
                         const std::string& axis, const std::string& identify) {
  return load_problem(
      {"pendulum.urdf", pendulum_urdf(axis)}, {},
      {"study.yaml", "identify: {" + identify +
                         "}\nexcite: {joints: {hinge: {noise: 0.1}}, period: 4.0" +
                         (excite.empty() ? "" : ", ") + excite + "}\n" + more + "\n"});
}

std::string arm_urdf() {
  std::string text =
      R"(<robot name="arm" xmlns:codesign="urn:mechanism_codesign"><link name="base"/>)";
  const char* names[] = {"upper", "fore"};
  for (const std::string name : names)
    text += "<codesign:parameter name=\"" + name +
            "_mass\" value=\"2\" lower=\"0.1\" upper=\"10\"/>" + "<codesign:parameter name=\"" +
            name + "_inertia\" value=\"0.05\" lower=\"0.001\" upper=\"5\"/>" +
            "<codesign:parameter name=\"" + name +
            "_viscous\" value=\"0.3\" lower=\"0\" upper=\"10\"/>" + "<codesign:parameter name=\"" +
            name + "_coulomb\" value=\"0.5\" lower=\"0\" upper=\"10\"/>";
  for (const std::string name : names)
    text +=
        "<link name=\"" + name +
        R"("><inertial><origin xyz="0 0 -0.2"/><mass value="2" codesign:value="${)" + name +
        R"(_mass}"/><inertia ixx="0.05" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0" codesign:ixx="${)" +
        name + R"(_inertia}" codesign:iyy="${)" + name + R"(_inertia}" codesign:izz="${)" + name +
        "_inertia}\"/></inertial></link>";
  const auto joint = [&text](const std::string& name, const std::string& parent,
                             const std::string& child, const std::string& origin) {
    text += "<joint name=\"" + name + R"(" type="revolute"><parent link=")" + parent +
            R"("/><child link=")" + child + R"("/><origin xyz=")" + origin +
            R"("/><axis xyz="0 1 0"/><limit lower="-1.5" upper="2" velocity="3" effort="25"/>)" +
            R"(<dynamics damping="0.3" friction="0.5" codesign:damping="${)" + child +
            R"(_viscous}" codesign:friction="${)" + child + "_coulomb}\"/></joint>";
  };
  joint("shoulder", "base", "upper", "0 0 0");
  joint("elbow", "upper", "fore", "0 0 -0.4");
  return text + "</robot>";
}

Problem arm(const std::string& excite, const std::string& identify, const std::string& tuned) {
  std::string parameters;
  std::istringstream words(tuned);
  for (std::string word; std::getline(words, word, ',');)
    parameters += (parameters.empty() ? "" : ",") + word + ": {}";
  return load_problem({"arm.urdf", arm_urdf()}, {},
                      {"study.yaml", "identify: {" + identify +
                                         "}\nexcite: {joints: {shoulder: {acceleration: 15}, "
                                         "elbow: {effort: 9}}, noise: 0.2, period: 5.0" +
                                         (excite.empty() ? "" : ", ") + excite +
                                         "}\nparameters: {" + parameters + "}\n"});
}

std::string file_text(const std::string& path) {
  std::ifstream file(source_dir() + "/" + path);
  EXPECT_TRUE(file.good()) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Problem slider_crank(const std::string& excite) {
  return load_problem(
      {"slider_crank.urdf", file_text("urdf/slider_crank.urdf")}, {},
      {"study.yaml",
       "initial_state: {crank_joint: {position: 0.0}}\nidentify: {}\nexcite:\n"
       "  joints: {crank_joint: {position: [-1.5, 1.5], velocity: 8.0, effort: 1.0}}\n"
       "  limits: {slider_joint: {position: [0.2, 0.27], velocity: 0.4}}\n  noise: 0.01\n  period: "
       "3.0\n" +
           excite + "parameters: {crank_length: {}, rod_length: {}}\n"});
}

double worst_along(const MotionLimits& limits, const DrivePath& path, ExcitedMotion* motion) {
  PathResponse response;
  EXPECT_TRUE(motion->respond(path, false, &response).ok());
  double worst = 0.0;
  for (const LimitedSignal& signal : limits.signals) {
    using Kind = LimitedSignal::Kind;
    const Eigen::MatrixXd& rows =
        signal.is_follower ? (signal.kind == Kind::kPosition ? response.follower_position
                                                             : response.follower_velocity)
        : signal.kind == Kind::kPosition ? path.position
        : signal.kind == Kind::kVelocity ? path.velocity
        : signal.kind == Kind::kEffort   ? response.effort
                                         : path.acceleration;
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
      worst = std::max(worst, std::abs(signal.relative(rows(signal.joint, k))));
  }
  return worst;
}

}  // namespace codesign
