// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/run_bag.h"

#include <filesystem>
#include <system_error>

#include "mechanism_codesign/version.h"

namespace codesign {

template <class Write>
void RunBag::guard(const Write& write) {
  try {
    write();
  } catch (const OutputError& error) {
    bag_.reset();
    lock_.reset();
    state_->warn("bag", {{"output_failed", error.what(), {}}});
  }
}

void RunBag::open(const std::string& description, const std::string& root_frame, const std::vector<std::size_t>& link_parents,
                  const SimulationScene& scene) {
  if (options_.bag.empty()) return;
  link_parents_ = link_parents;
  guard([&] {
    lock_ = lock();
    bag_ = std::make_unique<BagWriter>(options_.bag);
    bag_->write_text("robot_description", description);
    bag_->write_text("version", version());
    bag_->write_latched("scene", 0.0, scene.message({BagWriter::stamp(0.0), root_frame}));
  });
}

// If a killed node left an unlocked lock file, its unfinished bag is removed.
std::optional<LockFile> RunBag::lock() const {
  const std::string path = options_.bag + ".job";
  std::optional<LockFile> abandoned = LockFile::take_abandoned(path);
  if (!abandoned) return LockFile::create(path);
  std::error_code error;
  if (std::filesystem::remove(options_.bag + ".active", error)) ROS_WARN_STREAM("a node was killed: removed " << options_.bag << ".active");
  return abandoned;
}

void RunBag::record(const FrameNames& names, const Frame& frame, const SimulationScene& scene) {
  if (!bag_) return;
  guard([&] {
    bag_->write_frame("", options_.frame_prefix + names.links[0], names, frame, options_.style);
    bag_->write("caption", frame.time, scene.text(frame, {BagWriter::stamp(frame.time), options_.frame_prefix + names.links[0]}));
    bag_->write("tf", frame.time, link_transforms(names, link_parents_, frame, BagWriter::stamp(frame.time), options_.frame_prefix));
  });
}

void RunBag::record(const mechanism_codesign::Commands& commands, double time) {
  if (!bag_) return;
  mechanism_codesign::Commands stamped = commands;
  stamped.header.stamp = BagWriter::stamp(time);
  guard([&] { bag_->write("commands", time, stamped); });
}

void RunBag::close() {
  if (!bag_) return;
  guard([&] {
    bag_->finish();
    state_->show("bag", options_.bag);
    bag_.reset();
    lock_.reset();
  });
}

}  // namespace codesign
