// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_order.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace codesign {
namespace {

// In tolerances: the floor of the first norm, the ratio of each to the one before, and the number
// of norms that the motion takes itself.
constexpr double kFirst = 1e-6, kRatio = 4.0;
constexpr int kNorms = 3;

// SUNDIALS gives a vector no place for anything of its user's, so the content is made longer. It is
// allocated and freed in C.
struct Content {
  _N_VectorContent_Serial numbers;
  OrderFloor* floor;
};

bool extend(N_Vector vector, OrderFloor* floor) {
  void* const longer = std::realloc(vector->content, sizeof(Content));
  if (!longer) return false;
  vector->content = longer;
  static_cast<Content*>(longer)->floor = floor;
  return true;
}

OrderFloor* floor_of(N_Vector vector) { return static_cast<Content*>(vector->content)->floor; }

template <auto kClone>
N_Vector clone(N_Vector from) {
  const N_Vector copy = kClone(from);
  if (!copy || extend(copy, floor_of(from))) return copy;
  N_VDestroy_Serial(copy);
  return nullptr;
}

sunrealtype masked_norm(N_Vector x, N_Vector weights, N_Vector mask) {
  const double norm = N_VWrmsNormMask_Serial(x, weights, mask);
  OrderFloor* const floor = floor_of(x);
  return floor ? floor->raise(norm) : norm;
}

}  // namespace

double OrderFloor::raise(double norm) {
  if (!active_ || norms_ >= kNorms) return norm;
  double floor = kFirst;
  for (int k = 0; k < norms_; ++k) floor *= kRatio;
  ++norms_;
  return norm < floor ? floor : norm;
}

void set_order_floor(N_Vector vector, OrderFloor* floor) {
  if (!extend(vector, floor)) throw std::bad_alloc();
  vector->ops->nvclone = clone<N_VClone_Serial>;
  vector->ops->nvcloneempty = clone<N_VCloneEmpty_Serial>;
  vector->ops->nvwrmsnormmask = masked_norm;
}

}  // namespace codesign
