// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "paths.h"

namespace codesign {

std::string source_dir() { return CODESIGN_SOURCE_DIR; }

std::string codesign_executable() { return CODESIGN_EXECUTABLE; }

std::string mpirun_executable() { return CODESIGN_MPIRUN; }

}  // namespace codesign
