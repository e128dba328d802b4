// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/saved_result.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "jobs/json.h"

namespace codesign {
namespace {

constexpr const char* kAllowed = "what codesign optimize writes: {\"parameters\": {NAME: number, ...}, ...}";

int line_at(const std::string& text, std::size_t offset) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n'));
}

/// Where a JSON text has its first number beyond the range of double, for which the parser tells no place.
std::size_t first_overflow(const std::string& text) {
  bool is_in_text = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '"') {
      is_in_text = !is_in_text;
    } else if (is_in_text) {
      k += text[k] == '\\' ? 1 : 0;
    } else if (text[k] >= '0' && text[k] <= '9') {
      char* end = nullptr;
      if (std::isinf(std::strtod(text.c_str() + k, &end))) return k;
      k = static_cast<std::size_t>(end - text.c_str()) - 1;
    }
  }
  return 0;
}

Json parse(const SourceText& source) {
  try {
    return Json::parse(source.text);
  } catch (const Json::parse_error& error) {
    throw InputError({{source.name, line_at(source.text, error.byte)}, "result", "not JSON", "", kAllowed});
  } catch (const Json::out_of_range&) {
    const std::size_t place = first_overflow(source.text), end = source.text.find_first_of(",]} \t\r\n", place);
    throw InputError({{source.name, line_at(source.text, place)},
                      "result",
                      "a number is beyond the range of double",
                      source.text.substr(place, end - place),
                      "magnitudes up to 1.8e308"});
  }
}

}  // namespace

ParameterSettings read_result(const SourceText& json) {
  const Json object = parse(json);
  const auto parameters = object.is_object() ? object.find("parameters") : object.end();
  if (parameters == object.end() || !parameters->is_object())
    throw InputError({{json.name, 1}, "parameters", "the result has no design", "", kAllowed});
  ParameterSettings settings;
  for (const auto& [name, value] : parameters->items()) {
    if (!value.is_number()) {
      const int line = line_at(json.text, json.text.find(Json(name).dump(), json.text.find("\"parameters\"")));
      throw InputError({{json.name, line}, "parameters." + name, "not a number", value.type_name(), "a number"});
    }
    settings.emplace_back(name, value.get<double>());
  }
  return settings;
}

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
