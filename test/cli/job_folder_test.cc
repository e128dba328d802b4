// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/job_folder.h"

#include <gtest/gtest.h>

#include "cli/inputs.h"
#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

Problem loaded_slider_crank() {
  Arguments arguments;
  arguments.model = shipped("urdf/slider_crank.urdf");
  arguments.study = shipped("config/slider_crank.yaml");
  return load(arguments);
}

TEST(JobFolder, AFailedTrialLeavesItsNumbersEmpty) {
  const ScratchFolder folder;
  const Problem problem = loaded_slider_crank();
  JobFolder job(folder.path("job"), problem);
  Trial trial;
  trial.evaluation = 2;
  trial.iteration = 1;
  trial.status = {StatusCode::kAssemblyFailed, 0.0, "too short"};
  trial.best_objective = 0.25;
  trial.rho = problem.start();
  job.add(trial);
  const std::string text = read_text_file(folder.path("job/convergence.csv"));
  EXPECT_NE(text.find("\n2,1,assembly_failed,,0.25,,0,0.08,0.3,0.05,0.025,1\n"), std::string::npos)
      << text;
}

TEST(JobFolder, RefusesAFolderThatCannotBe) {
  const Problem problem = loaded_slider_crank();
  EXPECT_THROW(JobFolder("/dev/null/job", problem), InputError);
}

}  // namespace
}  // namespace codesign::cli
