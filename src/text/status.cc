// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "mechanism_codesign/error.h"
#include "mechanism_codesign/source_text.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A text longer than `most` bytes is cut and ends with "...", so that messages stay readable.
std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
    --end;  // do not cut a UTF-8 character
  return text.substr(0, end) + "...";
}

InputFault shortened(InputFault fault) {
  for (std::string* part : {&fault.element, &fault.value}) *part = shortened(*part, 300);
  for (std::string* part : {&fault.message, &fault.allowed})
    *part = shortened(*part, 1000);  // these may show an element to write
  return fault;
}

std::string describe(const InputFault& fault) {
  std::string text = fault.where.file;
  if (fault.where.line > 0) text += ":" + std::to_string(fault.where.line);
  if (!text.empty()) text += ": ";
  if (!fault.element.empty()) text += fault.element + ": ";
  text += fault.message;
  if (fault.value.empty() && fault.allowed.empty()) return text;
  text += " (";
  if (!fault.value.empty()) text += "value: " + fault.value;
  if (!fault.value.empty() && !fault.allowed.empty()) text += ", ";
  if (!fault.allowed.empty()) text += "allowed: " + fault.allowed;
  return text + ")";
}

}  // namespace

InputError::InputError(InputFault fault)
    : std::runtime_error(describe(shortened(fault))), fault_(shortened(std::move(fault))) {}

Warning warn(const std::string& code, const InputFault& fault) {
  return {code, InputError(fault).what(), fault.where};
}

void append(const Warnings& more, Warnings* warnings) {
  std::set<std::pair<std::string, std::string>> known;
  for (const Warning& warning : *warnings) known.emplace(warning.code, warning.message);
  for (const Warning& warning : more)
    if (known.emplace(warning.code, warning.message).second) warnings->push_back(warning);
}

SourceText read_source(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError({{path, 0}, "", "this is a folder", "", "a file"});
  if (!std::filesystem::exists(path, error))
    throw InputError({{path, 0},
                      "",
                      "there is no such file",
                      "",
                      "a file; a relative path of the command line begins in the current folder, "
                      "one in a study in the folder of the study"});
  std::ifstream file(path, std::ios::binary);
  if (file && file.peek() == std::ifstream::traits_type::eof())
    throw InputError({{path, 1}, "", "the file is empty", "", "a file with contents"});
  if (!file)
    throw InputError(
        {{path, 0}, "", "the file cannot be read", "", "a file that this user may read"});
  // Devices and pipes may never end.
  constexpr std::size_t kMost = 32000000;
  std::string text;
  std::array<char, 65536> block;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMost)
      throw InputError({{path, 1}, "", "the file is too large", "", "at most 32 MB"});
  }
  if (file.bad())
    throw InputError(
        {{path, 0}, "", "the file cannot be read", "", "a file that this user may read"});
  return {path, text};
}

const char* name_of(StatusCode code) {
  switch (code) {
    case StatusCode::kSuccess:
      return "success";
    case StatusCode::kCancelled:
      return "cancelled";
    case StatusCode::kAssemblyFailed:
      return "assembly_failed";
    case StatusCode::kInitialVelocityFailed:
      return "initial_velocity_failed";
    case StatusCode::kInitialReactionsFailed:
      return "initial_reactions_failed";
    case StatusCode::kSingularMatrix:
      return "singular_matrix";
    case StatusCode::kStepSizeTooSmall:
      return "step_size_too_small";
    case StatusCode::kTooManySteps:
      return "too_many_steps";
    case StatusCode::kUnstableMotion:
      return "unstable_motion";
    case StatusCode::kNonFinite:
      return "non_finite";
    case StatusCode::kInvalidDesign:
      return "invalid_design";
    case StatusCode::kSingularConfiguration:
      return "singular_configuration";
    case StatusCode::kConstraintDrift:
      return "constraint_drift";
    case StatusCode::kEnergyError:
      return "energy_error";
    case StatusCode::kInfeasible:
      return "infeasible";
    case StatusCode::kAlgorithmFailed:
      return "algorithm_failed";
    case StatusCode::kNonFiniteGradient:
      return "non_finite_gradient";
    case StatusCode::kWorkerLost:
      return "worker_lost";
    case StatusCode::kNoEquilibrium:
      return "no_equilibrium";
    case StatusCode::kNotIdentifiable:
      return "not_identifiable";
    case StatusCode::kSwitchHolds:
      return "switch_holds";
  }
  return "unknown";
}

namespace {

/// "at t = 0.5 s", or nothing for what ended a search, which has no time of a run.
std::string moment(const Status& status) {
  switch (status.code) {
    case StatusCode::kCancelled:
    case StatusCode::kInfeasible:
    case StatusCode::kAlgorithmFailed:
    case StatusCode::kWorkerLost:
    case StatusCode::kNonFiniteGradient:
    case StatusCode::kNoEquilibrium:
    case StatusCode::kNotIdentifiable:
      if (status.time == 0.0) return "";
      break;
    default:
      break;
  }
  return "at t = " + readable(status.time) + " s";
}

}  // namespace

std::string describe(const Status& status) {
  const std::string at = moment(status);
  return std::string(name_of(status.code)) + (at.empty() ? "" : " " + at) +
         (status.cause.empty() ? "" : ": " + status.cause);
}

std::string reason(const Status& status) {
  const std::string at = moment(status);
  return status.cause + (at.empty() ? "" : " (" + at + ")");
}

}  // namespace codesign
