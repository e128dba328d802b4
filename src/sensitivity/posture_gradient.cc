// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/posture_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"
#include "sensitivity/signal_watch.h"

namespace codesign {

PostureGradient::PostureGradient(const CompiledSystem& system)
    : system_(system),
      sequence_(system),
      groups_(system),
      layout_(system.study()),
      residuals_(system) {}

Status PostureGradient::start(const std::vector<double>& parameters, Derivatives derivatives) {
  with_gradient_ = derivatives != Derivatives::kNone;
  with_root_ = derivatives == Derivatives::kGaussNewton;
  extremes_.values.setConstant(layout_.size(), std::numeric_limits<double>::quiet_NaN());
  extremes_.times.setZero(layout_.size());
  extremes_.gradients.setZero(with_gradient_ ? count() : 0, layout_.size());
  sum_.setZero(count());
  if (Status status = sequence_.start(parameters); !status.ok()) return status;
  if (with_gradient_)
    groups_.for_each([&](auto* group) {
      group->range.seed(system_, parameters, &group->parameters);
      group->equations.set_design(group->parameters);
    });
  if (with_root_) {
    const auto rows = [this](ObjectivePart part, const State<double>& /*state*/,
                             Eigen::MatrixXd* to) { differentiate_residuals(part, to); };
    if (Status status = residuals_.start(&sequence_, rows); !status.ok()) return status;
  }
  return look();
}

Status PostureGradient::advance(double limit) {
  const Status status = sequence_.advance(limit);
  return status.ok() ? look() : status;
}

/// Adds the posture that was reached.
Status PostureGradient::look() {
  if (with_gradient_) {
    groups_.for_each([&](auto* group) {
      sequence_.assembly().extend(group->parameters, sequence_.state(), &group->equations,
                                  &group->extension, &group->state);
    });
    sum_ += derivatives([](auto* group) {
      typename std::remove_pointer_t<decltype(group)>::Scalar g(0.0);
      group->equations.residual(group->state, &group->G, &g);
      return g;
    });
  }
  if (with_root_) residuals_.look_at(sequence_.state(), 1.0);
  for (std::size_t k = 0; k < layout_.entries().size(); ++k) watch(k);
  const auto bad = std::find_if(extremes_.values.begin(), extremes_.values.end(),
                                [](double x) { return std::isinf(x); });
  if (bad == extremes_.values.end()) return {};
  return {StatusCode::kNonFinite, time(), "a watched signal is not finite"};
}

void PostureGradient::watch(std::size_t k) {
  const WatchLayout::Entry& entry = layout_.entries()[k];
  // The instants are the numbers of postures that follow each other.
  const auto instant = static_cast<int>(time() - entry.instants.front());
  if (instant < 0 || to_index(instant) >= entry.instants.size()) return;
  const int place = entry.at_instant(instant);
  extremes_.values[place] = sequence_.equations().watched(k, sequence_.state());
  extremes_.times[place] = time();
  if (with_gradient_)
    extremes_.gradients.col(place) =
        derivatives([k](auto* group) { return group->equations.watched(k, group->state); });
  if (entry.is_measured && to_index(instant) + 1 == entry.instants.size())
    set_measure(system_.study().watched[k], entry, &extremes_);
}

template <class Function>
Eigen::VectorXd PostureGradient::derivatives(const Function& function) {
  Eigen::VectorXd result(count());
  groups_.for_each([&](auto* group) {
    const auto number = function(group);
    result.segment(group->range.first, group->range.count) =
        number.directions().head(group->range.count);
  });
  return result;
}

void PostureGradient::differentiate_residuals(ObjectivePart part, Eigen::MatrixXd* rows) {
  const bool at_end = part == ObjectivePart::kTerminal;
  rows->resize(count(), to_signed((at_end ? system_.terminal() : system_.integral()).size()));
  groups_.for_each([&](auto* group) {
    group->equations.residuals(part, group->state, &group->residuals);
    for (Eigen::Index k = 0; k < rows->cols(); ++k)
      rows->col(k).segment(group->range.first, group->range.count) =
          group->residuals[k].directions().head(group->range.count);
  });
}

double PostureGradient::objective() {
  return sequence_.psi() + sequence_.equations().terminal(sequence_.state());
}

void PostureGradient::gradient(Eigen::VectorXd* gradient) {
  *gradient =
      sum_ + derivatives([](auto* group) { return group->equations.terminal(group->state); });
}

}  // namespace codesign
