// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/warning.h"

#include <set>
#include <utility>

namespace codesign {

Warning warn(const std::string& code, const InputFault& fault) { return {code, InputError(fault).what(), fault.where}; }

void append(const Warnings& more, Warnings* warnings) {
  std::set<std::pair<std::string, std::string>> known;
  for (const Warning& warning : *warnings) known.emplace(warning.code, warning.message);
  for (const Warning& warning : more)
    if (known.emplace(warning.code, warning.message).second) warnings->push_back(warning);
}

}  // namespace codesign
