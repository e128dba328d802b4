// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

struct Study;

class CompiledSystem;

/// The systems that the runs and the uncertain friction law of a study need, run by run: first with
/// the model's own friction laws, then with each law of the choice for all joints. Runs that change
/// only values of parameters share the study's own system.
/// @param own the system of the study itself. @param warnings receives the warnings about the runs
/// that it does not contain yet.
/// @throws InputError naming the run, for a run without equations of motion or whose start cannot
/// be assembled.
std::vector<std::shared_ptr<const CompiledSystem>> make_variants(
    const RobotDescription& robot, const Study& study,
    const std::shared_ptr<const CompiledSystem>& own, Warnings* warnings);

/// Checks that no parameter is tuned that a run sets or that is uncertain, that parameters have
/// bounds if there are many starts, and that the samplers can draw as many quantities. The reader
/// checks the file, but a request to a node may tune other parameters. @throws InputError naming
/// the parameter.
void require_compatible(const Study& study);

/// The number of friction laws to choose from; 0 if the law is certain.
int count_laws(const Study& study);

}  // namespace codesign
