// SPDX-License-Identifier: Apache-2.0
// The driver: read → parse → check → lower → optimize → emit, with timings, dumps and the verifier between phases.
// In: ProjectOptions. Out: the tree, the project, the IR module, generated files; diagnostics go to the sink at the end
// of the run. Called by the commands, one Compilation for each project; several may exist at a time, also in several
// threads.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/emit.h"
#include "frontend/source/diagnostics.h"
#include "frontend/syntax/tree.h"
#include "ir/interpreter/program.h"
#include "ir/ir.h"
#include "sema/check.h"
#include "sema/options.h"
#include "tools/driver/inputs.h"
#include "tools/driver/libraries.h"
#include "tools/driver/native.h"
#include "tools/driver/native_sources.h"
#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::driver {

// CPU seconds of each phase of a run, for --time-phases. One object for all compilations of `rung test --separate`.
class PhaseTimes {
 public:
  void begin(const char* phase);  // ends the previous phase
  void end();
  uint64_t lines = 0, bytes = 0;
  std::string table() const;

 private:
  struct Row {
    const char* phase;
    uint64_t cpu_ns, wall_ns;
  };
  std::vector<Row> rows_;
  const char* running_ = nullptr;
  uint64_t cpu_begin_ = 0, wall_begin_ = 0;
};

class Compilation {
 public:
  // Options are copied: rung.project may change them.
  Compilation(const ProjectOptions& options, PhaseTimes& times, Sink& sink);
  ~Compilation();

  // Each runs the phases before it. False: stop; finish() returns the exit code.
  bool read();
  bool parse();
  bool check();
  bool lower();                                           // and optimize
  uint32_t writtenSize() const { return written_size_; }  // of the tree, without code
  // After check(): parses a file in ST again that has another text: Sources::edit. False: names of the whole project
  // may have come or gone.
  bool parseAgain(FileId file);
  // After check(): the project in which these files in ST have another text (Sources::edit). The trees of the others
  // are kept. False: another Compilation is needed, and this one is of no use.
  bool checkAgain(std::span<const FileId> changed);
  // A condition of a pragma asks what the project declares.
  bool asksForNames() const { return asks_for_names_; }
  // After parse(), for pictures: see sema/project.h. Mistakes in declarations are not reported.
  std::vector<bool> inOutsOfBoxes();
  bool emit(std::vector<codegen::OutputFile>& files);
  // Reports native bodies that no C++ file defines. Called before the code becomes a program; a library leaves them to
  // the product that links it. False: stop.
  bool checkNatives();
  // Makes the program that `rung run` and `rung test` interpret; none when it cannot be interpreted (the reason is in
  // `why`). False: stop.
  bool translate(std::unique_ptr<ir::interpreter::Program>& program, std::string& why);

  // Passes the diagnostics to the sink and returns the exit code: 0, 1, 2 or 70.
  int finish();
  // The same after the C++ compiler, which may have rejected what the user wrote in C++.
  bool hasUserCpp() const { return module && (!module->cpp_bodies.empty() || !natives.empty()); }
  int finish(const NativeResult& native);
  // Prints only the errors of the C++ compiler that belong to these files.
  bool printRefusals(const NativeResult& native) const;
  // The diagnostics as a string, for `rung test --separate`.
  std::string diagnosticsText();
  int exitCode() const;

  bool for_pictures = false;                     // set before parse() by `rung graph`
  bool is_last = false;                          // checkAgain() need not free what was known: the process ends soon
  bool is_edited = false;                        // set before check(): bodies may be replaced after it, by `checked`
  const std::atomic<bool>* cancelled = nullptr;  // set before check(): sema::Options::cancelled
  sema::Scheduled scheduled;                     // set before check() by `rung convert`
  std::function<void()> parsed;                  // likewise: called while the tree is as parsed, and has no errors
  ProjectOptions options;
  Sources sources;
  Names names;
  Diagnostics diagnostics;
  Tree tree;
  Inputs inputs;
  LibrarySet libraries;
  NativeSources natives;
  std::unique_ptr<sema::Project> project;
  std::unique_ptr<sema::CheckedProject> checked;  // when `is_edited`
  std::unique_ptr<ir::Module> module;

 private:
  struct ParsedFile {
    FileId file;
    bool lost_names;
    std::vector<bool> eno_read_of;
  };
  void parseFile(FileId file);
  void parseFileAgain(FileId file);
  void noteLibraries();
  void checkParsed();
  std::string whatIsRead() const;
  sema::Options semaOptions();
  void hideOtherVendors(std::vector<sema::LibraryFile>& files) const;
  std::string passDiagnostics();
  bool addRefusals(const NativeResult& native, Diagnostics& to) const;
  void prepare(Diagnostics& own) const;
  RenderOptions renderOptions() const;
  std::string textOf(Diagnostics& own) const;
  void dump(const std::string& text) const;
  bool verified(const char* after);

  bool asks_for_names_ = false;
  std::vector<ParsedFile> parsed_;  // what each adds to the tree as a whole
  uint32_t written_size_ = 0;       // of the tree when all files are parsed
  uint32_t size_before_last_ = 0;   // … before checkAgain() parsed `last_changed_` alone
  FileId last_changed_;
  std::vector<sema::LibraryFile> library_files_;  // what sema refers to
  std::vector<FileId> library_sources_;
  PhaseTimes& times_;
  Sink& sink_;
  std::string usage_error_, internal_error_;
};

// Empty for `parse`, `lower` and the names of passes; else a message with a suggestion.
[[nodiscard]] std::string checkDumpName(const std::string& name);

}  // namespace rung::driver
