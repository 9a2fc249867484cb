// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/execution.h"

#include <algorithm>

#include "stdlib/runtime/host/clock.h"
#include "stdlib/runtime/host/faults.h"
#include "tools/driver/options.h"

namespace rung::debug {
namespace {

constexpr int64_t kLeastDistanceNs = 2'000'000;  // of two checkpoints
constexpr int kShareOfSaving = 20;               // 1/20 of the time goes into checkpoints
constexpr size_t kDenseCheckpoints = 16;         // the newest stay as they are
constexpr int64_t kDefaultCycles = 100, kMaxTestCycles = 100'000;
constexpr int kFailed = 4, kFaulted = 3;

Execution* debugged = nullptr;  // programs run one at a time

}  // namespace

Execution::Execution(std::shared_ptr<driver::ProgramVersion> version, ExecutionOptions options)
    : version_(std::move(version)), options_(std::move(options)), is_test_(!options_.test.empty()) {
  host::SessionHooks hooks;
  hooks.message = [this](uint8_t severity, const char* text) { onMessage(severity, text); };
  hooks.assertion = [this](const rung_assertion& assertion, bool passed, const char* expected, const char* actual) {
    onAssertion(assertion, passed, expected, actual);
  };
  hooks.serving = [this](rung_host& host) {
    log_.serve(host);
    host.faulted = onFaulted;
  };
  host::SessionOptions wanted = host::SessionOptions::of(options_.run);
  wanted.is_isolated = is_test_;
  session_ = std::make_unique<host::Session>(*version_->module, wanted, hooks);
  code().listen(this);
  order_.is_armed.resize(code().points().size());
  past_.checkpoints.push_back({});
  debugged = this;
  thread_ = std::thread([this] { work(); });
}

Execution::~Execution() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    quits_ = leaves_ = true;
    turn_ = Turn::Program;
  }
  handed_over_.notify_all();
  thread_.join();
  code().disarmAll();
  debugged = nullptr;
}

bool Execution::load(std::string& error) {
  const host::RunOptions& run = options_.run;
  if (is_test_) {
    const auto& tests = session_->module().tests;
    uint32_t number = 0;
    while (number < tests.size() && session_->module().strings + tests[number].name != options_.test) ++number;
    if (number == tests.size()) return error = "there is no test `" + options_.test + "`", false;
    session_->chooseTest(number);
  } else if (!session_->load(error)) {
    return false;
  }
  inputs_.emplace(session_->symbols());
  if (!run.inputs_path.empty() && !inputs_->load(run.inputs_path, error)) return false;
  trace_.emplace(session_->symbols());
  const host::Trace::Use use = run.trace_path.empty() ? host::Trace::Use::LastRow : host::Trace::Use::Rows;
  if (!trace_->choose(run.watch, use, error)) return error.insert(0, "--watch: "), false;
  if (!trace_->open(run.trace_path, run.out, error)) return false;
  if (!run.stop_on.empty() && !stop_on_.emplace(session_->symbols()).parse(run.stop_on, error))
    return error.insert(0, "--stop-on: "), false;
  if (!run.retain_path.empty()) {
    retain_.emplace(session_->symbols(), session_->memory(), run.retain_path);
    if (!retain_->open(error)) return false;
  }
  const int64_t cycle_ns = session_->cycleNs();
  cycles_ = run.cycles >= 0             ? run.cycles
            : run.for_ns >= 0           ? (run.for_ns + cycle_ns - 1) / cycle_ns
            : is_test_                  ? kMaxTestCycles
            : inputs_->lastCycle() >= 0 ? inputs_->lastCycle() + 1
                                        : kDefaultCycles;
  return true;
}

// ---- the hand-over

void Execution::work() {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    handed_over_.wait(lock, [this] { return turn_ == Turn::Program; });
  }
  runOn();
}

void Execution::park(Outcome outcome) {
  std::unique_lock<std::mutex> lock(mutex_);
  outcome_ = outcome;
  turn_ = Turn::Client;
  handed_over_.notify_all();
  handed_over_.wait(lock, [this] { return turn_ == Turn::Program; });
}

Outcome Execution::resume() {
  std::unique_lock<std::mutex> lock(mutex_);
  turn_ = Turn::Program;
  is_running_.store(true);
  handed_over_.notify_all();
  handed_over_.wait(lock, [this] { return turn_ == Turn::Client; });
  is_running_.store(false);
  return outcome_;
}

// In the thread of the program, inside an activation: leaves it where the client wants to be elsewhere.
void Execution::parkAt(const Moment& at, const Machine& machine, Outcome outcome) {
  now_ = at;
  machine_ = &machine;
  park(outcome);
  machine_ = nullptr;
  if (leaves_) rung_raise(machine.ctx, RUNG_FAULT_STOP, RUNG_NONE, 0);
}

void Execution::interrupt() {
  interrupted_.store(true);
  code().interrupt();
}

// ---- forward

int64_t Execution::stepsOf(const Machine& machine) {
  const rung_context& context = *machine.ctx;
  return (context.step_limit > 0 ? context.step_limit : INT64_MAX) - context.steps;
}

void Execution::applyEdits(const Moment& at) {
  for (; past_.next_edit < past_.edits.size() && past_.edits[past_.next_edit].at == at; ++past_.next_edit)
    past_.edits[past_.next_edit].change();
}

bool Execution::reaches(const Moment& at) { return order_.goal && *order_.goal == at; }

void Execution::atPoint(uint32_t point, const Machine& machine) {
  const Moment at{now_.unit, stepsOf(machine), point};
  applyEdits(at);
  if (reaches(at)) return parkAt(at, machine, {Outcome::Reached});
  const bool is_asked = order_.judge != nullptr && (order_.armed.all || order_.is_armed[point]);
  const bool stops = is_asked && order_.judge->stopsAt(at, machine);
  if (order_.hasGoal()) return;
  if (stops) return parkAt(at, machine, {Outcome::Stopped});
  if (!interrupted_.exchange(false)) return;
  code().forgetInterrupt();
  parkAt(at, machine, {Outcome::Interrupted});
}

Moment Execution::instructionOf(const Machine& machine) const {
  return {now_.unit, stepsOf(machine), kAtInstruction | version_->program->debug()->instruction(machine.ip)};
}

// A __TRY handles it; the host hears of all others, whoever raises them.
void Execution::atFault(const Machine& machine, uint8_t, uint32_t) {
  if (machine.ctx->fault_target == machine.ctx->stop_target) return;
  const Moment at = instructionOf(machine);
  if (reaches(at)) return parkAt(at, machine, {Outcome::Reached});
  if (order_.judge != nullptr && order_.judge->stopsAtFault(at, true) && !order_.hasGoal())
    parkAt(at, machine, {Outcome::Stopped});
}

void Execution::onFaulted(void*, const rung_context* context) {
  Execution& self = *debugged;
  const Machine* const machine = ir::interpreter::Program::running();
  if (self.leaves_ || machine == nullptr || machine->ctx != context) return;
  const Moment at = self.instructionOf(*machine);
  if (self.reaches(at)) return self.parkAt(at, *machine, {Outcome::Reached});
  if (self.order_.judge != nullptr && self.order_.judge->stopsAtFault(at, false) && !self.order_.hasGoal())
    self.parkAt(at, *machine, {Outcome::Stopped});
}

void Execution::onMessage(uint8_t severity, const char* text) {
  if (log_.isFirstReport()) options_.print(host::messageLine(session_->nowNs(), severity, text) + "\n", true);
}

void Execution::onAssertion(const rung_assertion& assertion, bool passed, const char* expected, const char* actual) {
  if (passed) return;
  place_.has_failed = true;
  const std::string location = host::shownPath(paths(), assertion.file) + ':' + std::to_string(assertion.line);
  const std::string text = location + ": " + host::describeAssertion(assertion, expected, actual);
  const bool is_new = is_test_ || std::find(reported_.begin(), reported_.end(), location) == reported_.end();
  if (log_.isFirstReport() && is_new) {
    reported_.push_back(location);
    options_.print(text + "\n", true);
  }
  const Machine* const machine = ir::interpreter::Program::running();
  if (machine == nullptr) return;
  const Moment at = instructionOf(*machine);
  if (reaches(at)) return parkAt(at, *machine, {Outcome::Reached});
  if (order_.judge != nullptr && order_.judge->stopsAtAssertion(at) && !order_.hasGoal())
    parkAt(at, *machine, {Outcome::Stopped});
}

// True: it was parked, and may be somewhere else now.
bool Execution::parksAtBorder() {
  const bool begins_cycle = place_.phase == Phase::Cycles && !place_.is_in_cycle;
  if (reaches(now_) || (begins_cycle && place_.cycle == order_.goal_cycle)) return park({Outcome::Reached}), true;
  if (place_.phase == Phase::Over) return park({Outcome::Ended, exit_code_}), true;
  if (order_.hasGoal()) return false;
  if (interrupted_.exchange(false)) {
    code().forgetInterrupt();
    return park({Outcome::Interrupted}), true;
  }
  if (!begins_cycle || is_asked_ || order_.judge == nullptr) return false;
  is_asked_ = true;
  if (!order_.judge->stopsAtCycle(now_, place_.cycle)) return false;
  return park({Outcome::Stopped}), true;
}

void Execution::runOn() {
  while (!quits_) {
    if (leaves_) {
      leaves_ = false;
      park({Outcome::Reached});
      continue;
    }
    applyEdits(now_);
    if (parksAtBorder()) continue;
    keepCheckpoint();
    session_->setReplaying(now_.unit <= past_.last_unit);
    past_.last_unit = std::max(past_.last_unit, now_.unit);
    if (!runUnit()) continue;
    now_ = {now_.unit + 1};
    is_asked_ = false;
  }
}

// The next piece of the run. False: the activation was left.
bool Execution::runUnit() {
  host::Ending ending;
  switch (place_.phase) {
    case Phase::Init:
      ending = session_->init();
      place_.phase = Phase::Begin;
      break;
    case Phase::Begin:
      if (retain_)
        retain_->restore(options_.run.start >= 0 ? static_cast<rung_start>(options_.run.start)
                         : retain_->hasData()    ? RUNG_WARM
                                                 : RUNG_COLD);
      ending = session_->begin();
      for (const auto& [path, value] : options_.run.sets) host::applySet(session_->symbols(), path, value);
      place_.phase = cycles_ > 0 ? Phase::Cycles : Phase::End;
      break;
    case Phase::Cycles:
      if (!runCycles(ending)) return false;
      break;
    case Phase::TestEnd:
      ending = session_->endTest();
      place_.phase = Phase::End;
      break;
    case Phase::End:
      ending = session_->end();
      if (!leaves_) finish(ending);
      return !leaves_;
    case Phase::Over: return true;
  }
  if (leaves_) return false;
  if (!ending.isComplete()) finish(ending);
  return true;
}

bool Execution::runCycles(host::Ending& ending) {
  if (!place_.is_in_cycle) {
    inputs_->apply(place_.cycle);
    place_.is_in_cycle = true;
  }
  if (session_->activate(ending) || !ending.isComplete()) return !leaves_;
  if (leaves_) return false;
  if (place_.cycle >= past_.traced_cycles) {
    trace_->row(place_.cycle,
                is_test_ ? session_->nowNs() : session_->rowTimeNs(place_.cycle * session_->rowsPerCycle()));
    past_.traced_cycles = place_.cycle + 1;
  }
  session_->completeCycle();
  place_.is_in_cycle = false;
  ++place_.cycle;
  const bool is_done = is_test_ ? session_->isDone() : stop_on_ && stop_on_->holds();
  if (is_done || place_.cycle >= cycles_) place_.phase = is_test_ ? Phase::TestEnd : Phase::End;
  return true;
}

// As `rung run` ends: what is printed is printed once.
void Execution::finish(const host::Ending& ending) {
  const bool is_first = log_.isFirstReport();
  place_.phase = Phase::Over;
  exit_code_ = place_.has_failed && is_test_ ? kFailed : driver::kSuccess;
  const std::string last_row = trace_->lastRow();
  session_->makeOutputsSafe();
  std::string error;
  if (!ending.isComplete()) {
    exit_code_ = is_test_ ? kFailed : kFaulted;
    if (is_first) options_.print(host::describeEnding(ending, session_->context(), paths()) + "\n", true);
  }
  if (!is_first) return;
  if (retain_ && ending.isComplete()) {
    retain_->copy(session_->nextRowNs());
    if (!retain_->save(error)) options_.print("error: " + error + "\n", true);
  }
  if (!trace_->close(error)) options_.print("error: " + error + "\n", true);
  if (is_test_) {
    options_.print(options_.test + (exit_code_ == 0 ? ": passed\n" : ": failed\n"), false);
  } else if (options_.run.trace_path.empty()) {
    options_.print(
        (ending.isComplete() ? last_row : std::string()) + std::to_string(session_->cyclesDone()) + " cycles\n", false);
  }
}

std::string Execution::faultText() {
  return host::describeFault(session_->context(), session_->context().fault, paths());
}

Outcome Execution::run(Judge& judge, const Armed& armed) {
  order_.judge = &judge;
  order_.armed = armed;
  order_.goal.reset();
  order_.goal_cycle = -1;
  arm();
  return resume();
}

// At the points of the judge, of changes that are to be done again, and of the goal.
void Execution::arm() {
  code().disarmAll();
  std::fill(order_.is_armed.begin(), order_.is_armed.end(), false);
  std::vector<uint32_t> points = order_.armed.points;
  for (const uint32_t point : points) order_.is_armed[point] = true;
  const auto add = [&](uint32_t point) {
    if (point < order_.is_armed.size()) points.push_back(point);
  };
  for (size_t i = past_.next_edit; i < past_.edits.size(); ++i) add(past_.edits[i].at.point);
  if (order_.goal) add(order_.goal->point);
  if (order_.armed.all && order_.armed.watched.empty()) return code().armAll();
  if (order_.armed.all) return code().armForChanges(order_.armed.watched, points);
  for (const uint32_t point : points) code().arm(point);
}

// ---- the past

void Execution::keepCheckpoint() {
  if (now_.unit <= past_.checkpoints.back().unit) return;
  const int64_t begin_ns = host::monotonicNs();
  if (place_.phase > Phase::Begin && begin_ns < past_.next_checkpoint_ns) return;
  Checkpoint& created = past_.checkpoints.emplace_back();
  created = {now_.unit, log_.position(), place_, session_->save()};
  past_.checkpoint_bytes += created.state.size();
  const int64_t end_ns = host::monotonicNs();
  past_.next_checkpoint_ns = end_ns + std::max(kLeastDistanceNs, (end_ns - begin_ns) * kShareOfSaving);
  if (historyBytes() <= options_.history_bytes) return;
  thinOut();
  if (log_.bytes() > options_.history_bytes / 2) forgetOldest();
}

// The answers of files and peers are needed as a whole from the first checkpoint on, so half of them go with the
// checkpoints that need them.
void Execution::forgetOldest() {
  const size_t half = log_.position() - log_.bytes() / 2;
  while (past_.checkpoints.size() > 1 && past_.checkpoints.front().log < half) {
    past_.checkpoint_bytes -= past_.checkpoints.front().state.size();
    past_.checkpoints.pop_front();
  }
  log_.forgetBefore(past_.checkpoints.front().log);
}

// Every second of the older ones goes, so that the oldest are the sparsest. The first two stay.
void Execution::thinOut() {
  if (past_.checkpoints.size() < kDenseCheckpoints + 4) return;
  std::deque<Checkpoint> kept;
  const size_t older = past_.checkpoints.size() - kDenseCheckpoints;
  past_.checkpoint_bytes = 0;
  for (size_t i = 0; i < past_.checkpoints.size(); ++i) {
    if (i >= 2 && i < older && i % 2 == 0) continue;
    past_.checkpoint_bytes += past_.checkpoints[i].state.size();
    kept.push_back(std::move(past_.checkpoints[i]));
  }
  past_.checkpoints = std::move(kept);
}

const Execution::Checkpoint& Execution::findCheckpoint(int64_t unit) const {
  auto after = std::upper_bound(past_.checkpoints.begin(), past_.checkpoints.end(), unit,
                                [](int64_t wanted, const Checkpoint& it) { return wanted < it.unit; });
  return *--after;
}

Moment Execution::checkpointFor(int64_t unit) const { return {findCheckpoint(unit).unit}; }

void Execution::leaveActivation() {
  if (!isInside()) return;
  leaves_ = true;
  resume();
}

void Execution::restore(const Checkpoint& checkpoint) {
  leaveActivation();
  if (checkpoint.place.phase != Phase::Init) session_->restore(checkpoint.state);
  session_->setReplaying(true);
  log_.goTo(checkpoint.log);
  place_ = checkpoint.place;
  now_ = {checkpoint.unit};
  is_asked_ = false;
  inputs_->goTo(place_.is_in_cycle ? place_.cycle + 1 : place_.cycle);
  past_.next_edit = 0;
  while (past_.next_edit < past_.edits.size() && past_.edits[past_.next_edit].at.unit < checkpoint.unit)
    ++past_.next_edit;
}

void Execution::restart() {
  leaveActivation();
  log_.clear();
  past_ = {};
  past_.checkpoints.push_back({});
  place_ = {};
  now_ = {};
  is_asked_ = false;
  inputs_->goTo(0);
}

void Execution::goTo(const Moment& moment) {
  if (moment == now_) return;
  restore(findCheckpoint(moment.unit));
  order_.judge = nullptr;
  order_.armed = {};
  order_.goal = moment;
  order_.goal_cycle = -1;
  arm();
  resume();
  order_.goal.reset();
}

bool Execution::goToCycle(int64_t cycle) {
  size_t last = past_.checkpoints.size() - 1;
  const auto isBefore = [&](const Place& it) {
    return it.phase <= Phase::Cycles && (it.cycle < cycle || (it.cycle == cycle && !it.is_in_cycle));
  };
  while (last > 0 && !isBefore(past_.checkpoints[last].place)) --last;
  if (!isBefore(past_.checkpoints[last].place)) return false;
  restore(past_.checkpoints[last]);
  order_.judge = nullptr;
  order_.armed = {};
  order_.goal.reset();
  order_.goal_cycle = cycle;
  arm();
  const Outcome outcome = resume();
  order_.goal_cycle = -1;
  return outcome.kind == Outcome::Reached;
}

void Execution::replay(const Moment& to, Judge& judge, const Armed& armed) {
  order_.judge = &judge;
  order_.armed = armed;
  order_.goal = to;
  order_.goal_cycle = -1;
  arm();
  resume();
  order_.goal.reset();
  order_.judge = nullptr;
}

void Execution::edit(std::function<void()> change) {
  past_.edits.resize(past_.next_edit);
  ++past_.next_edit;
  log_.cut();
  past_.last_unit = now_.unit;
  while (past_.checkpoints.back().unit > now_.unit) {
    past_.checkpoint_bytes -= past_.checkpoints.back().state.size();
    past_.checkpoints.pop_back();
  }
  change();
  past_.edits.push_back({now_, std::move(change)});
}

std::string Execution::change(std::shared_ptr<driver::ProgramVersion> next, std::string& report) {
  const host::ChangeReport made = session_->change(*next->module, next, false, 0);
  report = made.text();
  if (!made.error.empty()) return made.error;
  code().disarmAll();
  code().listen(nullptr);
  version_ = std::move(next);
  code().listen(this);
  order_.is_armed.assign(code().points().size(), false);
  const auto note = [&](const char* option, const std::vector<std::string>& missing) {
    for (const std::string& path : missing)
      report += std::string("warning: ") + option + ": the program does not have `" + path + "` any more\n";
  };
  note("--inputs", inputs_->moveTo(session_->symbols()));
  note("--watch", trace_->moveTo(session_->symbols()));
  std::string error;
  if (stop_on_ && !stop_on_.emplace(session_->symbols()).parse(options_.run.stop_on, error)) {
    report += "warning: --stop-on: " + error + "\n";
    stop_on_.reset();
  }
  if (retain_ && !retain_->moveTo(session_->symbols(), session_->memory(), error)) report += "warning: " + error + "\n";
  forgetPast();
  return "";
}

// The history begins where the program is, between two activations.
void Execution::forgetPast() {
  log_.clear();
  const int64_t traced = past_.traced_cycles;
  past_ = {};
  past_.traced_cycles = traced;
  past_.last_unit = now_.unit - 1;
  past_.checkpoints.push_back({now_.unit, 0, place_, session_->save()});
  past_.checkpoint_bytes = past_.checkpoints.back().state.size();
}

std::vector<DebugFrame> Execution::frames() {
  if (machine_ == nullptr) return {};
  return code().frames(*machine_, now_.point < kAtInstruction ? now_.point : RUNG_NONE);
}

uint64_t Execution::memoryHash() {
  uint64_t hash = 14695981039346656037ull;
  std::vector<uint8_t> memory;
  host::StateArchive archive = host::StateArchive::saving(memory);
  session_->memory().transfer(archive);
  for (const uint8_t byte : memory) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
}

}  // namespace rung::debug
