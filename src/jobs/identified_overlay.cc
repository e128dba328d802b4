// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/identified_overlay.h"

#include <map>
#include <vector>

#include "description/expression.h"
#include "description/robot.h"
#include "description/study.h"
#include "mechanism_codesign/version.h"
#include "reading/urdf/overlay.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr int kDigits = 6;

std::string interval_text(const IdentifiedNumber& number) {
  if (number.is_on_bound) return "on its bound, without an interval";
  if (!number.is_determined) return "not identifiable: the recordings do not determine it";
  std::string text = readable(number.low, kDigits) + " to " + readable(number.high, kDigits) + ", standard deviation " +
                     readable(number.deviation, kDigits);
  if (const auto& profile = number.profile)
    text += "; by its profile " + readable(profile->lower, kDigits) + " to " + readable(profile->upper, kDigits);
  return text;
}

std::string heading(const Problem& problem) {
  return "Identified by codesign identify, version " + std::string(version()) + ", from " + problem.study_text().name + "; intervals of " +
         readable(100.0 * problem.study().identification->intervals.level) + " %. Give this file after the other overlays of the model.";
}

/// A line for each number that only the study can take.
std::string of_the_study(const IdentificationResult& result, const std::map<std::string, const IdentifiedNumber*>& left) {
  std::string lines;
  for (const IdentifiedNumber& number : result.numbers) {
    if (left.count(number.name) == 0) continue;
    const std::size_t slash = number.name.rfind('/');
    const std::string value = to_decimal(number.value);
    std::string place = "identify." + number.name + ": " + value;
    if (identifier_fault(number.name).empty()) place = "parameters: {" + number.name + ": {initial: " + value + "}}";
    if (slash != std::string::npos)
      place = "identify: {joints: {" + number.name.substr(0, slash) + ": {" + number.name.substr(slash + 1) + ": " + value + "}}}";
    lines += "\n       " + place + "   " + interval_text(number);
  }
  return lines.empty() ? "" : "Not of the model; a study takes them so:" + lines;
}

}  // namespace

std::string identified_overlay(const Problem& problem, const IdentificationResult& result) {
  std::map<std::string, const IdentifiedNumber*> numbers;
  for (const IdentifiedNumber& number : result.numbers) numbers[number.name] = &number;
  const std::vector<Parameter>& declared = problem.robot().parameters;
  std::vector<SetValue> values;
  for (std::size_t k = 0; k < declared.size(); ++k) {
    const auto found = numbers.find(declared[k].name);
    if (found == numbers.end() && result.parameters[k] == declared[k].value) continue;
    SetValue set{declared[k], result.parameters[k], "not identified: as the study has it"};
    if (found != numbers.end()) {
      set.comment = interval_text(*found->second) + (declared[k].unit.empty() ? "" : " [" + declared[k].unit + "]");
      numbers.erase(found);
    }
    values.push_back(set);
  }
  return write_set_overlay(problem.robot().name, heading(problem), values, of_the_study(result, numbers));
}

}  // namespace codesign
