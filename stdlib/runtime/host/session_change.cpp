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
  ChangeReport outcome;
  if (const char* const why = refusal(next_module)) return outcome.error = why, outcome;
  const LoadedModule module(next_module);
  Change change(program_->module, module);
  Next next;
  beAtEase();
  endLeft();
  if (change.plan()) {
    next.program = std::make_unique<Program>(next_module, std::move(keeper), around(), *program_, change.kept());
    if (threads_ && !is_only_asked)
      next.threads = threads_->successor(next.program->tasks, next.program->memory.context());
    next.saved.resize(program_->memory.bytes());  // room that is ready
  }
  if (!next.program)
    outcome.error = "the change is refused";
  else if (!between([&] { changeAtRest(change, next, is_only_asked, rollback_cycles, outcome); }))
    outcome.error = "no moment between two activations was found within a second";
  if (next.threads) next.threads->abandon();
  ChangeReport report = change.report();
  report.error = std::move(outcome.error);
  report.unforced = std::move(outcome.unforced);
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

void Session::saveMemory(std::vector<uint8_t>& to) {
  to.clear();
  StateArchive saving = StateArchive::saving(to);
  program_->memory.transfer(saving);
}

// Takes `next` where it takes over. Of the report only the error and what is not forced any more; no task runs
// meanwhile.
void Session::changeAtRest(Change& change, Next& next, bool is_only_asked, int64_t rollback_cycles,
                           ChangeReport& outcome) {
  rung_context& context = program_->memory.context();
  if (!change.check(context)) return void(outcome.error = "the change is refused");
  if (!program_->schedule.isIdle()) return void(outcome.error = "an activation of a task has not ended");
  const bool is_ready = prepare(*next.program, outcome);
  if (is_only_asked) drivers_.attach(program_->module, program_->memory);
  if (is_only_asked || !is_ready) return;

  if (is_stopped_) program_->memory.restoreOutputs();
  saveMemory(next.saved);
  rung_context& context_of_next = next.program->memory.context();
  context_of_next.now_ns = context.now_ns;
  rung_context* faulted = nullptr;
  if (change.apply(context, context_of_next, faulted) != RUNG_FAULT_NONE) {
    outcome.error = "FB_Exit, FB_Init or FB_Reinit failed: " + describeFault(*faulted, faulted->fault, {});
    StateArchive restoring = StateArchive::restoring(next.saved);
    program_->memory.transfer(restoring);
    drivers_.attach(program_->module, program_->memory);
    if (is_stopped_) program_->memory.makeOutputsSafe();
    return;
  }
  if (before_) left_programs_.push_back(std::move(before_->program));
  before_.reset();
  outcome.unforced = takeOver(std::move(next.program));
  if (rollback_cycles > 0) {
    before_.emplace(Before{std::move(left_programs_.back()), std::move(next.saved), cyclesNow() + rollback_cycles});
    left_programs_.pop_back();
  }
  if (!next.threads) return;
  threads_->leaveTo(*next.threads);
  left_threads_.push_back(std::exchange(threads_, std::move(next.threads)));
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
