// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "python/callbacks.h"

#include <utility>

namespace codesign::python {

namespace py = pybind11;

Tell Told::tell() {
  if (progress_.is_none()) return {};
  return [this](const std::string& line, const Json& fields) { return call(line, fields); };
}

bool Told::call(const std::string& line, const Json& fields) {
  const py::gil_scoped_acquire acquire;
  // Python's lock passes to other threads inside the call: the mutex is not held there.
  try {
    progress_(line, to_python(fields));
    return true;
  } catch (py::error_already_set& error) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!error_) error_.emplace(std::move(error));
    interruption_->stop();
    return false;
  }
}

void Told::check() {
  if (!error_) return;
  py::error_already_set error = std::move(*error_);
  error_.reset();
  throw error;
}

}  // namespace codesign::python
