// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Loads libcodesign_bags.so when a bag is first read or written: the libraries of ROS that it links
// would take 40 % of the time in which the program starts. See
// doc/decisions/0072-bags-on-demand.md.
#include <dlfcn.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "mechanism_codesign/version.h"
#include "ros/bags/bag_files.h"

namespace codesign {
namespace {

/// The module lies beside the library that has version(). Empty if it is not there: the program may
/// be installed without what needs ROS.
std::string module_path() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&version), &library) == 0) return "";
  const auto folder = std::filesystem::path(library.dli_fname).parent_path();
  const std::string path = (folder / "libcodesign_bags.so").string();
  return access(path.c_str(), F_OK) == 0 ? path : "";
}

const BagFiles* load() {
  // Never closed, since libraries of ROS leave threads and handlers behind.
  void* const module = dlopen(module_path().c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = module ? dlsym(module, "codesign_bag_files") : nullptr;
  if (!function)
    throw std::runtime_error(std::string("bags can be neither read nor written: ") + dlerror());
  return reinterpret_cast<decltype(&codesign_bag_files)>(function)();
}

const BagFiles& loaded() {
  static const BagFiles* const files = load();
  return *files;
}

}  // namespace

BagFiles bag_files() {
  if (module_path().empty()) return {};
  return {[](const RecordingDescription& description, const std::string& path,
             const std::vector<std::string>& joints,
             Warnings* warnings) { return loaded().read(description, path, joints, warnings); },
          [](const std::string& path, const IdentificationShow& show) {
            loaded().write_identification(path, show);
          },
          [](const std::string& path, const TrajectoryPoints& points) {
            loaded().write_trajectory(path, points);
          }};
}

}  // namespace codesign
