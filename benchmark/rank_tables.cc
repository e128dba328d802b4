// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "benchmark/rank_program.h"
#include "benchmark/report.h"
#include "benchmark/slider_crank.h"
#include "engine/messages.h"
#include "jobs/journal.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// The numbers that rank 0 of a rank program prints.
std::vector<double> run_ranks(int ranks, const std::string& what) {
  std::array<char, 4096> self{};
  if (readlink("/proc/self/exe", self.data(), self.size() - 1) < 0)
    throw std::runtime_error("/proc/self/exe cannot be read");
  // In a container everybody is root, and there may be fewer processors than ranks. The last one is
  // Open MPI 5's word for that.
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                           "OMPI_MCA_rmaps_base_oversubscribe"})
    setenv(name, "1", 1);
  setenv("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe", 1);
  const std::string command = std::string(CODESIGN_MPIRUN) + " -n " + std::to_string(ranks) + " '" +
                              self.data() + "' " + kRankProgram + " " + what;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot be started: " + command);
  std::array<char, 4096> line{};
  const char* const text = std::fgets(line.data(), line.size(), pipe);
  if (pclose(pipe) != 0 || text == nullptr) throw std::runtime_error("failed: " + command);
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// Processor time of keeping one evaluation in a journal [s], and the size of its line [bytes].
std::pair<double, double> measure_journal(const Problem& problem) {
  constexpr int kLines = 5000;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("journal_" + std::to_string(getpid()));
  const Evaluation evaluation = Evaluator(problem).evaluate(problem.start(), true);
  const EvaluationTask task{system_of(problem), problem.parameters(), Derivatives::kGradient};
  double seconds = 0.0, bytes = 0.0;
  {
    Journal journal(path.string(), problem, problem.optimizer_options(), Journal::Mode::kNew);
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < kLines; ++k) journal.keep(task, evaluation);
    seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / kLines;
    bytes = static_cast<double>(std::filesystem::file_size(path)) / kLines;
  }
  std::filesystem::remove(path);
  return {seconds, bytes};
}

/// Processor time of writing and reading an evaluation [s] by `convert`.
template <class Convert>
double measure_conversion(const Convert& convert) {
  constexpr int kTimes = 20000;
  double steps = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < kTimes; ++k) steps += static_cast<double>(convert().statistics.steps);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / kTimes;
  if (!(steps > 0.0)) throw std::runtime_error("an evaluation lost its steps");
  return seconds;
}

/// Rows that compare the bytes of messages with the lines of the journal.
void add_formats(const Problem& problem, Table* table) {
  const Evaluation evaluation = Evaluator(problem).evaluate(problem.start(), true);
  const EvaluationRecord record{0, problem.parameters(), Derivatives::kGradient, evaluation};
  const double message = measure_conversion([&evaluation] {
    const std::string bytes = write_result(1, evaluation);
    ByteReader reader(bytes);
    reader.get<MessageKind>();
    reader.get<std::uint64_t>();
    return read_result(&reader);
  });
  const double line =
      measure_conversion([&record] { return read_line(to_line(record)).evaluation; });
  table->rows.push_back({"result written and read as a message", three_digits(1e6 * message), "-"});
  table->rows.push_back({"the same as a line of the journal", three_digits(1e6 * line), "-"});
}

std::string bytes_text(double bytes) {
  return std::to_string(static_cast<std::int64_t>(bytes + 0.5));
}

/// Wall time of the gradient by number of ranks. @returns processor time of one evaluation in one
/// process [s].
double measure_gradients(Report* report) {
  constexpr int kMostRanks = 4, kSamplesPerGradient = 32;
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Table table{"ensemble_ranks",
              "The gradient over 32 samples on ranks of mpirun, rank 0 among those that compute: "
              "the best of 7 repetitions",
              {"ranks", "ms", "processor time of all evaluations, ms", "of rank 0, ms", "speed-up",
               "per core"},
              {}};
  double alone = 0.0, evaluations = 0.0;
  for (int ranks = 1; ranks <= kMostRanks; ++ranks) {
    const std::vector<double> numbers = run_ranks(ranks, "gradient");
    if (ranks == 1) {
      alone = numbers.at(0);
      evaluations = numbers.at(2);
    }
    const double speed_up = alone / numbers.at(0);
    table.rows.push_back({std::to_string(ranks), three_digits(1e3 * numbers[0]),
                          three_digits(1e3 * numbers.at(2)), three_digits(1e3 * numbers.at(1)),
                          three_digits(speed_up), three_digits(speed_up / std::min(ranks, cores))});
    if (ranks == 2)
      report->findings.push_back(
          {"efficiency of two ranks at 32 samples", "", speed_up / 2.0, 0.95, true});
  }
  report->tables.push_back(table);
  return evaluations / kSamplesPerGradient;
}

/// What the measured times say about numbers of cores that are not here. With one evaluation per
/// core and time T, the cores ask for cores / T tasks per second; the dispatcher serves 1 / d, the
/// callers, each of which reads and records its own, one per time c.
Table on_paper(double evaluation, double dispatcher, double caller, double task_bytes,
               double result_bytes) {
  Table table{"ranks_on_paper",
              "On paper: from the figures above, evaluations of 10 ms, of the slider-crank's "
              "gradient, and of 1 s",
              {"evaluation, ms", "cores", "tasks per s", "dispatcher busy", "callers busy",
               "network, MB/s", "efficiency"},
              {}};
  for (const double seconds : {0.01, evaluation, 1.0})
    for (const double cores : {100.0, 1000.0, 10000.0}) {
      const double wanted = cores / seconds,
                   served = std::min({wanted, 1.0 / dispatcher, 1.0 / caller});
      table.rows.push_back({three_digits(1e3 * seconds), bytes_text(cores), bytes_text(served),
                            three_digits(served * dispatcher), three_digits(served * caller),
                            three_digits(1e-6 * served * (task_bytes + result_bytes)),
                            three_digits(served / wanted)});
    }
  return table;
}

}  // namespace

void measure_ranks(Report* report) {
  const double evaluation = measure_gradients(report);
  // Enough ranks that the dispatcher always has work: with few, most of its time goes into looking
  // for messages.
  const std::vector<double> numbers = run_ranks(9, "messages");
  const double dispatcher = numbers.at(0), reading = numbers.at(1);
  const Problem problem = with_uncertain_masses(load_slider_crank(), 32, "{type: serial}");
  const auto [journal, line] = measure_journal(problem);
  Table table{"rank_messages",
              "A task of the slider-crank's gradient: processor time of rank 0 apart from the "
              "evaluation, and bytes",
              {"what", "us", "bytes"},
              {}};
  table.rows.push_back({"dispatcher: sends the task and receives the result",
                        three_digits(1e6 * dispatcher),
                        bytes_text(numbers.at(3)) + " + " + bytes_text(numbers.at(4))});
  table.rows.push_back({"caller: reads the result", three_digits(1e6 * reading), "-"});
  table.rows.push_back(
      {"caller: writes a line of the journal", three_digits(1e6 * journal), bytes_text(line)});
  table.rows.push_back({"time until a task is answered that is the only one",
                        three_digits(1e6 * numbers.at(2)), "-"});
  table.rows.push_back({"the problem, once per rank", "-", bytes_text(numbers.at(5))});
  add_formats(problem, &table);
  report->tables.push_back(table);
  report->tables.push_back(
      on_paper(evaluation, dispatcher, reading + journal, numbers[3], numbers[4]));
}

}  // namespace codesign
