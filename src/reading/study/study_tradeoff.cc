// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <string>

#include "description/expression_syntax.h"
#include "reading/study/study_blocks.h"

namespace codesign {
namespace {

constexpr std::size_t kFewestObjectives = 2, kMostObjectives = 3;
constexpr const char* kForm = "{name: NAME, objective: {...}}";

std::string read_name(const YamlValue& item, const std::vector<TradeoffObjective>& before) {
  const YamlValue name = item.at("name");
  std::string text = name.text();
  const bool is_word = !text.empty() && std::all_of(text.begin(), text.end(), continues_identifier);
  if (!is_word)
    name.fail("not a name for an objective, which heads a column",
              "letters, digits and underscores");
  for (const TradeoffObjective& other : before)
    if (other.name == text) name.fail("two objectives have the same name", "another name");
  return text;
}

}  // namespace

std::vector<TradeoffObjective> read_tradeoff(const YamlValue& study_value,
                                             const RobotDescription& robot,
                                             const RunReader& read_run, const FileLoader& files,
                                             const Study& study) {
  const YamlValue tradeoff = study_value.at("tradeoff");
  if (const auto objective = study_value.find("objective"))
    objective->fail("a study with tradeoff has no objective besides those of the list",
                    "objective or tradeoff");
  if (study_value.find("identify"))
    tradeoff.fail("what is identified minimizes the residuals, and has no other objective",
                  "tradeoff or identify");
  const std::vector<YamlValue> items = tradeoff.items();
  if (items.size() < kFewestObjectives || items.size() > kMostObjectives)
    tradeoff.fail("found " + std::to_string(items.size()) + " objectives",
                  std::string("two or three, each ") + kForm);
  std::vector<TradeoffObjective> result;
  for (const YamlValue& item : items) {
    item.require_keys({"name", "objective"}, {});
    TradeoffObjective one;
    one.name = read_name(item, result);
    one.where = item.where();
    const YamlValue whole = study_value.merged(item);
    auto read = std::make_shared<Study>(read_run(whole));
    if (!has_objective(*read))
      item.at("objective").fail("the objective has no term", "at least one term");
    read->base_is_given = study.base_is_given;
    read->ensemble = read_ensemble(whole, robot, read_run, files, *read);
    one.study = std::move(read);
    result.push_back(std::move(one));
  }
  return result;
}

}  // namespace codesign
