// SPDX-License-Identifier: Apache-2.0
// `rung test`: all POUs marked {test}, interpreted or in one shared object, run on the bundled host. Tests with the
// same mocks are one module. With --separate each file is a separate project, so names of different files never
// clash; a few C++ units include the code of many. The JUnit file is written in every case: one that says that the run
// did not finish at the beginning, then one with the results or with what ended the run before them.
#include <algorithm>
#include <cstdio>
#include <map>

#include "ir/ir.h"
#include "rung/host.h"
#include "sema/project.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/coverage.h"
#include "tools/driver/list.h"
#include "tools/driver/module_library.h"
#include "tools/driver/native.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

// Modules in one C++ unit: a compromise between the starts of g++ and the cost of one changed file.
constexpr size_t kModulesPerUnit = 16;

struct Module {
  std::string name, shown, below;
  bool ok = false;
  std::string messages;
  std::map<std::string, std::string> skipped;
  host::ShownPaths paths;
  std::unique_ptr<ir::interpreter::Program> program;  // none: compiled C++
};

constexpr uint8_t kMemoryChecks = ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast;

// A power of two, so that an added file seldom moves the others to other units.
uint32_t batchCount(size_t modules) {
  uint32_t count = 1;
  while (count * kModulesPerUnit < modules) count *= 2;
  return count;
}

using MockSets = std::vector<std::vector<std::string>>;

// The names in reports of a POU marked {test}: itself, or each of its cases.
std::vector<std::string> testNames(const sema::Project& project, const sema::Pou& pou) {
  std::vector<std::string> names;
  for (const sema::TestCase& one : pou.pragmas.cases) names.emplace_back(project.names.string(one.name));
  if (names.empty()) names.emplace_back(project.names.string(pou.unique_name));
  return names;
}

// The sets of mocks that the chosen tests name; the empty set comes first, with or without such tests.
MockSets mockSets(const sema::Project& project, const host::TestOptions& options) {
  MockSets sets{{}};
  for (const sema::Pou& pou : project.pous) {
    if (!pou.pragmas.test || pou.pragmas.mocks.empty()) continue;
    const std::vector<std::string> names = testNames(project, pou);
    if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return isChosen(options, name); }))
      continue;
    std::vector<std::string> set;
    for (NameId mock : pou.pragmas.mocks) set.emplace_back(project.names.string(mock));
    if (std::find(sets.begin(), sets.end(), set) == sets.end()) sets.push_back(std::move(set));
  }
  return sets;
}

std::string headingOf(const std::vector<std::string>& mocks) {
  std::string text;
  for (const std::string& mock : mocks) text += (text.empty() ? "rung: in the tests with `" : ", `") + mock + '`';
  return text.empty() ? text : text + ":\n";
}

// Passes all on, and keeps the messages for the JUnit file.
class Recorder : public Sink {
 public:
  explicit Recorder(Sink& sink) : sink_(sink) {}
  void message(std::string_view text) override {
    text_ += text;
    sink_.message(text);
  }
  std::string output(std::string_view text) override { return sink_.output(text); }
  void diagnostics(const Diagnostics& all, const Sources& sources, const RenderOptions& options) override {
    RenderOptions plain = options;
    plain.format = DiagnosticFormat::Text;
    plain.color = false;
    text_ += render(all, sources, plain);
    sink_.diagnostics(all, sources, options);
  }
  void error(std::string_view what) override {
    text_ += "error: " + std::string(what) + '\n';
    sink_.error(what);
  }
  void internalError(std::string_view what) override {
    text_ += "internal error: " + std::string(what) + '\n';
    sink_.internalError(what);
  }
  void progress(const char* label, size_t done, size_t all) override { sink_.progress(label, done, all); }
  void programRuns(bool runs, bool checked) override { sink_.programRuns(runs, checked); }
  std::FILE* programOutput() override { return sink_.programOutput(); }
  std::FILE* programErrors() override { return sink_.programErrors(); }

  const std::string& text() const { return text_; }

 private:
  Sink& sink_;
  std::string text_;
};

class Tester {
 public:
  Tester(const ProjectOptions& project, const TestOptions& options, Sink& sink)
      : project_(project), options_(options), sink_(sink) {
    test_options_.filters = options.filters;
    test_options_.timeout_ns = options.timeout_ns;
    test_options_.max_steps = options.max_steps;
    test_options_.junit_path = options.junit;
    host::RunOptions shown;
    std::vector<std::string> others;
    host::parseRunOptions(options.run.host_arguments, shown,
                          others);  // without mistakes: they are --watch, --trace, --plot
    test_options_.watch = shown.watch;
    test_options_.trace_path = shown.trace_path;
    test_options_.plot_path = shown.plot_path;
    test_options_.out = sink.programOutput();
    test_options_.err = sink.programErrors();
  }

  int run() {
    if (options_.junit != "-")  // there, nothing would replace it
      if (const std::string error = writeOutcome("did not finish", "the run did not finish"); !error.empty())
        return usageError(sink_, error);
    int exit = options_.separate ? compileSeparately() : compileProject(project_, nullptr);
    if (exit == kSuccess) exit = buildAndRun();
    if (!reported_) {
      const std::string error = writeOutcome(exit == kInputErrors ? "compile" : "run", sink_.text());
      if (!error.empty()) exit = usageError(sink_, error);
    }
    times_.end();
    if (project_.time_phases) sink_.message(times_.table());
    return exit;
  }

 private:
  // A JUnit file with one error.
  std::string writeOutcome(const char* what, const std::string& messages) {
    if (options_.junit.empty()) return {};
    host::TestResults results;
    const std::string& path = project_.inputs.front();
    results.tests.push_back({what, path, 1, host::TestResult::Broken, 0, 0, messages, path});
    return host::writeJunit(results, options_.junit, sink_.programOutput());
  }

  // Compiles the modules of one project: the tests without mocks, then each set of mocks. `file`: the only file of a
  // project whose errors count as a failed test.
  int compileProject(const ProjectOptions& options, const InputFile* file) {
    MockSets sets{{}};
    std::string name;
    for (size_t i = 0; i < sets.size(); i++) {
      ProjectOptions one = options;
      one.code.mocks = sets[i];
      if (i > 0) one.name = name + "_mocks_" + std::to_string(i);
      if (options_.counts()) {  // counts each statement as written
        one.code.level = 0;
        one.code.level_given = true;
      }
      auto owned = std::make_unique<Compilation>(one, times_, sink_);
      Compilation& compilation = *owned;
      Module module;
      NativePart part;
      module.ok = makeModule(compilation, module, part);
      module.name = compilation.options.moduleName();
      if (i == 0) {
        name = module.name;
        checked_ = (compilation.options.code.checks & kMemoryChecks) == kMemoryChecks;
        if (module.ok) sets = mockSets(*compilation.project, test_options_);
      }
      if (file != nullptr && compilation.exitCode() != kInternal) {
        module.shown = file->shown;
        module.below = file->below;
        if (i == 0 || compilation.exitCode() != kSuccess)
          module.messages = headingOf(sets[i]) + compilation.diagnosticsText();
        module.ok = module.ok && compilation.exitCode() == kSuccess;
      } else if (i == 0 || !module.ok) {
        sink_.message(headingOf(sets[i]));
        const int exit = compilation.finish();
        if (exit != kSuccess || !module.ok) return exit;
      }
      if (!why_.empty()) return usageError(sink_, why_);
      for (const InputFile& input : compilation.inputs.files) {
        coverage_.nameFile(input.below, input.shown);
        module.paths[input.below] = input.shown;
      }
      if (module.ok) noteSkipped(*compilation.project, module);
      if (module.ok && i == 0 && sets.size() > 1 && compilation.module->tests.empty()) continue;
      if (file != nullptr || i > 0) part.folder = module.name;
      if (module.ok && !module.program) request_.parts.push_back(std::move(part));
      modules_.push_back(std::move(module));
      if (compilation.hasUserCpp()) with_cpp_.push_back(std::move(owned));
    }
    return kSuccess;
  }

  static void noteSkipped(const sema::Project& project, Module& module) {
    for (const sema::Pou& pou : project.pous)
      if (pou.pragmas.test && pou.pragmas.skip)
        for (const std::string& name : testNames(project, pou))
          module.skipped[name] = project.names.string(pou.pragmas.skip);
  }

  // Interpreted when possible, else as C++ files.
  bool makeModule(Compilation& compilation, Module& module, NativePart& part) {
    std::string why;
    const bool compiled =
        options_.run.mayInterpret() ? compilation.translate(module.program, why) : compilation.lower();
    if (!compiled) return false;
    if (module.program) return true;
    const bool must = options_.run.engine == Engine::Interpreter || options_.counts();
    if (!why.empty() && must) why_ = "this program cannot be interpreted: " + why;
    if (!why.empty() && why_.empty()) sink_.message("rung: this program runs as compiled C++: " + why + "\n");
    return compilation.checkNatives() && compilation.emit(part.files);
  }

  int compileSeparately() {
    // The files are found once, as one project; their sources are read again for each.
    Compilation all(project_, times_, sink_);
    if (!all.read()) return all.finish();
    std::string root = project_.root.empty() ? all.inputs.root : project_.root;
    for (size_t i = 0; i < all.inputs.files.size(); i++) {
      const InputFile& file = all.inputs.files[i];
      ProjectOptions one = project_;
      one.inputs = {file.path};
      one.root = root;
      one.code.is_bundled = true;
      one.name = all.options.moduleName() + "_" + std::to_string(i);
      const int exit = compileProject(one, &file);
      if (exit != kSuccess) return exit;
    }
    request_.batches = batchCount(request_.parts.size());
    return kSuccess;
  }

  int buildAndRun() {
    Cache cache;
    ModuleLibrary library;
    if (!request_.parts.empty()) {
      times_.begin("c++");
      request_.has_call_paths = true;
      request_.level = project_.code.level;
      request_.jobs = options_.run.native.jobs;
      request_.keep = options_.run.native.keep;
      NativeResult result = makeShared(cache, request_, sink_);
      if (result.exit == kInternal) sink_.internalError(result.message);
      if (result.exit == kUsage) usageError(sink_, result.message);
      if (result.exit == kInputErrors) refuse(result);
      if (result.exit != kSuccess) return result.exit;
      std::string error = library.open(result.path);
      if (!error.empty()) {
        sink_.internalError(error);
        return kInternal;
      }
    }
    times_.begin("run");
    host::TestResults results;
    if (options_.run.engine == Engine::Auto && !options_.counts() && request_.parts.empty())
      test_options_.hint_when_long = "rung: long tests are faster with --engine=native";
    for (const Module& module : modules_) {
      const int exit = runModule(module, library, results);
      if (exit != kSuccess) return exit;
      if (module.program) coverage_.add(*module.program);
    }
    if (results.count() == 0 && !results.interrupted && !options_.allow_none) return usageError(sink_, noTest());
    if (options_.coverage)
      if (const std::string error = sink_.output(coverage_.text()); !error.empty()) return usageError(sink_, error);
    const int exit = host::reportTests(results, test_options_);
    reported_ = true;
    if (crashed_in_generated_code_) {
      sink_.internalError(results.crash + " in generated code");
      return kInternal;
    }
    const std::string error = options_.lcov.empty() ? "" : writeFile(options_.lcov, coverage_.lcov());
    return error.empty() ? exit : usageError(sink_, error);
  }

  std::string noTest() const {
    if (options_.filters.empty()) return "no test found; write {test} before a POU, or accept this with `--allow-none`";
    std::string globs;
    for (const std::string& glob : options_.filters) globs += (globs.empty() ? "" : " or ") + backquoted(glob);
    std::vector<std::string_view> names(tests_.begin(), tests_.end());
    return withSuggestion("no test matches " + globs, options_.filters.front(), names);
  }

  // Prints the messages of g++ about a body, with the source of its file; the other messages were printed before.
  void refuse(const NativeResult& result) {
    for (const std::unique_ptr<Compilation>& compilation : with_cpp_)
      if (compilation->printRefusals(result)) return;
    sink_.message(result.message + "\n");
  }

  int runModule(const Module& module, const ModuleLibrary& library, host::TestResults& results) {
    if (!module.messages.empty()) sink_.message(module.messages);
    if (!module.ok) {
      if (const std::string error = sink_.output("FAIL " + module.shown + ": does not compile\n"); !error.empty())
        return usageError(sink_, error);
      results.failed++;
      results.tests.push_back(
          {"compile", module.below, 1, host::TestResult::Broken, 0, 0, module.messages, module.shown});
      return kSuccess;  // the other files count; the exit code reports a failed test
    }
    std::string error;
    const rung_module* description = module.program ? &module.program->description() : library.find(module.name, error);
    if (description == nullptr) {
      sink_.internalError(error);
      return kInternal;
    }
    const uint32_t passed = results.passed, failed = results.failed;
    for (uint32_t i = 0; i < description->tests.count; ++i)
      tests_.emplace_back(description->strings + rung_test_at(description, i)->name);
    test_options_.skipped = module.skipped;
    test_options_.paths = module.paths;
    if (module.program && options_.counts()) {
      test_options_.collect = [&] { return module.program->counts(); };
      test_options_.merge = [&](std::string_view counts) { module.program->addCounts(counts); };
    }
    sink_.programRuns(true, checked_);
    error = host::runTests(*description, test_options_, results);
    sink_.programRuns(false, false);
    if (!results.crash.empty() && checked_ && !results.crash.starts_with("SIGKILL") && with_cpp_.empty())
      crashed_in_generated_code_ = true;
    if (!error.empty()) return usageError(sink_, error);
    if (options_.separate)
      return printResult(sink_, std::string(results.failed == failed ? "ok  " : "FAIL") + " " + module.shown + ": " +
                                    std::to_string(results.passed - passed) + " passed, " +
                                    std::to_string(results.failed - failed) + " failed\n");
    return kSuccess;
  }

  const ProjectOptions& project_;
  const TestOptions& options_;
  Recorder sink_;
  host::TestOptions test_options_;
  PhaseTimes times_;
  NativeRequest request_;
  std::vector<Module> modules_;
  std::vector<std::unique_ptr<Compilation>> with_cpp_;  // those with bodies in C++
  Coverage coverage_;
  std::vector<std::string> tests_;  // all that were found
  bool checked_ = true;
  bool reported_ = false, crashed_in_generated_code_ = false;
  std::string why_;  // a usage error
};

}  // namespace

int runTest(const ProjectOptions& project, const TestOptions& options, Sink& sink) {
  if (options.list && options.separate) return usageError(sink, "`--list` and `--separate` cannot be combined");
  if (options.list) return listTests(project, options, sink);
  ProjectOptions testing = project;
  testing.written = options.junit;
  testing.code.with_tests = testing.code.counts_steps = true;
  testing.code.counts_statements = options.counts();
  return Tester(testing, options, sink).run();
}

}  // namespace rung::driver
