// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// The word of the command line that makes the benchmarks a program of several ranks, which
/// measure_ranks() starts with mpirun.
constexpr const char* kRankProgram = "--rank-program";

/// What such a program measures, printed by rank 0 as numbers in one line:
/// - "gradient", over 32 samples: wall time, processor time of rank 0, and of the evaluations of
///   all ranks [s];
/// - "messages": of a task that costs nothing: processor time of the dispatcher and of the caller
///   [s], and the time until it is answered if it is the only one [s]; then the sizes of the
///   messages with a task, a result and a problem [bytes].
/// @returns the exit code.
int run_rank_program(const std::string& what);

}  // namespace codesign
