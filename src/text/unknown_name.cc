// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/unknown_name.h"

#include "text/nearest_name.h"

namespace codesign {

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

InputError unknown_name(const SourceLocation& where, const std::string& element, const std::string& kind, const std::string& name,
                        const std::vector<std::string>& known) {
  const std::string near = nearest_name(name, known);
  const std::string message = "unknown " + kind + did_you_mean(near);
  return InputError({where, element, message, name, list_names(known)});
}

}  // namespace codesign
