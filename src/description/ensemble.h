// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

// The blocks of a study about several runs of one design, about parameters that are not known
// exactly, and about several starts of the search; doc/study.md describes the blocks.

struct Study;

/// Points in the open unit cube (0, 1)^d: pseudo-random, a Latin hypercube, or a scrambled Sobol
/// sequence.
enum class SamplerKind { kSobol, kLatinHypercube, kRandom };
constexpr std::array<const char*, 3> kSamplerNames{"sobol", "latin_hypercube", "random"};

/// How an uncertain quantity is distributed.
enum class DistributionKind {
  kUniform,  ///< between `lower` and `upper`
  kNormal,   ///< mean and standard deviation, truncated to [lower, upper]
  kChoice    ///< one of a few values or names, each equally likely
};

/// The distribution of one number.
struct Distribution {
  DistributionKind kind = DistributionKind::kUniform;
  /// kNormal; a deviation of zero: the mean, within the bounds
  double mean = 0.0, deviation = 0.0;
  double lower = -std::numeric_limits<double>::infinity();  ///< kUniform; truncation of kNormal
  double upper = std::numeric_limits<double>::infinity();   ///< likewise
  /// kChoice; for friction laws, the indices of `laws` of UncertainQuantity
  std::vector<double> choices;
};

/// How the mean of a normal distribution moves with another number, x_j: by slope (x_j - mean of
/// x_j).
struct MeanSlope {
  /// j, an earlier entry of the list of uncertain quantities, with a normal distribution
  std::size_t quantity = 0;
  double slope = 0.0;
};

/// One entry of `uncertain:`: a parameter of the model or the study that is not tuned, or the
/// friction law of all joints.
struct UncertainQuantity {
  std::string name;    ///< of the parameter; "friction_law" for the law
  int parameter = -1;  ///< index in Study::parameters; -1: the friction law
  Distribution distribution;
  /// names of the friction laws to choose from; empty for a parameter
  std::vector<std::string> laws;
  SourceLocation where;
  /// For a number that depends on others: `distribution` is its distribution given these others;
  /// doc/theory.md (24h).
  std::vector<MeanSlope> slopes{};
  bool is_identified = false;  ///< from a file that an identification wrote
  double spread = 0.0;         ///< for an identified number: its marginal standard deviation
};

/// The measure that is minimized over all runs and samples psi_i with weights w_i, sum 1.
enum class RobustMeasure {
  kMean,              ///< sum w_i psi_i
  kWorst,             ///< max psi_i
  kCvar,              ///< mean of the worst fraction 1 - level (conditional value at risk)
  kMeanPlusDeviation  ///< mean + factor * standard deviation
};
constexpr std::array<const char*, 4> kRobustMeasureNames{"mean", "worst", "cvar",
                                                         "mean_plus_deviation"};

/// The treatment of a sample that cannot be integrated.
enum class FailedSamples {
  kRefuse,  ///< the trial point is refused
  /// The sample counts as the worst of the others, with its weight; at most the fraction
  /// (1 - level) may fail.
  kTail
};
constexpr std::array<const char*, 2> kFailedSamplesNames{"refuse", "tail"};

/// The block `robust:`.
struct RobustOptions {
  RobustMeasure measure = RobustMeasure::kMean;
  double level = 0.9;   ///< of kCvar, in (0, 1)
  double factor = 1.0;  ///< of kMeanPlusDeviation, 0 or more
  int samples = 32;     ///< per run, at least 1; 1 if nothing is uncertain
  SamplerKind sampler = SamplerKind::kSobol;
  std::uint32_t seed = 1;
  int validate = 0;  ///< fresh samples at the optimum; 0: none
  FailedSamples failed = FailedSamples::kRefuse;
  SourceLocation where;
  /// Of kWorst: the number of each scenario's group, from 0, whose weighted mean is one of the
  /// values; empty: each scenario is one. No file gives them.
  std::vector<int> groups{};
};

/// One entry of `runs:`: a change of the study.
struct RunDescription {
  std::string name;
  double weight = 1.0;                              ///< positive; relative to the other runs
  std::vector<std::pair<std::string, double>> set;  ///< values of parameters that are not tuned
  /// the study with the run's changes; null if it changes only `set`
  std::shared_ptr<const Study> study;
  SourceLocation where;
};

/// The block `multistart:`.
struct MultistartOptions {
  int starts = 0;  ///< local searches; 0: no multistart
  SamplerKind sampler = SamplerKind::kSobol;
  std::uint32_t seed = 1;
  int screen = 0;  ///< points whose objective is evaluated to choose the starts; at least `starts`
  double cluster = 1e-4;  ///< results nearer than this in scaled parameters count as one optimum
  SourceLocation where;
};

/// How evaluations are spread.
enum class EngineKind {
  kSerial,
  kThreads,
  kMpi  ///< over the processes that mpirun has started
};
constexpr std::array<const char*, 3> kEngineNames{"serial", "threads", "mpi"};
struct EngineOptions {
  EngineKind kind = EngineKind::kThreads;
  int workers = 0;  ///< of kThreads; 0: one per processor
  /// place of `engine:` in the study; an empty file if the study has none: under mpirun the engine
  /// is then kMpi
  SourceLocation where{};
};

/// Everything of a study that is about more than one run.
struct EnsembleDescription {
  std::vector<RunDescription> runs;
  std::vector<UncertainQuantity> uncertain;
  std::optional<RobustOptions> robust;  ///< set exactly if is_ensemble()
  MultistartOptions multistart;
  EngineOptions engine;

  /// Whether an evaluation of the objective consists of more than the study's own run.
  bool is_ensemble() const { return !runs.empty() || !uncertain.empty(); }
  /// `robust`, or its defaults.
  RobustOptions robust_options() const { return robust.value_or(RobustOptions{}); }
};

}  // namespace codesign
