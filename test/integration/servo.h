// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "assembly/make_system.h"
#include "description/study.h"
#include "integration/mechanisms.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// A double pendulum with friction whose shoulder a PID turns; an extra state, terminal terms, five
/// parameters, one of them in the initial state.
std::string servo_study(const std::string& solver);

/// In absolute coordinates, whose places in the state tests know, unless the study names others.
std::shared_ptr<const CompiledSystem> compile(const std::string& urdf, const std::string& text);

std::shared_ptr<const CompiledSystem> servo(const std::string& solver);

}  // namespace codesign
