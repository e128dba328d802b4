// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "integration/sundials_compatibility.h"
#include "math/span.h"

namespace codesign {

/// Deleter for std::unique_ptr that calls a function of SUNDIALS.
template <auto kFree>
struct Release {
  template <class T>
  void operator()(T* object) const {
    kFree(object);
  }
};

inline void free_context(SUNContext context) { SUNContext_Free(&context); }
inline void free_ida(void* ida) { IDAFree(&ida); }

using ContextHandle = std::unique_ptr<std::remove_pointer_t<SUNContext>, Release<free_context>>;
using IdaHandle = std::unique_ptr<void, Release<free_ida>>;
using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, Release<N_VDestroy>>;
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Release<SUNMatDestroy>>;
using LinearSolverHandle = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Release<SUNLinSolFree>>;

/// The numbers of a vector of SUNDIALS. SUNDIALS does not mark vectors that its callbacks only read.
inline Span<double> span_of(N_Vector vector) { return {N_VGetArrayPointer(vector), N_VGetLength(vector)}; }

/// An owned array of vectors for the sensitivity functions of SUNDIALS.
class VectorArray {
 public:
  /// `count` vectors of the size of `like`. @throws std::bad_alloc
  VectorArray(int count, N_Vector like) : count_(count), vectors_(N_VCloneVectorArray(count, like)) {
    if (!vectors_) throw std::bad_alloc();
  }
  ~VectorArray() { N_VDestroyVectorArray(vectors_, count_); }
  VectorArray(const VectorArray&) = delete;
  VectorArray& operator=(const VectorArray&) = delete;

  N_Vector* get() { return vectors_; }
  Span<double> span(int k) const { return span_of(vectors_[k]); }

 private:
  int count_;
  N_Vector* vectors_;
};

inline ContextHandle make_context() {
  SUNContext context = nullptr;
  if (create_context(&context) != kSundialsSuccess) throw std::bad_alloc();
  return ContextHandle(context);
}

inline VectorHandle make_vector(int size, SUNContext context) {
  N_Vector vector = N_VNew_Serial(size, context);
  if (!vector) throw std::bad_alloc();
  N_VConst(0.0, vector);
  return VectorHandle(vector);
}

/// Throws std::logic_error for a negative flag. For calls that fail only through a programming error or lack of memory.
inline void require(int flag, const char* call) {
  if (flag < 0) throw std::logic_error(std::string(call) + " failed with " + std::to_string(flag));
}

}  // namespace codesign
