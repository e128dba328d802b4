// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/run_control.h"

#include "text/number_text.h"

namespace codesign {
namespace {

std_srvs::TriggerResponse trigger_reply(bool success, const std::string& message) {
  std_srvs::TriggerResponse response;
  response.success = static_cast<std::uint8_t>(success);
  response.message = message;
  return response;
}

}  // namespace

void RunControl::advertise(ros::NodeHandle node) {
  serve(&node, "pause", &RunControl::pause);
  serve(&node, "resume", &RunControl::resume);
  serve(&node, "step", &RunControl::step);
  serve(&node, "restart", &RunControl::restart);
}

void RunControl::serve(ros::NodeHandle* node, const std::string& name, Service service) {
  const boost::function<bool(std_srvs::TriggerRequest&, std_srvs::TriggerResponse&)> callback =
      [this, service](std_srvs::TriggerRequest&, std_srvs::TriggerResponse& response) {
        response = (this->*service)();
        return true;
      };
  servers_.push_back(node->advertiseService(name, callback));
}

void RunControl::configure(bool paused, std::int64_t step_frames) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = paused;
  step_frames_ = step_frames;
}

// note_frame() answers ~restart, since the answer means that the new run has its first frame.
void RunControl::begin_run() {
  const std::lock_guard<std::mutex> lock(mutex_);
  begun_ = running_ = true;
  restart_ = stands_ = false;
  leaving_ = stopped_;
  steps_left_ = 0;
  changed_.notify_all();
}

void RunControl::note_frame(double time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (time == 0.0) ++runs_;
  time_ = time;
  stands_ = false;
  if (steps_left_ > 0) --steps_left_;
  changed_.notify_all();
}

void RunControl::end_run(const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = false;
  why_ = why;
  changed_.notify_all();
}

void RunControl::stop(const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  leaving_ = stopped_ = true;
  why_ = why;
  changed_.notify_all();
}

bool RunControl::is_paused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return paused_ && steps_left_ == 0;
}

bool RunControl::stand_if_paused() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stands_ = paused_ && steps_left_ == 0;
  if (stands_) changed_.notify_all();
  return stands_;
}

bool RunControl::wants_restart() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return restart_;
}

std_srvs::TriggerResponse RunControl::refusal() const {
  return trigger_reply(false, stopped_ || !begun_ ? why_ : why_ + "; ~restart begins again");
}

std::unique_lock<std::mutex> RunControl::lock_when_known() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return begun_ || stopped_ || !why_.empty(); });
  return lock;
}

// Answered when the run stands: the frame that is computed meanwhile is still published.
std_srvs::TriggerResponse RunControl::pause() {
  std::unique_lock<std::mutex> lock = lock_when_known();
  if (stopped_ || !running_) return refusal();
  paused_ = true;
  steps_left_ = 0;
  changed_.notify_all();
  bell_->ring();
  changed_.wait(lock, [this] { return stands_ || !paused_ || !running_ || stopped_; });
  if (stopped_ || !running_) return refusal();
  const std::string time = "t = " + to_decimal(time_) + " s";
  return paused_ ? trigger_reply(true, "paused after " + time)
                 : trigger_reply(false, "another request has resumed the run at " + time);
}

std_srvs::TriggerResponse RunControl::resume() {
  const std::unique_lock<std::mutex> lock = lock_when_known();
  if (stopped_ || !running_) return refusal();
  paused_ = stands_ = false;
  steps_left_ = 0;
  changed_.notify_all();
  bell_->ring();
  return trigger_reply(true, "continues from t = " + to_decimal(time_) + " s");
}

std_srvs::TriggerResponse RunControl::step() {
  std::unique_lock<std::mutex> lock = lock_when_known();
  if (stopped_ || !running_) return refusal();
  if (steps_left_ > 0) return trigger_reply(false, "another ~step has not ended");
  // A frame that is on its way, such as the first of a run, is none of those that this request asks
  // for.
  changed_.wait(lock, [this] { return stands_ || !paused_ || !running_ || stopped_; });
  if (stopped_ || !running_) return refusal();
  if (!paused_) return trigger_reply(false, "the run is not paused; call ~pause first");
  steps_left_ = step_frames_;
  stands_ = false;
  const std::uint64_t run = runs_;
  bell_->ring();
  changed_.wait(lock, [&] {
    return steps_left_ == 0 || !paused_ || !running_ || stopped_ || restart_ || runs_ != run;
  });
  const bool done = paused_ && runs_ == run && !stopped_ && !restart_ && steps_left_ == 0;
  if (!running_) steps_left_ = 0;
  return trigger_reply(done,
                       "t = " + to_decimal(time_) + " s" +
                           (done ? "" : ": " + (running_ ? "the step was interrupted" : why_)));
}

std_srvs::TriggerResponse RunControl::restart() {
  std::unique_lock<std::mutex> lock = lock_when_known();
  if (stopped_ || !begun_) return trigger_reply(false, why_);
  leaving_ = restart_ = true;
  const std::uint64_t run = runs_;
  bell_->ring();
  changed_.wait(lock, [&] { return runs_ != run || stopped_ || (!restart_ && !running_); });
  return runs_ != run ? trigger_reply(true, "begun again") : trigger_reply(false, why_);
}

}  // namespace codesign
