// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "integration/event_log.h"
#include "mechanism_codesign/event.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

class CompiledSystem;

/// A switch for messages: "loads[0].effort, \"sign(slide/velocity)\"". @param origin null: not
/// known.
std::string describe_switch(const CompiledSystem& system, const SwitchOrigin* origin);

/// The events of a run with the names of their elements.
Events events_of(const CompiledSystem& system, const EventLog& log);

/// A warning `grazing_event` for each switch whose guard was only touched where the motion jumps,
/// or would jump: the first time, element and guard.
Warnings grazing_warnings(const CompiledSystem& system, const EventLog& log);

}  // namespace codesign
