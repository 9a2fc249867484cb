// `rung cam convert`: a cam as a `.cam` file, as CSV, or as declarations in ST. CSV has the lines of a `.cam` file with
// commas between the words, so nothing is lost, and tables of spreadsheets become cams.
#include <algorithm>

#include "cam/design/st_form.h"
#include "cam/design/text_form.h"
#include "frontend/import/formats.h"
#include "tools/driver/cam_commands.h"
#include "tools/driver/commands.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

std::string commaSeparated(std::string text) {
  std::replace(text.begin(), text.end(), ' ', ',');
  return text;
}

}  // namespace

int runCamConvert(const CamRun& run, Sink& sink) {
  const bool is_cam = importer::hasExtension(run.output, ".cam"), is_csv = importer::hasExtension(run.output, ".csv"),
             is_st = importer::hasExtension(run.output, ".st");
  if (run.inputs.size() != 1) return usageError(sink, "`rung cam convert` takes one `.cam` or CSV file");
  if (!is_cam && !is_csv && !is_st)
    return usageError(sink,
                      "`rung cam convert` needs a file to write: add `-o FILE.cam`, `-o FILE.csv` or `-o FILE.st`");
  CamInput input;
  readCamInput(run.inputs[0], input);
  if (!input.is_read) return finishCamInput(input, sink);
  const std::string text = textOf(input.cam);
  const std::string error = writeFile(run.output, is_cam ? text : is_csv ? commaSeparated(text) : globalsOf(input.cam));
  return error.empty() ? kSuccess : usageError(sink, error);
}

}  // namespace rung::driver
