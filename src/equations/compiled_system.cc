// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_system.h"

#include <algorithm>
#include <utility>

#include "equations/equation_recorder.h"
#include "equations/equation_variant.h"
#include "equations/equation_variants.h"
#include "math/arrays.h"

namespace codesign {

CompiledSystem::CompiledSystem(const RobotDescription& robot, const Study& study,
                               ReactionSharing sharing, const std::vector<int>& drives)
    : System(robot, study, std::move(sharing), drives) {
  auto residual = std::make_unique<ResidualRecording>(*this);
  patterns_ = record_patterns(*this, *residual);
  for (auto& variants : variants_) variants = std::make_unique<EquationVariants>();
  variants_[to_index(EquationPart::kMotion)] =
      std::make_unique<EquationVariants>(std::move(residual));
}

CompiledSystem::~CompiledSystem() = default;

// Loops couple rows that a tree leaves apart: their columns need more groups, while a program for
// their derivatives is short.
bool CompiledSystem::compresses_jacobian() const {
  constexpr int kLeast = 5;
  return layout().has_forest() && layout().n - 2 * layout().m >= kLeast;
}

bool CompiledSystem::has_rates_apart() const {
  const SolverOptions& solver = study().solver;
  const bool may_be_explicit =
      solver.method == RosenbrockMethod::kDopri5 || solver.method == RosenbrockMethod::kAuto;
  return compresses_jacobian() ||
         (solver.integrator == IntegratorKind::kRosenbrock && may_be_explicit);
}

// Steps of loops that share reactions are watched for singular positions, (23a), which explicit
// steps are long enough to pass unseen.
bool CompiledSystem::begins_explicitly() const {
  const SolverOptions& solver = study().solver;
  if (solver.integrator != IntegratorKind::kRosenbrock) return false;
  if (solver.method == RosenbrockMethod::kDopri5) return true;
  const bool has_dry_friction =
      !contacts().empty() || std::any_of(loads().begin(), loads().end(),
                                         [](const JointLoad& load) { return load.has_friction(); });
  return solver.method == RosenbrockMethod::kAuto && compliance() == 0.0 && !has_dry_friction;
}

bool CompiledSystem::has_switches() const { return !equation_variant()->mode().empty(); }

bool CompiledSystem::ends_run(const std::vector<bool>& mode) const {
  if (!until()) return false;
  for (std::size_t k = 0; const EquationVariant* code = equation_variant(k); ++k)
    if (code->mode() == mode) return code->ends_run();
  return record_variant({}, EquationPart::kMotion, mode)->ends_run();
}

const EquationVariant* CompiledSystem::equation_variant(std::size_t k, EquationPart part) const {
  return variants_[to_index(part)]->at(k, *this, part);
}

std::unique_ptr<EquationVariant> CompiledSystem::record_variant(std::vector<bool> outcomes,
                                                                EquationPart part,
                                                                std::vector<bool> mode) const {
  return std::make_unique<EquationVariant>(*this, part, std::move(outcomes), std::move(mode));
}

std::size_t CompiledSystem::keep_variant(std::unique_ptr<EquationVariant> variant,
                                         EquationPart part) const {
  return variants_[to_index(part)]->keep(std::move(variant));
}

}  // namespace codesign
