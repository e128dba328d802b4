// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "description/linear_measure.h"
#include "linear/linear_derivatives.h"
#include "linear/loop_margins.h"
#include "linear/poles.h"

namespace codesign {

/// Poles that rounding cannot tell apart, as one with their mean; theory (70c).
struct PoleCluster {
  std::complex<double> value;        ///< s [1/s]
  std::vector<std::size_t> members;  ///< places in the list of poles
  bool is_pair = false;
};
/// The clusters by a measure of poles, the one that decides first, then those that follow: as many
/// as LinearMeasure::kPoles, a pair twice; the last one again where there are fewer. Of the damping
/// ratio without poles at zero. Empty if there is no pole.
std::vector<PoleCluster> ranked(const std::vector<Pole>& poles, LinearMeasure::Kind kind,
                                double duration);
/// Its number.
double value_of(const PoleCluster& cluster, LinearMeasure::Kind kind, double period);
/// The derivative of its number: of several poles that of their mean, which exists wherever they
/// meet; NaN if rounding does not tell them from others. @param A of the closed loops. @param
/// change of A.
double derivative_of(const PoleCluster& cluster, const std::vector<Pole>& poles,
                     LinearMeasure::Kind kind, double period, const Eigen::MatrixXd& A,
                     const Eigen::MatrixXd& change);

/// The crossings or peaks by the kind of a measure of loops, the one that decides first, at most
/// LinearMeasure::places(); empty: there is none.
std::vector<AtFrequency> margins_of(const LoopMargins& margins, LinearMeasure::Kind kind);
/// The derivative of a margin of the loop with these matrices, by the implicit function theorem at
/// its crossing, at a peak at a fixed frequency. @param margin one of margins_of(). @param rest
/// LoopMargins::rest. @param closed as OpenLoop takes it, with derivatives as imaginary parts times
/// LinearDerivatives::kStep.
double derivative_of(const AtFrequency& margin, LinearMeasure::Kind kind, double rest,
                     const ComplexSpace& closed, double period);

}  // namespace codesign
