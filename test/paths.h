// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// The root of the source tree. One translation unit alone knows the path, so that a compiler cache
/// serves every checkout.
std::string source_dir();

/// The command line program of this build.
std::string codesign_executable();

/// mpirun, where this build has MPI; else empty.
std::string mpirun_executable();

}  // namespace codesign
