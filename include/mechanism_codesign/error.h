// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace codesign {

/// A place in an input file.
struct SourceLocation {
  std::string file;  ///< empty where no file is known
  int line = 0;      ///< from 1; 0 means the file as a whole
};

/// An invalid input, with all that a user needs to correct it.
struct InputFault {
  SourceLocation where;
  std::string element;  ///< e.g. `<joint name="crank_joint">` or `objective.integral[0].signal`
  std::string message;  ///< what is wrong, one sentence without a final stop
  std::string value;    ///< the offending value as written; may be empty
  std::string allowed;  ///< the allowed values or range; may be empty
};

/// Invalid input, thrown by the function that reads it. Numerical failures never throw it; they
/// return a Status (status.h).
///
/// `what()` reads `file:line: element: message (value: ..., allowed: ...)` without the parts that
/// are empty. Element and value are cut after 300 bytes, message and allowed values after 1000,
/// there and in fault().
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputFault fault);
  const InputFault& fault() const { return fault_; }

 private:
  InputFault fault_;
};

}  // namespace codesign
