// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MPI_LAUNCHER_H_
#define MECHANISM_CODESIGN_MPI_LAUNCHER_H_

#include <optional>
#include <string>

namespace codesign {

/// What a launcher of MPI programs (mpirun, srun) says in the environment about this process; it is there before MPI is initialized, and
/// without MPI.
struct Launched {
  int rank = 0;
  int ranks = 0;  ///< 0 where the launcher does not say
};

/// Nothing if no launcher has started this process. @param value of an environment variable by name; null: not set.
std::optional<Launched> find_launcher(const char* (*value)(const char* name));

/// The same, by the environment of this process.
std::optional<Launched> find_launcher();

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MPI_LAUNCHER_H_
