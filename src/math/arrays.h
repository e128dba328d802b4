// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace codesign {

/// A number that is known not to be negative, as an index of the standard library's containers.
template <class Integer>
constexpr std::size_t to_index(Integer k) {
  static_assert(std::is_integral_v<Integer> || std::is_enum_v<Integer>);
  return static_cast<std::size_t>(k);
}
/// A size or an index of the standard library's containers as a signed number, as Eigen and Span
/// have them.
template <class Integer>
constexpr std::ptrdiff_t to_signed(Integer k) {
  static_assert(std::is_integral_v<Integer> || std::is_enum_v<Integer>);
  return static_cast<std::ptrdiff_t>(k);
}

namespace internal {

/// Whether the entries of a container lie side by side. The entries of some of Eigen's expressions
/// do not, such as a row or a block of a matrix.
template <class Container, class = void>
inline constexpr bool kIsContiguous = true;
template <class Container>
inline constexpr bool
    kIsContiguous<Container, std::void_t<decltype(Container::InnerStrideAtCompileTime)>> =
        Container::IsVectorAtCompileTime
            ? int{Container::InnerStrideAtCompileTime} == 1
            : int{Container::OuterStrideAtCompileTime} == int{Container::InnerSizeAtCompileTime} &&
                  int{Container::OuterStrideAtCompileTime} > 0;

template <class From, class To>
using IfSameEntries = std::enable_if_t<std::is_convertible_v<From (*)[], To (*)[]>>;
template <class Container, class To>
using IfHolds = std::enable_if_t<
    kIsContiguous<Container> &&
    std::is_convertible_v<std::remove_pointer_t<decltype(std::declval<Container&>().data())> (*)[],
                          To (*)[]>>;

}  // namespace internal

/// An array that another object owns: a pointer to its first entry and its size. The twin of
/// C++20's std::span, but with signed sizes, as Layout and Eigen have them. Debug builds check
/// every index.
///
/// Functions take arrays by value as In<T> or Out<T>, which say who may write. Kernels whose time
/// counts take data() once and check sizes before.
template <class T>
class Span {
 public:
  Span() = default;
  Span(T* first, std::ptrdiff_t size) : data_(first), size_(size) { assert(size >= 0); }
  // NOLINTBEGIN(google-explicit-constructor): an array is passed as it is.
  template <class Entry, std::size_t size, class = internal::IfSameEntries<Entry, T>>
  Span(Entry (&array)[size]) : Span(array, std::ptrdiff_t{size}) {}
  /// Vectors, arrays and spans, and Eigen's objects with contiguous numbers. A temporary can be
  /// read from only.
  template <class Container, class = internal::IfHolds<Container, T>>
  Span(Container& from) : Span(from.data(), static_cast<std::ptrdiff_t>(from.size())) {}
  template <class Container, class = internal::IfHolds<const Container, T>>
  Span(const Container& from) : Span(from.data(), static_cast<std::ptrdiff_t>(from.size())) {}
  // NOLINTEND(google-explicit-constructor)

  T* data() const { return data_; }
  std::ptrdiff_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() const { return data_; }
  T* end() const { return data_ + size_; }
  T& operator[](std::ptrdiff_t k) const {
    assert(0 <= k && k < size_);
    return data_[k];
  }

  Span first(std::ptrdiff_t count) const { return subspan(0, count); }
  Span subspan(std::ptrdiff_t offset, std::ptrdiff_t count) const {
    assert(0 <= offset && 0 <= count && offset + count <= size_);
    return {data_ + offset, count};
  }

 private:
  T* data_ = nullptr;
  std::ptrdiff_t size_ = 0;
};

/// An array that a function reads. T is not deduced from the argument, so that every container
/// converts.
template <class T>
using In = Span<const std::common_type_t<T>>;
/// An array that a function writes; it may read it as well, as a solve in place does.
template <class T>
using Out = Span<std::common_type_t<T>>;

/// Allocates memory aligned to a cache line (64 bytes), so that no load of a vector register
/// touches two lines.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  LineAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): as containers convert allocators.
  LineAllocator(const LineAllocator<U>&) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kLine));
  }
  void deallocate(T* first, std::size_t) { ::operator delete(first, kLine); }

  template <class U>
  friend bool operator==(const LineAllocator&, const LineAllocator<U>&) {
    return true;
  }
  template <class U>
  friend bool operator!=(const LineAllocator&, const LineAllocator<U>&) {
    return false;
  }
};

/// Numbers in such memory.
using LineVector = std::vector<double, LineAllocator<double>>;

/// A vector for the short life of a function call: up to `few` entries stand in the object itself,
/// only more are allocated.
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
