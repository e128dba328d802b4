// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "patience.h"

namespace codesign {

/// A program that runs beside the test, with its output in files. Killed by the destructor if it
/// still runs.
class ChildProcess {
 public:
  /// @param output, error paths; @param file_size largest file the program may write [bytes], as if
  /// the disk were full beyond; 0: no limit.
  ChildProcess(std::vector<std::string> words, const std::string& output = "/dev/null",
               const std::string& error = "/dev/null", rlim_t file_size = 0)
      : pid_(fork()) {
    if (pid_ != 0) return;
    dup2(open(output.c_str(), O_WRONLY | O_CREAT, 0666), 1);
    dup2(open(error.c_str(), O_WRONLY | O_CREAT, 0666), 2);
    if (file_size > 0) {
      const rlimit limit{file_size, file_size};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  ~ChildProcess() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void send(int signal) const { kill(pid_, signal); }

  /// Its exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_;
};

}  // namespace codesign
