// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/optimization_node.h"

#include <std_msgs/String.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "description/study.h"
#include "engine/evaluation_engine.h"
#include "jobs/job_files.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "ros/apply/apply.h"
#include "ros/bags/bag_files.h"
#include "ros/common/inputs.h"
#include "ros/common/latched.h"
#include "ros/common/parameters.h"
#include "ros/jobs/messages.h"
#include "ros/jobs/request.h"
#include "ros/scene/recorded_run.h"
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
  return (ros_home != nullptr ? std::string(ros_home)
                              : std::string(home != nullptr ? home : ".") + "/.ros") +
         "/mechanism_codesign";
}

/// Publishes the URDF of a result, if there is one.
void publish_description(const std::string& urdf, const ros::Publisher& publisher) {
  if (urdf.empty()) return;
  std_msgs::String description;
  description.data = urdf;
  publish_latched(publisher, description);
}

std::string share_of(std::uint64_t done, std::uint64_t of) {
  return std::to_string(done) + " of " + std::to_string(of);
}

}  // namespace

OptimizationNode::OptimizationNode(Dispatcher* ranks)
    : state_("optimization"), spinner_(kDoorThreads, &queue_) {
  options_.ranks = ranks;
  optimization_progress_ =
      node_.advertise<mechanism_codesign::OptimizationProgress>("optimization_progress", 100, true);
  tuned_ = node_.advertise<std_msgs::String>("tuned/robot_description", 1, true);
  load();
  identification_progress_ = node_.advertise<mechanism_codesign::IdentificationProgress>(
      "identification_progress", 100, true);
  identified_ = node_.advertise<std_msgs::String>("identified/robot_description", 1, true);
  doors_.setCallbackQueue(&queue_);
  open_doors();
  ros::NodeHandle private_doors(doors_, ros::this_node::getName());
  cancel_ = private_doors.advertiseService("cancel", &OptimizationNode::on_cancel_request, this);
  spinner_.start();
  optimization_->open();
  identification_->open();
}

OptimizationNode::~OptimizationNode() { finish(); }

void OptimizationNode::finish() {
  const bool was_optimizing = optimization_->cancel(), was_identifying = identification_->cancel();
  application_->finish();
  identification_->finish();
  optimization_->finish();
  evaluation_->finish();
  // Returns when the callbacks of services have returned and their answers are sent.
  spinner_.stop();
  // The answers of actions are messages, and long answers of services are the rest of a buffer:
  // ROS sends both in a thread of its own, which on a busy machine waits for its turn.
  if ((was_optimizing || was_identifying) && ros::ok()) ros::WallDuration(1.0).sleep();
}

void OptimizationNode::load() {
  try {
    state_.warn("parameters", unknown_parameters(private_node_, optimization_parameters()));
    options_.output_directory =
        read_path(private_node_, "output_directory", default_output_directory());
    options_.rate = read_positive(private_node_, "rate", options_.rate);
    const Inputs inputs = read_inputs(node_, private_node_);
    study_ = inputs.study.text;
    folder_ = study_folder(inputs);
    Problem problem = codesign::load(inputs, bag_trajectory_loader(folder_));
    require_every_parameter(inputs, robot_of(problem));
    require_engine(study_of(problem).ensemble.engine, options_.ranks);
    check_recording(problem, options_.rate, private_node_.resolveName("rate"));
    for (const std::string& sentence : remove_leftovers(options_.output_directory))
      ROS_WARN_STREAM(sentence);
    state_.warn("files", problem.warnings());
    problem_ = std::move(problem);
    state_.show("robot", robot_of(*problem_).name);
    state_.show("output directory", options_.output_directory);
    state_.set(NodeState::Level::kOk, "ready: " + robot_of(*problem_).name + ", " +
                                          std::to_string(study_of(*problem_).tuned.size()) +
                                          " parameters to tune");
  } catch (const InputError& error) {
    fault_ = error.what();
    state_.set(NodeState::Level::kError, "bad input: " + fault_);
  }
}

void OptimizationNode::open_doors() {
  const auto has_start = [this](const auto& request) {
    check(request.parameters, request.start, "start");
  };
  const auto has_values = [this](const auto& request) {
    check(request.parameters, request.values, "values");
  };
  const auto names_job = [this](mechanism_codesign::ApplyRequest& request) {
    request.result = path_of(request.result);
  };
  optimization_ = std::make_unique<decltype(optimization_)::element_type>(
      doors_, "optimize", "another optimization is running", has_start,
      [this](const auto& request, const auto& observer, const auto& cancel) {
        return optimize(request, observer, cancel);
      });
  evaluation_ = std::make_unique<decltype(evaluation_)::element_type>(
      doors_, "evaluate", "another evaluation is running", has_values,
      [this](const auto& request, const auto&, const auto& cancel) {
        return run_evaluation(*problem_, request, cancel, options_.ranks);
      });
  identification_ = std::make_unique<decltype(identification_)::element_type>(
      doors_, "identify", "another identification is running", has_start,
      [this](const auto& request, const auto& observer, const auto& cancel) {
        return identify(request, observer, cancel);
      });
  application_ = std::make_unique<decltype(application_)::element_type>(
      doors_, "apply", "gains are being sent already", names_job,
      [this](const auto& request, const auto&, const auto& cancel) {
        return apply(request, cancel);
      });
  // Subscribed in the service's namespace, so that a remapping of the service applies to this
  // topic, too.
  cancel_apply_ =
      ros::NodeHandle(doors_, "apply")
          .subscribe<std_msgs::Empty>(
              "cancel", 1, [this](const std_msgs::Empty::ConstPtr&) { application_->cancel(); });
}

void OptimizationNode::check(const std::vector<std::string>& names,
                             const std::vector<double>& values, const std::string& field) const {
  if (!problem_) throw std::runtime_error(fault_);
  check_size(*problem_, names, values, field);
}

OptimizationNode::OptimizeResult OptimizationNode::optimize(
    const mechanism_codesign::OptimizeGoal& request, const FeedbackObserver& observer,
    const std::atomic<bool>& cancel) {
  state_.set(NodeState::Level::kOk, "optimizing");
  const auto publish = [&](const mechanism_codesign::OptimizationProgress& progress) {
    optimization_progress_.publish(progress);
    tell_progress(progress);
    if (observer) observer(progress);
  };
  const OptimizationOutcome outcome =
      run_optimization(*problem_, study_, request, options_, publish, cancel);
  publish_description(outcome.tuned_urdf, tuned_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!outcome.result.bag.empty()) last_bag_ = outcome.result.bag;
  }
  state_.warn("last job", warnings_of_job(outcome.result.warnings, problem_->warnings().size()));
  tell_result(outcome.result);
  return outcome.result;
}

OptimizationNode::IdentifyResult OptimizationNode::identify(
    const mechanism_codesign::IdentifyGoal& request, const IdentificationObserver& observer,
    const std::atomic<bool>& cancel) {
  state_.set(NodeState::Level::kOk, "identifying");
  const auto publish = [&](const mechanism_codesign::IdentificationProgress& progress) {
    identification_progress_.publish(progress);
    state_.show("identification", progress.job);
    state_.show("identification stage",
                progress.stage + ", " + share_of(progress.done, progress.of));
    if (observer) observer(progress);
  };
  const IdentificationOutcome outcome =
      run_identification(*problem_, folder_, request, options_, publish, cancel);
  publish_description(outcome.identified_urdf, identified_);
  state_.warn("last identification",
              warnings_of_job(outcome.result.warnings, problem_->warnings().size()));
  tell_result(outcome.result);
  return outcome.result;
}

OptimizationNode::ApplyResponse OptimizationNode::apply(
    const mechanism_codesign::ApplyRequest& request, const std::atomic<bool>& cancel) {
  ApplyResponse response = apply_gains(request, cancel);
  state_.show("last apply", response.code + ": " + response.message);
  return response;
}

std::string OptimizationNode::path_of(const std::string& result) {
  if (!result.empty()) return path_in(options_.output_directory, result);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_bag_.empty())
    throw InputError({{"request", 0},
                      "result",
                      "this node has finished no optimization yet",
                      "",
                      "the name of a job in " + options_.output_directory});
  return last_bag_;
}

void OptimizationNode::tell_progress(const mechanism_codesign::OptimizationProgress& progress) {
  state_.show("evaluation", std::to_string(progress.evaluation));
  state_.show("best objective", std::to_string(progress.best_objective));
  state_.show("job", progress.job);
  state_.show("stage", progress.stage + ", " + share_of(progress.done, progress.of));
  state_.show("runs", std::to_string(progress.runs));
  state_.show("runs per second", std::to_string(progress.runs_per_second));
  const std::string seconds =
      std::isnan(progress.seconds_left) ? "unknown" : std::to_string(progress.seconds_left);
  state_.show("seconds left", (progress.at_most ? "at most " : "") + seconds);
}

void OptimizationNode::tell_result(const OptimizeResult& result) {
  if (!result.success)
    return state_.set(NodeState::Level::kWarning,
                      "the last optimization ended with " + result.code + ": " + result.message);
  std::ostringstream sentence;
  sentence << "done: objective " << result.initial_objective << " -> " << result.objective << " ("
           << result.termination << "), " << result.bag;
  state_.set(NodeState::Level::kOk, sentence.str());
}

void OptimizationNode::tell_result(const IdentifyResult& result) {
  if (!result.success)
    return state_.set(NodeState::Level::kWarning,
                      "the last identification ended with " + result.code + ": " + result.message);
  std::ostringstream sentence;
  sentence << "identified:";
  for (const auto& number : result.numbers)
    sentence << ' ' << number.name << " = " << number.value << ',';
  sentence << ' ' << result.bag;
  state_.set(NodeState::Level::kOk, sentence.str());
}

bool OptimizationNode::on_cancel_request(std_srvs::Trigger::Request& /*request*/,
                                         std_srvs::Trigger::Response& response) {
  std::vector<std::string> cancelled;
  if (optimization_->cancel()) cancelled.emplace_back("the optimization");
  if (identification_->cancel()) cancelled.emplace_back("the identification");
  response.success = !cancelled.empty();
  if (cancelled.empty())
    response.message =
        "nothing to cancel: no optimization and no identification is running, or it is cancelled "
        "already";
  else
    response.message =
        "cancelled " + list_names(cancelled) + "; its answer has the best point so far";
  return true;
}

RunningNode make_optimization_node(Dispatcher* ranks) {
  const auto node = std::make_shared<OptimizationNode>(ranks);
  return {node, [node] { node->finish(); }};
}

}  // namespace codesign
