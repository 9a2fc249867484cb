// `rung test`: all POUs marked {test}, interpreted or in one shared object, run on the bundled host. With --separate
// each file is a project of its own, so that names of different files never clash; a few C++ units include the code of
// many.
#include <cstdio>

#include "ir/ir.h"
#include "rung/host.h"
#include "tools/rung/commands.h"
#include "tools/rung/compile.h"
#include "tools/rung/crash.h"
#include "tools/rung/module_library.h"
#include "tools/rung/native.h"

namespace rung::tool {
namespace {

// Modules in one C++ unit: enough that starting g++ costs little, few enough that one changed file costs little.
constexpr size_t kModulesPerUnit = 16;

struct Module {
  std::string name, shown, below;
  bool good = false;
  std::string messages;
  std::unique_ptr<ir::interpreter::Program> program;  // none: compiled C++
};

constexpr uint8_t kMemoryChecks = ir::kCheckDiv | ir::kCheckIndex | ir::kCheckNull | ir::kCheckCast;

// A power of two, so that one file more seldom moves the others to other units.
uint32_t batchCount(size_t modules) {
  uint32_t count = 1;
  while (count * kModulesPerUnit < modules) count *= 2;
  return count;
}

class Tester {
 public:
  explicit Tester(const Options& options) : options_(options) { test_options_.filter = options.filter; }

  int run() {
    int exit = options_.separate ? compileSeparately() : compileTogether();
    if (exit == kGood) exit = buildAndRun();
    times_.end();
    if (options_.time_phases) fputs(times_.table().c_str(), stderr);
    return exit;
  }

 private:
  int compileTogether() {
    Compilation compilation(options_, times_);
    Module module;
    NativePart part;
    module.good = makeModule(compilation, module, part);
    const int exit = compilation.finish();
    checked_ = (compilation.options.checks & kMemoryChecks) == kMemoryChecks;
    if (exit != kGood || !module.good) return exit;
    module.name = compilation.options.moduleName();
    if (!module.program) request_.parts.push_back(std::move(part));
    modules_.push_back(std::move(module));
    return why_.empty() ? exit : usageError(why_);
  }

  // Interpreted where it can be, else as C++ files.
  bool makeModule(Compilation& compilation, Module& module, NativePart& part) {
    std::string why;
    if (!compilation.translate(true, module.program, why)) return false;
    if (module.program) return true;
    if (!why.empty() && options_.engine == Engine::Interpreter) why_ = "this program cannot be interpreted: " + why;
    if (!why.empty() && why_.empty()) fprintf(stderr, "rung: this program runs as compiled C++: %s\n", why.c_str());
    return compilation.emit(true, part.files);
  }

  int compileSeparately() {
    // The files are found once, as one project; the texts are read again for each.
    Compilation all(options_, times_);
    if (!all.read()) return all.finish();
    std::string root = options_.root.empty() ? all.inputs.root : options_.root;
    for (size_t i = 0; i < all.inputs.files.size(); i++) {
      const InputFile& file = all.inputs.files[i];
      Options one = options_;
      one.inputs = {file.path};
      one.root = root;
      one.name = all.options.moduleName() + "_" + std::to_string(i);
      Compilation compilation(one, times_);
      NativePart part;
      part.folder = one.name;
      Module module{one.name, file.shown, file.below, false, {}, {}};
      module.good = makeModule(compilation, module, part);
      if (!why_.empty()) return usageError(why_);
      if (compilation.exitCode() == kInternal) return compilation.finish();
      module.messages = compilation.diagnosticsText();
      module.good = module.good && compilation.exitCode() == kGood;
      if (module.good && !module.program) request_.parts.push_back(std::move(part));
      modules_.push_back(std::move(module));
    }
    checked_ = (all.options.checks & kMemoryChecks) == kMemoryChecks;
    request_.batches = batchCount(request_.parts.size());
    return kGood;
  }

  int buildAndRun() {
    Cache cache;
    ModuleLibrary library;
    if (!request_.parts.empty()) {
      times_.begin("c++");
      request_.level = options_.level;
      request_.jobs = options_.jobs;
      request_.keep = options_.keep;
      NativeResult result = makeShared(cache, request_);
      if (result.exit == kInternal) printInternalError(result.message.c_str());
      if (result.exit == kUsage) usageError(result.message);
      if (result.exit != kGood) return result.exit;
      std::string error = library.open(result.path);
      if (!error.empty()) {
        printInternalError(error.c_str());
        return kInternal;
      }
    }
    times_.begin("run");
    host::TestResults results;
    test_options_.junit_path = options_.junit;
    for (const Module& module : modules_) {
      const int exit = runModule(module, library, results);
      if (exit != kGood) return exit;
    }
    fflush(stderr);
    return host::reportTests(results, test_options_);
  }

  int runModule(const Module& module, const ModuleLibrary& library, host::TestResults& results) {
    if (!module.messages.empty()) fputs(module.messages.c_str(), stderr);
    if (!module.good) {
      printf("FAIL %s: does not compile\n", module.shown.c_str());
      results.failed++;
      results.junit += host::brokenSuite(module.below, module.messages);
      return kGood;  // the other files count; the exit code says that a test failed
    }
    std::string error;
    const rung_module* description = module.program ? &module.program->description() : library.find(module.name, error);
    if (description == nullptr) {
      printInternalError(error.c_str());
      return kInternal;
    }
    const uint32_t passed = results.passed, failed = results.failed;
    setProgramRuns(true, checked_);
    error = host::runTests(*description, test_options_, results);
    setProgramRuns(false, false);
    if (!error.empty()) return usageError(error);
    if (options_.separate)
      printf("%s %s: %u passed, %u failed\n", results.failed == failed ? "ok  " : "FAIL", module.shown.c_str(),
             results.passed - passed, results.failed - failed);
    fflush(stdout);
    return kGood;
  }

  const Options& options_;
  host::TestOptions test_options_;
  PhaseTimes times_;
  NativeRequest request_;
  std::vector<Module> modules_;
  bool checked_ = true;
  std::string why_;  // an error of use
};

}  // namespace

int runTest(const Options& options) { return Tester(options).run(); }

}  // namespace rung::tool
