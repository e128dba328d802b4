// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "jobs/files.h"
#include "problem/load_problem.h"

namespace codesign {

/// The texts and settings of a job, from a command line or a node.
struct Inputs {
  SourceText urdf;
  std::vector<SourceText> overlays;
  SourceText study;            ///< an empty name: no study, the mechanism alone
  bool study_is_tree = false;  ///< whether the study is from the parameter server instead of a file
  SavedDesign design;          ///< of a saved result, as read_design() reads it
  ParameterSettings settings;  ///< they replace the values of `design`
};

/// Reads and compiles the inputs. @param loader reads trajectories that the study names in a bag;
/// without one they are refused.
/// @throws InputError as load_problem().
Problem load(const Inputs& inputs, const TrajectoryLoader& loader = {});

/// The paths of all files from which a problem was made: model, overlays, study, and the files,
/// trajectories and recordings that the study names.
std::vector<std::string> input_files(const Problem& problem);

/// Checks that no result replaces an input file. @param names of the files to be written into the
/// folder. @param option the option or argument with the folder. @throws InputError
void require_other_files(const std::string& folder, const std::vector<std::string>& names,
                         const std::string& option, const Problem& problem);

/// Another process, or another job of this one, works on the files of a job.
class JobIsRunning : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reserves the file names of one job in a folder that is shared by jobs of several processes. The
/// stem is `<robot>_%Y-%m-%d-%H-%M-%S` in local time, followed by `-2`, `-3`, ... if that stem is
/// taken; the files are `<stem>.bag`, `<stem>.best.json`, `<stem>.journal.jsonl`. The lock file
/// `<stem>.job` shows that the job is running.
class JobFiles {
 public:
  /// Creates the folder and reserves a stem. Characters of the robot's name other than letters,
  /// digits and `-` become `_`, and a long name is shortened to the limit of the file system.
  /// @throws OutputError if the folder or the lock file cannot be created.
  JobFiles(const std::string& directory, const std::string& robot);

  /// Takes over the files of a job that was killed or cancelled, and removes its unfinished files.
  /// @param name of the job, see name().
  /// @throws InputError naming `resume` if `name` is not a bare name or the folder has no journal
  /// with this name; JobIsRunning if the job is running.
  static JobFiles resume(const std::string& directory, const std::string& name);

  /// The stem without the folder.
  std::string name() const;
  const std::string& stem() const { return stem_; }
  /// The path of the bag, which does not exist yet: `<stem>.bag` or, if a resumed job already has a
  /// bag, `<stem>.resumed.bag`, ...
  const std::string& bag() const { return bag_; }
  /// The folder of files beside the bag, which the job creates: the path of the bag without `.bag`.
  std::string folder() const { return bag_.substr(0, bag_.size() - 4); }
  std::string journal() const { return stem_ + ".journal.jsonl"; }

 private:
  JobFiles(std::string stem, LockFile lock);
  static JobFiles reserve(const std::string& directory, const std::string& robot);

  std::string stem_, bag_;
  LockFile lock_;
};

/// Removes the unfinished files of killed jobs in a folder; files of running jobs, best points and
/// journals stay. @returns one sentence per killed job.
std::vector<std::string> remove_leftovers(const std::string& directory);

}  // namespace codesign
