// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_options.h"

#include <cmath>

#include "text/number_text.h"

namespace codesign {

std::string OptionRange::in_words() const {
  const bool is_whole = is_bounded() && has_least && has_most;
  if (is_whole)
    return "a whole number from " + std::to_string(static_cast<int>(least)) + " to " +
           std::to_string(static_cast<int>(most));
  const std::string end = is_bounded() ? "less than " + to_decimal(most) : "";
  if (has_least)
    return end.empty() ? to_decimal(least) + " or more"
                       : "from " + to_decimal(least) + " to " + end;
  return "more than " + to_decimal(least) + (end.empty() ? "" : " and " + end);
}

namespace {

[[noreturn]] void refuse(const YamlValue& value, const std::string& key, const OptionRange& range) {
  value.fail(range.fault != nullptr ? range.fault : key + " out of range",
             range.allowed != nullptr ? range.allowed : range.in_words());
}

/// The adjoint exists for the steps of the Rosenbrock integrator only.
void check_gradient(const YamlValue& solver, const SolverOptions& options) {
  if (options.gradient != GradientMethod::kAdjoint) return;
  const YamlValue value = solver.at("gradient");
  if (options.integrator != IntegratorKind::kRosenbrock)
    value.fail("the adjoint exists for the integrator rosenbrock only", "auto or direct with idas");
}

}  // namespace

void OptionReader::operator()(const std::string& key, bool& option) const {
  if (const auto value = block.find(key)) option = value->boolean();
}

void OptionReader::operator()(const std::string& key, const OptionRange& range,
                              double& option) const {
  const auto value = block.find(key);
  if (!value) return;
  option = value->number();
  if (!range.holds(option)) refuse(*value, key, range);
}

void OptionReader::operator()(const std::string& key, const OptionRange& range,
                              std::optional<double>& option) const {
  double number = 0.0;
  if (!block.find(key)) return;
  (*this)(key, range, number);
  option = number;
}

void OptionReader::operator()(const std::string& key, const OptionRange& range, int& option) const {
  const auto value = block.find(key);
  if (!value) return;
  const double number = range.is_bounded() ? value->number() : value->integer();
  if (number != std::floor(number)) value->fail("not an integer", range.in_words());
  if (!range.holds(number)) refuse(*value, key, range);
  option = static_cast<int>(number);
}

void OptionReader::operator()(const std::string& key, const OptionRange& range,
                              std::uint32_t& option) const {
  int number = static_cast<int>(option);
  (*this)(key, range, number);
  option = static_cast<std::uint32_t>(number);
}

std::vector<std::pair<std::string, LossKind>> fit_losses() {
  std::vector<std::pair<std::string, LossKind>> list;
  for (const LossKind& kind : losses())
    if (kind->weight != nullptr)
      list.emplace_back(kind == LossKind::kSquare ? "none" : kind->name, kind);
  return list;
}

void OptionReader::operator()(const std::string& key, LossKind& option) const {
  const auto value = block.find(key);
  if (!value) return;
  const std::vector<std::pair<std::string, LossKind>> known = fit_losses();
  std::vector<std::string> names;
  for (const auto& [name, kind] : known) names.push_back(name);
  const std::string chosen = value->choice(key, names);
  for (const auto& [name, kind] : known)
    if (name == chosen) option = kind;
}

SolverOptions read_solver_options(const YamlValue& solver) {
  SolverOptions options;
  read_options(solver, &options);
  if (const auto coordinates = solver.find("coordinates"))
    options.coordinates_where = coordinates->where();
  check_gradient(solver, options);
  return options;
}

LimitOptions read_limit_options(const YamlValue& limits) {
  LimitOptions options;
  read_options(limits, &options);
  for (const char* key : {"stiffness", "dissipation", "width"})
    if (const auto value = limits.find(key); value && !limits.find("position"))
      value->fail("an option of the stops, which the study does not have",
                  "position: true beside it");
  return options;
}

OptimizerOptions read_optimizer_options(const YamlValue& optimizer) {
  OptimizerOptions options;
  read_options(optimizer, &options);
  options.where = optimizer.find("algorithm").value_or(optimizer).where();
  return options;
}

}  // namespace codesign
