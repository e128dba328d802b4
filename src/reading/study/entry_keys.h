// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "description/motion_study.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/study/study_values.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

// The keys that an entry of a list or map of the study may have are rows, as those of blocks of
// options are (option_tables.h). A new key is a row, the member that it sets, and a line of its
// page: reading, the list of known keys and their messages follow, and test/reading/study/
// entry_keys_test.cc compares the rows with the pages.

/// What entries are read with.
struct EntryContext {
  const RobotDescription& robot;
  const ParameterTable& table;  ///< of Study::parameters
  const TrajectoryLoader& loader;
  const Study& study;  ///< as far as it has been read
};

/// For keys that need nothing else.
struct NoContext {};

/// A key of an entry. `read` sets what the key is about, or throws InputError; null: it is read
/// beside the other keys, since these depend on it.
template <class Entry, class Context = EntryContext>
struct EntryKey {
  using Read = std::function<void(const YamlValue& value, const Context& in, Entry* entry)>;

  const char* name;
  bool is_required;
  Read read;
};

template <class Entry, class Context = EntryContext>
using EntryKeys = std::vector<EntryKey<Entry, Context>>;

template <class Entry, class Context = EntryContext>
EntryKey<Entry, Context> required_key(const char* name,
                                      typename EntryKey<Entry, Context>::Read read = nullptr) {
  return {name, true, std::move(read)};
}
template <class Entry, class Context = EntryContext>
EntryKey<Entry, Context> optional_key(const char* name,
                                      typename EntryKey<Entry, Context>::Read read = nullptr) {
  return {name, false, std::move(read)};
}

/// Rows after others.
template <class Entry, class Context>
EntryKeys<Entry, Context> with(EntryKeys<Entry, Context> keys,
                               const EntryKeys<Entry, Context>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

/// Rows of a member of an entry as rows of the entry.
template <class Entry, class Part, class Context>
EntryKeys<Entry, Context> of_member(const EntryKeys<Part, Context>& keys, Part Entry::*member) {
  EntryKeys<Entry, Context> result;
  for (const EntryKey<Part, Context>& key : keys)
    result.push_back({key.name, key.is_required,
                      [read = key.read, member](const YamlValue& value, const Context& in,
                                                Entry* of) { read(value, in, &(of->*member)); }});
  return result;
}

/// Checks that an entry has all required keys and no unknown ones. @throws InputError
template <class Entry, class Context>
void require_keys(const YamlValue& value, const EntryKeys<Entry, Context>& keys) {
  std::vector<std::string> required, optional;
  for (const EntryKey<Entry, Context>& key : keys)
    (key.is_required ? required : optional).emplace_back(key.name);
  value.require_keys(required, optional);
}

/// Reads an entry: require_keys(), then the given keys in the order of the rows. @throws InputError
template <class Entry, class Context>
void read_entry(const YamlValue& value, const EntryKeys<Entry, Context>& keys,
                const Context& context, Entry* entry) {
  require_keys(value, keys);
  for (const EntryKey<Entry, Context>& key : keys)
    if (const auto found = value.find(key.name); found && key.read)
      key.read(*found, context, entry);
}

/// `between: [lower, upper]`, or `at_least` and `at_most` or one of these, into the members `lower`
/// and `upper` of an entry. require_bounds() checks that they are one of these forms.
template <class Entry>
EntryKeys<Entry> bound_keys() {
  return {
      optional_key<Entry>("between",
                          [](const YamlValue& value, const EntryContext& in, Entry* of) {
                            const std::vector<YamlValue> items = value.items();
                            if (items.size() != 2)
                              value.fail(
                                  "two bounds are needed, found " + std::to_string(items.size()),
                                  "[lower, upper]");
                            of->lower = read_quantity(items[0], in.table);
                            of->upper = read_quantity(items[1], in.table);
                          }),
      optional_key<Entry>("at_least",
                          [](const YamlValue& value, const EntryContext& in, Entry* of) {
                            of->lower = read_quantity(value, in.table);
                          }),
      optional_key<Entry>("at_most", [](const YamlValue& value, const EntryContext& in, Entry* of) {
        of->upper = read_quantity(value, in.table);
      })};
}
/// The order of the bounds is not checked. @throws InputError
void require_bounds(const YamlValue& entry);

using WatchedKeys = EntryKeys<WatchedSignal>;
using ControllerKeys = EntryKeys<ControllerDescription>;

/// `tolerance` of a bound, and the `weight` of a term that may be minimized or maximized.
EntryKey<WatchedSignal> tolerance_key();
EntryKey<WatchedSignal> term_weight_key();

/// The keys about the program of a controller on a robot, into ControllerDescription::realization.
ControllerKeys realization_keys(ControllerKind kind);

/// One form of the entries of a list or map, for the test of the pages.
struct EntryForm {
  std::string block;                  ///< `loads[]`
  std::vector<std::string> required;  ///< keys
  std::vector<std::string> optional;

  template <class Entry, class Context>
  EntryForm(std::string block_of, const EntryKeys<Entry, Context>& keys)
      : block(std::move(block_of)) {
    for (const EntryKey<Entry, Context>& key : keys)
      (key.is_required ? required : optional).emplace_back(key.name);
  }
};

// The forms of the entries that are read by rows.
std::vector<EntryForm> forms_of_starts();
std::vector<EntryForm> forms_of_loads();
std::vector<EntryForm> forms_of_terms();
std::vector<EntryForm> forms_of_watched_signals();
std::vector<EntryForm> forms_of_linear_numbers();
std::vector<EntryForm> forms_of_parameters();
std::vector<EntryForm> forms_of_constraints();
std::vector<EntryForm> forms_of_runs();
std::vector<EntryForm> forms_of_controllers();
std::vector<EntryForm> forms_of_recordings();
std::vector<EntryForm> forms_of_calibrations();
std::vector<EntryForm> forms_of_excited_joints();
std::vector<EntryForm> forms_of_hardware();
std::vector<EntryForm> forms_of_uncertain();

}  // namespace codesign
