// SPDX-License-Identifier: Apache-2.0
// The common part of all writers of a body: see body_part.h.
#include "codegen/body_part.h"

#include "codegen/signature.h"

namespace rung::codegen {

using ir::LocalKind;

void BodyPart::includeRecord(TypeId type) {
  type = elementOf(types_, type);
  if (types_.kind(type) != TypeKind::Record || state_.in.marks.record[type.index] == state_.in.group_number) return;
  state_.in.marks.record[type.index] = state_.in.group_number;
  group_.records.push_back(type);
}

void BodyPart::call(ir::BodyId id) {
  if (state_.in.marks.body[id.index] == state_.in.group_number) return;
  state_.in.marks.body[id.index] = state_.in.group_number;
  (facts_.is_inlined[id.index] != 0 ? group_.inlined : group_.callees).push_back(id);
}

std::string BodyPart::newName(const char* prefix) {
  std::string name = prefix;
  appendUnsigned(name, ++state_.names_created);
  return name;
}

std::string BodyPart::newVariable(TypeId type, const char* prefix) {
  std::string name = newName(prefix);
  includeRecord(type);
  declarations_ += ' ';
  appendDeclaration(declarations_, types_, type, name);
  declarations_ += ';';
  return name;
}

void BodyPart::variable(std::string& out, const ir::Local& local) const {
  if (local.kind == LocalKind::Temp) {
    out += string(local.name);
  } else {
    appendMangled(out, string(local.name));
  }
}

bool BodyPart::isWrittenBack(uint32_t number) const {
  return analysis_->fields.is_cached[number] != 0 && analysis_->uses.of[number].written;
}

void BodyPart::writeBack(std::string& out, uint32_t number) const {
  const types::Field& field = analysis_->uses.variables.field(number);
  std::string name;
  appendMangled(name, string(field.name));
  out += "self." + name + " = ";
  if (analysis_->loops.wide[number] != 0) out += '(' + std::string(scalarType(types_, field.type)) + ')';
  out += name + ';';
}

bool BodyPart::hasExit() const {
  for (uint32_t i = 0; i < analysis_->uses.variables.count(); ++i) {
    if (isWrittenBack(i) || returnsLength(i)) return true;
    if (analysis_->uses.variables.isField(i) && analysis_->slices.has(i)) return true;
  }
  return false;
}

uint8_t BodyPart::wideOf(ExprId place) const {
  const uint32_t number = analysis_->uses.variables.at(place);
  return number == kNoVariable ? uint8_t{0} : analysis_->loops.wide[number];
}

bool BodyPart::isCached(ExprId place) const {
  const uint32_t number = analysis_->uses.variables.at(place);
  return number != kNoVariable && analysis_->fields.is_cached[number] != 0;
}

bool BodyPart::returnsLength(uint32_t number) const {
  return number < body_->locals.size() && analysis_->measured.has(number) &&
         passesLength(module_, *body_, body_->locals[number]);
}

bool BodyPart::isPassedOnce(const ir::CallStmt* call, uint32_t number) const {
  if (call == nullptr || !analysis_->measured.has(number)) return false;
  const Body& callee = module_.body(call->callee);
  uint32_t times = 0;
  size_t i = 0;
  for (const ir::Local& parameter : ir::parameters(callee)) {
    const ExprId operand = i < call->operands.count ? body_->list(call->operands)[i++] : ExprId{};
    if (operand && passesLength(module_, callee, parameter))
      times += analysis_->uses.variables.stringAt(operand) == number;
  }
  return times == 1;
}

bool BodyPart::isSlice(ExprId place) const {
  return !analysis_->slices.is_slice.empty() && analysis_->slices.has(analysis_->uses.variables.stringAt(place));
}

}  // namespace rung::codegen
