// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watched_records.h"

#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kShown = 1e-8;  // smaller violations are rounding

}  // namespace

void add_watched(const OptimizationResult& result, Json* object) {
  if (result.watched.empty()) return;
  Json list = Json::array();
  for (const WatchedResult& watched : result.watched)
    list.push_back({{"element", watched.element},
                    {"signal", watched.signal},
                    {"initial_smallest", watched.initial_smallest},
                    {"initial_largest", watched.initial_largest},
                    {"smallest", watched.smallest},
                    {"largest", watched.largest},
                    {"smallest_time", watched.smallest_time},
                    {"largest_time", watched.largest_time},
                    {"violation", watched.violation}});
  (*object)["signals"] = std::move(list);
}

std::vector<std::string> watched_sentences(const OptimizationResult& result) {
  std::vector<std::string> sentences;
  for (const WatchedResult& watched : result.watched)
    sentences.push_back(watched.element + ", " + watched.signal + ": from " + readable(watched.initial_smallest) + " ... " +
                        readable(watched.initial_largest) + " to " + readable(watched.smallest) + " ... " + readable(watched.largest) +
                        (watched.violation > kShown ? ", beyond its bounds by " + readable(watched.violation, 3) : ""));
  return sentences;
}

}  // namespace codesign
