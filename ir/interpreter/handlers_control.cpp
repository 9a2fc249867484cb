// SPDX-License-Identifier: Apache-2.0
// Calls, faults and assertions: see handlers.h.
#include "ir/interpreter/debug.h"
#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"

namespace rung::ir::interpreter {

namespace {

void jump(RUNG_HANDLER_PARAMETERS) { RUNG_JUMP; }

// A callee finds its caller in front of its frame.
inline uint8_t* enter(const Insn* ip, uint8_t* fp, uint8_t* self, Machine* m) {
  uint8_t* const frame = fp + ip->a;
  if (RUNG_UNLIKELY(m->limit - frame < static_cast<ptrdiff_t>(ip->c)))
    fail(m, fp, self, RUNG_FAULT_STACK, static_cast<uint32_t>(ip->imm), 0);
  *reinterpret_cast<Linkage*>(frame) = {ip + 1, fp, self};
  return frame;
}
void call(RUNG_HANDLER_PARAMETERS) {
  uint8_t* const frame = enter(ip, fp, self, m);
  RUNG_GO(ip + static_cast<int32_t>(ip->d), frame, nullptr);
}
void callOnSelf(RUNG_HANDLER_PARAMETERS) {
  uint8_t* const frame = enter(ip, fp, self, m);
  RUNG_GO(ip + static_cast<int32_t>(ip->d), frame, self + ip->b);
}
void callOnPointer(RUNG_HANDLER_PARAMETERS) {
  uint8_t* const frame = enter(ip, fp, self, m);
  RUNG_GO(ip + static_cast<int32_t>(ip->d), frame, load<uint8_t*>(fp + ip->b));
}
void callVirtual(RUNG_HANDLER_PARAMETERS) {
  const VirtualCall& call = *reinterpret_cast<const VirtualCall*>(ip->imm);
  uint8_t* const object = load<uint8_t*>(fp + ip->b);
  const uint32_t number = load<uint32_t>(object), index = number - call.first;
  if (RUNG_UNLIKELY(index >= call.count || call.entries[index].frame == 0))
    fail(m, fp, self, RUNG_FAULT_CAST, call.site, RUNG_NO_SUCH_METHOD);
  const VirtualEntry entry = call.entries[index];
  uint8_t* const frame = fp + ip->a;
  if (RUNG_UNLIKELY(m->limit - frame < static_cast<ptrdiff_t>(entry.frame)))
    fail(m, fp, self, RUNG_FAULT_STACK, call.site, 0);
  *reinterpret_cast<Linkage*>(frame) = {ip + 1, fp, self};
  RUNG_GO(ip - ip->d + entry.at, frame, object);
}
void giveBack(RUNG_HANDLER_PARAMETERS) {
  const Linkage caller = *reinterpret_cast<const Linkage*>(fp);
  RUNG_GO(caller.ip, caller.fp, caller.self);
}
void halt(RUNG_HANDLER_PARAMETERS) { m->ip = nullptr; }
void pass(RUNG_HANDLER_PARAMETERS) { RUNG_NEXT; }

// In the place of the instruction that begins an armed point.
void stop(RUNG_HANDLER_PARAMETERS) {
  if (!m->debug->isQuiet(ip)) {
    m->ip = ip;
    m->fp = fp;
    m->self = self;
    m->debug->stopAt(ip, *m);
  }
  const Handler original = m->debug->original(ip);
  RUNG_TAIL_CALL original(ip, fp, self, m);
}

void native(RUNG_HANDLER_PARAMETERS) {
  m->ip = ip;  // for siteOfCrash
  m->fp = fp;  // for siteOfCall
  m->self = self;
  reinterpret_cast<NativeThunk>(ip->imm)(m->ctx, reinterpret_cast<uint64_t*>(fp + ip->a));
  RUNG_NEXT;
}

// The frame of a try is the body's, so that what it shares with the body is in memory.
struct Guarded {
  const Insn* ip;
  uint8_t *fp, *self;
  Machine* m;
};
[[gnu::noinline]] uint8_t guarded(const Insn* ip, uint8_t* fp, uint8_t* self, Machine* m) {
  Guarded inside{ip, fp, self, m};
  return rung_try(
      m->ctx,
      [](void* data) {
        const Guarded& at = *static_cast<Guarded*>(data);
        execute(at.ip, at.fp, at.self, at.m);
      },
      &inside);
}
void tryBlock(RUNG_HANDLER_PARAMETERS) {
  store<uint8_t>(fp + ip->a, guarded(ip + 1, fp, self, m));
  RUNG_JUMP;
}
void rethrow(RUNG_HANDLER_PARAMETERS) {
  if (load<uint8_t>(fp + ip->a) != 0) {
    const rung_fault fault = m->ctx->fault;
    rung_raise(m->ctx, fault.kind, fault.site, fault.value);
  }
  RUNG_NEXT;
}
void raise(RUNG_HANDLER_PARAMETERS) {
  fail(m, fp, self, static_cast<rung_fault_kind>(ip->a), ip->d, load<int64_t>(fp + ip->b));
}

void step(RUNG_HANDLER_PARAMETERS) {
  if (rung_step(m->ctx)) fail(m, fp, self, RUNG_FAULT_STOP, m->site_of == nullptr ? 0 : m->site_of(m->ctx, ip), 0);
  RUNG_NEXT;
}

// The same in code that a debugger stops in endless loops.
void debugStep(RUNG_HANDLER_PARAMETERS) {
  if (RUNG_UNLIKELY(m->debug->isInterrupted()) && !m->debug->areAllArmed()) m->debug->armAll();
  if (rung_step(m->ctx)) fail(m, fp, self, RUNG_FAULT_STOP, m->site_of(m->ctx, ip), 0);
  RUNG_NEXT;
}

void count(RUNG_HANDLER_PARAMETERS) {
  ++*reinterpret_cast<uint64_t*>(ip->imm);
  RUNG_NEXT;
}
void called(RUNG_HANDLER_PARAMETERS) {
  const rung_host* const host = m->ctx->host;
  if (host != nullptr && host->called != nullptr)
    host->called(m->ctx->host_data, reinterpret_cast<const char*>(ip->imm), load<const void*>(fp + ip->b));
  RUNG_NEXT;
}

// ---- assertions: slots b (condition or expected), b + 8 (left or actual), b + 16 (right or tolerance), b + 24
// (message)

template <AssertionKind K>
void assertion(RUNG_HANDLER_PARAMETERS) {
  m->ip = ip;  // for a debugger
  m->fp = fp;
  m->self = self;
  const AssertionSite& site = *reinterpret_cast<const AssertionSite*>(ip->imm);
  const uint8_t* const slots = fp + ip->b;
  rung_assertion is = site.is;
  if (site.has_message) is.message = load<const char*>(slots + 24);
  if constexpr (K == AssertionKind::Truth) {
    rung_assert(m->ctx, &is, load<uint8_t>(slots) != 0);
  } else if constexpr (K == AssertionKind::Compared) {
    rung_assert_compared(m->ctx, &is, load<uint8_t>(slots) != 0, site.kind, load<uint64_t>(slots + 8),
                         load<uint64_t>(slots + 16));
  } else if constexpr (K == AssertionKind::Equal) {
    rung_assert_equal(m->ctx, &is, site.kind, load<uint64_t>(slots), load<uint64_t>(slots + 8));
  } else {
    rung_assert_near(m->ctx, &is, site.kind, load<double>(slots), load<double>(slots + 8), load<double>(slots + 16));
  }
  RUNG_NEXT;
}

}  // namespace

void fail(Machine* m, const uint8_t* fp, const uint8_t* self, rung_fault_kind kind, uint32_t site, int64_t value) {
  m->fp = const_cast<uint8_t*>(fp);
  m->self = const_cast<uint8_t*>(self);
  if (m->debug != nullptr) {
    if (site != 0) m->ip = m->debug->insnOfSite(site - 1);
    m->debug->fault(*m, kind, site == 0 ? RUNG_NONE : site - 1);
  }
  rung_raise(m->ctx, kind, site == 0 ? RUNG_NONE : site - 1, value);
}

void execute(const Insn* ip, uint8_t* fp, uint8_t* self, Machine* m) {
#if RUNG_INTERPRETER_JUMPS
  ip->run(ip, fp, self, m);
#else
  m->ip = ip;
  m->fp = fp;
  m->self = self;
  while (m->ip != nullptr) m->ip->run(m->ip, m->fp, m->self, m);
#endif
}

uint32_t siteOfCall(const Insn* call) {
  return call->c == 0 ? reinterpret_cast<const VirtualCall*>(call->imm)->site : static_cast<uint32_t>(call->imm);
}

Handler jumpHandler() { return jump; }
Handler callHandler() { return call; }
Handler callOnSelfHandler() { return callOnSelf; }
Handler callOnPointerHandler() { return callOnPointer; }
Handler callVirtualHandler() { return callVirtual; }
Handler returnHandler() { return giveBack; }
Handler haltHandler() { return halt; }
Handler passHandler() { return pass; }
Handler stopHandler() { return stop; }
Handler nativeHandler() { return native; }
Handler tryHandler() { return tryBlock; }
Handler rethrowHandler() { return rethrow; }
Handler raiseHandler() { return raise; }
Handler stepHandler() { return step; }
Handler debugStepHandler() { return debugStep; }
Handler countHandler() { return count; }
Handler calledHandler() { return called; }
Handler assertHandler(AssertionKind kind) {
  switch (kind) {
    case AssertionKind::Truth: return assertion<AssertionKind::Truth>;
    case AssertionKind::Compared: return assertion<AssertionKind::Compared>;
    case AssertionKind::Equal: return assertion<AssertionKind::Equal>;
    case AssertionKind::Near: return assertion<AssertionKind::Near>;
  }
  return nullptr;
}

}  // namespace rung::ir::interpreter
