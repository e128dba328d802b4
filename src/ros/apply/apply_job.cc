// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/apply.h"

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "ros/apply/reconfigure_client.h"
#include "ros/apply/server_hold.h"
#include "ros/bags/bag_files.h"
#include "ros/common/replies.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Request = mechanism_codesign::ApplyRequest;
using Response = mechanism_codesign::ApplyResponse;

/// How long servers and topics may take to appear [s].
constexpr double kAnswerPatience = 5.0;

/// An exception that ends the job with a code and a sentence.
struct Refusal {
  std::string code, message;
};

SafeRanges safe_ranges(const Request& request, const FinishedJob& job) {
  SafeRanges ranges;
  ranges.add_limits_of(job.problem, job.parameters);
  for (const std::string& text : request.limits) ranges.add(text, "limits");
  if (request.unwatched && !ranges.joint_signals().empty())
    throw InputError({{"request", 0},
                      "limits",
                      "joint states are not watched",
                      ranges.joint_signals()[0],
                      "ranges of topics, /NAME"});
  return ranges;
}

/// The servers of one robot, and a thread that serves callbacks.
class Robot {
 public:
  Robot() : spinner_(1, &queue_) {
    node_.setCallbackQueue(&queue_);
    spinner_.start();
  }
  ~Robot() { spinner_.stop(); }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  ros::NodeHandle& node() { return node_; }

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
};

/// One application of gains.
class Application {
 public:
  Application(const Request& request, const std::atomic<bool>& cancel, Response* response)
      : request_(request), cancel_(cancel), response_(*response) {}

  void run(const std::string& path) {
    const RampOptions ramp = ramp_options(request_);
    const WatchOptions watch = watch_options(request_);
    const FinishedJob job =
        read_finished_job(path, bag_trajectory_loader(folder_of_job(path)), &cancel_);
    const SafeRanges ranges = safe_ranges(request_, job);
    const std::vector<GainOrder> orders = orders_of(job, request_.server);
    find_servers(orders);
    // Values that another program is changing are not those to go back to.
    if (!request_.dry_run) hold_servers(ramp);
    plan(orders);
    RobotWatch watcher(robot_.node(), ranges, watch);
    if (const std::string fault = watcher.begin(kAnswerPatience); !fault.empty())
      throw Refusal{"unsafe", "nothing was sent: " + fault};
    if (cancel_) throw Refusal{"cancelled", "cancelled before anything was sent"};
    if (request_.dry_run)
      response_.message = "tried only: " + amount() + " would change";
    else
      carry(ramp, &watcher);
  }

 private:
  void find_servers(const std::vector<GainOrder>& orders) {
    for (const GainOrder& order : orders)
      clients_.push_back(std::make_unique<ReconfigureClient>(
          robot_.node(), robot_.node().resolveName(order.server)));
    for (const std::unique_ptr<ReconfigureClient>& client : clients_) {
      const std::string missing = client->wait(kAnswerPatience, cancel_);
      if (cancel_) throw Refusal{"cancelled", "cancelled before anything was sent"};
      if (!missing.empty())
        throw Refusal{"no_server", client->name() +
                                       " is no running server of dynamic_reconfigure: " + missing +
                                       " is missing; rosservice list shows " +
                                       "the servers, as NAMESPACE/set_parameters"};
    }
  }

  void hold_servers(const RampOptions& ramp) {
    std::set<std::string> names;
    for (const std::unique_ptr<ReconfigureClient>& client : clients_) names.insert(client->name());
    const std::string purpose =
        "ramp " + to_decimal(ramp.ramp) + " s, hold " + to_decimal(ramp.hold) + " s";
    for (const std::string& name : names)
      if (const std::string held = hold_.take(name, purpose); !held.empty())
        throw Refusal{"busy", "nothing was sent: " + held};
  }

  void plan(const std::vector<GainOrder>& orders) {
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const GainServerState state = clients_[k]->state();
      const GainValues after = wanted_values(orders[k], state, clients_[k]->name());
      servers_.push_back({clients_[k].get(), only(after, state.now), after});
    }
    for (const RampServer& one : servers_)
      for (const auto& [name, value] : one.after) {
        mechanism_codesign::GainChange change;
        change.server = one.server->name();
        change.name = name;
        change.before = change.now = one.before.at(name).number;
        change.after = value.number;
        response_.changes.push_back(std::move(change));
      }
  }

  void carry(const RampOptions& options, RobotWatch* watcher) {
    const auto guard = [this, watcher]() -> std::optional<RampAlarm> {
      if (cancel_) return RampAlarm{"cancelled"};
      return watcher->alarm();
    };
    const RampOutcome outcome = GainRamp(servers_, options, guard).run();
    fill_now(outcome);
    response_.rollback_seconds = outcome.rollback_seconds;
    if (outcome.alarm.empty()) {
      response_.message = amount() + " changed within " + to_decimal(options.ramp) +
                          " s, and watched for " + to_decimal(options.hold) + " s";
      return;
    }
    if (!outcome.is_known())
      throw Refusal{"rollback_failed",
                    outcome.alarm + "; these servers have not confirmed their values before: " +
                        unknown(outcome)};
    throw Refusal{cancel_ ? "cancelled" : "aborted",
                  outcome.alarm + "; all servers have their values before"};
  }

  void fill_now(const RampOutcome& outcome) {
    std::size_t row = 0;
    for (std::size_t k = 0; k < servers_.size(); ++k)
      for (const auto& [name, value] : servers_[k].after) {
        const GainServer::Answer& now = outcome.now[k];
        response_.changes[row++].now =
            now ? now->at(name).number : std::numeric_limits<double>::quiet_NaN();
      }
  }

  std::string unknown(const RampOutcome& outcome) const {
    std::string names;
    for (std::size_t k = 0; k < servers_.size(); ++k)
      if (!outcome.now[k]) names += (names.empty() ? "" : ", ") + servers_[k].server->name();
    return names;
  }

  std::string amount() const {
    const std::size_t values = response_.changes.size(), servers = servers_.size();
    return std::to_string(values) + (values == 1 ? " value" : " values") + " of " +
           std::to_string(servers) + (servers == 1 ? " server" : " servers");
  }

  const Request& request_;
  const std::atomic<bool>& cancel_;
  Response& response_;
  Robot robot_;  // before hold and clients, which use its queue
  ServerHold hold_{robot_.node()};
  std::vector<std::unique_ptr<ReconfigureClient>> clients_;
  std::vector<RampServer> servers_;
};

}  // namespace

Response apply_gains(const Request& request, const std::atomic<bool>& cancel) {
  Response response;
  response.rollback_seconds = std::numeric_limits<double>::quiet_NaN();
  set_status({}, &response);
  try {
    Application(request, cancel, &response).run(request.result);
  } catch (const Refusal& refusal) {
    refuse(refusal.code, refusal.message, &response);
  } catch (const NeverSimulated& error) {
    refuse(cancel ? "cancelled" : "never_simulated", error.what(), &response);
  } catch (const InputError& error) {
    refuse("bad_input", error.what(), &response);
  } catch (const std::exception& error) {
    refuse("internal_error", error.what(), &response);
  }
  return response;
}

}  // namespace codesign
