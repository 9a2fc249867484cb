// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/debugger.h"

#include <limits.h>
#include <stdlib.h>
#include <strings.h>

#include <algorithm>
#include <cstring>

#include "stdlib/runtime/host/value_format.h"

namespace rung::debug {
namespace {

std::string absolute(const std::string& path) {
  char resolved[PATH_MAX];
  return realpath(path.c_str(), resolved) != nullptr ? resolved : path;
}

std::vector<uint8_t> bytesOf(const Variable& variable) {
  std::vector<uint8_t> bytes(variable.type->size);
  if (!rung_read_value(variable.context, &variable, bytes.data(), bytes.size())) bytes.clear();
  return bytes;
}

// `5`, `>= 3`, `% 10` of the count of hits.
bool suits(const std::string& wish, uint64_t count) {
  const size_t digits = wish.find_first_of("0123456789");
  if (digits == std::string::npos) return true;
  const uint64_t number = strtoull(wish.c_str() + digits, nullptr, 10);
  const std::string relation(host::trimmed(std::string_view(wish).substr(0, digits)));
  if (relation == ">=") return count >= number;
  if (relation == ">") return count > number;
  if (relation == "<=") return count <= number;
  if (relation == "<") return count < number;
  if (relation == "%") return number != 0 && count % number == 0;
  return count == number;
}

// Takes down the moments that a predicate accepts; the last one counts.
template <class Predicate>
class Recorder : public Judge {
 public:
  explicit Recorder(Predicate& predicate) : predicate_(predicate) {}
  bool stopsAt(const Moment& at, const Machine& machine) override {
    predicate_(at, machine);
    return false;
  }

 private:
  Predicate& predicate_;
};

}  // namespace

Debugger::Debugger(Execution& execution)
    : execution_(execution),
      values_(execution),
      expressions_(execution, values_, [this](const auto& look) { return lookBeforeCycle(look); }) {
  at_point_.resize(execution.code().points().size());
}

// ---- files

std::string Debugger::shownFile(const char* file) const { return host::shownPath(execution_.paths(), file); }

std::string Debugger::fileOf(const std::string& path) const {
  const std::string wanted = absolute(path);
  const char* known = nullptr;
  std::string by_end;
  for (const DebugPoint& point : execution_.code().points()) {
    if (point.file == known) continue;
    known = point.file;
    if (path == known || absolute(shownFile(known)) == wanted) return known;
    if (std::string_view(known).ends_with('/' + path)) by_end = known;  // a part of the path, as gdb takes it
  }
  return by_end;
}

// ---- breakpoints

// The points of the first statement in the line, at or after the column; without one in the line, of the next line of
// the same POU.
void Debugger::bind(Breakpoint& breakpoint, const std::string& file) {
  const std::vector<DebugPoint>& points = execution_.code().points();
  const BreakpointWish& wish = breakpoint.wish;
  const DebugPoint* best = nullptr;
  const auto isBetter = [&](const DebugPoint& one) {
    if (one.line < wish.line || (one.line == wish.line && one.column < wish.column)) return false;
    return best == nullptr || one.line < best->line || (one.line == best->line && one.column < best->column);
  };
  for (const DebugPoint& point : points)
    if (point.file == file && isBetter(point)) best = &point;
  if (best == nullptr && wish.column != 0) {  // the last statement of the line
    for (const DebugPoint& point : points)
      if (point.file == file && point.line == wish.line && (best == nullptr || point.column > best->column))
        best = &point;
  }
  const std::vector<ir::interpreter::DebugBody>& bodies = execution_.code().bodies();
  const bool is_of_pou = best != nullptr && (best->line == wish.line || bodies[best->body].line <= wish.line);
  if (!is_of_pou) {
    breakpoint.problem = "there is no statement at or after this line of the POU";
    return;
  }
  breakpoint.file = file;
  breakpoint.line = best->line;
  breakpoint.column = best->column;
  // Of a line as a whole, what each POU does first there; a statement has further points where it calls something.
  uint32_t last_body = RUNG_NONE;
  for (size_t i = 0; i < points.size(); ++i) {
    const DebugPoint& point = points[i];
    if (point.file != file || point.line != best->line) continue;
    if (wish.column == 0 ? point.body == last_body : point.column != best->column) continue;
    last_body = point.body;
    breakpoint.points.push_back(static_cast<uint32_t>(i));
  }
  breakpoint.is_bound = true;
}

void Debugger::bindFunction(Breakpoint& breakpoint) {
  const std::vector<DebugPoint>& points = execution_.code().points();
  const std::vector<ir::interpreter::DebugBody>& bodies = execution_.code().bodies();
  for (size_t b = 0; b < bodies.size(); ++b) {
    if (strcasecmp(bodies[b].name, breakpoint.wish.name.c_str()) != 0) continue;
    for (size_t i = 0; i < points.size(); ++i) {
      if (points[i].body != b) continue;
      breakpoint.points.push_back(static_cast<uint32_t>(i));
      breakpoint.file = points[i].file;
      breakpoint.line = points[i].line;
      breakpoint.column = points[i].column;
      break;
    }
  }
  breakpoint.is_bound = !breakpoint.points.empty();
  if (!breakpoint.is_bound) breakpoint.problem = "there is no POU `" + breakpoint.wish.name + "` with statements";
}

void Debugger::bindData(Breakpoint& breakpoint) {
  std::string& why = breakpoint.problem;
  breakpoint.is_bound = execution_.session().symbols().find(breakpoint.wish.name, breakpoint.watched, why);
}

namespace {

template <class Bind>
void bindAll(std::vector<Breakpoint>& all, std::vector<BreakpointWish> wishes, uint32_t& next_id, Bind bind) {
  all.clear();
  for (BreakpointWish& wish : wishes) {
    Breakpoint& created = all.emplace_back();
    created.id = next_id++;
    created.wish = std::move(wish);
    bind(created);
  }
}

}  // namespace

const std::vector<Breakpoint>& Debugger::setBreakpoints(const std::string& path, std::vector<BreakpointWish> wishes) {
  const std::string file = fileOf(path);
  std::vector<Breakpoint>& all = by_file_[absolute(path)];
  bindAll(all, std::move(wishes), next_id_, [&](Breakpoint& created) {
    if (!created.wish.condition.empty()) created.problem = expressions_.check(created.wish.condition);
    if (!created.problem.empty()) return;
    if (file.empty())
      created.problem = "no statement of the program is in this file";
    else
      bind(created, file);
  });
  return all;
}

const std::vector<Breakpoint>& Debugger::setFunctionBreakpoints(std::vector<BreakpointWish> wishes) {
  bindAll(functions_, std::move(wishes), next_id_, [&](Breakpoint& created) { bindFunction(created); });
  return functions_;
}

const std::vector<Breakpoint>& Debugger::setDataBreakpoints(std::vector<BreakpointWish> wishes) {
  bindAll(data_, std::move(wishes), next_id_, [&](Breakpoint& created) { bindData(created); });
  return data_;
}

std::vector<DebugPoint> Debugger::possiblePoints(const std::string& path, uint32_t first, uint32_t last) const {
  std::vector<DebugPoint> found;
  const std::string file = fileOf(path);
  for (const DebugPoint& point : execution_.code().points())
    if (point.file == file && point.line >= first && point.line <= last) found.push_back(point);
  const auto key = [](const DebugPoint& point) { return std::pair(point.line, point.column); };
  std::sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  found.erase(std::unique(found.begin(), found.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
              found.end());
  return found;
}

Execution::Armed Debugger::armed() const {
  Execution::Armed armed;
  armed.all =
      step_.is_active || std::any_of(data_.begin(), data_.end(), [](const Breakpoint& it) { return it.is_bound; });
  if (step_.is_active) return armed;
  const auto add = [&](const std::vector<Breakpoint>& all) {
    for (const Breakpoint& one : all) armed.points.insert(armed.points.end(), one.points.begin(), one.points.end());
  };
  for (const auto& [path, all] : by_file_) add(all);
  add(functions_);
  armed.points.insert(armed.points.end(), run_to_points_.begin(), run_to_points_.end());
  std::sort(armed.points.begin(), armed.points.end());
  armed.points.erase(std::unique(armed.points.begin(), armed.points.end()), armed.points.end());
  if (!armed.all) return armed;
  for (const Breakpoint& one : data_) {
    if (!one.is_bound) continue;
    const uint8_t* const at = one.watched.address();
    const uint32_t size = one.watched.type->size;
    if (at == nullptr || one.watched.pointers != 0 || size > sizeof DebugCode::Watched::value) {
      armed.watched.clear();  // what it is may change, or it is large
      return armed;
    }
    armed.watched.push_back({at, size, {}});
  }
  return armed;
}

// ---- the judge: in the thread of the program

bool Debugger::hits(Breakpoint& breakpoint, uint32_t point, const Machine& machine) {
  if (!breakpoint.wish.condition.empty()) {
    const std::vector<DebugFrame> frames = execution_.code().frames(machine, point);
    values_.forget();
    const Evaluated value = expressions_.evaluate(breakpoint.wish.condition, frames.empty() ? nullptr : &frames[0]);
    if (!value.error.empty()) {
      found_.text = "the condition `" + breakpoint.wish.condition + "`: " + value.error;
      return true;
    }
    if (!value.truth) return false;
  }
  ++breakpoint.count;
  return breakpoint.wish.hits.empty() || suits(breakpoint.wish.hits, breakpoint.count);
}

void Debugger::log(const Breakpoint& breakpoint, const Machine& machine, uint32_t point) {
  const std::vector<DebugFrame> frames = execution_.code().frames(machine, point);
  values_.forget();
  std::string text;
  const std::string& pattern = breakpoint.wish.log;
  for (size_t i = 0; i < pattern.size(); ++i) {
    const size_t end = pattern[i] == '{' ? pattern.find('}', i) : std::string::npos;
    if (end == std::string::npos) {
      text += pattern[i];
      continue;
    }
    const std::string expression = pattern.substr(i + 1, end - i - 1);
    if (expression == "cycle") {
      text += std::to_string(execution_.cycle());
    } else {
      const Evaluated value = expressions_.evaluate(expression, frames.empty() ? nullptr : &frames[0]);
      text += value.error.empty() ? value.value : '<' + value.error + '>';
    }
    i = end;
  }
  execution_.options().print(text + "\n", false);
}

bool Debugger::hitsBreakpoint(uint32_t point, const Machine& machine) {
  for (Breakpoint* const breakpoint : at_point_[point]) {
    if (!hits(*breakpoint, point, machine)) continue;
    if (!breakpoint->wish.log.empty()) {
      log(*breakpoint, machine, point);
      continue;
    }
    found_.reason = breakpoint->wish.name.empty() ? Stop::Breakpoint : Stop::FunctionBreakpoint;
    found_.ids.push_back(breakpoint->id);
  }
  return !found_.ids.empty();
}

bool Debugger::hasChanged(Breakpoint& breakpoint, std::string* text) {
  const Variable& watched = breakpoint.watched;
  const uint8_t* const now = watched.address();
  if (watched.bit == 255 && now != nullptr && breakpoint.last_value.size() == watched.type->size &&
      memcmp(now, breakpoint.last_value.data(), breakpoint.last_value.size()) == 0)
    return false;
  std::vector<uint8_t> bytes = bytesOf(watched);
  if (bytes == breakpoint.last_value) return false;
  if (text != nullptr) {
    const host::LoadedModule& module = execution_.session().module();
    std::string before, after;
    if (!breakpoint.last_value.empty()) host::formatCopied(module, watched, breakpoint.last_value.data(), before);
    host::formatValue(module, watched, after);
    *text = breakpoint.wish.name + ": " + (before.empty() ? "changed" : before + " -> " + after);
  }
  breakpoint.last_value = std::move(bytes);
  execution_.code().takeValues();
  return true;
}

bool Debugger::stopsAt(const Moment& at, const Machine& machine) {
  for (Breakpoint& breakpoint : data_) {
    std::string text;
    if (!breakpoint.is_bound || !hasChanged(breakpoint, &text)) continue;
    if (!hits(breakpoint, at.point, machine)) continue;
    found_.reason = Stop::DataBreakpoint;
    found_.text = text;
    found_.ids.push_back(breakpoint.id);
  }
  if (!found_.ids.empty()) return true;
  if (!at_point_[at.point].empty() && hitsBreakpoint(at.point, machine)) return true;
  if (!found_.text.empty()) return found_.reason = Stop::Breakpoint, true;  // a condition that cannot be evaluated
  if (std::find(run_to_points_.begin(), run_to_points_.end(), at.point) != run_to_points_.end()) {
    found_.reason = Stop::Step;
    return true;
  }
  if (!step_.is_active || !completesStep(at.point, machine)) return false;
  found_.reason = Stop::Step;
  return true;
}

bool Debugger::stopsAtFault(const Moment&, bool is_handled) {
  if (is_handled ? !exceptions_.faults : !(exceptions_.uncaught || exceptions_.faults)) return false;
  found_.reason = Stop::Exception;
  return true;
}

bool Debugger::stopsAtAssertion(const Moment&) {
  if (!exceptions_.assertions) return false;
  found_.reason = Stop::Exception;
  found_.text = "assertion failed";
  return true;
}

// A step of this size goes on: in a network or, outside of networks, on a line.
bool Debugger::isSamePart(Granularity granularity, uint32_t one, uint32_t other) const {
  if (granularity == Granularity::Statement || one == RUNG_NONE || other == RUNG_NONE) return false;
  const DebugPoint &a = execution_.code().points()[one], &b = execution_.code().points()[other];
  if (granularity == Granularity::Network && (a.network != 0 || b.network != 0))
    return a.body == b.body && a.network == b.network;
  return a.body == b.body && a.line == b.line;
}

bool Debugger::completesStep(uint32_t point, const Machine& machine) const {
  const bool is_new_unit = execution_.now().unit != step_.unit;
  if (step_.kind == StepKind::Cycle) return execution_.cycle() != step_.cycle;
  if (step_.kind == StepKind::Activation) return is_new_unit && machine.ctx->task == step_.task;
  if (step_.kind == StepKind::Into) return !isSamePart(step_.granularity, point, step_.point);
  if (step_.task != 0 && machine.ctx->task != step_.task) return false;
  const size_t depth = DebugCode::depth(machine);
  if (step_.kind == StepKind::Out) return is_new_unit || depth < step_.depth;
  if (is_new_unit) return true;
  if (depth > step_.depth) return false;
  return depth < step_.depth || !isSamePart(step_.granularity, point, step_.point);
}

// ---- forward

void Debugger::rememberWatched() {
  for (Breakpoint& breakpoint : data_)
    if (breakpoint.is_bound) breakpoint.last_value = bytesOf(breakpoint.watched);
}

void Debugger::standAt() {
  values_.forget();
  has_frames_ = false;
  task_ = execution_.isInside() ? execution_.session().context().task : 0;
  depth_ = execution_.isInside() ? execution_.depth() : 0;
}

void Debugger::placeBreakpoints() {
  for (auto& at : at_point_) at.clear();
  const auto place = [&](std::vector<Breakpoint>& all) {
    for (Breakpoint& one : all)
      for (const uint32_t point : one.points) at_point_[point].push_back(&one);
  };
  for (auto& [path, all] : by_file_) place(all);
  place(functions_);
}

// Breakpoints stay where they were in the source.
void Debugger::bindAgain() {
  at_point_.assign(execution_.code().points().size(), {});
  const auto clear = [](Breakpoint& one) {
    one.points.clear();
    one.is_bound = false;
    one.problem.clear();
  };
  for (auto& [path, all] : by_file_) {
    const std::string file = fileOf(path);
    for (Breakpoint& one : all) {
      clear(one);
      if (!file.empty()) bind(one, file);
    }
  }
  for (Breakpoint& one : functions_) {
    clear(one);
    bindFunction(one);
  }
  for (Breakpoint& one : data_) {
    clear(one);
    bindData(one);
  }
}

// The version that runs completes its cycle; the other one begins the next.
void Debugger::attendChange() {
  if (!new_version_) return;
  std::string problem, report;
  std::shared_ptr<driver::ProgramVersion> next = new_version_(problem);
  if (next && !execution_.isBeforeCycle() && !execution_.goToCycle(execution_.cycle() + 1))
    problem = "the program has ended";
  else if (next)
    problem = execution_.change(std::move(next), report);
  if (!problem.empty()) execution_.options().print("error: " + problem + "\n", true);
  if (report.empty()) return;
  execution_.options().print(report, true);
  bindAgain();
  standAt();
  step_.unit = execution_.now().unit - 1;
  step_.cycle = execution_.cycle() - 1;
  step_.depth = 0;
  step_.point = RUNG_NONE;
  run_to_points_.clear();
  rememberWatched();
}

Stop Debugger::run() {
  attendChange();
  placeBreakpoints();
  found_ = {};
  const Outcome outcome = execution_.run(*this, armed());
  return stopOf(outcome);
}

Stop Debugger::stopOf(const Outcome& outcome) {
  standAt();
  switch (outcome.kind) {
    case Outcome::Stopped:
      if (found_.reason == Stop::Exception && found_.text.empty()) found_.text = execution_.faultText();
      step_.is_active = false;
      run_to_points_.clear();
      return found_;
    case Outcome::Interrupted: return {Stop::Pause, "", {}, 0};
    case Outcome::Reached: return {Stop::Goto, "", {}, 0};
    case Outcome::Ended: break;
  }
  step_.is_active = false;
  run_to_points_.clear();
  return {Stop::Ended, "", {}, outcome.exit_code};
}

void Debugger::beginStep(StepKind kind, Granularity granularity) {
  const Moment now = execution_.now();
  const int64_t before = execution_.isInside() ? 0 : 1;  // what runs next is the next unit, and cycle
  step_ = {true, kind, granularity, depth_, pointOf(now), task_, now.unit - before, execution_.cycle() - before};
}

// The statement that a moment is at or in.
uint32_t Debugger::pointOf(const Moment& moment) const {
  if (moment.point == RUNG_NONE || moment.point < kAtInstruction) return moment.point;
  return execution_.code().pointOf(moment.point & ~kAtInstruction);
}

Stop Debugger::resume() {
  step_.is_active = false;
  rememberWatched();
  return run();
}

Stop Debugger::goOn() { return run(); }

Stop Debugger::step(StepKind kind, Granularity granularity, uint32_t task) {
  beginStep(kind, granularity);
  if (kind == StepKind::Activation && task != 0) step_.task = task;
  if (!execution_.isInside() && kind != StepKind::Cycle && kind != StepKind::Activation) step_.kind = StepKind::Into;
  rememberWatched();
  return run();
}

Stop Debugger::runTo(const std::string& path, uint32_t line) {
  Breakpoint there;
  there.wish.line = line;
  bind(there, fileOf(path));
  if (!there.is_bound) return {Stop::Goto, there.problem, {}, 0};
  run_to_points_ = there.points;
  return resume();
}

Stop Debugger::goToCycle(int64_t cycle) {
  step_.is_active = false;
  const bool is_there = execution_.goToCycle(cycle);
  standAt();
  if (is_there) return {Stop::Goto, "", {}, 0};
  const char* const why =
      execution_.hasEnded() ? "the program ends before cycle " : "the history does not reach cycle ";
  return {Stop::Ended, why + std::to_string(cycle), {}, 0};
}

// ---- back

// Goes to the last moment before the present one that the predicate accepts, segment by segment. False: there is none,
// and the program is where it was.
template <class Predicate>
bool Debugger::searchBack(const Execution::Armed& armed, Predicate predicate) {
  const Moment origin = execution_.now();
  Moment to = origin;
  std::optional<Moment> found;
  auto note = [&](const Moment& at, const Machine& machine) {
    if (at != to && predicate(at, machine)) found = at;
  };
  Recorder<decltype(note)> recorder(note);
  for (int64_t unit = to.point == RUNG_NONE ? to.unit - 1 : to.unit; unit >= execution_.firstUnit();) {
    const Moment checkpoint = execution_.checkpointFor(unit);
    execution_.goTo(checkpoint);
    rememberWatched();
    execution_.replay(to, recorder, armed);
    if (found) break;
    to = checkpoint;
    unit = checkpoint.unit - 1;
  }
  execution_.goTo(found ? *found : origin);
  standAt();
  return found.has_value();
}

Stop Debugger::stepBack(Granularity granularity) {
  const Moment origin = execution_.now();
  const size_t depth = depth_;
  const uint32_t task = task_;
  const uint32_t point = pointOf(origin);
  const bool is_within = origin.point != RUNG_NONE && origin.point >= kAtInstruction;  // at a fault or an assertion
  Execution::Armed all;
  all.all = true;
  const bool is_found = searchBack(all, [&](const Moment& at, const Machine& machine) {
    if (task == 0) return true;
    if (machine.ctx->task != task || (at.unit == origin.unit && DebugCode::depth(machine) > depth)) return false;
    if (at.unit != origin.unit && DebugCode::depth(machine) > depth) return false;
    if (is_within && at.unit == origin.unit && at.steps == origin.steps && at.point == point) return false;
    return !isSamePart(granularity, at.point, point);
  });
  if (!is_found) return {Stop::HistoryBegins, "the program has done nothing before", {}, 0};
  return {Stop::Step, "", {}, 0};
}

Stop Debugger::reverse() {
  step_.is_active = false;
  const Execution::Armed wanted = armed();
  placeBreakpoints();
  Stop stop;
  const bool is_found = searchBack(wanted, [&](const Moment& at, const Machine& machine) {
    bool is_hit = false;
    for (Breakpoint& breakpoint : data_) {
      std::string text;
      if (!breakpoint.is_bound || !hasChanged(breakpoint, &text)) continue;
      stop = {Stop::DataBreakpoint, text, {breakpoint.id}, 0};
      is_hit = true;
    }
    if (is_hit) return true;
    for (Breakpoint* const breakpoint : at_point_[at.point]) {
      if (!breakpoint->wish.log.empty()) continue;
      const uint64_t count = breakpoint->count;
      const bool hit = hits(*breakpoint, at.point, machine);
      breakpoint->count = count;
      if (!hit) continue;
      stop = {Stop::Breakpoint, "", {breakpoint->id}, 0};
      is_hit = true;
    }
    return is_hit;
  });
  found_ = {};
  if (is_found) return stop;
  execution_.goTo(execution_.checkpointFor(execution_.firstUnit()));
  standAt();
  return {Stop::HistoryBegins, "the begin of the program", {}, 0};
}

Stop Debugger::lastWrite(const std::string& path) {
  Breakpoint watch;
  watch.wish.name = path;
  bindData(watch);
  if (!watch.is_bound) return {Stop::Goto, watch.problem, {}, 0};
  Execution::Armed all;
  all.all = true;
  const Moment origin = execution_.now();
  Moment to = origin;
  std::optional<Moment> writer;
  std::string text;
  for (int64_t unit = to.point == RUNG_NONE ? to.unit - 1 : to.unit; unit >= execution_.firstUnit() && !writer;) {
    const Moment checkpoint = execution_.checkpointFor(unit);
    std::optional<Moment> last;
    execution_.goTo(checkpoint);
    watch.last_value = bytesOf(watch.watched);
    auto note = [&](const Moment& at, const Machine&) {
      if (last && hasChanged(watch, &text)) writer = last;
      last = at;
    };
    Recorder<decltype(note)> recorder(note);
    execution_.replay(to, recorder, all);
    if (last && hasChanged(watch, &text)) writer = last;  // by the last statement in front of `to`
    to = checkpoint;
    unit = checkpoint.unit - 1;
  }
  execution_.goTo(writer ? *writer : origin);
  standAt();
  if (!writer) return {Stop::HistoryBegins, "nothing has changed `" + path + "`", {}, 0};
  return {Stop::DataBreakpoint, text, {}, 0};
}

bool Debugger::lookBeforeCycle(const std::function<void()>& look) {
  if (execution_.isRunning()) return false;  // in a condition
  const Moment origin = execution_.now();
  if (!execution_.goToCycle(execution_.cycle())) return false;
  look();
  execution_.goTo(origin);
  return true;
}

// ---- where it is

std::vector<DebugFrame>& Debugger::frames() {
  if (!has_frames_) frames_ = execution_.frames();
  has_frames_ = true;
  return frames_;
}

Evaluated Debugger::evaluate(std::string_view expression, const DebugFrame* frame) {
  return expressions_.evaluate(expression, frame);
}

std::string Debugger::setPlace(const Variable& place, const std::string& value) {
  const host::LoadedModule& module = execution_.session().module();
  std::string error = host::checkValue(module, place, value);
  if (!error.empty()) return error;
  if (place.address() == nullptr) return "a pointer on the path is null";
  // A variable of a call is at the same address whenever the program comes here again.
  const Variable& kept = place;
  struct Blocks {
    void* blocks[2];
    rung_context context;
  };
  const auto blocks = std::make_shared<Blocks>();
  Variable stays = kept;
  if (kept.path.empty() && kept.storage == RUNG_IN_BLOCK) {
    blocks->context = *kept.context;
    memcpy(blocks->blocks, kept.context->blocks, sizeof blocks->blocks);
    blocks->context.blocks = blocks->blocks;
    stays.context = &blocks->context;
  }
  execution_.edit([&module, stays, blocks, value] { host::assignValue(module, stays, value); });
  return "";
}

std::string Debugger::set(const std::string& expression, const std::string& value, const DebugFrame* frame) {
  const Evaluated target = evaluate(expression, frame);
  if (!target.error.empty()) return target.error;
  if (target.place.isEmpty()) return "`" + expression + "` is not a variable";
  std::string text = value;
  // An expression, or a literal in the form of the variable's type.
  const host::LoadedModule& module = execution_.session().module();
  if (!host::checkValue(module, target.place, text).empty()) {
    const Evaluated computed = evaluate(value, frame);
    if (computed.error.empty()) text = computed.value;
  }
  return setPlace(target.place, text);
}

std::string Debugger::obey(const host::Command& command) {
  const auto error = std::make_shared<std::string>();
  host::Session& session = execution_.session();
  execution_.edit([&session, command, error] { *error = session.obey(command).error; });
  return *error;
}

std::string Debugger::force(const std::string& path, const std::string& value) {
  host::Command command;
  command.kind = host::Command::Force;
  command.values.push_back({path, value});
  return obey(command);
}

std::string Debugger::unforce(const std::string& path) {
  host::Command command;
  command.kind = host::Command::Unforce;
  command.values.push_back({path, ""});
  return obey(command);
}

}  // namespace rung::debug
