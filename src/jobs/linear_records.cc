// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/linear_records.h"

#include "jobs/record_json.h"
#include "jobs/result_fields.h"

namespace codesign {
namespace {

Json response_of(const ControllerLoop& loop) {
  Json real = Json::array(), imaginary = Json::array();
  for (const std::complex<double>& value : loop.response) {
    real.push_back(value.real());
    imaginary.push_back(value.imag());
  }
  return {{"frequency", loop.frequencies}, {"real", real}, {"imaginary", imaginary}};
}

}  // namespace

void add_stability(const LinearModel& model, Json* object) {
  (*object)["stability"] = name_of(model.stability);
  (*object)["verdict"] = model.verdict;
  if (model.system.period > 0.0) (*object)["period"] = model.system.period;
  Json modes = Json::array();
  for (const LinearMode& mode : model.modes) {
    Json object_of_mode = record_json(mode);
    if (model.system.period > 0.0) object_of_mode["radius"] = mode.pole.radius(model.system.period);
    object_of_mode["rates"] = by_name(model.joints, mode.rates);
    modes.push_back(std::move(object_of_mode));
  }
  (*object)["modes"] = std::move(modes);
}

void add_matrices(const StateSpace& system, Json* object) { add_fields(system, object); }

Json measured_json(const std::vector<ControllerDescription>& controllers) {
  Json measured = Json::object();
  for (const ControllerDescription& controller : controllers)
    if (controller.kind->has_error()) measured[controller.name] = controller.input.text;
  return measured;
}

Json loops_json(const LinearModel& model) {
  Json loops = Json::object();
  for (const ControllerLoop& loop : model.loops) {
    Json entry = Json::object();
    visit_margins(loop.margins,
                  [&](const char* name, const std::optional<AtFrequency>& margin, const char*) {
                    if (margin) entry[name] = record_json(*margin);
                  });
    if (loop.samples != 1) entry["samples"] = loop.samples;
    entry["response"] = response_of(loop);
    loops[loop.controller] = std::move(entry);
  }
  return loops;
}

}  // namespace codesign
