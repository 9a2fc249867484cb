// SPDX-License-Identifier: Apache-2.0
// A program that is loaded and can run: see session.h.
#include "session.h"

#include <unistd.h>
#include <algorithm>
#include <ctime>
#include <utility>

#include "clock.h"
#include "crashes.h"
#include "rung/host.h"
#include "rung/retain.h"
#include "sockets.h"
#include "value_format.h"

namespace rung::host {
namespace {

int64_t systemNs() {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * int64_t{1'000'000'000} + now.tv_nsec;
}

}  // namespace

SessionOptions SessionOptions::of(const RunOptions& run) {
  SessionOptions options;
  options.interval_ns = run.interval_ns;
  options.max_steps = run.max_steps;
  options.others_go_on = run.others_go_on;
  options.realtime = run.realtime;
  options.files_root = run.files_root;
  options.serial = run.serial;
  options.drivers = run.drivers;
  return options;
}

Session::Session(const rung_module& module, const SessionOptions& options, SessionHooks hooks)
    : options_(options),
      hooks_(std::move(hooks)),
      program_(std::make_unique<Program>(module, around())),
      served_(program_->module) {
  drivers_.attach(program_->module, program_->memory);
  if (options.is_isolated) {
    simulated_channels_.emplace(program_->memory.context(), served_);
  } else {
    files_.emplace(options.files_root, options.realtime);
    channels_.emplace(options.serial, served_);
  }
  program_->memory.context().host = &host_;
  program_->memory.context().host_data = this;
  program_->memory.context().step_limit = options.max_steps;
  serve();
}

Session::~Session() = default;

// ---- services of the host

int64_t Session::unsetClock() const { return options_.realtime ? systemNs() : program_->memory.context().now_ns; }

int64_t Session::onClock(void* data) {
  const Session& session = *static_cast<Session*>(data);
  return session.controller_.clock(session.unsetClock());
}
bool Session::onSetClock(void* data, int64_t ns) {
  Session& session = *static_cast<Session*>(data);
  return session.controller_.setClock(session.unsetClock(), ns);
}
bool Session::onNetwork(void* data, uint32_t port, rung_network* addresses) {
  return static_cast<Session*>(data)->controller_.network(port, *addresses);
}
bool Session::onSetNetwork(void* data, uint32_t port, const rung_network* addresses) {
  return static_cast<Session*>(data)->controller_.setNetwork(port, *addresses);
}
void Session::onMessage(void* data, uint8_t severity, const char* text) {
  static_cast<Session*>(data)->hooks_.message(severity, text);
}
void Session::onAssertion(void* data, const rung_assertion* assertion, bool passed, const char* expected,
                          const char* actual) {
  static_cast<Session*>(data)->hooks_.assertion(*assertion, passed, expected, actual);
}
void Session::onCall(void* data, const char* pou, const void* instance) {
  static_cast<Session*>(data)->hooks_.called(pou, instance);
}

void Session::serve() {
  host_.wall_clock = onClock;
  host_.set_wall_clock = onSetClock;
  host_.network = onNetwork;
  host_.set_network = onSetNetwork;
  host_.diagnosis = &controller_.diagnosis();
  if (hooks_.message) host_.message = onMessage;
  if (hooks_.assertion) host_.assertion = onAssertion;
  hsio_.serve(host_);
  if (simulated_channels_) simulated_channels_->serve(host_);
  if (channels_) channels_->serve(host_);
  if (files_) files_->serve(host_);
  if (hooks_.serving) hooks_.serving(host_);
  if (options_.is_isolated) return;
  if (gethostname(machine_name_, sizeof machine_name_ - 1) == 0) host_.name = machine_name_;
  host_.address = findOwnAddress(machine_address_, sizeof machine_address_);
}

// ---- the beginning and the end

bool Session::load(std::string& error) {
  for (const std::string& driver : options_.drivers)
    if (!drivers_.load(driver, error)) return error.insert(0, "--driver: "), false;
  drivers_.serve(host_);
  drivers_.simulateModules(program_->symbols, hsio_, controller_.diagnosis());
  program_->tasks.serveImage(served_);
  if (!program_->tasks.prepare(error)) return false;
  countRows();
  return true;
}

// A cycle of an NCT program is one of its main program: T_PLC.
void Session::countRows() {
  const Task* const main = isNct(program_->module) ? program_->tasks.find("Main") : nullptr;
  rows_per_cycle_ = main == nullptr ? 1 : std::max<int64_t>(main->interval_ns / program_->tasks.rowNs(), 1);
}

void Session::switchOn() {
  program_->forces.unforceAll();
  program_->tasks.switchOn();
  controller_.reset();
  hsio_.reset();
  served_.reset();
  if (channels_ && !is_replaying_) channels_->closeAll();
  if (simulated_channels_) simulated_channels_->reset();
  std::function<void(const std::string&)> on_message;
  if (hooks_.message) on_message = [this](const std::string& text) { hooks_.message(RUNG_MESSAGE_NOTE, text.c_str()); };
  control_.serve(program_->module, host_, on_message);
  is_stopped_ = is_single_cycle_ = false;
  pace_ns_ = 0;
}

Ending Session::init() {
  switchOn();
  return endingOf(program_->memory.reset());
}

Ending Session::begin() {
  rung_context& context = program_->memory.context();
  if (hooks_.called) host_.called = onCall;
  begin_ns_ = base_ns_ = context.now_ns;
  cycle_ = row_ = rows_done_ = 0;
  if (test_ != RUNG_NONE) {
    context.entry = rung_test_at(context.module, test_);
    context.task = program_->module.tasks.size() + 1;  // none of the module's: only MUTEX and SEMA look at it
    return call(program_->module.tests[test_].init);
  }
  program_->schedule.restart(base_ns_);
  program_->tasks.readInputs(base_ns_);
  return {};
}

Ending Session::call(void (*function)(rung_context*)) {
  return function == nullptr ? Ending{} : endingOf(guarded(&program_->memory.context(), function));
}

Ending Session::endTest() { return call(program_->module.tests[test_].exit); }
Ending Session::end() { return endingOf(program_->memory.end()); }

// ---- virtual time

// A program with open channels keeps pace with the clock: peers do.
void Session::keepPace() {
  if (!channels_ || !channels_->isUsed() || is_replaying_) {
    pace_ns_ = 0;
    return;
  }
  const int64_t row_ns = program_->tasks.rowNs();
  if (pace_ns_ == 0) pace_ns_ = monotonicNs() - (rows_done_ - 1) * row_ns;
  channels_->runUntil(pace_ns_ + rows_done_ * row_ns);
}

Ending Session::testCycle() {
  rung_context& context = program_->memory.context();
  if (cycle_ > 0) context.now_ns += options_.interval_ns;  // the test may have moved it: TEST_ADVANCE
  context.activation = static_cast<uint32_t>(cycle_) + 1;
  served_.exchange(context.areas);
  Ending ending = call(program_->module.tests[test_].run);
  if (!ending.isComplete()) return ending;
  served_.exchange(context.areas);
  if (simulated_channels_) simulated_channels_->answerMasters();
  return ending;
}

bool Session::isDone() const {
  const rung_test& test = program_->module.tests[test_];
  return test.done_block == RUNG_NONE || program_->memory.block(test.done_block)[test.done_offset] != 0;
}

bool Session::activate(Ending& ending) {
  const int64_t last_row = cycle_ * rows_per_cycle_;
  if (row_ == rows_done_ && !program_->schedule.isInRow()) keepPace();
  if (is_stopped_) row_ = last_row + 1;
  for (; row_ <= last_row; ++row_) {
    if (test_ != RUNG_NONE) {
      ++row_;
      ending = testCycle();
      return ending.isComplete();
    }
    if (!program_->schedule.isInRow()) {
      program_->tasks.applyForces();
      program_->schedule.beginRow(base_ns_ + row_ * program_->tasks.rowNs());
    }
    if (program_->schedule.step(ending)) return true;
    if (!ending.isComplete()) return false;
  }
  const std::string lost = program_->tasks.lostDriver();
  if (!lost.empty()) ending = {Ending::Driver, {}, nullptr, lost};
  return false;
}

Ending Session::cycle() {
  Ending ending;
  while (activate(ending)) {
  }
  return ending;
}

void Session::completeCycle() {
  row_ = rows_done_ = cycle_ * rows_per_cycle_ + 1;
  ++cycle_;
  if (before_ && cycle_ > before_->last_cycle) before_.reset();
}

void Session::stopAfterSingleCycle() {
  if (!is_single_cycle_) return;
  is_single_cycle_ = false;
  stop();
}

// ---- real time

RealtimeResult Session::runInRealTime(const RealtimeOptions& options, const RealtimeHooks& hooks) {
  threads_ = std::make_unique<Realtime>(program_->tasks, program_->memory.context(), options, hooks);
  if (is_stopped_) threads_->pause();  // by a reset after a fault
  channels_->start();
  files_->work().start();  // not in the first cycle that needs it
  RealtimeResult result = threads_->run();
  const auto goesBack = [&] {
    return !result.hung && !result.ending.isComplete() && hooks.go_back && hooks.go_back(result.ending);
  };
  while (result.is_left || goesBack()) {
    if (result.is_left) {  // for threads that run already
      result = threads_->run();
      continue;
    }
    auto next = threads_->successor(program_->tasks, program_->memory.context());
    left_threads_.push_back(std::exchange(threads_, std::move(next)));
    result = threads_->runAfter(*left_threads_.back());
  }
  for (const std::unique_ptr<Realtime>& left : left_threads_) left->join();
  channels_->stop();
  rows_done_ += result.rows;
  return result;
}

// Interrupts are noticed at the starts of rows and when the caller's thread has time.
void Session::raiseInterrupts() {
  uint32_t interrupts = 0;
  do {
    hsio_.advance(threads_->programNs(), interrupts);
    for (uint32_t i = 0; interrupts >> i != 0; ++i)
      if ((interrupts >> i & 1) != 0) threads_->raise(rung_hsio_event(i));
  } while (interrupts != 0);
}

// ---- commands

void Session::stop() {
  is_stopped_ = true;
  markStopped();
  makeOutputsSafe();
}

void Session::resume() {
  is_stopped_ = false;
  controller_.diagnosis().stopped = 0;
  program_->tasks.restoreOutputs();
}

// TM/TP manual 4.1.4: what a reset keeps. The program is stopped after it.
Ending Session::reset(rung_start kind) {
  rung_context& context = program_->memory.context();
  std::vector<uint64_t> kept(rung_retain_bytes(context.module) / 8 + 1);
  program_->memory.end();
  rung_retain_pack(&context, kept.data());
  if (channels_) channels_->closeAll();
  const int64_t now = nowNs();
  Ending ending = endingOf(program_->memory.reset(true));
  if (!ending.isComplete()) return ending;
  rung_retain_unpack(&context, kept.data(), kind);
  context.now_ns = now;
  program_->schedule.restart(nextRowNs());
  program_->tasks.restart();
  stop();
  return ending;
}

// In virtual time the cycle that follows is it.
bool Session::cycleOnce() {
  if (!is_stopped_) return true;
  program_->tasks.restoreOutputs();
  if (!threads_) {
    is_single_cycle_ = true;
    is_stopped_ = false;
    return true;
  }
  const bool goes_on = threads_->cycle();
  makeOutputsSafe();
  return goes_on;
}

bool Session::raise(const std::string& event) {
  return threads_ ? threads_->raise(event) : program_->schedule.raise(event);
}

void Session::obeyAtRest(const Command& command, Answer& answer) {
  switch (command.kind) {
    case Command::Stop: stop(); break;
    case Command::Start: resume(); break;
    case Command::Cycle: answer.goes_on = cycleOnce(); break;
    case Command::Reset:
      answer.ending = reset(command.start);
      answer.goes_on = answer.ending.isComplete();
      break;
    case Command::Event:
      if (!raise(command.event)) answer.warning = "no task waits for the event `" + command.event + "`";
      break;
    case Command::Status: answer.text = program_->tasks.statistics(0) + controller_.faults(); break;
    case Command::Quit: answer.goes_on = false; break;
    case Command::Change: break;  // change
    case Command::Get:
    case Command::Set:
    case Command::Force:
    case Command::Unforce:
    case Command::Forces: break;  // obeyForValues
  }
}

// ---- values that a user reads, writes and forces

bool Session::findAll(const Command& command, std::vector<Variable>& variables, std::string& error) const {
  for (const Command::Value& value : command.values)
    if (!program_->symbols.find(value.path, variables.emplace_back(), error)) return false;
  return true;
}

std::string Session::get(const Command& command, std::string& values) const {
  constexpr uint64_t kMost = 100'000;
  std::vector<Variable> named, listed;
  std::string error;
  if (!findAll(command, named, error)) return error;
  uint64_t total = 0;
  for (size_t i = 0; i < named.size(); ++i) {
    total += program_->symbols.count(*named[i].type, Symbols::Detail::Watched);
    if (total > kMost) return "more than " + std::to_string(kMost) + " variables, at `" + command.values[i].path + "`";
    named[i].path = command.values[i].path;  // as --watch shows it
    if (named[i].type->kind == RUNG_POINTER)
      listed.push_back(named[i]);
    else
      program_->symbols.expand(named[i], listed, Symbols::Detail::Watched);
  }
  for (const Variable& variable : listed) {
    values += variable.path + " = ";
    formatValue(program_->module, variable, values);
    values += '\n';
  }
  return "";
}

std::string Session::set(const Command& command) {
  std::vector<Variable> variables;
  std::string error;
  if (!findAll(command, variables, error)) return error;
  for (size_t i = 0; i < variables.size(); ++i) {
    error = checkValue(program_->module, variables[i], command.values[i].text);
    if (error.empty() && variables[i].address() == nullptr)
      error = whyRefused(program_->module, variables[i], RUNG_ACCESS_NULL, "");
    if (!error.empty()) return error;
  }
  for (size_t i = 0; i < variables.size(); ++i) assignValue(program_->module, variables[i], command.values[i].text);
  return "";
}

std::string Session::force(const Command& command) {
  std::vector<Variable> variables;
  std::string error;
  if (!findAll(command, variables, error)) return error;
  for (size_t i = 0; i < variables.size(); ++i)
    if (error = program_->forces.check(variables[i], command.values[i].text); !error.empty()) return error;
  if (!program_->forces.hasRoom(variables.size()))
    return whyRefused(program_->module, variables.front(), RUNG_ACCESS_FULL, "");
  for (size_t i = 0; i < variables.size(); ++i) program_->forces.force(variables[i], command.values[i].text);
  program_->tasks.noteForces();
  if (!is_stopped_) program_->tasks.applyForces();
  return "";
}

std::string Session::unforce(const Command& command) {
  std::vector<Variable> variables;
  std::string error;
  if (command.values.size() == 1 && command.values[0].path == "*") return program_->forces.unforceAll(), "";
  if (!findAll(command, variables, error)) return error;
  for (const Variable& variable : variables) program_->forces.unforce(variable);
  return "";
}

// In real time between two activations, of which none is lost.
Answer Session::obeyForValues(const Command& command) {
  beAtEase();  // a list of values may be long
  Answer answer;
  const auto act = [&] {
    if (command.kind == Command::Get) answer.error = get(command, answer.values);
    if (command.kind == Command::Set) answer.error = set(command);
    if (command.kind == Command::Force) answer.error = force(command);
    if (command.kind == Command::Unforce) answer.error = unforce(command);
    if (command.kind == Command::Forces) answer.values = program_->forces.list();
  };
  answer.is_busy = !between(act);
  if (answer.is_busy) answer.error = "no moment between two activations was found within a second";
  return answer;
}

bool Session::between(const std::function<void()>& act) {
  if (threads_) return threads_->between(act);
  act();
  return true;
}

// In real time other tasks rest meanwhile.
Answer Session::obey(const Command& command) {
  if (command.isAboutValues()) return obeyForValues(command);
  Answer answer;
  const bool pauses = threads_ && command.kind != Command::Event && command.kind != Command::Status;
  if (pauses && !threads_->pause()) {
    answer.goes_on = false;
    answer.hangs = true;
    return answer;
  }
  std::unique_lock<std::mutex> rest;
  if (pauses) rest = threads_->rest();
  obeyAtRest(command, answer);
  if (threads_ && answer.goes_on && !is_stopped_) threads_->resume();
  return answer;
}

// ---- the state

void Session::transfer(StateArchive& archive) {
  program_->memory.transfer(archive);
  program_->forces.transfer(archive);
  program_->tasks.transfer(archive);
  program_->schedule.transfer(archive);
  controller_.transfer(archive);
  hsio_.transfer(archive);
  drivers_.transfer(archive);
  control_.transfer(archive);
  served_.transfer(archive);
  if (simulated_channels_) simulated_channels_->transfer(archive);
  archive.values(cycle_, row_, rows_done_, begin_ns_, base_ns_, is_stopped_, is_single_cycle_);
}

SessionState Session::save() {
  SessionState state;
  StateArchive archive = StateArchive::saving(state);
  transfer(archive);
  return state;
}

void Session::restore(const SessionState& state) {
  StateArchive archive = StateArchive::restoring(state);
  transfer(archive);
  pace_ns_ = 0;
}

}  // namespace rung::host
