// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/isolation.h"

#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <exception>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CODESIGN_SANITIZED 1
// A sanitizer's report must end the process by a signal, so that it differs from every exit code of
// the program. Leaks are not detected, because the child exits without freeing its memory.
extern "C" const char* __asan_default_options() {
  return "abort_on_error=1:detect_leaks=0:allocator_may_return_null=0";
}
extern "C" const char* __ubsan_default_options() { return "abort_on_error=1:print_stacktrace=1"; }
#endif

namespace codesign::fuzz {
namespace {

constexpr char kEnd = '\x04';  // the last byte of a report that is complete

std::atomic<bool> time_is_up{false};
extern "C" void on_time_up(int) { time_is_up = true; }

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void set_limits(const Limits& limits, const std::optional<long>& disk) {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPROF, on_time_up);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(limits.cancel_after);
  timer.it_value.tv_usec = static_cast<suseconds_t>(
      1e6 * (limits.cancel_after - static_cast<double>(timer.it_value.tv_sec)));
  setitimer(ITIMER_PROF, &timer, nullptr);
  const auto most = static_cast<rlim_t>(limits.cancel_after + 10.0 * limits.obey_within + 2.0);
  const rlimit cpu{most, most + 1}, core{0, 0};
  setrlimit(RLIMIT_CPU, &cpu);
  setrlimit(RLIMIT_CORE, &core);
  if (disk) {
    const rlimit bytes{static_cast<rlim_t>(*disk), static_cast<rlim_t>(*disk)};
    setrlimit(RLIMIT_FSIZE, &bytes);
  }
}

std::string judge_resources(const Limits& limits) {
  const double late = processor_seconds() - limits.cancel_after - limits.obey_within;
  if (late > 0.0)
    return "did not obey a cancel after " + std::to_string(limits.cancel_after) +
           " s: " + std::to_string(late) + " s late";
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  if (limits.kilobytes > 0 && usage.ru_maxrss > limits.kilobytes)
    return "took " + std::to_string(usage.ru_maxrss) + " kB of memory";
  return "";
}

[[noreturn]] void be_the_child(const Body& body, const Limits& limits,
                               const std::optional<long>& disk, int report) {
  set_limits(limits, disk);
  std::string fault;
  try {
    fault = body(time_is_up);
  } catch (const std::exception& error) {
    fault = std::string("an exception got out: ") + error.what();
  }
  if (fault.empty()) fault = judge_resources(limits);
  fault += kEnd;
  _exit(write(report, fault.data(), fault.size()) == static_cast<ssize_t>(fault.size()) ? 0 : 1);
}

std::string describe_end(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return "never ends";
  if (WIFSIGNALED(status)) return std::string("killed by a signal: ") + strsignal(WTERMSIG(status));
  return "left with exit code " + std::to_string(WEXITSTATUS(status)) + " in the middle";
}

}  // namespace

Limits default_limits() {
#ifdef CODESIGN_SANITIZED
  return {20.0, 10.0, 0};
#else
  return {};
#endif
}

std::string run_isolated(const Body& body, const Limits& limits, std::optional<long> disk) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    be_the_child(body, limits, disk, ends[1]);
  }
  close(ends[1]);
  std::string report;
  char buffer[4096];
  for (ssize_t count = 0; (count = read(ends[0], buffer, sizeof buffer)) > 0;)
    report.append(buffer, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (report.empty() || report.back() != kEnd) return describe_end(status);
  report.pop_back();
  return report;
}

}  // namespace codesign::fuzz
