// SPDX-License-Identifier: Apache-2.0
// Tasks in virtual time: see schedule.h.
#include "schedule.h"

#include <algorithm>
#include <cstring>

namespace rung::host {

Schedule::Schedule(Tasks& tasks, rung_context& context, Hsio& hsio, bool others_go_on)
    : tasks_(tasks), context_(context), hsio_(hsio), others_go_on_(others_go_on), states_(tasks.all().size()) {}

void Schedule::restart(int64_t now_ns) {
  is_in_row_ = false;
  jobs_.clear();
  interrupts_.clear();
  for (State& state : states_) state = {now_ns, false, false};
}

void Schedule::goOnFrom(const Schedule& before, int64_t now_ns) {
  restart(now_ns);
  for (const Task& task : tasks_.all()) {
    const Task* const was = before.tasks_.find(tasks_.nameOf(task));
    if (was == nullptr || was->row->kind != task.row->kind) continue;
    State& state = states_[task.index];
    const State& old_state = before.states_[was->index];
    state.was_true = old_state.was_true;
    state.raised = old_state.raised;
    if (was->interval_ns == task.interval_ns) state.next_ns = std::max(old_state.next_ns, now_ns);
  }
}

void Schedule::transfer(StateArchive& archive) {
  for (State& state : states_) archive.value(state);
  archive.values(is_in_row_, ends_first_, now_ns_, end_ns_, next_due_);
  archive.list(due_);
  archive.list(interrupts_);
  archive.list(jobs_);
}

bool Schedule::raise(const std::string& event) {
  bool found = false;
  for (const Task& task : tasks_.all()) {
    if (task.row->kind != RUNG_EXTERNAL || event != context_.module->strings + task.row->external_event) continue;
    states_[task.index].raised = found = true;
  }
  return found;
}

void Schedule::releasePeriods(uint32_t task, int64_t end_ns) {
  State& state = states_[task];
  for (; state.next_ns < end_ns; state.next_ns += tasks_.all()[task].interval_ns) due_.push_back({state.next_ns, task});
}

// Finds the activations that become due in a row. Triggers and host events are sampled at its begin.
void Schedule::release(int64_t begin_ns, int64_t end_ns) {
  due_.clear();
  for (uint32_t i = 0; i < states_.size(); ++i) {
    const Task& task = tasks_.all()[i];
    if (task.stopped) continue;
    State& state = states_[i];
    switch (static_cast<rung_task_kind>(task.row->kind)) {
      case RUNG_CYCLIC: releasePeriods(i, end_ns); break;
      case RUNG_FREEWHEELING: due_.push_back({begin_ns, i}); break;
      case RUNG_EVENT: {
        const bool is_true = readBool(task.trigger);
        if (is_true && !state.was_true) due_.push_back({begin_ns, i});
        state.was_true = is_true;
        if (task.row->interval_ns > 0 && !is_true) releasePeriods(i, end_ns);
        while (task.row->interval_ns > 0 && state.next_ns < end_ns) state.next_ns += task.row->interval_ns;
        break;
      }
      case RUNG_STATUS:
        if (readBool(task.trigger)) due_.push_back({begin_ns, i});
        break;
      case RUNG_EXTERNAL:
        if (state.raised) due_.push_back({begin_ns, i});
        state.raised = false;
        break;
    }
  }
  if (due_.size() > 1)
    std::stable_sort(due_.begin(), due_.end(),
                     [](const Release& a, const Release& b) { return a.time_ns < b.time_ns; });
}

void Schedule::enter(const Release& release) {
  const uint32_t priority = tasks_.all()[release.task].row->priority;
  size_t at = jobs_.size();
  for (size_t i = 0; i < jobs_.size(); ++i) {
    if (jobs_[i].task == release.task) {
      // It still runs or waits: this start is dropped, the grid of its periods stays. A freewheeling task has none.
      if (tasks_.all()[release.task].row->kind != RUNG_FREEWHEELING)
        tasks_.countOverruns(tasks_.all()[release.task], 1);
      return;
    }
    if (at == jobs_.size() && tasks_.all()[jobs_[i].task].row->priority > priority) at = i;
  }
  jobs_.insert(jobs_.begin() + static_cast<ptrdiff_t>(at), {release.task, release.time_ns});
}

bool Schedule::isFirstOfResource(size_t job) const {
  const uint32_t resource = tasks_.all()[jobs_[job].task].row->resource;
  for (size_t i = 0; i < job; ++i)
    if (tasks_.all()[jobs_[i].task].row->resource == resource) return false;
  return true;
}

bool Schedule::begin(size_t job, Ending& ending) {
  Job& chosen = jobs_[job];
  Task& task = tasks_.all()[chosen.task];
  chosen.start_ns = now_ns_;
  chosen.left_ns = task.row->duration_ns;
  if (tasks_.begin(task, context_, chosen.release_ns, now_ns_ - chosen.release_ns) == RUNG_FAULT_NONE) {
    if (chosen.left_ns == 0) return finish(job, ending);
    tasks_.exchange().drop(context_);  // its copies stay until its end
    return true;
  }
  if (others_go_on_ && context_.fault.kind != RUNG_FAULT_STOP) {
    tasks_.stopOne(task, context_);
    jobs_.erase(jobs_.begin() + static_cast<ptrdiff_t>(job));
    return true;
  }
  ending = Ending::faulted(context_);
  return false;
}

bool Schedule::finish(size_t job, Ending& ending) {
  Task& task = tasks_.all()[jobs_[job].task];
  const int64_t took_ns = now_ns_ - jobs_[job].start_ns;
  jobs_.erase(jobs_.begin() + static_cast<ptrdiff_t>(job));
  if (tasks_.end(task, context_, now_ns_, took_ns)) return true;
  ending.kind = Ending::Watchdog;
  ending.name = tasks_.nameOf(task);
  return false;
}

bool Schedule::advance(Ending& ending) {
  for (size_t i = 0; i < jobs_.size(); ++i) {
    if (!isFirstOfResource(i)) continue;
    if (jobs_[i].start_ns >= 0 && jobs_[i].left_ns == 0) return finish(i, ending);
    if (jobs_[i].start_ns < 0) return begin(i, ending);
  }
  return false;
}

// When the next job is complete, or `until_ns`.
int64_t Schedule::firstEnd(int64_t until_ns) const {
  for (size_t i = 0; i < jobs_.size(); ++i)
    if (isFirstOfResource(i)) until_ns = std::min(until_ns, now_ns_ + jobs_[i].left_ns);
  return until_ns;
}

// When the next interrupt occurs, or `until_ns`. Its tasks become due then.
int64_t Schedule::firstInterrupt(int64_t until_ns) {
  uint32_t interrupts = 0;
  const int64_t now_ns = hsio_.advance(until_ns, interrupts);
  for (uint32_t i = 0; interrupts >> i != 0; ++i) {
    if ((interrupts >> i & 1) == 0) continue;
    for (const Task& task : tasks_.all())
      if (task.row->kind == RUNG_EXTERNAL && !task.stopped &&
          strcasecmp(rung_hsio_event(i), context_.module->strings + task.row->external_event) == 0)
        interrupts_.push_back({now_ns, task.index});
  }
  return interrupts == 0 ? until_ns : std::min(until_ns, now_ns);
}

// Lets the first job of each resource run.
void Schedule::spend(int64_t until_ns) {
  for (size_t i = 0; i < jobs_.size(); ++i)
    if (isFirstOfResource(i)) jobs_[i].left_ns -= until_ns - now_ns_;
}

// To the next moment at which something begins or ends, or to the end of the row.
void Schedule::passTime() {
  const int64_t next_ns = next_due_ < due_.size() ? due_[next_due_].time_ns : end_ns_;
  const int64_t then = std::max(now_ns_, firstInterrupt(firstEnd(next_ns)));
  spend(then);
  is_in_row_ = then < end_ns_;
  now_ns_ = then;
  ends_first_ = true;
}

bool Schedule::hasCompleteJob() const {
  return std::any_of(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.start_ns >= 0 && job.left_ns == 0; });
}

void Schedule::enterDue() {
  for (const Release& interrupt : interrupts_) enter(interrupt);
  interrupts_.clear();
  for (; next_due_ < due_.size() && due_[next_due_].time_ns <= now_ns_; ++next_due_) enter(due_[next_due_]);
  ends_first_ = false;
}

void Schedule::beginRow(int64_t begin_ns) {
  now_ns_ = begin_ns;
  end_ns_ = begin_ns + tasks_.rowNs();
  release(begin_ns, end_ns_);
  next_due_ = 0;
  is_in_row_ = ends_first_ = true;
}

bool Schedule::step(Ending& ending) {
  while (is_in_row_) {
    if (ends_first_ && hasCompleteJob()) return advance(ending);
    if (ends_first_) enterDue();
    if (advance(ending)) return true;
    if (!ending.isComplete()) return false;
    passTime();
  }
  return false;
}

}  // namespace rung::host
