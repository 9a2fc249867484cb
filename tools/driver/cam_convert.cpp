// SPDX-License-Identifier: Apache-2.0
// `rung cam convert`: a cam as a `.cam` file, as CSV, as declarations in ST, or as a PLCopen project with these. CSV
// has the lines of a `.cam` file with commas between the words, so nothing is lost, and tables of spreadsheets become
// cams. A program that declares a cam with its initial values is read like any program (sema/bodies/constant_cams.h).
#include <algorithm>
#include <filesystem>
#include <optional>

#include "cam/design/st_form.h"
#include "cam/design/text_form.h"
#include "frontend/export/plcopen.h"
#include "frontend/import/formats.h"
#include "sema/check.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

std::string commaSeparated(std::string text) {
  std::replace(text.begin(), text.end(), ' ', ',');
  return text;
}

// The declarations of the cam as TC6 XML, in the form in which CODESYS exports a list of global variables.
std::optional<std::string> plcopenOf(const cam::Cam& cam, Sink& sink) {
  ProjectOptions options;
  options.inputs = {cam.name + ".st"};
  options.unsaved = {{cam.name + ".st", globalsOf(cam)}};
  PhaseTimes times;
  Compilation compilation(options, times, sink);
  std::string xml;
  compilation.parsed = [&] {
    xml = exporter::writeProject({compilation.tree, compilation.names, compilation.sources, compilation.tree.files},
                                 cam.name, compilation.diagnostics);
  };
  compilation.check();
  if (compilation.finish() != kSuccess) return {};
  return xml;
}

// The `.cam` text of the cam that a program declares: of the one with the name, or of the only one.
int textOfProgram(const CamRun& run, Sink& sink, std::string& text) {
  ProjectOptions options;
  options.inputs = {run.inputs[0]};
  PhaseTimes times;
  Compilation compilation(options, times, sink);
  const bool is_checked = compilation.check();
  if (const int exit = compilation.finish(); exit != kSuccess) return exit;
  std::vector<sema::ConstantCam> cams;
  if (is_checked) cams = sema::constantCams(*compilation.project);
  const auto& given = run.options.given;
  const bool has_name = std::find(given.begin(), given.end(), "--name") != given.end();
  std::string names;
  const sema::ConstantCam* chosen = nullptr;
  for (const sema::ConstantCam& cam : cams) {
    names += (names.empty() ? "" : ", ") + backquoted(cam.cam.name);
    if (!has_name || sameIdentifier(cam.cam.name, run.options.name)) chosen = &cam;
  }
  if (chosen == nullptr && (cams.empty() || !has_name))
    return usageError(
        sink, backquoted(run.inputs[0]) + " declares no cam whose points are initial values that no program changes");
  if (chosen == nullptr)
    return usageError(sink,
                      backquoted(run.inputs[0]) + " has no cam " + backquoted(run.options.name) + "; it has " + names);
  if (!has_name && cams.size() > 1)
    return usageError(sink, backquoted(run.inputs[0]) + " has several cams; choose one with `--name`: " + names);
  text = withDesign(chosen->cam, chosen->design);
  return kSuccess;
}

bool isTable(const std::string& path) {
  return importer::hasExtension(path, ".cam") || importer::hasExtension(path, ".csv");
}

}  // namespace

int runCamConvert(const CamRun& run, Sink& sink) {
  const auto is = [&](const char* extension) { return importer::hasExtension(run.output, extension); };
  const bool is_cam = is(".cam"), is_csv = is(".csv"), is_st = is(".st"), is_xml = is(".xml");
  if (run.inputs.size() != 1) return usageError(sink, "`rung cam convert` takes one file");
  if (!is_cam && !is_csv && !is_st && !is_xml)
    return usageError(sink, "`rung cam convert` needs a file to write: add `-o FILE.cam`, `.csv`, `.st` or `.xml`");
  CamInput input;
  if (isTable(run.inputs[0])) {
    if (!run.options.given.empty()) return usageError(sink, "`--name` chooses a cam of a program");
    readCamInput(run.inputs[0], input);
  } else {
    std::string text;
    if (const int exit = textOfProgram(run, sink, text); exit != kSuccess) return exit;
    readCamText(run.inputs[0], std::move(text), input);
  }
  if (!input.is_read) return finishCamInput(input, sink);
  const std::string text = textOf(input.cam);
  std::optional<std::string> xml;
  if (is_xml && !(xml = plcopenOf(input.cam, sink))) return kInternal;
  const std::string error = writeFile(run.output, is_xml   ? *xml
                                                  : is_cam ? text
                                                  : is_csv ? commaSeparated(text)
                                                           : globalsOf(input.cam));
  return error.empty() ? kSuccess : usageError(sink, error);
}

}  // namespace rung::driver
