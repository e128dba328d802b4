// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/table_recording.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "recordings/number_table.h"
#include "text/unknown_name.h"

namespace codesign {
namespace {

std::string text_of_file(const RecordingDescription& description, const std::string& path) {
  constexpr std::streamoff kMostBytes = std::streamoff{2} << 30;
  const auto fail = [&](const std::string& message, const std::string& allowed) {
    throw InputError({description.where, description.element + ".csv", message, path, allowed});
  };
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) fail(std::string("the file cannot be read: ") + std::strerror(errno), "a path, relative to the folder of the study");
  const std::streamoff size = file.tellg();
  if (size < 0 || size > kMostBytes) fail("no file, or one that is too large", "a file of at most 2 GB");
  std::string text(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  if (!file.read(text.data(), size)) fail(std::string("the file cannot be read: ") + std::strerror(errno), "");
  return text;
}

/// The index of a column that the study names.
int index_of(const ColumnDescription& column, const NumberTable& table) {
  if (column.number > 0) {
    if (column.number > table.width())
      throw InputError({column.where, column.element, "the table has " + std::to_string(table.width()) + " columns: " + table.file(),
                        std::to_string(column.number), "from 1 to " + std::to_string(table.width())});
    return column.number - 1;
  }
  const std::vector<std::string>& names = table.names();
  if (names.empty())
    throw InputError({column.where, column.element, "the columns of the table have no names: " + table.file(), column.name,
                      "a number from 1 to " + std::to_string(table.width())});
  const auto found = std::find(names.begin(), names.end(), column.name);
  if (found == names.end()) throw unknown_name(column.where, column.element, "column of " + table.file(), column.name, names);
  if (std::find(found + 1, names.end(), column.name) != names.end())
    throw InputError({column.where, column.element, "several columns have this name: " + table.file(), column.name,
                      "the number of the column, from 1 to " + std::to_string(table.width())});
  return static_cast<int>(found - names.begin());
}

/// A column that was found by its name in the table.
ColumnDescription named(const std::string& name, const RecordingDescription& description) {
  ColumnDescription column;
  column.name = name;
  column.where = description.where;
  column.element = description.element;
  return column;
}

/// `description` with the columns that have the names of signals.
RecordingDescription with_found_columns(RecordingDescription description, const NumberTable& table,
                                        const std::vector<std::string>& joints) {
  const auto has = [&table](const std::string& name) {
    return std::find(table.names().begin(), table.names().end(), name) != table.names().end();
  };
  for (const char* name : {"t", "time"})
    if (has(name)) description.time = named(name, description);
  for (const std::string& joint : joints)
    for (std::size_t k = 0; k < kMeasuredQuantityNames.size(); ++k) {
      const std::string name = joint + "/" + kMeasuredQuantityNames[k];
      if (has(name)) description.columns.push_back({joint, static_cast<MeasuredQuantity>(k), named(name, description)});
    }
  if (!description.time || description.columns.empty())
    throw InputError({description.where, description.element,
                      std::string("the table has no column named ") +
                          (description.time ? "JOINT/position, JOINT/velocity or JOINT/effort with a joint of the model" : "time or t") +
                          ", but " + (table.names().empty() ? "no names at all" : list_names(table.names())) + ": " + table.file(),
                      "", "columns: {time: COLUMN, JOINT/position: COLUMN, ...}"});
  return description;
}

std::vector<double> scaled(std::vector<double> values, const ColumnDescription& column) {
  if (column.scale != 1.0 || column.offset != 0.0)
    for (double& value : values) value = column.scale * value + column.offset;
  return values;
}

JointSamples& samples_of(const std::string& joint, std::vector<JointSamples>* joints) {
  for (JointSamples& samples : *joints)
    if (samples.joint == joint) return samples;
  joints->push_back({joint, {}, {}, {}});
  return joints->back();
}

}  // namespace

JointRecording read_table_recording(const RecordingDescription& description, const std::string& path,
                                    const std::vector<std::string>& joints) {
  const NumberTable table(path, text_of_file(description, path), description.delimiter);
  const RecordingDescription found = description.time ? description : with_found_columns(description, table, joints);
  std::vector<int> indices = {index_of(*found.time, table)};
  for (const MeasuredColumn& measured : found.columns) indices.push_back(index_of(measured.column, table));
  NumberTable::Columns columns = table.read(indices);
  JointRecording recording;
  recording.file = path;
  recording.element = description.element;
  recording.where = description.where;
  recording.places = std::move(columns.lines);
  recording.times = scaled(std::move(columns.values[0]), *found.time);
  for (std::size_t k = 0; k < found.columns.size(); ++k) {
    const MeasuredColumn& measured = found.columns[k];
    samples_of(measured.joint, &recording.joints).of(measured.quantity) = scaled(std::move(columns.values[k + 1]), measured.column);
  }
  return recording;
}

}  // namespace codesign
