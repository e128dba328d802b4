// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/journal_header.h"

#include "jobs/json.h"
#include "mechanism_codesign/version.h"
#include "text/decimal.h"
#include "text/fingerprint.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// 2: each line has its checksum.
constexpr int kFormat = 2;
constexpr const char* kBegin = "{\"journal\":";

/// A key of the header with its name in messages.
struct Part {
  const char* key;
  const char* name;
};
constexpr Part kParts[] = {{"model", "the model differs"},
                           {"overlays", "the overlays differ"},
                           {"study", "the study differs"},
                           {"start", "the values of the parameters at the start (--set, ~set or a request's start) differ"},
                           {"tuned", "the tuned parameters differ"},
                           {"optimizer", "the options of the optimizer differ"},
                           {"trajectories", "the recorded trajectories that the study names differ"},
                           {"files", "the contents of the files that the study names differ"}};

bool is_whole(const std::string& text) {
  return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
}

std::string overlay_texts(const Problem& problem) {
  std::string text;
  for (const SourceText& overlay : problem.overlays()) text += fingerprint(overlay.text);
  return text;
}

std::string trajectory_numbers(const Problem& problem) {
  std::string text;
  for (const LoadedTrajectory& loaded : problem.contents().trajectories) {
    const RecordedTrajectory& recorded = loaded.trajectory;
    for (const auto* column : {&recorded.times, &recorded.positions, &recorded.velocities, &recorded.accelerations})
      text += format_numbers(*column) + "\n";
  }
  return text;
}

std::string file_texts(const Problem& problem) {
  std::string text;
  for (const LoadedFile& loaded : problem.contents().files) text += fingerprint(loaded.source.text);
  return text;
}

}  // namespace

std::string journal_header(const Problem& problem, const OptimizerOptions& options) {
  std::string tuned;
  for (const std::string& name : problem.tuned_names()) tuned += name + "\n";
  const std::string optimizer =
      options.algorithm + " " + std::to_string(options.max_evaluations) + " " + to_decimal(options.relative_tolerance);
  Json header = {{"journal", kFormat},
                 {"version", version()},
                 {"model", fingerprint(problem.urdf().text)},
                 {"overlays", fingerprint(overlay_texts(problem))},
                 {"study", fingerprint(problem.study_text().text)},
                 {"start", fingerprint(format_numbers(problem.parameters()))},
                 {"tuned", fingerprint(tuned)},
                 {"optimizer", fingerprint(optimizer)}};
  if (const std::string numbers = trajectory_numbers(problem); !numbers.empty()) header["trajectories"] = fingerprint(numbers);
  if (const std::string texts = file_texts(problem); !texts.empty()) header["files"] = fingerprint(texts);
  return with_checksum(header.dump());
}

std::string header_difference(const std::string& found, const std::string& expected) {
  const std::string begin = kBegin, own_format = std::to_string(kFormat);
  if (found.rfind(begin, 0) != 0) return "this is not the journal of an optimization";
  const std::string format = found.substr(begin.size(), found.find(',') - begin.size());
  if (format != own_format && is_whole(format))
    return "the journal has format " + format + ", written by another version of this program, which writes format " + own_format;
  const Json theirs = Json::parse(has_right_checksum(found) ? found : "", nullptr, false), ours = Json::parse(expected);
  if (!theirs.is_object()) return "line 1 is damaged, and only this line says to which job the journal belongs";
  const Json version = theirs.value("version", Json());
  if (version != ours["version"])
    return "the journal is of version " + version.dump() + " of this program, which is version " + ours["version"].dump() +
           "; the bits of results may differ between versions";
  for (const Part& part : kParts)
    if (theirs.value(part.key, Json()) != ours.value(part.key, Json()))
      return std::string(part.name) + " from the journal, which belongs to another job";
  return theirs == ours ? "" : "the journal has a header that this program does not know";
}

}  // namespace codesign
