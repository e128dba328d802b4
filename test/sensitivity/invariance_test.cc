// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "description/study.h"
#include "edited_text.h"
#include "mechanism_codesign/gradient.h"
#include "paths.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

std::string text_of(const std::string& path) { return read_source(source_dir() + "/" + path).text; }

std::string replaced(const std::string& text, const std::string& pattern, const std::string& by) {
  const std::string result = replaced_all(text, pattern, by);
  EXPECT_NE(result, text) << pattern;
  return result;
}

/// Objective and gradient at a tolerance at which formulations agree to about 1e-7.
Evaluation evaluate(const std::string& urdf, const std::string& study_text) {
  const RobotDescription robot = read_urdf({"variant.urdf", urdf});
  Study study = read_study({"variant.yaml", study_text}, robot);
  study.duration = 0.5;
  study.solver.method = RosenbrockMethod::kRodas5P;
  study.solver.relative_tolerance = 1e-8;
  study.solver.absolute_tolerance = 1e-9;
  const auto system = make_system(robot, study);
  Eigen::VectorXd rho(static_cast<Eigen::Index>(study.tuned.size()));
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] =
        study.parameters[static_cast<std::size_t>(study.tuned[k])].value;
  return evaluator_of(system).evaluate(rho, true);
}

const Evaluation& reference() {
  static const Evaluation evaluation =
      evaluate(text_of("urdf/slider_crank.urdf"), text_of("config/slider_crank.yaml"));
  return evaluation;
}

void expect_same(const Evaluation& variant) {
  ASSERT_TRUE(reference().status.ok()) << reference().status.cause;
  ASSERT_TRUE(variant.status.ok()) << variant.status.cause;
  EXPECT_NEAR(variant.objective, reference().objective, 2e-6 * reference().objective);
  for (Eigen::Index k = 0; k < variant.gradient.size(); ++k)
    EXPECT_NEAR(variant.gradient[k], reference().gradient[k],
                1e-5 * reference().gradient.cwiseAbs().maxCoeff())
        << k;
}

/// Top-level elements of a robot in reverse order; parameters stay in front, since studies list
/// them in their own order anyway.
std::string reversed(const std::string& urdf) {
  std::vector<std::string> blocks;
  const std::string element("<(link|joint|loop)\\b[^>]*?(/>|>[\\s\\S]*?</\\1>)");
  blocks = matches_in(urdf, element);
  EXPECT_EQ(blocks.size(), 12U);
  std::string rest = replaced_all(urdf, element, ""), body;
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) body += *block + "\n";
  return rest.insert(rest.rfind("</robot>"), body);
}

TEST(Invariance, NamesDoNotMatter) {
  std::string urdf = text_of("urdf/slider_crank.urdf"), study = text_of("config/slider_crank.yaml");
  for (std::string* text : {&urdf, &study}) *text = replaced(*text, "crank_joint", "a1");
  urdf = replaced(urdf, "\"slider_joint\"", "\"zz\"");
  urdf = replaced(urdf, "\"(crank|rod|slider)\"", "\"part_$1_of_it\"");
  expect_same(evaluate(urdf, study));
}

TEST(Invariance, OrderDoesNotMatter) {
  expect_same(
      evaluate(reversed(text_of("urdf/slider_crank.urdf")), text_of("config/slider_crank.yaml")));
}

TEST(Invariance, DirectionDoesNotMatter) {
  const std::string turned =
      replaced(text_of("urdf/slider_crank.urdf"), "</robot>",
               "<link name=\"world\"/><joint name=\"turn\" type=\"fixed\"><parent "
               "link=\"world\"/><child link=\"ground\"/>"
               "<origin xyz=\"0.3 -0.2 0.5\" rpy=\"1.5707963267948966 0 0\"/></joint></robot>");
  // The axis -z becomes +y after a quarter turn about x.
  expect_same(
      evaluate(turned, text_of("config/slider_crank.yaml") + "\ngravity: [0.0, 9.81, 0.0]\n"));
}

TEST(Invariance, TheCutDoesNotMatter) {
  // The tree runs over the rod to the slider, and the sliding joint with its friction closes the
  // loop.
  std::string urdf = text_of("urdf/slider_crank.urdf");
  const std::string friction = matches_in(urdf, "<codesign:friction[\\s\\S]*?/>").at(0);
  urdf = replaced(urdf, "<joint name=\"slider_joint\"[\\s\\S]*?</joint>", "");
  urdf = replaced(
      urdf, "<loop name=\"slider_pin\"[\\s\\S]*?</loop>",
      "<joint name=\"pin_z\" type=\"continuous\"><parent link=\"rod\"/><child link=\"cross\"/>"
      "<origin xyz=\"0.3 0 0\" codesign:xyz=\"${rod_length} 0 0\"/><axis xyz=\"0 0 "
      "1\"/></joint><link name=\"cross\"/>"
      "<joint name=\"pin_y\" type=\"continuous\"><parent link=\"cross\"/><child link=\"slider\"/>"
      "<origin xyz=\"0 0 0\" rpy=\"0 -0.49301772898075735 0.16744807921968938\"/><axis xyz=\"0 1 "
      "0\"/></joint>"
      "<loop name=\"rail\" type=\"prismatic\"><predecessor link=\"ground\"/><successor "
      "link=\"slider\"/><axis xyz=\"1 0 0\"/>" +
          replaced_all(friction, "\\$", "$$$$") + "</loop>");
  expect_same(evaluate(urdf, text_of("config/slider_crank.yaml")));
}

}  // namespace
}  // namespace codesign
