// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "description/expression.h"
#include "description/parameter_switches.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// The names of the parameters, in order.
std::vector<std::string> names_of(const std::vector<Parameter>& parameters);

/// The index of the parameter named `name`, which the study must not tune. @throws InputError,
/// located at `at`.
/// @param others further allowed names, for the list in the message.
int untuned_parameter(const std::string& name, const Study& study, const YamlValue& at,
                      const std::vector<std::string>& others = {});

int untuned_parameter(const std::string& name, const Study& study, const SourceLocation& where,
                      const std::string& element, const std::vector<std::string>& others = {});

/// Refuses a value that is not finite or outside the bounds of a parameter. @throws InputError
void require_within_bounds(double value, const Parameter& parameter, const SourceLocation& where,
                           const std::string& element);
/// Reads a number and does the same.
double read_within_bounds(const YamlValue& value, const Parameter& parameter);

/// Refuses a name in an expression of signals that is neither a signal, a parameter nor the time t.
/// @throws InputError
void require_known(const SignalDescription& signal, const std::vector<std::string>& parameters,
                   const SourceLocation& where, const std::string& element);

/// A number above zero. @param unit for the message, for example " s". @throws InputError
double read_above_zero(const YamlValue& value, const std::string& unit = "");

/// Whether a text is `${...}`.
bool is_expression(const std::string& text);

/// What stands within the braces of a text that is_expression().
std::string expression_in(const std::string& text);

/// A number, or `${expression}` of all named parameters. @throws InputError if it is invalid or not
/// finite at the parameters' start.
Quantity read_quantity(const YamlValue& value, const ParameterTable& table);

/// Notes that the study depends on the parameters in an expression of signals. Names that are no
/// parameters are left to resolve_signal().
void use_parameters(const SignalDescription& signal, const ParameterTable& table);

/// The switches of a signal that is an expression, find_switches().
std::vector<ParameterSwitch> switches_of(const SignalDescription& signal,
                                         const ParameterTable& table, bool at_instant);

/// Adds the switches of what is read at single instants: terminal terms, terms of postures, watched
/// signals without a band, and functions of time that a sampled controller reads.
void add_switches_at_instants(const ParameterTable& table, Study* study);

/// A list of three quantities. @throws InputError
QuantityVector read_vector(const YamlValue& value, const ParameterTable& table);

/// The joint or loop named `name`. @throws InputError, located at `at`, if there is none or it does
/// not have exactly one coordinate.
const JointDescription& scalar_joint(const std::string& name, const RobotDescription& robot,
                                     const YamlValue& at);

}  // namespace codesign
