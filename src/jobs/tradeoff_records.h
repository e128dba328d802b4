// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "jobs/json.h"
#include "optimization/tradeoff.h"

namespace codesign {

/// `objectives` (names), `tuned` (names), `points` in the order of the curve, `ideal`, `nadir`,
/// `smallest_gap`, `largest_gap`, and the cost of all searches.
Json tradeoff_json(const Problem& problem, const TradeoffResult& result);
/// The text of `--json` with warnings and, if the job failed, `error`.
std::string tradeoff_report(const Problem& problem, const TradeoffResult& result);
/// One point, as in `points`.
Json point_json(const Problem& problem, const std::vector<std::string>& names,
                const TradeoffPoint& point);

/// The table of points: kind, `objective_NAME`, tuned parameters, and how the search ended.
std::vector<std::string> tradeoff_columns(const Problem& problem, const TradeoffResult& result);
std::vector<std::vector<std::string>> tradeoff_rows(const TradeoffResult& result);

/// "point 3 of 11: error 0.12, effort 3.4, on_curve (9 evaluations)".
std::string tradeoff_line(const std::vector<std::string>& names, const TradeoffPoint& point,
                          int done, int of);
/// The points as a table for people, what of them is no point of the curve, and the cost.
std::string tradeoff_text(const Problem& problem, const TradeoffResult& result);

}  // namespace codesign
