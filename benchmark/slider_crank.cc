// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/slider_crank.h"

#include <stdexcept>

#include "description/solver_options.h"
#include "description/study.h"
#include "mechanism_codesign/error.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr const char* kUrdf = "urdf/slider_crank_haug.urdf";
constexpr const char* kStudy = "config/slider_crank_haug.yaml";

/// `text` with what stands from `first` to the end of `last` replaced.
std::string replaced(std::string text, const std::string& first, const std::string& last,
                     const std::string& replacement) {
  const std::size_t begin = text.find(first),
                    end = begin == std::string::npos ? begin : text.find(last, begin);
  if (end == std::string::npos)
    throw std::runtime_error("the shipped case has changed: no '" + first + "' in it");
  return text.replace(begin, end + last.size() - begin, replacement);
}

constexpr const char* kMasses =
    R"(<robot name="slider_crank_haug" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="crank_mass" value="0.12" lower="0.1" upper="0.2"/>
  <codesign:parameter name="rod_mass" value="0.5" lower="0.4" upper="0.6"/>
  <codesign:parameter name="slider_mass" value="2" lower="1" upper="3"/>
  <link name="crank"><inertial><mass value="0.12" codesign:value="${crank_mass}"/></inertial></link>
  <link name="rod"><inertial><mass value="0.5" codesign:value="${rod_mass}"/></inertial></link>
  <link name="slider"><inertial><mass value="2" codesign:value="${slider_mass}"/></inertial></link>
</robot>)";

RosenbrockMethod method_named(const std::string& name) {
  for (std::size_t k = 0; k < kRosenbrockMethodNames.size(); ++k)
    if (name == kRosenbrockMethodNames[k]) return static_cast<RosenbrockMethod>(k);
  throw std::invalid_argument(name);
}

}  // namespace

Problem load_slider_crank() { return load_problem(read_source(kUrdf), {}, read_source(kStudy)); }

std::optional<Problem> with_solver(const Problem& problem, const std::string& name,
                                   double relative_tolerance) {
  Study changed = study_of(problem);
  changed.solver.coordinates =
      CoordinatesKind::kAbsolute;  // the formulation of the paper and of the other codes
  changed.solver.integrator = name == "idas" ? IntegratorKind::kIdas : IntegratorKind::kRosenbrock;
  if (name != "idas") changed.solver.method = method_named(name == kControlled ? "rodas5p" : name);
  changed.solver.sensitivity_tolerance = name == kControlled ? relative_tolerance : 0.0;
  changed.solver.relative_tolerance = relative_tolerance;
  changed.solver.absolute_tolerance = 0.1 * relative_tolerance;
  try {
    return with_study(problem, std::move(changed));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

Problem with_tuned(const Problem& problem, int tuned) {
  const SourceText study{
      kStudy,
      replaced(read_source(kStudy).text, "  Kp: {", "}\n",
               "  crank_mass: {}\n  rod_mass: {}\n  slider_mass: {}\n  Kp: {initial: 1.0}\n")};
  const Problem more = load_problem(problem.urdf(), {{"masses", kMasses}}, study);
  Study changed = study_of(more);
  changed.solver = study_of(problem).solver;
  changed.tuned.resize(static_cast<std::size_t>(tuned));
  return with_study(more, std::move(changed));
}

Problem with_uncertain_masses(const Problem& problem, int samples, const std::string& engine) {
  const SourceText study{
      kStudy,
      read_source(kStudy).text +
          "uncertain: {rod_mass: {uniform: [0.4, 0.6]}, slider_mass: {uniform: [1.0, 3.0]}}\n" +
          "robust: {samples: " + std::to_string(samples) + "}\nengine: " + engine + "\n"};
  return load_problem(problem.urdf(), {{"masses", kMasses}}, study);
}

Problem with_dry_friction(const Problem& problem) {
  const std::string friction = "<dynamics friction=\"" + std::to_string(kDryFriction) + "\"/>";
  const SourceText urdf{kUrdf, replaced(problem.urdf().text, "<codesign:friction", "/>", friction)};
  return load_problem(urdf, {},
                      {kStudy, replaced(read_source(kStudy).text, "  slider_length: {",
                                        "  slider_width: {tune: true}\n", "")});
}

}  // namespace codesign
