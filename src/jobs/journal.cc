// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "integration/watch_layout.h"
#include "jobs/files.h"
#include "jobs/journal_lines.h"
#include "math/arrays.h"
#include "text/fingerprint.h"

namespace codesign {
namespace {

constexpr mode_t kFileMode = 0666;

std::map<const CompiledSystem*, int> number_systems(const Problem& problem) {
  std::map<const CompiledSystem*, int> numbers;
  for (const auto& system : distinct_systems(problem))
    numbers.emplace(system.get(), static_cast<int>(numbers.size()));
  return numbers;
}

std::vector<Eigen::Index> count_extremes(const Problem& problem) {
  std::vector<Eigen::Index> counts;
  for (const auto& system : distinct_systems(problem))
    counts.push_back(WatchLayout(system->whole_study()).size());
  return counts;
}

std::size_t hash_of(const std::vector<double>& values) {
  return std::hash<std::string_view>()(
      {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
}

std::size_t key_of(int system, Derivatives derivatives, const std::vector<double>& parameters) {
  return hash_of(parameters) + 3 * to_index(system) + to_index(derivatives);
}

/// What is the same whenever a task is evaluated again.
std::size_t outcome_of(const Evaluation& evaluation) {
  std::vector<double> numbers = {static_cast<double>(evaluation.status.code),
                                 evaluation.status.time, evaluation.objective};
  const auto add = [&numbers](const auto& more) {
    numbers.insert(numbers.end(), more.data(), more.data() + more.size());
  };
  add(evaluation.gradient);
  add(evaluation.jacobian_root);
  add(evaluation.extremes.values);
  add(evaluation.extremes.gradients);
  return hash_of(numbers);
}

void require_count(const char* what, Eigen::Index found, Eigen::Index expected) {
  if (found != expected)
    throw std::invalid_argument("it has " + std::to_string(found) + " numbers of " + what +
                                " instead of " + std::to_string(expected));
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

void require_journal(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown))
    throw InputError({{path, 0},
                      "",
                      "there is no journal to resume",
                      "",
                      "the folder of an optimization that was killed or cancelled"});
}

Journal::Journal(std::string path, const Problem& problem, const OptimizerOptions& options,
                 Mode mode)
    : path_(std::move(path)),
      header_(journal_header(problem, options)),
      parameters_(problem.all_parameters().size()),
      tuned_(to_signed(problem.tuned_names().size())),
      systems_(number_systems(problem)),
      extremes_(count_extremes(problem)) {
  if (mode == Mode::kResume) read();
  open_file(mode);
}

Journal::~Journal() {
  if (file_ >= 0) close(file_);
}

void Journal::read() {
  require_journal(path_);
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  std::int64_t number = 0;
  ReadLines before;
  while (std::getline(file, line)) {
    ++number;
    // Each line was written with its end, by one call.
    if (file.eof()) {
      notes_.push_back(path_ + ": line " + std::to_string(number) +
                       ", the last one, was not finished and is dropped");
      break;
    }
    if (number == 1)
      check_header(line);
    else
      add_line(number, line, &before);
    end_ += static_cast<std::int64_t>(line.size()) + 1;
  }
  if (!file.eof())
    throw InputError(
        {{path_, 0}, "", "the journal cannot be read", "", "a file that this user may read"});
  resumed_ = lines_.size();
  notes_.push_back("goes on from " + path_ + ", which has " + std::to_string(resumed_) +
                   " finished evaluations");
  for (const Warning& warning : warnings()) notes_.push_back(warning.message);
}

void Journal::check_header(const std::string& line) const {
  const std::string difference = header_difference(line, header_);
  if (!difference.empty())
    throw InputError(
        {{path_, 1}, "", difference + "; optimize without resuming, or in another folder", "", ""});
}

void Journal::add_line(std::int64_t number, const std::string& line, ReadLines* before) {
  try {
    const EvaluationRecord record = read_line(line);
    require_fit(record);
    const std::size_t key = key_of(record.system, record.derivatives, record.parameters),
                      outcome = outcome_of(record.evaluation);
    const auto [same, is_new] = before->try_emplace(key, Read{number, outcome});
    if (is_new) lines_.emplace(key, Line{end_, static_cast<std::int64_t>(line.size())});
    if (same->second.outcome == outcome) return;
    // Nothing tells which of the two is right.
    if (lines_.erase(key) > 0)
      damages_.push_back(
          {same->second.number, "line " + std::to_string(number) + " contradicts it"});
    throw std::invalid_argument("it contradicts line " + std::to_string(same->second.number));
  } catch (const std::exception& error) {
    damages_.push_back({number, error.what()});
  }
}

/// @throws std::invalid_argument for a record that no evaluation of this job can have.
void Journal::require_fit(const EvaluationRecord& record) const {
  const bool fits = record.parameters.size() == parameters_ && record.system >= 0 &&
                    record.system < static_cast<int>(systems_.size());
  if (!fits) throw std::invalid_argument("it is of another job");
  const Evaluation& evaluation = record.evaluation;
  if (!evaluation.status.ok()) return;
  if (!std::isfinite(evaluation.objective))
    throw std::invalid_argument("its objective is not finite");
  const Eigen::Index slopes = record.derivatives == Derivatives::kNone ? 0 : tuned_;
  const Eigen::Index extremes = extremes_[to_index(record.system)];
  require_count("the gradient", evaluation.gradient.size(), slopes);
  require_count("the signals' extremes", evaluation.extremes.values.size(), extremes);
  require_count("the slopes of the signals' extremes", evaluation.extremes.gradients.size(),
                extremes * slopes);
}

Warnings Journal::warnings() const {
  if (damages_.empty()) return {};
  constexpr std::size_t kMostNamed = 10;
  const Damage& first = damages_.front();
  std::string others;
  for (std::size_t k = 1; k < std::min(damages_.size(), kMostNamed); ++k)
    others += (k > 1 ? ", " : "") + std::to_string(damages_[k].number);
  if (damages_.size() > kMostNamed)
    others += " and " + std::to_string(damages_.size() - kMostNamed) + " more";
  const std::string sentence = "line " + std::to_string(first.number) +
                               " is damaged: " + first.reason +
                               (others.empty() ? "" : "; damaged, too: " + others) +
                               "; damaged lines are not used, their evaluations are computed again";
  return {warn("journal_damaged", {{path_, static_cast<int>(first.number)}, "", sentence, "", ""})};
}

void Journal::open_file(Mode mode) {
  const int flags = O_RDWR | O_APPEND | O_CLOEXEC | (mode == Mode::kNew ? O_CREAT | O_EXCL : 0);
  file_ = open(path_.c_str(), flags, kFileMode);
  if (file_ >= 0 && ftruncate(file_, end_) == 0 && (end_ > 0 || append(header_))) return;
  const int cause = errno;
  if (file_ >= 0) close(file_);
  throw OutputError::of_system(path_, cause);
}

bool Journal::append(const std::string& line) {
  if (!failure_.empty()) return false;
  const std::string text = line + '\n';
  // A disk that becomes full takes a part of the line; only the next call returns the error.
  std::size_t done = 0;
  ssize_t written = 1;
  errno = 0;
  while (done < text.size() && (written = write(file_, text.data() + done, text.size() - done)) > 0)
    done += to_index(written);
  if (done == text.size()) {
    end_ += static_cast<std::int64_t>(done);
    return true;
  }
  const int cause = errno;
  failure_ = OutputError::of_system(path_, cause).what();
  // Removes the unfinished line, so that the job can be resumed from the file.
  if (ftruncate(file_, end_) != 0) failure_ += "; its last line is not finished";
  errno = cause;
  return false;
}

std::optional<Evaluation> Journal::look_up(std::size_t key, const EvaluationTask& task) const {
  const auto [first, last] = lines_.equal_range(key);
  for (auto place = first; place != last; ++place) {
    std::string line(to_index(place->second.size), '\0');
    if (pread(file_, line.data(), line.size(), place->second.begin) !=
        static_cast<ssize_t>(line.size()))
      continue;
    if (!has_right_checksum(line)) continue;  // the file has changed since it was opened
    EvaluationRecord record = read_line(line);
    const bool same = record.system == systems_.at(task.system.get()) &&
                      record.derivatives == task.derivatives &&
                      same_bits(record.parameters, task.parameters);
    if (same) return std::move(record.evaluation);
  }
  return std::nullopt;
}

std::optional<Evaluation> Journal::find(const EvaluationTask& task) {
  const auto system = systems_.find(task.system.get());
  if (system == systems_.end()) return std::nullopt;
  const std::size_t key = key_of(system->second, task.derivatives, task.parameters);
  const std::lock_guard<std::mutex> lock(mutex_);
  return look_up(key, task);
}

void Journal::keep(const EvaluationTask& task, const Evaluation& evaluation) {
  const auto system = systems_.find(task.system.get());
  if (system == systems_.end()) return;
  const std::string line = to_line({system->second, task.parameters, task.derivatives, evaluation});
  const std::size_t key = key_of(system->second, task.derivatives, task.parameters);
  const std::lock_guard<std::mutex> lock(mutex_);
  const Line place{end_, static_cast<std::int64_t>(line.size())};
  if (append(line)) lines_.emplace(key, place);
}

std::size_t Journal::evaluations() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return lines_.size();
}

std::string Journal::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

}  // namespace codesign
