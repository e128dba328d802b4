// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "jobs/fields.h"

namespace codesign {

/// The names of the fields in the definition of a message, in their order.
inline std::vector<std::string> names_of_fields(const std::string& definition) {
  std::vector<std::string> names;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line) && line.rfind("====", 0) != 0;) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type, name, rest;
    words >> type >> name >> rest;
    const bool is_constant = (name + rest).find('=') != std::string::npos;
    if (!name.empty() && !is_constant) names.push_back(name);
  }
  return names;
}

namespace internal {

template <class To, class From>
bool set_field(const From& from, To* to) {
  if constexpr (std::is_arithmetic_v<From> && std::is_arithmetic_v<To>) {
    *to = static_cast<To>(from);
    return true;
  } else if constexpr (!std::is_arithmetic_v<From> && std::is_assignable_v<To&, const From&>) {
    *to = from;
    return true;
  } else {
    return false;
  }
}
template <class To>
bool set_field(const OrNull& from, To* to) {
  return set_field(from.value, to);
}
template <class To, class From>
bool set_field(const UnlessEmpty<From>& from, To* to) {
  return set_field(from.value, to);
}

/// Takes the place of a stream, to which a message gives its fields one after another.
template <class Record>
class FieldSetter {
 public:
  FieldSetter(const Record& record, std::vector<std::string> names)
      : record_(record), names_(std::move(names)) {}

  template <class To>
  void next(To& to) {
    const std::string& name = names_.at(next_++);
    for_each_field<Record>([&](const auto& row) {
      if (name == row.name && !set_field(row.of(record_), &to))
        throw std::logic_error("the field " + name + " of the message has another type");
    });
  }

 private:
  const Record& record_;
  const std::vector<std::string> names_;
  std::size_t next_ = 0;
};

}  // namespace internal

/// Sets the fields of a message that have the name of a field of the result, fields_of(); the
/// others stay. @throws std::logic_error if a type does not fit.
template <class Record, class Message>
void set_fields(const Record& record, Message* message) {
  internal::FieldSetter<Record> setter(
      record, names_of_fields(ros::message_traits::Definition<Message>::value()));
  ros::serialization::Serializer<Message>::template allInOne<internal::FieldSetter<Record>,
                                                             Message&>(setter, *message);
}

}  // namespace codesign
