// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/evaluation_engine.h"
#include "jobs/journal_lines.h"
#include "problem/load_problem.h"

namespace codesign {

/// The file with all evaluations of a job, doc/study.md. Searches are deterministic given their
/// evaluations, so that the same job with this memory continues where a killed job ended. Line 1
/// identifies the job, every further line is one evaluation (journal_lines.h), written by one call
/// as soon as it is finished. Lines stay in the file; the memory holds only their places.
///
/// A damaged line is not used, so that its evaluation is computed again and appended: a line whose
/// checksum is wrong, whose numbers are not as many as this job has, or that contradicts another
/// line about the same evaluation. warnings() names it. Thread-safe.
class Journal final : public EvaluationMemory {
 public:
  enum class Mode {
    kNew,    ///< the file must not exist
    kResume  ///< the file must exist and be the journal of this job
  };

  /// Creates or opens the file. The unfinished last line of a killed process is dropped.
  /// @throws InputError for a file that is missing, whose first line is damaged, or that is the
  /// journal of another job, naming file and line. OutputError if it cannot be written.
  Journal(std::string path, const Problem& problem, const OptimizerOptions& options, Mode mode);
  ~Journal() override;
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  std::optional<Evaluation> find(const EvaluationTask& task) override;
  /// Appends a line. After a failure to write, nothing more is appended; see failure().
  void keep(const EvaluationTask& task, const Evaluation& evaluation) override;

  /// How many evaluations are in the file.
  std::size_t evaluations() const;
  /// Number of evaluations in the file when it was opened.
  std::size_t resumed() const { return resumed_; }
  /// Sentences for the user about the opened file.
  const std::vector<std::string>& notes() const { return notes_; }
  /// `journal_damaged` if the opened file has damaged lines, naming them.
  Warnings warnings() const;
  /// The reason for missing lines; empty if no line is missing.
  std::string failure() const;

 private:
  struct Line {
    std::int64_t begin = 0, size = 0;
  };
  /// A line with an evaluation that was read, to compare later lines about the same evaluation with
  /// it.
  struct Read {
    std::int64_t number = 0;
    std::size_t outcome = 0;  ///< hash of what the evaluation has found
  };
  struct Damage {
    std::int64_t number = 0;
    std::string reason;
  };
  using ReadLines = std::unordered_map<std::size_t, Read>;
  void open_file(Mode mode);
  void read();
  void check_header(const std::string& line) const;
  void add_line(std::int64_t number, const std::string& line, ReadLines* before);
  void require_fit(const EvaluationRecord& record) const;
  bool append(const std::string& line);
  std::optional<Evaluation> look_up(std::size_t key, const EvaluationTask& task) const;

  const std::string path_, header_;
  const std::size_t parameters_;  ///< number of parameters
  const Eigen::Index tuned_;      ///< number of tuned parameters
  const std::map<const CompiledSystem*, int> systems_;
  /// number of extreme values of an evaluation, by system
  const std::vector<Eigen::Index> extremes_;
  int file_ = -1;
  std::size_t resumed_ = 0;
  std::vector<std::string> notes_;
  /// in the order of the lines, except for lines that a later line contradicts
  std::vector<Damage> damages_;
  mutable std::mutex mutex_;  // guards all members below
  std::unordered_multimap<std::size_t, Line> lines_;
  std::int64_t end_ = 0;  ///< size of the file
  std::string failure_;
};

/// @throws InputError if there is no journal at `path`.
void require_journal(const std::string& path);

}  // namespace codesign
