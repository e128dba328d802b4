// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_ALGORITHM_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_ALGORITHM_H_

#include <nlopt.hpp>
#include <string>

#include "description/study.h"

namespace codesign {

/// The NLopt optimizer that a study names. @throws InputError for an unknown name, or constraints with an algorithm that takes none.
nlopt::opt make_optimizer(const Study& study, const OptimizerOptions& options, unsigned dimension);

/// Snake-case name of why NLopt stopped.
std::string termination_name(nlopt::result result);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_ALGORITHM_H_
