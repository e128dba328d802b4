// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "python/recorded_arrays.h"

#include <string>
#include <utility>
#include <vector>

#include "mechanism_codesign/error.h"
#include "python/conversions.h"
#include "text/number_text.h"

namespace codesign::python {
namespace {

namespace py = pybind11;

std::vector<double> column_of(const py::handle& values, const std::string& name,
                              const RecordedArrays& of) {
  std::vector<double> numbers = to_numbers(values, name);
  if (numbers.size() != of.times.size())
    throw InputError({{"arrays", 0},
                      of.element == "arrays" ? name : of.element + "." + name,
                      "there is not one number for each time",
                      std::to_string(numbers.size()),
                      std::to_string(of.times.size())});
  return numbers;
}

/// @param recording (name, time, [(joint, position, velocity, effort)], [(signal, values)], set,
/// mask, start, rest)
RecordedArrays arrays_of(const py::tuple& recording) {
  RecordedArrays arrays;
  arrays.element = recording[0].cast<std::string>();
  arrays.times = to_numbers(recording[1], "time");
  for (const py::handle entry : recording[2].cast<py::list>()) {
    const auto columns = entry.cast<py::tuple>();
    JointSamples samples;
    samples.joint = to_name(columns[0], "joints");
    for (std::size_t q = 0; q < kMeasuredQuantityNames.size(); ++q)
      if (const py::object values = columns[q + 1]; !values.is_none())
        samples.of(static_cast<MeasuredQuantity>(q)) =
            column_of(values, samples.joint + "/" + kMeasuredQuantityNames[q], arrays);
    arrays.joints.push_back(std::move(samples));
  }
  for (const py::handle entry : recording[3].cast<py::list>()) {
    const auto pair = entry.cast<py::tuple>();
    const std::string name = to_name(pair[0], "signals");
    arrays.signals.push_back({parse_signal(name, {"arrays", 0}, arrays.element + ".signals"),
                              column_of(pair[1], name, arrays)});
  }
  arrays.settings = to_settings(recording[4].cast<py::dict>());
  for (const auto& [joint, speed] : to_settings(recording[5].cast<py::dict>())) {
    if (!(speed > 0.0))
      throw InputError({{"arrays", 0},
                        arrays.element + ".mask" + (joint.empty() ? "" : "." + joint),
                        "not above zero",
                        to_decimal(speed),
                        "a speed in rad/s or m/s"});
    arrays.masks.push_back({joint, speed, {"arrays", 0}});
  }
  if (const std::string rest = to_name(recording[7], "rest"); rest == kRestRuleNames[1])
    arrays.rest = RestRule::kBounds;
  else if (rest != kRestRuleNames[0])
    throw InputError({{"arrays", 0},
                      arrays.element + ".rest",
                      "no rule for samples at rest",
                      rest,
                      std::string(kRestRuleNames[0]) + ", " + kRestRuleNames[1]});
  if (arrays.rest == RestRule::kBounds && arrays.masks.empty())
    throw InputError({{"arrays", 0},
                      arrays.element + ".rest",
                      "without a mask no sample is at rest",
                      kRestRuleNames[1],
                      "mask=SPEED beside it"});
  for (const auto& [joint, position] : to_settings(recording[6].cast<py::dict>())) {
    StartPosition start{joint, FittedNumber(position)};
    start.position.where = {"arrays", 0};
    arrays.starts.push_back(std::move(start));
  }
  return arrays;
}

}  // namespace

RecordingArrays arrays_of(const py::list& data, const py::list& holdout) {
  RecordingArrays arrays;
  for (const py::handle each : data) arrays.data.push_back(arrays_of(each.cast<py::tuple>()));
  for (const py::handle each : holdout) arrays.holdout.push_back(arrays_of(each.cast<py::tuple>()));
  return arrays;
}

}  // namespace codesign::python
