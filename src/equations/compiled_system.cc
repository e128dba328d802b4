// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_system.h"

#include "equations/equation_code.h"
#include "equations/record_assembly.h"

namespace codesign {

CompiledSystem::CompiledSystem(const RobotDescription& robot, const Study& study, ReactionSharing sharing, const std::vector<int>& drives)
    : System(robot, study, std::move(sharing), drives), plan_(record_assembly(*this)), code_(std::make_unique<LazyEquationCode>()) {}

CompiledSystem::~CompiledSystem() = default;

const EquationCode* CompiledSystem::equation_code() const { return code_->get(*this, plan_); }

}  // namespace codesign
