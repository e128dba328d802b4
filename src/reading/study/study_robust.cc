// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_robust.h"

#include "reading/study/study_fields.h"

namespace codesign {
namespace {

constexpr int kMostSamples = 100000, kMostValidated = 1000000;

void read_level(const YamlValue& robust, RobustOptions* options) {
  const auto level = robust.find("level");
  if (!level) return;
  if (options->measure != RobustMeasure::kCvar) level->fail("level belongs to cvar", "measure: cvar");
  options->level = level->number();
  if (!(options->level > 0.0 && options->level < 1.0)) level->fail("level out of range", "more than 0 and less than 1");
}

void read_factor(const YamlValue& robust, RobustOptions* options) {
  const auto factor = robust.find("factor");
  if (!factor) return;
  if (options->measure != RobustMeasure::kMeanPlusDeviation)
    factor->fail("factor belongs to mean_plus_deviation", "measure: mean_plus_deviation");
  options->factor = factor->number();
  if (options->factor < 0.0) factor->fail("factor out of range", "0 or more");
}

/// Runs alone are not sampled.
void refuse_samples(const YamlValue& robust) {
  for (const char* key : {"samples", "sampler", "seed", "validate"})
    if (const auto value = robust.find(key))
      value->fail(std::string(key) + " has no meaning without uncertain: nothing is sampled", "with the block uncertain only");
}

}  // namespace

RobustOptions read_robust(const YamlValue& robust, const EnsembleDescription& ensemble) {
  robust.require_keys({}, {"measure", "level", "factor", "samples", "sampler", "seed", "validate", "failed"});
  if (!ensemble.is_ensemble())
    robust.fail("there is nothing to be robust against: the study has neither uncertain nor runs", "with the block uncertain or runs");
  RobustOptions options = default_robust(ensemble, robust.where());
  if (ensemble.uncertain.empty()) refuse_samples(robust);
  read_choice(robust, "measure", kRobustMeasureNames, &options.measure);
  read_level(robust, &options);
  read_factor(robust, &options);
  read_whole(robust, "samples", 1, kMostSamples, &options.samples);
  read_sampler(robust, &options.sampler, &options.seed);
  read_whole(robust, "validate", 0, kMostValidated, &options.validate);
  read_choice(robust, "failed", kFailedSamplesNames, &options.failed);
  return options;
}

RobustOptions default_robust(const EnsembleDescription& ensemble, const SourceLocation& where) {
  RobustOptions options;
  options.where = where;
  if (ensemble.uncertain.empty()) options.samples = 1;
  return options;
}

}  // namespace codesign
