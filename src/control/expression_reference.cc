// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/expression_reference.h"

#include <algorithm>
#include <cmath>

#include "codegen/number_types.h"
#include "description/formula.h"
#include "math/arrays.h"
#include "math/taylor_quadrature.h"

namespace codesign {

template <class T>
void ExpressionReference<T>::set(const TimeExpression& expression,
                                 const std::vector<T>& parameters) {
  expression_ = &expression;
  used_.clear();
  for (const int used : expression_->formula->dependencies())
    used_.push_back(used == expression_->time ? T(0.0) : parameters.at(to_index(used)));
}

template <class T>
Taylor<T> ExpressionReference<T>::series_at(double t) const {
  return time_series(*expression_->formula, expression_->time, used_, t);
}

template <class T>
ReferenceMotion<T> ExpressionReference<T>::at(double t) const {
  const Taylor<T> f = series_at(t);
  return {f.c[0], f.c[1], T(2.0) * f.c[2], T(6.0) * f.c[3]};
}

template <class T>
ReferenceMotion<T> ExpressionReference<T>::integral_at(double t) const {
  const Taylor<T> f = series_at(t);
  return {area_to(t, f), f.c[0], f.c[1], T(2.0) * f.c[2]};
}

// Panels are chosen by the values alone, so that all number types have the same ones.
template <class T>
void ExpressionReference<T>::prepare_integral(double duration) {
  std::vector<double> values;
  for (const T& used : used_) values.push_back(value_of(used));
  const auto series_of_values = [&](double t) {
    return time_series(*expression_->formula, expression_->time, values, t);
  };
  panels_.clear();
  for (const double begin : integration_panels(series_of_values, duration)) {
    const Taylor<T> series = series_at(begin);
    T area(0.0);
    if (!panels_.empty()) {
      const Panel& last = panels_.back();
      area = last.area + panel_integral(last.series, series, begin - last.begin);
    }
    panels_.push_back({begin, series, area});
  }
}

// Outside the prepared panels, as in a run that goes on, further ones of their mean width follow.
template <class T>
T ExpressionReference<T>::area_to(double t, const Taylor<T>& there) const {
  const auto next =
      std::upper_bound(panels_.begin(), panels_.end(), t,
                       [](double time, const Panel& panel) { return time < panel.begin; });
  Panel panel = next == panels_.begin() ? *next : *(next - 1);
  const double width = panels_.back().begin / static_cast<double>(panels_.size() - 1);
  while (panel.begin != t) {
    const double step = std::clamp(t - panel.begin, -width, width),
                 end = std::abs(t - panel.begin) <= width ? t : panel.begin + step;
    const Taylor<T> series = end == t ? there : series_at(end);
    panel.area += panel_integral(panel.series, series, end - panel.begin);
    panel.begin = end;
    panel.series = series;
  }
  return panel.area;
}

#define CODESIGN_INSTANTIATE(T) template class ExpressionReference<T>;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
