// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mpi/run_on_ranks.h"

#include <csignal>
#include <iostream>

#include "engine/dispatcher.h"
#include "engine/mpi_engine.h"
#include "mpi/launcher.h"
#include "mpi/mpi_transport.h"

namespace codesign {
namespace {

constexpr int kFailed = 1;
constexpr auto kFlush = std::chrono::seconds(2);  // for the last messages

/// Of the time that mpirun gives the ranks to end after the loss of one of them, by default a
/// second, rank 0 waits so much for the answers of the others; in the rest it keeps its results.
constexpr double kShareOfAnswers = 0.3;

RankTimes rank_times() {
  RankTimes times;
  if (const std::optional<double> seconds = seconds_to_end())
    times.answer = std::chrono::duration_cast<RankTimes::Duration>(
        std::chrono::duration<double>(kShareOfAnswers * *seconds));
  return times;
}

// mpirun sends its signals to all ranks. The first signal is for rank 0, which keeps its results
// and then ends the other ranks.
extern "C" void stay(int signal_number) { std::signal(signal_number, SIG_DFL); }

/// Ends MPI. If not all ranks can end together, the remaining ranks end at once; otherwise they
/// would wait for each other forever.
int finish(MpiTransport* transport, bool in_order, int code) {
  if (!in_order || !transport->flush(kFlush)) transport->abort(code);
  transport->finish();
  return code;
}

int serve(const std::string& name, MpiTransport* transport) {
  std::signal(SIGINT, stay);
  std::signal(SIGTERM, stay);
  const std::string fault = RankWorker(transport).run();
  if (!fault.empty())
    std::cerr << name << ": rank " << transport->rank() << " ends: " << fault << std::endl;
  return finish(transport, fault.empty(), fault.empty() ? 0 : kFailed);
}

}  // namespace

int run_on_ranks(const std::string& name, const std::function<int(Dispatcher*)>& first) {
  const std::optional<Launched> launched = find_launcher();
  if (!launched || launched->ranks == 1) {
    Dispatcher alone(nullptr);
    return first(&alone);
  }
  MpiTransport transport;
  if (transport.rank() > 0) return serve(name, &transport);
  Dispatcher dispatcher(&transport, rank_times());
  const int code = first(&dispatcher);
  const bool in_order = dispatcher.finish();
  if (!in_order)
    std::cerr << name << ": not all ranks have ended in order; those that are left are ended now"
              << std::endl;
  std::cout.flush();
  return finish(&transport, in_order, code);
}

}  // namespace codesign
