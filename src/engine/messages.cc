// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/messages.h"

#include <stdexcept>

namespace codesign {

// All members by name, so that a new member of a structure does not compile before it is named
// here; written and read in this order.

template <class Bytes>
void members(Bytes& bytes, Hello& x) {
  auto& [format, version, host] = x;
  bytes(format, version, host);
}
template <class Bytes>
void members(Bytes& bytes, SourceLocation& x) {
  auto& [file, line] = x;
  bytes(file, line);
}
template <class Bytes>
void members(Bytes& bytes, SourceText& x) {
  auto& [name, text, origins] = x;
  bytes(name, text, origins);
}
template <class Bytes>
void members(Bytes& bytes, RecordedTrajectory& x) {
  auto& [times, positions, velocities, accelerations] = x;
  bytes(times, positions, velocities, accelerations);
}
template <class Bytes>
void members(Bytes& bytes, LoadedTrajectory& x) {
  auto& [bag, topic, joint, trajectory] = x;
  bytes(bag, topic, joint, trajectory);
}
template <class Bytes>
void members(Bytes& bytes, LoadedFile& x) {
  auto& [file, source] = x;
  bytes(file, source);
}
template <class Bytes>
void members(Bytes& bytes, PortableProblem& x) {
  auto& [urdf, overlays, study, trajectories, files, values, tuned] = x;
  bytes(urdf, overlays, study, trajectories, files, values, tuned);
}
template <class Bytes>
void members(Bytes& bytes, RunSteps& x) {
  auto& [method, is_second, most] = x;
  bytes(method, is_second, most);
}
template <class Bytes>
void members(Bytes& bytes, Status& x) {
  auto& [code, time, cause] = x;
  bytes(code, time, cause);
}
template <class Bytes>
void members(Bytes& bytes, Extremes& x) {
  auto& [values, times, gradients] = x;
  bytes(values, times, gradients);
}
template <class Bytes>
void members(Bytes& bytes, Statistics& x) {
  auto& [steps, rejected, cpu_seconds, drift, energy_error, explicit_steps] = x;
  bytes(steps, rejected, cpu_seconds, drift, energy_error, explicit_steps);
}
template <class Bytes>
void members(Bytes& bytes, Warning& x) {
  auto& [code, message, where] = x;
  bytes(code, message, where);
}
template <class Bytes>
void members(Bytes& bytes, Event& x) {
  auto& [time, element, object, expression, rising, jump] = x;
  bytes(time, element, object, expression, rising, jump);
}
template <class Bytes>
void members(Bytes& bytes, Events& x) {
  auto& [list, count, order] = x;
  bytes(list, count, order);
}
template <class Bytes>
void members(Bytes& bytes, Evaluation& x) {
  auto& [status, objective, gradient, root, extremes, statistics, warnings, events] = x;
  bytes(status, objective, gradient, root, extremes, statistics, warnings, events);
}
template <class Bytes>
void members(Bytes& bytes, InputFault& x) {
  auto& [where, element, message, value, allowed] = x;
  bytes(where, element, message, value, allowed);
}

namespace {

template <class... Values>
std::string message(const Values&... values) {
  ByteWriter writer;
  writer(values...);
  return writer.take();
}

}  // namespace

std::string write_numbered(MessageKind kind, std::uint64_t number) { return message(kind, number); }

std::string write_hello(const Hello& hello) { return message(MessageKind::kHello, hello); }

Hello read_hello(ByteReader* reader) { return reader->get<Hello>(); }

std::string write_problem(std::uint32_t number, const PortableProblem& problem) {
  return message(MessageKind::kProblem, std::uint64_t{number}, problem);
}

PortableProblem read_problem(ByteReader* reader) { return reader->get<PortableProblem>(); }

std::string write_task(std::uint64_t number, std::uint32_t problem, std::uint32_t system,
                       Derivatives derivatives, const std::vector<double>& parameters,
                       const RunSteps& steps) {
  return message(MessageKind::kTask, number, problem, system, derivatives, parameters, steps);
}

TaskMessage read_task(std::uint64_t number, ByteReader* reader) {
  TaskMessage task;
  task.number = number;
  (*reader)(task.problem, task.system, task.derivatives, task.parameters, task.steps);
  return task;
}

std::string write_result(std::uint64_t number, const Evaluation& evaluation) {
  return message(MessageKind::kResult, number, evaluation);
}

Evaluation read_result(ByteReader* reader) { return reader->get<Evaluation>(); }

std::string write_error(std::uint64_t number, const std::exception_ptr& error) {
  InputFault fault;
  bool is_input = false;
  try {
    std::rethrow_exception(error);
  } catch (const InputError& caught) {
    is_input = true;
    fault = caught.fault();
  } catch (const std::exception& caught) {
    fault.message = caught.what();
  } catch (...) {
    fault.message = "an unknown exception";
  }
  return message(MessageKind::kError, number, is_input, fault);
}

std::exception_ptr read_error(ByteReader* reader) {
  const bool is_input = reader->get<bool>();
  auto fault = reader->get<InputFault>();
  if (is_input) return std::make_exception_ptr(InputError(std::move(fault)));
  return std::make_exception_ptr(std::runtime_error(fault.message));
}

}  // namespace codesign
