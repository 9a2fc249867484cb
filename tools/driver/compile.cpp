// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/compile.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

#include "frontend/parse/parse.h"
#include "frontend/schedule/network_elements.h"
#include "frontend/source/invariant.h"
#include "frontend/source/render.h"
#include "ir/interpreter/constant_call.h"
#include "ir/lower.h"
#include "ir/passes/passes.h"
#include "ir/text.h"
#include "ir/verify.h"
#include "native_table.h"
#include "tools/driver/commands.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

uint64_t clockNs(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<uint64_t>(t.tv_sec) * 1'000'000'000u + static_cast<uint64_t>(t.tv_nsec);
}

void addTo(std::vector<bool>& sum, const std::vector<bool>& more) {
  if (sum.size() < more.size()) sum.resize(more.size());
  for (size_t i = 0; i < more.size(); ++i)
    if (more[i]) sum[i] = true;
}

}  // namespace

void PhaseTimes::begin(const char* phase) {
  end();
  setPhase(phase);
  running_ = phase;
  cpu_begin_ = clockNs(CLOCK_PROCESS_CPUTIME_ID);
  wall_begin_ = clockNs(CLOCK_MONOTONIC);
}

void PhaseTimes::end() {
  if (running_ == nullptr) return;
  uint64_t cpu = clockNs(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin_, wall = clockNs(CLOCK_MONOTONIC) - wall_begin_;
  for (Row& row : rows_) {
    if (strcmp(row.phase, running_) != 0) continue;
    row.cpu_ns += cpu;
    row.wall_ns += wall;
    running_ = nullptr;
    return;
  }
  rows_.push_back({running_, cpu, wall});
  running_ = nullptr;
}

std::string PhaseTimes::table() const {
  char line[160];
  std::string out = "phase          CPU s     wall s      lines/s\n";
  uint64_t cpu = 0, wall = 0;
  auto add = [&](const char* name, uint64_t cpu_ns, uint64_t wall_ns) {
    double seconds = static_cast<double>(cpu_ns) * 1e-9;
    snprintf(line, sizeof line, "%-10s %9.4f  %9.4f %12.0f\n", name, seconds, static_cast<double>(wall_ns) * 1e-9,
             seconds > 0 ? static_cast<double>(lines) / seconds : 0.0);
    out += line;
  };
  for (const Row& row : rows_) {
    add(row.phase, row.cpu_ns, row.wall_ns);
    cpu += row.cpu_ns;
    wall += row.wall_ns;
  }
  add("total", cpu, wall);
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  snprintf(line, sizeof line, "%llu lines, %llu bytes, peak memory %.1f MiB\n", static_cast<unsigned long long>(lines),
           static_cast<unsigned long long>(bytes), static_cast<double>(usage.ru_maxrss) / 1024.0);
  return out + line;
}

Compilation::~Compilation() = default;

Compilation::Compilation(const ProjectOptions& given, PhaseTimes& times, Sink& sink)
    : options(given), diagnostics(sources), times_(times), sink_(sink) {
  diagnostics.max_errors = options.report.max_errors;
  diagnostics.keeps_all_warnings = options.report.max_warnings == 0;
  diagnostics.warnings_are_errors = options.report.werror;
}

bool Compilation::read() {
  times_.begin("read");
  readInputs(options, sources, diagnostics, inputs);
  if (inputs.project.file) applyProjectFile(inputs.project, options);
  for (const WarningSwitch& warning : options.report.warnings)
    if (!diagnostics.setWarning(warning.name, warning.on) && usage_error_.empty())
      usage_error_ = "unknown warning `" + warning.name + "` in `-W`; `rung list warnings` lists all";
  if (usage_error_.empty()) usage_error_ = libraries.load(options);
  for (const InputFile& file : inputs.files) {
    std::string_view text = sources.sourceText(file.file);
    for (size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) ++times_.lines;
    times_.bytes += text.size();
  }
  if (usage_error_.empty() && !inputs.io_error) usage_error_ = natives.read(inputs, libraries, sources);
  importer::LadderSettings& ladder = inputs.project.ladder;
  if (options.code.plc_period_ns > 0) ladder.plc_period_ns = options.code.plc_period_ns;
  if (options.code.time_slice_ns > 0) ladder.time_slice_ns = options.code.time_slice_ns;
  if (ladder.plc_period_ns % ladder.time_slice_ns != 0 && usage_error_.empty())
    usage_error_ = "the PLC period of an NCT program must be a multiple of its TimeSlice";
  const bool ok = usage_error_.empty() && !inputs.io_error && diagnostics.errorCount() == inputs.missing_files;
  if (ok) readPrograms(sources, diagnostics, inputs, for_pictures);
  for (const LibraryInput& file : inputs.library_files)
    if (ok) libraries.addFile(file.library, file.path, file.file, sources.sourceText(file.file));
  noteLibraries();
  if (options.verbose) sink_.message(whatIsRead());
  times_.end();
  return ok;
}

// The lines of `--verbose`: inputs, the project's settings, files, and the libraries beside those of Rung.
std::string Compilation::whatIsRead() const {
  std::string out;
  for (const std::string& input : options.inputs) out += "rung: input: " + input + "\n";
  if (inputs.project.file) out += "rung: project: " + std::string(sources.displayPath(inputs.project.file)) + "\n";
  for (const InputFile& file : inputs.files) out += "rung: file: " + file.shown + "\n";
  for (const auto& [name, folder] : libraries.folders()) out += "rung: library: " + name + " in " + folder + "\n";
  for (const importer::Library& wanted : inputs.libraries) out += "rung: library of the project: " + wanted.name + "\n";
  return out;
}

// The names of the project among the inputs, or of a library given with -I, that has this name; or null.
static std::vector<std::string>* namesOfProject(Inputs& inputs, std::string_view wanted) {
  const auto has = [&](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return sameIdentifier(name, wanted); });
  };
  for (std::vector<std::string>& names : inputs.library_names)
    if (has(names)) return &names;
  return has(inputs.project_names) ? &inputs.project_names : nullptr;
}

// Reports the libraries that a project of another tool asks for and Rung does not have, and adds the project's names
// for the others.
void Compilation::noteLibraries() {
  std::vector<std::string> named;
  for (const importer::Library& wanted : inputs.libraries) {
    named.push_back(wanted.name);
    if (!wanted.space.empty() && !sameIdentifier(wanted.space, wanted.name)) {
      if (std::vector<std::string>* names = namesOfProject(inputs, wanted.name); names != nullptr)
        names->push_back(wanted.space);
      else
        libraries.addAlias(wanted.space, wanted.name);
    }
    const auto called = [&](std::string_view name) { return sameIdentifier(name, wanted.name); };
    const bool known = namesOfProject(inputs, wanted.name) != nullptr ||
                       std::any_of(libraries.files().begin(), libraries.files().end(),
                                   [&](const sema::LibraryFile& file) { return called(file.library); }) ||
                       std::any_of(libraries.aliases().begin(), libraries.aliases().end(),
                                   [&](const sema::LibraryAlias& alias) { return called(alias.alias); });
    if (!known)
      diagnostics.report(diag::UnknownLibrary, wanted.loc, {wanted.name})
          .length(static_cast<uint32_t>(wanted.name.size()));
  }
  libraries.prefer(named);
}

// A block's name means that of the library that the project refers to, never another vendor's block of the same name.
void Compilation::hideOtherVendors(std::vector<sema::LibraryFile>& files) const {
  static constexpr struct { const char *referred, *hidden; } kVendors[] = {{"Tc2_MC2", "SM3_Basic"}};
  const auto isReferred = [&](std::string_view name) {
    return std::any_of(inputs.libraries.begin(), inputs.libraries.end(),
                       [&](const importer::Library& library) { return sameIdentifier(library.name, name); });
  };
  for (const auto& row : kVendors) {
    if (!isReferred(row.referred) || isReferred(row.hidden)) continue;
    for (sema::LibraryFile& file : files)
      if (std::string_view(file.library) == row.hidden) file.hidden_by = row.referred;
  }
}

// Appends the file to the tree, and notes what its parser says of the whole tree.
void Compilation::parseFile(FileId file) {
  const bool lost_names = std::exchange(tree.lost_names, false);
  std::vector<bool> eno_read_of = std::exchange(tree.eno_read_of, {});
  text::parseFile(tree, names, sources, file, options.dialect, diagnostics);
  parsed_.push_back({file, tree.lost_names, tree.eno_read_of});
  tree.lost_names = tree.lost_names || lost_names;
  addTo(eno_read_of, tree.eno_read_of);
  tree.eno_read_of = std::move(eno_read_of);
}

// Puts the file into its place in the tree, and its parser's messages into that of the old ones.
void Compilation::parseFileAgain(FileId file) {
  diagnostics.retract([&](const Diagnostic& diagnostic) {
    return diagnostic.reporter == 0 && sources.editedFile(sources.fileOf(diagnostic.loc)) == file;
  });
  const auto is_it = [&](const auto& parsed) { return parsed.file == file; };
  const auto place = std::find_if(tree.files.begin(), tree.files.end(), is_it) - tree.files.begin();
  parsed_.erase(std::find_if(parsed_.begin(), parsed_.end(), is_it));
  parseFile(file);
  tree.files[static_cast<size_t>(place)] = tree.files.back();
  tree.files.pop_back();
}

bool Compilation::parseAgain(FileId file) {
  const ParsedFile before =
      *std::find_if(parsed_.begin(), parsed_.end(), [&](const ParsedFile& parsed) { return parsed.file == file; });
  parseFileAgain(file);
  return before.lost_names == parsed_.back().lost_names && before.eno_read_of == parsed_.back().eno_read_of;
}

bool Compilation::parse() {
  if (!read()) return false;
  times_.begin("parse");
  tree.lost_names = inputs.unread;
  std::vector<FileId> files;
  for (const InputFile& file : inputs.files) files.push_back(file.file);
  asks_for_names_ = text::applyConditions(sources, files, options.defines, options.dialect, diagnostics);
  for (const InputFile& file : inputs.files) {
    if (diagnostics.full()) break;
    setPhaseSubject(file.below.data(), file.below.size());
    parseFile(file.file);
  }
  if (inputs.project.configuration) parseFile(inputs.project.configuration);
  for (const FileId made : {inputs.project.safe_values, inputs.project.module_variables, inputs.project.axis_variables})
    if (made) parseFile(made);
  written_size_ = tree.size();
  setPhaseSubject("", 0);
  times_.end();
  if (options.code.dump_after == "parse")
    for (const FileUnit& unit : tree.files) dump(printTree(tree, names, sources, unit));
  return true;
}

sema::Options Compilation::semaOptions() {
  sema::Options sema_options;
  sema_options.dialect = options.dialect;
  if (!options.name.empty()) sema_options.name = options.name;
  library_files_ = libraries.files();
  // The variables of the numerical control are in the memory of its ladder.
  if (!types::findArea(inputs.project.areas, 'N'))
    std::erase_if(library_files_,
                  [](const auto& file) { return std::string_view(file.path).ends_with("nct/symbols.st"); });
  hideOtherVendors(library_files_);
  for (size_t i = 0; i < library_sources_.size(); ++i) library_files_[i].file = library_sources_[i];
  sema_options.libraries = library_files_;
  sema_options.library_aliases = libraries.aliases();
  sema_options.project_names = inputs.project_names;
  for (const std::vector<std::string>& names : inputs.library_names)
    sema_options.library_projects.push_back({names, {}});
  for (const InputFile& input : inputs.files)
    if (input.is_library) sema_options.library_projects[input.library].files.push_back(input.file);
  sema_options.free_subranges = inputs.is_twincat;
  sema_options.pool_bytes = inputs.project.pool_bytes;
  sema_options.areas = inputs.project.areas;
  sema_options.aligned_globals = inputs.project.aligned_globals;
  sema_options.io_modules = inputs.project.io_modules;
  sema_options.task_durations = inputs.project.task_durations;
  sema_options.default_interval_ns = options.code.default_interval_ns;
  sema_options.with_tests = options.code.with_tests;
  sema_options.mocks = options.code.mocks;
  sema_options.pointer_size = options.code.pointer_size;
  sema_options.native_width = options.code.native_width;
  sema_options.edge_coils = options.code.edge_coils;
  sema_options.scheduled = scheduled;
  sema_options.cancelled = cancelled;
  sema_options.records_mentions = is_edited;
  sema_options.call_constant = [](sema::Project& in, sema::PouId function, std::span<const types::Value> values,
                                  FunctionRef<bool(sema::PouId)> ready) {
    return ir::interpreter::callConstant(in, function, values, {rung::natives::table, rung::natives::count}, ready);
  };
  return sema_options;
}

std::vector<bool> Compilation::inOutsOfBoxes() {
  Diagnostics unreported(sources);
  sema::Project declared(sources, names, unreported, tree, semaOptions());
  return sema::inOutsOfBoxes(declared);
}

bool Compilation::check() {
  if (!parse()) return false;
  if (!inputs.has_ladder)
    for (const InputFile& file : inputs.message_files)
      diagnostics.report(diag::NoLadderOfMessages, sources.begin(file.file), {});
  if (parsed && !diagnostics.hasErrors()) parsed();
  times_.begin("check");
  // Checking follows even after errors of the parser: one run reports as much as it can.
  if (!diagnostics.full()) checkParsed();
  setPhaseSubject("", 0);
  times_.end();
  return !diagnostics.hasErrors();
}

void Compilation::checkParsed() {
  project = std::make_unique<sema::Project>(sources, names, diagnostics, tree, semaOptions());
  if (is_edited) {
    checked = std::make_unique<sema::CheckedProject>(*project);
    const std::span<const FileId> added = checked->librarySources();
    library_sources_.assign(added.begin(), added.end());
  } else {
    sema::check(*project);
  }
  project->options.cancelled = nullptr;
}

bool Compilation::checkAgain(std::span<const FileId> changed) {
  sema::CheckedProject* const old_check = checked.release();
  sema::Project* const old_project = project.release();
  if (!is_last) {
    delete old_check;
    delete old_project;
  }
  const bool is_last = changed.size() == 1 && changed[0] == last_changed_;
  size_before_last_ = is_last ? size_before_last_ : written_size_;
  last_changed_ = changed.size() == 1 ? changed[0] : FileId{};
  tree.truncate(size_before_last_);
  diagnostics.retract([](const Diagnostic& diagnostic) { return diagnostic.reporter != 0; });
  for (const FileId file : changed) parseFileAgain(file);
  if (diagnostics.full()) return false;
  tree.lost_names = inputs.unread;
  tree.eno_read_of.clear();
  for (const ParsedFile& file : parsed_) {
    tree.lost_names = tree.lost_names || file.lost_names;
    addTo(tree.eno_read_of, file.eno_read_of);
  }
  written_size_ = tree.size();
  checkParsed();
  return true;
}

bool Compilation::lower() {
  if (!check()) return false;
  times_.begin("lower");
  module = std::make_unique<ir::Module>(project->types, names, sources);
  ir::LowerOptions lower_options;
  lower_options.checks = options.code.checks;
  lower_options.online_change = options.code.online_change;
  ir::lower(*project, lower_options, *module);
  setPhaseSubject("", 0);
  times_.end();
  if (options.code.dump_after == "lower") dump(ir::print(*module));
  if (options.code.verify && !verified("lower")) return false;

  times_.begin("optimize");
  ir::optimize(*module, options.code.level, [this](const ir::Pass& pass, ir::Body& body) {
    if (options.code.dump_after == pass.name) dump(ir::print(*module, body));
    if (!options.code.verify || !internal_error_.empty()) return;
    for (const std::string& problem : ir::verify(*module, body)) {
      internal_error_ = "the IR of `" + std::string(names.string(body.spelling)) + "` is broken after pass " +
                        pass.name + ": " + problem;
      break;
    }
  });
  setPhaseSubject("", 0);
  times_.end();
  return internal_error_.empty();
}

bool Compilation::emit(std::vector<codegen::OutputFile>& files) {
  if (!module && !lower()) return false;
  times_.begin("emit");
  codegen::EmitOptions emit_options;
  emit_options.bundled = options.code.is_bundled;
  emit_options.module_name = options.moduleName();
  emit_options.with_tests = options.code.with_tests;
  emit_options.counts_steps = options.code.counts_steps;
  emit_options.optimize_all = options.code.level >= 2;
  emit_options.is_native_of_rung = isNativeOfRung;
  files = codegen::emitCpp(*module, emit_options);
  natives.addTo(files, *module, sources);
  setPhaseSubject("", 0);
  times_.end();
  return true;
}

bool Compilation::checkNatives() {
  if (!module && !lower()) return false;
  for (const ir::Body& body : module->bodies) {
    const std::string function = body.native ? ir::nativeName(*module, body) : std::string();
    if (function.empty() || isNativeOfRung(function) || natives.mention(function, sources)) continue;
    diagnostics.report(diag::NativeWithoutBody, body.loc,
                       {names.string(body.spelling ? body.spelling : body.name), function});
  }
  return !diagnostics.hasErrors();
}

bool Compilation::translate(std::unique_ptr<ir::interpreter::Program>& program, std::string& why) {
  if (!lower()) return false;
  times_.begin("translate");
  ir::interpreter::ProgramOptions program_options;
  const std::string name = options.moduleName();
  program_options.module_name = name;
  program_options.with_tests = options.code.with_tests;
  program_options.natives = {rung::natives::table, rung::natives::count};
  program_options.coverage = options.code.counts_statements;
  program_options.trace_calls = options.code.trace_calls;
  program_options.debug = options.code.debug;
  program = std::make_unique<ir::interpreter::Program>(*module, program_options);
  times_.end();
  if (program->refusal().empty()) return true;
  why = program->refusal();
  program.reset();
  return true;
}

bool Compilation::verified(const char* after) {
  std::vector<std::string> problems = ir::verify(*module);
  if (problems.empty()) return true;
  internal_error_ = std::string("the IR is broken after ") + after + ": " + problems[0];
  return false;
}

void Compilation::dump(const std::string& text) const { sink_.message(text); }

int Compilation::exitCode() const {
  if (!internal_error_.empty()) return kInternal;
  if (!usage_error_.empty() || inputs.io_error) return kUsage;
  return diagnostics.hasErrors() ? kInputErrors : kSuccess;
}

std::string Compilation::diagnosticsText() { return textOf(diagnostics); }

// Sorted, with the names of the elements of diagrams.
void Compilation::prepare(Diagnostics& own) const {
  if (own.all().empty()) return;
  const diagram::ElementLocator elements(tree, names);
  if (!elements.empty()) own.nameElements([&](Loc loc) { return elements.at(loc); });
  own.sort();
}

RenderOptions Compilation::renderOptions() const {
  RenderOptions render_options;
  render_options.format = options.report.format;
  render_options.color = options.report.color;
  render_options.max_warnings = options.report.max_warnings;
  render_options.page = errorPage;
  return render_options;
}

std::string Compilation::textOf(Diagnostics& own) const {
  if (own.all().empty() && options.report.format == DiagnosticFormat::Text) return {};
  prepare(own);
  return render(own, sources, renderOptions());
}

int Compilation::finish() {
  if (!usage_error_.empty()) {
    sink_.error(usage_error_);
    return kUsage;
  }
  prepare(diagnostics);
  const std::string refused = passDiagnostics();
  if (!internal_error_.empty()) sink_.internalError(internal_error_);
  if (refused.empty()) return exitCode();
  sink_.error(refused);
  return kUsage;
}

// With --diagnostics the file has the requested format, and the sink gets text.
std::string Compilation::passDiagnostics() {
  RenderOptions render_options = renderOptions();
  std::string error;
  if (!options.report.path.empty()) {
    RenderOptions of_file = render_options;
    of_file.color = false;
    error = writeFile(options.report.path, render(diagnostics, sources, of_file));
    render_options.format = DiagnosticFormat::Text;
  }
  if (!diagnostics.all().empty() || render_options.format != DiagnosticFormat::Text)
    sink_.diagnostics(diagnostics, sources, render_options);
  return error;
}

// Columns of g++ count bytes: it cannot open the user's file.
static Loc locationIn(const Sources& sources, FileId file, const Refusal& refusal) {
  const std::string_view line = sources.line(file, refusal.line);
  if (line.data() == nullptr) return sources.begin(file);
  const size_t at = std::min<size_t>(refusal.column == 0 ? 0 : refusal.column - 1, line.size());
  return {sources.begin(file).offset + static_cast<uint32_t>(line.data() - sources.original(file).data() + at)};
}

bool Compilation::addRefusals(const NativeResult& native, Diagnostics& to) const {
  bool any = false;
  for (const Refusal& refusal : native.refusals) {
    for (uint32_t i = 1; i <= sources.fileCount(); ++i) {
      if (sources.path({i}) != refusal.path) continue;
      to.report(diag::CppRefused, locationIn(sources, {i}, refusal), {refusal.message});
      any = true;
      break;
    }
  }
  return any;
}

int Compilation::finish(const NativeResult& native) {
  if (native.exit == kInputErrors && !addRefusals(native, diagnostics)) sink_.message(native.message + "\n");
  const int exit = finish();
  if (native.exit == kInternal) sink_.internalError(native.message);
  if (native.exit == kUsage) sink_.error(native.message);
  return exit != kSuccess ? exit : native.exit;
}

bool Compilation::printRefusals(const NativeResult& native) const {
  Diagnostics own(sources);
  if (!addRefusals(native, own)) return false;
  sink_.message(textOf(own));
  return true;
}

std::string checkDumpName(const std::string& name) {
  if (name.empty()) return {};
  std::vector<std::string_view> known = {"parse", "lower"};
  for (const ir::Pass& pass : ir::bodyPasses(2)) known.push_back(pass.name);
  for (std::string_view candidate : known)
    if (candidate == name) return {};
  std::string message = "unknown `" + name + "` in `--dump-after`";
  std::string_view near = nearest(name, known);
  if (!near.empty()) return message + "; did you mean `" + std::string(near) + "`?";
  const char* separator = "; it takes ";
  for (std::string_view candidate : known) {
    message += separator + std::string(candidate);
    separator = ", ";
  }
  return message;
}

}  // namespace rung::driver
