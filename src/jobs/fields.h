// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <tuple>
#include <type_traits>

namespace codesign {

// The fields of a result are rows of a table, fields_of(): from them come its JSON and its columns
// of CSV (record_json.h, record_cells.h), its part of the JSON schema (record_schema.h), its line
// of the journal, and its ROS message (ros/common/message_fields.h). A row has a name and says how
// to get the value: by a pointer to a member, or by a function of the result. A value that can be
// set, a member or what a function returns a reference to, is read back from JSON, too.

template <class Get>
struct Field {
  const char* name;
  Get get;
  const char* meaning;         ///< with the unit, for the schema and doc/json.md
  bool is_finite = false;      ///< a number that is never null
  bool may_be_absent = false;  ///< a document may leave it out

  template <class Record>
  decltype(auto) of(Record& record) const {
    return std::invoke(get, record);
  }
  constexpr Field finite() const { return {name, get, meaning, true, may_be_absent}; }
  constexpr Field not_always() const { return {name, get, meaning, is_finite, true}; }
};

template <class Get>
constexpr Field<Get> field(const char* name, Get get, const char* meaning = "") {
  return {name, get, meaning};
}

/// A bool that is one of two words in JSON.
template <class Record>
struct WordField {
  const char* name;
  bool Record::*member;
  const char *if_false, *if_true, *meaning;

  std::string of(const Record& record) const { return record.*member ? if_true : if_false; }
};

template <class Record>
constexpr WordField<Record> word(const char* name, bool Record::*member, const char* if_false,
                                 const char* if_true, const char* meaning = "") {
  return {name, member, if_false, if_true, meaning};
}

/// A number that JSON has as null where it is not known or has no bound; a message has the number.
struct OrNull {
  double value;
  bool is_null;
};

/// A value for JSON that leaves the key out where it is empty.
template <class T>
struct UnlessEmpty {
  const T& value;
};
template <class T>
UnlessEmpty<T> unless_empty(const T& value) {
  return {value};
}

/// Calls visit(row) for each row of a result's table.
template <class Record, class Visit>
void for_each_field(const Visit& visit) {
  constexpr auto kRows = fields_of(static_cast<const std::remove_cv_t<Record>*>(nullptr));
  std::apply([&visit](const auto&... row) { (visit(row), ...); }, kRows);
}

}  // namespace codesign
