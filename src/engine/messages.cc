// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/messages.h"

#include <stdexcept>

namespace codesign {
namespace {

ByteWriter begin(MessageKind kind, std::uint64_t number) {
  ByteWriter writer;
  writer.add(kind);
  writer.add(number);
  return writer;
}

void add(const SourceText& text, ByteWriter* writer) {
  writer->add_text(text.name);
  writer->add_text(text.text);
}

SourceText get_source(ByteReader* reader) {
  std::string name = reader->get_text();
  return {std::move(name), reader->get_text()};
}

void add(const SourceLocation& where, ByteWriter* writer) {
  writer->add_text(where.file);
  writer->add(static_cast<std::int32_t>(where.line));
}

SourceLocation get_location(ByteReader* reader) {
  std::string file = reader->get_text();
  return {std::move(file), reader->get<std::int32_t>()};
}

void add(const LoadedTrajectory& one, ByteWriter* writer) {
  for (const std::string& text : {one.bag, one.topic, one.joint}) writer->add_text(text);
  const auto& [times, positions, velocities, accelerations] = one.trajectory;
  for (const std::vector<double>* values : {&times, &positions, &velocities, &accelerations})
    writer->add_numbers(*values);
}

LoadedTrajectory get_trajectory(ByteReader* reader) {
  LoadedTrajectory one;
  for (std::string* text : {&one.bag, &one.topic, &one.joint}) *text = reader->get_text();
  auto& [times, positions, velocities, accelerations] = one.trajectory;
  for (std::vector<double>* values : {&times, &positions, &velocities, &accelerations})
    *values = reader->get_numbers<std::vector<double>>();
  return one;
}

void add(const LoadedFile& one, ByteWriter* writer) {
  writer->add_text(one.file);
  add(one.source, writer);
}

LoadedFile get_file(ByteReader* reader) {
  std::string file = reader->get_text();
  return {std::move(file), get_source(reader)};
}

/// Reads a list whose entries `get_one` reads.
template <class GetOne>
auto get_list(ByteReader* reader, const GetOne& get_one) {
  std::vector<decltype(get_one(reader))> list;
  for (auto left = reader->get<std::uint64_t>(); left > 0; --left) list.push_back(get_one(reader));
  return list;
}

std::uint64_t size_of(std::size_t size) { return size; }

void add(const Eigen::MatrixXd& matrix, ByteWriter* writer) {
  writer->add(static_cast<std::int64_t>(matrix.rows()));
  writer->add_numbers(matrix);
}

Eigen::MatrixXd get_matrix(ByteReader* reader) {
  const auto rows = reader->get<std::int64_t>();
  const Eigen::VectorXd values = reader->get_numbers<Eigen::VectorXd>();
  if (rows <= 0) return {};
  return values.reshaped(rows, values.size() / rows);
}

void add(const Events& events, ByteWriter* writer) {
  const auto& [list, count, order] = events;
  writer->add(size_of(list.size()));
  for (const auto& [time, element, object, expression, rising, jump] : list) {
    writer->add(time);
    for (const std::string* text : {&element, &object, &expression}) writer->add_text(*text);
    writer->add(rising);
    writer->add(jump);
  }
  writer->add(count);
  writer->add_text(order);
}

Event get_event(ByteReader* reader) {
  Event event;
  event.time = reader->get<double>();
  for (std::string* text : {&event.element, &event.object, &event.expression})
    *text = reader->get_text();
  event.rising = reader->get<bool>();
  event.jump = reader->get<bool>();
  return event;
}

Events get_events(ByteReader* reader) {
  Events events;
  events.list = get_list(reader, get_event);
  events.count = reader->get<std::int64_t>();
  events.order = reader->get_text();
  return events;
}

Warning get_warning(ByteReader* reader) {
  std::string code = reader->get_text(), message = reader->get_text();
  return {std::move(code), std::move(message), get_location(reader)};
}

}  // namespace

std::string write_numbered(MessageKind kind, std::uint64_t number) {
  return begin(kind, number).take();
}

std::string write_hello(const Hello& hello) {
  ByteWriter writer;
  writer.add(MessageKind::kHello);
  writer.add(hello.format);
  writer.add_text(hello.version);
  writer.add_text(hello.host);
  return writer.take();
}

Hello read_hello(ByteReader* reader) {
  Hello hello;
  hello.format = reader->get<std::uint32_t>();
  hello.version = reader->get_text();
  hello.host = reader->get_text();
  return hello;
}

std::string write_problem(std::uint32_t number, const PortableProblem& problem) {
  const auto& [urdf, overlays, study, trajectories, files, values, tuned] = problem;
  ByteWriter writer = begin(MessageKind::kProblem, number);
  add(urdf, &writer);
  writer.add(size_of(overlays.size()));
  for (const SourceText& overlay : overlays) add(overlay, &writer);
  add(study, &writer);
  writer.add(size_of(trajectories.size()));
  for (const LoadedTrajectory& one : trajectories) add(one, &writer);
  writer.add(size_of(files.size()));
  for (const LoadedFile& one : files) add(one, &writer);
  writer.add_numbers(values);
  writer.add(size_of(tuned.size()));
  for (const std::string& name : tuned) writer.add_text(name);
  return writer.take();
}

PortableProblem read_problem(ByteReader* reader) {
  PortableProblem problem;
  problem.urdf = get_source(reader);
  problem.overlays = get_list(reader, get_source);
  problem.study = get_source(reader);
  problem.trajectories = get_list(reader, get_trajectory);
  problem.files = get_list(reader, get_file);
  problem.values = reader->get_numbers<std::vector<double>>();
  problem.tuned = get_list(reader, [](ByteReader* from) { return from->get_text(); });
  return problem;
}

std::string write_task(std::uint64_t number, std::uint32_t problem, std::uint32_t system,
                       Derivatives derivatives, const std::vector<double>& parameters,
                       const RunSteps& steps) {
  ByteWriter writer = begin(MessageKind::kTask, number);
  writer.add(problem);
  writer.add(system);
  writer.add(derivatives);
  writer.add_numbers(parameters);
  writer.add(steps.method);
  writer.add(steps.is_second);
  writer.add(steps.most);
  return writer.take();
}

TaskMessage read_task(std::uint64_t number, ByteReader* reader) {
  TaskMessage task;
  task.number = number;
  task.problem = reader->get<std::uint32_t>();
  task.system = reader->get<std::uint32_t>();
  task.derivatives = reader->get<Derivatives>();
  task.parameters = reader->get_numbers<std::vector<double>>();
  task.steps.method = reader->get<RunSteps::Method>();
  task.steps.is_second = reader->get<bool>();
  task.steps.most = reader->get<std::int32_t>();
  return task;
}

std::string write_result(std::uint64_t number, const Evaluation& evaluation) {
  // All members by name, so that a new member of Evaluation does not compile before it is written
  // here and read in read_result().
  const auto& [status, objective, gradient, jacobian_root, extremes, statistics, warnings, events] =
      evaluation;
  const auto& [code, time, cause] = status;
  const auto& [values, times, gradients] = extremes;
  const auto& [steps, rejected_steps, cpu_seconds, constraint_drift, energy_error, explicit_steps] =
      statistics;
  ByteWriter writer = begin(MessageKind::kResult, number);
  writer.add(code);
  writer.add(time);
  writer.add_text(cause);
  writer.add(objective);
  writer.add_numbers(gradient);
  add(jacobian_root, &writer);
  writer.add_numbers(values);
  writer.add_numbers(times);
  add(gradients, &writer);
  for (const std::int64_t count : {steps, rejected_steps, explicit_steps}) writer.add(count);
  for (const double value : {cpu_seconds, constraint_drift, energy_error}) writer.add(value);
  writer.add(size_of(warnings.size()));
  for (const Warning& warning : warnings) {
    writer.add_text(warning.code);
    writer.add_text(warning.message);
    add(warning.where, &writer);
  }
  add(events, &writer);
  return writer.take();
}

Evaluation read_result(ByteReader* reader) {
  Evaluation evaluation;
  evaluation.status.code = reader->get<StatusCode>();
  evaluation.status.time = reader->get<double>();
  evaluation.status.cause = reader->get_text();
  evaluation.objective = reader->get<double>();
  evaluation.gradient = reader->get_numbers<Eigen::VectorXd>();
  evaluation.jacobian_root = get_matrix(reader);
  evaluation.extremes.values = reader->get_numbers<Eigen::VectorXd>();
  evaluation.extremes.times = reader->get_numbers<Eigen::VectorXd>();
  evaluation.extremes.gradients = get_matrix(reader);
  Statistics& statistics = evaluation.statistics;
  for (std::int64_t* count :
       {&statistics.steps, &statistics.rejected_steps, &statistics.explicit_steps})
    *count = reader->get<std::int64_t>();
  for (double* value :
       {&statistics.cpu_seconds, &statistics.constraint_drift, &statistics.energy_error})
    *value = reader->get<double>();
  evaluation.warnings = get_list(reader, get_warning);
  evaluation.events = get_events(reader);
  return evaluation;
}

std::string write_error(std::uint64_t number, const std::exception_ptr& error) {
  ByteWriter writer = begin(MessageKind::kError, number);
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
  writer.add(is_input);
  add(fault.where, &writer);
  for (const std::string* text : {&fault.element, &fault.message, &fault.value, &fault.allowed})
    writer.add_text(*text);
  return writer.take();
}

std::exception_ptr read_error(ByteReader* reader) {
  const bool is_input = reader->get<bool>();
  InputFault fault;
  fault.where = get_location(reader);
  for (std::string* text : {&fault.element, &fault.message, &fault.value, &fault.allowed})
    *text = reader->get_text();
  if (is_input) return std::make_exception_ptr(InputError(std::move(fault)));
  return std::make_exception_ptr(std::runtime_error(fault.message));
}

}  // namespace codesign
