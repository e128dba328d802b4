// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MPI_RUN_ON_RANKS_H_
#define MECHANISM_CODESIGN_MPI_RUN_ON_RANKS_H_

#include <functional>
#include <string>

namespace codesign {

class Dispatcher;

/// Runs a program on the processes that mpirun has started: rank 0 does what the program does, and the others evaluate for it until it
/// ends. A program that mpirun has not started is one process; MPI is not initialized then. Called once, from main().
/// @param name of the program, for messages. @param first what rank 0 does, with the processes of the job for engines; null where MPI is
/// not built in. @returns the exit code.
int run_on_ranks(const std::string& name, const std::function<int(Dispatcher*)>& first);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MPI_RUN_ON_RANKS_H_
