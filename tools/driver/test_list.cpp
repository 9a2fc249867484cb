// SPDX-License-Identifier: Apache-2.0
// `rung test --list`: the tests of a project with their places, for editors. In: a checked project. Out: a line or an
// object for each test and each of its cases, in the order of the sources; also of a project with errors. Nothing runs.
#include "rung/host.h"
#include "sema/project.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/list.h"

namespace rung::driver {
namespace {

class TestList {
 public:
  TestList(const Compilation& compilation, const TestOptions& options)
      : compilation_(compilation), list_(compilation.options.report) {
    chosen_.filters = options.filters;
  }

  void add(const sema::Pou& pou) {
    if (pou.pragmas.cases.empty()) addTest(pou, pou.unique_name, pou.loc);
    for (const sema::TestCase& one : pou.pragmas.cases) addTest(pou, one.name, one.loc);
  }
  std::string text() const { return list_.text(); }

 private:
  std::string string(NameId name) const { return std::string(compilation_.names.string(name)); }

  // `at`: its name, or the {case}.
  void addTest(const sema::Pou& pou, NameId unique_name, Loc at) {
    const std::string name = string(unique_name);
    if (!host::isChosen(chosen_, name)) return;
    const Sources& sources = compilation_.sources;
    const SourceLocation place = sources.location(at);
    const std::string file(sources.displayPath(place.file)), why = string(pou.pragmas.skip);
    JsonRow row;
    row.text("name", name).text("pou", string(pou.unique_name)).text("file", file);
    row.number("line", place.line).number("column", place.column);
    if (pou.pragmas.skip) row.text("skip", why);
    list_.add(name + "  " + file + ":" + std::to_string(place.line) + (pou.pragmas.skip ? "  skip: " + why : "") + "\n",
              row);
  }

  const Compilation& compilation_;
  host::TestOptions chosen_;
  List list_;
};

}  // namespace

int listTests(const ProjectOptions& project, const TestOptions& options, Sink& sink) {
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  compilation.check();
  const int exit = compilation.finish();
  if (!compilation.project) return exit;
  TestList list(compilation, options);
  for (const sema::Pou& pou : compilation.project->pous)
    if (pou.pragmas.test) list.add(pou);
  const int printed = printResult(sink, list.text());
  return exit == kSuccess ? printed : exit;
}

}  // namespace rung::driver
