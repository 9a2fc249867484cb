// SPDX-License-Identifier: Apache-2.0
// See recorded_code.h.
#include "ir/interpreter/recorded_code.h"

#include <algorithm>

namespace rung::ir::interpreter {

void RecordedCode::count(Loc loc, const char* function) {
  if (!options_.coverage || !body_->counted || !loc) return;
  if (function == nullptr && loc == body_->loc) return;  // made for the header: not a statement of the source
  const FilePosition position = filePosition(module_, *body_, loc);
  const char* file = code_.counters.empty() ? nullptr : code_.counters.back().file;
  if (file == nullptr || position.path != file) file = code_.strings.emplace_back(position.path).c_str();
  code_.counters.push_back({file, function, position.line, 0});
  emit(countHandler(), {}, {}, {}, 0, reinterpret_cast<int64_t>(&code_.counters.back().count));
}

bool RecordedCode::countsBranches(Loc loc) const { return options_.coverage && body_->counted && loc; }

void RecordedCode::countBranch(Loc loc, uint32_t branch) {
  if (!countsBranches(loc)) return;
  count(loc, nullptr);
  if (loc == body_->loc) return;
  Counter& counter = code_.counters.back();
  counter.column = filePosition(module_, *body_, loc).column;
  counter.branch = branch;
}

void RecordedCode::recordLocation(Loc loc) {
  if (!loc || (!code_.line_table.empty() && recorded_loc_ == loc)) return;
  recorded_loc_ = loc;
  const FilePosition at = filePosition(module_, *body_, loc);
  const NameId pou = body_->spelling ? body_->spelling : body_->name;
  code_.line_table.push_back({static_cast<uint32_t>(code_.insns.size()), pool_.add(module_.names.string(pou)),
                              pool_.add(at.path), at.line, at.column});
}

// Where the networks of a file begin: lines of the notation, and of the ladder of NCT.
const std::vector<uint32_t>& RecordedCode::networksOf(FileId file) {
  const auto [at, is_new] = networks_.try_emplace(file.index);
  if (!is_new) return at->second;
  const std::string_view text = module_.sources.sourceText(file);
  const uint32_t base = module_.sources.begin(file).offset;
  for (size_t line = text.find('\n'); line != std::string_view::npos; line = text.find('\n', line + 1)) {
    const std::string_view rest = text.substr(line + 1, 7);
    if (rest.starts_with("NETWORK") || rest.starts_with("RUNG"))
      at->second.push_back(base + static_cast<uint32_t>(line));
  }
  return at->second;
}

// The last network of the body before a location; 0: none.
uint32_t RecordedCode::lastNetwork(Loc body, Loc loc) {
  const FileId file = module_.sources.fileOf(loc);
  if (!body || !loc || module_.sources.fileOf(body) != file) return 0;
  const std::vector<uint32_t>& all = networksOf(file);
  const auto after = std::upper_bound(all.begin(), all.end(), loc.offset);
  return after == all.begin() || *(after - 1) < body.offset ? 0 : *(after - 1);
}

uint32_t RecordedCode::networkOf(Loc loc) {
  const uint32_t network = lastNetwork(body_->loc, loc);
  if (network != 0) return network;
  return lastNetwork(module_.sources.originalLocation(body_->loc), module_.sources.originalLocation(loc));
}

// What Rung makes for the header of a POU is not a statement of the source.
void RecordedCode::recordPoint(Loc loc) {
  if (!options_.debug || body_->library || body_->kind == BodyKind::Init || !loc || loc == body_->loc) return;
  if (point_body_ == body_id_.index && point_loc_ == loc) return;
  point_body_ = body_id_.index;
  point_loc_ = loc;
  const FilePosition at = filePosition(module_, *body_, loc);
  const char* file = code_.points.empty() ? nullptr : code_.points.back().file;
  if (file == nullptr || at.path != file) file = code_.strings.emplace_back(at.path).c_str();
  code_.points.push_back(
      {static_cast<uint32_t>(code_.insns.size()), body_id_.index, at.line, at.column, networkOf(loc), file});
}

void RecordedCode::countStep() {
  if (options_.bounded || !(body_->library && body_->pure)) emit(options_.debug ? debugStepHandler() : stepHandler());
}

void RecordedCode::traceCall(BodyId id, const Address* self) {
  const Body& callee = module_.body(id);
  if (!options_.trace_calls || body_->library || (callee.library && !callee.self)) return;
  if (callee.kind == BodyKind::Init || !callee.spelling) return;
  if (code_.called.size() <= id.index) code_.called.resize(module_.bodies.size());
  const char*& name = code_.called[id.index];
  if (name == nullptr) {
    code_.strings.push_back(callee.self ? types_.toString(callee.self)
                                        : std::string(module_.names.string(callee.spelling)));
    name = code_.strings.back().c_str();
  }
  Ref instance = slot();
  if (self != nullptr) {
    instance = pointerTo(*self);
  } else {
    emit(moveHandler(Scalar::U64, Mode::Constant, Mode::Frame), instance);
  }
  emit(calledHandler(), {}, instance, {}, 0, reinterpret_cast<int64_t>(name));
}

}  // namespace rung::ir::interpreter
