// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "benchmark/report.h"
#include "benchmark/robot_peers.h"
#include "benchmark/work_precision.h"
#include "equations/compiled_system.h"
#include "math/cpu_timer.h"
#include "mechanism_codesign/simulation.h"
#include "text/number_text.h"

namespace codesign {
namespace {

const std::vector<double> kTolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
constexpr double kTight = 1e-11;
constexpr int kFreshRuns = 5;

struct Choice {
  const char *name, *solver;
};
constexpr Choice kOwn[] = {{"auto", "coordinates: joint, method: auto"},
                           {"rodas5p", "coordinates: joint, method: rodas5p"},
                           {"auto, absolute", "coordinates: absolute, method: auto"}};
constexpr std::size_t kPlain = 3, kSimbody = 4;  // places behind kOwn

void require(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.cause);
}

/// A simulation by this library, as a program that links it writes it.
class OwnRun {
 public:
  OwnRun(const Robot& robot, const std::string& solver, double tolerance)
      : OwnRun(robot.duration, robot_case(robot, text(solver, tolerance))) {}
  OwnRun(double duration, const GeneratedCase& files)
      : duration_(duration),
        problem_(load_problem(files.urdf, {}, files.study)),
        simulation_(problem_, problem_.parameters()) {}

  static std::string text(const std::string& solver, double tolerance) {
    return solver + ", relative_tolerance: " + to_decimal(tolerance) +
           ", absolute_tolerance: " + to_decimal(0.1 * tolerance) + ", maximum_steps: 10000000";
  }
  void take_first_step() {
    require(simulation_.start());
    require(simulation_.advance(1e-9));
  }
  RobotMotion run() {
    RobotMotion motion;
    Frame frame;
    require(simulation_.start());
    for (int k = 1; k <= kInstants; ++k) {
      const double t = duration_ * k / kInstants;
      require(simulation_.advance_to(t));
      simulation_.sample(t, &frame);
      for (const JointSample& joint : frame.joints) motion.positions.push_back(joint.position);
    }
    motion.steps = static_cast<long>(simulation_.statistics().steps);
    return motion;
  }

 private:
  double duration_;
  Problem problem_;
  Simulation simulation_;
};

double difference(const std::vector<double>& x, const std::vector<double>& y) {
  double largest = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) largest = std::max(largest, std::abs(x[k] - y.at(k)));
  return largest;
}

Contestant own(const Robot& robot, const Choice& choice, const std::vector<double>& reference) {
  return {choice.name, [=](double tolerance, bool) -> std::function<Outcome()> {
            const auto prepared = std::make_shared<OwnRun>(robot, choice.solver, tolerance);
            return [prepared, reference] {
              const RobotMotion motion = prepared->run();
              return Outcome{difference(motion.positions, reference), motion.steps};
            };
          }};
}

template <class Run>
Contestant peer(const char* name, const Robot& robot, const Run& run,
                const std::vector<double>& reference) {
  return {name, [=](double tolerance, bool) -> std::function<Outcome()> {
            return [=] {
              const RobotMotion motion = run(robot, tolerance);
              return Outcome{difference(motion.positions, reference), motion.steps};
            };
          }};
}

/// Least processor time of `kFreshRuns` calls [s]: what disturbs a call only adds to its time.
template <class Function>
double least_seconds(const Function& function) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kFreshRuns; ++k) {
    const CpuTimer timer;
    function();
    least = std::min(least, timer.seconds());
  }
  return least;
}

/// Goals of the design [ms], where it states any.
struct Goal {
  const char* robot;
  double whole, first_step, plain_ratio, simbody_ratio;
};
constexpr double kNone = 0.0;
constexpr Goal kGoals[] = {{"UR5", 3.0, 5.0, 1.0, 5.0},
                           {"Panda", kNone, kNone, kNone, 5.0},
                           {"Atlas", 30.0, 25.0, 1.5, 5.0},
                           {"Valkyrie", 18.0, 25.0, 1.5, 5.0},
                           {"Talos, dry friction", 15.0, 25.0, kNone, kNone}};

class Measurement {
 public:
  Measurement(const Robot& robot, const Goal& goal, Report* report)
      : robot_(robot), goal_(goal), report_(report) {
    reference_ = OwnRun(robot, kOwn[1].solver, kTight).run().positions;
    agreement_ = difference(run_plain(robot, kTight).positions, reference_);
    if (!(agreement_ < 0.1 * robot.error))
      throw std::runtime_error(robot.name + ": the two references differ");
    std::vector<Contestant> contestants;
    for (const Choice& choice : kOwn) contestants.push_back(own(robot, choice, reference_));
    contestants.push_back(peer("plain", robot, run_plain, reference_));
    if (run_simbody_robot(robot, 1e-3)) {
      const auto simbody = [](const Robot& r, double accuracy) {
        return *run_simbody_robot(r, accuracy);
      };
      contestants.push_back(peer("Simbody", robot, simbody, reference_));
    }
    for (const Sweep& sweep : run_sweeps(contestants, kTolerances, false))
      at_.push_back(interpolate(robot.error, sweep));
  }

  std::vector<std::string> row_of_runs() const {
    std::vector<std::string> row = {robot_.name, std::to_string(robot_.links.size()),
                                    one_digit(agreement_), one_digit(robot_.error)};
    for (std::size_t k = 0; k < kSimbody + 1; ++k) {
      row.push_back(three_digits(1e3 * seconds(k)));
      row.push_back(std::isnan(seconds(k))
                        ? "-"
                        : std::to_string(static_cast<long>(std::lround(at_[k].steps))));
    }
    row.push_back(three_digits(seconds(0) / seconds(kPlain)));
    row.push_back(three_digits(seconds(kSimbody) / seconds(0)));
    return row;
  }

  std::vector<std::string> row_of_texts() {
    const GeneratedCase files = robot_case(robot_, OwnRun::text(kOwn[0].solver, at_[0].tolerance));
    const double setup = least_seconds([&] { load_problem(files.urdf, {}, files.study); });
    const double first = least_seconds([&] { OwnRun(robot_.duration, files).take_first_step(); });
    const double whole = least_seconds([&] { OwnRun(robot_.duration, files).run(); });
    add_findings(first, whole);
    return {robot_.name, three_digits(1e3 * setup), three_digits(1e3 * first),
            three_digits(1e3 * seconds(0)), three_digits(1e3 * whole)};
  }

 private:
  double seconds(std::size_t k) const { return k < at_.size() ? at_[k].seconds : std::nan(""); }

  void add_findings(double first, double whole) {
    const auto add = [&](const std::string& what, const char* unit, double measured, double target,
                         bool at_least) {
      if (target != kNone && !std::isnan(measured))
        report_->findings.push_back({robot_.name + ": " + what, unit, measured, target, at_least});
    };
    add("from its text to the first step", "ms", 1e3 * first, goal_.first_step, false);
    add("from its text to the end of the motion", "ms", 1e3 * whole, goal_.whole, false);
    add("the motion, in times of the plain code", "", seconds(0) / seconds(kPlain),
        goal_.plain_ratio, false);
    add("the motion by Simbody, in times of ours", "", seconds(kSimbody) / seconds(0),
        goal_.simbody_ratio, true);
  }

  const Robot& robot_;
  const Goal& goal_;
  Report* report_;
  std::vector<double> reference_;
  double agreement_ = 0.0;
  std::vector<AtError> at_;
};

}  // namespace

void measure_robots(Report* report) {
  Table runs{"robots",
             "Motions of robots, all at the same error: processor time",
             {"robot", "joints", "references differ by", "error"},
             {}};
  for (const char* name : {"auto", "rodas5p", "auto, absolute", "plain", "Simbody"})
    for (const char* what : {": ms", ": steps"}) runs.columns.push_back(std::string(name) + what);
  runs.columns.insert(runs.columns.end(), {"auto / plain", "Simbody / auto"});
  Table texts{"robots_setup",
              "From the text of a robot to the end of its motion, by auto in joint coordinates: "
              "processor time",
              {"robot", "set-up, ms", "to the first step, ms", "the motion alone, ms",
               "to the end of the motion, ms"},
              {}};
  const std::vector<Robot> robots = all_robots();
  for (const Robot& robot : robots) {
    const auto* goal = std::find_if(std::begin(kGoals), std::end(kGoals),
                                    [&](const Goal& g) { return g.robot == robot.name; });
    if (goal == std::end(kGoals)) throw std::logic_error(robot.name);
    Measurement measurement(robot, *goal, report);
    runs.rows.push_back(measurement.row_of_runs());
    texts.rows.push_back(measurement.row_of_texts());
  }
  report->tables.push_back(runs);
  report->tables.push_back(texts);
}

}  // namespace codesign
