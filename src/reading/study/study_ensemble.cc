// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <optional>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "reading/study/study_options.h"

namespace codesign {
namespace {

void refuse_key(const YamlValue& robust, const char* key, const std::string& measure) {
  if (const auto value = robust.find(key))
    value->fail(std::string(key) + " belongs to " + measure, "measure: " + measure);
}

/// Runs alone are not sampled.
void refuse_samples(const YamlValue& robust) {
  for (const char* key : {"samples", "sampler", "seed", "validate"})
    if (const auto value = robust.find(key))
      value->fail(std::string(key) + " has no meaning without uncertain: nothing is sampled",
                  "with the block uncertain only");
}

/// The default without `robust:`: the mean, over 32 samples if something is uncertain, else over
/// the runs. @param where for messages.
RobustOptions default_robust(const EnsembleDescription& ensemble, const SourceLocation& where) {
  RobustOptions options;
  options.where = where;
  if (ensemble.uncertain.empty()) options.samples = 1;
  return options;
}

RobustOptions read_robust(const YamlValue& robust, const EnsembleDescription& ensemble) {
  require_option_keys(robust, RobustOptions());
  if (!ensemble.is_ensemble())
    robust.fail("there is nothing to be robust against: the study has neither uncertain nor runs",
                "with the block uncertain or runs");
  RobustOptions options = default_robust(ensemble, robust.where());
  if (ensemble.uncertain.empty()) refuse_samples(robust);
  const OptionReader reader{robust};
  reader("measure", kRobustMeasureNames, options.measure);
  if (options.measure != RobustMeasure::kCvar) refuse_key(robust, "level", "cvar");
  if (options.measure != RobustMeasure::kMeanPlusDeviation)
    refuse_key(robust, "factor", "mean_plus_deviation");
  visit_options(reader, &options);
  return options;
}

/// The parameter as the study names it; the coefficients of a `basis` controller are declared
/// elsewhere.
void require_bounds(const YamlValue& study_value, const Parameter& parameter) {
  const std::optional<InputFault> fault = find_missing_bounds(parameter);
  if (!fault) return;
  const auto parameters = study_value.find("parameters");
  if (const auto value = parameters ? parameters->find(parameter.name) : std::nullopt)
    value->fail(fault->message, fault->allowed);
  throw InputError(*fault);
}

MultistartOptions read_multistart(const YamlValue& study_value, const Study& study) {
  const YamlValue multistart = study_value.at("multistart");
  require_option_keys(multistart, MultistartOptions(), {"starts"});
  if (study.tuned.empty())
    multistart.fail("the study tunes nothing, so there is nothing to search for",
                    "with tuned parameters only");
  MultistartOptions options;
  options.where = multistart.where();
  visit_options(OptionReader{multistart}, &options);
  if (!multistart.find("screen")) options.screen = 4 * options.starts;
  for (int index : study.tuned) require_bounds(study_value, study.parameters[to_index(index)]);
  return options;
}

EngineOptions read_engine(const YamlValue& engine) {
  EngineOptions options;
  require_option_keys(engine, options);
  const OptionReader reader{engine};
  reader("type", kEngineNames, options.kind);
  const auto type = engine.find("type"), workers = engine.find("workers");
  if (type || workers) options.where = (type ? type : workers)->where();
  if (workers && options.kind == EngineKind::kSerial)
    workers->fail("the engine serial has no workers", "type: threads");
  if (workers && options.kind == EngineKind::kMpi)
    workers->fail("mpirun says how many workers the engine mpi has", "mpirun -n NUMBER");
  visit_options(reader, &options);
  return options;
}

}  // namespace

EnsembleDescription read_ensemble(const YamlValue& study_value, const RobotDescription& robot,
                                  const RunReader& read_run, const FileLoader& files,
                                  const Study& study) {
  EnsembleDescription ensemble;
  const auto runs = study_value.find("runs"), uncertain = study_value.find("uncertain"),
             robust = study_value.find("robust");
  if (runs) ensemble.runs = read_runs(study_value, study, read_run, files);
  if (uncertain)
    ensemble.uncertain = read_uncertain(*uncertain, robot, study, ensemble.runs, files);
  if (robust)
    ensemble.robust = read_robust(*robust, ensemble);
  else if (ensemble.is_ensemble())
    ensemble.robust = default_robust(ensemble, uncertain ? uncertain->where() : runs->where());
  if (study_value.find("multistart")) ensemble.multistart = read_multistart(study_value, study);
  if (const auto engine = study_value.find("engine")) ensemble.engine = read_engine(*engine);
  return ensemble;
}

}  // namespace codesign
