// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <actionlib/server/action_server.h>
#include <actionlib_msgs/GoalID.h>
#include <ros/node_handle.h>
#include <std_msgs/Empty.h>

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "ros/common/replies.h"
#include "ros/common/worker.h"

namespace codesign {

/// A service with a worker of its own. Each request is checked, refused while another one runs,
/// computed by the worker, and answered.
/// @tparam Goal, Result the fields of the request and of the response, as the computation takes and
/// gives them. @tparam Progress the feedback.
template <class Service, class Goal = typename Service::Request,
          class Result = typename Service::Response, class Progress = std_msgs::Empty>
class Door {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Observer = std::function<void(const Progress&)>;
  /// Computes in the worker's thread; must not throw.
  using Run = std::function<Result(const Goal& goal, const Observer& observer,
                                   const std::atomic<bool>& cancel)>;

  /// Offers the service `name`. @param node whose callback queue has several threads, since a
  /// callback waits for the end of its job.
  /// @param busy why a request is refused while another one runs. @param check called with each
  /// request before it is copied; an exception refuses the request with `bad_input`.
  template <class Check>
  Door(ros::NodeHandle node, const std::string& name, std::string busy, const Check& check, Run run)
      : node_(std::move(node)), busy_(std::move(busy)), run_(std::move(run)) {
    service_ = node_.advertiseService<Request, Response>(
        name, [this, check](Request& request, Response& response) {
          const auto done = std::make_shared<std::promise<Result>>();
          Result result;
          if (start(request, check,
                    {{}, {}, [done](const Result& answer) { done->set_value(answer); }}, &result))
            result = done->get_future().get();
          response = same_fields<Response>(result);
          return true;
        });
  }

  /// Cancels the running job. @returns whether a job runs that had not been cancelled before.
  bool cancel() { return worker_.cancel(); }
  /// Cancels the running job, waits for its end, and accepts no further jobs.
  void finish() { worker_.finish(); }

 protected:
  /// The client of a job; called in the worker's thread.
  struct Client {
    std::function<void()> begin;
    Observer progress;
    std::function<void(const Result&)> end;
  };

  /// Starts the job of a request. If that is not possible, fills `refusal` and returns false.
  template <class Asked, class Check>
  bool start(Asked& request, const Check& check, const Client& client, Result* refusal) {
    try {
      check(request);
    } catch (const std::exception& error) {
      refuse("bad_input", error.what(), refusal);
      return false;
    }
    const auto result = std::make_shared<Result>();
    const auto job = [this, goal = same_fields<Goal>(request), client,
                      result](const std::atomic<bool>& cancel) {
      if (client.begin) client.begin();
      *result = run_(goal, client.progress, cancel);
    };
    if (worker_.try_start(job, [client, result] { client.end(*result); })) return true;
    refuse("busy", busy_, refusal);
    return false;
  }

  ros::NodeHandle node_;

 private:
  const std::string busy_;
  const Run run_;
  Worker worker_;
  ros::ServiceServer service_;
};

template <class Action>
using GoalOf = typename Action::_action_goal_type::_goal_type;
template <class Action>
using ResultOf = typename Action::_action_result_type::_result_type;
template <class Action>
using FeedbackOf = typename Action::_action_feedback_type::_feedback_type;

/// A service and an action of the same name, with one worker for both.
template <class Action, class Service>
class ActionDoor : public Door<Service, GoalOf<Action>, ResultOf<Action>,
                               typename FeedbackOf<Action>::_progress_type> {
 public:
  using Base =
      Door<Service, GoalOf<Action>, ResultOf<Action>, typename FeedbackOf<Action>::_progress_type>;

  /// As Door().
  template <class Check>
  ActionDoor(const ros::NodeHandle& node, const std::string& name, std::string busy,
             const Check& check, typename Base::Run run)
      : Base(node, name, std::move(busy), check, std::move(run)),
        action_(
            Base::node_, name, [this, check](const GoalHandle& goal) { on_goal(goal, check); },
            [this](const GoalHandle& goal) { on_cancel(goal); }, false),
        // Subscribed in the action's namespace, so that a remapping of the action applies to this
        // topic, too.
        cancel_all_(ros::NodeHandle(Base::node_, name)
                        .subscribe("cancel", 10, &ActionDoor::on_cancel_all, this)) {}

  /// Accepts goals from now on.
  void open() { action_.start(); }

 private:
  using GoalHandle = typename actionlib::ActionServer<Action>::GoalHandle;
  using Result = ResultOf<Action>;

  template <class Check>
  void on_goal(GoalHandle goal, const Check& check) {
    const auto begin = [goal]() mutable { goal.setAccepted(); };
    const auto progress = [goal](const auto& told) mutable {
      FeedbackOf<Action> message;
      message.progress = told;
      goal.publishFeedback(message);
    };
    const auto end = [goal](const Result& result) mutable {
      if (result.success)
        goal.setSucceeded(result);
      else if (result.code == "cancelled")
        goal.setCanceled(result, result.message);
      else
        goal.setAborted(result, result.message);
    };
    Result refusal;
    if (!Base::start(*goal.getGoal(), check, {begin, progress, end}, &refusal))
      goal.setRejected(refusal, refusal.message);
  }

  void on_cancel(const GoalHandle& goal) {
    const unsigned char status = goal.getGoalStatus().status;
    if (status == actionlib_msgs::GoalStatus::RECALLING ||
        status == actionlib_msgs::GoalStatus::PREEMPTING)
      Base::cancel();
  }

  /// In actionlib an empty identifier with a zero stamp cancels all goals; here it also cancels a
  /// job of the service.
  void on_cancel_all(const actionlib_msgs::GoalID& goal) {
    if (goal.id.empty() && goal.stamp.isZero()) Base::cancel();
  }

  actionlib::ActionServer<Action> action_;
  ros::Subscriber cancel_all_;
};

}  // namespace codesign
