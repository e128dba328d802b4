// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// All joint types with friction from their reaction, in the tree and as a loop, with preload: the
// energy balance holds with the work of friction.
#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "equations/formulas.h"
#include "equations/joint_cases.h"
#include "integration/energy_balance.h"

namespace codesign {
namespace {

using joint_cases::chain;
using joint_cases::loop;
using joint_cases::tree;

struct FrictionCase {
  std::string name, content;
};

void PrintTo(const FrictionCase& c, std::ostream* out) { *out << c.name; }

const char* const kOnGround =
    "<link name='base'/><joint name='weld' type='fixed'><parent link='ground'/><child "
    "link='base'/></joint>";

std::string friction(const std::string& geometry, const std::string& preload = "2") {
  return "<codesign:friction mu_static='0.12' mu_dynamic='0.1' transition_velocity='0.05' "
         "viscous='0.01' preload='" +
         preload + "' " + geometry + "/>";
}

/// In a chain the first joint has the friction annotation.
std::string annotated(std::string content, const std::string& annotation) {
  return content.insert(content.find("</joint>"), annotation);
}

std::vector<FrictionCase> cases() {
  const std::string pin = friction("joint_length='0.1' pin_radius='0.03'"),
                    slide = friction("joint_length='0.1' joint_width='0.06'"),
                    ball = friction("pin_radius='0.04'"), ring = friction("pin_radius='0.05'"),
                    flat = friction("");
  const std::string by_direction = friction(
      "joint_length='0.1' pin_radius='0.03' mu_static_backward='0.06' mu_dynamic_backward='0.05' "
      "viscous_backward='0.03'");
  const auto in_tree = [](const std::string& type, const std::string& annotation) {
    return tree("joint", type, "base", "tip", "1 0 0.5", joint_cases::kOrigin + annotation);
  };
  const auto as_loop = [](const std::string& type, const std::string& annotation) {
    return joint_cases::free("tip") + loop(type, "base", annotation);
  };
  return {{"revolute", in_tree("revolute", pin)},
          {"continuous", in_tree("continuous", pin)},
          {"prismatic", in_tree("prismatic", slide)},
          {"cylindrical", annotated(chain({{'R', "1 0 0.5"}, {'P', "1 0 0.5"}}), pin)},
          {"revolute_by_direction", in_tree("revolute", by_direction)},
          {"cylindrical_loop_by_direction", as_loop("codesign:cylindrical", by_direction)},
          {"spherical", annotated(chain({{'R', "1 0 0"}, {'R', "0 1 0"}, {'R', "0 0 1"}}), ball)},
          {"planar", in_tree("planar", ring)},
          {"table", annotated(chain({{'P', "1 0 0.5"}, {'P', "0.4 1 0"}}), flat)},
          {"revolute_loop", as_loop("revolute", pin)},
          {"prismatic_loop", as_loop("prismatic", slide)},
          {"cylindrical_loop", as_loop("codesign:cylindrical", pin)},
          {"spherical_loop", as_loop("codesign:spherical", ball)},
          {"planar_loop", as_loop("planar", ring)}};
}

std::string model(const std::string& content) {
  return robot(
      "<codesign:parameter name='size' value='0.1'/><codesign:parameter name='mass' value='0.8'/>" +
      std::string(kOnGround) + joint_cases::body("tip") + content);
}

class FrictionConformance : public ::testing::TestWithParam<FrictionCase> {};

TEST_P(FrictionConformance, FrictionTakesExactlyItsWork) {
  const Balance b =
      balance(model(GetParam().content), motion_study(0.4, "{}", "tip/velocity/x", kFriction));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(b.friction_work, 1e-3);
  EXPECT_NEAR(b.start - b.end, b.friction_work, 2e-6 * b.friction_work);
}

/// N at the start, where nothing slides yet and friction does not change the reactions.
double normal_force_at_rest(const std::string& content) {
  Compiled c(model(content), let_go("{}", "tip/velocity/x"));
  EXPECT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  for (int pair : c.system.contacts()) return c.equations.formulas().contact(pair).normal;
  for (const JointLoad& load : c.system.loads())
    if (load.find<BearingFriction>())
      return c.equations.formulas().friction(load.pair, load.element).normal;
  ADD_FAILURE() << "no friction";
  return 0.0;
}

TEST_P(FrictionConformance, ThePreloadAddsToTheNormalForce) {
  std::string loose = GetParam().content;
  loose.replace(loose.find("preload='2'"), 11, "preload='0'");
  const double without = normal_force_at_rest(loose);
  EXPECT_GT(without, 0.1);
  EXPECT_NEAR(normal_force_at_rest(GetParam().content), without + 2.0, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(AllJoints, FrictionConformance, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace codesign
