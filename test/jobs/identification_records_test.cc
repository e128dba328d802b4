// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "identification/identify.h"
#include "identification/swinging_arm.h"
#include "jobs/identification_records.h"
#include "jobs/json.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

TEST(IdentificationFiles, TextsOfOneResult) {
  const Problem problem = swinging_problem();
  StudyRecordings recordings;
  recordings.data = {SwingingRig().record("identify.data[0]")};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok());
  const std::string json = to_text(identification_json(problem, result));
  const std::vector<IdentificationFile> files = identification_files(problem, result, json);
  ASSERT_EQ(files.size(), 5U);
  EXPECT_EQ(files[0].name, "identification.json");
  EXPECT_EQ(files[0].text(), json);
  EXPECT_EQ(files[1].name, "identified_overlay.urdf");
  EXPECT_EQ(files[2].name, "identified.urdf");
  EXPECT_EQ(read_urdf({"identified", files[2].text()}).parameters[1].value, result.numbers[1].value);
  EXPECT_EQ(files[3].name, "residuals.csv");
  EXPECT_EQ(files[3].text().substr(0, 50).find("set,recording,time,hinge/recorded,hinge/computed\n"), 0U);
  EXPECT_EQ(files[4].name, "job_study.yaml");
  EXPECT_EQ(files[4].text(), swinging_study());

  const IdentificationShow show = identification_show(problem, result, json, compare_motion(problem, recordings, result, kShownRate));
  EXPECT_EQ(show.study, swinging_study());
  EXPECT_EQ(show.joints, std::vector<std::string>{"hinge"});
  EXPECT_EQ(show.urdf, files[2].text());
  EXPECT_EQ(show.data.times.size(), static_cast<std::size_t>(result.samples));
  EXPECT_EQ(show.motion.recordings.size(), 1U);
}

}  // namespace

}  // namespace codesign
