// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/watched_records.h"

#include <cmath>

#include "jobs/json.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kShown = 1e-8;  // smaller violations are rounding

/// A number, or null where there is no bound.
Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json place(const ScenarioResult& scenario) { return {{"run", scenario.run}, {"sample", scenario.sample + 1}}; }

}  // namespace

void add_watched(const OptimizationResult& result, Json* object) {
  if (result.watched.empty()) return;
  Json list = Json::array();
  for (const WatchedResult& watched : result.watched) {
    Json one = {{"element", watched.element},
                {"signal", watched.signal},
                {"lower", bound(watched.lower)},
                {"upper", bound(watched.upper)},
                {"after", watched.after},
                {"before", watched.before},
                {"initial_smallest", watched.initial_smallest},
                {"initial_largest", watched.initial_largest},
                {"smallest", watched.smallest},
                {"largest", watched.largest},
                {"smallest_time", watched.smallest_time},
                {"largest_time", watched.largest_time},
                {"violation", watched.violation},
                {"tolerance", watched.tolerance}};
    if (!result.scenarios.empty()) {
      one["smallest_in"] = place(result.scenarios[static_cast<std::size_t>(watched.smallest_scenario)]);
      one["largest_in"] = place(result.scenarios[static_cast<std::size_t>(watched.largest_scenario)]);
    }
    list.push_back(std::move(one));
  }
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
