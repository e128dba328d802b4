// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iomanip>
#include <map>
#include <sstream>

#include "jobs/saved_result.h"
#include "mechanism_codesign/error.h"
#include "ros/apply/apply.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// More than a day. The limit keeps the number of steps of a ramp within the range of int.
constexpr double kLongestTime = 1e5;

double checked_time(double value, const char* name, double fallback) {
  if (!(value >= 0.0 && value <= kLongestTime))
    throw InputError({{"request", 0},
                      name,
                      "not a time",
                      to_decimal(value),
                      "0 for the default, or up to 100000 s"});
  return value == 0.0 ? fallback : value;
}

using mechanism_codesign::ApplyRequest;

struct ApplyOption {
  bool has_value;
  std::function<void(const std::string&, ApplyArguments*)> apply;
};

/// A number above zero, since zero stands for the default in a request.
ApplyOption number(const std::string& name, double ApplyRequest::*field) {
  return {true, [name, field](const std::string& text, ApplyArguments* to) {
            double value = 0.0;
            const auto [end, error] =
                std::from_chars(text.data(), text.data() + text.size(), value);
            if (error != std::errc() || end != text.data() + text.size() || !(value > 0.0))
              throw ApplyUsageError(name + ": \"" + text + "\" is not a number above zero");
            to->request.*field = value;
          }};
}

ApplyOption text(std::string ApplyRequest::*field) {
  return {true,
          [field](const std::string& word, ApplyArguments* to) { to->request.*field = word; }};
}

ApplyOption flag(std::uint8_t ApplyRequest::*field) {
  return {false, [field](const std::string&, ApplyArguments* to) { to->request.*field = 1; }};
}

std::map<std::string, ApplyOption> apply_options() {
  return {{"--dry-run", flag(&ApplyRequest::dry_run)},
          {"--unwatched", flag(&ApplyRequest::unwatched)},
          {"--server", text(&ApplyRequest::server)},
          {"--joint-states", text(&ApplyRequest::joint_states)},
          {"--ramp", number("--ramp", &ApplyRequest::ramp)},
          {"--hold", number("--hold", &ApplyRequest::hold)},
          {"--max-age", number("--max-age", &ApplyRequest::max_age)},
          {"--deviation", number("--deviation", &ApplyRequest::deviation)},
          {"--limit",
           {true, [](const std::string& word,
                     ApplyArguments* to) { to->request.limits.push_back(word); }}},
          {"--json", {false, [](const std::string&, ApplyArguments* to) { to->json = true; }}},
          {"--help", {false, [](const std::string&, ApplyArguments* to) { to->help = true; }}},
          {"-h", {false, [](const std::string&, ApplyArguments* to) { to->help = true; }}}};
}

}  // namespace

RampOptions ramp_options(const mechanism_codesign::ApplyRequest& request) {
  RampOptions options;
  options.ramp = checked_time(request.ramp, "ramp", options.ramp);
  options.hold = checked_time(request.hold, "hold", options.hold);
  // Who accepts joint states that are older accepts answers that come later.
  options.patience =
      std::max(options.patience, checked_time(request.max_age, "max_age", options.patience));
  return options;
}

WatchOptions watch_options(const mechanism_codesign::ApplyRequest& request) {
  WatchOptions options;
  if (!request.joint_states.empty()) options.joint_states = request.joint_states;
  options.max_age = checked_time(request.max_age, "max_age", options.max_age);
  if (!std::isfinite(request.deviation) || request.deviation < 0.0)
    throw InputError({{"request", 0},
                      "deviation",
                      "not a length or an angle",
                      to_decimal(request.deviation),
                      "0 for none, or more"});
  options.deviation = request.deviation;
  if (request.unwatched && (options.deviation > 0.0 || !request.joint_states.empty()))
    throw InputError({{"request", 0},
                      "unwatched",
                      "joint states are named and left unwatched",
                      "",
                      "one of both"});
  if (request.unwatched) options.joint_states.clear();
  return options;
}

ApplyArguments parse_apply_arguments(const std::vector<std::string>& words) {
  const std::map<std::string, ApplyOption> options = apply_options();
  ApplyArguments arguments;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k].empty()) throw ApplyUsageError("an empty argument");
    if (words[k][0] != '-') {
      if (!arguments.request.result.empty())
        throw ApplyUsageError("unexpected \"" + words[k] + "\" after the job");
      arguments.request.result = words[k];
      continue;
    }
    const std::size_t equals = words[k].find('=');
    const std::string name = words[k].substr(0, equals);
    const auto option = options.find(name);
    if (option == options.end()) {
      std::vector<std::string> known;
      for (const auto& [known_name, unused] : options) known.push_back(known_name);
      throw ApplyUsageError("unknown option \"" + name + "\"" +
                            did_you_mean(nearest_name(name, known)));
    }
    if (!option->second.has_value && equals != std::string::npos)
      throw ApplyUsageError(name + " takes no value");
    if (!option->second.has_value) {
      option->second.apply("", &arguments);
    } else if (equals != std::string::npos && equals + 1 < words[k].size()) {
      option->second.apply(words[k].substr(equals + 1), &arguments);
    } else {
      if (equals != std::string::npos || k + 1 == words.size())
        throw ApplyUsageError(name + " needs a value");
      option->second.apply(words[++k], &arguments);
    }
  }
  if (!arguments.help && arguments.request.result.empty())
    throw ApplyUsageError(
        "\"apply\" needs the DIR or BAG of an optimization, as codesign optimize --output DIR "
        "writes it");
  return arguments;
}

std::string apply_usage() {
  return R"(usage: codesign apply DIR|BAG [OPTIONS]

Sends the gains of a finished optimization to the servers of dynamic_reconfigure of a running robot,
along a ramp, and takes them back if the robot leaves its limits (doc/results.md).

  --dry-run              checks everything, tells what would change, and sends nothing
  --server NAMESPACE     sends the tuned parameters by their names to this server; by default gains
                         go to the namespaces of `hardware:` in the study
  --ramp SECONDS         from the values before to the new ones; by default 2
  --hold SECONDS         how long the robot is watched after that; by default 1
  --limit SIGNAL=LOW:HIGH  JOINT/position, JOINT/velocity, JOINT/effort, or a topic /NAME of
                         std_msgs/Float64; may be repeated. It replaces the limit of the model
  --deviation X          largest change of any joint's position since the beginning [rad or m]
  --joint-states TOPIC   by default joint_states
  --max-age SECONDS      oldest joint state; by default 0.5
  --unwatched            no joint states are watched, only the topics of --limit
  --json                 one JSON object on standard output

ROS's remappings, such as __ns:=/robot, may follow.
exit code: 0 the robot has the new values (or could take them), 1 it has the ones before, or nobody
knows (code rollback_failed), 2 bad input
)";
}

std::string apply_table(const mechanism_codesign::ApplyResponse& response) {
  std::ostringstream out;
  std::size_t server = 6, name = 9;
  for (const auto& change : response.changes) {
    server = std::max(server, change.server.size());
    name = std::max(name, change.name.size());
  }
  const auto row = [&](const std::string& first, const std::string& second,
                       const std::vector<std::string>& numbers) {
    out << std::left << std::setw(static_cast<int>(server)) << first << "  "
        << std::setw(static_cast<int>(name)) << second << std::right;
    for (const std::string& text : numbers) out << "  " << std::setw(13) << text;
    out << '\n';
  };
  if (!response.changes.empty()) row("server", "parameter", {"before", "after", "now"});
  for (const auto& change : response.changes)
    row(change.server, change.name,
        {readable(change.before), readable(change.after), readable(change.now)});
  if (response.success) out << response.message << '\n';
  return out.str();
}

std::string apply_json(const mechanism_codesign::ApplyResponse& response) {
  ApplyRecord record{
      response.success != 0, response.code, response.message, {}, response.rollback_seconds};
  for (const auto& change : response.changes)
    record.changes.push_back({change.server, change.name, change.before, change.after, change.now});
  return apply_text(record);
}

}  // namespace codesign
