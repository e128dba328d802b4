// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace codesign {

/// A message with the rank it comes from.
struct Envelope {
  int from = 0;
  std::string bytes;
};

/// Carries messages between the processes (ranks) of a job. Messages from one rank to another arrive whole and in the order in which they
/// were sent. No call waits for another process. Called by one thread at a time.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  virtual void send(int to, std::string bytes) = 0;
  /// The next message, if one has arrived. Also advances the messages that are being sent.
  virtual std::optional<Envelope> receive() = 0;
  /// A sentence about a failed connection; empty if no connection has failed.
  virtual std::string failure() const = 0;
};

}  // namespace codesign
