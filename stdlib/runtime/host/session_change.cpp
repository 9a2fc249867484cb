// SPDX-License-Identifier: Apache-2.0
// Another version of the program takes over in a running session, or gives way to the one before: see session.h.
#include <algorithm>

#include "faults.h"
#include "session.h"

namespace rung::host {

// Devices and triggers of the next version. False: the report says what is wrong.
bool Session::prepare(Program& next, ChangeReport& report) {
  drivers_.addTerminals(next.symbols);
  drivers_.attach(next.module, next.memory);
  const bool is_ready = next.tasks.prepare(report.error);
  next.tasks.goOnFrom(program_->tasks);
  if (is_ready) return true;
  drivers_.attach(program_->module, program_->memory);
  return false;
}

// Time and forces go on; the one that leaves is kept for a while, for its threads or for goBack().
// Returns the paths of variables that are not forced any more.
std::vector<std::string> Session::takeOver(std::unique_ptr<Program> next) {
  const int64_t rows = rows_done_ + (threads_ ? threads_->rowsDone() : 0);
  const int64_t next_row_ns = base_ns_ + rows * program_->tasks.rowNs();
  next->schedule.goOnFrom(program_->schedule, next_row_ns);
  std::vector<std::string> unforced = next->forces.takeFrom(program_->forces);
  next->memory.context().now_ns = program_->memory.context().now_ns;
  served_.attach(next->module);
  drivers_.attach(next->module, next->memory);
  std::swap(program_, next);
  base_ns_ = next_row_ns - rows * program_->tasks.rowNs();
  program_->tasks.noteForces();
  left_programs_.push_back(std::move(next));
  if (is_stopped_) program_->memory.makeOutputsSafe();
  if (hooks_.changed) hooks_.changed();
  return unforced;
}

// What takes time is done while the program goes on.
ChangeReport Session::change(const rung_module& next_module, std::shared_ptr<const void> keeper, bool is_only_asked,
                             int64_t rollback_cycles) {
  ChangeReport report;
  if (const char* const why = refusal(next_module)) return report.error = why, report;
  endLeft();
  const LoadedModule module(next_module);
  Change change(program_->module, module);
  const bool is_possible = change.plan();
  report = change.report();
  report.error = is_possible ? "" : "the change is refused";
  if (!is_possible) return report;
  auto next = std::make_unique<Program>(next_module, std::move(keeper), around(), *program_, change.kept());
  const auto act = [&] { report = changeAtRest(change, std::move(next), is_only_asked, rollback_cycles); };
  if (!threads_)
    act();
  else if (!threads_->between(act))
    report.error = "no moment between two activations was found within a second";
  return report;
}

// Forgets versions that others have followed, where no thread of theirs sleeps any more.
void Session::endLeft() {
  const auto hasEnded = [](const std::unique_ptr<Realtime>& threads) { return threads->hasEnded(); };
  if (!std::all_of(left_threads_.begin(), left_threads_.end(), hasEnded)) return;
  for (const std::unique_ptr<Realtime>& threads : left_threads_) threads->join();
  left_threads_.clear();
  left_programs_.clear();
}

ChangeReport Session::changeAtRest(Change& change, std::unique_ptr<Program> next, bool is_only_asked,
                                   int64_t rollback_cycles) {
  rung_context& context = program_->memory.context();
  const bool is_possible = change.check(context);
  ChangeReport report = change.report();
  if (!is_possible) report.error = "the change is refused";
  if (is_possible && !program_->schedule.isIdle()) report.error = "an activation of a task has not ended";
  if (!report.error.empty()) return report;
  const bool is_ready = prepare(*next, report);
  if (is_only_asked) drivers_.attach(program_->module, program_->memory);
  if (is_only_asked || !is_ready) return report;

  if (is_stopped_) program_->memory.restoreOutputs();
  std::vector<uint8_t> saved;
  StateArchive saving = StateArchive::saving(saved);
  program_->memory.transfer(saving);
  next->memory.context().now_ns = context.now_ns;
  rung_context* faulted = nullptr;
  if (change.apply(context, next->memory.context(), faulted) != RUNG_FAULT_NONE) {
    report.error = "FB_Exit, FB_Init or FB_Reinit failed: " + describeFault(*faulted, faulted->fault, {});
    StateArchive restoring = StateArchive::restoring(saved);
    program_->memory.transfer(restoring);
    drivers_.attach(program_->module, program_->memory);
    if (is_stopped_) program_->memory.makeOutputsSafe();
    return report;
  }
  if (before_) left_programs_.push_back(std::move(before_->program));
  before_.reset();
  report.unforced = takeOver(std::move(next));
  if (rollback_cycles > 0) {
    before_.emplace(Before{std::move(left_programs_.back()), std::move(saved), cyclesNow() + rollback_cycles});
    left_programs_.pop_back();
  }
  if (threads_) threads_->leave();
  return report;
}

bool Session::goBack() {
  if (!before_ || cyclesNow() > before_->last_cycle) return false;
  Before before = std::move(*before_);
  before_.reset();
  StateArchive restoring = StateArchive::restoring(before.memory);
  before.program->memory.transfer(restoring);
  before.program->tasks.goOnFrom(program_->tasks);
  before.program->tasks.restart();
  before.program->forces.unforceAll();
  if (!threads_) completeCycle();
  takeOver(std::move(before.program));
  return true;
}

}  // namespace rung::host
