// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "jobs/json.h"
#include "jobs/run_recorder.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"
#include "problem/load_problem.h"

namespace codesign {

struct MachineNumber;

/// `{code, message, file, line, element, value, allowed}` with code `bad_input`.
Json to_json(const InputError& error);
/// `[{joint, limit, bound, worst, time}]`
Json to_json(const std::vector<LimitCrossing>& crossings);
/// machine_numbers() of a design; and each as joint, number, value and unit.
std::vector<MachineNumber> machine_numbers_of(const Problem& problem,
                                              const std::vector<double>& parameters);
Json to_json(const std::vector<MachineNumber>& numbers);
/// Sets `events`, a list of `{time, element, object, expression, direction, kind}`, and
/// `event_count`.
void add_events(const Events& events, Json* object);
/// `{code, message, time}`
Json to_json(const Status& status);
/// `[{code, message, file, line}]`
Json to_json(const Warnings& warnings);
/// Sets the fields of the statistics.
void add_statistics(const Statistics& statistics, Json* object);
/// Sets `setup_seconds`, `warnings`, those of the problem before those of the run, and `error` if
/// the run failed.
void add_outcome(const Problem& problem, const Warnings& of_run, const Status& status,
                 Json* object);
/// Sets `counts` for the design at `parameters`, if it can be assembled.
void add_counts(const Problem& problem, const std::vector<double>& parameters, Json* object);

/// A list of all named parameters: `name`, `unit`, `tuned` (whether the study tunes it), `lower`,
/// `upper` (null: none), `initial`, `value`, and `bound`: lower or upper if a tuned value lies on
/// it, else empty.
Json parameter_table(const Problem& problem, const OptimizationResult& result);

/// What differences of the objective through other steps say of a gradient, or why that is not
/// known.
Json differences_json(const IndependentCheck& check);

/// The gradient at the best point beside a reference by complex step (with `idas` by Ridders'
/// differences): `method`, `gradient`, `reference`, `largest_relative_difference`. If the check
/// would probably take more than a few seconds, or if it fails, `skipped` has the reason. Beside
/// it `differences`, by which the search was confirmed at its end.
Json gradient_check_json(const Problem& problem, const OptimizationResult& result,
                         const std::atomic<bool>* cancel);

}  // namespace codesign
