// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "ensemble/ensemble_fixture.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

class JournalTest : public testing::Test {
 protected:
  Journal open(Journal::Mode mode) const { return {path(), problem_, problem_.optimizer_options(), mode}; }
  std::string path() const { return (folder_.path() / "journal.jsonl").string(); }
  EvaluationTask task(double kp, bool with_gradient = false) const {
    return {problem_.system(), problem_.parameters(Eigen::Vector2d(kp, 3.0)), gradient_if(with_gradient)};
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
  EXPECT_FALSE(journal.find({block("").system(), task(1.0).parameters, Derivatives::kNone})) << "a system of another problem";
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
  EXPECT_EQ(journal.find(task(2.0, true))->jacobian_root.size(), 0) << "another line of the same design";
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

TEST_F(JournalTest, RefusesDamageInTheMiddle) {
  write_two();
  const std::string whole = text();
  std::string damaged = whole;
  damaged[damaged.find('\n') + 3] = '\0';
  write(damaged);
  expect_refusal(":2", "the line is damaged");
  std::string foreign = whole;
  foreign.replace(foreign.find("\"system\":0"), 10, "\"system\":7");
  write(foreign);
  expect_refusal(":2", "of another job");
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
  EXPECT_THROW(Journal("/dev/null/journal", problem_, problem_.optimizer_options(), Journal::Mode::kNew), std::exception);
}

TEST_F(JournalTest, TellsVariantsOfTheSystemApart) {
  const Problem problem = block("runs: {a: {}, b: {controllers: {hold: {setpoint: 1.0}}}}\nrobust: {measure: mean}\n");
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
