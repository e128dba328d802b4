// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/optimization_node.h"

#include <std_msgs/String.h>

#include <cmath>
#include <cstdlib>
#include <future>
#include <sstream>
#include <utility>

#include "engine/evaluation_engine.h"
#include "jobs/job_files.h"
#include "mechanism_codesign/error.h"
#include "ros/conversions.h"
#include "ros/inputs.h"
#include "ros/node_arguments.h"
#include "ros/parameters.h"
#include "ros/recorded_run.h"
#include "ros/request.h"
#include "ros/trajectory_bag.h"
#include "ros/wire.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

/// Threads for callbacks: four callbacks may wait for their workers, the others answer `busy`.
constexpr unsigned kDoorThreads = 6;

std::vector<std::string> optimization_parameters() {
  std::vector<std::string> names = input_parameters();
  names.insert(names.end(), {"output_directory", "rate", "diagnostic_period"});
  return names;
}

std::string default_output_directory() {
  const char* ros_home = std::getenv("ROS_HOME");
  const char* home = std::getenv("HOME");
  return (ros_home != nullptr ? std::string(ros_home) : std::string(home != nullptr ? home : ".") + "/.ros") + "/mechanism_codesign";
}

}  // namespace

OptimizationNode::OptimizationNode(Dispatcher* ranks) : state_("optimization"), spinner_(kDoorThreads, &queue_) {
  loaded_.options.ranks = ranks;
  progress_ = node_.advertise<mechanism_codesign::OptimizationProgress>("optimization_progress", 100, true);
  tuned_ = node_.advertise<std_msgs::String>("tuned/robot_description", 1, true);
  load();
  doors_.setCallbackQueue(&queue_);
  optimize_ = doors_.advertiseService("optimize", &OptimizationNode::on_optimize, this);
  evaluate_ = doors_.advertiseService("evaluate", &OptimizationNode::on_evaluate, this);
  action_ = std::make_unique<ActionServer>(
      doors_, "optimize", [this](const GoalHandle& goal) { on_goal(goal); }, [this](const GoalHandle& goal) { on_cancel(goal); }, false);
  // Subscribed in the action's namespace, so that a remapping of the action applies to this topic, too.
  cancel_all_ = ros::NodeHandle(doors_, "optimize").subscribe("cancel", 10, &OptimizationNode::on_cancel_all, this);
  identification_ = std::make_unique<IdentificationDoor>(node_, doors_, loaded_, &state_);
  application_ = std::make_unique<ApplyDoor>(doors_, loaded_.options.output_directory, &state_);
  ros::NodeHandle private_doors(doors_, ros::this_node::getName());
  cancel_ = private_doors.advertiseService("cancel", &OptimizationNode::on_cancel_request, this);
  spinner_.start();
  action_->start();
  identification_->open();
}

OptimizationNode::~OptimizationNode() { finish(); }

void OptimizationNode::finish() {
  const bool was_optimizing = optimizer_.cancel(), was_identifying = identification_->cancel();
  application_->finish();
  identification_->finish();
  optimizer_.finish();
  evaluator_.finish();
  // Returns when the callbacks of services have returned and their answers are sent.
  spinner_.stop();
  // The answers of actions are messages, which ROS sends in a thread of its own.
  if ((was_optimizing || was_identifying) && ros::ok()) ros::WallDuration(0.3).sleep();
}

void OptimizationNode::load() {
  try {
    state_.warn("parameters", unknown_parameters(private_node_, optimization_parameters()));
    loaded_.options.output_directory = read_path(private_node_, "output_directory", default_output_directory());
    loaded_.options.rate = read_positive(private_node_, "rate", loaded_.options.rate);
    const Inputs inputs = read_inputs(node_, private_node_);
    loaded_.text = inputs.study.text;
    loaded_.folder = study_folder(inputs);
    Problem problem = codesign::load(inputs, bag_trajectory_loader(loaded_.folder));
    require_every_parameter(inputs, problem.robot());
    require_engine(problem.study().ensemble.engine, loaded_.options.ranks);
    check_recording(problem, loaded_.options.rate, private_node_.resolveName("rate"));
    for (const std::string& sentence : remove_leftovers(loaded_.options.output_directory)) ROS_WARN_STREAM(sentence);
    state_.warn("files", problem.warnings());
    loaded_.problem = std::move(problem);
    state_.show("robot", loaded_.problem->robot().name);
    state_.show("output directory", loaded_.options.output_directory);
    state_.set(NodeState::Level::kOk, "ready: " + loaded_.problem->robot().name + ", " +
                                          std::to_string(loaded_.problem->study().tuned.size()) + " parameters to tune");
  } catch (const InputError& error) {
    loaded_.fault = error.what();
    state_.set(NodeState::Level::kError, "bad input: " + loaded_.fault);
  }
}

bool OptimizationNode::start(const mechanism_codesign::OptimizeGoal& request, const Client& client, Result* refusal) {
  if (!loaded_.problem) {
    refuse("bad_input", loaded_.fault, refusal);
    return false;
  }
  const auto result = std::make_shared<Result>();
  const auto job = [this, request, client, result](const std::atomic<bool>& cancel) {
    if (client.begin) client.begin();
    *result = run(request, client.progress, cancel);
  };
  if (optimizer_.try_start(job, [client, result] { client.end(*result); })) return true;
  refuse("busy", "another optimization is running", refusal);
  return false;
}

OptimizationNode::Result OptimizationNode::run(const mechanism_codesign::OptimizeGoal& request, const FeedbackObserver& observer,
                                               const std::atomic<bool>& cancel) {
  state_.set(NodeState::Level::kOk, "optimizing");
  const auto publish = [&](const mechanism_codesign::OptimizationProgress& progress) {
    progress_.publish(progress);
    state_.show("evaluation", std::to_string(progress.evaluation));
    state_.show("best objective", std::to_string(progress.best_objective));
    tell_progress(progress);
    if (observer) observer(progress);
  };
  const OptimizationOutcome outcome = run_optimization(*loaded_.problem, loaded_.text, request, loaded_.options, publish, cancel);
  if (!outcome.tuned_urdf.empty()) {
    std_msgs::String description;
    description.data = outcome.tuned_urdf;
    tuned_.publish(description);
  }
  application_->note_job(outcome.result.bag);
  state_.warn("last job", warnings_of_job(outcome.result.warnings, loaded_.problem->warnings().size()));
  tell_result(outcome.result);
  return outcome.result;
}

void OptimizationNode::tell_progress(const mechanism_codesign::OptimizationProgress& progress) {
  state_.show("job", progress.job);
  state_.show("stage", progress.stage + ", " + std::to_string(progress.done) + " of " + std::to_string(progress.of));
  state_.show("runs", std::to_string(progress.runs));
  state_.show("runs per second", std::to_string(progress.runs_per_second));
  const std::string seconds = std::isnan(progress.seconds_left) ? "unknown" : std::to_string(progress.seconds_left);
  state_.show("seconds left", (progress.at_most ? "at most " : "") + seconds);
}

void OptimizationNode::tell_result(const Result& result) {
  std::ostringstream sentence;
  if (result.success) {
    sentence << "done: objective " << result.initial_objective << " -> " << result.objective << " (" << result.termination << "), "
             << result.bag;
    state_.set(NodeState::Level::kOk, sentence.str());
  } else {
    state_.set(NodeState::Level::kWarning, "the last optimization ended with " + result.code + ": " + result.message);
  }
}

template <class Reply>
bool OptimizationNode::has_size(const std::vector<std::string>& names, const std::vector<double>& values, const std::string& field,
                                Reply* refusal) const {
  try {
    if (loaded_.problem) check_size(*loaded_.problem, names, values, field);
    return true;
  } catch (const InputError& error) {
    refuse("bad_input", error.what(), refusal);
    return false;
  }
}

bool OptimizationNode::on_optimize(mechanism_codesign::Optimize::Request& request, mechanism_codesign::Optimize::Response& response) {
  const auto done = std::make_shared<std::promise<Result>>();
  const Client client{{}, {}, [done](const Result& result) { done->set_value(result); }};
  Result result;
  if (!has_size(request.parameters, request.start, "start", &result)) {
    response = same_fields<mechanism_codesign::Optimize::Response>(result);
    return true;
  }
  if (start(same_fields<mechanism_codesign::OptimizeGoal>(request), client, &result)) result = done->get_future().get();
  response = same_fields<mechanism_codesign::Optimize::Response>(result);
  return true;
}

bool OptimizationNode::on_evaluate(mechanism_codesign::Evaluate::Request& request, mechanism_codesign::Evaluate::Response& response) {
  if (!loaded_.problem) {
    refuse("bad_input", loaded_.fault, &response);
    return true;
  }
  if (!has_size(request.parameters, request.values, "values", &response)) return true;
  const auto done = std::make_shared<std::promise<void>>();
  const auto job = [this, &request, &response](const std::atomic<bool>& cancel) {
    response = run_evaluation(*loaded_.problem, request, cancel, loaded_.options.ranks);
  };
  if (evaluator_.try_start(job, [done] { done->set_value(); }))
    done->get_future().wait();
  else
    refuse("busy", "another evaluation is running", &response);
  return true;
}

void OptimizationNode::on_goal(GoalHandle goal) {
  Client client;
  client.begin = [goal]() mutable { goal.setAccepted(); };
  client.progress = [goal](const mechanism_codesign::OptimizationProgress& progress) mutable {
    mechanism_codesign::OptimizeFeedback message;
    message.progress = progress;
    goal.publishFeedback(message);
  };
  client.end = [goal](const Result& result) mutable {
    if (result.success)
      goal.setSucceeded(result);
    else if (result.code == "cancelled")
      goal.setCanceled(result, result.message);
    else
      goal.setAborted(result, result.message);
  };
  Result refusal;
  const auto& request = *goal.getGoal();
  if (!has_size(request.parameters, request.start, "start", &refusal) || !start(*goal.getGoal(), client, &refusal))
    goal.setRejected(refusal, refusal.message);
}

/// In actionlib an empty identifier with a zero stamp cancels all goals; here it also cancels a job of the service.
void OptimizationNode::on_cancel_all(const actionlib_msgs::GoalID& goal) {
  if (goal.id.empty() && goal.stamp.isZero()) optimizer_.cancel();
}

void OptimizationNode::on_cancel(const GoalHandle& goal) {
  const unsigned char status = goal.getGoalStatus().status;
  if (status == actionlib_msgs::GoalStatus::RECALLING || status == actionlib_msgs::GoalStatus::PREEMPTING) optimizer_.cancel();
}

bool OptimizationNode::on_cancel_request(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  std::vector<std::string> cancelled;
  if (optimizer_.cancel()) cancelled.emplace_back("the optimization");
  if (identification_->cancel()) cancelled.emplace_back("the identification");
  response.success = !cancelled.empty();
  if (cancelled.empty())
    response.message = "nothing to cancel: no optimization and no identification is running, or it is cancelled already";
  else
    response.message = "cancelled " + list_names(cancelled) + "; its answer has the best point so far";
  return true;
}

RunningNode make_optimization_node(Dispatcher* ranks) {
  const auto node = std::make_shared<OptimizationNode>(ranks);
  return {node, [node] { node->finish(); }};
}

}  // namespace codesign
