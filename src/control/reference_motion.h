// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

namespace codesign {

/// A function of time and its first three time derivatives at one instant.
template <class T>
struct ReferenceMotion {
  T value{0.0}, rate{0.0}, acceleration{0.0}, jerk{0.0};
};

/// Makes a function of this kind of one among several kinds. One that is of this kind already uses
/// its memory again, so that the same description at other parameters allocates nothing.
template <class Kind, class... Kinds, class Description, class T>
void set_kind(std::variant<Kinds...>* function, const Description& description,
              const std::vector<T>& parameters) {
  Kind* kind = std::get_if<Kind>(function);
  if (!kind) kind = &function->template emplace<Kind>();
  kind->set(description, parameters);
}

}  // namespace codesign
