// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <limits>
#include <string>
#include <vector>

#include "mechanism_codesign/warning.h"

// Strict reading of a node's private parameters: a value of the wrong type is an InputError that
// shows the value; the default is used only for a parameter that is not set.

namespace codesign {

/// Reads a parameter of any type. False if it is not set or is an empty text, which launch files
/// use for "not set".
bool find_parameter(const ros::NodeHandle& node, const std::string& key,
                    XmlRpc::XmlRpcValue* value);

/// A finite number above zero, at most `largest`, or `fallback` if the parameter is not set.
/// @throws InputError for any other value.
double read_positive(const ros::NodeHandle& private_node, const std::string& key, double fallback,
                     double largest = std::numeric_limits<double>::max());

/// A truth value, also as the text `true` or `false`, or `fallback` if the parameter is not set.
/// @throws InputError for any other value.
bool read_flag(const ros::NodeHandle& private_node, const std::string& key, bool fallback);

/// A text, or `fallback` if the parameter is not set. @throws InputError for any other type.
std::string read_text(const ros::NodeHandle& private_node, const std::string& key,
                      const std::string& fallback);

/// A path, or `fallback`, with the home directory for a leading `~` and made absolute: a relative
/// one begins at the folder in which the node was started, which a client does not know. Empty
/// stays empty. @throws InputError if it is not a text.
std::string read_path(const ros::NodeHandle& private_node, const std::string& key,
                      const std::string& fallback);

/// A text or a list of texts; empty if the parameter is not set. @throws InputError for any other
/// type.
std::vector<std::string> read_texts(const ros::NodeHandle& private_node, const std::string& key);

/// The names in a text such as `a,b` or `[a, b]`, as a command line gives a list: rosrun passes
/// `_name:=[a,b]` on as text.
std::vector<std::string> names_in(const std::string& text);

/// The numbers in a text such as `{Kp: 80}`, as a command line gives a dictionary; without a type
/// if it holds anything else.
XmlRpc::XmlRpcValue dictionary_in(const std::string& text);

/// As read_texts(), but a text counts as names_in() it.
std::vector<std::string> read_names(const ros::NodeHandle& private_node, const std::string& key);

/// `unknown_parameter` for each private parameter whose name is not in `known`, with the nearest
/// known name.
Warnings unknown_parameters(const ros::NodeHandle& private_node,
                            const std::vector<std::string>& known);

/// `path` with the home directory for a leading `~`.
std::string expand_home(const std::string& path);

/// Throws an InputError that shows the value of a parameter. @param allowed the allowed values, for
/// the message.
[[noreturn]] void refuse_parameter(const ros::NodeHandle& node, const std::string& key,
                                   const std::string& message, const XmlRpc::XmlRpcValue& value,
                                   const std::string& allowed);

/// Reads a number: an integer, a floating-point number, or a text that spells one, since launch
/// files and YAML pass `1e6` on as text. False for any other value.
bool is_number(const XmlRpc::XmlRpcValue& value, double* number);

/// The content of a value that is a text.
std::string text_of(const XmlRpc::XmlRpcValue& value);

/// A tree of ROS parameters as YAML text, so that studies from the parameter server are read by the
/// same strict reader as files. Keys are sorted, since XML-RPC structs have no order.
std::string to_yaml(const XmlRpc::XmlRpcValue& tree);

}  // namespace codesign
