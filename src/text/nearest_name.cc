// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace codesign {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Optimal string alignment distance. A row of its table depends on the two rows before it only.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  // Bounds the time spent on one error message, however many and however long the names in a file
  // or a request are.
  constexpr std::size_t kLongest = 100, kMostLetterPairs = 20000000;
  if (name.size() > kLongest) return "";
  const std::string wanted = lower_case(name);
  std::string nearest;
  std::size_t fewest = 0, letter_pairs = 0;
  for (const std::string& candidate : known) {
    const std::size_t longer = std::max(name.size(), candidate.size()),
                      allowed = std::max<std::size_t>(2, longer / 3);
    if (longer > kLongest || longer - std::min(name.size(), candidate.size()) > allowed) continue;
    letter_pairs += name.size() * candidate.size();
    if (letter_pairs > kMostLetterPairs) break;
    const std::size_t distance = edit_distance(wanted, lower_case(candidate));
    const bool near = distance < longer && distance <= allowed;
    if (near && (nearest.empty() || distance < fewest)) {
      nearest = candidate;
      fewest = distance;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& near) {
  return near.empty() ? "" : ", did you mean \"" + near + "\"?";
}

std::string list_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 24;
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += ", ";
    if (i == kMost) return list + "...";
    list += names[i];
  }
  return list.empty() ? "there are none" : list;
}

InputError unknown_name(const SourceLocation& where, const std::string& element,
                        const std::string& kind, const std::string& name,
                        const std::vector<std::string>& known) {
  const std::string near = nearest_name(name, known);
  const std::string message = "unknown " + kind + did_you_mean(near);
  return InputError({where, element, message, name, list_names(known)});
}

}  // namespace codesign
