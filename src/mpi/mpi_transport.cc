// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mpi/mpi_transport.h"

#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kTag = 0;

}  // namespace

MpiTransport::MpiTransport() {
  int provided = 0;
  // On rank 0 another thread than the initializing one makes the calls.
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS)
    throw std::runtime_error("MPI does not start");
  if (provided < MPI_THREAD_SERIALIZED)
    throw std::runtime_error("this MPI cannot be called from several threads");
  // A communicator of our own, with an error handler that returns; the default handler ends the
  // program.
  MPI_Comm_dup(MPI_COMM_WORLD, &world_);
  MPI_Comm_set_errhandler(world_, MPI_ERRORS_RETURN);
  MPI_Comm_rank(world_, &rank_);
  MPI_Comm_size(world_, &ranks_);
}

void MpiTransport::send(int to, std::string bytes) {
  Sending& one = sending_.emplace_back(Sending{std::move(bytes), MPI_REQUEST_NULL});
  check(MPI_Isend(one.bytes.data(), static_cast<int>(one.bytes.size()), MPI_BYTE, to, kTag, world_,
                  &one.request),
        "sending");
}

std::optional<Envelope> MpiTransport::receive() {
  move_on();
  int is_there = 0;
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  if (!check(MPI_Improbe(MPI_ANY_SOURCE, kTag, world_, &is_there, &message, &status),
             "looking for messages") ||
      is_there == 0)
    return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Envelope envelope{status.MPI_SOURCE, std::string(to_index(size), '\0')};
  if (!check(MPI_Mrecv(envelope.bytes.data(), size, MPI_BYTE, &message, MPI_STATUS_IGNORE),
             "receiving"))
    return std::nullopt;
  return envelope;
}

/// Frees the messages that have been sent. Messages mostly leave in order, so that the search ends
/// at the first one that has not left.
void MpiTransport::move_on() {
  while (!sending_.empty()) {
    int is_sent = 0;
    if (!check(MPI_Test(&sending_.front().request, &is_sent, MPI_STATUS_IGNORE), "sending"))
      is_sent = 1;
    if (is_sent == 0) return;
    sending_.pop_front();
  }
}

bool MpiTransport::flush(std::chrono::milliseconds most) {
  const auto end = std::chrono::steady_clock::now() + most;
  for (move_on(); !sending_.empty(); move_on()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return true;
}

void MpiTransport::finish() {
  MPI_Comm_free(&world_);
  MPI_Finalize();
}

void MpiTransport::abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::_Exit(code);
}

bool MpiTransport::check(int code, const char* what) {
  if (code == MPI_SUCCESS) return true;
  if (!failure_.empty()) return false;
  std::string text(MPI_MAX_ERROR_STRING, '\0');
  int size = 0;
  MPI_Error_string(code, text.data(), &size);
  failure_ = std::string("a connection to another rank has failed while ") + what + ": " +
             text.substr(0, to_index(size));
  return false;
}

}  // namespace codesign
