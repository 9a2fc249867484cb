// SPDX-License-Identifier: Apache-2.0
// `rung init`: a rung.project for the sources of a folder. Its dialect is the one in which they have the fewest errors,
// and its task runs what runs without it.
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "sema/project.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/new_project.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

// The folder's sources, checked; nothing is said about their errors.
std::unique_ptr<Compilation> checked(const ProjectOptions& options, Dialect dialect, PhaseTimes& times, Sink& sink) {
  ProjectOptions reading = options;
  reading.dialect = dialect;
  reading.dialect_given = true;
  auto compilation = std::make_unique<Compilation>(reading, times, sink);
  compilation->check();
  return compilation;
}

// The dialect that was asked for; else the first of those with the fewest errors.
std::unique_ptr<Compilation> inBestDialect(const ProjectOptions& options, PhaseTimes& times, Sink& sink) {
  if (options.dialect_given) return checked(options, options.dialect, times, sink);
  std::unique_ptr<Compilation> best;
  for (const Dialect dialect : {Dialect::Codesys, Dialect::Iec3, Dialect::Iec2}) {
    std::unique_ptr<Compilation> next = checked(options, dialect, times, sink);
    if (best && next->diagnostics.errorCount() >= best->diagnostics.errorCount()) continue;
    best = std::move(next);
    if (!best->diagnostics.hasErrors() || best->inputs.io_error) break;
  }
  return best;
}

// Programs that run although no file has a task.
std::vector<std::string> programsWithoutTask(const sema::Project& project) {
  std::vector<std::string> programs;
  const auto isDefault = [](const sema::Task& task) { return !task.configuration && !task.loc; };
  if (project.tasks.size() != 1 || !isDefault(project.tasks[0])) return programs;
  for (const sema::ProgramInstance& instance : project.instances)
    programs.emplace_back(project.names.string(instance.name));
  return programs;
}

bool hasTests(const sema::Project& project) {
  for (const sema::Pou& pou : project.pous)
    if (pou.pragmas.test && !pou.library) return true;
  return false;
}

bool hasDrawings(const Compilation& compilation) {
  for (const FileUnit& unit : compilation.tree.files)
    for (const DeclId id : compilation.tree.list(unit.decls))
      if (compilation.tree.kind(id) == DeclKind::Pou) {
        const BodyKind kind = compilation.tree.as<PouDecl>(id).body_kind;
        if (kind == BodyKind::Network || kind == BodyKind::Sfc) return true;
      }
  return false;
}

}  // namespace

int runInit(const ProjectOptions& options, Sink& sink) {
  const std::string folder = options.inputs.empty() ? "." : options.inputs[0];
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return usageError(sink, backquoted(folder) + " is not a folder; `rung new NAME` makes one");
  const std::string file = folder == "." ? "rung.project" : (fs::path(folder) / "rung.project").string();
  if (fs::symlink_status(file, error).type() != fs::file_type::not_found)
    return usageError(sink, backquoted(file) + " exists; it is the project of this folder");

  ProjectOptions reading = options;
  reading.inputs = {folder};
  PhaseTimes times;
  const std::unique_ptr<Compilation> compilation = inBestDialect(reading, times, sink);
  if (compilation->inputs.io_error || !compilation->project) return compilation->finish();

  const sema::Project& project = *compilation->project;
  const std::string name = fs::canonical(folder, error).filename().string();
  std::string text = "# " + name +
                     "; `rung help` lists the commands, which find this file in this folder and below.\n" +
                     "[project]\nname = " + moduleNameOf(name) + "\n";
  const std::string dialect = std::string(profileOf(compilation->options.dialect).name);
  if (compilation->options.dialect != kDefaultDialect) text += "std = " + dialect + "\n";
  const std::vector<std::string> programs = programsWithoutTask(project);
  if (!programs.empty()) {
    text +=
        "\n# The sources have no task. This one calls the programs every 10 ms.\n[task main]\ninterval = 10ms\n"
        "priority = 1\nprograms = ";
    for (size_t i = 0; i < programs.size(); ++i) text += (i == 0 ? "" : ", ") + programs[i];
    text += "\n";
  }
  if (const std::string problem = writeFile(file, text); !problem.empty()) return usageError(sink, problem);

  std::string out = "created " + file + " for " + std::to_string(compilation->inputs.files.size()) + " file" +
                    (compilation->inputs.files.size() == 1 ? "" : "s") + " (" + dialect + ")\n\ntry:\n";
  if (folder != ".") out += "  cd " + shellWord(folder) + "\n";
  out += "  rung check\n";
  if (!compilation->diagnostics.hasErrors()) {
    if (!project.instances.empty()) out += "  rung run --cycles 100 --plot plot.svg\n";
    if (hasTests(project)) out += "  rung test\n";
    if (hasDrawings(*compilation)) out += "  rung graph -o pictures\n";
  }
  return printResult(sink, out);
}

}  // namespace rung::driver
