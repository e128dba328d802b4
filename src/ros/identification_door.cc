// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/identification_door.h"

#include <std_msgs/String.h>

#include <cmath>
#include <future>
#include <sstream>

#include "mechanism_codesign/error.h"
#include "ros/conversions.h"
#include "ros/request.h"
#include "ros/wire.h"

namespace codesign {
namespace {

/// Whether the lists of a request have admissible lengths, before they are copied; fills `refusal` if not.
template <class Request>
bool is_of_size(const LoadedStudy& loaded, const Request& request, mechanism_codesign::IdentifyResult* refusal) {
  try {
    if (loaded.problem) check_size(*loaded.problem, request.parameters, request.start, "start");
    return true;
  } catch (const InputError& error) {
    refuse("bad_input", error.what(), refusal);
    return false;
  }
}

}  // namespace

IdentificationDoor::IdentificationDoor(const ros::NodeHandle& node, const ros::NodeHandle& doors, const LoadedStudy& loaded,
                                       NodeState* state)
    : node_(node),
      doors_(doors),
      loaded_(loaded),
      state_(*state),
      progress_(node_.advertise<mechanism_codesign::IdentificationProgress>("identification_progress", 100, true)),
      identified_(node_.advertise<std_msgs::String>("identified/robot_description", 1, true)),
      action_(
          doors_, "identify", [this](const GoalHandle& goal) { on_goal(goal); }, [this](const GoalHandle& goal) { on_cancel(goal); },
          false),
      service_(doors_.advertiseService("identify", &IdentificationDoor::on_request, this)),
      // Subscribed in the action's namespace, so that a remapping of the action applies to this topic, too.
      cancel_all_(ros::NodeHandle(doors_, "identify").subscribe("cancel", 10, &IdentificationDoor::on_cancel_all, this)) {}

bool IdentificationDoor::start(const mechanism_codesign::IdentifyGoal& request, const Caller& caller, Result* refusal) {
  if (!loaded_.problem) {
    refuse("bad_input", loaded_.fault, refusal);
    return false;
  }
  const auto result = std::make_shared<Result>();
  const auto job = [this, request, caller, result](const std::atomic<bool>& cancel) {
    if (caller.begin) caller.begin();
    *result = run(request, caller.progress, cancel);
  };
  if (worker_.try_start(job, [caller, result] { caller.end(*result); })) return true;
  refuse("busy", "another identification is running", refusal);
  return false;
}

IdentificationDoor::Result IdentificationDoor::run(const mechanism_codesign::IdentifyGoal& request, const IdentificationObserver& observer,
                                                   const std::atomic<bool>& cancel) {
  state_.set(NodeState::Level::kOk, "identifying");
  const auto publish = [&](const mechanism_codesign::IdentificationProgress& progress) {
    progress_.publish(progress);
    state_.show("identification", progress.job);
    state_.show("identification stage", progress.stage + ", " + std::to_string(progress.done) + " of " + std::to_string(progress.of));
    if (observer) observer(progress);
  };
  const IdentificationOutcome outcome = run_identification(*loaded_.problem, loaded_.folder, request, loaded_.options, publish, cancel);
  if (!outcome.identified_urdf.empty()) {
    std_msgs::String description;
    description.data = outcome.identified_urdf;
    identified_.publish(description);
  }
  state_.warn("last identification", warnings_of_job(outcome.result.warnings, loaded_.problem->warnings().size()));
  tell_result(outcome.result);
  return outcome.result;
}

void IdentificationDoor::tell_result(const Result& result) {
  if (!result.success)
    return state_.set(NodeState::Level::kWarning, "the last identification ended with " + result.code + ": " + result.message);
  std::ostringstream sentence;
  sentence << "identified:";
  for (const auto& number : result.numbers) sentence << ' ' << number.name << " = " << number.value << ',';
  sentence << ' ' << result.bag;
  state_.set(NodeState::Level::kOk, sentence.str());
}

bool IdentificationDoor::on_request(mechanism_codesign::Identify::Request& request, mechanism_codesign::Identify::Response& response) {
  const auto done = std::make_shared<std::promise<Result>>();
  const Caller caller{{}, {}, [done](const Result& result) { done->set_value(result); }};
  Result result;
  if (is_of_size(loaded_, request, &result) && start(same_fields<mechanism_codesign::IdentifyGoal>(request), caller, &result))
    result = done->get_future().get();
  response = same_fields<mechanism_codesign::Identify::Response>(result);
  return true;
}

void IdentificationDoor::on_goal(GoalHandle goal) {
  Caller caller;
  caller.begin = [goal]() mutable { goal.setAccepted(); };
  caller.progress = [goal](const mechanism_codesign::IdentificationProgress& progress) mutable {
    mechanism_codesign::IdentifyFeedback message;
    message.progress = progress;
    goal.publishFeedback(message);
  };
  caller.end = [goal](const Result& result) mutable {
    if (result.success)
      goal.setSucceeded(result);
    else if (result.code == "cancelled")
      goal.setCanceled(result, result.message);
    else
      goal.setAborted(result, result.message);
  };
  Result refusal;
  if (!is_of_size(loaded_, *goal.getGoal(), &refusal) || !start(*goal.getGoal(), caller, &refusal))
    goal.setRejected(refusal, refusal.message);
}

/// In actionlib an empty identifier with a zero stamp cancels all goals; here it also cancels a job of the service.
void IdentificationDoor::on_cancel_all(const actionlib_msgs::GoalID& goal) {
  if (goal.id.empty() && goal.stamp.isZero()) worker_.cancel();
}

void IdentificationDoor::on_cancel(const GoalHandle& goal) {
  const unsigned char status = goal.getGoalStatus().status;
  if (status == actionlib_msgs::GoalStatus::RECALLING || status == actionlib_msgs::GoalStatus::PREEMPTING) worker_.cancel();
}

}  // namespace codesign
