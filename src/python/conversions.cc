// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "python/conversions.h"

#include <utility>

#include "jobs/files.h"
#include "jobs/json_records.h"
#include "math/arrays.h"
#include "mechanism_codesign/error.h"

namespace codesign::python {
namespace {

namespace py = pybind11;

/// Names in a model may have bytes that are not UTF-8.
py::str to_str(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), to_signed(text.size()), "replace"));
}

void raise(const char* name, const py::object& argument) {
  const py::object type = py::module_::import("mechanism_codesign._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(argument).ptr());
}

py::list list_of(const Json& json) {
  py::list list;
  for (const Json& item : json) list.append(to_python(item));
  return list;
}

}  // namespace

py::object to_python(const Json& json) {
  switch (json.type()) {
    case Json::value_t::object: {
      py::dict object;
      for (const auto& [key, value] : json.items()) object[to_str(key)] = to_python(value);
      return object;
    }
    case Json::value_t::array:
      return list_of(json);
    case Json::value_t::string:
      return to_str(json.get<std::string>());
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

py::array_t<double> to_array(const Eigen::VectorXd& values) {
  return py::array_t<double>(values.size(), values.data());
}

py::array_t<double> to_array(const Eigen::MatrixXd& values) {
  const Eigen::Index step = sizeof(double);
  return py::array_t<double>({values.rows(), values.cols()}, {step, step * values.rows()},
                             values.data());
}

py::array keep_as_array(std::vector<double> values, std::size_t room, std::size_t rows) {
  const std::size_t columns = room > 0 ? values.size() / room : 0;
  auto kept = std::make_unique<std::vector<double>>(std::move(values));
  double* const data = kept->data();
  const py::capsule owner(kept.release(),
                          [](void* held) { delete static_cast<std::vector<double>*>(held); });
  py::array_t<double> array({columns, rows}, {room * sizeof(double), sizeof(double)}, data, owner);
  array.attr("setflags")(false);
  return array;
}

std::vector<double> to_numbers(const py::handle& values, const std::string& name) {
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  // What a conversion would lose: masks, imaginary parts, and the units of dates and durations.
  if (py::module_::import("numpy").attr("ma").attr("is_masked")(values).cast<bool>())
    throw py::type_error(name + " has masked values; leave them out");
  if (const auto given = py::array::ensure(values);
      given && std::string("cmM").find(given.dtype().kind()) != std::string::npos)
    throw py::type_error(name + " has the type " + py::str(given.dtype()).cast<std::string>() +
                         "; real numbers in SI units are needed");
  const Numbers array = Numbers::ensure(values);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(name + " is no array of numbers");
  }
  if (array.ndim() != 1)
    throw py::value_error(name + " has " + std::to_string(array.ndim()) + " dimensions, not one");
  return {array.data(), array.data() + array.size()};
}

std::string to_name(const py::handle& value, const std::string& name) {
  if (!py::isinstance<py::str>(value))
    throw py::type_error(name + " needs names, not " + py::repr(value).cast<std::string>());
  return value.cast<std::string>();
}

ParameterSettings to_settings(const py::dict& settings) {
  ParameterSettings result;
  for (const auto& [name, value] : settings) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (number == -1.0 && PyErr_Occurred() != nullptr) {
      PyErr_Clear();
      throw py::type_error("the parameter " + py::str(name).cast<std::string>() +
                           " needs a number, not " + py::repr(value).cast<std::string>());
    }
    result.emplace_back(py::str(name).cast<std::string>(), number);
  }
  return result;
}

SourceText to_source(const py::tuple& source) {
  const auto name = source[0].cast<std::string>();
  if (source[1].is_none()) return read_source(name);
  return {name, source[1].cast<std::string>()};
}

py::list to_list(const std::vector<std::string>& names) {
  py::list list;
  for (const std::string& name : names) list.append(to_str(name));
  return list;
}

void translate_exceptions() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const InputError& error) {
      raise("InputError", to_python(to_json(error)));
    } catch (const OutputError& error) {
      raise("OutputError", to_str(error.what()));
    }
  });
}

}  // namespace codesign::python
