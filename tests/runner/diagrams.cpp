// SPDX-License-Identifier: Apache-2.0
// The timing diagrams of the library pages: docs/library/diagrams/LIBRARY/NAME.svg is what
// samples/library/LIBRARY/NAME.st draws, with the options in its `// run: ` or `// test: ` line. tests/update draws it
// again. Programs with `// output: ` lines show no behaviour in time; they are run with the page that has them.
#include <algorithm>
#include <filesystem>

#include "tests/runner/diff.h"
#include "tests/runner/support.h"

namespace rung::tests {
namespace {

constexpr char kPrograms[] = "samples/library", kPictures[] = "docs/library/diagrams";

std::string pictureOf(const std::string& file) {
  const std::string name = file.substr(sizeof kPrograms - 1);
  return kPictures + name.substr(0, name.size() - 2) + "svg";
}

Command commandFor(const Setting& setting, const std::string& file, const std::vector<std::string>& lines) {
  Command c;
  c.folder = freshFolder(setting);
  writeContent(c.folder + "/" + nameOf(file), readContent(setting.root + "/" + file));
  const std::string run = valueOf(lines, "run");
  c.arguments = {setting.rung, run.empty() ? "test" : "run", nameOf(file)};
  for (const std::string& word : splitWords(run.empty() ? valueOf(lines, "test") : run)) c.arguments.push_back(word);
  c.arguments.insert(c.arguments.end(), {"--engine=interp", "--plot", "picture.svg"});
  return c;
}

Result drawOne(const Setting& setting, const std::string& file) {
  Result result;
  const std::vector<std::string> lines = splitLines(readContent(setting.root + "/" + file));
  const Command draw = commandFor(setting, file, lines);
  const Output output = run(draw);
  const std::string drawn = readContent(draw.folder + "/picture.svg"), path = setting.root + "/" + pictureOf(file);
  if (output.exit_code != 0 || drawn.empty()) {
    result.fail(file, output.out.substr(0, 2000) + output.err.substr(0, 2000), commandLine(draw));
  } else if (drawn == readContent(path)) {
    result.pass();
  } else if (setting.update) {
    std::filesystem::create_directories(folderOf(path));
    writeContent(path, drawn);
    result.log += "updated " + pictureOf(file) + "\n";
    result.pass();
  } else {
    result.fail(pictureOf(file), diff(splitLines(readContent(path)), splitLines(drawn)), "tests/update " + file);
  }
  return result;
}

}  // namespace

void addDiagrams(const Setting& setting, std::vector<Job>& jobs) {
  for (const std::string& file : filesBelow(setting, kPrograms, ".st")) {
    const std::vector<std::string> lines = splitLines(readContent(setting.root + "/" + file));
    const std::string options = valueOf(lines, "run") + valueOf(lines, "test");
    if (options.find("--watch") == std::string::npos || !valuesOf(lines, "output").empty()) continue;
    jobs.push_back({file, 0, [&setting, file] { return drawOne(setting, file); }});
  }
}

}  // namespace rung::tests
