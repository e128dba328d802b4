// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "edited_text.h"

#include <regex>

namespace codesign {

std::string replaced_all(const std::string& text, const std::string& expression,
                         const std::string& by) {
  return std::regex_replace(text, std::regex(expression), by);
}

std::vector<std::string> matches_in(const std::string& text, const std::string& expression,
                                    int group) {
  const std::regex pattern(expression);
  return {std::sregex_token_iterator(text.begin(), text.end(), pattern, group), {}};
}

bool is_match(const std::string& text, const std::string& expression) {
  return std::regex_match(text, std::regex(expression));
}

}  // namespace codesign
