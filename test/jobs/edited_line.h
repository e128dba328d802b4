// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "jobs/json.h"
#include "text/fingerprint.h"

namespace codesign {

/// A line of a journal with other content and the checksum of that content.
template <class Edit>
std::string edited_line(const std::string& line, const Edit& edit) {
  Json object = Json::parse(line);
  object.erase("checksum");
  edit(&object);
  return with_checksum(object.dump());
}

}  // namespace codesign
