// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <sstream>

#include "cli/run_fixture.h"
#include "identification/swinging_arm.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

class IdentifyCommand : public testing::Test {
 protected:
  IdentifyCommand() {
    std::ofstream(folder_.path("arm.urdf")) << kSwingingArm;
    std::ofstream(folder_.path("data.csv")) << SwingingRig().table();
    write_study("");
  }
  void write_study(const std::string& more) const {
    std::ofstream(folder_.path("study.yaml")) << swinging_study("{csv: data.csv}", more);
  }
  std::vector<std::string> words() const {
    return {"identify", folder_.path("arm.urdf"), folder_.path("study.yaml"), "--output",
            folder_.path("job")};
  }
  bool has(const std::string& name) const {
    return std::filesystem::exists(folder_.path("job/" + name));
  }

  /// Runs the command with a writer of bags; cancelled once the error stream shows that many lines
  /// of evaluations.
  Outcome run_until(int evaluations) {
    struct CountingBuffer : std::stringbuf {
      std::atomic<bool>* cancel;
      int left;
      int sync() override {
        const std::string text = str();
        int seen = 0;
        for (std::size_t at = text.find("evaluation "); at != std::string::npos;
             at = text.find("evaluation ", at + 1))
          ++seen;
        if (seen >= left) *cancel = true;
        return 0;
      }
    } buffer;
    std::atomic<bool> cancel{false};
    buffer.cancel = &cancel;
    buffer.left = evaluations;
    std::ostream err(&buffer);
    std::ostringstream out;
    const auto write = [this](const std::string& path, const IdentificationShow& show) {
      bag_path_ = path;
      frames_ = show.motion.recordings.at(0).model.size();
    };
    Outcome outcome;
    outcome.code = run(words(), {out, err, cancel, nullptr, nullptr, {}, write});
    outcome.out = out.str();
    outcome.err = buffer.str();
    return outcome;
  }

  ScratchFolder folder_;
  std::string bag_path_;
  std::size_t frames_ = 0;
};

TEST_F(IdentifyCommand, WritesItsFilesAndTheBag) {
  const Outcome outcome = run_until(1000);
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  for (const char* name :
       {"identification.json", "identified.urdf", "residuals.csv", "job_study.yaml"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_EQ(bag_path_, folder_.path("job/identification.bag"));
  EXPECT_EQ(frames_, 249U);
  const Json json = Json::parse(read_text_file(folder_.path("job/identification.json")));
  EXPECT_NEAR(json["identified"]["inertia"]["value"].get<double>(), 0.3, 1e-3);
  const std::string rows = read_text_file(folder_.path("job/residuals.csv"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 994);
}

TEST_F(IdentifyCommand, InterruptedItKeepsTheBestPoint) {
  const Outcome outcome = run_until(2);
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_NE(outcome.err.find("cancelled"), std::string::npos) << outcome.err;
  for (const char* name : {"identification.json", "identified.urdf", "residuals.csv"})
    EXPECT_TRUE(has(name)) << name;
  const Json json = Json::parse(read_text_file(folder_.path("job/identification.json")));
  EXPECT_EQ(json["termination"], "cancelled");
  EXPECT_EQ(json["error"]["code"], "cancelled");
  EXPECT_GT(json["identified"]["inertia"]["deviation"].get<double>(), 0.0);
  EXPECT_EQ(frames_, 249U) << "the bag is whole: a second interrupt ends the program";
}

TEST_F(IdentifyCommand, ProfilesAreTold) {
  write_study("  intervals: {profiles: true}\n");
  const Outcome outcome = run_until(1000);
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.err.find("profile 1 of 2\nprofile 2 of 2\n"), std::string::npos) << outcome.err;
}

TEST_F(IdentifyCommand, AResultDoesNotReplaceItsStudy) {
  std::filesystem::create_directory(folder_.path("job"));
  std::filesystem::rename(folder_.path("study.yaml"), folder_.path("job/job_study.yaml"));
  const Outcome outcome = run_words({"identify", words().at(1), folder_.path("job/job_study.yaml"),
                                     "--output", folder_.path("job")});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("job_study.yaml would replace this file"), std::string::npos)
      << outcome.err;
}

TEST_F(IdentifyCommand, WithoutABagWriterThereIsNoBag) {
  const Outcome outcome = run_words(words());
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_TRUE(has("residuals.csv"));
  EXPECT_FALSE(has("identification.bag"));
}

TEST_F(IdentifyCommand, JudgesAModelAsItStandsAndAgainstAnother) {
  std::vector<std::string> judge = words();
  judge.emplace_back("--evaluate");
  const Outcome judged = run_words(judge);
  EXPECT_EQ(judged.code, kDone) << judged.err;
  EXPECT_EQ(judged.out.find("data, hinge: root mean square of the residuals 1.28"), 0U)
      << judged.out;
  EXPECT_EQ(judged.out.find("number "), std::string::npos) << judged.out;
  EXPECT_TRUE(has("identification.json"));
  EXPECT_FALSE(has("identified.urdf"));
  const Outcome fitted =
      run_words({"identify", words().at(1), words().at(2), "--against",
                 folder_.path("job/identification.json"), "--set", "viscous=0.2"});
  EXPECT_EQ(fitted.code, kDone) << fitted.err;
  EXPECT_NE(fitted.out.find("of the 2 further numbers here"), std::string::npos) << fitted.out;
  const Outcome wrong = run_words(
      {"identify", words().at(1), words().at(2), "--against", folder_.path("study.yaml")});
  EXPECT_EQ(wrong.code, kBadInput);
  EXPECT_NE(wrong.err.find("study.yaml: identification: not JSON"), std::string::npos) << wrong.err;
}

TEST_F(IdentifyCommand, AStudyWithoutRecordingsIsBadInput) {
  std::ofstream(folder_.path("study.yaml")) << "duration: 1.0\n";
  const Outcome outcome = run_words(words());
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_NE(outcome.err.find("a block identify"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace codesign::cli
