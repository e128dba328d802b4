// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/dispatcher.h"
#include "engine/mpi_engine.h"
#include "mechanism_codesign/version.h"
#include "patience.h"

namespace codesign {

/// The boxes of all ranks of a job whose ranks are threads of this process.
class Mail {
 public:
  explicit Mail(int ranks) : boxes_(static_cast<std::size_t>(ranks)) {}
  int ranks() const { return static_cast<int>(boxes_.size()); }
  void send(int from, int to, std::string bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    boxes_[static_cast<std::size_t>(to)].push_back({from, std::move(bytes)});
  }
  std::optional<Envelope> receive(int rank) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::deque<Envelope>& box = boxes_[static_cast<std::size_t>(rank)];
    if (box.empty()) return std::nullopt;
    Envelope first = std::move(box.front());
    box.pop_front();
    if (ByteReader(first.bytes).get<MessageKind>() == MessageKind::kTask) ++taken_;
    return first;
  }
  /// How many tasks the ranks have taken out of their boxes.
  int taken() const { return taken_; }

 private:
  std::mutex mutex_;
  std::vector<std::deque<Envelope>> boxes_;
  std::atomic<int> taken_{0};
};

class MailTransport final : public Transport {
 public:
  MailTransport(Mail* mail, int rank) : mail_(mail), rank_(rank) {}
  int rank() const override { return rank_; }
  int ranks() const override { return mail_->ranks(); }
  void send(int to, std::string bytes) override { mail_->send(rank_, to, std::move(bytes)); }
  std::optional<Envelope> receive() override { return mail_->receive(rank_); }
  std::string failure() const override { return failure_; }

  std::string failure_;

 private:
  Mail* mail_;
  int rank_;
};

/// Times of a job whose ranks all live, however busy the machine is.
inline RankTimes patient_times() {
  RankTimes times;
  times.silence = times.orphaned = times.goodbye = times.answer = kPatience;
  return times;
}

/// A job with real workers.
class RankJob {
 public:
  explicit RankJob(int ranks, const RankTimes& times = patient_times())
      : mail_(ranks), first_(&mail_, 0), times_(times) {
    for (int rank = 1; rank < ranks; ++rank)
      threads_.emplace_back([this, rank] {
        MailTransport transport(&mail_, rank);
        EXPECT_EQ(RankWorker(&transport, times_).run(), "");
      });
    dispatcher_.emplace(&first_, times_);
  }
  ~RankJob() {
    EXPECT_TRUE(dispatcher_->finish()) << "every rank says goodbye";
    for (std::thread& thread : threads_) thread.join();
  }
  RankJob(const RankJob&) = delete;
  RankJob& operator=(const RankJob&) = delete;
  Dispatcher* ranks() { return &*dispatcher_; }
  int taken() const { return mail_.taken(); }

 private:
  Mail mail_;
  MailTransport first_;
  const RankTimes times_;
  std::vector<std::thread> threads_;
  std::optional<Dispatcher> dispatcher_;
};

/// A job of two ranks whose second one is played by the test.
class PlayedJob {
 public:
  /// The answer of the second rank to a message; empty if it is silent.
  using Part = std::function<std::optional<std::string>(MessageKind, std::uint64_t)>;

  PlayedJob(const Hello& hello, Part part, const RankTimes& times = {})
      : mail_(2),
        first_(&mail_, 0),
        dispatcher_(&first_, without_goodbye(times)),
        part_(std::move(part)) {
    mail_.send(1, 0, write_hello(hello));
    thread_ = std::thread([this] { play(); });
  }
  ~PlayedJob() {
    over_ = true;
    thread_.join();
  }
  PlayedJob(const PlayedJob&) = delete;
  PlayedJob& operator=(const PlayedJob&) = delete;
  Dispatcher* ranks() { return &dispatcher_; }
  void wait_for_hello() const {
    while (!dispatcher_.is_complete()) std::this_thread::sleep_for(std::chrono::microseconds(100));
  }

 private:
  static RankTimes without_goodbye(RankTimes times) {
    times.goodbye = std::chrono::seconds(0);
    return times;
  }
  void play() {
    while (!over_) {
      const std::optional<Envelope> envelope = mail_.receive(1);
      if (!envelope) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        continue;
      }
      ByteReader reader(envelope->bytes);
      const auto kind = reader.get<MessageKind>();
      if (std::optional<std::string> answer = part_(kind, reader.get<std::uint64_t>()))
        mail_.send(1, 0, std::move(*answer));
    }
  }

  Mail mail_;
  MailTransport first_;
  Dispatcher dispatcher_;
  Part part_;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

inline Hello own_hello() { return {kMessageFormat, version(), "elsewhere"}; }

}  // namespace codesign
