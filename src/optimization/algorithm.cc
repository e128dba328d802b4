// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/algorithm.h"

#include <map>

#include "text/decimal.h"

namespace codesign {
namespace {

struct Algorithm {
  nlopt::algorithm id;
  bool takes_constraints;
};

const std::map<std::string, Algorithm>& algorithms() {
  static const std::map<std::string, Algorithm> table{
      {"lbfgs", {nlopt::LD_LBFGS, false}},   {"var1", {nlopt::LD_VAR1, false}},
      {"var2", {nlopt::LD_VAR2, false}},     {"tnewton", {nlopt::LD_TNEWTON_PRECOND_RESTART, false}},
      {"mma", {nlopt::LD_MMA, true}},        {"ccsaq", {nlopt::LD_CCSAQ, true}},
      {"slsqp", {nlopt::LD_SLSQP, true}},    {"cobyla", {nlopt::LN_COBYLA, true}},
      {"bobyqa", {nlopt::LN_BOBYQA, false}}, {"auglag_lbfgs", {nlopt::LD_AUGLAG, true}}};
  return table;
}

std::string names(bool constrained) {
  std::string list;
  for (const auto& [name, algorithm] : algorithms())
    if (!constrained || algorithm.takes_constraints) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

SourceLocation where_of(const OptimizerOptions& options, const Study& study) {
  return options.where.file.empty() ? SourceLocation{study.file, 1} : options.where;
}

nlopt::opt make_optimizer(const Study& study, const OptimizerOptions& options, unsigned dimension, bool with_slack) {
  const auto found = algorithms().find(options.algorithm);
  const SourceLocation where = where_of(options, study);
  const InputFault fault{where, "optimizer.algorithm", "", options.algorithm, ""};
  if (found == algorithms().end()) throw InputError({fault.where, fault.element, "no such algorithm", fault.value, names(false)});
  if (!study.constraints.empty() && !found->second.takes_constraints)
    throw InputError({fault.where, fault.element, "this algorithm takes no constraints on parameters", fault.value, names(true)});
  if (with_slack && !found->second.takes_constraints)
    throw InputError({fault.where, fault.element, "this algorithm takes no constraints, which robust.measure worst and cvar are solved by",
                      fault.value, names(true)});
  // Checked here because the tolerance may also come from a request of a ROS client. Smaller ones are below rounding.
  constexpr double kLeast = 1e-15;
  if (!(options.relative_tolerance >= kLeast && options.relative_tolerance < 1.0))
    throw InputError({where, "optimizer.relative_tolerance", "tolerance out of range", to_decimal(options.relative_tolerance),
                      "from 1e-15 to less than 1"});
  nlopt::opt optimizer(found->second.id, dimension);
  if (found->second.id == nlopt::LD_AUGLAG) {
    nlopt::opt local(nlopt::LD_LBFGS, dimension);
    local.set_ftol_rel(options.relative_tolerance);
    // NLopt 2.7.1 reads the absolute tolerances of the sub-optimizer even if they were never set.
    local.set_xtol_abs(0.0);
    optimizer.set_local_optimizer(local);
    optimizer.set_xtol_abs(0.0);
  }
  return optimizer;
}

std::string termination_name(nlopt::result result) {
  switch (result) {
    case nlopt::SUCCESS:
      return "success";
    case nlopt::STOPVAL_REACHED:
      return "objective_value_reached";
    case nlopt::FTOL_REACHED:
      return "objective_tolerance_reached";
    case nlopt::XTOL_REACHED:
      return "parameter_tolerance_reached";
    case nlopt::MAXEVAL_REACHED:
      return "max_evaluations_reached";
    case nlopt::MAXTIME_REACHED:
      return "max_time_reached";
    case nlopt::FORCED_STOP:
      return "cancelled";
    case nlopt::ROUNDOFF_LIMITED:
      return "roundoff_limited";
    default:
      return "algorithm_failed";
  }
}

}  // namespace codesign
