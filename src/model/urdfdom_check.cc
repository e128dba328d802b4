// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "urdfdom_check.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "mechanism_codesign/model/error.h"

namespace codesign {
namespace {

/// Collects errors for as long as it lives; warnings (on a root link with inertia, say) are not ours to repeat.
class ErrorCollector : public console_bridge::OutputHandler {
 public:
  ErrorCollector() : previous_(console_bridge::getOutputHandler()) { console_bridge::useOutputHandler(this); }
  ~ErrorCollector() override { console_bridge::useOutputHandler(previous_); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) errors_ += (errors_.empty() ? "" : "; ") + text;
  }
  const std::string& errors() const { return errors_; }

 private:
  console_bridge::OutputHandler* previous_;
  std::string errors_;
};

}  // namespace

void check_with_urdfdom(const std::string& file, const std::string& text) {
  static std::mutex mutex;  // the output handler is one for the process
  const std::lock_guard<std::mutex> lock(mutex);
  const ErrorCollector collector;
  if (urdf::parseURDF(text) == nullptr) throw InputError({{file, 0}, "<robot>", "urdfdom refuses the file: " + collector.errors(), "", ""});
}

}  // namespace codesign
