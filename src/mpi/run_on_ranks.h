// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace codesign {

class Dispatcher;

/// Runs a program on the processes that mpirun has started: rank 0 runs the program, and the other
/// ranks evaluate for it until it ends. If mpirun has not started the program, it is a single
/// process and does not initialize MPI. Called once, from main().
/// @param name of the program, for messages. @param first the function for rank 0. Its argument is
/// the processes of the job, for engines; null in a build without MPI. @returns the exit code.
int run_on_ranks(const std::string& name, const std::function<int(Dispatcher*)>& first);

}  // namespace codesign
