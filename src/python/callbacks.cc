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
  const Locked locked;
  try {
    outlive_python([&] { progress_(line, to_python(fields)); });
    return true;
  } catch (py::error_already_set& error) {
    interruption_->fail(std::move(error));
    return false;
  }
}

}  // namespace codesign::python
