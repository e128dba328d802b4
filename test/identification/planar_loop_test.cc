// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Linkages whose loop is held in its plane, identified from the motor of their crank alone.

#include "identification/identify.h"
#include "identification/simulated_recording.h"
#include "integration/planar_linkages.h"

namespace codesign {
namespace {

/// The linkage with numbers to be found: the crank's mass, and the friction of the slide.
Problem linkage(bool in_plane) {
  std::string urdf = block_on_a_loop(
      "<codesign:friction mu_static='0.2' codesign:mu_static='${mu}' mu_dynamic='0.2' "
      "codesign:mu_dynamic='${mu}' transition_velocity='0.02' joint_length='0.1' "
      "joint_width='0.06'/>");
  const std::string ground = "<link name='ground'/>";
  urdf.insert(urdf.find(ground) + ground.size(),
              "<codesign:parameter name='mu' value='0.2' lower='0' upper='1'/>");
  return load_problem(
      {"linkage.urdf", in_plane ? held_in_plane(urdf) : urdf}, {},
      {"study.yaml",
       "duration: 6.0\ninitial_state: {crank_joint: {position: 0.9}, rod_joint: {guess: -0.9}, "
       "block_joint: {guess: 0.0}}\n"
       "controllers: {servo: {type: pid, input: crank_joint/position, setpoint: {type: sine, "
       "amplitude: 1.2, period: 2.5, offset: 0.9}, output: crank_joint, gains: {p: 400.0, d: "
       "40.0}}}\nparameters: {mass: {}, mu: {}}\nsolver: {relative_tolerance: 1.0e-8, "
       "absolute_tolerance: 1.0e-9}\nidentify: {data: [{csv: run.csv}], filter: {cutoff: 40.0, "
       "residual_cutoff: 20.0, decimate: 5}}\noptimizer: {relative_tolerance: 1.0e-10}\n"});
}

TEST(PlanarLoop, IsIdentifiedFromItsMotor) {
  const std::map<std::string, double> truth = {{"mass", 1.6}, {"mu", 0.35}};
  const Problem problem = linkage(true);
  StudyRecordings recordings;
  recordings.data = {record_run(problem, truth, {"crank_joint"}, 500.0)};
  const IdentificationResult found = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  ASSERT_EQ(found.numbers.size(), truth.size());
  for (const IdentifiedNumber& number : found.numbers) {
    EXPECT_NEAR(number.value, truth.at(number.name), 2e-3 * truth.at(number.name)) << number.name;
    EXPECT_TRUE(number.is_determined) << number.name;
  }
  EXPECT_LT(found.data[0].rms, 2e-3 * found.data[0].recorded);
  EXPECT_GT(found.data[0].start, 20.0 * found.data[0].rms);
  // All loads of this linkage lie in its plane, so that a loop that shares them finds the same.
  const IdentificationResult shared = identify(linkage(false), recordings, {}, nullptr);
  ASSERT_TRUE(shared.status.ok()) << shared.status.cause;
  for (std::size_t k = 0; k < found.numbers.size(); ++k)
    EXPECT_NEAR(found.numbers[k].value, shared.numbers[k].value, 1e-5) << found.numbers[k].name;
}

/// The joints move together, so that the speed of a mask would not be that of one.
TEST(PlanarLoop, BoundsAtRestNeedIndependentJoints) {
  const Problem problem = linkage(true);
  StudyRecordings recordings;
  recordings.data = {
      record_run(problem, {{"mass", 1.6}, {"mu", 0.35}}, {"crank_joint", "rod_joint"}, 500.0)};
  recordings.data[0].element = "identify.data[0]";
  recordings.data[0].where = {"study.yaml", 5};
  JointSamples& crank = recordings.data[0].joints[0];
  recordings.data[0].joints[1].effort.clear();
  crank.least_speed = 0.05;
  crank.has_bounds = true;
  try {
    identify(problem, recordings, {}, nullptr);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "identify.data[0].mask.rest");
    EXPECT_EQ(error.fault().where.line, 5);
  }
}

}  // namespace
}  // namespace codesign
