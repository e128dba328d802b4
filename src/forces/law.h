// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

namespace codesign {

class Traced;

/// A function of values for the two scalars of formulas: double computes, Traced records.
/// Function<T> is a pointer to the function for T. Written {f, f} for a function template f; {} for
/// none.
template <template <class> class Function>
struct Law {
  Function<double> computed = nullptr;
  Function<Traced> recorded = nullptr;

  explicit operator bool() const { return computed != nullptr; }
  template <class T, class... Values>
  auto of(const Values&... values) const {
    if constexpr (std::is_same_v<T, double>)
      return computed(values...);
    else
      return recorded(values...);
  }
};

/// Refers to a row of a table of laws. The row must outlive it. Two are equal if they refer to the
/// same row.
template <class Row>
class RowReference {
 public:
  constexpr RowReference(const Row& row)
      : row_(&row) {}  // NOLINT(google-explicit-constructor): a row is used as its own reference

  constexpr const Row& operator*() const { return *row_; }
  constexpr const Row* operator->() const { return row_; }
  friend constexpr bool operator==(const RowReference& a, const RowReference& b) {
    return a.row_ == b.row_;
  }
  friend constexpr bool operator!=(const RowReference& a, const RowReference& b) {
    return a.row_ != b.row_;
  }

 private:
  const Row* row_;
};

}  // namespace codesign
