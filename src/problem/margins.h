// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "description/signal.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

struct ParameterConstraint;
struct Study;

/// The negative margin down to which a parameter constraint counts as met, because NLopt's
/// algorithms end on the boundary of the constraints, where rounding may leave either sign: -1e-7,
/// or where that is less 1e-7 of the margin's magnitude, which is what it is at the start and what
/// its parameters change it, to first order, over their ranges; doc/theory.md (24f).
double least_margin(const Study& study, const ParameterConstraint& constraint);

/// What a constraint has left at all named parameters, negative where it is violated: its margin,
/// of an equality minus the magnitude of it; NaN where it has no real value.
double margin_left(const ParameterConstraint& constraint, const std::vector<double>& parameters);

/// Whether a point may begin a search by its margins: those of equalities do not count, which no
/// point has that was drawn.
bool may_begin(const Study& study, const Eigen::VectorXd& margins);

/// Whether every margin is at least least_margin(); a margin that is NaN is not. @param margins
/// order of Study::constraints.
bool all_met(const Study& study, const Eigen::VectorXd& margins);

/// A sentence that lists the violated constraints with their margins, for the status of an
/// optimization.
std::string describe_unmet(const Study& study, const Eigen::VectorXd& margins);

/// @throws InputError naming the first constraint whose margin is not finite at `parameters`, the
/// start of an optimization.
void require_numbers_at_start(const Study& study, const std::vector<double>& parameters);

/// A warning for each constraint that no design can meet, by interval arithmetic: tuned parameters,
/// and parameters that a run sets or that are uncertain, vary within their bounds, the others have
/// their values. An optimization then ends as kInfeasible.
Warnings unsatisfiable_constraints(const Study& study);

/// @throws InputError if the two bounds of one expression, which are two constraints with the same
/// place, have changed their order since they were read.
void require_ordered_bounds(const Study& study);

}  // namespace codesign
