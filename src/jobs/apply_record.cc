// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/apply_record.h"

#include <utility>

#include "jobs/json.h"

namespace codesign {

std::string apply_text(const ApplyRecord& record) {
  Json object, changes = Json::array();
  for (const ApplyRecord::Change& change : record.changes)
    changes.push_back(
        {{"server", change.server}, {"name", change.name}, {"before", change.before}, {"after", change.after}, {"now", change.now}});
  object["success"] = record.success;
  object["changes"] = std::move(changes);
  object["rollback_seconds"] = record.rollback_seconds;
  if (record.success)
    object["message"] = record.message;
  else
    object["error"] = {{"code", record.code}, {"message", record.message}};
  return to_text(object);
}

}  // namespace codesign
