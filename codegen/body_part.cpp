// SPDX-License-Identifier: Apache-2.0
// The common part of all writers of a body: see body_part.h.
#include "codegen/body_part.h"

#include "codegen/cxx/print.h"
#include "codegen/signature.h"

namespace rung::codegen {

using ir::LocalKind;

void BodyState::begin(cxx::Position place) {
  if (begins) add(tree.stmt(cxx::StmtKind::Nothing));
  begins = true;
  at = place;
}

void BodyState::add(cxx::Stmt* stmt) {
  cxx::Statements one;
  one.add(stmt);
  add(one);
}

void BodyState::add(const cxx::Statements& list) {
  if (begins && !list.empty()) {
    list.first()->begins = true;
    list.first()->at = at;
    begins = false;
  }
  to->append(list);
}

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

cxx::Variable* BodyPart::declare(const cxx::Type& type, std::string_view name, Ex value) {
  cxx::Variable* const made = tree_.variable(type, name, value);
  state_.declarations.add(tree_.declare(made));
  return made;
}

cxx::Variable* BodyPart::declare(std::string_view type, std::string_view name, Ex value) {
  return declare(cxx::Type{tree_.kept(type), {}, {}}, name, value);
}

cxx::Ex BodyPart::newVariable(TypeId type, const char* prefix) {
  includeRecord(type);
  return tree_.fixed(declare(valueType(tree_, types_, type), newName(prefix))->name);
}

void BodyPart::variable(std::string& out, const ir::Local& local) const {
  if (local.kind == LocalKind::Temp) {
    out += string(local.name);
  } else {
    appendMangled(out, string(local.name));
  }
}

cxx::Ex BodyPart::variable(const ir::Local& local) {
  return local.kind == LocalKind::Temp ? tree_.fixed(string(local.name)) : mangledName(local.name);
}

std::string BodyPart::mangled(NameId name) const {
  std::string out;
  appendMangled(out, string(name));
  return out;
}

std::string_view BodyPart::keptMangled(NameId name) {
  BodyState::Mangled& known = state_.mangled[name.index % state_.mangled.size()];
  if (known.name != name.index) known = {name.index, tree_.kept(mangled(name))};
  return known.text;
}

cxx::Ex BodyPart::constantOf(TypeId type, uint64_t bits) {
  std::string text;
  appendConstant(text, types_, type, bits);
  return tree_.constant(text, text[0] == '-');
}

cxx::Ex BodyPart::quoted(std::string_view text, bool wide) {
  std::string out;
  wide ? appendQuotedWide(out, text) : appendQuoted(out, text);
  return tree_.name(out);
}

cxx::Ex BodyPart::raiseNoted() {
  const Ex at = tree_.fixed("at");
  const Ex site = tree_.infix(Operator::Add, tree_.name("sites_" + group_.stem),
                              tree_.infix(Operator::ShiftRight, at, tree_.number(4)));
  return tree_.call("rung_raise", {tree_.fixed("ctx"), tree_.infix(Operator::BitAnd, at, tree_.number(15)), site,
                                   tree_.fixed("value")});
}

std::string BodyPart::pointerTo(TypeId type, bool constant) {
  return cxx::toString(pointerType(tree_, types_, type, constant), "");
}

bool BodyPart::isWrittenBack(uint32_t number) const {
  return analysis_->fields.is_cached[number] != 0 && analysis_->uses.of[number].written;
}

cxx::Ex BodyPart::writeBack(uint32_t number) {
  const types::Field& field = analysis_->uses.variables.field(number);
  Ex value = mangledName(field.name);
  const Ex to = tree_.member(tree_.fixed("self"), value->text);
  if (analysis_->loops.wide[number] != 0) value = tree_.cast(scalarType(types_, field.type), value);
  return tree_.infix(Operator::Assign, to, value);
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
