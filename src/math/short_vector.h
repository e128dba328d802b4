// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

namespace codesign {

/// A vector for the short life of a function call: up to `few` entries stand in the object itself, only more are allocated.
template <class T, std::size_t few>
class ShortVector {
 public:
  ShortVector() = default;
  explicit ShortVector(std::size_t size) : size_(size) {
    if (size > few) many_.resize(size);
  }

  void push_back(const T& x) {
    if (size_ == few) many_.assign(few_.begin(), few_.end());
    if (size_ < few)
      few_[size_] = x;
    else
      many_.push_back(x);
    ++size_;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return size_ > few ? many_.data() : few_.data(); }
  const T* data() const { return size_ > few ? many_.data() : few_.data(); }
  T& operator[](std::size_t k) {
    assert(k < size_);
    return data()[k];
  }
  const T& operator[](std::size_t k) const {
    assert(k < size_);
    return data()[k];
  }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

 private:
  std::size_t size_ = 0;
  std::array<T, few> few_{};
  std::vector<T> many_;  ///< all entries, if they are more than `few`
};

}  // namespace codesign
