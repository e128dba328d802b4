// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// codesign optimize under mpirun: the same results, ranks that are killed, wrong use.
#include "mpi/run_on_ranks.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "child_process.h"
#include "cli/resumable.h"

namespace codesign::cli {
namespace {

class RunOnRanks : public testing::Test {
 protected:
  void SetUp() override {
    if (mpirun_executable().empty())
      GTEST_SKIP() << "there is no mpirun: install openmpi-bin and libopenmpi-dev, and build again";
    // In a container everybody is root, and there may be fewer processors than ranks. The last one
    // is Open MPI 5's word for that.
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe"})
      setenv(name, "1", 1);
    setenv("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe", 1);
    // [s] After the loss of a rank the others have so long to end; by default one second, in which
    // a busy machine may not write the results.
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "4", 1);
  }
  static std::vector<std::string> on_ranks(int ranks, std::vector<std::string> words) {
    std::vector<std::string> all = {mpirun_executable(), "-n", std::to_string(ranks)};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  std::vector<std::string> job(const std::string& study, const std::string& option,
                               const std::string& folder) const {
    return {codesign_executable(), "optimize", kModel, study, option, folder_.path(folder)};
  }
  std::string in(const std::string& folder, const std::string& name) const {
    return folder_.path(folder + "/" + name);
  }
  bool is_open_mpi_5() const {
    ChildProcess({mpirun_executable(), "--version"}, folder_.path("version"), "/dev/null").wait();
    return read_text_file(folder_.path("version")).find("(Open MPI) 5.") != std::string::npos;
  }
  /// mpirun of Open MPI 5.0.7 crashes whenever it starts two programs, whichever they are.
  bool can_start_two_programs() const {
    const std::vector<std::string> words = {
        mpirun_executable(), "-n", "1", "true", ":", "-n", "1", "true"};
    return ChildProcess(words, "/dev/null", "/dev/null").wait() == 0;
  }
  int run_job(const std::vector<std::string>& words) const {
    return ChildProcess(words, folder_.path("out"), folder_.path("err")).wait();
  }
  std::string err() const { return read_text_file(folder_.path("err")); }

  void expect_same_results(const std::string& folder, const std::string& expected) const {
    // Not as EXPECT_EQ, which would print both.
    EXPECT_TRUE(evaluations_of(in(folder, "journal.jsonl")) ==
                evaluations_of(in(expected, "journal.jsonl")))
        << folder;
    EXPECT_EQ(without_times(Json::parse(read_text_file(in(folder, "result.json")))),
              without_times(Json::parse(read_text_file(in(expected, "result.json")))))
        << folder;
    for (const char* name : {"tuned.urdf", "tuned.csv", "starts.csv", "scenarios.csv"})
      EXPECT_EQ(read_text_file(in(folder, name)), read_text_file(in(expected, name)))
          << folder << " " << name;
  }

  /// A file about a process; empty if the process ends meanwhile.
  static std::string told_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    try {
      return {std::istreambuf_iterator<char>(file), {}};
    } catch (const std::exception&) {
      return "";
    }
  }

  /// The process of a rank of the job that writes into a folder; 0 if it is not there (yet).
  static pid_t process_of(int rank, const std::string& folder) {
    const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const std::string words = told_of(entry.path() / "cmdline"),
                        variables = told_of(entry.path() / "environ");
      if (words.find(folder) != std::string::npos &&
          variables.find(wanted + '\0') != std::string::npos)
        return std::stoi(name);
    }
    return 0;
  }

  ScratchFolder folder_;
};

TEST_F(RunOnRanks, ThreadsAndRanksGiveTheSameResults) {
  const auto study = [this](const std::string& engine) {
    return resumable_study(folder_, "engine: {" + engine + "}\n");
  };
  ASSERT_EQ(run_job(job(study("type: serial"), "--output", "serial")), kDone) << err();
  for (const int threads : {1, 2}) {
    const std::string folder = std::to_string(threads) + "_threads";
    ASSERT_EQ(run_job(job(study("type: threads, workers: " + std::to_string(threads)), "--output",
                          folder)),
              kDone)
        << err();
    expect_same_results(folder, "serial");
  }
  for (const int ranks : {2, 3, 4}) {
    const std::string folder = std::to_string(ranks) + "_ranks";
    ASSERT_EQ(run_job(on_ranks(ranks, job(study("type: mpi"), "--output", folder))), kDone)
        << err();
    expect_same_results(folder, "serial");
  }
  ASSERT_EQ(run_job(job(study("type: mpi"), "--output", "alone")), kDone)
      << "mpi without mpirun is one process: " << err();
  expect_same_results("alone", "serial");
}

TEST_F(RunOnRanks, OnlyRankZeroNeedsTheFiles) {
  if (!can_start_two_programs()) GTEST_SKIP() << "this mpirun cannot start two programs";
  const std::string study = resumable_study(folder_, "");
  ASSERT_EQ(run_job(job(study, "--output", "here")), kDone) << err();
  std::vector<std::string> words = on_ranks(1, job(study, "--output", "there"));
  words.insert(words.end(),
               {":", "-n", "2", codesign_executable(), "optimize", "nowhere.urdf", "nothing.yaml"});
  ASSERT_EQ(run_job(words), kDone) << err();
  expect_same_results("there", "here");
}

TEST_F(RunOnRanks, GradientsOfEnsemblesAreTheSame) {
  const std::string study = resumable_study(folder_, "");
  const std::vector<std::string> words = {codesign_executable(), "gradient", kModel, study,
                                          "--json"};
  ASSERT_EQ(run_job(words), kDone) << err();
  const Json alone = without_times(Json::parse(read_text_file(folder_.path("out"))));
  ASSERT_EQ(
      ChildProcess(on_ranks(3, words), folder_.path("out_of_ranks"), folder_.path("err")).wait(),
      kDone)
      << err();
  EXPECT_EQ(without_times(Json::parse(read_text_file(folder_.path("out_of_ranks")))), alone);
}

TEST_F(RunOnRanks, KilledRanksEndTheJobAndNothingIsLostOrComputedTwice) {
  if (is_open_mpi_5())
    GTEST_SKIP() << "mpirun of Open MPI 5 kills the other ranks within half a second, before rank "
                    "0 can keep its results";
  const std::string study = resumable_study(folder_, "");
  ASSERT_EQ(run_job(job(study, "--output", "whole")), kDone) << err();
  const std::size_t all = finished_lines(in("whole", "journal.jsonl")).size();
  const std::string journal = in("killed", "journal.jsonl");
  std::mt19937 random(11);
  std::vector<std::string> before;
  int told = 0;
  for (int kills = 0; kills < 6; ++kills) {
    const int rank = kills % 3;
    {
      std::filesystem::remove(folder_.path("err"));
      ChildProcess process(
          on_ranks(
              3, job(study, std::filesystem::exists(journal) ? "--resume" : "--output", "killed")),
          "/dev/null", folder_.path("err"));
      const std::size_t more = before.size() + 1 + random() % (all / 16);
      ASSERT_TRUE(comes_true([&] {
        return finished_lines(journal).size() >= more &&
               process_of(rank, folder_.path("killed")) > 0;
      }));
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 5000));
      kill(process_of(rank, folder_.path("killed")), SIGKILL);
      EXPECT_NE(process.wait(), kDone);
      ASSERT_TRUE(comes_true([&] {
        return process_of(1, folder_.path("killed")) == 0 &&
               process_of(0, folder_.path("killed")) == 0;
      }));
    }
    const std::vector<std::string> now = finished_lines(journal);
    ASSERT_GE(now.size(), before.size()) << kills;
    for (std::size_t k = 0; k < before.size(); ++k) ASSERT_EQ(now[k], before[k]) << kills;
    before = now;
    ASSERT_LT(before.size(), all) << "it has ended before it was killed";
    if (rank == 0) continue;
    // Rank 0 misses a rank, keeps its results and reports the loss.
    // Its message is read from the result: mpirun may cut off what a rank prints at the end.
    const Json result = Json::parse(read_text_file(in("killed", "result.json")));
    const std::string message = result["error"]["message"];
    EXPECT_NE(message.find("rank " + std::to_string(rank) + " of 3 on host "), std::string::npos)
        << message;
    EXPECT_EQ(result["error"]["code"], "worker_lost");
    EXPECT_EQ(result["termination"], "worker_lost");
    ++told;
  }
  EXPECT_EQ(told, 4);
  ASSERT_EQ(run_job(on_ranks(2, job(study, "--resume", "killed"))), kDone) << err();
  expect_same_results("killed", "whole");
}

TEST_F(RunOnRanks, AnInterruptKeepsTheBestAndGoesOn) {
  const std::string study = resumable_study(folder_, "");
  ASSERT_EQ(run_job(job(study, "--output", "whole")), kDone) << err();
  {
    ChildProcess process(on_ranks(3, job(study, "--output", "job")), "/dev/null",
                         folder_.path("err"));
    ASSERT_TRUE(comes_true([&] { return finished_lines(in("job", "journal.jsonl")).size() > 20; }));
    // To rank 0, as Ctrl-C does where mpirun passes it on.
    kill(process_of(0, folder_.path("job")), SIGINT);
    process.wait();
  }
  EXPECT_EQ(Json::parse(read_text_file(in("job", "result.json")))["error"]["code"], "cancelled")
      << err();
  ASSERT_EQ(run_job(on_ranks(3, job(study, "--resume", "job"))), kDone) << err();
  expect_same_results("job", "whole");
}

TEST_F(RunOnRanks, AnEngineOfOneProcessIsRefusedOnce) {
  const std::string study = resumable_study(folder_, "engine: {type: threads}\n");
  EXPECT_EQ(run_job(on_ranks(3, job(study, "--output", "job"))), kBadInput);
  const std::string text = err(),
                    sentence =
                        "mpirun has started 3 processes, and the study asks for an engine of one";
  EXPECT_NE(text.find("engine.type: " + sentence), std::string::npos) << text;
  EXPECT_EQ(text.find(sentence), text.rfind(sentence)) << "each rank says it: " << text;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("job")));
}

TEST_F(RunOnRanks, AStudyWithOneEvaluationAtATimeSaysSo) {
  EXPECT_EQ(run_job(on_ranks(2, job(short_study(folder_), "--output", "job"))), kDone) << err();
  EXPECT_NE(err().find("of the 2 processes that mpirun has started, one computes"),
            std::string::npos)
      << err();
}

TEST(RunOnRanksAlone, AProgramWithoutMpirunIsOneProcess) {
  EXPECT_EQ(run_on_ranks("test", [](Dispatcher*) { return 7; }), 7);
}

}  // namespace
}  // namespace codesign::cli
