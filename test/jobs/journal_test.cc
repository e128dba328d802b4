// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "ensemble/ensemble_fixture.h"
#include "jobs/edited_line.h"
#include "jobs/json.h"
#include "problem/load_problem.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

class JournalTest : public testing::Test {
 protected:
  Journal open(Journal::Mode mode) const {
    return {path(), problem_, problem_.optimizer_options(), mode};
  }
  std::string path() const { return (folder_.path() / "journal.jsonl").string(); }
  EvaluationTask task(double kp, bool with_gradient = false) const {
    return {system_of(problem_), problem_.parameters(Eigen::Vector2d(kp, 3.0)),
            gradient_if(with_gradient)};
  }
  static Evaluation value(double objective) {
    Evaluation evaluation;
    evaluation.objective = objective;
    evaluation.gradient = Eigen::Vector2d(objective, -objective);
    return evaluation;
  }
  /// A journal of two evaluations: 1 with objective 10, and 2 with a gradient and objective 20.
  void write_two() const {
    Journal journal = open(Journal::Mode::kNew);
    journal.keep(task(1.0), value(10.0));
    journal.keep(task(2.0, true), value(20.0));
    EXPECT_EQ(journal.failure(), "");
  }
  std::string text() const {
    std::ostringstream text;
    text << std::ifstream(path()).rdbuf();
    return text.str();
  }
  void write(const std::string& text) const { std::ofstream(path()) << text; }
  static std::size_t second_line_of(const std::string& text) { return text.find('\n') + 1; }
  /// The one damaged line is named with its reason when the journal is opened, and in a warning.
  void expect_damage(const std::string& reason) const {
    const Journal journal = open(Journal::Mode::kResume);
    ASSERT_EQ(journal.warnings().size(), 1u) << reason;
    const Warning warning = journal.warnings()[0];
    EXPECT_EQ(warning.code, "journal_damaged");
    EXPECT_NE(warning.message.find(path() + ":2: line 2 is damaged: "), std::string::npos)
        << warning.message;
    EXPECT_NE(warning.message.find(reason), std::string::npos) << warning.message;
    EXPECT_NE(warning.message.find("computed again"), std::string::npos) << warning.message;
    EXPECT_EQ(journal.notes().back(), warning.message);
  }
  void expect_refusal(const std::string& where, const std::string& message) const {
    try {
      open(Journal::Mode::kResume);
      ADD_FAILURE() << message;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path() + where), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }

  TemporaryDirectory folder_;
  const Problem problem_ = block("");
};

TEST_F(JournalTest, FindsWhatAnEarlierProcessKept) {
  write_two();
  Journal journal = open(Journal::Mode::kResume);
  EXPECT_EQ(journal.resumed(), 2u);
  ASSERT_EQ(journal.notes().size(), 1u);
  EXPECT_NE(journal.notes()[0].find("2 finished evaluations"), std::string::npos);
  ASSERT_TRUE(journal.find(task(1.0)));
  EXPECT_EQ(journal.find(task(1.0))->objective, 10.0);
  EXPECT_EQ(journal.find(task(2.0, true))->gradient, Eigen::Vector2d(20.0, -20.0));
  EXPECT_FALSE(journal.find(task(1.0, true))) << "its gradient is not known";
  EXPECT_FALSE(journal.find(task(1.0 + 1e-16 * 4))) << "other bits";
  EXPECT_FALSE(journal.find({system_of(block("")), task(1.0).parameters, Derivatives::kNone}))
      << "a system of another problem";
  journal.keep(task(3.0), value(30.0));
  EXPECT_EQ(journal.find(task(3.0))->objective, 30.0);
  EXPECT_EQ(open(Journal::Mode::kResume).resumed(), 3u);
}

TEST_F(JournalTest, KeepsTheRootOfWhatWasAskedForWithIt) {
  EvaluationTask asked = task(2.0);
  asked.derivatives = Derivatives::kGaussNewton;
  Evaluation evaluation = value(20.0);
  evaluation.jacobian_root = (Eigen::Matrix2d() << 0.1, 1.0 / 3.0, 0.0, 2.0).finished();
  write_two();
  open(Journal::Mode::kResume).keep(asked, evaluation);
  Journal journal = open(Journal::Mode::kResume);
  ASSERT_TRUE(journal.find(asked));
  EXPECT_EQ(journal.find(asked)->jacobian_root, evaluation.jacobian_root);
  EXPECT_EQ(journal.find(task(2.0, true))->jacobian_root.size(), 0)
      << "another line of the same design";
  asked.parameters = task(1.0).parameters;
  EXPECT_FALSE(journal.find(asked));
}

TEST_F(JournalTest, DropsAnUnfinishedLastLineAndSaysSo) {
  write_two();
  const std::string whole = text();
  const std::size_t second = whole.find('\n', whole.find('\n') + 1) + 1;
  for (const std::size_t size : {second + 1, second + 50, whole.size() - 1}) {
    write(whole.substr(0, size));
    Journal journal = open(Journal::Mode::kResume);
    EXPECT_EQ(journal.resumed(), 1u);
    EXPECT_NE(journal.notes().at(0).find("line 3"), std::string::npos) << journal.notes()[0];
    EXPECT_EQ(text(), whole.substr(0, second));
    journal.keep(task(2.0, true), value(20.0));
    EXPECT_EQ(text(), whole);
  }
}

TEST_F(JournalTest, BeginsAnewIfNotEvenTheFirstLineWasFinished) {
  write_two();
  const std::string header = text().substr(0, text().find('\n') + 1);
  for (const std::size_t size : {std::size_t{0}, std::size_t{20}, header.size() - 1}) {
    write(header.substr(0, size));
    EXPECT_EQ(open(Journal::Mode::kResume).resumed(), 0u);
    EXPECT_EQ(text(), header);
  }
}

TEST_F(JournalTest, LeavesDamagedLinesOutAndNamesThem) {
  write_two();
  const std::string whole = text();
  const std::size_t second = whole.find('\n') + 1, third = whole.find('\n', second) + 1;
  const std::string line = whole.substr(second, third - second - 1);
  std::string flipped = line;
  flipped[line.find("10.0")] = '3';
  const auto set = [&](const char* key, const Json& value) {
    return edited_line(line, [&](Json* object) { (*object)[key] = value; });
  };
  const std::pair<std::string, const char*> cases[] = {
      {std::string(1, '\0') + line.substr(1), "checksum"},
      {flipped, "checksum"},
      {line.substr(0, line.rfind(",\"checksum")) + "}", "checksum"},
      {"", "checksum"},
      {set("system", 7), "of another job"},
      {set("parameters", {1.0}), "of another job"},
      {set("objective", "inf"), "not finite"}};
  for (const auto& [damaged, reason] : cases) {
    write(whole.substr(0, second) + damaged + "\n" + whole.substr(third));
    expect_damage(reason);
    EXPECT_FALSE(open(Journal::Mode::kResume).find(task(1.0)));
    EXPECT_TRUE(open(Journal::Mode::kResume).find(task(2.0, true))) << "the other line counts";
  }
  Journal journal = open(Journal::Mode::kResume);
  journal.keep(task(1.0), value(10.0));
  EXPECT_EQ(open(Journal::Mode::kResume).find(task(1.0))->objective, 10.0);
}

TEST_F(JournalTest, LeavesOutGradientsOfAnotherLength) {
  write_two();
  const std::string whole = text();
  const std::size_t third = whole.rfind('\n', whole.size() - 2) + 1;
  for (const std::size_t count : {0, 1, 3, 100003}) {
    const auto resize = [count](Json* line) {
      (*line)["gradient"] = std::vector<double>(count, 1.0);
    };
    write(whole.substr(0, second_line_of(whole)) +
          edited_line(whole.substr(third, whole.size() - third - 1), resize) + "\n");
    expect_damage(std::to_string(count) + " numbers of the gradient instead of 2");
    EXPECT_FALSE(open(Journal::Mode::kResume).find(task(2.0, true)));
  }
}

TEST_F(JournalTest, LeavesOutExtremesOfAnotherNumber) {
  const auto more = [](Json* line) {
    (*line)["extremes"] = {{"values", {1.0}}, {"times", {0.0}}, {"gradients", Json::array()}};
  };
  write_two();
  const std::string whole = text();
  const std::size_t second = second_line_of(whole), third = whole.find('\n', second) + 1;
  write(whole.substr(0, second) + edited_line(whole.substr(second, third - second - 1), more) +
        "\n");
  expect_damage("1 numbers of the signals' extremes instead of 0");
}

TEST_F(JournalTest, UsesNeitherOfTwoLinesThatContradictEachOther) {
  write_two();
  {
    Journal journal = open(Journal::Mode::kResume);
    journal.keep(task(1.0), value(10.0));
    journal.keep(task(2.0, true), value(21.0));
  }
  const Journal journal = open(Journal::Mode::kResume);
  ASSERT_EQ(journal.warnings().size(), 1u);
  const std::string message = journal.warnings()[0].message;
  EXPECT_NE(message.find("line 3 is damaged: line 5 contradicts it; damaged, too: 5"),
            std::string::npos)
      << message;
  EXPECT_FALSE(open(Journal::Mode::kResume).find(task(2.0, true)));
  EXPECT_EQ(open(Journal::Mode::kResume).find(task(1.0))->objective, 10.0)
      << "said twice is no contradiction";
}

TEST_F(JournalTest, NamesAtMostTenDamagedLines) {
  write_two();
  write(text() + std::string(30, '\n'));
  const std::string message = open(Journal::Mode::kResume).warnings().at(0).message;
  EXPECT_NE(message.find("damaged, too: 5, 6, 7, 8, 9, 10, 11, 12, 13 and 20 more"),
            std::string::npos)
      << message;
}

TEST_F(JournalTest, RefusesAnotherJob) {
  expect_refusal("", "there is no journal to resume");
  write("a,b\n1,2\n");
  expect_refusal(":1", "this is not the journal of an optimization");
  const Problem other = block("multistart: {starts: 2}\n");
  std::filesystem::remove(path());
  Journal(path(), other, other.optimizer_options(), Journal::Mode::kNew);
  expect_refusal(":1", "the study differs");
}

TEST_F(JournalTest, ReplacesNoFile) {
  write_two();
  EXPECT_THROW(open(Journal::Mode::kNew), std::exception);
  EXPECT_THROW(
      Journal("/dev/null/journal", problem_, problem_.optimizer_options(), Journal::Mode::kNew),
      std::exception);
}

TEST_F(JournalTest, TellsVariantsOfTheSystemApart) {
  const Problem problem =
      block("runs: {a: {}, b: {controllers: {hold: {setpoint: 1.0}}}}\nrobust: {measure: mean}\n");
  const auto a = variant_of(problem, 0, -1), b = variant_of(problem, 1, -1);
  ASSERT_NE(a, b);
  {
    Journal journal(path(), problem, problem.optimizer_options(), Journal::Mode::kNew);
    journal.keep({b, problem.parameters(), Derivatives::kNone}, value(5.0));
  }
  Journal journal(path(), problem, problem.optimizer_options(), Journal::Mode::kResume);
  EXPECT_FALSE(journal.find({a, problem.parameters(), Derivatives::kNone}));
  EXPECT_TRUE(journal.find({b, problem.parameters(), Derivatives::kNone}));
}

}  // namespace
}  // namespace codesign
