// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

std::vector<SignalDescription> parsed_signals(const std::vector<std::string>& texts);

/// The signals of a run at a time.
std::vector<double> end_of(const std::string& urdf, const std::string& study, double time,
                           const std::vector<std::string>& texts);

/// A link of this mass [kg].
std::string mass(const std::string& name, double kilograms);

/// A vertical slide from the ground; `more` are further elements.
std::string lift(const std::string& name, const std::string& child, double height,
                 const std::string& more = "");

}  // namespace codesign
