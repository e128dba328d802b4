// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/mechanisms.h"

#include <cmath>

#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kLength = 0.2, kMass = 0.5, kRadius = 0.01, kFriction = 0.3, kWidth = 0.02;

std::string quoted(double value) { return "\"" + to_decimal(value) + "\""; }
std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// A number, and its twin if there is one.
std::string attribute(const std::string& name, double value, const std::string& twin = "") {
  return " " + name + "=" + quoted(value) +
         (twin.empty() ? "" : " codesign:" + name + "=" + quoted("${" + twin + "}"));
}

/// A point on the z axis.
std::string on_z(double z, const std::string& twin = "") {
  return "<origin xyz=" + quoted("0 0 " + to_decimal(z)) +
         (twin.empty() ? "" : " codesign:xyz=" + quoted("0 0 ${" + twin + "}")) + "/>";
}

/// A slender bar from the link's origin along -z. Without `suffix` it has no parameters.
std::string bar(const std::string& name, const std::string& suffix = "") {
  const bool twins = !suffix.empty();
  const std::string inertia = twins ? "mass" + suffix + "*(length" + suffix + "**2 + " +
                                          to_decimal(kWidth * kWidth) + ")/12"
                                    : "";
  const double across = kMass * (kLength * kLength + kWidth * kWidth) / 12.0,
               along = kMass * kWidth * kWidth / 6.0;
  return "<link name=" + quoted(name) + "><inertial>" +
         on_z(-kLength / 2.0, twins ? "-length" + suffix + "/2" : "") + "<mass" +
         attribute("value", kMass, twins ? "mass" + suffix : "") + "/><inertia" +
         attribute("ixx", across, inertia) + attribute("ixy", 0.0) + attribute("ixz", 0.0) +
         attribute("iyy", across, inertia) + attribute("iyz", 0.0) +
         attribute("izz", along,
                   twins ? "mass" + suffix + "*" + to_decimal(kWidth * kWidth / 6.0) : "") +
         "/></inertial></link>\n";
}

std::string friction(const std::string& suffix = "") {
  const bool twins = !suffix.empty();
  return "<codesign:friction model=\"brown_mcphee\" mu_dynamic=\"0.2\" "
         "transition_velocity=\"0.01\" joint_length=\"0.05\" "
         "smoothing=\"0.01\"" +
         attribute("mu_static", kFriction, twins ? "friction" + suffix : "") +
         attribute("pin_radius", kRadius, twins ? "radius" + suffix : "") + "/>";
}

std::string hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& origin, const std::string& axis, const std::string& inside) {
  return "<joint name=" + quoted(name) + " type=\"continuous\"><parent link=" + quoted(parent) +
         "/><child link=" + quoted(child) + "/>" + origin + "<axis xyz=" + quoted(axis) + "/>" +
         inside + "</joint>\n";
}

std::string robot(const std::string& name, const std::string& content) {
  return "<robot name=" + quoted(name) +
         " xmlns:codesign=\"urn:mechanism_codesign\">\n<link name=\"ground\"/>\n" + content +
         "</robot>\n";
}

std::string parameter(const std::string& name, double value) {
  return "<codesign:parameter name=" + quoted(name) + attribute("value", value) +
         attribute("lower", 0.8 * value) + attribute("upper", 1.5 * value) + "/>\n";
}

std::string study(const std::string& initial_state, const std::string& parameters,
                  const std::string& signal) {
  return "duration: 0.5\ninitial_state: {" + initial_state + "}\nparameters: {" + parameters +
         "}\nobjective: {integral: [{signal: " + signal +
         "}]}\nsolver: {coordinates: absolute, method: rodas4, relative_tolerance: 1.0e-6, "
         "absolute_tolerance: 1.0e-7}\n";
}

GeneratedCase chain(int links, bool parametric, const std::string& tuned) {
  std::string parameters, content, initial;
  for (int k = 0; k < links; ++k) {
    const std::string index = std::to_string(k), suffix = parametric ? "_" + index : "",
                      before = parametric ? "_" + std::to_string(k - 1) : "";
    if (parametric)
      parameters += parameter("length" + suffix, kLength) + parameter("mass" + suffix, kMass) +
                    parameter("radius" + suffix, kRadius) +
                    parameter("friction" + suffix, kFriction);
    initial += (k == 0 ? "" : ", ") + ("hinge_" + index) + ": {position: 0.5}";
    content += bar("link_" + index, suffix);
    content += hinge("hinge_" + index, k == 0 ? "ground" : "link_" + std::to_string(k - 1),
                     "link_" + index,
                     k == 0 ? on_z(0.0) : on_z(-kLength, parametric ? "-length" + before : ""),
                     k % 2 == 0 ? "0 1 0" : "1 0 0", friction(suffix));
  }
  return {{"chain.urdf", robot("chain", parameters + content)},
          {"chain.yaml", study(initial, tuned, "hinge_0/velocity")}};
}

}  // namespace

GeneratedCase open_chain(int links) { return chain(links, false, ""); }

GeneratedCase parametric_chain(int links, int tuned) {
  static const char* const kinds[] = {"length_", "mass_", "radius_", "friction_"};
  std::string names;
  for (int k = 0; k < tuned; ++k)
    names += (k == 0 ? "" : ", ") + (kinds[k % 4] + std::to_string(k / 4)) + ": {}";
  return chain(links, true, names);
}

GeneratedCase ladder(int loops) {
  std::string content, initial;
  for (int k = 0; k <= loops; ++k) {
    const std::string index = std::to_string(k), post = "post_" + index;
    content += bar(post) + hinge("hinge_" + index, "ground", post,
                                 "<origin xyz=\"" + to_decimal(kLength * k) + " 0 0\"/>", "0 1 0",
                                 friction());
    initial += (k == 0 ? "" : ", ") + ("hinge_" + index) +
               (k == 0 ? ": {position: 0.6}" : ": {guess: 0.6}");
    if (k == loops) break;
    // The coupler lies along x: its own -z is turned there.
    const std::string coupler = "coupler_" + index, ball = "ball_" + index;
    content += bar(coupler) + "<link name=\"" + ball + "_a\"/>\n<link name=\"" + ball + "_b\"/>\n";
    content +=
        hinge(ball + "_y", post, ball + "_a",
              "<origin xyz=\"0 0 " + to_decimal(-kLength) + "\" rpy=\"0 -1.5707963267948966 0\"/>",
              "0 1 0", "");
    content += hinge(ball + "_x", ball + "_a", ball + "_b", "", "1 0 0", "") +
               hinge(ball + "_z", ball + "_b", coupler, "", "0 0 1", "");
    content += "<loop name=\"pin_" + index + "\" type=\"codesign:universal\"><predecessor link=\"" +
               coupler + "\">" + on_z(-kLength) + "</predecessor><successor link=\"post_" +
               std::to_string(k + 1) + "\">" + on_z(-kLength) +
               "</successor><axis xyz=\"0 1 0\"/><codesign:second_axis xyz=\"0 0 1\"/></loop>\n";
    initial += ", " + ball + "_y: {guess: -0.6}";
  }
  return {{"ladder.urdf", robot("ladder", content)},
          {"ladder.yaml", study(initial, "", "hinge_0/velocity")}};
}

GeneratedCase stacked_four_bars(int loops, bool with_friction) {
  constexpr double kWidth = 1.5 * kLength;
  const std::string along_x = "rpy=\"0 -1.5707963267948966 0\"/>",
                    at_width = "<origin xyz=\"" + to_decimal(kWidth) + " 0 0\"/>";
  std::string content, initial, below = "ground";
  for (int k = 0; k < loops; ++k) {
    const std::string index = std::to_string(k), crank = "crank_" + index,
                      rocker = "rocker_" + index, coupler = "coupler_" + index;
    content += bar(crank) + bar(rocker) + bar(coupler);
    content +=
        hinge("crank_hinge_" + index, below, crank, "", "0 1 0", with_friction ? friction() : "");
    content += hinge("rocker_hinge_" + index, below, rocker, k == 0 ? at_width : on_z(-kWidth),
                     "0 1 0", "");
    // The coupler lies along x of the linkage; its own -z is turned there.
    content += hinge("coupler_hinge_" + index, crank, coupler,
                     "<origin xyz=\"0 0 " + to_decimal(-kLength) + "\" " + along_x, "0 1 0", "");
    content += "<loop name=\"pin_" + index + "\" type=\"continuous\"><predecessor link=\"" +
               coupler + "\">" + on_z(-kWidth) + "</predecessor><successor link=\"" + rocker +
               "\">" + on_z(-kLength) + "</successor><axis xyz=\"0 1 0\"/></loop>\n";
    initial += (k == 0 ? "" : ", ") + ("crank_hinge_" + index) + ": {position: 0.2}";
    initial +=
        ", rocker_hinge_" + index + ": {guess: 0.2}, coupler_hinge_" + index + ": {guess: -0.2}";
    below = coupler;
  }
  return {{"stack.urdf", robot("stack", content)},
          {"stack.yaml", study(initial, "", "crank_hinge_0/velocity")}};
}

std::vector<PlanarCase> planar_linkages(bool held) {
  const auto at = [](double x, double z) {
    return "<origin xyz=" + quoted(to_decimal(x) + " 0 " + to_decimal(z)) + "/>";
  };
  const auto pin = [&at](const std::string& name, const std::string& predecessor, double z,
                         const std::string& successor, double w) {
    return "<loop name=" + quoted(name) +
           " type=\"continuous\"><predecessor link=" + quoted(predecessor) + ">" + at(0.0, z) +
           "</predecessor><successor link=" + quoted(successor) + ">" + at(0.0, w) +
           "</successor><axis xyz=\"0 1 0\"/></loop>\n";
  };
  const std::string y = "0 1 0";
  const std::string slider = robot(
      "slider_crank",
      bar("crank") + bar("rod") + bar("slider") +
          hinge("crank_hinge", "ground", "crank", "", y, friction()) +
          hinge("rod_hinge", "crank", "rod", on_z(-0.5 * kLength), y, "") +
          "<joint name=\"slide\" type=\"prismatic\"><parent link=\"ground\"/><child "
          "link=\"slider\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"0\" "
          "velocity=\"0\"/></joint>" +
          pin("slider_pin", "rod", -kLength, "slider", 0.0));
  GeneratedCase four = stacked_four_bars(1, true), six = four;
  six.urdf.text.insert(
      six.urdf.text.rfind("</robot>"),
      bar("rod") + bar("output") + hinge("rod_hinge", "coupler_0", "rod", on_z(-kLength), y, "") +
          hinge("output_hinge", "ground", "output", at(3.0 * kLength, 0.0), y, "") +
          pin("output_pin", "rod", -1.8 * kLength, "output", -kLength));
  six.study.text.replace(six.study.text.find("{position: 0.2}"), 15,
                         "{position: 0.2}, rod_hinge: {guess: 0.0}, output_hinge: {guess: 0.4}");
  std::vector<PlanarCase> cases = {
      {"four-bar", four},
      {"slider-crank",
       {{"slider.urdf", slider},
        {"slider.yaml", study("crank_hinge: {position: 1.0}, rod_hinge: {guess: -1.4}, slide: "
                              "{guess: -0.24}",
                              "", "crank_hinge/velocity")}}},
      {"six-bar", six}};
  const std::string absolute = "coordinates: absolute, ";
  for (PlanarCase& c : cases)
    c.texts.study.text.erase(c.texts.study.text.find(absolute), absolute.size());
  if (!held) return cases;
  for (PlanarCase& c : cases)
    for (std::size_t k = 0; (k = c.texts.urdf.text.find("<loop ", k)) != std::string::npos; k += 6)
      c.texts.urdf.text.insert(k + 6, "codesign:out_of_plane=\"zero\" ");
  return cases;
}

GeneratedCase bricard_ring() {
  // The angles alternate between theta and phi with cos theta + cos phi + cos theta cos phi = 0.
  const double theta = 1.2, phi = std::acos(-std::cos(theta) / (1.0 + std::cos(theta)));
  std::string content, initial;
  for (int k = 0; k < 5; ++k) {
    const std::string hinge_name = "hinge_" + std::to_string(k), link = "link_" + std::to_string(k);
    content +=
        bar(link) + hinge(hinge_name, k == 0 ? "ground" : "link_" + std::to_string(k - 1), link,
                          on_z(k == 0 ? 0.0 : -kLength), k % 2 == 0 ? "0 1 0" : "1 0 0", "");
    initial += (k == 0 ? "" : ", ") + hinge_name + (k == 0 ? ": {position: " : ": {guess: ") +
               to_decimal(k % 2 == 0 ? theta : phi) + "}";
  }
  content += "<loop name=\"hinge_5\" type=\"continuous\"><predecessor link=\"link_4\">" +
             on_z(-kLength) + "</predecessor><successor link=\"ground\">" + on_z(kLength) +
             "</successor><axis xyz=\"1 0 0\"/></loop>\n";
  return {{"ring.urdf", robot("ring", content)},
          {"ring.yaml", study(initial, "", "hinge_0/velocity")}};
}

}  // namespace codesign
