// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/server_hold.h"

#include <netdb.h>
#include <poll.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <std_msgs/Header.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

#include "ros/common/latched.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using XmlRpc::XmlRpcValue;

/// How long a node may take to accept a connection [ms], and to tell since when it holds a server.
constexpr int kListenPatience = 3000;
constexpr std::chrono::seconds kNotePatience(2);

/// A description that is closed at the end of its block.
class Socket {
 public:
  explicit Socket(const addrinfo& address)
      : number_(socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                       address.ai_protocol)) {}
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  bool connects(const addrinfo& address) const {
    if (number_ < 0) return false;
    if (connect(number_, address.ai_addr, address.ai_addrlen) == 0) return true;
    if (errno != EINPROGRESS) return false;
    pollfd ready{number_, POLLOUT, 0};
    // A machine that does not answer at all may be there: only a refusal is certain.
    if (poll(&ready, 1, kListenPatience) <= 0) return true;
    int fault = 0;
    socklen_t size = sizeof fault;
    return getsockopt(number_, SOL_SOCKET, SO_ERROR, &fault, &size) == 0 && fault == 0;
  }

 private:
  int number_;
};

bool listens(const std::string& host, std::uint32_t port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  // A machine whose name is not known here may be there.
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return true;
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, freeaddrinfo);
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next)
    if (Socket(*address).connects(*address)) return true;
  return false;
}

/// Whether the process of a node is there.
bool is_running(const std::string& node) {
  XmlRpcValue arguments, result, uri;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  if (!ros::master::execute("lookupNode", arguments, result, uri, false)) return false;
  std::string host;
  std::uint32_t port = 0;
  return !ros::network::splitURI(static_cast<std::string&>(uri), host, port) || listens(host, port);
}

/// The publishers of a topic, in the order in which the master got to know them.
std::vector<std::string> publishers_of(const std::string& topic) {
  XmlRpcValue arguments, result, state;
  arguments[0] = ros::this_node::getName();
  std::vector<std::string> nodes;
  if (!ros::master::execute("getSystemState", arguments, result, state, true)) return nodes;
  XmlRpcValue& topics = state[0];
  for (int k = 0; k < topics.size(); ++k) {
    if (static_cast<std::string&>(topics[k][0]) != topic) continue;
    for (int n = 0; n < topics[k][1].size(); ++n)
      nodes.push_back(static_cast<std::string&>(topics[k][1][n]));
  }
  return nodes;
}

/// The last message of a topic, which comes in another thread.
struct Heard {
  std::mutex mutex;
  std::condition_variable changed;
  std::optional<std_msgs::Header> message;
};

std::optional<HoldNote> note_on(ros::NodeHandle node, const std::string& topic) {
  const auto heard = std::make_shared<Heard>();
  const ros::Subscriber subscriber = node.subscribe<std_msgs::Header>(
      topic, 1, [heard](const std_msgs::Header::ConstPtr& message) {
        const std::lock_guard<std::mutex> lock(heard->mutex);
        heard->message = *message;
        heard->changed.notify_all();
      });
  std::unique_lock<std::mutex> lock(heard->mutex);
  heard->changed.wait_for(lock, kNotePatience, [&] { return heard->message.has_value(); });
  if (!heard->message) return {};
  const double since = heard->message->stamp.toSec();
  return HoldNote{std::max(0.0, ros::WallTime::now().toSec() - since), heard->message->frame_id};
}

}  // namespace

std::vector<std::string> nodes_before(const std::string& me,
                                      const std::vector<std::string>& nodes) {
  return {nodes.begin(), std::find(nodes.begin(), nodes.end(), me)};
}

std::string held_sentence(const std::string& server, const std::string& holder,
                          const HoldNote* note) {
  const bool is_program = holder.find("codesign_apply") != std::string::npos;
  return holder + " changes the values of " + server +
         (note == nullptr
              ? ""
              : ", for " + readable(note->seconds, 2) + " s by now (" + note->purpose + ")") +
         "; wait for its end, or " +
         (is_program ? "end it: rosnode kill " + holder
                     : "end it by a message on its topic apply/cancel");
}

std::string ServerHold::take(const std::string& server, const std::string& purpose) {
  const std::string topic = server + "/codesign_apply";
  ros::Publisher publisher = node_.advertise<std_msgs::Header>(topic, 1, true);
  for (const std::string& node : nodes_before(ros::this_node::getName(), publishers_of(topic))) {
    if (!is_running(node)) continue;
    publisher.shutdown();
    const std::optional<HoldNote> note = note_on(node_, topic);
    return held_sentence(server, node, note ? &*note : nullptr);
  }
  std_msgs::Header message;
  const ros::WallTime now = ros::WallTime::now();
  message.stamp = ros::Time(now.sec, now.nsec);
  message.frame_id = purpose;
  publish_latched(publisher, message);
  publishers_.push_back(publisher);
  return "";
}

}  // namespace codesign
