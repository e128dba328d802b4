// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_reader.h"

#include "description/excursions.h"
#include "reading/parameter_table.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_options.h"
#include "reading/study/study_values.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {
namespace {

void require_purpose_of_excite(const YamlValue& root) {
  const auto excite = root.find("excite");
  if (excite && !root.find("identify"))
    excite->fail("the study identifies nothing, so that no motion is better than another",
                 "a block identify; without data it may be {}");
}

/// An excitation plans the motion of all joints.
void refuse_motion_of_excitation(const YamlValue& root) {
  if (const auto motion = root.find("motion"); motion && root.find("excite"))
    motion->fail("the motion that `excite` seeks is that of all joints that determine it",
                 "no motion in a study that excites");
}

std::array<double, 3> read_gravity(const YamlValue& value) {
  const std::vector<YamlValue> items = value.items();
  if (items.size() != 3)
    value.fail("gravity needs three components, found " + std::to_string(items.size()),
               "[x, y, z] in m/s^2");
  return {items[0].number(), items[1].number(), items[2].number()};
}

/// The adjoint cannot compute the derivatives of extreme values.
void refuse_adjoint(const YamlValue& root, const Study& study) {
  if (study.solver.gradient != GradientMethod::kAdjoint ||
      std::all_of(study.watched.begin(), study.watched.end(),
                  [](const WatchedSignal& watched) { return watched.linear != nullptr; }))
    return;
  root.at("solver")
      .at("gradient")
      .fail(
          "the adjoint has no derivatives of the extreme values that path, final, objective.peak "
          "and "
          "peaks in constraints need",
          "auto, direct");
}

/// Postures are not integrated, and their derivatives need no choice of a method.
void refuse_integrator_of_postures(const YamlValue& root, const Study& study) {
  if (study.postures == 0) return;
  if (study.solver.integrator == IntegratorKind::kIdas)
    root.at("solver").at("integrator").fail("postures are not integrated", "rosenbrock");
  if (study.solver.gradient == GradientMethod::kAdjoint)
    root.at("solver").at("gradient").fail("postures have no adjoint", "auto, direct");
}

/// Reads all blocks of one run and its optimization, that is all except the blocks of
/// read_ensemble(). Does not check the keys of the root.
Study read_single_run(const YamlValue& root, const std::string& file, const RobotDescription& robot,
                      const TrajectoryLoader& loader, const FileLoader& files) {
  Study study;
  study.file = file;
  study.postures = count_postures(root);
  if (const auto gravity = root.find("gravity")) study.gravity = read_gravity(*gravity);
  read_parameters(root, robot, files, &study);
  declare_coefficients(root, &study);
  declare_gains(root, &study);
  constexpr std::size_t kMostTuned = 10000;
  if (study.tuned.size() > kMostTuned) {
    const YamlValue at = root.find("parameters").value_or(root);
    at.fail("too many parameters to tune: " + std::to_string(study.tuned.size()),
            "at most " + std::to_string(kMostTuned));
  }
  read_constraints(root, robot, loader, &study);
  const ParameterTable table(study.parameters);
  if (study.postures > 0)
    study.duration = study.postures - 1.0;
  else
    read_duration(root, table, &study);
  read_initial_state(root, robot, table, &study);
  read_positions(root, robot, table, &study);
  read_controllers(root, robot, table, loader, &study);
  read_hardware(root, table, &study);
  read_motion(root, robot, table, loader, &study);
  read_loads(root, robot, table, loader, &study);
  read_until(root, robot, table, &study);
  read_objective(root, robot, table, loader, &study);
  read_watched(root, robot, table, loader, &study);
  study.excursions = find_excursions(study);
  study.used_parameters = robot.used_parameters;
  study.used_parameters.insert(table.used.begin(), table.used.end());
  study.switches = robot.switches;
  study.switches.insert(study.switches.end(), table.switches.begin(), table.switches.end());
  add_switches_at_instants(table, &study);
  if (const auto limits = root.find("limits")) study.limits = read_limit_options(*limits);
  if (const auto solver = root.find("solver")) study.solver = read_solver_options(*solver);
  // Step control tests the errors of motions; the effort of a given motion may change within a step
  // that these allow.
  constexpr double kFewestSteps = 500.0;
  if (!study.motion.empty() && study.postures == 0 && study.solver.maximum_step == 0.0)
    study.solver.maximum_step = study.duration / kFewestSteps;
  if (const auto optimizer = root.find("optimizer"))
    study.optimizer = read_optimizer_options(*optimizer);
  refuse_adjoint(root, study);
  check_moving_end(study);
  refuse_integrator_of_postures(root, study);
  return study;
}

bool says_floating(const YamlValue& root) {
  const auto base = root.is_map() ? root.find("base") : std::nullopt;
  return base && base->choice("base", {"fixed", "floating"}) == "floating";
}

}  // namespace

// To parse a study a second time takes as long as a short simulation, so that a text in which the
// word cannot be is not parsed for it; it could be spelled with escapes.
bool has_floating_base(const SourceText& yaml) {
  const auto has = [&yaml](const char* word) { return yaml.text.find(word) != std::string::npos; };
  return (has("floating") || has("\\")) && says_floating(YamlValue::parse(yaml));
}

Study read_study(const SourceText& yaml, const RobotDescription& robot,
                 const TrajectoryLoader& loader, const FileLoader& files) {
  const YamlValue root = YamlValue::parse(yaml);
  root.require_keys(
      {}, {"duration",   "until",      "gravity",   "initial_state", "controllers", "loads",
           "motion",     "parameters", "objective", "path",          "final",       "constraints",
           "limits",     "solver",     "optimizer", "runs",          "uncertain",   "robust",
           "multistart", "engine",     "identify",  "excite",        "hardware",    "positions",
           "hold",       "efforts",    "base",      "tradeoff"});
  require_purpose_of_excite(root);
  refuse_motion_of_excitation(root);
  const TrajectoryLoader trajectories = trajectories_of(loader, files);
  const auto read_run = [&](const YamlValue& study_value) {
    return read_single_run(study_value, yaml.name, robot, trajectories, files);
  };
  Study study = read_run(root);
  study.base_is_given = root.find("base").has_value();
  says_floating(root);  // refuses another word
  study.ensemble = read_ensemble(root, robot, read_run, files, study);
  if (!study.choices.empty())
    for (const char* key : {"multistart", "identify", "tradeoff"})
      if (const auto block = root.find(key))
        block->fail("parameters that are chosen from a list have a search of their own",
                    std::string("either ") + key + " or choice and integer");
  if (root.find("tradeoff")) {
    study.tradeoff = read_tradeoff(root, robot, read_run, files, study);
    for (const TradeoffObjective& one : study.tradeoff)
      study.used_parameters.insert(one.study->used_parameters.begin(),
                                   one.study->used_parameters.end());
  }
  if (const auto identify = root.find("identify"))
    study.identification = read_identification(*identify, robot, study);
  if (const auto efforts = root.find("efforts")) study.grid = read_posture_grid(*efforts, robot);
  if (const auto excite = root.find("excite")) study.excitation = read_excitation(*excite, robot);
  return study;
}

}  // namespace codesign
