// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "description/excitation.h"
#include "description/identification.h"
#include "description/named_file.h"
#include "description/reference.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `parameters:` into Study::parameters (the model's, then the study's own) and Study::tuned
/// (in the order written). Start and bounds default to the model's; a parameter that the model does
/// not have needs `initial`. @throws InputError
/// @param files reads tables of rows to choose from.
void read_parameters(const YamlValue& study_value, const RobotDescription& robot,
                     const FileLoader& files, Study* study);

/// Whether an entry of `parameters:` is a list of rows with several numbers, or a table of them.
bool is_catalogue(const YamlValue& value);
/// Reads such an entry: tunes the parameters of its columns, which must be known, together.
/// @throws InputError
void read_catalogue(const std::string& name, const YamlValue& value, const FileLoader& files,
                    Study* study);
/// Reads `choice` or `integer` of the parameter `index`, whose start has been read, and tunes it.
/// @throws InputError
void read_choice(const std::string& name, const YamlValue& value, int index, Study* study);

/// Sets a parameter's bounds to `lower` and `upper` of a map, where given.
/// @throws InputError if lower is not below upper, or the parameter's value is not within them.
void read_bounds(const YamlValue& value, Parameter* parameter);

/// Reads a known number, or a map `{initial, lower, upper}`, which may be empty, of a number to be
/// fitted. Missing keys leave their values unchanged.
/// @param lower bound of a fitted number unless another one is given. @throws InputError
void read_fitted(const YamlValue& value, double lower, FittedNumber* number);

/// Appends the parameters that basis controllers declare by `coefficients: {count, initial, lower,
/// upper, tune}` to Study::parameters. For a controller `push` they are push_c0, push_c1, ...
/// @throws InputError
void declare_coefficients(const YamlValue& study_value, Study* study);

/// Appends parameters with the names PREFIX0, PREFIX1, ... and the keys lower, upper and tune of
/// `value`. @throws InputError for a name that is none or is taken.
void declare_numbers(const YamlValue& value, const std::string& prefix,
                     const std::vector<double>& starts, Study* study);
/// Appends the parameters of `gains: {from: lqr, weights}` and `gains: {from: poles, poles}` of
/// state feedbacks, NAME_k0, ..., and what they start from. @throws InputError
void declare_gains(const YamlValue& study_value, Study* study);
/// The gain of signal `k` of such a controller; nothing if `controller` has other gains.
std::optional<Quantity> initial_gain(const std::string& controller, std::size_t k,
                                     const ParameterTable& table, const Study& study);

/// Reads the keys of one basis controller, after declare_coefficients(). @param table of
/// Study::parameters.
/// @throws InputError
BasisDescription read_basis(const std::string& controller, const YamlValue& value,
                            const ParameterTable& table, double study_duration);

/// The key, `peak` or a measure, by which an item of `constraints:` bounds a signal and not
/// parameters; read_watched() reads such items. Null for others.
const char* bounded_measure(const YamlValue& item);

/// Whether an item of `constraints:` bounds a number of a linearization; read_linear() reads it.
bool is_linear_item(const YamlValue& item);
/// Appends the terms `objective.loop`, `objective.poles` and the bounds of `constraints:` on them
/// to Study::watched, of which they are the last. @throws InputError for a controller that is none
/// or drives no joint, and in a study with postures.
void read_linear(const YamlValue& study_value, const RobotDescription& robot,
                 const ParameterTable& table, const TrajectoryLoader& loader, Study* study);

/// Reads the constraints among parameters in the list `constraints:`, each `left >= right`, `left
/// <= right` or
/// `{expression: "${...}", between: [lower, upper]}`; a bound on both sides becomes two
/// constraints. Study::parameters must have been read.
/// @throws InputError
void read_constraints(const YamlValue& study_value, const RobotDescription& robot,
                      const TrajectoryLoader& loader, Study* study);

/// Reads `initial_state:`. @param table of Study::parameters. @throws InputError
void read_initial_state(const YamlValue& study_value, const RobotDescription& robot,
                        const ParameterTable& table, Study* study);

/// Reads `duration:` and `until:`, the end of a run. Study::parameters must have been read, and for
/// read_until() Study::controllers.
/// @throws InputError for a duration that is not positive or that bounds of parameters do not keep
/// above 0 and finite, for what is no condition, and in a study that identifies or excites.
void read_duration(const YamlValue& root, const ParameterTable& table, Study* study);
void read_until(const YamlValue& root, const RobotDescription& robot, const ParameterTable& table,
                Study* study);
/// Refuses what runs whose end depends on the design cannot have, after all else has been read.
/// @throws InputError
void check_moving_end(const Study& study);

/// The number of postures of `positions:`, or 0 without it. @throws InputError for a study that has
/// blocks of a motion, too.
int count_postures(const YamlValue& study_value);

/// Reads `positions:`, the positions of joints in each posture: a list of quantities or `{from, to,
/// count}`. read_initial_state() must have been called. @param table of Study::parameters. @throws
/// InputError
void read_positions(const YamlValue& study_value, const RobotDescription& robot,
                    const ParameterTable& table, Study* study);

/// Reads `loads:`, efforts and wrenches. Study::controllers must have been read. @param table of
/// Study::parameters. @throws InputError
void read_loads(const YamlValue& study_value, const RobotDescription& robot,
                const ParameterTable& table, const TrajectoryLoader& loader, Study* study);

/// The loader of trajectories in bags, and in tables that `files` reads; each may be empty. Both
/// must outlive it.
TrajectoryLoader trajectories_of(const TrajectoryLoader& bags, const FileLoader& files);

/// Reads a function of time: a quantity, an expression of the time t, or a map whose `type` is
/// sine, waypoints or trajectory.
/// @param loader for trajectories, trajectories_of(). @throws InputError
ReferenceDescription read_reference(const YamlValue& value, const ParameterTable& table,
                                    const TrajectoryLoader& loader);

/// Reads `motion:`, the joints whose motion is given. Study::duration, initial_state and
/// controllers must have been read. @param table of Study::parameters. @throws InputError
void read_motion(const YamlValue& study_value, const RobotDescription& robot,
                 const ParameterTable& table, const TrajectoryLoader& loader, Study* study);

/// Reads `controllers:`. Study::duration must have been read.
/// @param table of Study::parameters, with the coefficients of basis controllers. @throws
/// InputError
void read_controllers(const YamlValue& study_value, const RobotDescription& robot,
                      const ParameterTable& table, const TrajectoryLoader& loader, Study* study);

/// Reads the bounds of a controller's number: one positive number for both sides, or `[lower,
/// upper]`. @param may_be_zero whether they may be 0. @throws InputError
ControlBounds read_control_bounds(const YamlValue& value, const ParameterTable& table,
                                  bool may_be_zero);

/// Reads `filter:`, a map or a list of maps, each with `type` and the numbers of the filter.
/// @throws InputError
std::vector<FilterDescription> read_filters(const YamlValue& value, const ParameterTable& table);

/// @throws InputError for a sampled filter whose frequency its sample time does not show.
void check_filters(const ControllerDescription& controller);

/// @throws InputError for keys about a controller's program on a robot, realization_keys(), that
/// have no effect without others.
void check_realization(const YamlValue& value, const ControllerDescription& controller);

/// Reads `hardware:`, doc/study.md: for controllers of the study, the namespaces of their gains on
/// the robot. The controllers must have been read. @throws InputError for an unknown controller, a
/// controller without gains of control_toolbox, a bad or repeated namespace, or an `i` gain without
/// `i_clamp`.
void read_hardware(const YamlValue& root, const ParameterTable& table, Study* study);

/// read_reference(), or in a study with postures a list of quantities, one for each of them.
/// @throws InputError
ReferenceDescription read_target(const YamlValue& value, const ParameterTable& table,
                                 const TrajectoryLoader& loader, const Study& study);

/// Reads `objective:`, which may be missing or empty. Study::controllers must have been read.
/// @param table of Study::parameters. @throws InputError
void read_objective(const YamlValue& study_value, const RobotDescription& robot,
                    const ParameterTable& table, const TrajectoryLoader& loader, Study* study);

/// Reads `path:`, `final:`, `objective.peak:` and the measures in `objective:` and `constraints:`,
/// each a list that may be missing.
/// Study::controllers and Study::duration must have been read. @param table of Study::parameters.
/// @throws InputError
void read_watched(const YamlValue& study_value, const RobotDescription& robot,
                  const ParameterTable& table, const TrajectoryLoader& loader, Study* study);

/// Reads all of a study except the blocks of EnsembleDescription.
using RunReader = std::function<Study(const YamlValue& study_value)>;

/// Reads the map `runs:`, or the table that it names. The changes of a run are merged into the
/// study's own tree, and the whole is read by `read_run`.
/// @param study as read without changes. @param files reads the table. @throws InputError
std::vector<RunDescription> read_runs(const YamlValue& study_value, const Study& study,
                                      const RunReader& read_run, const FileLoader& files);

/// Reads the map `uncertain:`.
/// @param study with its parameters. @param runs of the study; parameters that they set cannot be
/// uncertain. @param files reads the file that `from` names; empty: such a study is refused.
/// @throws InputError
std::vector<UncertainQuantity> read_uncertain(const YamlValue& uncertain,
                                              const RobotDescription& robot, const Study& study,
                                              const std::vector<RunDescription>& runs,
                                              const FileLoader& files);

/// Reads `uncertain.from`: the normal distribution of several parameters that an identification has
/// found, with its correlations, doc/theory.md (24h). Numbers of sensors and recordings, which are
/// not parameters of the model, are left out: the result is the marginal distribution of the other
/// numbers.
/// @param from the file's path, or {file, except}. @param study with its parameters. @param own
/// names with a distribution of their own in `uncertain:`. @param files reads the file; empty:
/// refused. @param first how many uncertain quantities come before these
/// @throws InputError, located in the study or in the file
std::vector<UncertainQuantity> read_identified(const YamlValue& from, const Study& study,
                                               const std::set<std::string>& own,
                                               const FileLoader& files, std::size_t first);

/// Reads `runs:`, `uncertain:`, `robust:`, `multistart:` and `engine:`. All other blocks of the
/// study must have been read. `robust` is set exactly if the study has runs or uncertain
/// quantities. @param files as in read_study(). @throws InputError
EnsembleDescription read_ensemble(const YamlValue& study_value, const RobotDescription& robot,
                                  const RunReader& read_run, const FileLoader& files,
                                  const Study& study);

/// Reads the list `tradeoff:`, each item `{name: NAME, objective: {...}}`: the study is read with
/// each objective. All other blocks must have been read. @throws InputError for less than two or
/// more than three, a name that is none or is taken, no term, and in a study with `objective`.
std::vector<TradeoffObjective> read_tradeoff(const YamlValue& study_value,
                                             const RobotDescription& robot,
                                             const RunReader& read_run, const FileLoader& files,
                                             const Study& study);

/// Reads a list of recordings, `identify.data` or `identify.holdout`; at least one. @throws
/// InputError
std::vector<RecordingDescription> read_recording_list(const YamlValue& list,
                                                      const RobotDescription& robot,
                                                      const Study& study);

/// Reads the map `identify:` of a study whose parameters have been read. The recordings themselves
/// are not opened. There may be none: of a motion that is planned, or in a program that has them as
/// arrays. @throws InputError
IdentificationDescription read_identification(const YamlValue& identify,
                                              const RobotDescription& robot, const Study& study);

/// The duration of a study with `identify:` that has no `duration`: the duration of a segment,
/// `identify.segment` or its default [s].
double segment_of(const YamlValue& identify);

/// Reads the map `efforts:` of a study, whose one key is `grid`. @throws InputError
PostureGrid read_posture_grid(const YamlValue& efforts, const RobotDescription& robot);

/// Reads the map `excite:` of a study. Whether the joints determine the motion is not examined.
/// @throws InputError
ExcitationDescription read_excitation(const YamlValue& excite, const RobotDescription& robot);

}  // namespace codesign
