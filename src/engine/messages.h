// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "engine/bytes.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "sensitivity/run_steps.h"

namespace codesign {

// Messages between the ranks of a job. A message is one byte, its MessageKind, followed by the
// fields listed there; numbers keep their bits.

/// Version of the layout of all messages except kHello; a change of any layout needs a new number.
constexpr std::uint32_t kMessageFormat = 4;

enum class MessageKind : std::uint8_t {
  // To rank 0.
  kHello,    ///< Hello: the first message of a rank
  kResult,   ///< number of the task, evaluation
  kError,    ///< number of the task, exception
  kPong,     ///< number of the ping
  kGoodbye,  ///< the answer to kEnd, the last message of a rank
  // To the others.
  kProblem,  ///< number of the problem, PortableProblem
  kTask,     ///< TaskMessage
  /// number of the task; the rank drops a waiting task without an answer and answers a running one
  /// early
  kCancel,
  kForget,  ///< number of the problem
  kPing,    ///< number of the ping
  kEnd,     ///< the job is over
  // To both.
  kSign  ///< sign of life, without fields
};

/// The first message of a rank, which identifies it. Its layout never changes, so that other
/// versions can read it.
struct Hello {
  std::uint32_t format = kMessageFormat;
  std::string version, host;
};

/// A task: a run of a system of a problem at one design.
struct TaskMessage {
  std::uint64_t number = 0;
  std::uint32_t problem = 0, system = 0;  ///< the system's place in distinct_systems()
  Derivatives derivatives = Derivatives::kNone;
  std::vector<double> parameters;
  RunSteps steps{};
};

/// A message that consists of a kind and a number.
std::string write_numbered(MessageKind kind, std::uint64_t number = 0);
std::string write_hello(const Hello& hello);
std::string write_problem(std::uint32_t number, const PortableProblem& problem);
std::string write_task(std::uint64_t number, std::uint32_t problem, std::uint32_t system,
                       Derivatives derivatives, const std::vector<double>& parameters,
                       const RunSteps& steps = {});
std::string write_result(std::uint64_t number, const Evaluation& evaluation);
/// An exception: an InputError is read back as an InputError, any other exception as a
/// std::runtime_error with the same sentence.
std::string write_error(std::uint64_t number, const std::exception_ptr& error);

// Each function reads the fields after kind and number, or after the kind of a message without a
// number. @throws std::runtime_error for a damaged message.
Hello read_hello(ByteReader* reader);
PortableProblem read_problem(ByteReader* reader);
TaskMessage read_task(std::uint64_t number, ByteReader* reader);
Evaluation read_result(ByteReader* reader);
std::exception_ptr read_error(ByteReader* reader);

}  // namespace codesign
