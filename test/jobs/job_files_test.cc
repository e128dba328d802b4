// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <fstream>
#include <set>

#include "description/study.h"
#include "edited_text.h"
#include "jobs/files.h"
#include "jobs/job_files.h"
#include "mechanism_codesign/error.h"
#include "paths.h"
#include "problem/load_problem.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

Inputs slider_crank() {
  Inputs inputs;
  inputs.urdf = read_source(source_dir() + "/urdf/slider_crank_haug.urdf");
  return inputs;
}

TEST(Inputs, WithoutAStudyAreTheMechanismAlone) {
  const Problem problem = load(slider_crank());
  EXPECT_TRUE(study_of(problem).tuned.empty());
  EXPECT_EQ(problem.duration(), 0.0);
}

TEST(Inputs, WithAStudyAreTheWholeProblem) {
  Inputs inputs = slider_crank();
  inputs.study = read_source(source_dir() + "/config/slider_crank_haug.yaml");
  const Problem problem = load(inputs);
  ASSERT_FALSE(study_of(problem).tuned.empty());
  inputs.settings = {{problem.tuned_names().front(), problem.start()[0] * 1.01}};
  EXPECT_EQ(load(inputs).start()[0], problem.start()[0] * 1.01);
  inputs.settings = {{"none_of_these", 1.0}};
  EXPECT_THROW(load(inputs), InputError);
}

class Names : public testing::Test {
 protected:
  std::string folder() const { return directory_.path().string(); }
  bool is_there(const std::string& path) const { return std::filesystem::exists(path); }

  /// Creates files with these suffixes as left by a killed job; returns their stem.
  std::string killed_job(const std::vector<std::string>& suffixes) const {
    const pid_t child = fork();
    if (child == 0) {
      const JobFiles job(folder(), "killed");
      for (const std::string& suffix : suffixes) std::ofstream(job.stem() + suffix) << "x";
      raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      if (entry.path().extension() == ".job")
        return (entry.path().parent_path() / entry.path().stem()).string();
    return "";
  }

  void expect_refusal(const std::string& name, const std::string& message) const {
    try {
      JobFiles::resume(folder(), name);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().element, "resume");
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }

  TemporaryDirectory directory_;
};

TEST_F(Names, TellTheRobotAndTheTimeInAFolderTheyMake) {
  const JobFiles job(folder() + "/a/b", "slider_crank");
  EXPECT_TRUE(
      is_match(job.bag(), folder() + R"(/a/b/slider_crank_\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d\.bag)"))
      << job.bag();
}

TEST_F(Names, CannotLeadOutOfTheFolder) {
  EXPECT_EQ(std::filesystem::path(JobFiles(folder(), "../../etc/evil robot").bag()).parent_path(),
            directory_.path());
  EXPECT_EQ(std::filesystem::path(JobFiles(folder(), "").bag()).filename().string().substr(0, 6),
            "robot_");
}

TEST_F(Names, OfAnyLengthAreShortEnoughForEveryFileOfTheJob) {
  for (const std::size_t length : {200U, 230U, 255U, 100000U}) {
    const JobFiles job(folder(), std::string(length, 'r'));
    std::ofstream longest(job.stem() + "-99999.best.json.part");
    EXPECT_TRUE(longest.good()) << length;
  }
}

TEST_F(Names, OfManyJobsInOneSecondDiffer) {
  std::set<std::string> bags;
  std::vector<JobFiles> running;
  for (int k = 0; k < 50; ++k) {
    running.emplace_back(folder(), "r");
    bags.insert(running.back().bag());
  }
  EXPECT_EQ(bags.size(), 50U);
}

TEST_F(Names, OfJobsThatFollowEachOtherDoNotMeetWhatIsThere) {
  std::set<std::string> stems;
  for (const std::string suffix :
       {".bag", ".bag.active", ".best.json", ".best.urdf", ".journal.jsonl"}) {
    const JobFiles job(folder(), "r");
    EXPECT_TRUE(stems.insert(job.stem()).second) << suffix;
    std::ofstream(job.stem() + suffix) << "x";
  }
}

TEST_F(Names, AFolderThatCannotBeMadeIsAnOutputError) {
  EXPECT_THROW(JobFiles("/dev/null/bags", "r"), OutputError);
}

TEST_F(Names, LeftoversOfKilledJobsGoAndAreSaid) {
  const std::string stem =
      killed_job({".bag.active", ".best.json", ".best.urdf", ".best.json.part"});
  const std::vector<std::string> said = remove_leftovers(folder());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("removed " + stem + ".bag.active"), std::string::npos) << said[0];
  EXPECT_NE(said[0].find(stem + ".best.json"), std::string::npos) << said[0];
  for (const char* gone : {".bag.active", ".best.json.part", ".job"})
    EXPECT_FALSE(is_there(stem + gone)) << gone;
  for (const char* kept : {".best.json", ".best.urdf"}) EXPECT_TRUE(is_there(stem + kept)) << kept;
  EXPECT_TRUE(remove_leftovers(folder()).empty());
}

TEST_F(Names, OfAKilledJobAreTakenOverByTheOneThatGoesOnWithIt) {
  const std::string stem = killed_job({".bag.active", ".best.json", ".journal.jsonl"});
  const std::string name = std::filesystem::path(stem).filename();
  {
    const JobFiles job = JobFiles::resume(folder(), name);
    EXPECT_EQ(job.stem(), stem);
    EXPECT_EQ(job.name(), name);
    EXPECT_EQ(job.bag(), stem + ".bag");
    EXPECT_EQ(job.journal(), stem + ".journal.jsonl");
    EXPECT_TRUE(is_there(stem + ".job"));
    EXPECT_FALSE(is_there(stem + ".bag.active"));
    EXPECT_TRUE(is_there(job.journal()));
    EXPECT_THROW(JobFiles::resume(folder(), name), JobIsRunning);
    EXPECT_TRUE(is_there(stem + ".job")) << "still locked";
    EXPECT_TRUE(remove_leftovers(folder()).empty());
  }
  EXPECT_FALSE(is_there(stem + ".job"));
}

TEST_F(Names, ANodeThatStartsSaysHowAKilledJobIsResumed) {
  const std::string stem = killed_job({".bag.active", ".journal.jsonl"});
  const std::vector<std::string> said = remove_leftovers(folder());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("resume: " + std::filesystem::path(stem).filename().string() + " goes on"),
            std::string::npos)
      << said[0];
  EXPECT_TRUE(is_there(stem + ".journal.jsonl"));
}

TEST_F(Names, TheBagOfAResumedJobReplacesNone) {
  const std::string stem = folder() + "/arm_2026-01-01-00-00-00";
  std::ofstream(stem + ".journal.jsonl") << "x";
  for (const std::string next : {".bag", ".resumed.bag", ".resumed-2.bag", ".resumed-3.bag"}) {
    const std::string bag = JobFiles::resume(folder(), "arm_2026-01-01-00-00-00").bag();
    EXPECT_EQ(bag, stem + next);
    std::ofstream(bag) << "x";
  }
}

TEST_F(Names, ToResumeAreBareNamesOfJobsInTheFolder) {
  std::ofstream(folder() + "/there.journal.jsonl") << "x";
  std::ofstream(folder() + "/done.bag") << "x";
  std::filesystem::create_directory(folder() + "/below");
  std::ofstream(folder() + "/below/there.journal.jsonl") << "x";
  std::filesystem::create_symlink(folder() + "/below/there.journal.jsonl",
                                  folder() + "/link.journal.jsonl");
  for (const std::string& name :
       {std::string("below/there"), std::string("./there"), std::string("/etc/passwd"),
        std::string(".."), std::string("there.journal.jsonl"), std::string("there\0", 6),
        std::string(256, 'a')})
    expect_refusal(name, "not the name of a job");
  expect_refusal("where", "there is no journal " + folder() + "/where.journal.jsonl");
  expect_refusal("link", "there is no journal");
  expect_refusal("done", "the job is complete, its bag is " + folder() + "/done.bag");
  EXPECT_FALSE(is_there(folder() + "/where.job")) << "a refusal leaves nothing";
  EXPECT_EQ(JobFiles::resume(folder(), "there").name(), "there");
}

TEST_F(Names, FilesOfLivingJobsAndOfOtherProgramsStay) {
  const JobFiles living(folder(), "living");
  std::ofstream(living.stem() + ".bag.active") << "x";
  std::ofstream(folder() + "/recorded_2026-11-22-06-00-00.bag.active")
      << "rosbag record is writing this";
  EXPECT_TRUE(remove_leftovers(folder()).empty());
  EXPECT_TRUE(is_there(living.stem() + ".bag.active"));
  EXPECT_TRUE(is_there(folder() + "/recorded_2026-11-22-06-00-00.bag.active"));
  EXPECT_TRUE(remove_leftovers("/nonexistent").empty());
}

}  // namespace

}  // namespace codesign
