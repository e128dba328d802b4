// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/reaction_advice.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/linear_tables.h"
#include "cli/report.h"
#include "description/study.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/linear_records.h"
#include "jobs/run_recorder.h"
#include "linear/equilibrium.h"
#include "problem/load_problem.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

constexpr int kPostureDigits = 6;

void print_equilibrium(const Equilibrium& found, std::ostream& out) {
  Table joints;
  joints.add({"joint", "position", "effort"});
  for (std::size_t k = 0; k < found.names.joints.size(); ++k)
    joints.add({found.names.joints[k], readable(found.frame.joints[k].position, kPostureDigits),
                readable(found.frame.joints[k].effort, kPostureDigits)});
  joints.print(out);
  for (std::size_t k = 0; k < found.names.signals.size(); ++k)
    out << found.names.signals[k] << "  " << readable(found.frame.signals[k], kPostureDigits)
        << '\n';
  print_stability(found.linear, out);
}

Json joints_json(const Equilibrium& found) {
  Json joints = Json::object();
  for (std::size_t k = 0; k < found.frame.joints.size(); ++k)
    joints[found.names.joints[k]] = {{"position", found.frame.joints[k].position},
                                     {"effort", found.frame.joints[k].effort}};
  return joints;
}

}  // namespace

int equilibrium(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  const std::vector<SignalDescription> signals =
      select_signals(arguments, problem, study_of(problem).controllers, {});
  const Equilibrium found = find_equilibrium(*system_of(problem), problem.parameters(), signals,
                                             &console.cancel, {{}, arguments.friction, false});
  LimitWatch limits(problem, problem.parameters(), found.names);
  if (found.status.ok()) limits.observe(found.frame);
  if (found.status.ok() && !arguments.json) {
    print_equilibrium(found, console.out);
    for (const LimitCrossing& crossing : limits.crossings())
      console.out << describe(crossing) << '\n';
  }
  Json object;
  if (arguments.json) {
    object["parameters"] = parameters_json(problem, problem.parameters());
    object["joints"] = joints_json(found);
    object["signals"] = by_name(found.names.signals, found.frame.signals);
    if (found.status.ok()) add_stability(found.linear, &object);
    object["limits_exceeded"] = to_json(limits.crossings());
    object["steps"] = found.steps;
  }
  add_warnings(arguments, problem, warn_of_open_reactions(*system_of(problem), signals), &object,
               console);
  return finish(arguments, found.status, std::move(object), console);
}

}  // namespace codesign::cli
