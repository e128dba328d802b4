// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// In place of mpi_transport.cc and run_on_ranks.cc where MPI is not installed.
#include <iostream>

#include "mpi/launcher.h"
#include "mpi/run_on_ranks.h"

namespace codesign {

int run_on_ranks(const std::string& name, const std::function<int(Dispatcher*)>& first) {
  constexpr int kBadInput = 2;
  const std::optional<Launched> launched = find_launcher();
  if (!launched || launched->ranks <= 1) return first(nullptr);
  // Otherwise each process would run the same job and write the same files.
  if (launched->rank == 0)
    std::cerr << name << ": started as " << launched->ranks
              << " processes, but built without MPI; install libopenmpi-dev and build again, or "
                 "start it without mpirun"
              << std::endl;
  return kBadInput;
}

}  // namespace codesign
