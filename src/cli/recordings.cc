// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/recordings.h"

#include <filesystem>

#include "description/study.h"
#include "identification/effort/effort_doubts.h"
#include "problem/load_problem.h"
#include "text/nearest_name.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {

StudyRecordings read_recordings(const Problem& problem, const Console& console,
                                Warnings* warnings) {
  const std::string folder =
      std::filesystem::absolute(problem.study_text().name).parent_path().string();
  return load_recordings(*study_of(problem).identification, robot_of(problem), folder, console.bags,
                         warnings);
}

std::vector<RecordingSummary> check_recordings(const Problem& problem, const Console& console,
                                               Warnings* warnings) {
  std::vector<RecordingSummary> summaries;
  const std::optional<IdentificationDescription>& identification = study_of(problem).identification;
  if (!identification) return summaries;
  const StudyRecordings recordings = read_recordings(problem, console, warnings);
  for (const std::vector<JointRecording>* list : {&recordings.data, &recordings.holdout})
    for (const JointRecording& recording : *list)
      summaries.push_back(
          summary_of(recording, measured_motion(recording, identification->filter, warnings)));
  append(warnings_of(*identification, find_effort_doubts(problem, recordings.data)), warnings);
  return summaries;
}

void print_recordings(const std::vector<RecordingSummary>& recordings, std::ostream& out) {
  if (recordings.empty()) return;
  constexpr int kDigits = 6;
  Table table;
  table.add({"recording", "samples", "rate [Hz]", "from [s]", "to [s]", "fitted"});
  for (const RecordingSummary& summary : recordings)
    table.add({summary.element, std::to_string(summary.samples), readable(summary.rate, kDigits),
               readable(summary.from, kDigits), readable(summary.to, kDigits),
               std::to_string(summary.fitted)});
  table.print(out);
  for (const RecordingSummary& summary : recordings)
    out << summary.element << ": " << list_names(summary.measured) << " (" << summary.file << ")\n";
}

}  // namespace codesign::cli
