// SPDX-License-Identifier: Apache-2.0
// The options of `rung run`, for the tool and for executables of `rung build`. See rung/host.h.
#include <sys/stat.h>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <iterator>

#include "crashes.h"
#include "monitor_access.h"
#include "rung/host.h"
#include "rung/values.h"
#include "symbols.h"

namespace rung::host {
namespace {

constexpr int64_t kMaxSerialPort = 255;

// Reads `T#10ms`, `10ms`, `1.5s` as nanoseconds, above 0.
bool readDuration(const std::string& text, int64_t& ns) {
  const std::string literal = text.find('#') == std::string::npos ? "LT#" + text : text;
  return rung_parse(RUNG_LTIME, true, 0, literal.data(), literal.size(), &ns) && ns > 0;
}

bool readCount(const std::string& text, int64_t& count) {
  const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), count);
  return read.ec == std::errc{} && read.ptr == text.data() + text.size() && count >= 0;
}

const char kHelp[] =
    "options\n"
    "  --cycles N            run N cycles of the fastest task (default: 100, or all of --inputs)\n"
    "  --for TIME            run for this time: --for T#2s\n"
    "  --interval TIME       cycle time if there are no tasks (default: T#10ms)\n"
    "  --inputs FILE         CSV with header cycle,PATH,...: values set before each cycle\n"
    "  --set PATH=VALUE      set a variable once, before cycle 0\n"
    "  --watch PATH,...      the variables to trace (default: all)\n"
    "  --trace FILE|-        write a CSV row after each cycle\n"
    "  --trace-forces        a column of the trace names the forced variables\n"
    "  --plot FILE           plot the variables over time, as SVG\n"
    "  --retain FILE         keep retained variables in FILE between runs\n"
    "  --retain-interval TIME   how often the file is written (default: 1s)\n"
    "  --files-root DIR      the folder for the program's files (default: the current one)\n"
    "  --start cold|warm|origin   default: warm if the retain file exists, else cold\n"
    "  --stop-on CONDITION   stop after the cycle that makes CONDITION TRUE: --stop-on 'Main.n >= 10'\n"
    "  --timeout TIME        end with exit code 3 after this real time (default: none)\n"
    "  --on-fault all|task   what a fault stops: all tasks (default), or the one that it is in\n"
    "  --control FILE        commands, each after the number of its cycle: stop, start, cycle, reset, get, set, force "
    "and\n"
    "                        others; in real time also a pipe\n"
    "  --monitor [ADDR:]PORT serve a page and tools (HTTP) at this port, 0: any; the program keeps pace with the "
    "clock\n"
    "  --monitor-insecure    the address may be one that other machines reach, without encryption\n"
    "  --rollback N          go back when a new version of the program faults within N cycles\n"
    "  --serial N=DEVICE     the device of serial port N of the program: --serial 1=/dev/ttyUSB0; may be repeated\n"
    "  --driver LIB[=ARG]    devices of a product: a shared library with the function rung_drivers\n"
    "  --realtime            run in real time, until the cycles are done or Ctrl-C\n";

}  // namespace

std::string parseTimeout(const std::string& text, int64_t& ns) {
  ns = 0;
  if (text == "0" || readDuration(text, ns)) return "";
  return "--timeout needs a time such as 10s, or 0 for none, not `" + text + "`";
}

std::string parseMaxSteps(const std::string& text, int64_t& steps) {
  return readCount(text, steps) ? "" : "--max-steps needs a number, or 0 for none, not `" + text + "`";
}

namespace {

// What each option does with its value. '': it is right; else the message.

std::string readTime(const char* option, const char* example, const std::string& value, int64_t& ns) {
  if (readDuration(value, ns)) return "";
  return std::string(option) + " needs a time such as " + example + ", not `" + value + "`";
}

std::string setRollback(const std::string& value, RunOptions& options) {
  return readCount(value, options.change.rollback_cycles) ? ""
                                                          : "--rollback needs a number of cycles, not `" + value + "`";
}

template <std::string RunOptions::*option>
std::string setString(const std::string& value, RunOptions& options) {
  options.*option = value;
  return "";
}

std::string addDriver(const std::string& value, RunOptions& options) {
  options.drivers.push_back(value);
  return "";
}

std::string addWatched(const std::string& value, RunOptions& options) {
  options.watch += (options.watch.empty() ? "" : ",") + value;
  return "";
}

std::string addPreset(const std::string& value, RunOptions& options) {
  const size_t separator = value.find('=');
  if (separator == std::string::npos || separator == 0) return "--set needs PATH=VALUE, not `" + value + "`";
  options.sets.emplace_back(value.substr(0, separator), value.substr(separator + 1));
  return "";
}

std::string setStopCondition(const std::string& value, RunOptions& options) {
  if (!options.stop_on.empty()) return "--stop-on is given twice; join the conditions with OR";
  if (value.empty()) return "--stop-on needs a condition such as 'Main.n >= 10'";
  options.stop_on = value;
  return "";
}

std::string setFilesRoot(const std::string& value, RunOptions& options) {
  struct stat info;
  if (stat(value.c_str(), &info) != 0 || !S_ISDIR(info.st_mode))
    return "--files-root needs an existing folder, not `" + value + "`";
  options.files_root = value;
  return "";
}

std::string addSerialPort(const std::string& value, RunOptions& options) {
  int64_t port = 0;
  const size_t separator = value.find('=');
  if (separator == std::string::npos || separator + 1 == value.size() || !readCount(value.substr(0, separator), port) ||
      port < 1 || port > kMaxSerialPort)
    return "--serial needs a port and its device, 1=/dev/ttyUSB0, not `" + value + "`";
  if (!options.serial.emplace(static_cast<uint32_t>(port), value.substr(separator + 1)).second)
    return "--serial: port " + std::to_string(port) + " is given twice";
  return "";
}

std::string setFaultScope(const std::string& value, RunOptions& options) {
  if (value != "task" && value != "all") return "--on-fault needs `all` or `task`, not `" + value + "`";
  options.others_go_on = value == "task";
  return "";
}

std::string setStart(const std::string& value, RunOptions& options) {
  const std::string start = lowerCase(value);
  if (start == "cold")
    options.start = RUNG_COLD;
  else if (start == "warm")
    options.start = RUNG_WARM;
  else if (start == "origin")
    options.start = RUNG_ORIGIN;
  else
    return "--start needs cold, warm or origin, not `" + value + "`";
  return "";
}

struct ValueOption {
  const char* name;
  std::string (*set)(const std::string& value, RunOptions& options);
};

using Value = const std::string&;
const ValueOption kValueOptions[] = {
    {"--cycles",
     [](Value value, RunOptions& options) -> std::string {
       return readCount(value, options.cycles) ? "" : "--cycles needs a number, not `" + value + "`";
     }},
    {"--for", [](Value value, RunOptions& options) { return readTime("--for", "T#2s", value, options.for_ns); }},
    {"--interval",
     [](Value value, RunOptions& options) { return readTime("--interval", "T#10ms", value, options.interval_ns); }},
    {"--timeout", [](Value value, RunOptions& options) { return parseTimeout(value, options.timeout_ns); }},
    {"--max-steps", [](Value value, RunOptions& options) { return parseMaxSteps(value, options.max_steps); }},
    {"--retain-interval",
     [](Value value, RunOptions& options) {
       return readTime("--retain-interval", "100ms", value, options.retain_interval_ns);
     }},
    {"--inputs", setString<&RunOptions::inputs_path>},
    {"--trace", setString<&RunOptions::trace_path>},
    {"--plot", setString<&RunOptions::plot_path>},
    {"--retain", setString<&RunOptions::retain_path>},
    {"--control", setString<&RunOptions::control_path>},
    {"--monitor",
     [](Value value, RunOptions& options) -> std::string {
       options.monitor.address = value;
       return "";
     }},
    {"--rollback", setRollback},
    {"--driver", addDriver},
    {"--watch", addWatched},
    {"--set", addPreset},
    {"--stop-on", setStopCondition},
    {"--files-root", setFilesRoot},
    {"--serial", addSerialPort},
    {"--on-fault", setFaultScope},
    {"--start", setStart},
};

// The option without a value; null: there is none of this name.
bool* flagOf(const std::string& name, RunOptions& options) {
  if (name == "--realtime") return &options.realtime;
  if (name == "--trace-calls") return &options.trace_calls;
  if (name == "--trace-forces") return &options.trace_forces;
  if (name == "--monitor-insecure") return &options.monitor.is_insecure;
  return nullptr;
}

std::string checkMonitor(const RunOptions& options) {
  const MonitorOptions& monitor = options.monitor;
  if (monitor.address.empty()) return monitor.is_insecure ? "--monitor-insecure needs --monitor" : "";
  MonitorAddress address;
  std::string error = readMonitorAddress(monitor.address, address);
  if (error.empty() && !address.isLoopback() && !monitor.is_insecure)
    error = "--monitor: other machines reach `" + monitor.address +
            "`, and what they send and read is not encrypted; add --monitor-insecure, or use a tunnel to 127.0.0.1";
  return error;
}

std::string contradiction(const RunOptions& options) {
  if (options.realtime && !options.stop_on.empty()) return "--stop-on works only in virtual time; remove --realtime";
  if (options.realtime && options.trace_calls) return "--trace-calls works only in virtual time; remove --realtime";
  if (options.trace_calls && options.trace_path == "-")
    return "--trace-calls and --trace - would both write to stdout; give --trace a file";
  if (options.trace_forces && options.trace_path.empty())
    return "--trace-forces adds a column to the trace; name its file with --trace";
  return checkMonitor(options);
}

}  // namespace

std::string parseRunOptions(const std::vector<std::string>& arguments, RunOptions& options,
                            std::vector<std::string>& rest) {
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const size_t equals = argument.find('=');
    const bool has_value = argument.compare(0, 2, "--") == 0 && equals != std::string::npos;
    const std::string name = has_value ? argument.substr(0, equals) : argument;
    if (bool* const flag = flagOf(name, options); flag != nullptr) {
      if (has_value) return name + " takes no value";
      *flag = true;
      continue;
    }
    const auto option = std::find_if(std::begin(kValueOptions), std::end(kValueOptions),
                                     [&](const ValueOption& known) { return name == known.name; });
    if (option == std::end(kValueOptions)) {
      rest.push_back(argument);
      continue;
    }
    if (!has_value && i + 1 == arguments.size()) return name + " needs a value";
    const std::string value = has_value ? argument.substr(equals + 1) : arguments[++i];
    if (std::string error = option->set(value, options); !error.empty()) return error;
  }
  return contradiction(options);
}

int applicationMain(const rung_module& module, int argc, char** argv, const rung_pou_view* pous) {
  signal(SIGXFSZ, SIG_IGN);  // makes exceeding a file size limit a write error, like a full disk
  catchCrashes();
  RunOptions options;
  std::vector<std::string> rest;
  const std::string problem =
      parseRunOptions(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc), options, rest);
  if (!problem.empty()) {
    fprintf(stderr, "error: %s\n", problem.c_str());
    return 2;
  }
  if (options.trace_calls) {
    fputs("error: --trace-calls needs the interpreter: use `rung run`\n", stderr);
    return 2;
  }
  for (const std::string& argument : rest) {
    if (argument == "--help" || argument == "-h") {
      printf("%s, compiled by %s\n%s", module.name, module.compiler, kHelp);
      return 0;
    }
    if (argument == "--version") {
      printf("%s, compiled by %s\n", module.name, module.compiler);
      return 0;
    }
    fprintf(stderr, "error: unknown option `%s`; --help lists all\n", argument.c_str());
    return 2;
  }
  for (; pous != nullptr && pous->name != nullptr; ++pous) options.monitor.pous.push_back(*pous);
  return run(module, options);
}

}  // namespace rung::host
