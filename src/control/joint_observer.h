// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "description/joint_observer.h"

namespace codesign {

/// The numbers of an observer at one design, theory (49a): with the innovation e = y - x
///   x' = v + l1 e,  v' = (u + d)/J + l2 e,  d' = J l3 e
/// of a continuous one; a sampled one flows without e and adds l1 e, l2 e, J l3 e at each sample.
template <class T>
struct JointObserver {
  T inertia{1.0};
  std::array<T, 3> gains{T(0.0), T(0.0), T(0.0)};
};

/// Coefficients c1, c2, c3 behind the first one of a polynomial of the order.
template <class T>
using ObserverPolynomial = std::array<T, 3>;

/// Its roots are the poles s, or exp(s T) of a sampled observer. @param sample_time [s]; 0:
/// continuous.
template <class T>
ObserverPolynomial<T> polynomial_of_poles(const ObserverDescription& of, double sample_time) {
  using Number = std::complex<double>;
  std::array<Number, 4> c{1.0, 0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < of.real.size(); ++k) {
    const Number pole(of.real[k], of.imaginary[k]);
    const Number root = sample_time > 0.0 ? std::exp(pole * sample_time) : pole;
    for (std::size_t j = k + 1; j > 0; --j) c[j] -= root * c[j - 1];
  }
  return {T(c[1].real()), T(c[2].real()), T(c[3].real())};
}

/// The same with all poles at -2 pi bandwidth.
template <class T>
ObserverPolynomial<T> polynomial_of_bandwidth(int order, const T& bandwidth, double sample_time) {
  using std::exp;
  const T rate = T(-6.283185307179586) * bandwidth;
  const T root = sample_time > 0.0 ? T(exp(T(sample_time) * rate)) : rate;
  const T square = root * root;
  if (order == 2) return {T(-2.0) * root, square, T(0.0)};
  return {T(-3.0) * root, T(3.0) * square, -square * root};
}

/// The stationary Kalman filter of this model, theory (49b). @param noise process / (inertia^2
/// measurement). A sampled one has no disturbance.
template <class T>
ObserverPolynomial<T> polynomial_of_noise(int order, const T& noise, double sample_time) {
  using std::exp;
  using std::log;
  using std::sqrt;
  if (sample_time > 0.0) {
    const T lambda = T(sample_time * sample_time * sample_time / 6.0) * noise;
    const T at_one = sqrt(T(6.0) * lambda), at_minus_one = sqrt(T(16.0) + T(2.0) * lambda);
    const T sum = at_one + at_minus_one;
    const T t = T(4.0) / (sum + sqrt(T(sum * sum - T(16.0))));
    return {T(0.5) * t * (at_one - at_minus_one), t * t, T(0.0)};
  }
  const T w = exp(T(log(noise) / T(2.0 * order)));
  if (order == 2) return {T(std::sqrt(2.0)) * w, w * w, T(0.0)};
  return {T(2.0) * w, T(2.0) * w * w, w * w * w};
}

/// @param sample_time [s]; 0: continuous.
template <class T>
JointObserver<T> joint_observer(const ObserverDescription& of, double sample_time,
                                const std::vector<T>& parameters) {
  JointObserver<T> observer;
  observer.inertia = of.inertia.at(parameters);
  ObserverPolynomial<T> c = polynomial_of_poles<T>(of, sample_time);
  if (of.bandwidth)
    c = polynomial_of_bandwidth(of.order(), T(of.bandwidth->at(parameters)), sample_time);
  if (of.process)
    c = polynomial_of_noise(of.order(),
                            T(of.process->at(parameters) / (observer.inertia * observer.inertia *
                                                            of.measurement->at(parameters))),
                            sample_time);
  if (!(sample_time > 0.0)) {
    observer.gains = c;
    return observer;
  }
  // With the model's map of a sample, det(z I - (I - l C) A) is the polynomial.
  const T time(sample_time), at_one = T(1.0) + c[0] + c[1] + c[2];
  if (of.order() == 2) {
    observer.gains = {T(1.0) - c[1], at_one / time, T(0.0)};
    return observer;
  }
  const T first = T(1.0) + c[2];
  observer.gains = {first, (T(3.0) - first - T(0.5) * at_one + c[0]) / time,
                    at_one / (time * time)};
  return observer;
}

}  // namespace codesign
