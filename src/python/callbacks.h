// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "python/conversions.h"
#include "python/interruption.h"
#include "python/jobs.h"
#include "python/python_lock.h"

namespace codesign::python {

/// Hands the progress of a job, which runs without Python's lock, to a function of Python. An
/// exception of that function ends the job, and is raised behind it.
class Told {
 public:
  /// @param progress function(line, fields); None: nothing is told. Must outlive this.
  Told(pybind11::handle progress, Interruption* interruption)
      : progress_(progress), interruption_(interruption) {}

  Tell tell();

 private:
  bool call(const std::string& line, const Json& fields);

  const pybind11::handle progress_;
  Interruption* const interruption_;
};

/// work(tell, cancel) without Python's lock, told to `progress`, ended early by Ctrl-C, by `cancel`
/// (an event of `threading`, or None), and by an exception of either. @throws
/// pybind11::error_already_set for Ctrl-C and for this exception
template <class Work>
auto job(pybind11::handle progress, pybind11::handle cancel, const Work& work) {
  Interruption interruption;
  Told told(progress, &interruption);
  auto result = [&] {
    const Unlocked unlocked;
    const EventWatch watch(cancel, &interruption);
    return work(told.tell(), interruption.flag());
  }();
  interruption.check();
  return result;
}

}  // namespace codesign::python
