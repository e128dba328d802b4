// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// codesign optimize --resume: killed, cancelled, refused.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "child_process.h"
#include "cli/resumable.h"
#include "jobs/json.h"

namespace codesign::cli {
namespace {

class Resume : public testing::Test {
 protected:
  std::vector<std::string> job(const std::string& option, const std::string& folder) const {
    return {codesign_executable(), "optimize", kModel, study_, option, folder_.path(folder)};
  }
  std::string in(const std::string& folder, const std::string& name) const {
    return folder_.path(folder + "/" + name);
  }

  ScratchFolder folder_;
  std::string study_ = resumable_study(folder_, "engine: {workers: 2}\n");
};

TEST_F(Resume, KilledTwentyTimesNothingIsLostOrComputedTwice) {
  ASSERT_EQ(ChildProcess(job("--output", "whole")).wait(), kDone);
  const std::size_t all = finished_lines(in("whole", "journal.jsonl")).size();
  ASSERT_GT(all, 60u);
  std::mt19937 random(7);
  std::vector<std::string> before;
  const std::string journal = in("killed", "journal.jsonl");
  for (int kills = 0; kills < 20; ++kills) {
    {
      ChildProcess process(
          job(std::filesystem::exists(journal) ? "--resume" : "--output", "killed"));
      // Every second time while it starts, else after some more evaluations.
      const bool starts = kills % 2 == 0;
      const std::size_t more = starts ? 0 : before.size() + 1 + random() % (all / 30);
      const auto grown = [&] { return finished_lines(journal).size() >= more; };
      ASSERT_TRUE(comes_true(grown));
      std::this_thread::sleep_for(std::chrono::microseconds(random() % (starts ? 40000 : 4000)));
      process.send(SIGKILL);
      process.wait();
    }
    const std::vector<std::string> now = finished_lines(journal);
    ASSERT_GE(now.size(), before.size()) << kills;
    for (std::size_t k = 0; k < before.size(); ++k) ASSERT_EQ(now[k], before[k]) << kills;
    before = now;
    if (before.size() < all || kills == 19) continue;
    // It has ended before it was killed, and begins anew.
    std::filesystem::remove_all(folder_.path("killed"));
    before.clear();
  }
  ASSERT_EQ(ChildProcess(job("--resume", "killed")).wait(), kDone);
  EXPECT_TRUE(evaluations_of(journal) == evaluations_of(in("whole", "journal.jsonl")))
      << "not as EXPECT_EQ, which would print both";
  EXPECT_EQ(without_times(Json::parse(read_text_file(in("killed", "result.json")))),
            without_times(Json::parse(read_text_file(in("whole", "result.json")))));
  for (const char* name : {"tuned.urdf", "tuned.csv", "starts.csv", "scenarios.csv"})
    EXPECT_EQ(read_text_file(in("killed", name)), read_text_file(in("whole", name))) << name;
}

TEST_F(Resume, EventsAndEndsOfRunsAreThoseOfTheWholeJob) {
  study_ = resumable_study(
      folder_,
      "engine: {workers: 2}\nuntil: \"${crank_joint/position < -0.8}\"\n"
      "loads: [{joint: crank_joint, effort: \"${crank_joint/position < -0.4 ? 0.5 : 0.0}\"}]\n");
  ASSERT_EQ(ChildProcess(job("--output", "whole")).wait(), kDone);
  const std::size_t all = finished_lines(in("whole", "journal.jsonl")).size();
  const std::string journal = in("killed", "journal.jsonl");
  for (const std::size_t share : {4U, 2U}) {
    ChildProcess process(job(share == 4U ? "--output" : "--resume", "killed"));
    ASSERT_TRUE(comes_true([&] { return finished_lines(journal).size() >= all / share; }));
    process.send(SIGKILL);
    process.wait();
  }
  ASSERT_EQ(ChildProcess(job("--resume", "killed")).wait(), kDone);
  const Json whole = Json::parse(read_text_file(in("whole", "result.json")));
  EXPECT_GT(whole["event_count"], 0);
  EXPECT_EQ(without_times(Json::parse(read_text_file(in("killed", "result.json")))),
            without_times(whole));
  EXPECT_TRUE(evaluations_of(journal) == evaluations_of(in("whole", "journal.jsonl")));
}

TEST_F(Resume, AFinishedJobIsAnsweredFromItsJournal) {
  study_ = short_study(folder_);
  ASSERT_EQ(ChildProcess(job("--output", "job")).wait(), kDone);
  const std::string result = read_text_file(in("job", "result.json")),
                    journal = read_text_file(in("job", "journal.jsonl"));
  std::filesystem::remove(in("job", "result.json"));
  const Outcome outcome = run_words({"optimize", kModel, study_, "--resume", folder_.path("job")});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.err.find("4 finished evaluations"), std::string::npos) << outcome.err;
  Json again = Json::parse(read_text_file(in("job", "result.json"))), first = Json::parse(result);
  EXPECT_EQ(again["cpu_seconds"], first["cpu_seconds"]) << "of the evaluations, which are the same";
  EXPECT_EQ(without_times(again), without_times(first));
  EXPECT_EQ(read_text_file(in("job", "journal.jsonl")), journal);
}

TEST_F(Resume, AnotherJobAndAnEmptyFolderAreRefusedAndLoseNothing) {
  study_ = short_study(folder_);
  ASSERT_EQ(ChildProcess(job("--output", "job")).wait(), kDone);
  const std::string result = read_text_file(in("job", "result.json"));
  const Outcome other =
      run_words({"optimize", kModel, study_, "--set", "Kp=2", "--resume", folder_.path("job")});
  EXPECT_EQ(other.code, kBadInput);
  EXPECT_NE(other.err.find("journal.jsonl:1: the values of the parameters at the start (--set, "
                           "~set or a request's start) differ"),
            std::string::npos)
      << other.err;
  EXPECT_EQ(read_text_file(in("job", "result.json")), result);
  const Outcome none = run_words({"optimize", kModel, study_, "--resume", folder_.path("none")});
  EXPECT_EQ(none.code, kBadInput);
  EXPECT_NE(none.err.find("there is no journal to resume"), std::string::npos) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("none")));
}

TEST_F(Resume, DamagedLinesAreNamedAndComputedAgain) {
  study_ = short_study(folder_);
  ASSERT_EQ(ChildProcess(job("--output", "job")).wait(), kDone);
  const std::string result = read_text_file(in("job", "result.json"));
  std::vector<std::string> lines = finished_lines(in("job", "journal.jsonl"));
  ASSERT_EQ(lines.size(), 5u);
  const std::size_t gradient = lines[2].find("\"gradient\":[") + 12;
  lines[2].erase(gradient, lines[2].find(']', gradient) - gradient);
  lines[3][lines[3].find("\"objective\":") + 14] ^= 1;
  std::ofstream journal(in("job", "journal.jsonl"));
  for (const std::string& line : lines) journal << line << '\n';
  journal.close();
  const Outcome outcome =
      run_words({"optimize", kModel, study_, "--json", "--resume", folder_.path("job")});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_NE(outcome.err.find("2 finished evaluations"), std::string::npos) << outcome.err;
  const Json object = json_of(outcome), first = Json::parse(result);
  bool is_named = false;
  for (const Json& warning : object["warnings"])
    is_named |= warning["code"] == "journal_damaged" &&
                warning["message"].get<std::string>().find(
                    "line 3 is damaged: its checksum is not that of its text; damaged, too: 4") !=
                    std::string::npos;
  EXPECT_TRUE(is_named) << outcome.err;
  EXPECT_EQ(object["objective"], first["objective"]);
  EXPECT_EQ(object["gradient"], first["gradient"]);
  EXPECT_EQ(object["evaluations"], first["evaluations"]);
}

TEST_F(Resume, WithoutItTheJournalIsSetAside) {
  study_ = short_study(folder_);
  ASSERT_EQ(ChildProcess(job("--output", "job")).wait(), kDone);
  const std::string journal = read_text_file(in("job", "journal.jsonl"));
  const Outcome outcome = run_words({"optimize", kModel, study_, "--output", folder_.path("job")});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_NE(outcome.err.find("previous_journal.jsonl"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_text_file(in("job", "previous_journal.jsonl")), journal);
}

TEST_F(Resume, AFullDiskLeavesAJournalThatCanBeResumed) {
  study_ = folder_.edited("longer.yaml", read_text_file(short_study(folder_)), "max_evaluations: 4",
                          "max_evaluations: 14");
  // The journal grows by 400 bytes with each evaluation, the messages by a quarter of that.
  ChildProcess process(job("--output", "job"), "/dev/null", folder_.path("err"), 4000);
  EXPECT_EQ(process.wait(), kFailed);
  const std::string err = read_text_file(folder_.path("err"));
  EXPECT_NE(err.find("journal.jsonl: cannot be written: File too large"), std::string::npos) << err;
  const Outcome outcome = run_words({"optimize", kModel, study_, "--resume", folder_.path("job")});
  EXPECT_EQ(outcome.code, kDone) << outcome.err;
  // The header, the evaluations, and at an optimum one more for its flat directions.
  const std::size_t evaluations =
      Json::parse(read_text_file(in("job", "result.json")))["evaluations"].get<std::size_t>();
  const std::size_t lines = finished_lines(in("job", "journal.jsonl")).size();
  EXPECT_TRUE(lines == 1 + evaluations || lines == 2 + evaluations)
      << lines << " lines, " << evaluations << " evaluations";
}

}  // namespace
}  // namespace codesign::cli
