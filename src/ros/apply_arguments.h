// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/ApplyRequest.h>
#include <mechanism_codesign/ApplyResponse.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace codesign {

/// The arguments of `codesign apply`.
struct ApplyArguments {
  mechanism_codesign::ApplyRequest request;  ///< `result` is the path of the folder or bag
  bool json = false, help = false;
};

/// A word of the command line that cannot be used.
class ApplyUsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the words after `codesign apply`, without ROS's remappings. @throws ApplyUsageError naming the word.
ApplyArguments parse_apply_arguments(const std::vector<std::string>& words);

/// The text for `codesign apply --help`.
std::string apply_usage();

/// The answer for people: a table of the values, and the message.
std::string apply_table(const mechanism_codesign::ApplyResponse& response);

/// The answer as one JSON object, with the fields of the service; without success `error` has code and message.
std::string apply_json(const mechanism_codesign::ApplyResponse& response);

}  // namespace codesign
