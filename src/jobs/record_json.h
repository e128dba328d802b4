// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "jobs/fields.h"
#include "jobs/json.h"
#include "text/number_text.h"

namespace codesign {

/// How a number is written that JSON does not have. A document has null for infinity and NaN, as
/// to_text() writes them; a record that is read back has them as text.
enum class NonFinite { kNull, kText };

template <NonFinite non_finite = NonFinite::kNull, class Record>
Json record_json(const Record& record);
template <NonFinite non_finite = NonFinite::kNull, class Record>
Json records_json(const std::vector<Record>& records);

/// A number as a record has it, and back. @throws Json::exception or std::invalid_argument if it
/// is none.
template <NonFinite non_finite = NonFinite::kNull>
Json number_to_json(double value) {
  return non_finite == NonFinite::kNull || std::isfinite(value) ? Json(value)
                                                                : Json(to_decimal(value));
}
double to_number(const Json& json);

namespace internal {

template <NonFinite non_finite>
Json value_json(double value) {
  return number_to_json<non_finite>(value);
}
template <NonFinite non_finite, class T>
Json value_json(const T& value) {
  if constexpr (std::is_constructible_v<Json, const T&>)
    return Json(value);
  else
    return record_json<non_finite>(value);
}
template <NonFinite non_finite>
Json value_json(const OrNull& number) {
  return number.is_null ? Json() : Json(number.value);
}
template <NonFinite non_finite>
Json value_json(const std::vector<std::string>& texts) {
  return texts;
}
template <NonFinite non_finite>
Json value_json(const std::vector<double>& numbers) {
  return numbers;
}
template <NonFinite non_finite>
Json value_json(const Eigen::MatrixXd& matrix) {
  return rows_json(matrix);
}
template <NonFinite non_finite, class Record>
Json value_json(const std::vector<Record>& records) {
  return records_json<non_finite>(records);
}

template <NonFinite non_finite, class T>
void set_value(const char* name, const T& value, Json* object) {
  (*object)[name] = value_json<non_finite>(value);
}
template <NonFinite non_finite, class T>
void set_value(const char* name, const UnlessEmpty<T>& value, Json* object) {
  if (!value.value.empty()) (*object)[name] = value.value;
}
template <NonFinite non_finite, class T>
void set_value(const char* name, const std::optional<T>& value, Json* object) {
  if (value) (*object)[name] = value_json<non_finite>(*value);
}

inline void read_value(const Json& json, double* value) { *value = to_number(json); }
template <class T>
void read_value(const Json& json, T* value) {
  *value = json.get<T>();
}

template <class Get, class Record>
void read_field(const Field<Get>& row, const Json& object, Record* record) {
  using Value = std::invoke_result_t<Get, Record&>;
  if constexpr (std::is_lvalue_reference_v<Value> &&
                !std::is_const_v<std::remove_reference_t<Value>>)
    read_value(object.at(row.name), &row.of(*record));
}
template <class Record>
void read_field(const WordField<Record>& row, const Json& object, Record* record) {
  const auto text = object.at(row.name).template get<std::string>();
  if (text != row.if_true && text != row.if_false)
    throw std::invalid_argument(std::string("unknown ") + row.name + ": " + text);
  record->*row.member = text == row.if_true;
}

}  // namespace internal

/// Sets the fields of a result in an object.
template <NonFinite non_finite = NonFinite::kNull, class Record>
void add_fields(const Record& record, Json* object) {
  for_each_field<Record>(
      [&](const auto& row) { internal::set_value<non_finite>(row.name, row.of(record), object); });
}

/// An object with the fields of a result.
template <NonFinite non_finite, class Record>
Json record_json(const Record& record) {
  Json object = Json::object();
  add_fields<non_finite>(record, &object);
  return object;
}

/// A list of them.
template <NonFinite non_finite, class Record>
Json records_json(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(record_json<non_finite>(record));
  return list;
}

/// The result whose object is given, as record_json<NonFinite::kText>() wrote it: all its fields
/// that can be set. @throws Json::exception or std::invalid_argument for another object.
template <class Record>
Record read_record(const Json& object) {
  Record record;
  for_each_field<Record>([&](const auto& row) { internal::read_field(row, object, &record); });
  return record;
}
template <class Record>
std::vector<Record> read_records(const Json& list) {
  std::vector<Record> records;
  for (const Json& one : list) records.push_back(read_record<Record>(one));
  return records;
}

}  // namespace codesign
