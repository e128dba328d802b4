// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

namespace codesign::python {

/// Never returns once the interpreter ends. A thread that then asks for Python's lock is ended by
/// Python in the middle of C++, which ends the process with an error; so it waits for the end.
inline void wait_if_python_ends() {
#if PY_VERSION_HEX >= 0x030D0000
  while (Py_IsFinalizing()) pause();
#else
  while (_Py_IsFinalizing()) pause();
#endif
}

/// Gives Python's lock up in this scope.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked() {
    wait_if_python_ends();
    PyEval_RestoreThread(state_);
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Holds Python's lock in this scope, in any thread.
class Locked {
 public:
  Locked() : state_((wait_if_python_ends(), PyGILState_Ensure())) {}
  ~Locked() { PyGILState_Release(state_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};

}  // namespace codesign::python
