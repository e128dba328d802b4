// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>

#include "math/lanes.h"

namespace codesign {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Vector4 = Eigen::Matrix<T, 4, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Matrix4 = Eigen::Matrix<T, 4, 4>;
template <class T>
using Matrix34 = Eigen::Matrix<T, 3, 4>;
template <class T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// The value without derivatives or imaginary part. Branches use it, since they must not depend on the derivatives.
inline double value_of(double x) { return x; }
inline double value_of(const std::complex<double>& x) { return x.real(); }
template <int N>
double value_of(const Lanes<N>& x) {
  return x.a;
}

/// The place of a decision in the source, for decisions that recordings turn round together.
constexpr unsigned place_in_source(const char* file, unsigned line) {
  unsigned hash = line;
  for (; *file; ++file) hash = 31 * hash + static_cast<unsigned char>(*file);
  return hash;
}

/// Whether value_of(x) < value_of(y). Formulas branch by this function only, so that they can be recorded for compilation
/// (codegen/traced.h).
/// @param likely the outcome that the first recording follows where it depends on the state; other outcomes are recorded when they occur.
template <class T>
bool is_less(const T& x, const T& y, bool likely, unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) {
  static_cast<void>(likely), static_cast<void>(place);
  return value_of(x) < value_of(y);
}

}  // namespace codesign
