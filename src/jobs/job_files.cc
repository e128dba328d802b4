// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/job_files.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "description/study.h"
#include "jobs/files.h"
#include "math/arrays.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"
#include "reading/urdf/floating_base.h"

namespace codesign {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = ".job";
constexpr const char* kJournal = ".journal.jsonl";
const std::array<std::string, 2> kBest = {".best.urdf", ".best.json"};
/// Length reserved after the robot's name for the date, a number and the longest suffix.
constexpr std::size_t kBehindTheName = 48;

std::string file_name_of(std::string robot, const std::string& directory) {
  const long longest = pathconf(directory.c_str(), _PC_NAME_MAX);
  const std::size_t room = longest > 0 ? to_index(longest) : 255;
  robot.resize(std::min(robot.size(), std::max(room, kBehindTheName + 1) - kBehindTheName));
  for (char& c : robot)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return robot.empty() ? "robot" : robot;
}

std::string time_stamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 32> stamp{};
  std::strftime(stamp.data(), stamp.size(), "%Y-%m-%d-%H-%M-%S", &local);
  return stamp.data();
}

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

bool has_files(const std::string& stem) {
  return exists(stem) || exists(stem + ".bag") || exists(stem + ".bag.active") ||
         exists(stem + kBest[0]) || exists(stem + kBest[1]) || exists(stem + kJournal) ||
         exists(stem + ".identification.json");
}

std::string bare_name(const std::string& stem) { return fs::path(stem).filename().string(); }

/// The first name for a bag that is not taken. A cancelled job already has a bag when it is
/// resumed.
std::string free_bag(const std::string& stem) {
  std::string bag = stem + ".bag";
  for (int number = 1; exists(bag); ++number)
    bag = stem + ".resumed" + (number > 1 ? "-" + std::to_string(number) : "") + ".bag";
  return bag;
}

/// Removes the unfinished files of a killed job. Returns a sentence that names the removed files
/// and the best point.
std::string clean(const std::string& stem) {
  std::string removed, kept;
  // ".active" without ".bag" is for a bag of the simulation node in the same folder, whose path may
  // have any ending.
  for (const std::string& suffix : {std::string(".bag.active"), std::string(".active"),
                                    kBest[0] + kPartSuffix, kBest[1] + kPartSuffix}) {
    std::error_code error;
    if (fs::remove(stem + suffix, error)) removed += (removed.empty() ? "" : ", ") + stem + suffix;
  }
  for (const std::string& suffix : kBest)
    if (exists(stem + suffix)) kept += (kept.empty() ? "" : " and ") + stem + suffix;
  return "a job was killed: " +
         (removed.empty() ? stem + " had no unfinished bag" : "removed " + removed) +
         (kept.empty() ? "; it had no best point yet" : "; its best point is in " + kept) +
         (exists(stem + kJournal)
              ? "; a request with resume: " + bare_name(stem) + " goes on with it"
              : "");
}

[[noreturn]] void refuse_resume(const std::string& message, const std::string& value,
                                const std::string& allowed) {
  throw InputError({{"request", 0}, "resume", message, value, allowed});
}

/// Names of jobs consist only of these characters, so that no name leads out of the folder.
void require_bare_name(const std::string& name) {
  constexpr std::size_t kLongest = 255;
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  };
  if (name.empty() || name.size() > kLongest || !std::all_of(name.begin(), name.end(), is_plain))
    refuse_resume("not the name of a job", name.substr(0, 80),
                  "letters, digits, - and _, such as slider_crank_2026-11-23-08-30-00");
}

}  // namespace

Problem load(const Inputs& inputs, const TrajectoryLoader& loader) {
  if (inputs.study.name.empty())
    return load_mechanism_at(inputs.design, inputs.urdf, inputs.overlays, inputs.settings);
  return load_problem_at(inputs.design, inputs.urdf, inputs.overlays, inputs.study, inputs.settings,
                         loader, inputs.study_is_tree ? files_in("") : FileLoader());
}

std::vector<std::string> input_files(const Problem& problem) {
  std::vector<std::string> paths = {problem.urdf().name, problem.study_text().name};
  for (const SourceText& overlay : problem.overlays())
    if (overlay.name != kFloatingBase) paths.push_back(overlay.name);
  for (const LoadedFile& file : contents_of(problem).files) paths.push_back(file.source.name);
  const fs::path folder = fs::absolute(problem.study_text().name).parent_path();
  for (const LoadedTrajectory& trajectory : contents_of(problem).trajectories)
    paths.push_back(folder / trajectory.bag);
  if (const auto& identification = study_of(problem).identification)
    for (const auto* recordings : {&identification->data, &identification->holdout})
      for (const RecordingDescription& recording : *recordings)
        paths.push_back(folder / recording.file);
  return paths;
}

void require_other_files(const std::string& folder, const std::vector<std::string>& names,
                         const std::string& option, const Problem& problem) {
  const std::vector<std::string> inputs = input_files(problem);
  for (const std::string& name : names)
    require_no_input((fs::path(folder) / name).string(), option, "the result " + name, inputs);
}

JobFiles::JobFiles(const std::string& directory, const std::string& robot)
    : JobFiles(reserve(directory, robot)) {}

JobFiles JobFiles::reserve(const std::string& directory, const std::string& robot) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw OutputError(directory, error.message());
  const std::string first =
      (fs::path(directory) / (file_name_of(robot, directory) + "_" + time_stamp())).string();
  std::string stem = first;
  for (int number = 2;; ++number) {
    // The holder of the lock owns the stem. Only then is it safe to check for files of an earlier
    // job with the same stem.
    std::optional<LockFile> lock = LockFile::create(stem + kLock);
    if (lock && !has_files(stem)) return JobFiles(stem, std::move(*lock));
    stem = first + "-" + std::to_string(number);
  }
}

JobFiles JobFiles::resume(const std::string& directory, const std::string& name) {
  require_bare_name(name);
  const std::string stem = (fs::path(directory) / name).string();
  const auto require_journal_here = [&] {
    std::error_code error;
    if (fs::symlink_status(stem + kJournal, error).type() == fs::file_type::regular) return;
    const bool is_complete = exists(stem + ".bag");
    refuse_resume(is_complete ? "the job is complete, its bag is " + stem + ".bag"
                              : "there is no journal " + stem + kJournal,
                  name, "a job of this output directory that was killed or cancelled");
  };
  require_journal_here();
  std::optional<LockFile> lock = LockFile::take(stem + kLock);
  if (!lock) throw JobIsRunning("the job " + name + " is running");
  require_journal_here();  // another process may have completed the job between the two lines above
  clean(stem);
  return JobFiles(stem, std::move(*lock));
}

JobFiles::JobFiles(std::string stem, LockFile lock)
    : stem_(std::move(stem)), bag_(free_bag(stem_)), lock_(std::move(lock)) {}

std::string JobFiles::name() const { return bare_name(stem_); }

std::vector<std::string> remove_leftovers(const std::string& directory) {
  std::vector<std::string> sentences;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() != kLock) continue;
    const std::optional<LockFile> lock = LockFile::take_abandoned(entry->path().string());
    if (lock) sentences.push_back(clean(entry->path().parent_path() / entry->path().stem()));
  }
  return sentences;
}

}  // namespace codesign
