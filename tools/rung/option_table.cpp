// SPDX-License-Identifier: Apache-2.0
// The tables of the command line; see option_table.h.
#include "tools/rung/option_table.h"

#include "frontend/source/dialect.h"
#include "rung/host.h"

namespace rung::tool {
namespace {

constexpr uint32_t kRuns = bit(Command::Run) | bit(Command::Monitor);
constexpr uint32_t kRunsOrDebugs = kRuns | bit(Command::Debug);
constexpr uint32_t kCompile =
    bit(Command::Check) | bit(Command::Emit) | bit(Command::Build) | kRunsOrDebugs | bit(Command::Test);
constexpr uint32_t kReads =
    kCompile | bit(Command::List) | bit(Command::Convert) | bit(Command::Graph) | bit(Command::Fmt);
constexpr uint32_t kReadsOrServes = kReads | bit(Command::Lsp);
constexpr uint32_t kAll = ~0u;

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
    {Command::Monitor, "monitor", "URL COMMAND ... | [FILE|DIR ...]", "watch and change a running program"},
    {Command::Debug, "debug", "[FILE|DIR ...]", "stop, step, look, and step back"},
    {Command::Lsp, "lsp", "", "serve an editor (language server protocol)"},
    {Command::Dap, "dap", "", "serve an editor (debug adapter protocol)"},
    {Command::Explain, "explain", "CODE", "print the page of a diagnostic, such as E0401"},
    {Command::Version, "version", "", "print the version and where the runtime is"},
};

// N, a number from `low` to `high`.
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

// The field at the end of a path of member pointers: `fieldOf<&CommandLine::test, &TestOptions::junit>(line)`.
template <auto... path>
auto& fieldOf(CommandLine& line) {
  return (line.*....*path);
}

// Each of the next functions sets the field at the end of its path.
template <auto... path>
std::string setFlag(const OptionRow&, const std::string&, CommandLine& line) {
  fieldOf<path...>(line) = true;
  return {};
}

template <auto... path>
std::string setText(const OptionRow&, const std::string& value, CommandLine& line) {
  fieldOf<path...>(line) = value;
  return {};
}

template <auto... path>
std::string addText(const OptionRow&, const std::string& value, CommandLine& line) {
  fieldOf<path...>(line).push_back(value);
  return {};
}

template <uint32_t low, uint32_t high, auto... path>
std::string setNumber(const OptionRow& row, const std::string& value, CommandLine& line) {
  return parseNumber(row.name, value, low, high, fieldOf<path...>(line));
}

// The values of the row are those of an enumeration, from `first` on.
template <auto first, auto... path>
std::string setChoice(const OptionRow& row, const std::string& value, CommandLine& line) {
  uint32_t choice = 0;
  std::string error = parseChoice(row.name, value, row.value, choice);
  fieldOf<path...>(line) = static_cast<decltype(first)>(static_cast<uint32_t>(first) + choice);
  return error;
}

// How the program of `rung run`, or the tests, are run.
RunOptions& runOf(CommandLine& line) { return line.command == Command::Test ? line.test.run : line.run; }

NativeOptions& nativeOf(CommandLine& line) {
  return line.command == Command::Build ? line.build.native : runOf(line).native;
}

std::string& outputOf(CommandLine& line) {
  if (line.command == Command::Emit) return line.emit.output;
  if (line.command == Command::Build) return line.build.output;
  if (line.command == Command::Convert) return line.convert.output;
  if (line.command == Command::Graph) return line.graph.output;
  return line.cam_output;
}

std::string setOutput(const OptionRow&, const std::string& value, CommandLine& line) {
  std::string& output = outputOf(line);
  if (!output.empty()) return "`-o` is given twice";
  output = value;
  return {};
}

// A:B
std::string setLines(const OptionRow&, const std::string& value, CommandLine& line) {
  constexpr uint32_t kMost = 1'000'000'000;
  format::LineRange& lines = line.fmt.lines;
  const size_t colon = value.find(':');
  if (colon == std::string::npos) return "`--lines` takes the first and the last line, as in `--lines=10:20`";
  std::string error = parseNumber("--lines", value.substr(0, colon), 1, kMost, lines.first);
  if (error.empty()) error = parseNumber("--lines", value.substr(colon + 1), lines.first, kMost, lines.last);
  return error;
}

template <BuildKind kind>
std::string setBuildKind(const OptionRow&, const std::string&, CommandLine& line) {
  if (line.build.kind != BuildKind::Executable && line.build.kind != kind)
    return "`--shared` and `--static` cannot be combined";
  line.build.kind = kind;
  return {};
}

template <FixSet fixes>
std::string setFixes(const OptionRow&, const std::string&, CommandLine& line) {
  line.check.fixes = fixes;
  return {};
}

std::string setDiff(const OptionRow&, const std::string&, CommandLine& line) {
  (line.command == Command::Check ? line.check.shows_changes : line.fmt.shows_changes) = true;
  return {};
}

std::string setKeep(const OptionRow&, const std::string&, CommandLine& line) {
  nativeOf(line).keep = true;
  return {};
}

std::string setJobs(const OptionRow& row, const std::string& value, CommandLine& line) {
  return parseNumber(row.name, value, 1, 1024, nativeOf(line).jobs);
}

std::string setEngine(const OptionRow& row, const std::string& value, CommandLine& line) {
  uint32_t choice = 0;
  std::string error = parseChoice(row.name, value, row.value, choice);
  runOf(line).engine = choice == 0 ? Engine::Native : Engine::Interpreter;
  return error;
}

std::string addHostArgument(const OptionRow& row, const std::string& value, CommandLine& line) {
  runOf(line).host_arguments.push_back(row.value != nullptr ? row.name + ("=" + value) : row.name);
  return {};
}

// A run takes its limits from the host, a test has its own.
std::string setLimit(const OptionRow& row, const std::string& value, CommandLine& line) {
  if (line.command != Command::Test) addHostArgument(row, value, line);
  return std::string_view(row.name) == "--timeout" ? host::parseTimeout(value, line.test.timeout_ns)
                                                   : host::parseMaxSteps(value, line.test.max_steps);
}

template <int64_t CodeOptions::*period>
std::string setPeriod(const OptionRow&, const std::string& value, CommandLine& line) {
  return host::parseTimeout(value, line.project.code.*period);
}

std::string setName(const OptionRow& row, const std::string& value, CommandLine& line) {
  if (line.command == Command::Cam) return setCamOption(row.name, value, line.cam);
  if (!isModuleName(value)) return backquoted(value) + " is not a C identifier; `--name` takes letters, digits and `_`";
  if (value == "rung" || value.starts_with("rung_"))
    return "the names of the runtime begin with `rung_`; choose another `--name` than " + backquoted(value);
  line.project.name = value;
  return {};
}

std::string setDialect(const OptionRow&, const std::string& value, CommandLine& line) {
  line.project.dialect_given = true;
  return parseDialect(value, line.project.dialect);
}

std::string setNativeWidth(const OptionRow&, const std::string& value, CommandLine& line) {
  line.project.code.native_width_given = true;
  return parseNativeWidth(value, line.project.code.native_width);
}

std::string setEdgeCoils(const OptionRow&, const std::string& value, CommandLine& line) {
  line.project.code.edge_coils_given = true;
  return parseEdgeCoils(value, line.project.code.edge_coils);
}

std::string setChecks(const OptionRow&, const std::string& value, CommandLine& line) {
  line.project.code.checks_given = true;
  return parseChecks(value, line.project.code.checks);
}

std::string setLevel(const OptionRow& row, const std::string& value, CommandLine& line) {
  uint32_t choice = 0;
  std::string error = parseChoice(row.name, value, row.value, choice);
  line.project.code.level_given = true;
  line.project.code.level = static_cast<int>(choice);
  return error;
}

std::string addWarning(const OptionRow&, const std::string& value, CommandLine& line) {
  ReportOptions& report = line.project.report;
  if (value == "error")
    report.werror = true;
  else if (value.starts_with("no-"))
    report.warnings.push_back({value.substr(3), false});
  else
    report.warnings.push_back({value, true});
  return {};
}

std::string setMaxErrors(const OptionRow& row, const std::string& value, CommandLine& line) {
  uint32_t& most = line.project.report.max_errors;
  std::string error = parseNumber(row.name, value, 0, 1'000'000'000, most);
  if (error.empty() && most == 0) most = ~0u;
  return error;
}

std::string addDefine(const OptionRow&, const std::string& value, CommandLine& line) {
  return parseDefine(value, line.project.defines);
}

std::string setPointerSize(const OptionRow& row, const std::string& value, CommandLine& line) {
  uint32_t choice = 0;
  std::string error = parseChoice(row.name, value, row.value, choice);
  line.project.code.pointer_size = choice == 0 ? 8 : 4;
  return error;
}

std::string setCam(const OptionRow& row, const std::string& value, CommandLine& line) {
  return setCamOption(row.name, value, line.cam);
}

constexpr OptionRow kOptions[] = {
    {"-o", "PATH",
     bit(Command::Emit) | bit(Command::Build) | bit(Command::Convert) | bit(Command::Graph) | bit(Command::Cam),
     setOutput, "output file or folder"},
    {"--emit", "cpp|ir|tree", bit(Command::Emit), setChoice<EmitKind::Cpp, &CommandLine::emit, &EmitOptions::kind>,
     "cpp to files, ir or tree to stdout (default: cpp)"},
    {"--to", "st|xml|mes", bit(Command::Convert), setChoice<ConvertTo::St, &CommandLine::convert, &ConvertOptions::to>,
     "Structured Text, PLCopen XML or messages of NCT"},
    {"--split", nullptr, bit(Command::Convert), setFlag<&CommandLine::convert, &ConvertOptions::splits>,
     "to ST: one file for each POU, also of files in ST"},
    {"--page-width", "N", bit(Command::Graph), setNumber<0, 1'000'000, &CommandLine::graph, &GraphOptions::page_width>,
     "wrap networks at N pixels; 0: never (default: 1200)"},
    {"--check", nullptr, bit(Command::Fmt), setFlag<&CommandLine::fmt, &FormatOptions::only_checks>,
     "write nothing; list files to change, exit 1"},
    {"--fix", nullptr, bit(Command::Check), setFixes<FixSet::Sure>, "apply the fixes that are sure, in place"},
    {"--fix=all", nullptr, bit(Command::Check), setFixes<FixSet::All>,
     "apply proposals too, the first of each message"},
    {"--diff", nullptr, bit(Command::Check) | bit(Command::Fmt), setDiff, "write nothing; print what would change"},
    {"--lines", "A:B", bit(Command::Fmt), setLines, "change only lines A to B, of one file"},
    {"--depfile", "FILE", bit(Command::Emit), setText<&CommandLine::emit, &EmitOptions::depfile>,
     "write a make rule that lists every file read"},
    {"--depfile-target", "PATH", bit(Command::Emit), setText<&CommandLine::emit, &EmitOptions::depfile_target>,
     "the rule's target (default: DIR/rung.manifest)"},
    {"--list-outputs", nullptr, bit(Command::Emit), setFlag<&CommandLine::emit, &EmitOptions::list_outputs>,
     "print the file names without writing the files"},
    {"--bundles", "N", bit(Command::Emit), setNumber<1, 1000, &CommandLine::emit, &EmitOptions::bundles>,
     "write N more files that include all the others"},
    {"--shared", nullptr, bit(Command::Build), setBuildKind<BuildKind::Shared>, "make a shared library"},
    {"--static", nullptr, bit(Command::Build), setBuildKind<BuildKind::Static>, "make a static library"},
    {"-g", nullptr, bit(Command::Build), setFlag<&CommandLine::build, &BuildOptions::debug>,
     "for gdb, with names and values of ST; default: -O0"},
    {"--symbols", "FILE", bit(Command::Build), setText<&CommandLine::build, &BuildOptions::symbols>,
     "write where the variables are, as JSON"},
    {"--keep", nullptr, bit(Command::Build) | kRuns | bit(Command::Test), setKeep,
     "keep the generated C++ and print its folder"},
    {"--engine", "native|interp", kRuns | bit(Command::Test), setEngine,
     "compile to C++, or interpret (default: interp)"},
    {"--cycles", "N", kRunsOrDebugs, addHostArgument, "run N cycles (default: 100, or all of --inputs)"},
    {"--for", "T", kRunsOrDebugs, addHostArgument, "run for a time, such as T#2s"},
    {"--interval", "T", kRunsOrDebugs, addHostArgument, "cycle time if there are no tasks (default: T#10ms)"},
    {"--inputs", "FILE", kRunsOrDebugs, addHostArgument, "CSV (cycle,PATH,...): values set before each cycle"},
    {"--set", "PATH=VALUE", kRunsOrDebugs, addHostArgument, "set a variable before cycle 0; may be repeated"},
    {"--watch", "PATH,...", kRunsOrDebugs | bit(Command::Test), addHostArgument, "variables to trace (default: all)"},
    {"--trace", "FILE", kRunsOrDebugs | bit(Command::Test), addHostArgument,
     "write a CSV row after each cycle; - is stdout"},
    {"--plot", "FILE", kRuns | bit(Command::Test), addHostArgument, "plot the variables over time, as SVG"},
    {"--on-fault", "all|task", kRunsOrDebugs, addHostArgument, "what a fault stops (default: all tasks)"},
    {"--control", "FILE", kRuns, addHostArgument, "commands: stop, reset, get, set, force and others"},
    {"--watch-files", nullptr, kRunsOrDebugs, setFlag<&CommandLine::run, &RunOptions::watch_files>,
     "change the running program when its files change"},
    {"--rollback", "N", kRuns, addHostArgument, "go back when a new version faults within N cycles"},
    {"--monitor", "[ADDRESS:]PORT", kRuns, addHostArgument, "serve a page and tools there; 0: any free port"},
    {"--monitor-insecure", nullptr, kRuns, addHostArgument, "that address may be any, without encryption"},
    {"--driver", "LIB[=ARG]", kRuns, addHostArgument, "devices of a product: a library with rung_drivers"},
    {"--retain", "FILE", kRunsOrDebugs, addHostArgument, "keep retained variables in FILE between runs"},
    {"--retain-interval", "T", kRuns, addHostArgument, "how often the retain file is written (default: 1s)"},
    {"--start", "cold|warm|origin", kRunsOrDebugs, addHostArgument,
     "default: warm if the retain file exists, else cold"},
    {"--files-root", "DIR", kRunsOrDebugs, addHostArgument, "folder for the program's files (default: current)"},
    {"--serial", "N=DEVICE", kRunsOrDebugs, addHostArgument, "device of serial port N; may be repeated"},
    {"--stop-on", "CONDITION", kRunsOrDebugs, addHostArgument, "stop after the cycle that makes CONDITION TRUE"},
    {"--trace-forces", nullptr, kRuns, addHostArgument, "a column of the trace names forced variables"},
    {"--trace-calls", nullptr, kRuns, addHostArgument, "print which POUs ran in each cycle"},
    {"--realtime", nullptr, kRuns, addHostArgument, "run in real time"},
    {"--timeout", "T", kRuns | bit(Command::Test), setLimit, "end the run, or each test, after T (a test: 10s)"},
    {"--max-steps", "N", kRunsOrDebugs | bit(Command::Test), setLimit, "end an activation after N steps (100000000)"},
    {"--filter", "GLOB", bit(Command::Test), addText<&CommandLine::test, &TestOptions::filters>,
     "run only tests whose name matches; may be repeated"},
    {"--list", nullptr, bit(Command::Test), setFlag<&CommandLine::test, &TestOptions::list>,
     "run nothing; print which tests there are"},
    {"--allow-none", nullptr, bit(Command::Test), setFlag<&CommandLine::test, &TestOptions::allow_none>,
     "no test is not an error"},
    {"--junit", "FILE", bit(Command::Test), setText<&CommandLine::test, &TestOptions::junit>,
     "write the results as JUnit XML"},
    {"--coverage", nullptr, bit(Command::Test), setFlag<&CommandLine::test, &TestOptions::coverage>,
     "print which lines of the program ran"},
    {"--lcov", "FILE", bit(Command::Test), setText<&CommandLine::test, &TestOptions::lcov>,
     "write coverage for lcov and genhtml"},
    {"--separate", nullptr, bit(Command::Test), setFlag<&CommandLine::test, &TestOptions::separate>,
     "treat each file as a separate project"},
    {"--signature", "NAME", bit(Command::List), setText<&CommandLine::list, &ListOptions::signature>,
     "show the declaration of a function, block or type"},
    {"--template", "NAME", bit(Command::New), setText<&CommandLine::project_template>,
     "what kind of project (default: st)"},
    {"--rate", "N", bit(Command::Monitor), setNumber<1, 1000, &CommandLine::monitor_rate>,
     "of watch and trace: rows a second (default: 10)"},
    {"-x", "FILE", bit(Command::Debug), addText<&CommandLine::debug, &DebugOptions::scripts>,
     "take commands from FILE first; may be repeated"},
    {"-c", "COMMAND", bit(Command::Debug), addText<&CommandLine::debug, &DebugOptions::commands>,
     "then this command; may be repeated"},
    {"--batch", nullptr, bit(Command::Debug), setFlag<&CommandLine::debug, &DebugOptions::is_batch>,
     "end after these commands"},
    {"--test", "NAME", bit(Command::Debug), setText<&CommandLine::debug, &DebugOptions::test>,
     "debug a test instead of the program"},
    {"--history", "MB", bit(Command::Debug), setNumber<1, 65536, &CommandLine::debug, &DebugOptions::history_mb>,
     "memory for the way back (default: 64)"},
    {"--port", "N", bit(Command::Dap), setNumber<0, 65535, &CommandLine::debug, &DebugOptions::port>,
     "serve one client on this port of this machine"},
    {"--log", "FILE", bit(Command::Lsp), setText<&CommandLine::lsp_log>, "write every message to FILE"},
    {"--stroke", "S", bit(Command::Cam), setCam, "way of the slave (default: 1)"},
    {"--length", "X", bit(Command::Cam), setCam, "way of the master (default: 1)"},
    {"--v0", "V", bit(Command::Cam), setCam, "velocity at the begin, per unit of the master"},
    {"--v1", "V", bit(Command::Cam), setCam, "velocity at the end"},
    {"--a0", "A", bit(Command::Cam), setCam, "acceleration at the begin"},
    {"--a1", "A", bit(Command::Cam), setCam, "acceleration at the end"},
    {"--j0", "J", bit(Command::Cam), setCam, "jerk at the begin"},
    {"--j1", "J", bit(Command::Cam), setCam, "jerk at the end"},
    {"--turn", "Z", bit(Command::Cam), setCam, "turning point, from 0 to 1 (default: 0.5)"},
    {"--points", "N", bit(Command::Cam), setCam, "points of the table (default: 33)"},
    {"--speed", "V", bit(Command::Cam), setCam, "speed of the master (default: that of the file)"},
    {"--segments", "N", bit(Command::Cam), setCam, "most segments of a fit (default: 100)"},
    {"--tolerance", "E", bit(Command::Cam), setCam, "largest error (default: the noise of the points)"},
    {"--smooth", "c2|c3", bit(Command::Cam), setCam, "continuous acceleration, or jerk too (default: c2)"},
    {"--repeat", "KIND", bit(Command::Cam), setCam, "closed, relative or modulo:PERIOD"},
    {"--range", "X0:X1", bit(Command::Cam), setCam, "of the master (default: that of the points)"},
    {"--exact", "X:Y", bit(Command::Cam), setCam, "the curve goes through it; may be repeated"},
    {"--dwell", "X0:X1[:Y]", bit(Command::Cam), setCam, "the slave rests; may be repeated"},
    {"--max-velocity", "V", bit(Command::Cam), setCam, "limit of the slave, at --speed"},
    {"--max-acceleration", "A", bit(Command::Cam), setCam, "the same"},
    {"--max-jerk", "J", bit(Command::Cam), setCam, "the same"},
    {"--position", "LOW:HIGH", bit(Command::Cam), setCam, "limits of the slave"},
    {"--loss", "squares|huber|cauchy|tukey", bit(Command::Cam), setCam, "how errors count (default: squares)"},
    {"--loss-scale", "E", bit(Command::Cam), setCam, "error from which they count less"},
    {"--master-unit", "U", bit(Command::Cam), setCam, "unit in the file, such as deg"},
    {"--slave-unit", "U", bit(Command::Cam), setCam, "the same"},
    {"--std", "codesys|iec3|iec2", kReadsOrServes | bit(Command::Init), setDialect, "dialect (default: codesys)"},
    {"--native-width", "32|64", kCompile, setNativeWidth, "codesys: bits of intermediate results (default: 32)"},
    {"--edge-coils", "pulse|latch", kCompile | bit(Command::Convert), setEdgeCoils,
     "edge coils without an edge: FALSE (default), kept"},
    {"--plc-period", "T", kCompile, setPeriod<&CodeOptions::plc_period_ns>,
     "period of Main of an NCT program (default: T#10ms)"},
    {"--time-slice", "T", kCompile, setPeriod<&CodeOptions::time_slice_ns>,
     "period of Int0 of an NCT program (default: T#2ms)"},
    {"--checks", "LIST", kCompile, setChecks, "div,index,null,cast (default), more, all or none"},
    {"-O", "0|1|2", kCompile, setLevel, "optimization level (default: 1)"},
    {"-W", "NAME", kReadsOrServes, addWarning, "enable a warning by name or code; -Wno-NAME disables"},
    {"--werror", nullptr, kReads, setFlag<&CommandLine::project, &ProjectOptions::report, &ReportOptions::werror>,
     "treat warnings as errors"},
    {"--max-errors", "N", kReadsOrServes, setMaxErrors, "list N errors at most; 0: all (100; of lsp: 1000)"},
    {"--max-warnings", "N", kReads,
     setNumber<0, 1'000'000'000, &CommandLine::project, &ProjectOptions::report, &ReportOptions::max_warnings>,
     "list at most N of one warning; 0: all (default: 20)"},
    {"--format", "text|json|sarif", kReads,
     setChoice<DiagnosticFormat::Text, &CommandLine::project, &ProjectOptions::report, &ReportOptions::format>,
     "format of diagnostics and lists (default: text)"},
    {"--diagnostics", "FILE", kReads, setText<&CommandLine::project, &ProjectOptions::report, &ReportOptions::path>,
     "write diagnostics to FILE in that format, too"},
    {"--color", "auto|always|never", kReads | bit(Command::Explain), setChoice<Color::Auto, &CommandLine::color>,
     "use colours (auto: on a terminal; default: auto)"},
    {"-D", "NAME[=VALUE]", kReadsOrServes, addDefine, "define NAME for {IF defined (NAME)}; may be repeated"},
    {"-I", "PATH", kReadsOrServes, addText<&CommandLine::project, &ProjectOptions::library_paths>,
     "folder or file with libraries; may be repeated"},
    {"--root", "DIR", kReads, setText<&CommandLine::project, &ProjectOptions::root>,
     "make paths in the output relative to DIR"},
    {"--name", "ID", kCompile | bit(Command::Cam), setName, "prefix of the module's symbols, or name of the cam"},
    {"--target-pointer", "8|4", bit(Command::Emit) | bit(Command::Build), setPointerSize,
     "size of a pointer on the target (default: 8 bytes)"},
    {"--online-change", nullptr, bit(Command::Emit) | bit(Command::Build),
     setFlag<&CommandLine::project, &ProjectOptions::code, &CodeOptions::online_change>,
     "with tables for online changes"},
    {"-j", "N", bit(Command::Build) | kRuns | bit(Command::Test), setJobs,
     "number of C++ compilers to run in parallel"},
    {"--dump-after", "NAME", kCompile, setText<&CommandLine::project, &ProjectOptions::code, &CodeOptions::dump_after>,
     "print the result of parse, lower or a pass to stderr"},
    {"--time-phases", nullptr, kCompile, setFlag<&CommandLine::project, &ProjectOptions::time_phases>,
     "print the time and lines per second of each phase"},
    {"--verbose", nullptr, kReads, setFlag<&CommandLine::project, &ProjectOptions::verbose>,
     "print which project, files and libraries are read"},
    {"--help", nullptr, kAll, setFlag<&CommandLine::help>, nullptr},
    {"-h", nullptr, kAll, setFlag<&CommandLine::help>, nullptr},
};

}  // namespace

std::span<const CommandRow> commandRows() { return kCommands; }
std::span<const OptionRow> optionRows() { return kOptions; }

const OptionRow* findOption(std::string_view name) {
  for (const OptionRow& row : kOptions)
    if (name == row.name) return &row;
  return nullptr;
}

}  // namespace rung::tool
