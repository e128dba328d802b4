// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/pade.h"

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "codegen/traced.h"
#include "math/dense.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

template <class T>
FilterShape<T> all_pass(const FilterNumbers<T>& x) {
  FilterShape<T> h;
  h.rate = x[1] / x[0];
  h.lead = -1.0;
  return h;
}

template <class T>
FilterShape<T> all_pass_2(const FilterNumbers<T>& x) {
  FilterShape<T> h;
  h.rate = x[1] / x[0];
  h.lead = 1.0;
  h.damping = 2.0 * x[2];
  h.middle = -h.damping;
  return h;
}

constexpr FilterLaw make_row(Law<FilterFunction> shape, int order) {
  FilterLaw law;
  law.name = "pade";
  law.shape = shape;
  law.order = order;
  law.numbers = {FilterNumber{"delay"}, {"size"}, {"damping"}};
  law.passes_steps = true;
  return law;
}

constexpr FilterLaw kFirst = make_row({all_pass, all_pass}, 1),
                    kSecond = make_row({all_pass_2, all_pass_2}, 2);

/// The coefficients of q, of x^n 1.
std::vector<double> coefficients(int order) {
  std::vector<double> q(static_cast<std::size_t>(order) + 1, 1.0);
  for (int k = order; k > 0; --k)
    q[static_cast<std::size_t>(k) - 1] =
        q[static_cast<std::size_t>(k)] * k * (2 * order - k + 1) / (order - k + 1);
  return q;
}

/// Newton's method for a zero of a polynomial.
Complex polished(const std::vector<double>& q, Complex x) {
  constexpr int kSteps = 8;
  for (int step = 0; step < kSteps; ++step) {
    Complex value = 0.0, slope = 0.0;
    for (std::size_t k = q.size(); k-- > 0;) {
      slope = slope * x + value;
      value = value * x + q[k];
    }
    x -= value / slope;
  }
  return x;
}

}  // namespace

std::vector<PadeSection> pade_sections(int order) {
  const std::vector<double> q = coefficients(order);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  for (int k = 0; k < order; ++k) {
    companion(0, k) = -q[static_cast<std::size_t>(order - 1 - k)];
    if (k > 0) companion(k, k - 1) = 1.0;
  }
  std::vector<PadeSection> sections;
  const Eigen::VectorXcd roots = general_eigen(companion).values;
  for (Eigen::Index k = 0; k < order; ++k) {
    constexpr double kReal = 1e-6;
    if (roots[k].imag() < -kReal) continue;
    const bool is_pair = roots[k].imag() > kReal;
    const Complex root = polished(q, is_pair ? roots[k] : Complex(roots[k].real()));
    const double size = std::abs(root);
    sections.push_back({is_pair ? kSecond : kFirst, size, is_pair ? -root.real() / size : 1.0});
  }
  return sections;
}

bool is_pade(const FilterKind& kind) {
  return kind == FilterKind(kFirst) || kind == FilterKind(kSecond);
}

}  // namespace codesign
