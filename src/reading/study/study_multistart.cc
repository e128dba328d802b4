// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_multistart.h"

#include <optional>

#include "description/tuned_parameters.h"
#include "reading/study/study_fields.h"

namespace codesign {
namespace {

constexpr int kMostStarts = 100000, kMostScreened = 10000000;

/// The parameter as the study names it; the coefficients of a `basis` controller are declared elsewhere.
void require_bounds(const YamlValue& study_value, const Parameter& parameter) {
  const std::optional<InputFault> fault = find_missing_bounds(parameter);
  if (!fault) return;
  const auto parameters = study_value.find("parameters");
  if (const auto value = parameters ? parameters->find(parameter.name) : std::nullopt) value->fail(fault->message, fault->allowed);
  throw InputError(*fault);
}

}  // namespace

MultistartOptions read_multistart(const YamlValue& study_value, const Study& study) {
  const YamlValue multistart = study_value.at("multistart");
  multistart.require_keys({"starts"}, {"sampler", "seed", "screen", "cluster"});
  if (study.tuned.empty()) multistart.fail("the study tunes nothing, so there is nothing to search for", "with tuned parameters only");
  MultistartOptions options;
  options.where = multistart.where();
  read_whole(multistart, "starts", 1, kMostStarts, &options.starts);
  read_sampler(multistart, &options.sampler, &options.seed);
  options.screen = 4 * options.starts;
  read_whole(multistart, "screen", options.starts, kMostScreened, &options.screen);
  if (const auto cluster = multistart.find("cluster")) {
    options.cluster = cluster->number();
    if (!(options.cluster > 0.0 && options.cluster < 1.0)) cluster->fail("cluster out of range", "more than 0 and less than 1");
  }
  for (int index : study.tuned) require_bounds(study_value, study.parameters[static_cast<std::size_t>(index)]);
  return options;
}

}  // namespace codesign
