// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace codesign {

/// Nodes by a key other than zero: a hash table in one array, since a recording looks every operation up and most of them are new.
class NodeTable {
 public:
  /// The node of a key, which becomes `node` if there is none. @return the node, and whether it is new.
  std::pair<int, bool> find_or_add(std::uint64_t key, int node) {
    if (2 * (count_ + 1) > entries_.size()) grow();
    Entry& entry = place_of(key);
    if (entry.key == key) return {entry.node, false};
    entry = {key, node};
    ++count_;
    return {node, true};
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    int node = -1;
  };

  /// Fibonacci hashing, then the next place that is empty or has the key.
  Entry& place_of(std::uint64_t key) {
    const std::size_t mask = entries_.size() - 1;
    std::size_t k = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> 32U) & mask;
    while (entries_[k].key != 0 && entries_[k].key != key) k = (k + 1) & mask;
    return entries_[k];
  }

  void grow() {
    constexpr std::size_t kFirst = 16384;
    std::vector<Entry> old(entries_.empty() ? kFirst : 2 * entries_.size());
    old.swap(entries_);
    for (const Entry& entry : old)
      if (entry.key != 0) place_of(entry.key) = entry;
  }

  std::vector<Entry> entries_;  ///< a power of two of them
  std::size_t count_ = 0;
};

}  // namespace codesign
