// SPDX-License-Identifier: Apache-2.0
// Points, bodies and frames of interpreted code: see debug.h.
#include "ir/interpreter/debug.h"

#include <algorithm>

#include "frontend/source/invariant.h"

namespace rung::ir::interpreter {

namespace {

const char* keep(Code& code, std::string_view text) { return code.strings.emplace_back(text).c_str(); }

}  // namespace

DebugCode::DebugCode(const Module& module, const Description& description, Code& code) : code_(code) {
  std::vector<uint32_t> number(module.bodies.size(), RUNG_NONE);
  std::vector<uint32_t> order;
  for (uint32_t i = 1; i < module.bodies.size(); ++i)
    if (code.debug_ends[i] != 0) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return code.bodies[a].at < code.bodies[b].at; });
  const char* file = keep(code, "");
  for (const uint32_t i : order) {
    const Body& body = module.bodies[i];
    const FilePosition at = filePosition(module, body, body.loc);
    if (at.path != file) file = keep(code, at.path);
    number[i] = static_cast<uint32_t>(bodies_.size());
    DebugBody& to = bodies_.emplace_back();
    to.name = keep(code, module.names.string(body.spelling ? body.spelling : body.name));
    to.file = file;
    to.line = at.line;
    to.column = at.column;
    to.first = code.bodies[i].at;
    to.end = code.debug_ends[i];
    to.is_library = body.library;
    to.is_shown = body.kind != BodyKind::Init && static_cast<bool>(body.spelling);
    to.self = description.self_types[i];
    for (size_t l = 0; l < body.locals.size(); ++l) {
      const Local& local = body.locals[l];
      if (local.kind == LocalKind::Temp || !local.name) continue;
      to.locals.push_back({keep(code, module.names.string(local.name)), description.local_types[i][l],
                           code.debug_offsets[i][l], local.by_reference, local.kind});
    }
  }
  point_of_.assign(code.insns.size(), RUNG_NONE);
  originals_.resize(code.insns.size());
  for (size_t i = 0; i < code.insns.size(); ++i) originals_[i] = code.insns[i].run;
  for (const Code::Point& point : code.points) {
    // Two statements begin with the same instruction where the first has no code.
    if (!points_.empty() && points_.back().insn == point.insn) points_.pop_back();
    point_of_[point.insn] = static_cast<uint32_t>(points_.size());
    points_.push_back({point.insn, number[point.body], point.line, point.column, point.network, point.file});
  }
  code.points.clear();
  code.debug_offsets.clear();
}

void DebugCode::arm(uint32_t point) {
  RUNG_INVARIANT(!all_armed_, "points are armed one by one, or all");
  armed_points_.push_back(point);
  code_.insns[points_[point].insn].run = stopHandler();
}

void DebugCode::armAll() {
  for (const DebugPoint& point : points_) code_.insns[point.insn].run = stopHandler();
  all_armed_ = true;
  armed_points_.clear();
}

void DebugCode::armForChanges(std::vector<Watched> watched, const std::vector<uint32_t>& points) {
  armAll();
  watched_ = std::move(watched);
  asks_.assign(code_.insns.size(), 0);
  for (const uint32_t point : points) asks_[points_[point].insn] = 1;
  takeValues();
}

void DebugCode::takeValues() {
  for (Watched& one : watched_) memcpy(one.value, one.at, one.size);
}

void DebugCode::disarmAll() {
  watched_.clear();
  const auto restore = [&](const DebugPoint& point) { code_.insns[point.insn].run = originals_[point.insn]; };
  if (all_armed_)
    for (const DebugPoint& point : points_) restore(point);
  for (const uint32_t point : armed_points_) restore(points_[point]);
  armed_points_.clear();
  all_armed_ = false;
}

const DebugBody* DebugCode::bodyAt(const Insn* ip) const {
  const auto insn = static_cast<uint32_t>(ip - code_.insns.data());
  auto after = std::upper_bound(bodies_.begin(), bodies_.end(), insn,
                                [](uint32_t at, const DebugBody& body) { return at < body.first; });
  if (after == bodies_.begin()) return nullptr;
  --after;
  return insn < after->end ? &*after : nullptr;
}

DebugFrame DebugCode::frameAt(const Insn* ip, uint8_t* fp, uint8_t* self) const {
  const DebugBody* const body = bodyAt(ip);
  if (body == nullptr) return {RUNG_NONE, "", 0, 0, fp, self};
  const auto insn = static_cast<uint32_t>(ip - code_.insns.data());
  DebugFrame frame{static_cast<uint32_t>(body - bodies_.data()), body->file, body->line, body->column, fp, self};
  auto line = std::upper_bound(code_.line_table.begin(), code_.line_table.end(), insn,
                               [](uint32_t at, const Code::LineEntry& entry) { return at < entry.insn; });
  if (line != code_.line_table.begin() && (--line)->insn >= body->first) {
    frame.line = line->line;
    frame.column = line->column;
  }
  return frame;
}

uint32_t DebugCode::pointOf(uint32_t instruction) const {
  auto after = std::upper_bound(points_.begin(), points_.end(), instruction,
                                [](uint32_t at, const DebugPoint& point) { return at < point.insn; });
  return after == points_.begin() ? RUNG_NONE : static_cast<uint32_t>(after - points_.begin() - 1);
}

std::vector<DebugFrame> DebugCode::frames(const Machine& machine, uint32_t point) const {
  std::vector<DebugFrame> frames;
  const Insn* ip = machine.ip;
  uint8_t *fp = machine.fp, *self = machine.self;
  for (;;) {
    DebugFrame frame = frameAt(ip, fp, self);
    if (frames.empty() && point != RUNG_NONE) {
      frame.line = points_[point].line;
      frame.column = points_[point].column;
    }
    if (frame.body != RUNG_NONE && bodies_[frame.body].is_shown) frames.push_back(frame);
    if (fp == machine.base) return frames;
    const Linkage& caller = *reinterpret_cast<const Linkage*>(fp);
    ip = caller.ip - 1;
    fp = caller.fp;
    self = caller.self;
  }
}

}  // namespace rung::ir::interpreter
