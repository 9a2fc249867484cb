// SPDX-License-Identifier: Apache-2.0
// Native bodies of synchronization.st. Tasks in real time are threads, so shared state is atomic; the host waits
// (rung_host::wait). In virtual time no task runs while another waits, so waiting is an error at once.
#include "rung/code.h"

namespace {

bool waits(const rung_context* ctx) {
  return ctx->host != nullptr && ctx->host->wait != nullptr && ctx->host->wait(ctx->host_data) != 0;
}

}  // namespace

extern "C" {

uint32_t rung_standard_HOST_LOCK(rung_context* ctx, uint32_t* owner, uint8_t once) {
  const uint32_t own = ctx->task + 1;  // outside of tasks: 1
  for (;;) {
    uint32_t seen = 0;
    if (__atomic_compare_exchange_n(owner, &seen, own, false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED))
      return RUNG_LOCK_FREE;
    if (seen == own) return RUNG_LOCK_OWN;
    if (once != 0 || !waits(ctx)) return RUNG_LOCK_HELD;
  }
}

uint32_t rung_standard_HOST_UNLOCK(rung_context* ctx, uint32_t* owner) {
  uint32_t seen = ctx->task + 1;
  return __atomic_compare_exchange_n(owner, &seen, 0, false, __ATOMIC_RELEASE, __ATOMIC_RELAXED) ? RUNG_LOCK_FREE
                                                                                                 : RUNG_LOCK_NOT_OWN;
}

uint32_t rung_standard_HOST_ACQUIRE(rung_context* ctx, uint32_t* count, uint32_t limit, uint8_t once) {
  for (;;) {
    uint32_t seen = __atomic_load_n(count, __ATOMIC_RELAXED);
    while (seen < limit)
      if (__atomic_compare_exchange_n(count, &seen, seen + 1, false, __ATOMIC_ACQUIRE, __ATOMIC_RELAXED))
        return RUNG_LOCK_FREE;
    if (once != 0 || !waits(ctx)) return RUNG_SEMA_EMPTY;
  }
}

uint32_t rung_standard_HOST_RELEASE(rung_context*, uint32_t* count) {
  uint32_t seen = __atomic_load_n(count, __ATOMIC_RELAXED);
  while (seen > 0)
    if (__atomic_compare_exchange_n(count, &seen, seen - 1, false, __ATOMIC_RELEASE, __ATOMIC_RELAXED))
      return RUNG_LOCK_FREE;
  return RUNG_SEMA_FULL;
}

uint32_t rung_standard_TEST_AND_SET(rung_context*, uint32_t* flag) {
  return __atomic_exchange_n(flag, 1, __ATOMIC_ACQ_REL);
}

int32_t rung_standard_HOST_ADD(rung_context*, int32_t* value, int32_t summand) {
  return static_cast<int32_t>(__atomic_fetch_add(value, summand, __ATOMIC_ACQ_REL));
}

uint8_t rung_standard_HOST_SWAP_DWORD(rung_context*, uint32_t* value, uint32_t old, uint32_t wanted) {
  return __atomic_compare_exchange_n(value, &old, wanted, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE) ? 1 : 0;
}

}  // extern "C"
