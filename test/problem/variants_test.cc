// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/variants.h"

#include <gtest/gtest.h>

#include <limits>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "equations/compiled_system.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

TEST(Variants, OneStudyIsItsOwn) {
  const Problem problem = block("");
  EXPECT_EQ(variant_of(problem, 0, -1), system_of(problem));
  EXPECT_EQ(count_laws(study_of(problem)), 0);
}

TEST(Variants, EachRunHasEachLaw) {
  const Problem problem = block(R"(
runs: {own: {set: {mass: 1.0}}, far: {controllers: {hold: {setpoint: 0.9}}}}
uncertain: {friction_law: {choice: [gonthier, lugre]}}
)");
  ASSERT_EQ(count_laws(study_of(problem)), 2);
  EXPECT_EQ(variant_of(problem, 0, -1), system_of(problem));
  EXPECT_EQ(variant_of(problem, 0, 0)->robot().joints[0].friction->model, FrictionModel::kGonthier);
  EXPECT_EQ(variant_of(problem, 1, 1)->robot().joints[0].friction->model, FrictionModel::kLuGre);
  EXPECT_EQ(variant_of(problem, 1, -1)->robot().joints[0].friction->model,
            FrictionModel::kBrownMcPhee);
  EXPECT_EQ(variant_of(problem, 1, 1)->study().controllers[0].setpoint.constant.nominal(), 0.9);
  EXPECT_EQ(variant_of(problem, 0, 1)->study().controllers[0].setpoint.constant.nominal(), 0.5);
}

TEST(Variants, EachSystemIsListedOnce) {
  EXPECT_EQ(distinct_systems(block("")).size(), 1U);
  const Problem problem = block(R"(
runs: {own: {}, light: {set: {mass: 1.0}}, far: {controllers: {hold: {setpoint: 0.9}}}}
uncertain: {friction_law: {choice: [gonthier, lugre]}}
)");
  const auto systems = distinct_systems(problem);
  EXPECT_EQ(systems.front(), system_of(problem));
  // Two systems with the model's own law, since one run only sets a value, and three runs with two
  // laws each.
  EXPECT_EQ(systems.size(), 8U);
  EXPECT_EQ(systems.back(), variant_of(problem, 2, 1));
}

// As a request to a node does.
Problem tuning(const Problem& problem, int parameter) {
  Study study = study_of(problem);
  study.tuned.push_back(parameter);
  return with_study(problem, study);
}

TEST(Variants, ARequestCannotTuneWhatARunSetsOrWhatIsUncertain) {
  EXPECT_NO_THROW(tuning(block("runs: {light: {set: {mass: 1.0}}}\n"), 0));
  EXPECT_THROW(tuning(block("runs: {light: {set: {mass: 1.0}}}\n"), 1), InputError);
  EXPECT_THROW(tuning(block("uncertain: {mu: {uniform: [0.2, 0.4]}}\n"), 0), InputError);
}

TEST(Variants, ManyStartsNeedBounds) {
  const Problem problem = block("multistart: {starts: 2}\n");
  Study study = study_of(problem);
  study.parameters[2].upper = std::numeric_limits<double>::infinity();
  EXPECT_THROW(with_study(problem, study), InputError);
}

// Names, lines and ranges of the fault for a study with that many further parameters.
InputFault fault_of(const std::string& ensemble, const std::string& parameters) {
  try {
    block(ensemble, "{algorithm: slsqp}", parameters);
  } catch (const InputError& error) {
    return error.fault();
  }
  return {};
}

TEST(Variants, SobolSamplesHaveALargestDimension) {
  std::string parameters, uncertain = "uncertain: {mu: {uniform: [0.2, 0.4]}";
  for (int k = 0; k < 3667; ++k) {
    parameters += ", a" + std::to_string(k) + ": {tune: false, initial: 0.5}";
    uncertain += ", a" + std::to_string(k) + ": {uniform: [0, 1]}";
  }
  const InputFault fault = fault_of(uncertain + "}\nrobust: {samples: 2}\n", parameters);
  EXPECT_EQ(fault.where.file, "block.yaml");
  EXPECT_GT(fault.where.line, 1);
  EXPECT_EQ(fault.element, "robust.sampler");
  EXPECT_EQ(fault.value, "3668 uncertain parameters");
  EXPECT_NE(fault.allowed.find("at most 3667"), std::string::npos) << fault.allowed;
  EXPECT_EQ(fault_of(uncertain + "}\nrobust: {samples: 2, sampler: random}\n", parameters).message,
            "");
}

TEST(Variants, ManySobolStartsHaveALargestDimension) {
  std::string parameters;
  for (int k = 0; k < 3667; ++k)
    parameters += ", a" + std::to_string(k) + ": {initial: 0.5, lower: 0, upper: 1}";
  const InputFault fault = fault_of("multistart: {starts: 1}\n", parameters);
  EXPECT_EQ(fault.element, "multistart.sampler");
  EXPECT_EQ(fault.value, "3669 tuned parameters");
  EXPECT_EQ(fault_of("multistart: {starts: 1, sampler: latin_hypercube}\n", parameters).message,
            "");
}

TEST(Variants, SettingsReachTheRuns) {
  const Problem problem = with_settings(
      block("runs: {far: {controllers: {hold: {setpoint: 0.9}}}}\n"), {{"mass", 3.0}, {"Kp", 7.0}});
  EXPECT_EQ(variant_of(problem, 0, -1)->study().parameters[1].value, 3.0);
  EXPECT_EQ(variant_of(problem, 0, -1)->study().parameters[2].value, 7.0);
}

}  // namespace
}  // namespace codesign
