// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/told_once.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace codesign {
namespace {

/// Takes the text from `begin` to the end of `end` out, wherever it stands.
std::string without(std::string text, const std::string& begin, const std::string& end) {
  for (std::size_t from = text.find(begin); from != std::string::npos;
       from = text.find(begin, from)) {
    const std::size_t to = text.find(end, from + begin.size());
    if (to == std::string::npos) break;
    text.erase(from, to + end.size() - from);
  }
  return text;
}

/// The message `FILE:LINE: ELEMENT: MESSAGE (value: VALUE, allowed: ALLOWED)` without file, line,
/// names in the element, value and allowed.
std::string kind_of(const Warning& warning) {
  const std::string place = warning.where.file + ":" + std::to_string(warning.where.line) + ": ";
  std::string text = warning.message;
  if (text.rfind(place, 0) == 0) text.erase(0, place.size());
  for (const char* end : {" (value: ", " (allowed: "})
    text.erase(std::min(text.rfind(end), text.size()));
  // A name in the message itself stands in other marks.
  return without(text, " name=\"", "\">");
}

struct Further {
  int count = 0, last_line = 0;
};

}  // namespace

Warnings told_once(const Warnings& warnings) {
  Warnings first;
  std::vector<Further> further;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> known;
  for (const Warning& warning : warnings) {
    const auto [place, is_new] = known.emplace(
        std::make_tuple(warning.code, kind_of(warning), warning.where.file), first.size());
    if (is_new || warning.where.file.empty()) {
      first.push_back(warning);
      further.emplace_back();
      continue;
    }
    Further& more = further[place->second];
    ++more.count;
    more.last_line = warning.where.line;
  }
  for (std::size_t k = 0; k < first.size(); ++k)
    if (further[k].count > 0)
      first[k].message += "; the same at " + std::to_string(further[k].count) +
                          (further[k].count == 1 ? " further place" : " further places") +
                          " of this file, the last in line " + std::to_string(further[k].last_line);
  return first;
}

}  // namespace codesign
