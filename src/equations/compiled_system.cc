// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_system.h"

#include <utility>

#include "equations/equation_variants.h"
#include "equations/record_patterns.h"

namespace codesign {

CompiledSystem::CompiledSystem(const RobotDescription& robot, const Study& study, ReactionSharing sharing, const std::vector<int>& drives)
    : System(robot, study, std::move(sharing), drives),
      patterns_(record_patterns(*this)),
      variants_{std::make_unique<EquationVariants>(), std::make_unique<EquationVariants>(), std::make_unique<EquationVariants>(),
                std::make_unique<EquationVariants>()} {}

CompiledSystem::~CompiledSystem() = default;

const EquationCode* CompiledSystem::equation_code(std::size_t k, EquationPart part) const {
  return variants_[static_cast<std::size_t>(part)]->at(k, *this, patterns_, part);
}

std::unique_ptr<EquationCode> CompiledSystem::record_variant(std::vector<bool> outcomes, EquationPart part) const {
  return std::make_unique<EquationCode>(*this, patterns_, part, std::move(outcomes));
}

std::size_t CompiledSystem::keep_variant(std::unique_ptr<EquationCode> variant, EquationPart part) const {
  return variants_[static_cast<std::size_t>(part)]->keep(std::move(variant));
}

}  // namespace codesign
