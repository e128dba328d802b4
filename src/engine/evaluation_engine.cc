// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation_engine.h"

#include <algorithm>
#include <thread>

#include "engine/serial_engine.h"
#include "engine/thread_engine.h"

namespace codesign {

std::unique_ptr<EvaluationEngine> make_engine(const EngineOptions& options, std::int64_t most_useful) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto workers = static_cast<int>(std::min<std::int64_t>(options.workers > 0 ? options.workers : processors, most_useful));
  if (options.kind == EngineKind::kSerial || workers <= 1) return std::make_unique<SerialEngine>();
  return std::make_unique<ThreadEngine>(workers);
}

}  // namespace codesign
