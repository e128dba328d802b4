// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/journal_fuzz.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/commands.h"
#include "fuzz/mutation.h"
#include "text/fingerprint.h"

namespace codesign::fuzz {
namespace {

using Json = nlohmann::json;
constexpr const char* kJournal = "job/journal.jsonl";

struct Result {
  int code = 0;
  Json json;
  std::string err;
};

Result optimize_with(const char* option, const std::atomic<bool>& cancel) {
  std::ostringstream out, err;
  Result result;
  result.code = cli::run({"optimize", "model.urdf", "study.yaml", "--json", option, "job"},
                         {out, err, cancel});
  result.json = Json::parse(out.str(), nullptr, false);
  result.err = err.str();
  return result;
}

std::string journal_text() {
  std::ostringstream text;
  text << std::ifstream(kJournal, std::ios::binary).rdbuf();
  return text.str();
}

/// Changes the content of one line and gives it the checksum of the new content.
std::string forge_line(const std::string& journal, Dice* dice) {
  std::vector<std::size_t> begins = {0};
  for (std::size_t at = journal.find('\n'); at + 1 < journal.size();
       at = journal.find('\n', at + 1))
    begins.push_back(at + 1);
  const std::size_t begin = dice->pick(begins), end = journal.find('\n', begin);
  const std::string line = journal.substr(begin, end - begin);
  std::string content = mutate_text(line.substr(0, line.rfind(",\"checksum\"")), dice);
  for (char& c : content)
    if (c == '\n') c = ' ';
  return journal.substr(0, begin) + with_checksum(content + "}") + journal.substr(end);
}

std::string judge(const Result& first, const Result& again, bool is_forged) {
  const Json error = again.json.is_object() ? again.json.value("error", Json::object()) : Json();
  if (!error.is_object()) return "no JSON: " + again.err;
  if (again.code == 2) {
    const bool has_place = error.value("file", "") == kJournal && error.value("line", 0) >= 1;
    return has_place ? "" : "bad input without its place: " + error.dump();
  }
  if (again.code == 1 && error.value("code", "") == "failed")
    return "an exception instead of a status: " + error.dump();
  if (is_forged)
    return again.code == 0 || again.code == 1 ? "" : "exit code " + std::to_string(again.code);
  for (const char* key : {"objective", "gradient", "evaluations", "termination"})
    if (again.json.value(key, Json()) != first.json.value(key, Json()))
      return "another " + std::string(key) + " after damage of the journal: " + again.err;
  return again.code == first.code ? ""
                                  : "exit code " + std::to_string(again.code) + ": " + again.err;
}

std::string damage_and_resume(const std::atomic<bool>& cancel, Dice* dice) {
  const Result first = optimize_with("--output", cancel);
  if (!std::filesystem::exists(kJournal) || cancel) return "";
  std::string text = journal_text();
  const bool is_forged = dice->one_in(2);
  for (std::size_t changes = 1 + dice->below(3); changes > 0; --changes)
    text = is_forged ? forge_line(text, dice) : mutate_text(text, dice);
  std::ofstream(kJournal, std::ios::binary) << text;
  const Result again = optimize_with("--resume", cancel);
  return cancel ? "" : judge(first, again, is_forged);
}

}  // namespace

std::string run_resumed(const std::vector<Seed>& seeds, const Limits& limits, Dice* dice) {
  const Seed& seed = dice->pick(seeds);
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("codesign_fuzz_job_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto body = [&](const std::atomic<bool>& cancel) {
    std::filesystem::current_path(folder);
    std::ofstream("model.urdf", std::ios::binary) << seed.urdf;
    std::ofstream("study.yaml", std::ios::binary) << seed.study;
    return damage_and_resume(cancel, dice);
  };
  // A cancelled job with a folder still writes its first and its best run.
  Limits with_runs = limits;
  with_runs.obey_within *= 2.0;
  const std::string fault = run_isolated(body, with_runs);
  std::filesystem::remove_all(folder);
  return fault.empty() ? fault : seed.name + ", damaged journal: " + fault;
}

}  // namespace codesign::fuzz
