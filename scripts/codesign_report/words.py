# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What the codes of a result mean, in words."""

TERMINATIONS = {
    "success": "The search converged: no step improves the objective any more.",
    "objective_value_reached": "The search reached the value of the objective that was asked for.",
    "objective_tolerance_reached": "The search converged: the last steps changed the objective by less than its tolerance.",
    "parameter_tolerance_reached": "The search converged: the last steps changed the parameters by less than their tolerance.",
    "all_combinations_searched": "Each combination of what is chosen was searched; the best one is shown.",
    "combinations_bounded": "Each combination of what is chosen was searched, or left out since its relaxation was worse than the one shown; "
                            "that holds where the searches of relaxations have found their least values.",
    "max_evaluations_reached": "The search used all its evaluations before it converged; the best point so far is shown. "
                               "A larger optimizer.max_evaluations, or going on from this result, may improve it.",
    "stopped_early": "The search stopped on a slope: its algorithms gained nothing more, but the point is not an optimum. "
                     "Another start or another algorithm may help.",
    "max_time_reached": "The search used all its time before it converged; the best point so far is shown.",
    "cancelled": "The search was cancelled; the best point so far is shown.",
    "roundoff_limited": "The search ended where rounding hides further progress; the point is usually as good as it gets.",
    "algorithm_failed": "The algorithm gave up; the best point so far is shown. Another algorithm or another start may help.",
    "infeasible": "No point that meets all constraints was found; the one shown violates them least.",
    "start_failed": "The start could not be simulated, so that there was nothing to improve.",
    "worker_lost": "A process that computed for the search was lost; the best point so far is shown, and --resume goes on.",
}

# Terminations of a search that converged.
SUCCESSES = ("success", "objective_tolerance_reached", "parameter_tolerance_reached", "roundoff_limited", "all_combinations_searched",
             "combinations_bounded")


def termination(code):
    """A sentence for a termination; that of an unknown one is its name."""
    return TERMINATIONS.get(code, "The search ended: " + code.replace("_", " ") + ".")


def stationarity(result):
    """How near the point is to an optimum, in words; empty if the result does not say it."""
    value, slope, start = (result.get(key) for key in ("stationarity", "slope", "initial_slope"))
    if value is None:
        return ""
    if (result.get("differences") or {}).get("disagrees"):
        return f"Stopped early: stationary to {value:.2g} by the gradient, which differences of the objective refute."
    if result.get("termination") in SUCCESSES:
        return f"Stationary to {value:.2g}."
    share = f"the slope is {slope / start:.2g} of the start's, " if slope is not None and start else ""
    return f"Stopped early: {share}stationary to {value:.2g} only."


def on_bound(row):
    """A word for a parameter on its bound."""
    return {"lower": "on lower bound", "upper": "on upper bound"}.get(row.get("bound"), "")
