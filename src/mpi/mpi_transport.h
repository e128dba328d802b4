// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <chrono>
#include <list>

#include "engine/transport.h"

namespace codesign {

/// The ranks of MPI_COMM_WORLD. MPI is initialized by the constructor and finalized by finish();
/// there is one object per process.
class MpiTransport final : public Transport {
 public:
  /// @throws std::runtime_error if MPI cannot be initialized for calls from one thread at a time.
  MpiTransport();
  ~MpiTransport() override = default;
  MpiTransport(const MpiTransport&) = delete;
  MpiTransport& operator=(const MpiTransport&) = delete;

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  void send(int to, std::string bytes) override;
  std::optional<Envelope> receive() override;
  std::string failure() const override { return failure_; }

  /// Waits until all messages are sent, at most for this time. @returns whether they are sent.
  bool flush(std::chrono::milliseconds most);
  /// Ends MPI together with all other ranks.
  void finish();
  /// Ends the processes of all ranks, this one as well, with this exit code.
  [[noreturn]] void abort(int code);

 private:
  struct Sending {
    std::string bytes;
    MPI_Request request;
  };
  void move_on();
  bool check(int code, const char* what);

  MPI_Comm world_ = MPI_COMM_NULL;
  int rank_ = 0, ranks_ = 1;
  std::list<Sending> sending_;
  std::string failure_;
};

}  // namespace codesign
