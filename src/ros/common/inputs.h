// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "jobs/job_files.h"
#include "problem/load_problem.h"

namespace codesign {

/// Reads the private parameters of a node:
/// - `~model`: path of the URDF; without it the text in `robot_description`;
/// - `~overlays`: a path or a list of paths;
/// - `~study`: a path, or the study itself as a tree of parameters
///   (`<rosparam ns="study" file=...>`);
/// - `~result`: path of a result.json, whose design replaces the values of model and study;
/// - `~set`: parameter values that replace the values of model, study and result, by name.
/// @throws InputError for a missing or ill-typed parameter or a file that cannot be read.
Inputs read_inputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

/// The folder of a node's study file; empty for a study on the parameter server.
std::string study_folder(const Inputs& inputs);

/// Checks that a study from the parameter server names every parameter of the model.
///
/// The parameter server drops empty mappings: an entry `crank_length: {}`, which means "tune it
/// between the model's bounds", does not arrive. A study that comes as a tree must therefore name
/// each parameter of the model, with `{tune: false}` for parameters that stay fixed.
/// @throws InputError for a parameter of the model that a tree does not name.
void require_every_parameter(const Inputs& inputs, const RobotDescription& robot);

/// The names of the private parameters that read_inputs() reads.
const std::vector<std::string>& input_parameters();

/// `description_differs` if the parameter `robot_description`, which robot_state_publisher and rviz
/// use, describes a mechanism other than `effective`, the URDF that is simulated. No warning if the
/// parameter is not set. @param drawn the same URDF with_sticks().
Warnings check_description(const ros::NodeHandle& node, const Problem& problem,
                           const std::string& effective, const std::string& drawn);

/// Whether the URDF `text` describes the simulated mechanism: it equals `effective` or `drawn`, or
/// it is the model's own file and neither overlays nor parameter values change the model.
bool describes(const std::string& text, const Problem& problem, const std::string& effective,
               const std::string& drawn);

}  // namespace codesign
