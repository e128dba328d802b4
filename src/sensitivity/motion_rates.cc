// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/motion_rates.h"

#include "assembly/assembly.h"
#include "equations/equations.h"
#include "integration/integrator.h"

namespace codesign {

Status solve_motion(Integrator* integrator, State<double>* state, State<double>* rates) {
  Equations<double>& equations = integrator->equations();
  if (Status status = integrator->assembly().rates().solve(&equations, state); !status.ok())
    return status;
  rates->t = state->t;
  rates->q = state->v;
  rates->v = state->z.head(state->v.size());
  rates->s = state->z.tail(state->s.size());
  integrator->assembly().rates().differentiate(*state, &equations, rates);
  return {};
}

double rate_along(const SparseGradient<double>& gradient, const State<double>& rates,
                  const Layout& layout) {
  double rate = gradient.time;
  for (const auto& e : gradient.position)
    rate += e.value * (e.column < layout.n ? rates.q[e.column] : rates.s[e.column - layout.n]);
  for (const auto& e : gradient.velocity) rate += e.value * rates.v[e.column];
  for (const auto& e : gradient.rate) rate += e.value * rates.z[e.column];
  return rate;
}

}  // namespace codesign
