// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_PARAMETERS_H_
#define MECHANISM_CODESIGN_ROS_PARAMETERS_H_

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

#include "mechanism_codesign/warning.h"

// Private parameters of a node, read strictly: one of the wrong type is an InputError that shows its value, never the default.

namespace codesign {

/// False if `key` is not set, or an empty text, as launch files leave it. The value may be of any type.
bool find_parameter(const ros::NodeHandle& node, const std::string& key, XmlRpc::XmlRpcValue* value);

/// A finite number above zero, or `fallback` if it is not set. @throws InputError if it is none.
double read_positive(const ros::NodeHandle& private_node, const std::string& key, double fallback);

/// The same, and at most `largest`.
double read_positive(const ros::NodeHandle& private_node, const std::string& key, double fallback, double largest);

/// true or false. @throws InputError
bool read_flag(const ros::NodeHandle& private_node, const std::string& key, bool fallback);

/// @throws InputError if it is no text.
std::string read_text(const ros::NodeHandle& private_node, const std::string& key, const std::string& fallback);

/// A path, in which a leading `~` is the home directory. @throws InputError if it is no text.
std::string read_path(const ros::NodeHandle& private_node, const std::string& key, const std::string& fallback);

/// A text or a list of texts; none if it is not set. @throws InputError
std::vector<std::string> read_texts(const ros::NodeHandle& private_node, const std::string& key);

/// A warning for each private parameter whose name is none of `known`, with the nearest one.
Warnings unknown_parameters(const ros::NodeHandle& private_node, const std::vector<std::string>& known);

/// `path` with the home directory for a leading `~`.
std::string expand_home(const std::string& path);

/// Refuses the value of a parameter, showing it.
[[noreturn]] void refuse_parameter(const ros::NodeHandle& node, const std::string& key, const std::string& message,
                                   const XmlRpc::XmlRpcValue& value, const std::string& allowed);

/// False if the value is no number.
bool is_number(const XmlRpc::XmlRpcValue& value, double* number);

/// A text's content. The value must hold one.
std::string text_of(const XmlRpc::XmlRpcValue& value);

/// A tree of ROS parameters as YAML text, for the one strict reader of studies. XML-RPC structs know no order: keys come out sorted.
std::string to_yaml(const XmlRpc::XmlRpcValue& tree);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_PARAMETERS_H_
