// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mpi/launcher.h"

#include <cstdlib>

namespace codesign {
namespace {

/// The names of Open MPI, of PMIx (srun, Open MPI 5 under another launcher) and of PMI (Hydra,
/// srun).
struct Names {
  const char* rank;
  const char* ranks;
};
constexpr Names kLaunchers[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                {"PMIX_RANK", "PMIX_SIZE"},
                                {"PMI_RANK", "PMI_SIZE"}};

int number(const char* text, int otherwise) {
  return text == nullptr ? otherwise : std::atoi(text);
}

const char* of_process(const char* name) { return std::getenv(name); }

}  // namespace

std::optional<Launched> find_launcher(const char* (*value)(const char* name)) {
  for (const Names& names : kLaunchers)
    if (const char* const rank = value(names.rank))
      return Launched{number(rank, 0), number(value(names.ranks), 0)};
  return std::nullopt;
}

std::optional<Launched> find_launcher() { return find_launcher(of_process); }

std::optional<double> seconds_to_end(const char* (*value)(const char* name)) {
  const int seconds = number(value("OMPI_MCA_odls_base_sigkill_timeout"), 0);
  return seconds > 0 ? std::optional<double>(seconds) : std::nullopt;
}

std::optional<double> seconds_to_end() { return seconds_to_end(of_process); }

}  // namespace codesign
