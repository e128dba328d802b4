// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ERROR_H_
#define MECHANISM_CODESIGN_ERROR_H_

#include <stdexcept>
#include <string>

namespace codesign {

/// A place in one of the user's files. Line 0: the file as a whole.
struct SourceLocation {
  std::string file;
  int line = 0;
};

/// Everything a user needs to mend a faulty input.
struct InputFault {
  SourceLocation where;
  std::string element;  ///< e.g. `<joint name="crank_joint">` or `objective.integral[0].signal`
  std::string message;  ///< what is wrong, one sentence without a final stop
  std::string value;    ///< the offending value as written; may be empty
  std::string allowed;  ///< the allowed values or range; may be empty
};

/// Bad input, thrown where it enters. Never thrown by a numerical failure.
///
/// `what()` reads `file:line: element: message (value: ..., allowed: ...)`.
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputFault fault);
  const InputFault& fault() const { return fault_; }

 private:
  InputFault fault_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ERROR_H_
