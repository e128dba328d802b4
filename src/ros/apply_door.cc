// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply_door.h"

#include <algorithm>
#include <filesystem>
#include <future>
#include <memory>

#include "mechanism_codesign/error.h"
#include "ros/apply_job.h"
#include "ros/job.h"
#include "ros/parameters.h"

namespace codesign {

std::string path_in(const std::string& directory, const std::string& result) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::weakly_canonical(directory), given(expand_home(result));
  const fs::path path = fs::weakly_canonical(given.is_absolute() ? given : folder / given);
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  if (end != folder.end() || rest == path.end())
    throw InputError({{"request", 0}, "result", "not a job of the output directory", result, "a name or a path in " + folder.string()});
  return path.string();
}

ApplyDoor::ApplyDoor(const ros::NodeHandle& doors, const std::string& output_directory, NodeState* state)
    : doors_(doors),
      output_directory_(output_directory),
      state_(*state),
      service_(doors_.advertiseService("apply", &ApplyDoor::on_request, this)),
      // Subscribed in the service's namespace, so that a remapping of the service applies to this topic, too.
      cancel_(ros::NodeHandle(doors_, "apply").subscribe<std_msgs::Empty>("cancel", 1, [this](const std_msgs::Empty::ConstPtr&) {
        worker_.cancel();
      })) {}

void ApplyDoor::note_job(const std::string& bag) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!bag.empty()) last_bag_ = bag;
}

std::string ApplyDoor::path_of(const std::string& result) {
  if (!result.empty()) return path_in(output_directory_, result);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_bag_.empty())
    throw InputError(
        {{"request", 0}, "result", "this node has finished no optimization yet", "", "the name of a job in " + output_directory_});
  return last_bag_;
}

bool ApplyDoor::on_request(mechanism_codesign::Apply::Request& request, mechanism_codesign::Apply::Response& response) {
  std::string path;
  try {
    path = path_of(request.result);
  } catch (const std::exception& error) {
    refuse("bad_input", error.what(), &response);
    return true;
  }
  const auto done = std::make_shared<std::promise<void>>();
  const auto job = [&request, &response, path](const std::atomic<bool>& cancel) { response = apply_gains(request, path, cancel); };
  if (!worker_.try_start(job, [done] { done->set_value(); })) {
    refuse("busy", "gains are being sent already", &response);
    return true;
  }
  done->get_future().wait();
  state_.show("last apply", response.code + ": " + response.message);
  return true;
}

}  // namespace codesign
