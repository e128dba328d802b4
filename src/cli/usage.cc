// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/usage.h"

namespace codesign::cli {

std::string usage() {
  return R"(usage: codesign COMMAND MODEL [STUDY] [OPTIONS]

MODEL is an annotated URDF (doc/annotations.md), STUDY a YAML file (doc/study.md).

commands
  check MODEL [STUDY]      the table of equations, redundant constraints
  urdf MODEL [STUDY]       the URDF that is simulated: overlays merged, parameters at their values
    --sticks               for viewers: links without <visual>, or whose meshes are not here,
                           get sticks and spheres
  simulate MODEL STUDY     one run as CSV
    --signals A,B          the signals to print; by default of all joints, frictions, controllers
    --csv FILE             the file to write; by default standard output
    --samples N            number of equally spaced instants, at least 2; by default 101
  gradient MODEL STUDY     the objective and its gradient by direct sensitivities
    --verify[=METHOD]      compare with complex_step (the default) or ridders (always with idas)
  optimize MODEL STUDY     tune the study's parameters; Ctrl-C ends with the best point so far
    --output DIR           write result.json, tuned.urdf, gains.yaml, tables of both runs and of
                           the search (doc/results.md); best.urdf and best.json while it runs
    --resume DIR           go on with the optimization of DIR/journal.jsonl, killed or cancelled
  identify MODEL STUDY     fit parameters to recordings, and tell how well they are known
    --output DIR           write identification.json, identified_overlay.urdf, identified.urdf,
                           residuals.csv and job_study.yaml, the study
  excite MODEL STUDY       a motion within all limits, after whose recording identify knows most
    --output DIR           write trajectory.csv, plain.csv, excitation.json; with ROS trajectory.bag
  report DIR|BAG           a page with all that an optimization or identification has found
    -o FILE                the page; by default report.html
  apply DIR|BAG            send the gains of an optimization to a running robot, along a ramp, and
                           take them back if it leaves its limits (apply --help; with ROS)
  help                     this text
  --version                the version of this program, as "codesign 0.1.0"

options of every command
  --overlay FILE           annotations to merge into the model; may be repeated
  --result FILE            take the design of a result.json
  --set PARAMETER=VALUE    replace a parameter's value, or the start of a tuned one; may be repeated
  --json                   one JSON object on standard output, with this program's version

exit code: 0 success, 1 a failed run or output that cannot be written, 2 bad input
the codes of failures (error.code in JSON) are listed in doc/study.md, Statuses
)";
}

}  // namespace codesign::cli
