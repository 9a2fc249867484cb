// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/terminal.h"

#include <signal.h>
#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <fstream>
#include <iostream>
#include <map>

#include "stdlib/runtime/host/inputs.h"
#include "tools/debug/line_editor.h"
#include "tools/driver/commands.h"

namespace rung::debug {
namespace {

constexpr size_t kListedLines = 10;

// The first word, and the rest.
std::pair<std::string, std::string> splitWord(std::string_view line) {
  line = host::trimmed(line);
  const size_t end = line.find_first_of(" \t");
  if (end == std::string_view::npos) return {std::string(line), ""};
  return {std::string(line.substr(0, end)), std::string(host::trimmed(line.substr(end)))};
}

int64_t numberOr(const std::string& text, int64_t otherwise) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos || text.size() > 18) return otherwise;
  return std::stoll(text);
}

Execution* interruptible = nullptr;
void onInterrupt(int) {
  if (interruptible != nullptr) interruptible->interrupt();
}

class Terminal {
 public:
  Terminal(Target& target, std::FILE* out) : debugger_(*target.debugger), out_(out) {}

  // False: the session ends.
  bool obey(const std::string& line);
  int exitCode() const { return exit_code_; }
  LineEditor::Completion completionOf(const std::string& line);

 private:
  struct Command {
    const char *name, *arguments, *help;
    void (Terminal::*run)(const std::string& arguments);
  };
  static const Command kCommands[];

  void say(const std::string& text) {
    fputs(text.c_str(), out_);
    if (text.empty() || text.back() != '\n') fputc('\n', out_);
  }

  // ---- running
  void run(const std::string&) {
    if (execution().now() != Moment{}) execution().restart();
    show(debugger_.resume());
  }
  void start(const std::string&) {
    if (execution().now() != Moment{}) execution().restart();
    show(debugger_.step(StepKind::Into, Granularity::Statement));
  }
  void resume(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.resume(); });
  }
  void next(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.step(StepKind::Over, Granularity::Line); });
  }
  void step(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.step(StepKind::Into, Granularity::Line); });
  }
  void network(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.step(StepKind::Over, Granularity::Network); });
  }
  void nextStatement(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.step(StepKind::Into, Granularity::Statement); });
  }
  void finish(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.step(StepKind::Out, Granularity::Line); });
  }
  void cycle(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.step(StepKind::Cycle, Granularity::Line); });
  }
  void activation(const std::string& arguments) {
    uint32_t task = debugger_.task();
    if (!arguments.empty() && !findTask(arguments, task)) return say("there is no task `" + arguments + "`");
    show(debugger_.step(StepKind::Activation, Granularity::Line, task == 0 ? 1 : task));
  }
  void until(const std::string& arguments) {
    std::string file;
    uint32_t line = 0, column = 0;
    if (!parseLocation(arguments, file, line, column)) return say("until takes LINE or FILE:LINE");
    show(debugger_.runTo(file, line));
  }
  void goTo(const std::string& arguments) {
    const int64_t wanted = numberOr(arguments, -1);
    if (wanted < 0) return say("goto takes the number of a cycle");
    show(debugger_.goToCycle(wanted));
  }
  void back(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.stepBack(Granularity::Line); });
  }
  void backStatement(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.stepBack(Granularity::Statement); });
  }
  void reverse(const std::string& arguments) {
    repeat(arguments, [this] { return debugger_.reverse(); });
  }
  void lastWrite(const std::string& arguments) { show(debugger_.lastWrite(arguments)); }
  template <class Do>
  void repeat(const std::string& arguments, Do once) {
    Stop stop;
    for (int64_t left = std::max<int64_t>(numberOr(arguments, 1), 1); left > 0; --left) {
      stop = once();
      if (stop.reason != Stop::Step && left > 1) break;
    }
    show(stop);
  }

  // ---- breakpoints
  void setBreakpoint(const std::string& arguments) { addBreakpoint(arguments, false); }
  void setTemporary(const std::string& arguments) { addBreakpoint(arguments, true); }
  void addBreakpoint(const std::string& arguments, bool is_temporary);
  void watch(const std::string& arguments);
  void remove(const std::string& arguments);
  void condition(const std::string& arguments);
  void ignore(const std::string& arguments);
  void logPoint(const std::string& arguments);
  void catchKind(const std::string& arguments);
  void apply();

  // ---- looking
  void print(const std::string& arguments);
  void set(const std::string& arguments);
  void force(const std::string& arguments);
  void unforce(const std::string& arguments) { report(debugger_.unforce(arguments.empty() ? "*" : arguments)); }
  void display(const std::string& arguments);
  void undisplay(const std::string&) { displayed_.clear(); }
  void backtrace(const std::string&);
  void up(const std::string& arguments) { select(frame_ + numberOr(arguments, 1)); }
  void down(const std::string& arguments) { select(frame_ - numberOr(arguments, 1)); }
  void frame(const std::string& arguments) { select(numberOr(arguments, frame_)); }
  void list(const std::string& arguments);
  void info(const std::string& arguments);
  void help(const std::string& arguments);
  void quit(const std::string&) { ends_ = true; }

  void report(const std::string& error) {
    if (!error.empty()) say(error);
  }
  void select(int64_t number);
  void show(const Stop& stop);
  void showPlace(bool with_pou);
  void showDisplayed();
  void showVariables(const std::vector<ShownVariable>& variables, const std::string& prefix);
  std::string textOf(const Evaluated& value);
  std::string contentOf(const Variable& place, uint32_t depth);
  bool parseLocation(const std::string& text, std::string& file, uint32_t& line, uint32_t& column);
  bool findTask(const std::string& name, uint32_t& number);
  std::string taskName(uint32_t number);
  const std::vector<std::string>& linesOf(const std::string& path);
  const DebugFrame* selected() {
    std::vector<DebugFrame>& frames = debugger_.frames();
    return frame_ < static_cast<int64_t>(frames.size()) ? &frames[static_cast<size_t>(frame_)] : nullptr;
  }
  Execution& execution() { return debugger_.execution(); }

  Debugger& debugger_;
  std::FILE* out_;
  bool ends_ = false;
  int exit_code_ = 0;
  int64_t frame_ = 0;
  uint32_t list_line_ = 0;
  std::string list_file_;
  std::vector<std::string> displayed_;
  std::map<std::string, std::vector<std::string>> sources_;
  std::string last_pou_;
  // Of the user, with numbers that stay.
  struct Wish {
    uint32_t number;
    enum Kind : uint8_t { Line, Pou, Data } kind;
    std::string file;
    BreakpointWish wish;
    bool is_temporary;
    uint32_t id = 0;
    std::string problem;
    uint32_t line = 0;
  };
  std::vector<Wish> wishes_;
  uint32_t next_number_ = 1;
  Debugger::Exceptions exceptions_;
  std::string last_line_;
};

const Terminal::Command Terminal::kCommands[] = {
    {"activation", "[TASK]", "to the next activation of a task", &Terminal::activation},
    {"back", "[N]", "to the line before", &Terminal::back},
    {"backi", "[N]", "to the statement before", &Terminal::backStatement},
    {"backtrace", "", "the calls, the innermost first", &Terminal::backtrace},
    {"break", "[FILE:]LINE[:COLUMN] | POU [if CONDITION]", "stop there", &Terminal::setBreakpoint},
    {"catch", "fault|uncaught|assert|none", "stop at faults, at those that no __TRY handles, at failed assertions",
     &Terminal::catchKind},
    {"condition", "NUMBER [CONDITION]", "when a breakpoint counts", &Terminal::condition},
    {"continue", "[N]", "until something stops it", &Terminal::resume},
    {"cycle", "[N]", "to the first statement of the next cycle", &Terminal::cycle},
    {"delete", "[NUMBER]", "a breakpoint, or all", &Terminal::remove},
    {"display", "EXPRESSION", "print it at each stop", &Terminal::display},
    {"down", "[N]", "to the call that is further inside", &Terminal::down},
    {"finish", "[N]", "until this call returns", &Terminal::finish},
    {"force", "PATH = VALUE", "hold a variable at a value", &Terminal::force},
    {"frame", "N", "choose a call", &Terminal::frame},
    {"goto", "N", "to the begin of cycle N, also back", &Terminal::goTo},
    {"help", "[COMMAND]", "this list", &Terminal::help},
    {"hits", "NUMBER COUNT", "the hit at which a breakpoint stops: 5, >= 5, % 10", &Terminal::ignore},
    {"info", "breakpoints|tasks|locals|instance|globals|image|history", "lists", &Terminal::info},
    {"lastwrite", "PATH", "back to the statement that changed a variable last", &Terminal::lastWrite},
    {"list", "[LINE]", "the source", &Terminal::list},
    {"log", "LOCATION TEXT", "print a text with {expressions} there, without a stop", &Terminal::logPoint},
    {"network", "[N]", "to the next network or rung", &Terminal::network},
    {"next", "[N]", "to the next line of this call", &Terminal::next},
    {"print", "EXPRESSION", "a value; prev(x) is that before the cycle", &Terminal::print},
    {"quit", "", "end", &Terminal::quit},
    {"reverse-continue", "[N]", "back until something stops it", &Terminal::reverse},
    {"run", "", "from the begin", &Terminal::run},
    {"set", "VARIABLE := VALUE", "change a variable", &Terminal::set},
    {"start", "", "to the first statement", &Terminal::start},
    {"step", "[N]", "to the next line, also of a call", &Terminal::step},
    {"stepi", "[N]", "to the next statement", &Terminal::nextStatement},
    {"tbreak", "LOCATION", "a breakpoint for one stop", &Terminal::setTemporary},
    {"undisplay", "", "print nothing at stops", &Terminal::undisplay},
    {"unforce", "[PATH]", "one, or all", &Terminal::unforce},
    {"until", "[FILE:]LINE", "run to a line", &Terminal::until},
    {"up", "[N]", "to the call around it", &Terminal::up},
    {"watch", "PATH", "stop when a variable changes", &Terminal::watch},
};

// ---- where it is

const std::vector<std::string>& Terminal::linesOf(const std::string& path) {
  const auto [at, is_new] = sources_.try_emplace(path);
  if (!is_new) return at->second;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at->second.push_back(line);
  }
  return at->second;
}

void Terminal::showPlace(bool with_pou) {
  const DebugFrame* const at = selected();
  if (at == nullptr) return say("before cycle " + std::to_string(execution().cycle()));
  const std::string name = debugger_.values().nameOf(*at), file = debugger_.shownFile(at->file);
  if (with_pou || name != last_pou_)
    say(name + " at " + file + ':' + std::to_string(at->line) + ", cycle " + std::to_string(execution().cycle()));
  last_pou_ = name;
  const std::vector<std::string>& lines = linesOf(file);
  if (at->line >= 1 && at->line <= lines.size()) say(std::to_string(at->line) + '\t' + lines[at->line - 1]);
  list_file_ = file;
  list_line_ = at->line;
}

void Terminal::show(const Stop& stop) {
  frame_ = 0;
  bool with_pou = false;
  const auto numbers = [&] {
    std::string text;
    for (const Wish& wish : wishes_)
      if (std::find(stop.ids.begin(), stop.ids.end(), wish.id) != stop.ids.end())
        text += (text.empty() ? "" : ", ") + std::to_string(wish.number);
    return text;
  };
  switch (stop.reason) {
    case Stop::Breakpoint:
    case Stop::FunctionBreakpoint:
      say("breakpoint " + numbers() + (stop.text.empty() ? "" : ": " + stop.text));
      with_pou = true;
      break;
    case Stop::DataBreakpoint:
      say((stop.ids.empty() || numbers().empty() ? "" : "watch " + numbers() + ": ") + stop.text);
      with_pou = true;
      break;
    case Stop::Exception:
      say(stop.text);
      with_pou = true;
      break;
    case Stop::Pause:
      say("interrupted");
      with_pou = true;
      break;
    case Stop::Goto:
      if (!stop.text.empty()) return say(stop.text);
      break;
    case Stop::HistoryBegins: say("the history begins here: " + stop.text); break;
    case Stop::Ended:
      exit_code_ = stop.exit_code;
      return say(stop.text.empty() ? "the program has ended with exit code " + std::to_string(stop.exit_code)
                                   : stop.text);
    case Stop::Entry:
    case Stop::Step: break;
  }
  showPlace(with_pou);
  showDisplayed();
  const auto isDone = [&](const Wish& wish) {
    return wish.is_temporary && std::find(stop.ids.begin(), stop.ids.end(), wish.id) != stop.ids.end();
  };
  if (std::any_of(wishes_.begin(), wishes_.end(), isDone)) {
    wishes_.erase(std::remove_if(wishes_.begin(), wishes_.end(), isDone), wishes_.end());
    apply();
  }
}

void Terminal::showDisplayed() {
  for (const std::string& expression : displayed_)
    say(expression + " = " + textOf(debugger_.evaluate(expression, selected())));
}

void Terminal::select(int64_t number) {
  const auto count = static_cast<int64_t>(debugger_.frames().size());
  if (number < 0 || number >= count) return say("there is no such call");
  frame_ = number;
  showPlace(true);
}

void Terminal::backtrace(const std::string&) {
  const std::vector<DebugFrame>& frames = debugger_.frames();
  for (size_t i = 0; i < frames.size(); ++i)
    say('#' + std::to_string(i) + "  " + debugger_.values().nameOf(frames[i]) + " at " +
        debugger_.shownFile(frames[i].file) + ':' + std::to_string(frames[i].line));
  if (frames.empty()) say("no activation runs");
}

void Terminal::list(const std::string& arguments) {
  if (list_file_.empty() && selected() != nullptr) list_file_ = debugger_.shownFile(selected()->file);
  const std::vector<std::string>& lines = linesOf(list_file_);
  const int64_t middle = numberOr(arguments, 0);
  if (middle > 0) list_line_ = static_cast<uint32_t>(middle);
  const size_t first = list_line_ > kListedLines / 2 ? list_line_ - kListedLines / 2 : 1;
  for (size_t i = first; i < first + kListedLines && i <= lines.size(); ++i)
    say(std::to_string(i) + '\t' + lines[i - 1]);
  list_line_ = static_cast<uint32_t>(first + kListedLines + kListedLines / 2);
}

// ---- values

// `(a := 1, b := [2, 3])`, as literals of ST, down to a depth and a number of parts.
std::string Terminal::contentOf(const Variable& place, uint32_t depth) {
  constexpr uint32_t kDeepest = 4;
  constexpr uint64_t kMost = 100;
  const ShownVariable shown = debugger_.values().show("", place);
  if (place.type->kind == RUNG_POINTER || shown.named + shown.indexed == 0) return shown.value;
  if (depth > kDeepest) return "...";
  const bool is_array = shown.indexed != 0;
  std::string text(1, is_array ? '[' : '(');
  const std::vector<ShownVariable> parts = debugger_.values().inside(place, 0, kMost);
  for (size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : ", ") + (is_array ? "" : parts[i].name + " := ") + contentOf(parts[i].place, depth + 1);
  if (shown.named + shown.indexed > kMost) text += ", ...";
  return text + (is_array ? ']' : ')');
}

std::string Terminal::textOf(const Evaluated& value) {
  if (!value.error.empty()) return value.error;
  return value.place.isEmpty() ? value.value : contentOf(value.place, 0);
}

void Terminal::print(const std::string& arguments) {
  const Evaluated value = debugger_.evaluate(arguments, selected());
  say(value.error.empty() ? arguments + " = " + textOf(value) : value.error);
}

void Terminal::set(const std::string& arguments) {
  const size_t sign = arguments.find(":=");
  if (sign == std::string::npos) return say("set takes VARIABLE := VALUE");
  report(debugger_.set(std::string(host::trimmed(arguments.substr(0, sign))),
                       std::string(host::trimmed(arguments.substr(sign + 2))), selected()));
}

void Terminal::force(const std::string& arguments) {
  const size_t sign = arguments.find('=');
  if (sign == std::string::npos) return say("force takes PATH = VALUE");
  report(debugger_.force(std::string(host::trimmed(arguments.substr(0, sign))),
                         std::string(host::trimmed(arguments.substr(sign + 1)))));
}

void Terminal::display(const std::string& arguments) {
  if (!arguments.empty()) displayed_.push_back(arguments);
  showDisplayed();
}

void Terminal::showVariables(const std::vector<ShownVariable>& variables, const std::string& prefix) {
  for (const ShownVariable& variable : variables) say(prefix + variable.name + " = " + contentOf(variable.place, 1));
}

void Terminal::info(const std::string& arguments) {
  const std::string what = splitWord(arguments).first;
  const auto is = [&](const char* name) { return !what.empty() && strncasecmp(name, what.c_str(), what.size()) == 0; };
  if (is("breakpoints")) {
    for (const Wish& wish : wishes_) {
      std::string line = std::to_string(wish.number) + "  " +
                         (wish.kind == Wish::Line ? wish.file + ':' + std::to_string(wish.line) : wish.wish.name);
      if (!wish.wish.condition.empty()) line += " if " + wish.wish.condition;
      if (!wish.wish.hits.empty()) line += " hits " + wish.wish.hits;
      if (!wish.wish.log.empty()) line += " log " + wish.wish.log;
      say(line + (wish.problem.empty() ? "" : "  (" + wish.problem + ')'));
    }
    if (wishes_.empty()) say("there are no breakpoints");
  } else if (is("tasks")) {
    say(execution().session().tasks().statistics(0));
  } else if (is("locals") || is("instance")) {
    const DebugFrame* const at = selected();
    if (at == nullptr) return say("no activation runs");
    showVariables(debugger_.values().locals(*at), "");
    showVariables(debugger_.values().instance(*at), "");
  } else if (is("globals")) {
    showVariables(debugger_.values().globals(), "");
  } else if (is("image")) {
    showVariables(debugger_.values().image(), "");
  } else if (is("history")) {
    say("cycle " + std::to_string(execution().cycle()) + ", " + std::to_string(execution().historyBytes() / 1024) +
        " KiB of history");
  } else {
    say("info takes breakpoints, tasks, locals, globals, image or history");
  }
}

// ---- breakpoints

bool Terminal::parseLocation(const std::string& text, std::string& file, uint32_t& line, uint32_t& column) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  size_t numbers = 0;
  while (numbers < parts.size() && numberOr(parts[parts.size() - 1 - numbers], -1) >= 0) ++numbers;
  if (numbers == 0 || numbers > 2 || parts.size() - numbers > 1) return false;
  const size_t first = parts.size() - numbers;
  line = static_cast<uint32_t>(numberOr(parts[first], 0));
  column = numbers == 2 ? static_cast<uint32_t>(numberOr(parts[first + 1], 0)) : 0;
  file = first == 1 ? parts[0] : list_file_;
  const auto& points = execution().code().points();
  if (file.empty() && !points.empty()) file = debugger_.shownFile(points[0].file);
  return true;
}

// Passes all to the debugger, whose calls replace those of a file.
void Terminal::apply() {
  std::map<std::string, std::vector<Wish*>> by_file;
  std::vector<Wish*> pous, data;
  for (Wish& wish : wishes_) {
    if (wish.kind == Wish::Line) by_file[wish.file].push_back(&wish);
    if (wish.kind == Wish::Pou) pous.push_back(&wish);
    if (wish.kind == Wish::Data) data.push_back(&wish);
  }
  const auto wanted = [](const std::vector<Wish*>& of) {
    std::vector<BreakpointWish> all;
    for (const Wish* wish : of) all.push_back(wish->wish);
    return all;
  };
  const auto take = [](const std::vector<Wish*>& of, const std::vector<Breakpoint>& made) {
    for (size_t i = 0; i < of.size(); ++i) {
      of[i]->id = made[i].id;
      of[i]->problem = made[i].problem;
      of[i]->line = made[i].is_bound ? made[i].line : of[i]->wish.line;
    }
  };
  debugger_.forgetLines();
  for (const auto& [file, of] : by_file) take(of, debugger_.setBreakpoints(file, wanted(of)));
  take(pous, debugger_.setFunctionBreakpoints(wanted(pous)));
  take(data, debugger_.setDataBreakpoints(wanted(data)));
}

void Terminal::addBreakpoint(const std::string& arguments, bool is_temporary) {
  Wish wish{next_number_, Wish::Pou, "", {}, is_temporary, 0, "", 0};
  const size_t condition = arguments.find(" if ");
  const std::string place(host::trimmed(std::string_view(arguments).substr(0, condition)));
  if (condition != std::string::npos)
    wish.wish.condition = host::trimmed(std::string_view(arguments).substr(condition + 4));
  if (place.empty()) return say("break takes [FILE:]LINE[:COLUMN] or the name of a POU");
  if (parseLocation(place, wish.file, wish.wish.line, wish.wish.column))
    wish.kind = Wish::Line;
  else
    wish.wish.name = place;
  wishes_.push_back(wish);
  apply();
  const Wish& made = wishes_.back();
  if (!made.problem.empty()) {
    say(made.problem);
    wishes_.pop_back();
    return apply();
  }
  ++next_number_;
  say("breakpoint " + std::to_string(made.number) +
      (made.kind == Wish::Line ? " at " + made.file + ':' + std::to_string(made.line) : " at " + made.wish.name));
}

void Terminal::watch(const std::string& arguments) {
  // A name that the selected call knows, by its path in the program.
  std::string path = arguments;
  const DebugFrame* const at = selected();
  if (at != nullptr) {
    const std::string inside = debugger_.values().instancePath(*at) + '.' + arguments;
    Variable found;
    std::string error;
    if (execution().session().symbols().find(inside, found, error)) path = inside;
  }
  wishes_.push_back({next_number_, Wish::Data, "", {}, false, 0, "", 0});
  wishes_.back().wish.name = path;
  apply();
  if (const std::string problem = wishes_.back().problem; !problem.empty()) {
    wishes_.pop_back();
    apply();
    return say(problem);
  }
  say("watch " + std::to_string(next_number_++) + ": " + path);
}

void Terminal::remove(const std::string& arguments) {
  const int64_t number = numberOr(arguments, -1);
  const size_t before = wishes_.size();
  wishes_.erase(std::remove_if(wishes_.begin(), wishes_.end(),
                               [&](const Wish& wish) { return arguments.empty() || wish.number == number; }),
                wishes_.end());
  if (wishes_.size() == before) return say("there is no such breakpoint");
  apply();
}

void Terminal::condition(const std::string& arguments) {
  const auto [number, text] = splitWord(arguments);
  for (Wish& wish : wishes_) {
    if (wish.number != numberOr(number, -1)) continue;
    const std::string before = std::exchange(wish.wish.condition, text);
    apply();
    if (wish.problem.empty()) return;
    say(wish.problem);
    wish.wish.condition = before;
    return apply();
  }
  say("there is no such breakpoint");
}

void Terminal::ignore(const std::string& arguments) {
  const auto [number, text] = splitWord(arguments);
  for (Wish& wish : wishes_) {
    if (wish.number != numberOr(number, -1)) continue;
    wish.wish.hits = text;
    return apply();
  }
  say("there is no such breakpoint");
}

void Terminal::logPoint(const std::string& arguments) {
  const auto [place, text] = splitWord(arguments);
  if (text.empty()) return say("log takes a place and a text");
  const size_t count = wishes_.size();
  addBreakpoint(place, false);
  if (wishes_.size() == count) return;
  wishes_.back().wish.log = text;
  apply();
}

void Terminal::catchKind(const std::string& arguments) {
  if (arguments == "fault")
    exceptions_.faults = true;
  else if (arguments == "uncaught")
    exceptions_.uncaught = true;
  else if (arguments == "assert")
    exceptions_.assertions = true;
  else if (arguments == "none")
    exceptions_ = {false, false, false};
  else
    return say("catch takes fault, uncaught, assert or none");
  debugger_.setExceptions(exceptions_);
}

std::string Terminal::taskName(uint32_t number) {
  const auto& tasks = execution().session().module().tasks;
  return number >= 1 && number <= tasks.size() ? execution().module().strings + tasks[number - 1].name : "";
}

bool Terminal::findTask(const std::string& name, uint32_t& number) {
  const auto& tasks = execution().session().module().tasks;
  for (uint32_t i = 1; i <= tasks.size(); ++i)
    if (strcasecmp(taskName(i).c_str(), name.c_str()) == 0) return number = i, true;
  return false;
}

// ---- commands

void Terminal::help(const std::string& arguments) {
  for (const Command& command : kCommands) {
    if (!arguments.empty() && arguments != command.name) continue;
    std::string line = std::string(command.name) + (*command.arguments == 0 ? "" : " ") + command.arguments;
    if (line.size() < 30) line.resize(30, ' ');
    say(line + ' ' + command.help);
  }
}

bool Terminal::obey(const std::string& written) {
  std::string line(host::trimmed(written));
  if (!line.empty() && line[0] == '#') return true;
  if (line.empty()) line = last_line_;
  if (line.empty()) return true;
  last_line_ = line;
  const auto [word, arguments] = splitWord(line);
  static const std::map<std::string, std::string> kShort = {{"b", "break"},
                                                            {"bt", "backtrace"},
                                                            {"c", "continue"},
                                                            {"d", "delete"},
                                                            {"f", "frame"},
                                                            {"h", "help"},
                                                            {"i", "info"},
                                                            {"l", "list"},
                                                            {"n", "next"},
                                                            {"p", "print"},
                                                            {"q", "quit"},
                                                            {"r", "run"},
                                                            {"s", "step"},
                                                            {"si", "stepi"},
                                                            {"rc", "reverse-continue"},
                                                            {"where", "backtrace"},
                                                            {"ni", "stepi"},
                                                            {"reverse-step", "back"},
                                                            {"reverse-next", "back"},
                                                            {"rs", "back"},
                                                            {"rn", "back"}};
  const auto known = kShort.find(word);
  const std::string name = known == kShort.end() ? word : known->second;
  const Command* found = nullptr;
  for (const Command& command : kCommands) {
    if (name == command.name) {
      found = &command;
      break;
    }
    if (name.size() < 2 || strncmp(command.name, name.c_str(), name.size()) != 0) continue;
    if (found != nullptr) {
      say("`" + word + "` could be `" + found->name + "` or `" + command.name + "`");
      return true;
    }
    found = &command;
  }
  if (found == nullptr)
    say("there is no command `" + word + "`; `help` lists all");
  else
    (this->*found->run)(arguments);
  fflush(out_);
  return !ends_;
}

// The commands, then names of POUs and variables.
LineEditor::Completion Terminal::completionOf(const std::string& line) {
  LineEditor::Completion found;
  const size_t blank = line.find_last_of(" \t(");
  found.begin = blank == std::string::npos ? 0 : blank + 1;
  const std::string word = line.substr(found.begin);
  const auto add = [&](const std::string& name) {
    if (strncasecmp(name.c_str(), word.c_str(), word.size()) == 0) found.words.push_back(name);
  };
  if (blank == std::string::npos) {
    for (const Command& command : kCommands) add(command.name);
    return found;
  }
  const size_t dot = word.find_last_of('.');
  const DebugFrame* const at = selected();
  std::vector<ShownVariable> known;
  if (dot != std::string::npos) {
    const Evaluated base = debugger_.evaluate(word.substr(0, dot), at);
    if (base.error.empty() && !base.place.isEmpty()) known = debugger_.values().inside(base.place, 0, UINT64_MAX);
    for (const ShownVariable& one : known) add(word.substr(0, dot + 1) + one.name);
  } else {
    for (const ir::interpreter::DebugBody& body : execution().code().bodies())
      if (body.is_shown && !body.is_library) add(body.name);
    if (at != nullptr) known = debugger_.values().locals(*at);
    for (const ShownVariable& one : known) add(one.name);
    if (at != nullptr) known = debugger_.values().instance(*at);
    for (const ShownVariable& one : known) add(one.name);
    for (const ShownVariable& one : debugger_.values().globals()) add(one.name);
  }
  std::sort(found.words.begin(), found.words.end());
  found.words.erase(std::unique(found.words.begin(), found.words.end()), found.words.end());
  return found;
}

bool readLines(const std::string& path, std::deque<std::string>& lines, std::string& error) {
  std::string content;
  if (!host::readFile(path, content, error)) return false;
  size_t at = 0;
  while (at < content.size()) {
    const size_t end = std::min(content.find('\n', at), content.size());
    lines.push_back(content.substr(at, end - at));
    at = end + 1;
  }
  return true;
}

}  // namespace

int runTerminal(const TerminalOptions& options, driver::Sink& sink) {
  std::deque<std::string> lines;
  std::string error;
  for (const std::string& script : options.scripts)
    if (!readLines(script, lines, error)) return driver::usageError(sink, "-x: " + error);
  lines.insert(lines.end(), options.commands.begin(), options.commands.end());
  std::FILE* const out = sink.programOutput();
  std::FILE* const err = sink.programErrors();
  Target target;
  const auto print = [out, err](const std::string& text, bool is_error) {
    fflush(out);
    fputs(text.c_str(), is_error ? err : out);
    fflush(err);
  };
  const int made = target.make(options.target, print, sink, error);
  if (made != driver::kSuccess) return error.empty() ? made : driver::usageError(sink, error);
  Terminal terminal(target, out);
  interruptible = target.execution.get();
  struct sigaction action {};
  action.sa_handler = onInterrupt;
  sigaction(SIGINT, &action, nullptr);
  bool goes_on = true;
  for (const std::string& line : lines) {
    if (!goes_on) break;
    if (!line.empty()) goes_on = terminal.obey(line);
  }
  const bool is_interactive = isatty(0) != 0 && isatty(1) != 0;
  LineEditor editor("(rung) ", [&](const std::string& line) { return terminal.completionOf(line); });
  while (goes_on && !options.is_batch) {
    std::string line;
    if (is_interactive ? !editor.read(line) : !std::getline(std::cin, line)) break;
    if (!line.empty() || is_interactive) goes_on = terminal.obey(line);
  }
  interruptible = nullptr;
  return terminal.exitCode();
}

}  // namespace rung::debug
