// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>

namespace codesign {

/// Converts a message to another message type with the same fields, such as the request of a service to the goal of an action. Does not
/// compile if the fields differ.
template <class To, class From>
To same_fields(const From& from) {
  namespace traits = ros::message_traits;
  static_assert(traits::MD5Sum<To>::static_value1 == traits::MD5Sum<From>::static_value1 &&
                    traits::MD5Sum<To>::static_value2 == traits::MD5Sum<From>::static_value2,
                "the two messages do not have the same fields");
  const ros::SerializedMessage wire = ros::serialization::serializeMessage(from);
  ros::serialization::IStream stream(wire.message_start, static_cast<std::uint32_t>(wire.num_bytes - 4));
  To to;
  ros::serialization::deserialize(stream, to);
  return to;
}

}  // namespace codesign
