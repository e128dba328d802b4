// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "jobs/files.h"
#include "text/nearest_name.h"

namespace codesign::cli {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr const char* kProjectFiles[] = {"model.urdf", "study.yaml"};

/// The names of the gallery's folders with a model and a study, sorted.
Names machines_of(const fs::path& gallery) {
  Names names;
  for (const fs::directory_entry& entry : fs::directory_iterator(gallery))
    if (std::all_of(std::begin(kProjectFiles), std::end(kProjectFiles),
                    [&](const char* file) { return fs::exists(entry.path() / file); }))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The heading of the machine's page.
std::string title_of(const fs::path& machine) {
  std::ifstream file(machine / "README.md");
  std::string line;
  std::getline(file, line);
  return line.rfind("# ", 0) == 0 ? line.substr(2) : "";
}

int list(const fs::path& gallery, const Arguments& arguments, const Console& console) {
  Json object;
  object["machines"] = Json::array();
  for (const std::string& name : machines_of(gallery)) {
    const std::string title = title_of(gallery / name);
    object["machines"].push_back({{"name", name}, {"title", title}});
    if (!arguments.json) console.out << name << "  " << title << '\n';
  }
  return finish(arguments, Status(), std::move(object), console);
}

/// The path as one word of a shell.
std::string shell_word(const fs::path& path) {
  std::string word = "'";
  bool is_plain = true;
  for (const char c : path.string()) {
    is_plain = is_plain && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
                            c == '-' || c == '.' || c == '/');
    word += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return is_plain ? path.string() : word + "'";
}

Names next_commands(const fs::path& folder) {
  const auto word = [&](const char* file) { return ' ' + shell_word(folder / file); };
  const std::string inputs = word(kProjectFiles[0]) + word(kProjectFiles[1]);
  return {"codesign simulate" + inputs + " --csv" + word("run.csv"),
          "codesign optimize" + inputs + " --output" + word("job"),
          "codesign report" + word("job") + " -o" + word("report.html")};
}

}  // namespace

int start_project(const Arguments& arguments, const std::string& gallery, const Console& console) {
  if (arguments.model.empty() && arguments.from.empty()) return list(gallery, arguments, console);
  const Names known = machines_of(gallery);
  if (arguments.model.empty())
    throw InputError({{},
                      "new",
                      "the name of the new folder is not given",
                      "",
                      "codesign new NAME --from MACHINE"});
  if (arguments.from.empty())
    throw InputError(
        {{}, "--from", "the machine to begin with is not given", "", list_names(known)});
  if (std::count(known.begin(), known.end(), arguments.from) == 0)
    throw unknown_name({}, "--from", "machine", arguments.from, known);
  const fs::path folder = arguments.model, machine = fs::path(gallery) / arguments.from;
  // A name that the system does not take, such as one of 300 bytes, is refused by make_folder().
  std::error_code unknown;
  if (fs::exists(fs::symlink_status(folder, unknown)))
    throw InputError({{arguments.model, 0},
                      "",
                      "this already exists, and codesign new does not overwrite anything",
                      arguments.model,
                      "the name of a folder that does not exist"});
  make_folder(arguments.model, "new");
  Json object;
  for (const char* file : kProjectFiles) {
    write_whole_file((folder / file).string(), read_source((machine / file).string()).text);
    object["files"].push_back((folder / file).string());
    if (!arguments.json) console.out << (folder / file).string() << '\n';
  }
  object["page"] = (machine / "README.md").string();
  object["commands"] = next_commands(folder);
  if (!arguments.json) {
    console.out << "its question and answer: " << (machine / "README.md").string() << "\nnext:\n";
    for (const std::string& command : next_commands(folder)) console.out << "  " << command << '\n';
  }
  return finish(arguments, Status(), std::move(object), console);
}

}  // namespace codesign::cli
