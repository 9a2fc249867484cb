// SPDX-License-Identifier: Apache-2.0
// Whole bodies and entries, and the data beside them: see translate.h.
#include "ir/interpreter/translate.h"

#include <algorithm>

#include "frontend/source/invariant.h"
#include "ir/walk.h"

namespace rung::ir::interpreter {

void BodyTranslator::begin() {
  beginFrame();
  local_offset_.clear();
  block_slots_.clear();
  image_slots_.clear();
  loops_.clear();
  tries_.clear();
  user_labels_.clear();
}

void BodyTranslator::layOutLocals() {
  local_offset_.resize(body_->locals.size());
  for (size_t i = 0; i < body_->locals.size(); ++i) {
    if (isParameter(body_->locals[i])) local_offset_[i] = slot().offset;
  }
  result_slot_ = slot();
  for (size_t i = 0; i < body_->locals.size(); ++i) {
    const Local& local = body_->locals[i];
    if (isParameter(local)) continue;
    if (local.kind == LocalKind::Result) {
      local_offset_[i] = result_slot_.offset;
    } else {
      local_offset_[i] = slot(info(local.type).size, info(local.type).align).offset;
    }
  }
}

// The addresses of the blocks and images that the body uses, in slots from the start.
void BodyTranslator::loadBases() {
  const auto note = [&](std::vector<std::pair<uint32_t, Ref>>& slots, uint32_t number, Handler run) {
    for (const auto& known : slots) {
      if (known.first == number) return;
    }
    slots.push_back({number, slot()});
    emit(run, slots.back().second, {number, false});
  };
  forEachStmt(*body_, body_->first, [&](StmtId id) {
    forEachRoot(module_, *body_, body_->stmt(id), [&](ExprId root, Use) {
      forEachExpr(*body_, root, [&](ExprId at) {
        const Expr& e = expr(at);
        if (const auto* global = e.tryAs<GlobalExpr>())
          note(block_slots_, blocks_.list_block[global->list], blockHandler());
        if (const auto* program = e.tryAs<ProgramExpr>())
          note(block_slots_, blocks_.program_block[program->program], blockHandler());
        if (const auto* image = e.tryAs<ImageExpr>()) note(image_slots_, image->area, imageHandler());
      });
    });
  });
}

// Scalar variables begin as 0 unless the first statements set them.
void BodyTranslator::clearVariables() {
  std::vector<bool> is_set(body_->locals.size());
  for (StmtId id = body_->first; id; id = body_->stmt(id).next) {
    const auto* assign = body_->stmt(id).tryAs<AssignStmt>();
    if (assign == nullptr) break;
    bool reads_unset = false;
    const auto note = [&](ExprId at) {
      const uint32_t* read = localOf(expr(at));
      if (read == nullptr || is_set[*read]) return;
      const LocalKind kind = body_->locals[*read].kind;
      reads_unset = reads_unset || kind == LocalKind::Variable || kind == LocalKind::Result;
    };
    const uint32_t* set = localOf(expr(assign->place));
    forEachExpr(*body_, assign->value, note);
    if (set == nullptr) forEachExpr(*body_, assign->place, note);
    if (reads_unset) break;
    if (set != nullptr) is_set[*set] = true;
  }
  for (size_t i = 0; i < body_->locals.size(); ++i) {
    const Local& local = body_->locals[i];
    if (is_set[i] || local.by_reference || isAggregate(local.type) || isString(local.type)) continue;
    if (local.kind != LocalKind::Variable && local.kind != LocalKind::Result) continue;
    emit(moveHandler(Scalar::U64, Mode::Constant, Mode::Frame), {local_offset_[i], false});
  }
}

void BodyTranslator::translate(BodyId id) {
  body_ = &module_.body(id);
  body_id_ = id;
  const auto first = static_cast<uint32_t>(code_.insns.size());
  begin();
  layOutLocals();
  return_label_ = newLabel();
  for (size_t i = 0; i < body_->labels.size(); ++i) user_labels_.push_back({newLabel(), 0});
  if (body_->has_labels) noteLabels(body_->first, 0);
  if (options_.bounded || !body_->library) emit(options_.debug ? debugStepHandler() : stepHandler());
  if (options_.coverage && body_->counted) {
    code_.strings.emplace_back(module_.names.string(body_->spelling ? body_->spelling : body_->name));
    count(body_->loc, code_.strings.back().c_str());
  }
  loadBases();
  clearVariables();
  block(body_->first);
  place(return_label_);
  emit(returnHandler());
  code_.bodies[id.index] = finishFrame(first);
  if (!options_.debug) return;
  code_.debug_ends[id.index] = static_cast<uint32_t>(code_.insns.size());
  code_.debug_offsets[id.index] = local_offset_;
}

Code::Entry BodyTranslator::translateSteps(std::span<const Step> steps) {
  static const Body kNone;
  body_ = &kNone;
  const auto first = static_cast<uint32_t>(code_.insns.size());
  begin();
  const Ref instance = slot();
  const Address self{Base::Pointer, instance, 0, 0, kNoBit};
  for (const Step& step : steps) {
    if (step.kind == Step::Clear || step.kind == Step::CallOn) emit(blockHandler(), instance, {step.block, false});
    if (step.kind == Step::Clear) {
      emit(clearHandler(Base::Pointer), instance, {},
           {static_cast<uint32_t>(info(blocks_.blocks[step.block].record).size), false});
    } else if (step.kind == Step::CallOn) {
      traceCall(step.body, &self);
      emitCall(step.body, &self, 0);
    } else if (step.kind == Step::CallOnSelf) {
      const Address given{Base::Self, {}, 0, 0, kNoBit};
      emitCall(step.body, &given, 0);
    } else {
      // A test that is a function: its parameters are zero, its results dropped.
      const Body& callee = module_.body(step.body);
      uint32_t at = kFrameHeader;
      const uint32_t before = top_;
      for (const Local& local : callee.locals) {
        if (!isParameter(local) && !(local.kind == LocalKind::Result && local.by_reference)) continue;
        const uint32_t to = at;
        if (local.kind != LocalKind::Result) at += 8;
        if (local.by_reference) {
          const Ref memory = slot(info(local.type).size, info(local.type).align);
          emit(clearHandler(Base::Frame), memory, {}, {static_cast<uint32_t>(info(local.type).size), false});
          pointerInto({Base::Frame, memory, 0, 0, kNoBit}, {to, true});
        } else {
          emit(moveHandler(Scalar::U64, Mode::Constant, Mode::Frame), {to, true});
        }
      }
      emitCall(step.body, nullptr, 0);
      top_ = before;
    }
  }
  emit(haltHandler());
  return finishFrame(first);
}

void translateData(const Module& module, Code& code) {
  for (const Data& data : module.data) {
    code.data.emplace_back((data.bytes.size() + 8) / 8);
    std::copy(data.bytes.begin(), data.bytes.end(), reinterpret_cast<uint8_t*>(code.data.back().data()));
    code.data_of_module.push_back(code.data.back().data());
  }
}

void translateDispatches(const Module& module, Code& code) {
  for (const Dispatch& dispatch : module.dispatches) code.dispatches.emplace_back(dispatch.bodies.size());
}

void link(const Module& module, Code& code) {
  for (size_t i = 0; i < code.dispatches.size(); ++i) {
    const std::vector<BodyId>& bodies = module.dispatches[i].bodies;
    for (size_t b = 0; b < bodies.size(); ++b)
      code.dispatches[i][b] = {code.bodies[bodies[b].index].at, code.bodies[bodies[b].index].frame};
  }
  for (const auto& [insn, body] : code.calls) {
    code.insns[insn].c = code.bodies[body.index].frame;
    code.insns[insn].d = code.bodies[body.index].at - insn;
  }
}

}  // namespace rung::ir::interpreter
