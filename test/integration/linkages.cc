// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/linkages.h"

#include <cmath>
#include <functional>
#include <string>

namespace codesign {

std::string four_bar_with(const std::string& more) {
  std::string text = four_bar();
  return text.insert(text.rfind("<loop"), more);
}

std::string four_bar_row(int count) {
  std::string content;
  const auto tip = [](int k) { return "bar" + std::to_string(k); };
  for (int k = 0; k <= count; ++k)
    content +=
        bar(tip(k)) + hinge(tip(k) + "_hinge", "ground", tip(k), std::to_string(1.2 * k) + " 0 0");
  for (int k = 0; k < count; ++k) {
    const std::string coupler = "coupler" + std::to_string(k);
    content += bar(coupler) + "<joint name='pin" + std::to_string(k) +
               "' type='continuous'><parent link='" + tip(k) + "'/><child link='" + coupler +
               "'/><origin xyz='0 0 -1' rpy='0 -1.5707963267948966 0'/><axis xyz='0 1 0'/></joint>";
    content += "<loop name='close" + std::to_string(k) + "' type='continuous'><predecessor link='" +
               tip(k + 1) + "'><origin xyz='0 0 -1'/></predecessor><successor link='" + coupler +
               "'><origin xyz='0 0 -1.2'/></successor><axis xyz='0 1 0'/></loop>";
  }
  return robot(content);
}

double four_bar_row_acceleration(int count, double theta) {
  const double bars = count + 1.0, couplers = count;
  return -9.81 * std::sin(theta) * (0.5 * bars + couplers) / (bars * 0.3334 + couplers);
}

std::string upright_row(int count) {
  const auto rod = [](const std::string& name, bool upright) {
    return "<link name='" + name + "'><inertial><origin xyz='" + (upright ? "0 0 0.5" : "0.5 0 0") +
           "'/><mass value='1'/><inertia ixx='" + (upright ? "0.08333333333333333" : "1e-05") +
           "' ixy='0' ixz='0' iyy='0.08333333333333333' iyz='0' izz='" +
           (upright ? "1e-05" : "0.08333333333333333") + "'/></inertial></link>";
  };
  std::string content;
  for (int k = 0; k <= count; ++k) {
    const std::string bar = "bar" + std::to_string(k);
    content += rod(bar, true) +
               hinge("hinge" + std::to_string(k), "ground", bar, std::to_string(k) + " 0 0");
  }
  for (int k = 0; k < count; ++k) {
    const std::string number = std::to_string(k), coupler = "coupler" + number;
    content += rod(coupler, false) + hinge("pin" + number, "bar" + number, coupler, "0 0 1") +
               "<loop name='close" + number + "' type='continuous'><predecessor link='bar" +
               std::to_string(k + 1) + "'><origin xyz='0 0 1'/></predecessor><successor link='" +
               coupler + "'><origin xyz='1 0 0'/></successor><axis xyz='0 1 0'/></loop>";
  }
  return robot(content);
}

double upright_row_acceleration(int count, double theta) {
  const double bars = count + 1.0, couplers = count;
  return 9.81 * std::sin(theta) * (0.5 * bars + couplers) / (bars / 3.0 + couplers);
}

std::string bricard() {
  std::string content;
  const auto twist = [](int k) {
    return std::string(k % 2 == 0 ? "1.5707963267948966" : "-1.5707963267948966");
  };
  for (int k = 1; k <= 5; ++k) {
    const std::string link = "bar" + std::to_string(k),
                      parent = k == 1 ? "ground" : "bar" + std::to_string(k - 1);
    content += "<link name='" + link +
               "'><inertial><origin xyz='0.5 0 0'/><mass value='1'/><inertia ixx='0.001' ixy='0' "
               "ixz='0' iyy='0.0834' iyz='0' "
               "izz='0.0834'/></inertial></link><joint name='turn" +
               std::to_string(k) + "' type='continuous'><parent link='" + parent +
               "'/><child link='" + link + "'/>" +
               (k == 1 ? "" : "<origin xyz='1 0 0' rpy='" + twist(k - 2) + " 0 0'/>") +
               "<axis xyz='0 0 1'/></joint>";
  }
  return robot(
      content +
      "<loop name='turn6' type='continuous'><predecessor link='bar5'><origin xyz='1 0 0' rpy='" +
      twist(4) +
      " 0 0'/></predecessor><successor link='ground'><origin xyz='-1 0 0' rpy='1.5707963267948966 "
      "0 0'/></successor><axis xyz='0 0 "
      "1'/></loop>");
}

double bricard_partner(double theta) {
  return std::acos(-std::cos(theta) / (1.0 + std::cos(theta)));
}

std::string bricard_start(double theta, double rate) {
  std::string initial =
      "{turn1: {position: " + std::to_string(theta) + ", velocity: " + std::to_string(rate) + "}";
  for (int k = 2; k <= 5; ++k)
    initial += ", turn" + std::to_string(k) +
               ": {guess: " + std::to_string(k % 2 == 1 ? theta : bricard_partner(theta)) + "}";
  return initial + "}";
}

double reference_angle(const std::function<double(double)>& f, double theta, double rate, double t,
                       int steps) {
  const double h = t / steps;
  for (int k = 0; k < steps; ++k) {
    const double a1 = f(theta), a2 = f(theta + 0.5 * h * rate),
                 a3 = f(theta + 0.5 * h * rate + 0.25 * h * h * a1),
                 a4 = f(theta + h * rate + 0.5 * h * h * a2);
    theta += h * rate + h * h / 6.0 * (a1 + a2 + a3);
    rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return theta;
}

}  // namespace codesign
