/* SPDX-License-Identifier: Apache-2.0 */
/* rtos.h on pthreads, for tests on a PC: one thread at a time runs, the most urgent that is ready. Time passes when all
 * sleep, so that each run is the same. */
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>

#include "board.h"
#include "rtos.h"

typedef struct thread {
  rtos_task* task;
  void (*run)(void*);
  void* argument;
  unsigned priority;
  uint32_t wake; /* sleeps until this tick */
  bool waits;    /* for a notification */
  bool notified;
  pthread_t id;
} thread;

static thread threads[8];
static unsigned thread_count;
static uint32_t now;
static thread* running; /* null: the scheduler */
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t changed = PTHREAD_COND_INITIALIZER;

static bool is_ready(const thread* t) { return t->waits ? t->notified : t->wake <= now; }

static thread* most_urgent(void) {
  thread* found = NULL;
  for (thread* t = threads; t < threads + thread_count; ++t)
    if (is_ready(t) && (found == NULL || t->priority > found->priority)) found = t;
  return found;
}

/* Lets the most urgent thread run, until it is the turn of `self` again. */
static void yield(thread* self) {
  pthread_mutex_lock(&mutex);
  running = most_urgent();
  pthread_cond_broadcast(&changed);
  while (running != self) pthread_cond_wait(&changed, &mutex);
  pthread_mutex_unlock(&mutex);
}

static void* begin(void* argument) {
  thread* self = argument;
  pthread_mutex_lock(&mutex);
  while (running != self) pthread_cond_wait(&changed, &mutex);
  pthread_mutex_unlock(&mutex);
  self->run(self->argument);
  return NULL;
}

void rtos_create(rtos_task* task, const char* name, void (*run)(void*), void* argument, unsigned priority, void* stack,
                 size_t stack_bytes) {
  thread* t = &threads[thread_count++];
  (void)stack; /* a thread of the PC has a stack of its own */
  t->task = task;
  t->run = run;
  t->argument = argument;
  t->priority = priority;
  printf("task %s: priority %u, %u bytes of stack\n", name, priority, (unsigned)stack_bytes);
}

void rtos_start(void) {
  for (thread* t = threads; t < threads + thread_count; ++t) pthread_create(&t->id, NULL, begin, t);
  for (; board_runs(now); ++now) {
    plant_tick();
    yield(NULL);
    board_trace(now);
  }
}

uint32_t rtos_now(void) { return now; }

void rtos_sleep_until(uint32_t tick) {
  running->wake = tick;
  yield(running);
}

void rtos_wait(void) {
  thread* self = running;
  self->waits = true;
  yield(self);
  self->waits = self->notified = false;
}

void rtos_notify(rtos_task* task) {
  for (thread* t = threads; t < threads + thread_count; ++t)
    if (t->task == task) t->notified = true;
}

void rtos_lock(void) {}
void rtos_unlock(void) {}
