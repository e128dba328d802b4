// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/command_oracle.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/commands.h"
#include "jobs/bag_files.h"
#include "paths.h"

namespace codesign::fuzz {
namespace {

using Json = nlohmann::json;
constexpr const char* kShipped = "SHIPPED/";

struct Outcome {
  int code = 0;
  std::string out, err;
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// An empty folder, the same for all runs of this process.
std::filesystem::path fresh_folder() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("codesign_fuzz_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::vector<std::string> words_of(const Input& input) {
  std::vector<std::string> words = input.arguments;
  for (std::string& word : words)
    if (word.rfind(kShipped, 0) == 0)
      word = source_dir() + word.substr(std::string(kShipped).size() - 1);
  return words;
}

/// Whether a number is missing; numbers that are not finite are printed as null. A bound on one
/// side has null on the other.
bool has_null(const Json& json) {
  if (json.is_null()) return true;
  if (json.is_object())
    return std::any_of(json.items().begin(), json.items().end(), [](const auto& item) {
      return item.key() != "lower" && item.key() != "upper" && has_null(item.value());
    });
  if (!json.is_structured()) return false;
  return std::any_of(json.begin(), json.end(), has_null);
}

/// Checks that a message on bad input names the file, and the line if the file could be read.
std::string judge_bad_input(const Json& error, const Input& input) {
  if (error.value("code", "") == "bad_usage") return "";
  const std::string file = error.value("file", "");
  const int line = error.value("line", 0);
  if (file.empty()) return "bad input without a file: " + error.dump();
  const auto found = input.files.find(file);
  const bool was_read = found != input.files.end() ||
                        (holds(file, source_dir()) && std::filesystem::is_regular_file(file));
  if (was_read && line < 1) return "bad input without a line: " + error.dump();
  if (found != input.files.end() &&
      line > std::count(found->second.begin(), found->second.end(), '\n') + 1)
    return "a line behind the end: " + error.dump();
  return "";
}

std::string judge_json(const Outcome& outcome, const Input& input) {
  const Json json = Json::parse(outcome.out, nullptr, false);
  if (json.is_discarded()) return "no JSON: " + outcome.out.substr(0, 300);
  if (outcome.code == 0) {
    // An identified number without an interval has null there.
    const bool identifies = input.arguments.front() == "identify" && json.contains("parameters");
    if (has_null(identifies ? json["parameters"] : json))
      return "success with a number that is not finite";
    return json.contains("error") ? "success with an error" : "";
  }
  if (!json.contains("error")) return "failure without an error";
  const Json& error = json["error"];
  if (error.value("message", "").empty()) return "an error without a message: " + error.dump();
  if (outcome.code == 2) return judge_bad_input(error, input);
  if (error.value("code", "") == "failed" && !input.disk)
    return "an exception instead of a status: " + error.dump();
  return "";
}

std::string judge(const Outcome& outcome, const Input& input) {
  if (outcome.code < 0 || outcome.code > 2) return "exit code " + std::to_string(outcome.code);
  if (outcome.code != 0 && outcome.err.empty()) return "a failure that says nothing";
  if (input.exit && outcome.code != *input.exit)
    return "exit code " + std::to_string(outcome.code) + " instead of " +
           std::to_string(*input.exit) + ": " + outcome.err;
  if (!holds(outcome.err + outcome.out, input.says))
    return "does not say \"" + input.says + "\": " + outcome.err;
  const std::vector<std::string>& words = input.arguments;
  const bool helps = std::count(words.begin(), words.end(), "--help") +
                         std::count(words.begin(), words.end(), "-h") >
                     0;
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end() && !helps &&
                    words.front() != "help";
  return json ? judge_json(outcome, input) : "";
}

}  // namespace

std::string run_command(const Input& input, const Limits& limits) {
  const std::filesystem::path folder = fresh_folder();
  for (const auto& [name, text] : input.files)
    std::ofstream(folder / name, std::ios::binary) << text;
  const auto body = [&](const std::atomic<bool>& cancel) {
    std::filesystem::current_path(folder);
    std::ostringstream out, err;
    Outcome outcome;
    cli::Console console{out, err, cancel};
    console.bags = bag_files().read;
    outcome.code = cli::run(words_of(input), console);
    outcome.out = out.str();
    outcome.err = err.str();
    return judge(outcome, input);
  };
  const std::string fault = run_isolated(body, limits, input.disk);
  std::filesystem::remove_all(folder);
  return fault;
}

}  // namespace codesign::fuzz
