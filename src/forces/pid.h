// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The PID law u = p e + i s + d e', theory (C3), with the error e, its integral s and its rate e'. The gains are the derivatives of u by
/// e, s and e'.
template <class T>
struct Pid {
  T p{0.0}, i{0.0}, d{0.0};

  T output(const T& error, const T& integral, const T& error_rate) const { return p * error + i * integral + d * error_rate; }
};

}  // namespace codesign
