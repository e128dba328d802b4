// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "assembly/reaction_advice.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "description/study.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/run_recorder.h"
#include "problem/load_problem.h"
#include "statics/equilibrium.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

constexpr int kPostureDigits = 6;

/// "hinge 1, slide -0.2": the joints that take part.
std::string rates_text(const EquilibriumMode& mode, const std::vector<std::string>& joints) {
  std::string text;
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (std::abs(mode.rates[k]) > 1e-6)
      text += (text.empty() ? "" : ", ") + joints[k] + " " + readable(mode.rates[k], 3);
  return text.empty() ? "no joint with one coordinate" : text;
}

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
  out << name_of(found.stability) << '\n';
  if (found.modes.empty()) return;
  Table modes;
  modes.add({"small motion", "growth [1/s]", "frequency [Hz]", "rates"});
  for (std::size_t k = 0; k < found.modes.size(); ++k)
    modes.add({std::to_string(k + 1), readable(found.modes[k].growth(), kPostureDigits),
               readable(found.modes[k].frequency(), kPostureDigits),
               rates_text(found.modes[k], found.names.joints)});
  modes.print(out);
}

Json joints_json(const Equilibrium& found) {
  Json joints = Json::object();
  for (std::size_t k = 0; k < found.frame.joints.size(); ++k)
    joints[found.names.joints[k]] = {{"position", found.frame.joints[k].position},
                                     {"effort", found.frame.joints[k].effort}};
  return joints;
}

Json modes_json(const Equilibrium& found) {
  Json modes = Json::array();
  for (const EquilibriumMode& mode : found.modes)
    modes.push_back({{"growth", mode.growth()},
                     {"frequency", mode.frequency()},
                     {"rates", by_name(found.names.joints, mode.rates)}});
  return modes;
}

}  // namespace

int equilibrium(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  const std::vector<SignalDescription> signals =
      select_signals(arguments, problem, study_of(problem).controllers, {});
  const Equilibrium found =
      find_equilibrium(*system_of(problem), problem.parameters(), signals, &console.cancel);
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
    if (found.status.ok()) object["stability"] = name_of(found.stability);
    object["modes"] = modes_json(found);
    object["limits_exceeded"] = to_json(limits.crossings());
    object["steps"] = found.steps;
  }
  add_warnings(arguments, problem, warn_of_open_reactions(*system_of(problem), signals), &object,
               console);
  return finish(arguments, found.status, std::move(object), console);
}

}  // namespace codesign::cli
