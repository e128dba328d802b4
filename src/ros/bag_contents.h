// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/byte_reader.h"

namespace codesign {

/// Thrown if a cancel ends the reading of a bag.
class ReadingCancelled : public std::runtime_error {
 public:
  ReadingCancelled() : std::runtime_error("cancelled") {}
};

/// A bag that its recorder did not close, so that it has no index.
class UnindexedBag : public BagFault {
 public:
  using BagFault::BagFault;
};

/// One publisher's messages on a topic.
struct BagConnection {
  std::string topic, type, md5sum;
};

/// A message as it stands in the bag.
struct BagMessage {
  const BagConnection& connection;
  std::int64_t received;  ///< [ns]
  ByteReader content;
};

/// The messages of a bag of format 2.0, read for files of any content: rosbag_storage believes the lengths in a file, so that one changed
/// byte can end the process. See doc/decisions/0074-bags-are-read-here.md. Chunks without messages of the wanted topic are skipped.
class BagContents {
 public:
  /// Reads the connections and the index. @throws BagFault
  explicit BagContents(const std::string& path);

  /// The connections that have messages.
  std::vector<BagConnection> connections() const;
  bool empty() const { return counts_.empty(); }
  /// Time at which the first message of the bag was received [ns].
  std::int64_t begin() const { return begin_; }
  /// Calls `visit` for all messages of a topic, in the order of the file.
  /// @throws BagFault, ReadingCancelled soon after `cancel` is set, and what `visit` throws.
  void visit(const std::string& topic, const std::atomic<bool>* cancel, const std::function<void(const BagMessage&)>& visit);

 private:
  using Counts = std::map<std::uint32_t, std::uint64_t>;  // messages by the number of their connection
  struct Chunk {
    std::uint64_t at;  ///< place of its data
    std::uint32_t packed, size;
    std::string compression;
    Counts counts;
  };

  std::string read(std::uint64_t at, std::uint64_t count);
  std::uint64_t read_record(std::uint64_t at);
  void check_first_line();
  void read_file_header(const ByteReader& fields);
  void read_index(ByteReader fields, std::uint64_t at, const std::string& data);
  void read_connection(ByteReader fields, std::uint64_t at, const std::string& data);
  void check_counts() const;
  std::string unpack(const Chunk& chunk);
  void visit_chunk(const Chunk& chunk, const std::string& topic, const std::function<void(const BagMessage&)>& visit);

  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint32_t chunks_expected_ = 0, connections_expected_ = 0;
  std::vector<Chunk> chunks_;
  std::map<std::uint32_t, BagConnection> connections_;
  Counts counts_;
  std::int64_t begin_ = INT64_MAX;
};

}  // namespace codesign
