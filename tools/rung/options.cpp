// SPDX-License-Identifier: Apache-2.0
// The command line of rung; see options.h.
#include "tools/rung/options.h"

#include <cstdlib>
#include <iterator>

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "ir/ir.h"
#include "rung/host.h"
#include "tools/driver/new_project.h"

namespace rung::tool {
namespace {

constexpr uint32_t bit(Command command) { return 1u << static_cast<uint32_t>(command); }
constexpr uint32_t kCompile =
    bit(Command::Check) | bit(Command::Emit) | bit(Command::Build) | bit(Command::Run) | bit(Command::Test);
constexpr uint32_t kReads =
    kCompile | bit(Command::List) | bit(Command::Convert) | bit(Command::Graph) | bit(Command::Fmt);
constexpr uint32_t kAll = ~0u;

struct CommandRow {
  Command command;
  const char* name;
  const char* arguments;
  const char* summary;
};
constexpr CommandRow kCommands[] = {
    {Command::Check, "check", "[FILE|DIR ...]", "parse and check; print only diagnostics"},
    {Command::Emit, "emit", "[FILE|DIR ...] -o DIR", "write C++ (or print the IR or the tree)"},
    {Command::Build, "build", "[FILE|DIR ...] -o FILE", "emit, compile and link"},
    {Command::Run, "run", "[FILE|DIR ...]", "run a program, with inputs and traces"},
    {Command::Test, "test", "[FILE|DIR ...]", "run the POUs marked {test}"},
    {Command::Convert, "convert", "[FILE|DIR ...] --to st|xml|mes -o DIR",
     "convert files to ST, or a project to PLCopen XML"},
    {Command::Graph, "graph", "[FILE|DIR ...] -o DIR", "draw LD, FBD, CFC, SFC and NCT as SVG pictures"},
    {Command::Fmt, "fmt", "[FILE|DIR|- ...]", "format sources, also inside files of other tools"},
    {Command::List, "list", "libraries|warnings | pous|tasks PATH ...", "list libraries, warnings, POUs or tasks"},
    {Command::New, "new", "NAME", "make a folder with a small project and its test"},
    {Command::Init, "init", "[DIR]", "write a rung.project for the sources of a folder"},
    {Command::Cam, "cam", "law [NAME] | check|show|convert|fit FILE ...",
     "motion laws; check, draw, convert and fit cams"},
    {Command::Explain, "explain", "CODE", "print the page of a diagnostic, such as E0401"},
    {Command::Version, "version", "", "print the version and where the runtime is"},
};

// Commands announced in the project's documentation.
constexpr std::string_view kLaterCommands[] = {"lint", "lsp", "monitor"};

enum class Key : uint8_t {
  Output,
  Library,
  Define,
  Root,
  Name,
  Dialect,
  NativeWidth,
  EdgeCoils,
  Period,
  Checks,
  Level,
  Warning,
  Werror,
  MaxErrors,
  MaxWarnings,
  Format,
  Diagnostics,
  Jobs,
  Color,
  DumpAfter,
  TimePhases,
  Verbose,
  Emit,
  To,
  Split,
  PageWidth,
  FmtCheck,
  FmtDiff,
  FmtLines,
  Depfile,
  DepfileTarget,
  ListOutputs,
  Bundles,
  Shared,
  Static,
  Debug,
  Symbols,
  Keep,
  Engine,
  Host,
  Filter,
  Junit,
  AllowNone,
  Limit,
  Coverage,
  Lcov,
  Separate,
  TargetPointer,
  Signature,
  Template,
  CamNumber,
  Later,
  Help,
};

struct OptionRow {
  Key key;
  const char* name;   // as the user types it: "--root", "-o"
  const char* value;  // the name of its value; null: none
  uint32_t commands;
  const char* help;  // null: not in the help
};
constexpr OptionRow kOptions[] = {
    {Key::Output, "-o", "PATH",
     bit(Command::Emit) | bit(Command::Build) | bit(Command::Convert) | bit(Command::Graph) | bit(Command::Cam),
     "output file or folder"},
    {Key::Emit, "--emit", "cpp|ir|tree", bit(Command::Emit), "cpp to files, ir or tree to stdout (default: cpp)"},
    {Key::To, "--to", "st|xml|mes", bit(Command::Convert), "Structured Text, PLCopen XML or messages of NCT"},
    {Key::Split, "--split", nullptr, bit(Command::Convert), "to ST: one file for each POU, also of files in ST"},
    {Key::PageWidth, "--page-width", "N", bit(Command::Graph), "wrap networks at N pixels; 0: never (default: 1200)"},
    {Key::FmtCheck, "--check", nullptr, bit(Command::Fmt), "write nothing; list files to change, exit 1"},
    {Key::FmtDiff, "--diff", nullptr, bit(Command::Fmt), "write nothing; print what would change"},
    {Key::FmtLines, "--lines", "A:B", bit(Command::Fmt), "change only lines A to B, of one file"},
    {Key::Depfile, "--depfile", "FILE", bit(Command::Emit), "write a make rule that lists every file read"},
    {Key::DepfileTarget, "--depfile-target", "PATH", bit(Command::Emit),
     "the rule's target (default: DIR/rung.manifest)"},
    {Key::ListOutputs, "--list-outputs", nullptr, bit(Command::Emit), "print the file names without writing the files"},
    {Key::Bundles, "--bundles", "N", bit(Command::Emit), "write N more files that include all the others"},
    {Key::Shared, "--shared", nullptr, bit(Command::Build), "make a shared library"},
    {Key::Static, "--static", nullptr, bit(Command::Build), "make a static library"},
    {Key::Debug, "-g", nullptr, bit(Command::Build), "for debuggers: names and values of ST in gdb; -O0 unless given"},
    {Key::Symbols, "--symbols", "FILE", bit(Command::Build), "write where the variables are, as JSON"},
    {Key::Keep, "--keep", nullptr, bit(Command::Build) | bit(Command::Run) | bit(Command::Test),
     "keep the generated C++ and print its folder"},
    {Key::Engine, "--engine", "native|interp", bit(Command::Run) | bit(Command::Test),
     "compile to C++, or interpret (default: interp)"},
    {Key::Host, "--cycles", "N", bit(Command::Run), "run N cycles (default: 100, or all of --inputs)"},
    {Key::Host, "--for", "T", bit(Command::Run), "run for a time, such as T#2s"},
    {Key::Host, "--interval", "T", bit(Command::Run), "cycle time if there are no tasks (default: T#10ms)"},
    {Key::Host, "--inputs", "FILE", bit(Command::Run), "CSV (cycle,PATH,...): values set before each cycle"},
    {Key::Host, "--set", "PATH=VALUE", bit(Command::Run), "set a variable before cycle 0; may be repeated"},
    {Key::Host, "--watch", "PATH,...", bit(Command::Run) | bit(Command::Test), "variables to trace (default: all)"},
    {Key::Host, "--trace", "FILE", bit(Command::Run) | bit(Command::Test),
     "write a CSV row after each cycle; - is stdout"},
    {Key::Host, "--plot", "FILE", bit(Command::Run) | bit(Command::Test), "plot the variables over time, as SVG"},
    {Key::Host, "--on-fault", "all|task", bit(Command::Run), "what a fault stops (default: all tasks)"},
    {Key::Host, "--control", "FILE", bit(Command::Run), "commands: stop, start, reset, single cycles"},
    {Key::Host, "--driver", "LIB[=ARG]", bit(Command::Run), "devices of a product: a library with rung_drivers"},
    {Key::Host, "--retain", "FILE", bit(Command::Run), "keep retained variables in FILE between runs"},
    {Key::Host, "--retain-interval", "T", bit(Command::Run), "how often the retain file is written (default: 1s)"},
    {Key::Host, "--start", "cold|warm|origin", bit(Command::Run), "default: warm if the retain file exists, else cold"},
    {Key::Host, "--files-root", "DIR", bit(Command::Run), "folder for the program's files (default: current)"},
    {Key::Host, "--serial", "N=DEVICE", bit(Command::Run), "device of serial port N; may be repeated"},
    {Key::Host, "--stop-on", "CONDITION", bit(Command::Run), "stop after the cycle that makes CONDITION TRUE"},
    {Key::Host, "--trace-calls", nullptr, bit(Command::Run), "print which POUs ran in each cycle"},
    {Key::Host, "--realtime", nullptr, bit(Command::Run), "run in real time"},
    {Key::Limit, "--timeout", "T", bit(Command::Run) | bit(Command::Test),
     "end the run, or each test, after T (a test: 10s)"},
    {Key::Limit, "--max-steps", "N", bit(Command::Run) | bit(Command::Test),
     "end an activation after N steps (100000000)"},
    {Key::Filter, "--filter", "GLOB", bit(Command::Test), "run only tests whose name matches; may be repeated"},
    {Key::AllowNone, "--allow-none", nullptr, bit(Command::Test), "no test is not an error"},
    {Key::Junit, "--junit", "FILE", bit(Command::Test), "write the results as JUnit XML"},
    {Key::Coverage, "--coverage", nullptr, bit(Command::Test), "print which lines of the program ran"},
    {Key::Lcov, "--lcov", "FILE", bit(Command::Test), "write coverage for lcov and genhtml"},
    {Key::Separate, "--separate", nullptr, bit(Command::Test), "treat each file as a separate project"},
    {Key::Signature, "--signature", "NAME", bit(Command::List), "show the declaration of a function, block or type"},
    {Key::Template, "--template", "NAME", bit(Command::New), "what kind of project (default: st)"},
    {Key::CamNumber, "--stroke", "S", bit(Command::Cam), "way of the slave (default: 1)"},
    {Key::CamNumber, "--length", "X", bit(Command::Cam), "way of the master (default: 1)"},
    {Key::CamNumber, "--v0", "V", bit(Command::Cam), "velocity at the begin, per unit of the master"},
    {Key::CamNumber, "--v1", "V", bit(Command::Cam), "velocity at the end"},
    {Key::CamNumber, "--a0", "A", bit(Command::Cam), "acceleration at the begin"},
    {Key::CamNumber, "--a1", "A", bit(Command::Cam), "acceleration at the end"},
    {Key::CamNumber, "--j0", "J", bit(Command::Cam), "jerk at the begin"},
    {Key::CamNumber, "--j1", "J", bit(Command::Cam), "jerk at the end"},
    {Key::CamNumber, "--turn", "Z", bit(Command::Cam), "turning point, from 0 to 1 (default: 0.5)"},
    {Key::CamNumber, "--points", "N", bit(Command::Cam), "points of the table (default: 33)"},
    {Key::CamNumber, "--speed", "V", bit(Command::Cam), "speed of the master (default: that of the file)"},
    {Key::CamNumber, "--segments", "N", bit(Command::Cam), "most segments of a fit (default: 100)"},
    {Key::CamNumber, "--tolerance", "E", bit(Command::Cam), "largest error (default: the noise of the points)"},
    {Key::CamNumber, "--smooth", "c2|c3", bit(Command::Cam), "continuous acceleration, or jerk too (default: c2)"},
    {Key::CamNumber, "--repeat", "KIND", bit(Command::Cam), "closed, relative or modulo:PERIOD"},
    {Key::CamNumber, "--range", "X0:X1", bit(Command::Cam), "of the master (default: that of the points)"},
    {Key::CamNumber, "--exact", "X:Y", bit(Command::Cam), "the curve goes through it; may be repeated"},
    {Key::CamNumber, "--dwell", "X0:X1[:Y]", bit(Command::Cam), "the slave rests; may be repeated"},
    {Key::CamNumber, "--max-velocity", "V", bit(Command::Cam), "limit of the slave, at --speed"},
    {Key::CamNumber, "--max-acceleration", "A", bit(Command::Cam), "the same"},
    {Key::CamNumber, "--max-jerk", "J", bit(Command::Cam), "the same"},
    {Key::CamNumber, "--position", "LOW:HIGH", bit(Command::Cam), "limits of the slave"},
    {Key::CamNumber, "--loss", "squares|huber|cauchy|tukey", bit(Command::Cam), "how errors count (default: squares)"},
    {Key::CamNumber, "--loss-scale", "E", bit(Command::Cam), "error from which they count less"},
    {Key::CamNumber, "--master-unit", "U", bit(Command::Cam), "unit in the file, such as deg"},
    {Key::CamNumber, "--slave-unit", "U", bit(Command::Cam), "the same"},
    {Key::Dialect, "--std", "codesys|iec3|iec2", kReads | bit(Command::Init), "dialect (default: codesys)"},
    {Key::NativeWidth, "--native-width", "32|64", kCompile, "codesys: bits of intermediate results (default: 32)"},
    {Key::EdgeCoils, "--edge-coils", "pulse|latch", kCompile | bit(Command::Convert),
     "edge coils without an edge: FALSE (default), kept"},
    {Key::Period, "--plc-period", "T", kCompile, "period of Main of an NCT program (default: T#10ms)"},
    {Key::Period, "--time-slice", "T", kCompile, "period of Int0 of an NCT program (default: T#2ms)"},
    {Key::Checks, "--checks", "LIST", kCompile, "div,index,null,cast (default), more, all or none"},
    {Key::Level, "-O", "0|1|2", kCompile, "optimization level (default: 1)"},
    {Key::Warning, "-W", "NAME", kReads, "enable a warning by name or code; -Wno-NAME disables"},
    {Key::Werror, "--werror", nullptr, kReads, "treat warnings as errors"},
    {Key::MaxErrors, "--max-errors", "N", kReads, "list at most N errors; 0: all (default: 100)"},
    {Key::MaxWarnings, "--max-warnings", "N", kReads, "list at most N of one warning; 0: all (default: 20)"},
    {Key::Format, "--format", "text|json|sarif", kReads, "format of diagnostics and lists (default: text)"},
    {Key::Diagnostics, "--diagnostics", "FILE", kReads, "write diagnostics to FILE in that format, too"},
    {Key::Color, "--color", "auto|always|never", kReads | bit(Command::Explain),
     "use colours (auto: on a terminal; default: auto)"},
    {Key::Define, "-D", "NAME[=VALUE]", kReads, "define NAME for {IF defined (NAME)}; may be repeated"},
    {Key::Library, "-I", "PATH", kReads, "folder or file with libraries; may be repeated"},
    {Key::Root, "--root", "DIR", kReads, "make paths in the output relative to DIR"},
    {Key::Name, "--name", "ID", kCompile | bit(Command::Cam), "prefix of the module's symbols, or name of the cam"},
    {Key::TargetPointer, "--target-pointer", "8|4", bit(Command::Emit) | bit(Command::Build),
     "size of a pointer on the target (default: 8 bytes)"},
    {Key::Jobs, "-j", "N", bit(Command::Build) | bit(Command::Run) | bit(Command::Test),
     "number of C++ compilers to run in parallel"},
    {Key::DumpAfter, "--dump-after", "NAME", kCompile, "print the result of parse, lower or a pass to stderr"},
    {Key::TimePhases, "--time-phases", nullptr, kCompile, "print the time and lines per second of each phase"},
    {Key::Verbose, "--verbose", nullptr, kReads, "print which project, files and libraries are read"},
    {Key::Later, "--plc-period", "T", bit(Command::Run), nullptr},
    {Key::Later, "--time-slice", "T", bit(Command::Run), nullptr},
    {Key::Help, "--help", nullptr, kAll, nullptr},
    {Key::Help, "-h", nullptr, kAll, nullptr},
};

std::string parseNumber(std::string_view option, std::string_view value, uint32_t low, uint32_t high,
                        uint32_t& number) {
  uint64_t n = 0;
  bool ok = !value.empty() && value.size() <= 10;
  for (char c : value) {
    if (c < '0' || c > '9') ok = false;
    if (ok) n = n * 10 + static_cast<uint64_t>(c - '0');
  }
  if (ok && n >= low && n <= high) {
    number = static_cast<uint32_t>(n);
    return {};
  }
  return backquoted(option) + " takes a number from " + std::to_string(low) + " to " + std::to_string(high) + ", not " +
         backquoted(value);
}

// A:B
std::string parseLines(const std::string& value, format::LineRange& lines) {
  const size_t colon = value.find(':');
  if (colon == std::string::npos) return "`--lines` takes the first and the last line, as in `--lines=10:20`";
  std::string error = parseNumber("--lines", value.substr(0, colon), 1, 1'000'000'000, lines.first);
  if (error.empty()) error = parseNumber("--lines", value.substr(colon + 1), lines.first, 1'000'000'000, lines.last);
  return error;
}

std::string apply(const OptionRow& row, const std::string& value, Options& options) {
  uint32_t choice = 0;
  std::string error;
  switch (row.key) {
    case Key::Output:
      if (!options.output.empty()) return "`-o` is given twice";
      options.output = value;
      return {};
    case Key::Library: options.library_paths.push_back(value); return {};
    case Key::Define: return parseDefine(value, options.defines);
    case Key::Root: options.root = value; return {};
    case Key::Name:
      if (options.command == Command::Cam) return setCamOption(row.name, value, options.cam);
      if (!isModuleName(value))
        return backquoted(value) + " is not a C identifier; `--name` takes letters, digits and `_`";
      if (value == "rung" || value.starts_with("rung_"))
        return "the names of the runtime begin with `rung_`; choose another `--name` than " + backquoted(value);
      options.name = value;
      return {};
    case Key::Dialect: options.dialect_given = true; return parseDialect(value, options.dialect);
    case Key::NativeWidth: options.native_width_given = true; return parseNativeWidth(value, options.native_width);
    case Key::EdgeCoils: options.edge_coils_given = true; return parseEdgeCoils(value, options.edge_coils);
    case Key::Checks: options.checks_given = true; return parseChecks(value, options.checks);
    case Key::Level:
      options.level_given = true;
      error = parseChoice("-O", value, "0|1|2", choice);
      options.level = static_cast<int>(choice);
      return error;
    case Key::Warning:
      if (value == "error") {
        options.werror = true;
      } else if (value.starts_with("no-")) {
        options.warnings.push_back({value.substr(3), false});
      } else {
        options.warnings.push_back({value, true});
      }
      return {};
    case Key::Werror: options.werror = true; return {};
    case Key::MaxWarnings: return parseNumber(row.name, value, 0, 1'000'000'000, options.max_warnings);
    case Key::MaxErrors:
      error = parseNumber(row.name, value, 0, 1'000'000'000, options.max_errors);
      if (error.empty() && options.max_errors == 0) options.max_errors = ~0u;
      return error;
    case Key::Format:
      error = parseChoice(row.name, value, row.value, choice);
      options.format = static_cast<DiagnosticFormat>(choice);
      return error;
    case Key::Diagnostics: options.diagnostics_path = value; return {};
    case Key::PageWidth: return parseNumber(row.name, value, 0, 1'000'000, options.page_width);
    case Key::FmtCheck: options.only_checks = true; return {};
    case Key::FmtDiff: options.shows_changes = true; return {};
    case Key::FmtLines: return parseLines(value, options.lines);
    case Key::Jobs: return parseNumber(row.name, value, 1, 1024, options.jobs);
    case Key::Color:
      error = parseChoice(row.name, value, row.value, choice);
      options.color_choice = static_cast<Color>(choice);
      return error;
    case Key::DumpAfter: options.dump_after = value; return {};
    case Key::Verbose: options.verbose = true; return {};
    case Key::TimePhases: options.time_phases = true; return {};
    case Key::Emit:
      error = parseChoice(row.name, value, row.value, choice);
      options.emit = static_cast<EmitKind>(choice);
      return error;
    case Key::To:
      error = parseChoice(row.name, value, row.value, choice);
      options.to = choice == 0 ? ConvertTo::St : choice == 1 ? ConvertTo::Xml : ConvertTo::Messages;
      return error;
    case Key::Split: options.splits = true; return {};
    case Key::Depfile: options.depfile = value; return {};
    case Key::DepfileTarget: options.depfile_target = value; return {};
    case Key::Symbols: options.symbols = value; return {};
    case Key::ListOutputs: options.list_outputs = true; return {};
    case Key::Bundles: return parseNumber(row.name, value, 1, 1000, options.bundles);
    case Key::Shared:
    case Key::Static: {
      BuildKind kind = row.key == Key::Shared ? BuildKind::Shared : BuildKind::Static;
      if (options.build != BuildKind::Executable && options.build != kind)
        return "`--shared` and `--static` cannot be combined";
      options.build = kind;
      return {};
    }
    case Key::Debug: options.debug = true; return {};
    case Key::Keep: options.keep = true; return {};
    case Key::Engine:
      error = parseChoice(row.name, value, row.value, choice);
      options.engine = choice == 0 ? Engine::Native : Engine::Interpreter;
      return error;
    case Key::Host: options.host_arguments.push_back(row.value ? row.name + ("=" + value) : row.name); return {};
    case Key::Filter: options.filters.push_back(value); return {};
    case Key::AllowNone: options.allow_none = true; return {};
    case Key::Limit:
      if (options.command == Command::Run) options.host_arguments.push_back(row.name + ("=" + value));
      return std::string_view(row.name) == "--timeout" ? host::parseTimeout(value, options.timeout_ns)
                                                       : host::parseMaxSteps(value, options.max_steps);
    case Key::Period:
      return host::parseTimeout(
          value, std::string_view(row.name) == "--plc-period" ? options.plc_period_ns : options.time_slice_ns);
    case Key::Junit: options.junit = value; return {};
    case Key::Coverage: options.coverage = true; return {};
    case Key::Lcov: options.lcov = value; return {};
    case Key::Separate: options.separate = true; return {};
    case Key::TargetPointer:
      error = parseChoice(row.name, value, row.value, choice);
      options.pointer_size = choice == 0 ? 8 : 4;
      return error;
    case Key::Template: options.project_template = value; return {};
    case Key::Signature: options.signature = value; return {};
    case Key::CamNumber: return setCamOption(row.name, value, options.cam);
    case Key::Later: return backquoted(row.name) + " is not supported in this version of rung";
    case Key::Help: options.help = true; return {};
  }
  return {};
}

const OptionRow* findOption(std::string_view name) {
  for (const OptionRow& row : kOptions)
    if (name == row.name) return &row;
  return nullptr;
}

// `-O2`, `-Wno-x`, `-Idir`, `-j4`, `-oout`: the value follows a one-letter option without a blank.
const OptionRow* findGlued(std::string_view word) {
  if (word.size() < 3 || word[1] == '-') return nullptr;
  const OptionRow* row = findOption(word.substr(0, 2));
  return row != nullptr && row->value != nullptr ? row : nullptr;
}

std::string unknownOption(std::string_view word, Command command) {
  std::vector<std::string_view> candidates;
  std::string_view name = word.substr(0, word.find('='));
  for (const OptionRow& row : kOptions)
    if (row.help != nullptr && (row.commands & bit(command))) candidates.push_back(row.name);
  return withSuggestion("unknown option " + backquoted(name) + " of `rung " + commandName(command) + "`", name,
                        candidates) +
         " (`rung " + commandName(command) + " --help` lists all)";
}

std::string elsewhere(const OptionRow& row, Command command) {
  std::string message =
      backquoted(row.name) + " is not an option of `rung " + commandName(command) + "`; it belongs to";
  const char* separator = " ";
  for (const CommandRow& other : kCommands) {
    if (!(row.commands & bit(other.command))) continue;
    message += separator + backquoted(std::string("rung ") + other.name);
    separator = ", ";
  }
  return message;
}

Command findCommand(std::string_view word) {
  for (const CommandRow& row : kCommands)
    if (word == row.name) return row.command;
  if (word == "help" || word == "--help" || word == "-h") return Command::Help;
  if (word == "--version" || word == "-V") return Command::Version;
  return Command::None;
}

std::string checkCombination(const Options& options) {
  const std::string name = commandName(options.command);
  switch (options.command) {
    case Command::Check:
    case Command::Run:
    case Command::Test:
    case Command::Emit:
    case Command::Build:
    case Command::Convert:
    case Command::Graph:
    case Command::Fmt: break;  // without inputs: the project around the current folder
    case Command::Explain:
      if (options.inputs.size() != 1) return "`rung explain` takes one code, such as E0401";
      break;
    case Command::List:
      if (options.inputs.empty() && options.signature.empty())
        return "`rung list` takes `libraries`, `pous FILE|DIR ...`, `tasks FILE|DIR ...`, `warnings` or `--signature "
               "NAME`";
      break;
    case Command::New:
      if (options.inputs.size() != 1) return "`rung new` takes one name, that of the folder to make";
      break;
    case Command::Init:
      if (options.inputs.size() > 1) return "`rung init` takes one folder";
      break;
    case Command::Cam:
      if (options.inputs.empty()) return "`rung cam` needs a subcommand: law, check, show, convert or fit";
      break;
    case Command::None:
    case Command::Version:
    case Command::Help: break;
  }
  if (options.command == Command::Emit) {
    if (options.emit == EmitKind::Cpp && options.output.empty() && !options.list_outputs)
      return "`rung emit` needs a folder for the C++ files: add `-o DIR`, or `--emit=ir` to print the IR";
    if (options.emit != EmitKind::Cpp) {
      if (!options.output.empty() || !options.depfile.empty() || options.list_outputs || options.bundles > 0)
        return "`--emit=ir` and `--emit=tree` print to stdout and take no `-o`, `--depfile`, `--list-outputs` or "
               "`--bundles`";
    }
    if (!options.depfile_target.empty() && options.depfile.empty()) return "`--depfile-target` needs `--depfile`";
    if (!options.depfile.empty() && options.output.empty() && options.depfile_target.empty())
      return "`--depfile` needs `-o` or `--depfile-target`";
  }
  if (!options.diagnostics_path.empty() && options.separate)
    return "`--diagnostics` and `--separate` cannot be combined; each file is a project of its own";
  if (options.command == Command::List && options.format == DiagnosticFormat::Sarif)
    return "`rung list` takes `--format=text` or `--format=json`";
  const bool native = options.engine == Engine::Native || options.keep;
  if (options.counts() && native)
    return std::string(options.coverage ? "`--coverage`" : "`--lcov`") + " needs the interpreter; remove " +
           (options.keep ? "`--keep`" : "`--engine=native`");
  for (const std::string& argument : options.host_arguments)
    if (argument == "--trace-calls" && native)
      return std::string("`--trace-calls` needs the interpreter; remove ") +
             (options.keep ? "`--keep`" : "`--engine=native`");
  if (options.command == Command::Convert && (options.output.empty() || options.to == ConvertTo::None))
    return "`rung convert` needs a target and a folder: add `--to st|xml|mes -o DIR`";
  if (options.splits && options.to != ConvertTo::St) return "`--split` goes with `--to st`: other formats are one file";
  if (options.command == Command::Graph && options.output.empty())
    return "`rung graph` needs a folder for the pictures: add `-o DIR`";
  if (options.command == Command::Fmt && options.lines.last != UINT32_MAX && options.inputs.size() != 1)
    return "`--lines` takes one file";
  if (options.command == Command::Build && options.output.empty())
    return "`rung build` needs a name for its output: add `-o FILE`";
  return {};
}

void appendRow(std::string& out, const std::string& left, const char* help) {
  constexpr size_t kColumn = 28;
  out += "  " + left;
  if (left.size() + 2 >= kColumn)
    out += "\n" + std::string(kColumn, ' ');
  else
    out.append(kColumn - 2 - left.size(), ' ');
  for (const char* c = help; *c != '\0'; c++) {
    out += *c;
    if (*c == '\n') out.append(kColumn, ' ');
  }
  out += '\n';
}

std::string synopsis(const OptionRow& row) {
  std::string out = row.name;
  if (row.value == nullptr) return out;
  if (row.key == Key::Level || row.key == Key::Warning) return out + row.value;
  return out + (out.starts_with("--") ? "=" : " ") + row.value;
}

}  // namespace

bool readsProject(Command command) { return command >= Command::Check && command <= Command::Fmt; }

const char* commandName(Command command) {
  for (const CommandRow& row : kCommands)
    if (row.command == command) return row.name;
  return "help";
}

std::vector<CommandDescription> describeCommands() {
  std::vector<CommandDescription> commands;
  for (const CommandRow& row : kCommands) {
    CommandDescription command{row.name, row.arguments, row.summary, {}};
    for (const OptionRow& option : kOptions)
      if (option.help != nullptr && (option.commands & bit(row.command)) != 0)
        command.options.push_back({option.name, option.value == nullptr ? "" : option.value, option.help});
    commands.push_back(std::move(command));
  }
  return commands;
}

std::string expandResponseFiles(std::vector<std::string>& arguments) {
  uint32_t files = 0;
  for (size_t i = 0; i < arguments.size(); i++) {
    if (arguments[i].size() < 2 || arguments[i][0] != '@') continue;
    std::string path = arguments[i].substr(1);
    if (++files > 100) return "more than 100 response files; does " + backquoted(arguments[i]) + " include itself?";
    ReadResult read = readFile(path);
    if (!read.error.empty()) return "cannot read response file " + backquoted(path) + ": " + read.error;

    std::vector<std::string> inner;
    std::string word;
    bool in_word = false;
    char quote = 0;
    for (size_t k = 0; k < read.content.size(); k++) {
      char c = read.content[k];
      if (c == '\\' && quote != '\'' && k + 1 < read.content.size()) {
        word += read.content[++k];
        in_word = true;
      } else if (quote != 0) {
        if (c == quote)
          quote = 0;
        else
          word += c;
      } else if (c == '\'' || c == '"') {
        quote = c;
        in_word = true;
      } else if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
        if (in_word) inner.push_back(std::move(word));
        word.clear();
        in_word = false;
      } else {
        word += c;
        in_word = true;
      }
    }
    if (quote != 0) return "response file " + backquoted(path) + " ends inside a quoted word";
    if (in_word) inner.push_back(std::move(word));
    arguments.erase(arguments.begin() + static_cast<ptrdiff_t>(i));
    arguments.insert(arguments.begin() + static_cast<ptrdiff_t>(i), std::make_move_iterator(inner.begin()),
                     std::make_move_iterator(inner.end()));
    i--;  // the first of the new arguments may be a response file too
  }
  return {};
}

std::string parseOptions(const std::vector<std::string>& arguments, Options& options) {
  if (arguments.empty()) return "expected a command; `rung --help` lists all";
  options.command = findCommand(arguments[0]);
  if (options.command == Command::None) {
    for (const std::string_view later : kLaterCommands)
      if (arguments[0] == later) return "`rung " + arguments[0] + "` is not supported in this version of rung";
    std::vector<std::string_view> names;
    for (const CommandRow& row : kCommands) names.push_back(row.name);
    return withSuggestion("unknown command " + backquoted(arguments[0]), arguments[0], names) +
           " (`rung --help` lists all)";
  }
  if (options.command == Command::Help) {
    options.help = true;
    if (arguments.size() > 1) options.command = findCommand(arguments[1]);
    if (options.command == Command::Help) options.command = Command::None;
    return {};
  }

  bool only_inputs = false;
  for (size_t i = 1; i < arguments.size(); i++) {
    const std::string& word = arguments[i];
    if (only_inputs || word.empty() || word[0] != '-' || word == "-") {
      if (word.empty()) return "an input has an empty name";
      options.inputs.push_back(word);
      continue;
    }
    if (word == "--") {
      only_inputs = true;
      continue;
    }

    const size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    const OptionRow* row = findOption(word.substr(0, equals));
    std::string value;
    bool has_value = equals != std::string::npos;
    if (has_value) value = word.substr(equals + 1);
    if (row == nullptr) {
      row = findGlued(word);
      if (row != nullptr) {
        value = word.substr(2);
        has_value = true;
      }
    }
    if (row == nullptr) return unknownOption(word, options.command);
    if (!(row->commands & bit(options.command))) return elsewhere(*row, options.command);
    if (row->value == nullptr && has_value) return backquoted(row->name) + " takes no value";
    if (row->value != nullptr && !has_value) {
      if (i + 1 >= arguments.size()) return backquoted(row->name) + " needs a value: " + synopsis(*row);
      value = arguments[++i];
    }
    if (row->value != nullptr && value.empty()) return backquoted(row->name) + " has an empty value";
    std::string error = apply(*row, value, options);
    if (!error.empty()) return error;
  }
  if (options.help) return {};
#ifndef NDEBUG
  options.verify = true;
#endif
  const char* verify = std::getenv("RUNG_VERIFY");
  if (verify != nullptr && verify[0] != '\0') options.verify = verify[0] != '0';
  return checkCombination(options);
}

std::string helpText(Command command) {
  std::string out;
  if (command == Command::None || command == Command::Help) {
    out = "rung: a compiler for the languages of IEC 61131-3\n\nusage: rung COMMAND [options] [FILE|DIR ...]\n\n";
    for (const CommandRow& row : kCommands) appendRow(out, row.name, row.summary);
    out +=
        "\n`rung COMMAND --help` lists the options of a command. Inputs are files or\n"
        "folders, by default the project around the current folder; `@file` reads\n"
        "arguments from a file. Diagnostics go to stderr.\n\n"
        "exit codes: 0 success, 1 the input has errors, 2 usage or I/O error, 3 the\n"
        "program faulted, 4 a test failed, 70 internal error\n";
    return out;
  }
  for (const CommandRow& row : kCommands)
    if (row.command == command)
      out = std::string("rung ") + row.name + ": " + row.summary + "\n\nusage: rung " + row.name;
  std::string options;
  for (const OptionRow& row : kOptions)
    if (row.help != nullptr && (row.commands & bit(command))) appendRow(options, synopsis(row), row.help);
  if (!options.empty()) out += " [options]";
  for (const CommandRow& row : kCommands)
    if (row.command == command && row.arguments[0] != '\0') out += std::string(" ") + row.arguments;
  out += '\n';
  if (!options.empty()) out += "\noptions:\n" + options;
  if (command == Command::New) out += "\ntemplates:\n" + templateHelp();
  return out;
}

}  // namespace rung::tool
