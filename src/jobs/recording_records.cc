// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/recording_records.h"

#include "jobs/json.h"

namespace codesign {

RecordingSummary summary_of(const JointRecording& recording, const MeasuredMotion& motion) {
  RecordingSummary summary;
  summary.element = recording.element;
  summary.file = recording.file;
  summary.samples = recording.times.size();
  summary.fitted = motion.fitted();
  summary.from = recording.times.front();
  summary.to = recording.times.back();
  summary.rate = motion.times.rate();
  for (const JointSamples& samples : recording.joints)
    for (std::size_t k = 0; k < kMeasuredQuantityNames.size(); ++k)
      if (!samples.of(static_cast<MeasuredQuantity>(k)).empty())
        summary.measured.push_back(samples.joint + "/" + kMeasuredQuantityNames[k]);
  return summary;
}

Json to_json(const std::vector<RecordingSummary>& recordings) {
  Json list = Json::array();
  for (const RecordingSummary& summary : recordings)
    list.push_back({{"recording", summary.element},
                    {"file", summary.file},
                    {"samples", summary.samples},
                    {"rate", summary.rate},
                    {"from", summary.from},
                    {"to", summary.to},
                    {"fitted", summary.fitted},
                    {"measured", summary.measured}});
  return list;
}

}  // namespace codesign
