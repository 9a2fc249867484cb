// SPDX-License-Identifier: Apache-2.0
// A trace on the controller: see rung/scope.h.
#include "rung/scope.h"

namespace {

constexpr uint32_t kTimeBytes = sizeof(int64_t);

// An integer of 1 to 8 bytes.
double integerOf(const void* from, uint32_t size, bool is_signed) {
  uint64_t bits = 0;
  memcpy(&bits, from, size);
  if (!is_signed) return static_cast<double>(bits);
  const uint32_t shift = 64 - 8 * size;
  return static_cast<double>(static_cast<int64_t>(bits << shift) >> shift);
}

bool isSigned(const rung_type& type) {
  switch (type.kind) {
    case RUNG_SINT:
    case RUNG_INT:
    case RUNG_DINT:
    case RUNG_LINT:
    case RUNG_ENUM: return true;
    default: return type.is_signed != 0;
  }
}

bool isAtLevel(const rung_scope& scope, const rung_context& context) {
  uint64_t value = 0;
  if (!rung_read_value(&context, &scope.trigger, &value, scope.trigger.type->size)) return false;
  return rung_scope_number(&scope.trigger, &value) >= scope.level;
}

// Tells whether the row that is about to be taken is that of the trigger.
bool isTriggered(rung_scope& scope, const rung_context& context) {
  const bool is_at_level = isAtLevel(scope, context);
  const bool was_at_level = scope.was_at_level != 0;
  scope.was_at_level = is_at_level ? 1 : 0;
  const bool has_row_before = scope.taken != 0;
  switch (static_cast<rung_scope_condition>(scope.condition)) {
    case RUNG_SCOPE_NONE: return false;
    case RUNG_SCOPE_RISING: return has_row_before && !was_at_level && is_at_level;
    case RUNG_SCOPE_FALLING: return has_row_before && was_at_level && !is_at_level;
    case RUNG_SCOPE_ABOVE: return is_at_level;
    case RUNG_SCOPE_BELOW: return !is_at_level;
  }
  return false;
}

void takeRow(rung_scope& scope, const rung_context& context, int64_t now_ns) {
  uint8_t* at = scope.ring + static_cast<size_t>(scope.next) * scope.row_size;
  memcpy(at, &now_ns, kTimeBytes);
  at += kTimeBytes;
  for (uint32_t i = 0; i < scope.channel_count; ++i) {
    const uint32_t size = scope.channels[i].type->size;
    if (!rung_read_value(&context, &scope.channels[i], at, size)) memset(at, 0, size);
    at += size;
  }
  scope.next = scope.next + 1 == scope.capacity ? 0 : scope.next + 1;
  if (scope.kept < scope.capacity) ++scope.kept;
  ++scope.taken;
}

}  // namespace

extern "C" {

uint32_t rung_scope_row_size(const rung_variable* channels, uint32_t count) {
  uint32_t size = kTimeBytes;
  for (uint32_t i = 0; i < count; ++i) size += channels[i].type->size;
  return size;
}

bool rung_scope_is_trigger(const rung_variable* variable) {
  return variable->type->kind <= RUNG_UCHAR || variable->type->kind == RUNG_ENUM;
}

double rung_scope_number(const rung_variable* variable, const void* value) {
  const rung_type& type = *variable->type;
  if (type.kind == RUNG_REAL) {
    float number;
    memcpy(&number, value, sizeof number);
    return static_cast<double>(number);
  }
  double number;
  if (type.kind != RUNG_LREAL) return integerOf(value, type.size, isSigned(type));
  memcpy(&number, value, sizeof number);
  return number;
}

bool rung_scope_start(rung_scope* scope) {
  scope->row_size = rung_scope_row_size(scope->channels, scope->channel_count);
  scope->capacity = scope->ring_size / scope->row_size;
  scope->state = RUNG_SCOPE_OFF;
  scope->taken = scope->kept = scope->next = scope->trigger_row = 0;
  scope->was_at_level = scope->is_triggered = 0;
  scope->left_out = scope->divider == 0 ? 0 : scope->divider - 1;  // the first activation is sampled
  if (scope->capacity < 2 || (scope->condition != RUNG_SCOPE_NONE && scope->rows_before >= scope->capacity))
    return false;
  scope->state = scope->condition == RUNG_SCOPE_NONE ? RUNG_SCOPE_RUNNING : RUNG_SCOPE_WAITING;
  return true;
}

void rung_scope_stop(rung_scope* scope) {
  if (scope->state != RUNG_SCOPE_OFF) scope->state = RUNG_SCOPE_COMPLETE;
}

void rung_scope_sample(rung_scope* scope, const rung_context* context, int64_t now_ns) {
  if (scope->state == RUNG_SCOPE_OFF || scope->state == RUNG_SCOPE_COMPLETE) return;
  if (++scope->left_out < scope->divider) return;
  scope->left_out = 0;
  if (scope->state == RUNG_SCOPE_WAITING && isTriggered(*scope, *context)) {
    scope->trigger_row = scope->taken;
    scope->is_triggered = 1;
    scope->state = RUNG_SCOPE_TRIGGERED;
  }
  takeRow(*scope, *context, now_ns);
  if (scope->state == RUNG_SCOPE_TRIGGERED && scope->taken - scope->trigger_row >= scope->capacity - scope->rows_before)
    scope->state = RUNG_SCOPE_COMPLETE;
}

uint32_t rung_scope_read(const rung_scope* scope, uint32_t* from, void* rows, uint32_t count) {
  uint32_t age = scope->taken - *from;  // of the first row: 1 is the newest
  if (age > scope->kept) age = scope->kept;
  *from = scope->taken - age;
  if (count > age) count = age;
  uint32_t at = scope->next >= age ? scope->next - age : scope->next + scope->capacity - age;
  for (uint32_t i = 0; i < count; ++i) {
    memcpy(static_cast<uint8_t*>(rows) + static_cast<size_t>(i) * scope->row_size,
           scope->ring + static_cast<size_t>(at) * scope->row_size, scope->row_size);
    at = at + 1 == scope->capacity ? 0 : at + 1;
  }
  return count;
}

int64_t rung_scope_time(const void* row) {
  int64_t now_ns;
  memcpy(&now_ns, row, sizeof now_ns);
  return now_ns;
}

const void* rung_scope_value(const rung_scope* scope, const void* row, uint32_t channel) {
  const uint8_t* at = static_cast<const uint8_t*>(row) + kTimeBytes;
  for (uint32_t i = 0; i < channel; ++i) at += scope->channels[i].type->size;
  return at;
}

}  // extern "C"
