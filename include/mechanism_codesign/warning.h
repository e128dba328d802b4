// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_WARNING_H_
#define MECHANISM_CODESIGN_WARNING_H_

#include <string>
#include <vector>

#include "mechanism_codesign/error.h"

namespace codesign {

/// Something doubtful that does not stop the work. doc/warnings.md lists the codes.
struct Warning {
  std::string code;      ///< snake case, stable: "undetermined_friction"
  std::string message;   ///< the whole sentence for people, with file, line, value, what was done and how to silence it
  SourceLocation where;  ///< line 0 and an empty file where no single place is to blame
};

using Warnings = std::vector<Warning>;

/// A warning about a place in a file. Its message reads `file:line: element: message (value: ..., allowed: ...)`, as that of an InputError.
/// @param fault `message` says what was done and what to write to silence the warning.
Warning warn(const std::string& code, const InputFault& fault);

/// Appends the warnings of `more` that `warnings` does not hold yet (same code and message).
void append(const Warnings& more, Warnings* warnings);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_WARNING_H_
