// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <tuple>
#include <type_traits>

namespace codesign {

// The fields of a result are rows of a table, fields_of(): from them come its JSON and its columns
// of CSV (record.h), its line of the journal, and its ROS message (ros/common/message_fields.h). A
// row has a name and says how to get the value: by a pointer to a member, or by a function of the
// result. A value that can be set, a member or what a function returns a reference to, is read back
// from JSON, too.

template <class Get>
struct Field {
  const char* name;
  Get get;

  template <class Record>
  decltype(auto) of(Record& record) const {
    return std::invoke(get, record);
  }
};

template <class Get>
constexpr Field<Get> field(const char* name, Get get) {
  return {name, get};
}

/// A bool that is one of two words in JSON.
template <class Record>
struct WordField {
  const char* name;
  bool Record::*member;
  const char *if_false, *if_true;

  std::string of(const Record& record) const { return record.*member ? if_true : if_false; }
};

template <class Record>
constexpr WordField<Record> word(const char* name, bool Record::*member, const char* if_false,
                                 const char* if_true) {
  return {name, member, if_false, if_true};
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
