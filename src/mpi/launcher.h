// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace codesign {

/// Environment variables of a launcher of MPI programs (mpirun, srun) about this process. They are
/// set before MPI is initialized, and also in a build without MPI.
struct Launched {
  int rank = 0;
  int ranks = 0;  ///< 0 if the launcher does not set it
};

/// std::nullopt if no launcher has started this process. @param value of an environment variable by
/// name; null: not set.
std::optional<Launched> find_launcher(const char* (*value)(const char* name));

/// Reads the environment of this process.
std::optional<Launched> find_launcher();

/// How long mpirun lets the ranks live after the loss of one of them [s], if its environment says
/// so (OMPI_MCA_odls_base_sigkill_timeout); Open MPI's own choice is 1 s.
std::optional<double> seconds_to_end(const char* (*value)(const char* name));
std::optional<double> seconds_to_end();

}  // namespace codesign
