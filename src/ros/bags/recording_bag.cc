// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_files.h"

#include <sensor_msgs/JointState.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <set>
#include <utility>

#include "math/arrays.h"
#include "ros/bags/bag_contents.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A message of type sensor_msgs/JointState.
struct JointStates {
  std::int64_t received = 0, stamp = 0;  ///< [ns]
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
};

JointStates joint_states_of(const BagMessage& message) {
  BagCursor content = message.content;
  content.number<std::uint32_t>("a header's sequence number");
  JointStates states;
  states.received = message.received;
  states.stamp = content.time("a stamp");
  content.block("a frame's name");
  states.name = content.strings("a joint's name");
  states.position = content.doubles("positions");
  states.velocity = content.doubles("velocities");
  states.effort = content.doubles("efforts");
  if (!content.at_end()) content.fail("a message that is longer than its arrays");
  return states;
}

/// Nanoseconds in seconds, as ros::Duration rounds them.
double seconds(std::int64_t nanoseconds) {
  constexpr std::int64_t kSecond = 1000000000;
  const std::int64_t rest = ((nanoseconds % kSecond) + kSecond) % kSecond;
  return static_cast<double>((nanoseconds - rest) / kSecond) + 1e-9 * static_cast<double>(rest);
}

/// The messages that name the same joints of the model.
struct Group {
  std::vector<std::string> joints;    ///< in the order of the model, as those of a table
  std::vector<std::size_t> messages;  ///< indices
};

/// One reading of a bag.
class RecordingBag {
 public:
  RecordingBag(const RecordingDescription& description, const std::string& path,
               const std::vector<std::string>& joints, Warnings* warnings,
               const std::atomic<bool>* cancel)
      : description_(description),
        path_(path),
        known_(joints),
        warnings_(warnings),
        cancel_(cancel),
        bag_(path) {
    for (std::size_t k = 0; k < known_.size(); ++k) place_[known_[k]] = k;
  }

  JointRecording read() {
    find_topic();
    read_messages();
    const Group group = largest_group();
    JointRecording recording;
    recording.file = path_;
    recording.topic = topic_;
    recording.element = description_.element;
    recording.where = description_.where;
    set_times(group, &recording);
    for (const std::string& joint : group.joints)
      recording.joints.push_back(samples_of(joint, group));
    return recording;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& message,
                         const std::string& value, const std::string& allowed) const {
    throw InputError({description_.where, description_.element + key, message + " (" + path_ + ")",
                      value, allowed});
  }
  [[noreturn]] void fail_at(std::size_t message, const std::string& what,
                            const std::string& allowed) const {
    fail("", what + ", message " + std::to_string(message + 1) + " on " + topic_, "", allowed);
  }
  void warn_of(const std::string& code, const std::string& message, const std::string& allowed) {
    warnings_->push_back(warn(
        code, {description_.where, description_.element, message + ": " + path_, "", allowed}));
  }

  /// The topic as it stands in the bag, with or without the leading slash.
  void find_topic() {
    if (bag_.empty()) fail(".bag", "the bag is empty", "", "");
    std::map<std::string, std::string> types;
    for (const BagConnection& connection : bag_.connections())
      types.emplace(connection.topic, connection.type);
    const std::string& asked = description_.topic;
    for (const std::string& name :
         {asked, "/" + asked, asked.substr(asked.empty() || asked.front() != '/' ? 0 : 1)}) {
      const auto found = types.find(name);
      if (found == types.end()) continue;
      topic_ = name;
      if (found->second != "sensor_msgs/JointState")
        fail(".topic", "the topic holds no joint states but " + found->second, asked,
             "a topic of type sensor_msgs/JointState");
      return;
    }
    std::vector<std::string> names, listed;
    for (const auto& [name, type] : types) {
      names.push_back(name);
      listed.push_back(name + " (" + type + ")");
    }
    fail(".topic", "no message on this topic" + did_you_mean(nearest_name(asked, names)), asked,
         list_names(listed));
  }

  void read_messages() {
    bag_.visit(topic_, cancel_, [this](const BagMessage& message) {
      if (message.connection.md5sum != ros::message_traits::md5sum<sensor_msgs::JointState>())
        fail_at(messages_.size(), "the message has another definition of sensor_msgs/JointState",
                "");
      messages_.push_back(joint_states_of(message));
    });
    std::stable_sort(
        messages_.begin(), messages_.end(),
        [](const JointStates& a, const JointStates& b) { return a.received < b.received; });
    for (std::size_t k = 0; k < messages_.size(); ++k)
      for (const std::vector<double>* array :
           {&messages_[k].position, &messages_[k].velocity, &messages_[k].effort})
        if (!array->empty() && array->size() != messages_[k].name.size())
          fail_at(k,
                  std::to_string(messages_[k].name.size()) + " names, and an array of " +
                      std::to_string(array->size()) + " numbers",
                  "one number per name, or an empty array");
  }

  void refuse_other_robot() const {
    std::set<std::string> names;
    for (const JointStates& message : messages_)
      names.insert(message.name.begin(), message.name.end());
    const std::vector<std::string> found(names.begin(), names.end());
    fail(".topic",
         "the messages name no joint of the model, but " + list_names(found) +
             "; a bag of another robot?",
         description_.topic, list_names(known_));
  }

  /// The group of messages that name the most joints; of several such groups, the first one.
  Group largest_group() {
    std::map<std::vector<std::size_t>, Group> groups;
    for (std::size_t k = 0; k < messages_.size(); ++k) {
      std::vector<std::size_t> places;
      for (const std::string& name : messages_[k].name)
        if (const auto found = place_.find(name); found != place_.end())
          places.push_back(found->second);
      if (places.empty()) continue;
      std::sort(places.begin(), places.end());
      Group& group = groups[places];
      if (group.messages.empty())
        for (const std::size_t place : places) group.joints.push_back(known_[place]);
      group.messages.push_back(k);
    }
    if (groups.empty()) refuse_other_robot();
    const auto largest =
        std::max_element(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
          const Group &x = a.second, &y = b.second;
          return x.joints.size() != y.joints.size() ? x.joints.size() < y.joints.size()
                                                    : x.messages.size() < y.messages.size();
        });
    std::set<std::string> left_out;
    for (const auto& entry : groups)
      left_out.insert(entry.second.joints.begin(), entry.second.joints.end());
    for (const std::string& joint : largest->second.joints) left_out.erase(joint);
    if (!left_out.empty())
      warn_of("recording_joints_left_out",
              "other messages of the topic name " + list_names({left_out.begin(), left_out.end()}) +
                  ", which are left out, since they were not measured at the same times",
              "one publisher for all joints of the model");
    return largest->second;
  }

  std::vector<double> column_of(const std::string& joint, const Group& group,
                                MeasuredQuantity quantity) const {
    std::vector<double> column;
    for (const std::size_t k : group.messages) {
      const JointStates& message = messages_[k];
      const std::vector<double>& array = quantity == MeasuredQuantity::kPosition ? message.position
                                         : quantity == MeasuredQuantity::kVelocity
                                             ? message.velocity
                                             : message.effort;
      if (array.empty() != column.empty() && k != group.messages.front())
        fail_at(k,
                "the array of " + std::string(kMeasuredQuantityNames[to_index(quantity)]) +
                    "s is " +
                    (array.empty() ? "empty, but was not in the messages before"
                                   : "not empty, but was in the messages before"),
                "the same arrays in all messages");
      if (array.empty()) continue;
      const auto place = std::find(message.name.begin(), message.name.end(), joint);
      column.push_back(array[to_index(place - message.name.begin())]);
    }
    return column;
  }

  bool was_measured(const std::string& joint, MeasuredQuantity quantity,
                    const std::vector<double>& column) {
    const auto is_nan = [](double value) { return std::isnan(value); };
    if (std::all_of(column.begin(), column.end(), is_nan)) return false;
    if (quantity != MeasuredQuantity::kPosition &&
        std::all_of(column.begin(), column.end(), [](double value) { return value == 0.0; }))
      warn_of("recording_all_zero",
              "the " + std::string(kMeasuredQuantityNames[to_index(quantity)]) + " of " + joint +
                  " is zero throughout, as drivers write it that do not measure it",
              "an empty array for what is not measured");
    return true;
  }

  JointSamples samples_of(const std::string& joint, const Group& group) {
    JointSamples samples;
    samples.joint = joint;
    for (const MeasuredQuantity quantity :
         {MeasuredQuantity::kPosition, MeasuredQuantity::kVelocity, MeasuredQuantity::kEffort}) {
      std::vector<double> column = column_of(joint, group, quantity);
      if (was_measured(joint, quantity, column)) samples.of(quantity) = std::move(column);
    }
    return samples;
  }

  void check_clock(const Group& group) {
    constexpr double kOff = 0.5;
    double before = 0.0;
    for (const std::size_t k : group.messages) {
      const JointStates& message = messages_[k];
      if (message.stamp == 0)
        fail_at(k, "the stamp of the header is zero",
                "a publisher that sets it; or `stamp: receive`, if the load was low");
      const double late = seconds(message.received - message.stamp);
      if (k == group.messages.front() ? std::abs(late) <= kOff : std::abs(late - before) <= kOff) {
        before = late;
        continue;
      }
      warn_of("recording_clock",
              "message " + std::to_string(k + 1) + " was received " + readable(late, 6) +
                  " s after its stamp" +
                  (k == group.messages.front() ? ""
                                               : ", the one before " + readable(before, 6) + " s") +
                  "; the stamps count",
              "clocks that agree; `stamp: receive` takes the times of reception");
      return;
    }
  }

  void set_times(const Group& group, JointRecording* recording) {
    const std::size_t first = group.messages.front();
    const double start = seconds(messages_[first].received - bag_.begin());
    const bool by_header = description_.stamp == StampKind::kHeader;
    if (by_header) check_clock(group);
    const auto time_of = [&](std::size_t k) {
      return by_header ? messages_[k].stamp : messages_[k].received;
    };
    for (const std::size_t k : group.messages) {
      recording->times.push_back(start + seconds(time_of(k) - time_of(first)));
      recording->places.push_back(k + 1);
    }
  }

  const RecordingDescription& description_;
  const std::string& path_;
  std::vector<std::string> known_;            ///< in the order of the model
  std::map<std::string, std::size_t> place_;  ///< in known_
  Warnings* warnings_;
  const std::atomic<bool>* cancel_;
  BagContents bag_;
  std::string topic_;
  std::vector<JointStates> messages_;  ///< in the order in which they were received
};

JointRecording read(const RecordingDescription& description, const std::string& path,
                    const std::vector<std::string>& joints, Warnings* warnings,
                    const std::atomic<bool>* cancel) {
  const auto refuse = [&](const std::string& cause, const std::string& allowed) {
    return InputError({description.where, description.element + ".bag",
                       "the bag cannot be read: " + cause, path, allowed});
  };
  try {
    return RecordingBag(description, path, joints, warnings, cancel).read();
  } catch (const UnindexedBag& error) {
    throw refuse(
        error.what(),
        "a bag that was closed; `rosbag reindex` repairs one of a recorder that was killed");
  } catch (const BagFault& error) {
    const bool is_recorded =
        access(path.c_str(), F_OK) != 0 && access((path + ".active").c_str(), F_OK) == 0;
    throw refuse(error.what(),
                 is_recorded
                     ? "a bag that is complete; " + path +
                           ".active is there: its recorder still runs, or was killed"
                     : "a whole bag; `rosbag reindex` repairs what there is of one that was cut");
  } catch (const std::bad_alloc&) {
    throw refuse("its messages on " + description.topic + " do not fit into the memory",
                 "a shorter recording; `rosbag filter` writes one");
  }
}

}  // namespace

JointRecording read_recording_bag(const RecordingDescription& description, const std::string& path,
                                  const std::vector<std::string>& joints, Warnings* warnings) {
  return read(description, path, joints, warnings, nullptr);
}

BagReader cancellable_bag_reader(const std::atomic<bool>& cancel) {
  return [&cancel](const RecordingDescription& description, const std::string& path,
                   const std::vector<std::string>& joints, Warnings* warnings) {
    return read(description, path, joints, warnings, &cancel);
  };
}

}  // namespace codesign
