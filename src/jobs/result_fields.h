// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The tables of all results. A new field of a result is a member and a row there, and a line of the
// .msg file if it is to be in a message; `tools/json_page --write` brings schema and page up to it.

#include "jobs/fit_fields.h"
#include "jobs/run_fields.h"
#include "jobs/search_fields.h"
