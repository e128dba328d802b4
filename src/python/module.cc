// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The extension `mechanism_codesign._core`: what the Python code of the package calls. It has
// numbers, names and records alone; names, documentation and types of the interface are in
// python/mechanism_codesign/.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "description/study.h"
#include "jobs/job_files.h"
#include "jobs/json_records.h"
#include "jobs/judged_fits.h"
#include "jobs/linear_records.h"
#include "jobs/optimization_records.h"
#include "jobs/saved_result.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "mechanism_codesign/version.h"
#include "optimization/result_report.h"
#include "problem/load_problem.h"
#include "python/callbacks.h"
#include "python/conversions.h"
#include "python/interruption.h"
#include "python/jobs.h"
#include "python/python_lock.h"
#include "python/recorded_arrays.h"
#include "python/session.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign::python {
namespace {

namespace py = pybind11;

std::unique_ptr<Session> open(const py::tuple& model, const py::object& study,
                              const py::list& overlays, const py::dict& settings,
                              const py::object& design) {
  Inputs inputs;
  inputs.urdf = to_source(model);
  for (const py::handle overlay : overlays)
    inputs.overlays.push_back(to_source(overlay.cast<py::tuple>()));
  if (!study.is_none()) inputs.study = to_source(study.cast<py::tuple>());
  if (!design.is_none()) inputs.design = read_design(to_source(design.cast<py::tuple>()));
  inputs.settings = to_settings(settings);
  const Unlocked unlocked;
  return std::make_unique<Session>(load(inputs));
}

/// A class whose objects only the library makes: one that Python makes by `__new__` would have
/// nothing inside.
template <class T>
py::class_<T> made_here(py::module_* module, const char* name) {
  py::class_<T> type(*module, name);
  const py::cpp_function refuse([name](const py::args&, const py::kwargs&) {
    throw py::type_error(std::string(name) + " is made by the library alone");
  });
  type.attr("__new__") = py::module_::import("builtins").attr("staticmethod")(refuse);
  return type;
}

/// [(name, value, lower, upper, unit, tuned)]
py::list parameters(const Session& session) {
  const Problem& problem = session.problem();
  std::vector<bool> tuned(problem.all_parameters().size(), false);
  for (const int index : study_of(problem).tuned) tuned[to_index(index)] = true;
  py::list list;
  for (std::size_t k = 0; k < tuned.size(); ++k) {
    const Parameter& parameter = problem.all_parameters()[k];
    list.append(py::make_tuple(parameter.name, parameter.value, parameter.lower, parameter.upper,
                               parameter.unit, bool{tuned[k]}));
  }
  return list;
}

py::list joints(const Session& session) {
  std::vector<std::string> names;
  for (const JointDescription& joint : robot_of(session.problem()).joints)
    if (joint.has_one_coordinate()) names.push_back(joint.name);
  return to_list(names);
}

/// @param rho also taken as a keyword, unless a parameter has this name.
std::vector<double> design_of(const Session& session, const py::object& rho,
                              const py::dict& settings) {
  constexpr const char* kRho = "rho";
  const std::vector<Parameter>& all = session.problem().all_parameters();
  const bool is_keyword =
      rho.is_none() && settings.contains(kRho) &&
      std::none_of(all.begin(), all.end(), [](const Parameter& each) { return each.name == kRho; });
  if (is_keyword) {
    py::dict others = settings.attr("copy")();
    const py::object given = others.attr("pop")(kRho);
    return design_of(session, given, others);
  }
  return session.design(rho.is_none() ? std::nullopt : std::optional(to_numbers(rho, kRho)),
                        to_settings(settings));
}

std::vector<std::string> names_of(const py::list& list, const std::string& what) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const py::handle item : list) names.push_back(to_name(item, what));
  return names;
}

/// (failure or None, objective, gradient, empty, [warning]); for kGaussNewton residuals and their
/// Jacobian in place of the third and fourth.
py::tuple evaluate(Session* session, const py::object& rho, const py::dict& settings,
                   int derivatives, bool by_adjoint) {
  if (by_adjoint) session = &session->adjoint();
  const std::vector<double> design = design_of(*session, rho, settings);
  const Evaluation evaluation = interruptible([&](const std::atomic<bool>* cancel) {
    return session->evaluate(design, static_cast<Derivatives>(derivatives), cancel);
  });
  const auto failure = evaluation.status.ok() ? py::none() : to_python(to_json(evaluation.status));
  const auto warnings =
      evaluation.warnings.empty() ? py::none() : to_python(to_json(evaluation.warnings));
  const Squares squares = derivatives == static_cast<int>(Derivatives::kGaussNewton)
                              ? squares_of(evaluation)
                              : Squares{evaluation.gradient, {}};
  return py::make_tuple(failure, evaluation.objective, to_array(squares.residuals),
                        to_array(squares.jacobian), warnings);
}

Json methods_json(const RunSummary& summary) {
  Json methods = Json::array();
  for (const MethodChange& change : summary.methods)
    methods.push_back({{"from", change.time}, {"method", change.method}});
  return methods;
}

/// What is told of a run besides its table, converted when it is asked for: most runs of a loop are
/// read for their numbers alone.
struct RunNotes {
  Problem problem;
  std::vector<double> design;
  RunSummary summary;

  py::object record() const {
    Json record = {{"objective", summary.objective ? Json(*summary.objective) : Json()},
                   {"parameters", parameters_json(problem, design)}};
    add_statistics(summary.statistics, &record);
    record["methods"] = methods_json(summary);
    add_events(summary.events, &record);
    record["limits_exceeded"] = to_json(summary.crossings);
    record["warnings"] = to_json(summary.warnings);
    return to_python(record);
  }
};

/// (failure or None, table of columns x instants, names of the columns, notes)
py::tuple simulate(const Session& session, const py::object& rho, const py::dict& settings,
                   const py::list& signals, int samples) {
  std::vector<double> design = design_of(session, rho, settings);
  const std::vector<std::string> asked = names_of(signals, "signals");
  RunTable run = interruptible(
      [&](const std::atomic<bool>* cancel) { return session.run(design, asked, samples, cancel); });
  const Status& status = run.summary.status;
  const py::object failure = status.ok() ? py::none() : to_python(to_json(status));
  return py::make_tuple(failure, keep_as_array(std::move(run.values), run.room, run.rows),
                        to_list(run.names),
                        RunNotes{session.problem(), std::move(design), std::move(run.summary)});
}

/// (failure or None, record of the linearization)
py::tuple linearize(const Session& session, const py::object& rho, const py::dict& settings,
                    const py::list& signals, const std::string& friction, const py::object& at) {
  const std::vector<double> design = design_of(session, rho, settings);
  const std::vector<std::string> outputs = names_of(signals, "signals");
  const std::optional<double> time =
      at.is_none() ? std::nullopt : std::optional(to_numbers(py::make_tuple(at), "at").front());
  const LinearModel model = interruptible([&](const std::atomic<bool>* cancel) {
    return session.linearize(design, outputs, friction, time, cancel);
  });
  if (!model.status.ok()) return py::make_tuple(to_python(to_json(model.status)), py::dict());
  Json record = Json::object();
  add_stability(model, &record);
  add_matrices(model.system, &record);
  record["measured"] = measured_json(study_of(session.problem()).controllers);
  record["loops"] = loops_json(model);
  return py::make_tuple(py::none(), to_python(record));
}

/// The summary of record_design(): ranges and units of signals, energies, poses of all links.
py::object details(const Session& session, const py::object& rho, const py::dict& settings) {
  const std::vector<double> design = design_of(session, rho, settings);
  return to_python(interruptible([&](const std::atomic<bool>* cancel) {
                     return record_design(session.problem(), design, cancel);
                   }).summary);
}

std::string urdf(const Session& session, const py::object& rho, const py::dict& settings) {
  const Problem& problem = session.problem();
  return write_tuned_urdf(problem.urdf(), problem.overlays(), design_of(session, rho, settings),
                          std::nullopt, robot_of(problem).laws);
}

/// (failure or None, outputs, lengths, times, computed, names, values, matrix, names of the base
/// parameters, their values, their columns)
py::tuple regressor_of(const Session& session, const py::list& data, const py::object& rho,
                       const py::dict& settings) {
  const RecordingArrays arrays = arrays_of(data, py::list());
  const std::vector<double> design = design_of(session, rho, settings);
  const Regressor found = interruptible([&](const std::atomic<bool>* cancel) {
    return regressor(session.problem(), arrays, design, cancel);
  });
  const auto failure = found.status.ok() ? py::none() : to_python(to_json(found.status));
  return py::make_tuple(failure, to_list(found.outputs),
                        py::cast(std::vector<double>(found.lengths.begin(), found.lengths.end())),
                        py::array_t<double>(found.times.size(), found.times.data()),
                        to_array(found.computed), to_list(found.names), to_array(found.values),
                        to_array(found.matrix), to_list(found.base_names),
                        to_array(found.base_values), py::cast(found.base_columns));
}

template <class Finished>
py::object record_of(const Finished& finished) {
  return to_python(Json::parse(finished.json));
}

/// @throws OutputError naming the files that are missing.
void require_written(const std::vector<Failure>& failures, const std::string& folder) {
  if (failures.empty()) return;
  std::string causes;
  for (const Failure& failure : failures) causes += (causes.empty() ? "" : "; ") + failure.message;
  throw OutputError(folder, causes);
}

void add_tradeoffs(py::module_* module) {
  made_here<Traded>(module, "Traded")
      .def_property_readonly("record", &record_of<Traded>)
      .def_property_readonly("status",
                             [](const Traded& of) { return to_python(to_json(of.result.status)); })
      .def_property_readonly(
          "warnings", [](const Traded& of) { return to_python(to_json(of.result.warnings)); })
      .def_property_readonly("text",
                             [](const Traded& of) { return tradeoff_text(of.problem, of.result); });
}

void add_jobs(py::module_* module) {
  made_here<Optimized>(module, "Optimized")
      .def_property_readonly("record", &record_of<Optimized>)
      .def_property_readonly(
          "status", [](const Optimized& of) { return to_python(to_json(of.result.status)); })
      .def_property_readonly(
          "warnings", [](const Optimized& of) { return to_python(to_json(of.result.warnings)); })
      .def_property_readonly("text",
                             [](const Optimized& of) { return report(of.problem, of.result); })
      .def_property_readonly("has_point",
                             [](const Optimized& of) { return has_design(of.problem, of.result); })
      .def_property_readonly("best_objectives",
                             [](const Optimized& of) {
                               Eigen::VectorXd best(to_signed(of.trials.size()));
                               for (std::size_t k = 0; k < of.trials.size(); ++k)
                                 best[to_signed(k)] = of.trials[k].best_objective;
                               return to_array(best);
                             })
      .def_property_readonly("rho",
                             [](const Optimized& of) { return to_array(of.result.best.rho); })
      .def_property_readonly("initial_rho",
                             [](const Optimized& of) { return to_array(of.result.initial.rho); })
      .def_property_readonly("gradient",
                             [](const Optimized& of) { return to_array(of.result.best.gradient); })
      .def("write", [](const Optimized& of, const std::string& folder) {
        require_written(interruptible([&](const std::atomic<bool>* cancel) {
                          return write_folder(of, folder, cancel);
                        }),
                        folder);
      });
  made_here<Identified>(module, "Identified")
      .def_property_readonly("record", &record_of<Identified>)
      .def_property_readonly(
          "status", [](const Identified& of) { return to_python(to_json(of.result.status)); })
      .def_property_readonly(
          "warnings", [](const Identified& of) { return to_python(to_json(of.result.warnings)); })
      .def_property_readonly("has_point",
                             [](const Identified& of) { return !of.result.outputs().empty(); })
      .def_property_readonly("covariance",
                             [](const Identified& of) { return to_array(of.result.covariance); })
      .def_property_readonly("time",
                             [](const Identified& of) {
                               const std::vector<double>& times = of.result.data_series.times;
                               return py::array_t<double>(times.size(), times.data());
                             })
      .def_property_readonly(
          "recorded", [](const Identified& of) { return to_array(of.result.data_series.recorded); })
      .def_property_readonly(
          "computed", [](const Identified& of) { return to_array(of.result.data_series.computed); })
      .def("against",
           [](const Identified& of, const std::string& name, const std::string& text) {
             return to_python(comparison_json({name, text}, {"this result", of.json}));
           })
      .def_readonly("json", &Identified::json)
      .def("write", [](const Identified& of, const std::string& folder) {
        require_written(write_folder(of, folder), folder);
      });
}

/// (duration [s], number of postures, whether a run may end before, number of runs, samples of
/// each, whether something is uncertain)
py::tuple extent(const Session& session) {
  const Study& study = study_of(session.problem());
  return py::make_tuple(study.duration, study.postures, has_moving_end(study),
                        std::max<std::size_t>(1, study.ensemble.runs.size()),
                        study.ensemble.robust_options().samples, !study.ensemble.uncertain.empty());
}

void add_session(py::module_* module) {
  made_here<RunNotes>(module, "RunNotes").def("record", &RunNotes::record);
  made_here<Session>(module, "Session")
      .def_property_readonly("parameters", &parameters)
      .def_property_readonly("joints", &joints)
      .def_property_readonly("names",
                             [](const Session& of) { return to_list(of.problem().tuned_names()); })
      .def_property_readonly("name", [](const Session& of) { return robot_of(of.problem()).name; })
      .def_property_readonly("duration", [](const Session& of) { return of.problem().duration(); })
      .def_property_readonly("extent", &extent)
      .def_property_readonly("start",
                             [](const Session& of) { return to_array(of.problem().start()); })
      .def_property_readonly(
          "warnings", [](const Session& of) { return to_python(to_json(of.problem().warnings())); })
      .def_property_readonly("signals",
                             [](const Session& of) {
                               return to_list(default_signals(robot_of(of.problem()),
                                                              study_of(of.problem()).controllers));
                             })
      .def("evaluate", &evaluate)
      .def("simulate", &simulate)
      .def("linearize", &linearize)
      .def("details", &details)
      .def("urdf", &urdf)
      .def("optimize",
           [](const Session& of, const py::object& progress, const py::object& cancel) {
             return job(progress, cancel, [&of](const Tell& tell, const std::atomic<bool>* stop) {
               return optimize(of.problem(), tell, stop);
             });
           })
      .def("tradeoff",
           [](const Session& of, int points, const py::object& progress, const py::object& cancel) {
             return job(progress, cancel, [&](const Tell& tell, const std::atomic<bool>* stop) {
               return tradeoff(of.problem(), points, tell, stop);
             });
           })
      .def("regressor", &regressor_of)
      .def("identify", [](const Session& of, const py::object& data, const py::list& holdout,
                          bool is_fitted, const py::object& progress, const py::object& cancel) {
        std::optional<RecordingArrays> arrays;
        if (!data.is_none()) arrays = arrays_of(data.cast<py::list>(), holdout);
        return job(progress, cancel, [&](const Tell& tell, const std::atomic<bool>* stop) {
          return identify(of.problem(), arrays, is_fitted, tell, stop);
        });
      });
  module->def("open", &open);
}

}  // namespace
}  // namespace codesign::python

PYBIND11_MODULE(_core, module) {
  codesign::python::translate_exceptions();
  module.def("version", &codesign::version);
  module.def("numbers", [](const pybind11::object& values, const std::string& name) {
    const std::vector<double> numbers = codesign::python::to_numbers(values, name);
    return pybind11::array_t<double>(numbers.size(), numbers.data());
  });
  // Before the sessions that return them, whose signatures name them.
  codesign::python::add_jobs(&module);
  codesign::python::add_tradeoffs(&module);
  codesign::python::add_session(&module);
}
