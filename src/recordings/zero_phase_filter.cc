// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/zero_phase_filter.h"

#include <cassert>
#include <cmath>

#include "math/arrays.h"

namespace codesign {

// Pairs of poles of the analog prototype, s^2 + q s + 1 with q = 2 sin(pi (2k + 1) / (2 n)), and
// the real pole of odd orders, taken to discrete time by the bilinear transformation with the
// cutoff prewarped.
ZeroPhaseFilter::ZeroPhaseFilter(int order, double cutoff, double rate)
    : padding_(3 * (order + 1)) {
  assert(order >= 1 && cutoff > 0.0 && cutoff < 0.5 * rate);
  const double w = std::tan(M_PI * cutoff / rate);
  for (int k = 0; k < order / 2; ++k) {
    const double q = 2.0 * std::sin(M_PI * (2 * k + 1) / (2.0 * order)),
                 scale = 1.0 / (1.0 + q * w + w * w);
    sections_.push_back({w * w * scale, 2.0 * w * w * scale, w * w * scale,
                         2.0 * (w * w - 1.0) * scale, (1.0 - q * w + w * w) * scale});
  }
  if (order % 2 == 1)
    sections_.push_back({w / (1.0 + w), w / (1.0 + w), 0.0, (w - 1.0) / (w + 1.0), 0.0});
}

/// Filters the samples from `first` to before `last`, `step` apart, in place, from the steady state
/// of the first one.
void ZeroPhaseFilter::run(const Section& c, double* first, double* last, std::ptrdiff_t step) {
  double s1 = (1.0 - c.b0) * *first, s2 = (c.b2 - c.a2) * *first;
  for (double* sample = first; sample != last; sample += step) {
    const double x = *sample, y = c.b0 * x + s1;
    s1 = c.b1 * x - c.a1 * y + s2;
    s2 = c.b2 * x - c.a2 * y;
    *sample = y;
  }
}

void ZeroPhaseFilter::apply(Eigen::Ref<Eigen::VectorXd> samples, Workspace* workspace) const {
  const Eigen::Index n = samples.size(), m = padding_;
  assert(n >= least_samples());
  workspace->resize(to_index(n + 2 * m));
  double* const x = workspace->data();
  for (Eigen::Index k = 0; k < m; ++k) {
    x[k] = 2.0 * samples[0] - samples[m - k];
    x[m + n + k] = 2.0 * samples[n - 1] - samples[n - 2 - k];
  }
  for (Eigen::Index k = 0; k < n; ++k) x[m + k] = samples[k];
  // All forward runs come before the backward runs, since each run begins in the steady state of
  // its own input.
  for (const Section& section : sections_) run(section, x, x + n + 2 * m, 1);
  for (const Section& section : sections_) run(section, x + n + 2 * m - 1, x - 1, -1);
  for (Eigen::Index k = 0; k < n; ++k) samples[k] = x[m + k];
}

void ZeroPhaseFilter::apply_to_columns(Eigen::Ref<Eigen::MatrixXd> columns,
                                       Workspace* workspace) const {
  for (Eigen::Index column = 0; column < columns.cols(); ++column)
    apply(columns.col(column), workspace);
}

}  // namespace codesign
