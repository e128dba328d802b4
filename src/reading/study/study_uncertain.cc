// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "description/robot.h"
#include "math/arrays.h"
#include "reading/study/entry_keys.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kFrictionLaw = "friction_law";
constexpr const char* kFrom = "from";
constexpr const char* kForms =
    "one of uniform: [lower, upper], normal: [mean, deviation], choice: [a, b]";

std::array<YamlValue, 2> pair_at(const YamlValue& value, const std::string& names) {
  const std::vector<YamlValue> items = value.items();
  if (items.size() != 2)
    value.fail("two numbers are needed, found " + std::to_string(items.size()), "[" + names + "]");
  return {items[0], items[1]};
}

void read_interval(const YamlValue& value, const Parameter& parameter, Distribution* distribution) {
  const std::array<YamlValue, 2> range = pair_at(value, "lower, upper");
  distribution->lower = read_within_bounds(range[0], parameter);
  distribution->upper = read_within_bounds(range[1], parameter);
  if (!(distribution->lower < distribution->upper))
    range[0].fail("the lower end must lie below the upper one", "lower < upper");
}

/// Truncated to the bounds of the parameter, unless `between` says more.
void read_normal(const YamlValue& value, const Parameter& parameter, Distribution* distribution) {
  const std::array<YamlValue, 2> numbers = pair_at(value, "mean, deviation");
  distribution->kind = DistributionKind::kNormal;
  distribution->mean = read_within_bounds(numbers[0], parameter);
  distribution->deviation = numbers[1].number();
  if (!(distribution->deviation > 0.0))
    numbers[1].fail("the standard deviation must be positive", "more than 0");
  distribution->lower = parameter.lower;
  distribution->upper = parameter.upper;
}

void require_mean_inside(const YamlValue& normal, const Distribution& distribution) {
  if (distribution.mean < distribution.lower || distribution.mean > distribution.upper)
    pair_at(normal, "mean, deviation")[0].fail(
        "the mean lies outside the range to which the distribution is truncated",
        "[" + to_decimal(distribution.lower) + ", " + to_decimal(distribution.upper) + "]");
}

std::vector<YamlValue> choices_at(const YamlValue& choice) {
  std::vector<YamlValue> items = choice.items();
  if (items.size() < 2)
    choice.fail("found " + std::to_string(items.size()) + " to choose from", "at least two");
  return items;
}

void read_choice_values(const YamlValue& choice, const Parameter& parameter,
                        Distribution* distribution) {
  distribution->kind = DistributionKind::kChoice;
  std::set<double> seen;
  for (const YamlValue& item : choices_at(choice)) {
    distribution->choices.push_back(read_within_bounds(item, parameter));
    if (!seen.insert(distribution->choices.back()).second)
      item.fail("repeated choice", "values that differ; each is equally likely");
  }
}

void require_usable(FrictionModel law, const RobotDescription& robot, const YamlValue& at) {
  for (const JointDescription& joint : robot.joints)
    if (law->divides_by_mu_dynamic && joint.friction && joint.friction->mu_dynamic.nominal() == 0.0)
      at.fail(std::string("the ") + law->title +
                  " model divides by mu_dynamic, which is zero in the joint " + joint.name,
              "laws without states, or mu_dynamic > 0");
}

using DistributionKeys = EntryKeys<Distribution, Parameter>;
using FrictionLawKeys = EntryKeys<UncertainQuantity, RobotDescription>;

/// `between` narrows what `normal` has read.
const DistributionKeys& distribution_keys() {
  static const DistributionKeys kKeys{{"uniform", false, read_interval},
                                      {"normal", false, read_normal},
                                      {"between", false, read_interval},
                                      {"choice", false, read_choice_values}};
  return kKeys;
}

void read_law_choice(const YamlValue& choice, const RobotDescription& robot,
                     UncertainQuantity* quantity) {
  quantity->distribution.kind = DistributionKind::kChoice;
  for (const YamlValue& item : choices_at(choice)) {
    const std::string law = item.choice("friction law", names_of(robot.laws.friction));
    if (std::find(quantity->laws.begin(), quantity->laws.end(), law) != quantity->laws.end())
      item.fail("repeated choice", "laws that differ; each is equally likely");
    require_usable(*find_friction(robot.laws, law), robot, item);
    quantity->distribution.choices.push_back(static_cast<double>(quantity->laws.size()));
    quantity->laws.push_back(law);
  }
}

const FrictionLawKeys& friction_law_keys() {
  static const FrictionLawKeys kKeys{{"choice", true, read_law_choice}};
  return kKeys;
}

void read_laws(const YamlValue& value, const RobotDescription& robot, UncertainQuantity* quantity) {
  require_keys(value, friction_law_keys());
  if (std::none_of(robot.joints.begin(), robot.joints.end(),
                   [](const JointDescription& joint) { return joint.friction.has_value(); }))
    value.fail("no joint of the model has friction", "a model with <codesign:friction>");
  read_entry(value, friction_law_keys(), robot, quantity);
}

void read_distribution(const YamlValue& value, const Parameter& parameter,
                       Distribution* distribution) {
  require_keys(value, distribution_keys());
  const auto normal = value.find("normal"), between = value.find("between");
  if (value.find("uniform").has_value() + normal.has_value() + value.find("choice").has_value() !=
      1)
    value.fail("a parameter has one distribution", kForms);
  if (between && !normal) between->fail("between belongs to normal", kForms);
  read_entry(value, distribution_keys(), parameter, distribution);
  if (normal) require_mean_inside(*normal, *distribution);
}

void refuse_set_by_run(const std::string& name, const YamlValue& value,
                       const std::vector<RunDescription>& runs) {
  for (const RunDescription& run : runs)
    for (const auto& set : run.set)
      if (set.first == name)
        throw InputError(
            {value.where(), value.path(),
             "the run \"" + run.name + "\" sets this parameter, so it cannot be uncertain", name,
             "a parameter that no run sets"});
}

UncertainQuantity read_quantity_entry(const std::string& name, const YamlValue& value,
                                      const RobotDescription& robot, const Study& study) {
  const std::vector<Parameter>& all = study.parameters;
  const bool is_parameter =
      std::any_of(all.begin(), all.end(),
                  [&name](const Parameter& parameter) { return parameter.name == name; });
  UncertainQuantity quantity;
  quantity.name = name;
  quantity.where = value.where();
  if (name == kFrictionLaw && !is_parameter) {
    read_laws(value, robot, &quantity);
    return quantity;
  }
  quantity.parameter = untuned_parameter(name, study, value, {kFrictionLaw, kFrom});
  read_distribution(value, all[to_index(quantity.parameter)], &quantity.distribution);
  return quantity;
}

/// Whether an entry names a file with distributions. A parameter of that name takes precedence.
bool is_file(const std::string& name, const YamlValue& value, const Study& study) {
  const std::vector<std::string> known = names_of(study.parameters);
  const bool is_parameter = std::find(known.begin(), known.end(), kFrom) != known.end();
  return name == kFrom && !(is_parameter && value.is_map() && !value.find("file"));
}

}  // namespace

std::vector<EntryForm> forms_of_uncertain() {
  return {{"uncertain.NAME", distribution_keys()}, {"uncertain.friction_law", friction_law_keys()}};
}

std::vector<UncertainQuantity> read_uncertain(const YamlValue& uncertain,
                                              const RobotDescription& robot, const Study& study,
                                              const std::vector<RunDescription>& runs,
                                              const FileLoader& files) {
  std::set<std::string> own;
  for (const auto& [name, value] : uncertain.entries()) own.insert(name);
  std::vector<UncertainQuantity> quantities;
  for (const auto& [name, value] : uncertain.entries()) {
    if (!is_file(name, value, study)) {
      quantities.push_back(read_quantity_entry(name, value, robot, study));
      refuse_set_by_run(name, value, runs);
      continue;
    }
    for (UncertainQuantity& identified :
         read_identified(value, study, own, files, quantities.size())) {
      refuse_set_by_run(identified.name, value, runs);
      quantities.push_back(std::move(identified));
    }
  }
  if (quantities.empty())
    uncertain.fail("nothing is uncertain", "at least one PARAMETER: {uniform: [lower, upper]}");
  return quantities;
}

}  // namespace codesign
