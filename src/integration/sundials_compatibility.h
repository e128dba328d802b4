// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_SUNDIALS_COMPATIBILITY_H_
#define MECHANISM_CODESIGN_INTEGRATION_SUNDIALS_COMPATIBILITY_H_

#include <idas/idas.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

#include <string>

namespace codesign {

/// What SUNDIALS 6 and 7 call differently. Everything else that we use has one name in both (sunrealtype, not realtype).

/// What the functions of a matrix and a linear solver return when all is well: SUNMAT_SUCCESS and SUNLS_SUCCESS in 6, SUN_SUCCESS in 7.
inline constexpr int kSundialsSuccess = 0;

/// A context for one process. @return zero, or SUNDIALS's error.
inline int create_context(SUNContext* context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
#endif
}

/// Writes the sentence of the latest error of `ida`, made in `context`, to `message` and nothing to stderr. In 7 that holds for everything
/// made in the context. @return zero, or a negative error. @param message must outlive both.
inline int keep_last_message(void* ida, SUNContext context, std::string* message) {
#if SUNDIALS_VERSION_MAJOR >= 7
  static_cast<void>(ida);
  // The handlers form a stack and all of it is called; at its bottom lies the one that writes to stderr.
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

#endif  // MECHANISM_CODESIGN_INTEGRATION_SUNDIALS_COMPATIBILITY_H_
