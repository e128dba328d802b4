// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/dispatcher.h"

#include <algorithm>

#include "math/arrays.h"
#include "mechanism_codesign/version.h"
#include "text/cancel.h"

namespace codesign {
namespace {

// Largest number of messages to receive before messages are sent.
constexpr std::size_t kMostAtOnce = 256;

std::string in_seconds(RankTimes::Duration duration) {
  return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(duration).count()) + " s";
}

}  // namespace

Dispatcher::Dispatcher(Transport* transport, const RankTimes& times)
    : transport_(transport), times_(times) {
  RankState unheard;
  unheard.heard = unheard.addressed = times_.now();
  ranks_.assign(transport ? to_index(transport->ranks()) : 1, unheard);
  if (ranks() > 1) thread_ = std::thread([this] { work(); });
}

bool Dispatcher::finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  has_work_.notify_all();
  if (thread_.joinable()) thread_.join();
  return std::all_of(ranks_.begin() + 1, ranks_.end(),
                     [](const RankState& state) { return state.has_left; });
}

Status Dispatcher::lost() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return lost_;
}

bool Dispatcher::is_complete() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::all_of(ranks_.begin() + 1, ranks_.end(),
                     [](const RankState& state) { return state.is_ready; });
}

std::uint32_t Dispatcher::add(PortableProblem problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::uint32_t number = next_problem_++;
  problems_.emplace(number, write_problem(number, problem));
  return number;
}

void Dispatcher::remove(std::uint32_t problem) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    problems_.erase(problem);
    removed_.push_back(problem);
  }
  has_local_work_.notify_all();
  has_work_.notify_all();
}

void Dispatcher::run(RankBatch* batch, const std::function<void(std::size_t, Evaluation)>& take) {
  std::unique_lock<std::mutex> lock(mutex_);
  batches_.push_back(batch);
  waiting_.push_back(batch);
  waiting_tasks_ += batch->tasks.size();
  if (!lost_.ok()) end(batch, lost_);
  has_work_.notify_all();
  has_local_work_.notify_all();
  for (;;) {
    batch->changed.wait(lock, [batch] {
      return !batch->arrived.empty() || !batch->computed.empty() || batch->is_over();
    });
    if (batch->arrived.empty() && batch->computed.empty()) break;
    auto arrived = std::exchange(batch->arrived, {});
    auto computed = std::exchange(batch->computed, {});
    lock.unlock();
    std::exception_ptr error;
    for (auto& [index, evaluation] : computed) take(index, std::move(evaluation));
    for (const auto& [index, bytes] : arrived) try {
        ByteReader reader(bytes);
        const auto kind = reader.get<MessageKind>();
        reader.get<std::uint64_t>();
        if (kind == MessageKind::kError) std::rethrow_exception(read_error(&reader));
        take(index, read_result(&reader));
      } catch (...) {
        error = std::current_exception();
      }
    lock.lock();
    if (error && !batch->error) batch->error = error;
  }
  batches_.erase(std::find(batches_.begin(), batches_.end(), batch));
}

std::pair<RankBatch*, std::size_t> Dispatcher::take_next(std::deque<RankBatch*>::iterator place) {
  RankBatch* const batch = *place;
  const std::size_t index = batch->next++;
  --waiting_tasks_;
  if (batch->next == batch->tasks.size()) waiting_.erase(place);
  return {batch, index};
}

std::pair<RankBatch*, std::size_t> Dispatcher::take_local(std::uint32_t problem) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    if (problems_.count(problem) == 0) return {nullptr, 0};
    const auto place =
        std::find_if(waiting_.begin(), waiting_.end(),
                     [problem](const RankBatch* b) { return b->problem == problem; });
    if (place != waiting_.end()) return take_next(place);
    has_local_work_.wait(lock);
  }
}

void Dispatcher::give_local(RankBatch* batch, std::size_t index, Evaluation evaluation,
                            const std::exception_ptr& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!error)
    batch->computed.emplace_back(index, std::move(evaluation));
  else if (!batch->error)
    batch->error = error;
  ++batch->done;
  batch->changed.notify_all();
}

void Dispatcher::work() {
  PollPause pause;
  Outgoing outgoing;
  std::vector<Envelope> inbox;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ends_) {
    lock.unlock();
    for (auto& [rank, bytes] : outgoing) transport_->send(rank, std::move(bytes));
    while (inbox.size() < kMostAtOnce) {
      std::optional<Envelope> envelope = transport_->receive();
      if (!envelope) break;
      inbox.push_back(std::move(*envelope));
    }
    lock.lock();
    const Clock::time_point now = times_.now();
    for (const auto& [rank, bytes] : outgoing) ranks_[to_index(rank)].addressed = now;
    const bool is_quiet = inbox.empty() && outgoing.empty();
    if (!is_quiet) pause.restart(now);
    outgoing.clear();
    for (Envelope& envelope : inbox) handle(std::move(envelope), now);
    inbox.clear();
    send_removals(&outgoing);
    watch_cancels(now, &outgoing);
    watch_ranks(now, &outgoing);
    hand_out(&outgoing);
    // While a caller waits, the pause is short; otherwise a longer one suffices.
    const auto most =
        batches_.empty() ? std::chrono::milliseconds(20) : std::chrono::milliseconds(1);
    if (is_quiet && outgoing.empty() && !ends_) has_work_.wait_for(lock, pause.next(now, most));
  }
  lock.unlock();
  say_goodbye();
}

void Dispatcher::say_goodbye() {
  if (!lost_.ok()) return;
  for (int rank = 1; rank < ranks(); ++rank)
    transport_->send(rank, write_numbered(MessageKind::kEnd));
  const Clock::time_point end = times_.now() + times_.goodbye;
  for (int left = ranks() - 1; left > 0 && times_.now() < end;) {
    const std::optional<Envelope> envelope = transport_->receive();
    if (!envelope) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    } else if (ByteReader(envelope->bytes).get<MessageKind>() == MessageKind::kGoodbye) {
      ranks_[to_index(envelope->from)].has_left = true;
      --left;
    }
  }
}

void Dispatcher::handle(Envelope envelope, Clock::time_point now) {
  RankState& rank = ranks_[to_index(envelope.from)];
  rank.heard = now;
  ByteReader reader(envelope.bytes);
  const auto kind = reader.get<MessageKind>();
  if (kind == MessageKind::kHello) {
    welcome(envelope.from, &reader);
    return;
  }
  const auto number = reader.get<std::uint64_t>();
  if (kind == MessageKind::kPong) {
    rank.pong = std::max(rank.pong, number);
    has_pong_.notify_all();
  } else if (kind == MessageKind::kResult || kind == MessageKind::kError) {
    take_answer(envelope.from, number, std::move(envelope.bytes));
  }
}

void Dispatcher::welcome(int rank, ByteReader* reader) {
  RankState& state = ranks_[to_index(rank)];
  const Hello theirs = read_hello(reader), ours{kMessageFormat, version(), ""};
  state.host = theirs.host;
  if (theirs.version != ours.version || theirs.format != ours.format) {
    lose(name_of_rank(rank) + " runs version " + theirs.version +
         " of this program (messages of format " + std::to_string(theirs.format) +
         "), and rank 0 version " + ours.version + " (format " + std::to_string(ours.format) +
         "); install the same version on every host");
    return;
  }
  state.is_ready = true;
  sort_in(rank);
}

void Dispatcher::take_answer(int rank, std::uint64_t number, std::string bytes) {
  std::vector<SentTask>& sent = ranks_[to_index(rank)].sent;
  const auto place = std::find_if(sent.begin(), sent.end(),
                                  [number](const SentTask& one) { return one.number == number; });
  // The answer of a task whose batch has ended already.
  if (place == sent.end()) return;
  place->batch->arrived.emplace_back(place->index, std::move(bytes));
  ++place->batch->done;
  place->batch->changed.notify_all();
  sent.erase(place);
  sort_in(rank);
}

void Dispatcher::sort_in(int rank) {
  const std::size_t tasks = ranks_[to_index(rank)].sent.size();
  free_.erase(rank);
  half_free_.erase(rank);
  if (tasks == 0) free_.insert(rank);
  if (tasks == 1) half_free_.insert(rank);
}

/// Gives a rank a second task while it computes the first one, so that it does not idle until the
/// next message; but not if another rank could begin that task sooner.
void Dispatcher::hand_out(Outgoing* outgoing) {
  while (waiting_tasks_ > 0 && !free_.empty()) send_next(*free_.begin(), outgoing);
  while (waiting_tasks_ > ranks_.size() && !half_free_.empty())
    send_next(*half_free_.begin(), outgoing);
}

void Dispatcher::send_next(int rank, Outgoing* outgoing) {
  const auto [batch, index] = take_next(waiting_.begin());
  RankState& state = ranks_[to_index(rank)];
  if (state.problems.insert(batch->problem).second)
    outgoing->emplace_back(rank, problems_.at(batch->problem));
  const std::uint64_t number = next_number_++;
  const EvaluationTask& task = batch->tasks[index];
  outgoing->emplace_back(rank, write_task(number, batch->problem, batch->systems[index],
                                          task.derivatives, task.parameters, task.steps));
  state.sent.push_back({number, batch, index});
  sort_in(rank);
}

void Dispatcher::send_removals(Outgoing* outgoing) {
  for (const std::uint32_t problem : std::exchange(removed_, {}))
    for (int rank = 1; rank < ranks(); ++rank)
      if (ranks_[to_index(rank)].problems.erase(problem) > 0)
        outgoing->emplace_back(rank, write_numbered(MessageKind::kForget, problem));
}

void Dispatcher::watch_cancels(Clock::time_point now, Outgoing* outgoing) {
  for (const std::uint64_t ping : std::exchange(roll_calls_, {})) ping_all(ping, outgoing);
  for (RankBatch* batch : batches_) {
    if (!batch->ended.ok()) continue;
    if (!batch->ping) {
      if (is_set(batch->cancel)) end_tasks(batch, now, outgoing);
      continue;
    }
    const Status missed = missed_since(*batch->ping);
    if (missed.ok())
      end(batch, {StatusCode::kCancelled, 0.0, "cancelled"});
    else if (now - batch->pinged > times_.answer)
      end(batch, missed);
  }
}

/// Cancels the running tasks of a batch, and pings all workers.
void Dispatcher::end_tasks(RankBatch* batch, Clock::time_point now, Outgoing* outgoing) {
  drop_waiting(batch);
  for (int rank = 1; rank < ranks(); ++rank)
    for (const SentTask& task : ranks_[to_index(rank)].sent)
      if (task.batch == batch)
        outgoing->emplace_back(rank, write_numbered(MessageKind::kCancel, task.number));
  batch->ping = next_ping_++;
  batch->pinged = now;
  ping_all(*batch->ping, outgoing);
}

void Dispatcher::ping_all(std::uint64_t ping, Outgoing* outgoing) const {
  for (int rank = 1; rank < ranks(); ++rank)
    if (ranks_[to_index(rank)].is_ready)
      outgoing->emplace_back(rank, write_numbered(MessageKind::kPing, ping));
}

/// The first rank that has not answered a ping, as a status; ok if all have.
Status Dispatcher::missed_since(std::uint64_t ping) const {
  for (int rank = 1; rank < ranks(); ++rank) {
    const RankState& state = ranks_[to_index(rank)];
    if (state.is_ready && state.pong < ping)
      return {
          StatusCode::kWorkerLost, 0.0,
          name_of_rank(rank) + " does not answer: it was killed, or its machine cannot be reached"};
  }
  return {};
}

Status Dispatcher::call_roll() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!lost_.ok() || ranks() == 1) return lost_;
  const std::uint64_t ping = next_ping_++;
  roll_calls_.push_back(ping);
  has_work_.notify_all();
  has_pong_.wait_for(lock, times_.answer, [this, ping] { return missed_since(ping).ok(); });
  return missed_since(ping);
}

void Dispatcher::watch_ranks(Clock::time_point now, Outgoing* outgoing) {
  constexpr auto kPeriod = std::chrono::milliseconds(100);
  // If this process itself was stopped, it has not received messages meanwhile; that time is not
  // the silence of a rank.
  const Clock::duration away = now - std::exchange(looked_, now);
  if (away > std::chrono::seconds(1))
    for (RankState& state : ranks_) state.heard += away;
  if (now - watched_ < kPeriod || !lost_.ok()) return;
  watched_ = now;
  if (!transport_->failure().empty()) lose(transport_->failure());
  for (int rank = 1; rank < ranks(); ++rank) {
    const RankState& state = ranks_[to_index(rank)];
    const RankTimes::Duration patience = state.is_ready ? times_.silence : times_.first_sign;
    if (now - state.heard > patience)
      lose(name_of_rank(rank) + " has said nothing for " + in_seconds(patience) +
           ": it was killed, or its machine is stopped or cannot be reached");
    if (now - state.addressed > times_.sign)
      outgoing->emplace_back(rank, write_numbered(MessageKind::kSign));
  }
}

void Dispatcher::lose(const std::string& sentence) {
  if (!lost_.ok()) return;
  lost_ = {StatusCode::kWorkerLost, 0.0, sentence};
  for (RankBatch* batch : batches_) end(batch, lost_);
}

void Dispatcher::drop_waiting(RankBatch* batch) {
  const std::size_t left = batch->tasks.size() - batch->next;
  if (left == 0) return;
  waiting_.erase(std::find(waiting_.begin(), waiting_.end(), batch));
  waiting_tasks_ -= left;
  batch->next = batch->tasks.size();
  batch->done += left;
}

void Dispatcher::end(RankBatch* batch, const Status& status) {
  if (!batch->ended.ok()) return;
  drop_waiting(batch);
  for (int rank = 1; rank < ranks(); ++rank) {
    std::vector<SentTask>& sent = ranks_[to_index(rank)].sent;
    const auto rest = std::remove_if(sent.begin(), sent.end(),
                                     [batch](const SentTask& one) { return one.batch == batch; });
    batch->done += to_index(sent.end() - rest);
    sent.erase(rest, sent.end());
    if (ranks_[to_index(rank)].is_ready) sort_in(rank);
  }
  batch->ended = status;
  batch->changed.notify_all();
}

std::string Dispatcher::name_of_rank(int rank) const {
  const std::string& host = ranks_[to_index(rank)].host;
  return "rank " + std::to_string(rank) + " of " + std::to_string(ranks()) +
         (host.empty() ? "" : " on host " + host);
}

}  // namespace codesign
