// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "jobs/fields.h"
#include "jobs/json.h"

namespace codesign {

/// The JSON schema of an object with the fields of a result, as record_json() writes it: type and
/// meaning of each, and which are always there.
template <class Record>
Json record_schema();

namespace internal {

/// What a value is in JSON. Types that have rows are objects.
template <class T>
struct ValueSchema {
  static Json make(bool is_finite) {
    if constexpr (std::is_same_v<T, bool>)
      return {{"type", "boolean"}};
    else if constexpr (std::is_integral_v<T>)
      return {{"type", "integer"}};
    else if constexpr (std::is_floating_point_v<T>)
      return {{"type", is_finite ? Json("number") : Json({"number", "null"})}};
    else if constexpr (std::is_convertible_v<T, std::string>)
      return {{"type", "string"}};
    else
      return record_schema<T>();
  }
};
template <>
struct ValueSchema<OrNull> : ValueSchema<double> {};
template <class T>
struct ValueSchema<UnlessEmpty<T>> : ValueSchema<T> {};
template <class T>
struct ValueSchema<std::optional<T>> : ValueSchema<T> {};
template <class T>
struct ListSchema {
  static Json make(bool is_finite) {
    return {{"type", "array"}, {"items", ValueSchema<T>::make(is_finite)}};
  }
};
template <class T>
struct ValueSchema<std::vector<T>> : ListSchema<T> {};
template <class T, std::size_t n>
struct ValueSchema<std::array<T, n>> : ListSchema<T> {};
template <>
struct ValueSchema<Eigen::MatrixXd> : ListSchema<std::vector<double>> {};

template <class T>
struct MayBeAbsent : std::false_type {};
template <class T>
struct MayBeAbsent<UnlessEmpty<T>> : std::true_type {};
template <class T>
struct MayBeAbsent<std::optional<T>> : std::true_type {};

template <class Record, class Get>
void add_schema(const Field<Get>& row, Json* properties, Json* required) {
  using Value = std::decay_t<std::invoke_result_t<Get, const Record&>>;
  Json schema = ValueSchema<Value>::make(row.is_finite);
  schema["description"] = row.meaning;
  (*properties)[row.name] = std::move(schema);
  if (!MayBeAbsent<Value>::value && !row.may_be_absent) required->push_back(row.name);
}
template <class Record>
void add_schema(const WordField<Record>& row, Json* properties, Json* required) {
  (*properties)[row.name] = {{"enum", {row.if_true, row.if_false}}, {"description", row.meaning}};
  required->push_back(row.name);
}

}  // namespace internal

template <class Record>
Json record_schema() {
  Json properties = Json::object(), required = Json::array();
  for_each_field<Record>(
      [&](const auto& row) { internal::add_schema<Record>(row, &properties, &required); });
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"additionalProperties", false},
          {"required", std::move(required)}};
}

}  // namespace codesign
