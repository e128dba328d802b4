// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "jobs/journal_header.h"
#include "jobs/output_error.h"

namespace codesign {
namespace {

constexpr mode_t kFileMode = 0666;

std::map<const CompiledSystem*, int> number_systems(const Problem& problem) {
  std::map<const CompiledSystem*, int> numbers;
  for (const auto& system : distinct_systems(problem)) numbers.emplace(system.get(), static_cast<int>(numbers.size()));
  return numbers;
}

std::size_t key_of(int system, Derivatives derivatives, const std::vector<double>& parameters) {
  const std::string_view bits(reinterpret_cast<const char*>(parameters.data()), parameters.size() * sizeof(double));
  return std::hash<std::string_view>()(bits) + 3 * static_cast<std::size_t>(system) + static_cast<std::size_t>(derivatives);
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

void require_journal(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError({{path, 0}, "", "there is no journal to resume", "", "the folder of an optimization that was killed or cancelled"});
}

Journal::Journal(std::string path, const Problem& problem, const OptimizerOptions& options, Mode mode)
    : path_(std::move(path)),
      header_(journal_header(problem, options)),
      parameters_(problem.all_parameters().size()),
      systems_(number_systems(problem)) {
  if (mode == Mode::kResume) read();
  open_file(mode);
}

Journal::~Journal() {
  if (file_ >= 0) close(file_);
}

void Journal::refuse(std::int64_t line, const std::string& message, const std::string& value, const std::string& allowed) const {
  throw InputError({{path_, static_cast<int>(line)}, "", message, value, allowed});
}

void Journal::read() {
  require_journal(path_);
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  std::int64_t number = 0;
  while (std::getline(file, line)) {
    ++number;
    // Each line was written with its end, by one call.
    if (file.eof()) {
      notes_.push_back(path_ + ": line " + std::to_string(number) + ", the last one, was not finished and is dropped");
      break;
    }
    add_line(number, line);
    end_ += static_cast<std::int64_t>(line.size()) + 1;
  }
  if (!file.eof()) refuse(0, "the journal cannot be read");
  resumed_ = lines_.size();
  notes_.push_back("goes on from " + path_ + ", which has " + std::to_string(resumed_) + " finished evaluations");
}

void Journal::add_line(std::int64_t number, const std::string& line) {
  if (number == 1) {
    const std::string difference = header_difference(line, header_);
    if (!difference.empty()) refuse(1, difference + "; optimize without resuming, or in another folder");
    return;
  }
  try {
    const EvaluationRecord record = read_line(line);
    const bool fits = record.parameters.size() == parameters_ && record.system >= 0 && record.system < static_cast<int>(systems_.size());
    if (!fits) throw std::invalid_argument("it is of another job");
    lines_.emplace(key_of(record.system, record.derivatives, record.parameters), Line{end_, static_cast<std::int64_t>(line.size())});
  } catch (const std::exception& error) {
    refuse(number, std::string("the line is damaged: ") + error.what(), line.substr(0, 80),
           "an evaluation; take this line and all below it out of the file to compute them again");
  }
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
    done += static_cast<std::size_t>(written);
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
    std::string line(static_cast<std::size_t>(place->second.size), '\0');
    if (pread(file_, line.data(), line.size(), place->second.begin) != static_cast<ssize_t>(line.size())) continue;
    EvaluationRecord record = read_line(line);
    const bool same = record.system == systems_.at(task.system.get()) && record.derivatives == task.derivatives &&
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
