// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

/// Collects urdfdom's errors during its lifetime. Warnings, for example of a root link with
/// inertia, are dropped.
class ErrorCollector : public console_bridge::OutputHandler {
 public:
  ErrorCollector() : previous_(console_bridge::getOutputHandler()) {
    console_bridge::useOutputHandler(this);
  }
  ~ErrorCollector() override { console_bridge::useOutputHandler(previous_); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      errors_ += (errors_.empty() ? "" : "; ") + text;
  }
  const std::string& errors() const { return errors_; }

 private:
  console_bridge::OutputHandler* previous_;
  std::string errors_;
};

/// The last child of `above` whose name occurs in `words` in brackets or quotation marks, as
/// urdfdom writes names. The last one, since of two elements with the same name the second is the
/// fault.
const tinyxml2::XMLElement* find_named(const tinyxml2::XMLElement* above,
                                       const std::string& words) {
  const tinyxml2::XMLElement* found = nullptr;
  for (const tinyxml2::XMLElement* child = above->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const char* name = child->Attribute("name");
    const std::string word = name != nullptr ? name : "";
    const bool named = words.find("[" + word + "]") != std::string::npos ||
                       words.find("'" + word + "'") != std::string::npos ||
                       words.find("\"" + word + "\"") != std::string::npos;
    if (!word.empty() && named) found = child;
  }
  return found;
}

}  // namespace

void check_with_urdfdom(const XmlDocument& document) {
  const std::string text = document.text(true);
  static std::mutex mutex;  // the output handler is global
  const std::lock_guard<std::mutex> lock(mutex);
  const ErrorCollector collector;
  if (urdf::parseURDF(text) != nullptr) return;
  const tinyxml2::XMLElement* element = find_named(document.robot(), collector.errors());
  throw InputError({document.location(element != nullptr ? element : document.robot()), "<robot>",
                    "urdfdom refuses the file: " + collector.errors(), "",
                    "a file that robot_state_publisher and rviz can read, too"});
}

}  // namespace codesign
