// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/publisher.h>

namespace codesign {

/// Publishes a message on a latched topic so that each subscriber gets it, most of them twice.
/// roscpp (1.15 to 1.17) sends a message to the subscribers that it has and only then keeps it for
/// those to come: one that connects in between gets nothing. The second, equal message closes that
/// gap, since the first one is kept by then.
template <class Message>
void publish_latched(const ros::Publisher& publisher, const Message& message) {
  publisher.publish(message);
  publisher.publish(message);
}

}  // namespace codesign
