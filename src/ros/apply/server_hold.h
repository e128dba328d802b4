// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>
#include <vector>

namespace codesign {

/// Keeps two programs from changing the gains of one robot at the same time. A program holds a
/// server of dynamic_reconfigure while it offers the topic `SERVER/codesign_apply` as the first of
/// those that do: the master lists them in the order in which they came, so that of several that
/// begin at the same time exactly one holds it. A node that was killed remains on the list, and
/// counts only if its process still listens.
///
/// The topic has one latched std_msgs/Header: since when it is held, by the clock of the holder's
/// machine, and as `frame_id` for what.
class ServerHold {
 public:
  /// @param node whose callback queue is served by another thread.
  explicit ServerHold(const ros::NodeHandle& node) : node_(node) {}

  /// Takes a server, until the hold is destroyed. Several programs that take several servers take
  /// them in the same order, that of their names.
  /// @param server resolved name. @param purpose for whoever comes second, such as "ramp 2 s, hold
  /// 1 s". @returns a sentence that names the holder and for how long it has held the server;
  /// empty: it is taken.
  std::string take(const std::string& server, const std::string& purpose);

 private:
  ros::NodeHandle node_;
  std::vector<ros::Publisher> publishers_;
};

/// The nodes before `me` in the order of registration; all if it is not among them.
std::vector<std::string> nodes_before(const std::string& me, const std::vector<std::string>& nodes);

/// What a holder tells of itself.
struct HoldNote {
  double seconds = 0.0;  ///< for which it has held the server
  std::string purpose;
};

/// The sentence of ServerHold::take(). @param note null if the holder has not said anything.
std::string held_sentence(const std::string& server, const std::string& holder,
                          const HoldNote* note);

}  // namespace codesign
