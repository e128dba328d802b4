// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/inputs.h"

#include <gtest/gtest.h>

#include "paths.h"

namespace codesign {
namespace {

Inputs slider_crank() {
  Inputs inputs;
  inputs.urdf = read_source(source_dir() + "/urdf/slider_crank_haug.urdf");
  return inputs;
}

TEST(Inputs, WithoutAStudyAreTheMechanismAlone) {
  const Problem problem = load(slider_crank());
  EXPECT_TRUE(problem.study().tuned.empty());
  EXPECT_EQ(problem.duration(), 0.0);
}

TEST(Inputs, WithAStudyAreTheWholeProblem) {
  Inputs inputs = slider_crank();
  inputs.study = read_source(source_dir() + "/config/slider_crank_haug.yaml");
  const Problem problem = load(inputs);
  ASSERT_FALSE(problem.study().tuned.empty());
  inputs.settings = {{problem.tuned_names().front(), problem.start()[0] * 1.01}};
  EXPECT_EQ(load(inputs).start()[0], problem.start()[0] * 1.01);
  inputs.settings = {{"none_of_these", 1.0}};
  EXPECT_THROW(load(inputs), InputError);
}

}  // namespace
}  // namespace codesign
