// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace codesign::python {

/// Calls `work`, which asks for Python's lock or runs Python. Once the interpreter ends, Python
/// ends a thread that does so by unwinding its stack, which frames of C++ do not survive; here such
/// a thread waits for the end of the process instead.
template <class Work>
auto outlive_python(const Work& work) {
  try {
    return work();
  } catch (abi::__forced_unwind&) {
    for (;;) pause();
  }
}

/// Gives Python's lock up in this scope.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked() {
    outlive_python([this] { PyEval_RestoreThread(state_); });
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Holds Python's lock in this scope, in any thread.
class Locked {
 public:
  Locked() : state_(outlive_python([] { return PyGILState_Ensure(); })) {}
  ~Locked() { PyGILState_Release(state_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};

}  // namespace codesign::python
