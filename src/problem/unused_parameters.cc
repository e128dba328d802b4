// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/unused_parameters.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace codesign {
namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Adds every word (letters, digits, underscores) inside `${...}` to `words`.
void collect_words(const std::string& text, std::set<std::string>* words) {
  for (std::size_t at = text.find("${"); at != std::string::npos; at = text.find("${", at)) {
    const std::size_t end = std::min(text.find('}', at), text.size());
    for (at += 2; at < end;) {
      std::size_t after = at;
      while (after < end && is_letter(text[after])) ++after;
      if (after > at) words->insert(text.substr(at, after - at));
      at = std::max(after, at + 1);
    }
  }
}

/// The parameters that `basis` controllers declare as their coefficients; they are used although no `${...}` names them.
std::set<int> coefficients_of(const Study& study) {
  std::set<int> indices;
  for (const ControllerDescription& controller : study.controllers)
    for (const Quantity& coefficient : controller.basis.coefficients)
      if (!coefficient.is_constant())
        indices.insert(coefficient.expression()->dependencies().begin(), coefficient.expression()->dependencies().end());
  return indices;
}

}  // namespace

Warnings unused_parameters(const Problem::Contents& texts, const Study& study) {
  std::set<std::string> words;
  collect_words(texts.urdf.text, &words);
  for (const SourceText& overlay : texts.overlays) collect_words(overlay.text, &words);
  collect_words(texts.study_text.text, &words);
  const std::set<int> coefficients = coefficients_of(study);
  Warnings warnings;
  for (int index : study.tuned) {
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(index)];
    if (words.count(parameter.name) > 0 || coefficients.count(index) > 0) continue;
    warnings.push_back(
        warn("unused_parameter", {parameter.where, "parameter " + parameter.name,
                                  "nothing in the model or the study depends on this parameter, which is to be tuned; write ${" +
                                      parameter.name + "} where it belongs, or take it out of the study's parameters",
                                  "", ""}));
  }
  return warnings;
}

}  // namespace codesign
