// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "jobs/json.h"
#include "reading/urdf/pictures.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign::cli {

int urdf(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments);
  std::string text = write_tuned_urdf(problem.urdf(), problem.overlays(), problem.parameters(), std::nullopt, problem.robot().laws);
  if (arguments.sticks) text = with_sticks(text);
  if (!arguments.json) console.out << text;
  Json object;
  object["model"] = problem.robot().name;
  object["parameters"] = parameters_json(problem, problem.parameters());
  object["urdf"] = text;
  add_warnings(arguments, problem, {}, &object, console);
  return finish(arguments, Status(), std::move(object), console);
}

}  // namespace codesign::cli
