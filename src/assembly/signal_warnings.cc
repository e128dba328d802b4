// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/signal_warnings.h"

#include <algorithm>

#include "assembly/start_workspace.h"
#include "mechanism/signal_catalog.h"

namespace codesign {

Warnings warn_of_open_reactions(const CompiledSystem& system, const Redundancy& redundancy, const State<double>& state,
                                const std::vector<SignalDescription>& signals, Equations<double>* equations) {
  std::vector<Signal> resolved;
  resolved.reserve(signals.size());
  for (const SignalDescription& signal : signals)
    resolved.push_back(resolve_signal(signal, system.robot(), system.topology(), system.study().controllers));
  Warnings warnings;
  for (std::size_t k : open_reactions(system, redundancy, state, resolved, equations))
    append({warn("undetermined_reaction", {signals[k].where, "signal",
                                           "the signal reads a reaction that is not unique, because the loop has redundant constraints; "
                                           "the one of least norm is used; to remove the warning, give one joint of the loop the freedom "
                                           "that it has in reality, as codesign:spherical or codesign:cylindrical",
                                           signals[k].text, ""})},
           &warnings);
  return warnings;
}

Warnings warn_of_open_reactions(const CompiledSystem& system, const std::vector<SignalDescription>& signals) {
  const auto reads_one = [](const SignalDescription& signal) {
    return std::any_of(signal.terms.begin(), signal.terms.end(), [](const SignalTerm& term) { return is_reaction(term); });
  };
  if (std::none_of(signals.begin(), signals.end(), reads_one)) return {};
  StartWorkspace start(system, system.parameters());
  if (!start.solve_positions().ok()) return {};
  const Redundancy redundancy = analyse_redundancy(system, &start.equations, start.assembly, start.parameters, start.state);
  return warn_of_open_reactions(system, redundancy, start.state, signals, &start.equations);
}

}  // namespace codesign
