// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "jobs/json.h"
#include "mechanism_codesign/problem.h"

namespace codesign::python {

/// A JSON record as dictionaries, lists and numbers. Numbers stay as they are: NaN and infinity,
/// too.
pybind11::object to_python(const Json& json);

/// A new array with these values; the second one has the shape rows x columns.
pybind11::array_t<double> to_array(const Eigen::VectorXd& values);
pybind11::array_t<double> to_array(const Eigen::MatrixXd& values);

/// An array of columns x rows over the values, which it keeps: no value is copied.
/// @param values columns of `room` values each, of which the first `rows` are shown. Read-only.
pybind11::array keep_as_array(std::vector<double> values, std::size_t room, std::size_t rows);

/// The numbers of a list or array of one dimension. @param name for messages. @throws
/// pybind11::value_error; pybind11::type_error also for masked values, complex numbers, dates and
/// durations
std::vector<double> to_numbers(const pybind11::handle& values, const std::string& name);
/// @param name for messages, of the list. @throws pybind11::type_error for what is no string
std::string to_name(const pybind11::handle& value, const std::string& name);

/// Values by parameter. @throws pybind11::type_error for one that is no number.
ParameterSettings to_settings(const pybind11::dict& settings);

/// A file, or a text as pair (name for messages, text). @throws InputError as read_source().
SourceText to_source(const pybind11::tuple& source);

/// Names as a list.
pybind11::list to_list(const std::vector<std::string>& names);

/// Makes the exceptions of the library those of the Python package: InputError with file, line,
/// element, value and allowed range, and OutputError.
void translate_exceptions();

}  // namespace codesign::python
