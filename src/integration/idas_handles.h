// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "math/arrays.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

// The differences between SUNDIALS 6 and 7. All other names that are used here exist in both
// (sunrealtype, not realtype).

/// Return value of a matrix or linear solver operation without error: SUNMAT_SUCCESS and
/// SUNLS_SUCCESS in 6, SUN_SUCCESS in 7.
inline constexpr int kSundialsSuccess = 0;

/// Creates a context for one process, without MPI. @return zero, or an error code of SUNDIALS.
inline int create_context(SUNContext* context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
#endif
}

/// Redirects error messages of `ida`, created in `context`, from stderr to `message`, which holds
/// the latest. In SUNDIALS 7 this applies to every object of the context. @return zero, or a
/// negative error code. @param message must outlive both.
inline int keep_last_message(void* ida, SUNContext context, std::string* message) {
#if SUNDIALS_VERSION_MAJOR >= 7
  static_cast<void>(ida);
  // Every handler on the stack is called, and the one at the bottom writes to stderr, so the stack
  // is cleared first.
  if (const int flag = SUNContext_ClearErrHandlers(context); flag != kSundialsSuccess) return flag;
  const auto keep = [](int, const char*, const char*, const char* text, SUNErrCode, void* kept,
                       SUNContext) { *static_cast<std::string*>(kept) = text; };
  return SUNContext_PushErrHandler(context, keep, message);
#else
  static_cast<void>(context);
  const auto keep = [](int, const char*, const char*, char* text, void* kept) {
    *static_cast<std::string*>(kept) = text;
  };
  return IDASetErrHandlerFn(ida, keep, message);
#endif
}

/// Deleter for std::unique_ptr that calls a function of SUNDIALS.
template <auto kFree>
struct IdasDeleter {
  template <class T>
  void operator()(T* object) const {
    kFree(object);
  }
};

inline void free_context(SUNContext context) { SUNContext_Free(&context); }
inline void free_ida(void* ida) { IDAFree(&ida); }

using ContextHandle = std::unique_ptr<std::remove_pointer_t<SUNContext>, IdasDeleter<free_context>>;
using IdaHandle = std::unique_ptr<void, IdasDeleter<free_ida>>;
using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, IdasDeleter<N_VDestroy>>;
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, IdasDeleter<SUNMatDestroy>>;
using LinearSolverHandle =
    std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, IdasDeleter<SUNLinSolFree>>;

/// The numbers of a vector of SUNDIALS. SUNDIALS does not mark vectors that its callbacks only
/// read.
inline Span<double> span_of(N_Vector vector) {
  return {N_VGetArrayPointer(vector), N_VGetLength(vector)};
}

/// An owned array of vectors for the sensitivity functions of SUNDIALS.
class VectorArray {
 public:
  /// `count` vectors of the size of `like`. @throws std::bad_alloc
  VectorArray(int count, N_Vector like)
      : count_(count), vectors_(N_VCloneVectorArray(count, like)) {
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

/// Throws std::logic_error for a negative flag. For calls that fail only through a programming
/// error or lack of memory.
inline void require(int flag, const char* call) {
  if (flag < 0) throw std::logic_error(std::string(call) + " failed with " + std::to_string(flag));
}

/// The work of IDAS since its last restart.
struct IdasCounts {
  std::int64_t steps = 0;
  std::int64_t rejected = 0;  ///< failed error tests and solutions, sensitivities included
};

/// @param ida memory of IDAS. @param with_sensitivities whether it integrates any
IdasCounts count_idas(void* ida, bool with_sensitivities);

/// The Status for a return flag of IDASolve; ok for flags >= 0.
/// @param time reached by the run [s]. @param singular whether the last Newton matrix was singular.
/// @param message of IDAS, or of an exception in a callback; may be empty.
Status idas_status(int flag, double time, bool singular, const std::string& message);

/// The warning that sensitivities were restarted at `time` [s], where the steps had drifted off the
/// constraints. @param drift in tolerances.
Warning sensitivities_restarted(double time, double drift);

}  // namespace codesign
