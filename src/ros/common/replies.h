// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <string>
#include <type_traits>

#include "mechanism_codesign/status.h"
#include "mechanism_codesign/version.h"

namespace codesign {

/// Sets success, code, message and version of a reply from a status.
template <class Reply>
void set_status(const Status& status, Reply* reply) {
  reply->version = version();
  reply->success = status.ok();
  reply->code = name_of(status.code);
  if (!status.ok()) reply->message = reason(status);
}

/// Sets a reply without success: code, message and version.
template <class Reply>
void refuse(const std::string& code, const std::string& message, Reply* reply) {
  reply->version = version();
  reply->success = false;
  reply->code = code;
  reply->message = message;
}

/// Converts a message to another message type with the same fields, such as the request of a
/// service to the goal of an action. Does not compile if the fields differ.
template <class To, class From>
To same_fields(const From& from) {
  if constexpr (std::is_same_v<To, From>) return from;
  namespace traits = ros::message_traits;
  static_assert(traits::MD5Sum<To>::static_value1 == traits::MD5Sum<From>::static_value1 &&
                    traits::MD5Sum<To>::static_value2 == traits::MD5Sum<From>::static_value2,
                "the two messages do not have the same fields");
  const ros::SerializedMessage wire = ros::serialization::serializeMessage(from);
  ros::serialization::IStream stream(wire.message_start,
                                     static_cast<std::uint32_t>(wire.num_bytes - 4));
  To to;
  ros::serialization::deserialize(stream, to);
  return to;
}

}  // namespace codesign
