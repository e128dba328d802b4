// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation_engine.h"

#include <algorithm>
#include <thread>

#include "engine/mpi_engine.h"
#include "engine/serial_engine.h"
#include "engine/thread_engine.h"

namespace codesign {

void require_engine(const EngineOptions& options, const Dispatcher* ranks) {
  const char* const kElement = "engine.type";
  if (options.kind == EngineKind::kMpi && ranks == nullptr)
    throw InputError({options.where, kElement, "the engine mpi is not in this program", kEngineNames[2],
                      "serial or threads; codesign and the node optimization have it where they are built with libopenmpi-dev installed"});
  if (ranks == nullptr || ranks->ranks() == 1 || options.kind == EngineKind::kMpi || options.where.file.empty()) return;
  throw InputError({options.where, kElement,
                    "mpirun has started " + std::to_string(ranks->ranks()) + " processes, and the study asks for an engine of one",
                    kEngineNames[static_cast<std::size_t>(options.kind)], "mpi, no engine at all, or the same command without mpirun"});
}

std::unique_ptr<EvaluationEngine> make_engine(const Problem& problem, std::int64_t most_useful, Dispatcher* ranks) {
  const EngineOptions& options = problem.study().ensemble.engine;
  require_engine(options, ranks);
  if (most_useful > 1 && ranks != nullptr && ranks->ranks() > 1) return std::make_unique<MpiEngine>(ranks, problem);
  return make_engine(options, most_useful);
}

std::unique_ptr<EvaluationEngine> make_engine(const EngineOptions& options, std::int64_t most_useful) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto workers = static_cast<int>(std::min<std::int64_t>(options.workers > 0 ? options.workers : processors, most_useful));
  if (options.kind != EngineKind::kThreads || workers <= 1) return std::make_unique<SerialEngine>();
  return std::make_unique<ThreadEngine>(workers);
}

}  // namespace codesign
