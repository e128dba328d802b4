// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/hand_over.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "cli/console.h"

namespace codesign::cli {
namespace {

namespace fs = std::filesystem;

/// The environment with CODESIGN=PROGRAM.
std::vector<std::string> environment_with(const std::string& program) {
  const std::string key = "CODESIGN=";
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::strncmp(*variable, key.c_str(), key.size()) != 0) variables.emplace_back(*variable);
  variables.push_back(key + program);
  return variables;
}

/// Pointers as exec takes them; valid as long as `texts`.
std::vector<char*> pointers_to(std::vector<std::string>* texts) {
  std::vector<char*> pointers;
  for (std::string& text : *texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return kFailed;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kFailed;
}

}  // namespace

std::string find_script(const std::string& name, const std::string& program_folder) {
  // The folder of programs is lib/PACKAGE for rosrun, and bin in a build without ROS.
  for (const char* share : {"../../share/mechanism_codesign", "../share/mechanism_codesign"}) {
    const fs::path place = fs::path(program_folder) / share;
    std::string built;
    std::ifstream file(place / "scripts.path");
    std::getline(file, built);
    for (const fs::path& folder : {place / "scripts", fs::path(built)})
      if (!folder.empty() && fs::exists(folder / name))
        return fs::weakly_canonical(folder / name).string();
  }
  return "";
}

std::string find_gallery(const std::string& program_folder) {
  return find_script("../gallery", program_folder);
}

std::string own_path() { return fs::read_symlink("/proc/self/exe").string(); }

std::string find_program(const std::string& name, const std::string& program_folder) {
  const fs::path path = fs::path(program_folder) / name;
  return access(path.c_str(), X_OK) == 0 && fs::is_regular_file(path) ? path.string() : "";
}

void become(const std::string& program, const std::vector<std::string>& words) {
  const fs::path self = own_path();
  const std::string path = find_program(program, self.parent_path().string());
  if (path.empty())
    throw std::runtime_error("the program " + program + ", which needs ROS, is not beside " +
                             self.string() +
                             ": install ros-mechanism-codesign, or build where ROS is installed "
                             "(doc/building.md)");
  std::vector<std::string> arguments = words;
  arguments.insert(arguments.begin(), path);
  execv(path.c_str(), pointers_to(&arguments).data());
  throw std::runtime_error(path + " cannot be started: " + std::strerror(errno));
}

int hand_over(const std::string& script, const std::vector<std::string>& words) {
  const fs::path program = own_path();
  const std::string path = find_script(script, program.parent_path().string());
  if (path.empty())
    throw std::runtime_error("the script " + script + " of this package is not installed beside " +
                             program.string());
  std::vector<std::string> arguments = words, variables = environment_with(program.string());
  arguments.insert(arguments.begin(), path);
  pid_t child = 0;
  const int error = posix_spawn(&child, path.c_str(), nullptr, nullptr,
                                pointers_to(&arguments).data(), pointers_to(&variables).data());
  if (error != 0) throw std::runtime_error(path + " cannot be started: " + std::strerror(error));
  return wait_for(child);
}

}  // namespace codesign::cli
