// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/remembering_engine.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "engine/serial_engine.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

class MapMemory final : public EvaluationMemory {
 public:
  std::optional<Evaluation> find(const EvaluationTask& task) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto place = known_.find({task.parameters, task.derivatives});
    return place == known_.end() ? std::nullopt : std::optional<Evaluation>(place->second);
  }
  void keep(const EvaluationTask& task, const Evaluation& evaluation) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_TRUE(known_.emplace(std::make_pair(task.parameters, task.derivatives), evaluation).second) << "computed twice";
    if (known_.size() == cancel_at) cancel = true;
  }
  std::size_t size() const { return known_.size(); }

  std::size_t cancel_at = 0;
  std::atomic<bool> cancel{false};

 private:
  std::mutex mutex_;
  std::map<std::pair<std::vector<double>, Derivatives>, Evaluation> known_;
};

std::vector<EvaluationTask> designs(const Problem& problem, int first, int count) {
  std::vector<EvaluationTask> result;
  for (int k = first; k < first + count; ++k)
    result.push_back({problem.system(), problem.parameters(Eigen::Vector2d(10.0 + k, 3.0)), gradient_if(k % 2 == 0)});
  return result;
}

struct RunCounts {
  std::atomic<int> computed{0}, remembered{0};
};

EngineRecords records_with(const std::shared_ptr<MapMemory>& memory, RunCounts* counts) {
  return {memory, [counts](bool computed) { ++(computed ? counts->computed : counts->remembered); }};
}

TEST(RememberingEngine, ComputesOnlyWhatIsNotKnown) {
  const Problem problem = block("");
  const auto memory = std::make_shared<MapMemory>();
  RunCounts counts;
  const EngineRecords records = records_with(memory, &counts);
  const auto engine = with_records(std::make_unique<ThreadEngine>(2), records);
  EXPECT_EQ(engine->workers(), 2);
  engine->evaluate(designs(problem, 0, 4), nullptr);
  EXPECT_EQ(memory->size(), 4u);
  const std::vector<EvaluationTask> all = designs(problem, 2, 5);
  const std::vector<Evaluation> results = engine->evaluate(all, nullptr), expected = SerialEngine().evaluate(all, nullptr);
  EXPECT_EQ(counts.computed, 7);
  EXPECT_EQ(counts.remembered, 2);
  ASSERT_EQ(results.size(), 5u);
  for (std::size_t k = 0; k < results.size(); ++k) {
    EXPECT_EQ(results[k].objective, expected[k].objective) << k;
    EXPECT_EQ(results[k].gradient, expected[k].gradient) << k;
  }
}

TEST(RememberingEngine, KeepsEachResultAtOnceAndNoneThatWasCancelled) {
  const Problem problem = block("");
  const auto memory = std::make_shared<MapMemory>();
  memory->cancel_at = 2;
  RunCounts counts;
  const EngineRecords records = records_with(memory, &counts);
  const auto engine = with_records(std::make_unique<SerialEngine>(), records);
  const std::vector<Evaluation> results = engine->evaluate(designs(problem, 0, 4), &memory->cancel);
  EXPECT_EQ(memory->size(), 2u);
  EXPECT_EQ(counts.computed, 2);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(results[k].status.code == StatusCode::kCancelled, k >= 2) << k;
}

TEST(RememberingEngine, ACancelledJobIsNotCarriedOnByItsMemory) {
  const Problem problem = block("");
  const auto memory = std::make_shared<MapMemory>();
  RunCounts counts;
  const auto engine = with_records(std::make_unique<SerialEngine>(), records_with(memory, &counts));
  engine->evaluate(designs(problem, 0, 1), nullptr);
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(engine->evaluate(designs(problem, 0, 1), &cancel)[0].status.code, StatusCode::kCancelled);
}

TEST(RememberingEngine, WithoutRecordsIsTheEngineItself) {
  auto serial = std::make_unique<SerialEngine>();
  const EvaluationEngine* const address = serial.get();
  EXPECT_EQ(with_records(std::move(serial), {}).get(), address);
}

}  // namespace
}  // namespace codesign
