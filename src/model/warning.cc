// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/model/warning.h"

#include <algorithm>

namespace codesign {

Warning warn(const std::string& code, const InputFault& fault) { return {code, InputError(fault).what(), fault.where}; }

void append(const Warnings& more, Warnings* warnings) {
  for (const Warning& warning : more) {
    const auto same = [&](const Warning& known) { return known.code == warning.code && known.message == warning.message; };
    if (std::none_of(warnings->begin(), warnings->end(), same)) warnings->push_back(warning);
  }
}

}  // namespace codesign
