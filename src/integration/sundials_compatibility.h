// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <idas/idas.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

#include <string>

namespace codesign {

/// The differences between SUNDIALS 6 and 7. All other names that are used here exist in both (sunrealtype, not realtype).

/// Return value of a matrix or linear solver operation without error: SUNMAT_SUCCESS and SUNLS_SUCCESS in 6, SUN_SUCCESS in 7.
inline constexpr int kSundialsSuccess = 0;

/// Creates a context for one process, without MPI. @return zero, or an error code of SUNDIALS.
inline int create_context(SUNContext* context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
#endif
}

/// Redirects error messages of `ida`, created in `context`, from stderr to `message`, which holds the latest. In SUNDIALS 7 this applies to
/// every object of the context. @return zero, or a negative error code. @param message must outlive both.
inline int keep_last_message(void* ida, SUNContext context, std::string* message) {
#if SUNDIALS_VERSION_MAJOR >= 7
  static_cast<void>(ida);
  // Every handler on the stack is called, and the one at the bottom writes to stderr, so the stack is cleared first.
  if (const int flag = SUNContext_ClearErrHandlers(context); flag != kSundialsSuccess) return flag;
  const auto keep = [](int, const char*, const char*, const char* text, SUNErrCode, void* kept, SUNContext) {
    *static_cast<std::string*>(kept) = text;
  };
  return SUNContext_PushErrHandler(context, keep, message);
#else
  static_cast<void>(context);
  const auto keep = [](int, const char*, const char*, char* text, void* kept) { *static_cast<std::string*>(kept) = text; };
  return IDASetErrHandlerFn(ida, keep, message);
#endif
}

}  // namespace codesign
