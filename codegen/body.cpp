// SPDX-License-Identifier: Apache-2.0
// The function around the statements of a body: signature, variables, exits. See body.h.
#include "codegen/body.h"

#include "codegen/body_parts.h"
#include "codegen/cxx/print.h"
#include "codegen/signature.h"

#include "frontend/source/invariant.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::LocalKind;

void FunctionWriter::declareVariables() {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = 0; i < variables.localCount(); ++i) declareLocal(i);
  for (uint32_t i = variables.localCount(); i < variables.count(); ++i) {
    if (analysis_->fields.is_cached[i] != 0) declareCached(i);
  }
}

void FunctionWriter::declareLocal(uint32_t number) {
  const ir::Local& local = body_->locals[number];
  includeRecord(local.type);
  const VariableUse& use = analysis_->uses.of[number];
  const uint8_t wide = analysis_->loops.wide[number];
  const bool is_result = local.kind == LocalKind::Result;
  if (isParameter(local)) {
    if (wide != 0) RUNG_INVARIANT(!local.by_reference, "a wide control is a local");
    return;
  }
  if (is_result ? local.by_reference : use.weight == 0 && !use.written) return;
  if (analysis_->slices.has(number) || analysis_->appends.has(number)) return;
  std::string name;
  variable(name, local);
  if (wide != 0) {
    declare(wide == 32 ? "int32_t" : "int64_t", name, tree_.number(0));
    return;
  }
  Ex value = nullptr;
  if (!isAggregate(local.type) && !isString(local.type))
    value = isPointer(types_.plainKind(local.type)) ? tree_.fixed("nullptr") : tree_.number(0);
  declare(valueType(tree_, types_, local.type), name, value);
}

void FunctionWriter::declareCached(uint32_t number) {
  const types::Field& field = analysis_->uses.variables.field(number);
  const uint8_t wide = analysis_->loops.wide[number];
  const bool is_truth = types_.plainKind(field.type) == TypeKind::Bool;
  const Ex name = mangledName(field.name), memory = tree_.member(tree_.fixed("self"), name->text);
  const char* const type = wide == 32   ? "int32_t"
                           : wide == 64 ? "int64_t"
                           : is_truth   ? "bool"
                                        : scalarType(types_, field.type);
  declare(type, name->text, is_truth ? tree_.infix(Operator::Differs, memory, tree_.number(0)) : memory);
}

void FunctionWriter::writeAllBack() {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = variables.localCount(); i < variables.count(); ++i) {
    if (!analysis_->slices.has(i)) {
      if (isWrittenBack(i)) perform(writeBack(i));
      continue;
    }
    const types::Field& field = variables.field(i);
    const std::string name = mangled(field.name);
    const Ex slice = tree_.name(name + 'v');
    cxx::Stmt* const made =
        tree_.stmt(cxx::StmtKind::ShortIf, tree_.infix(Operator::Differs, slice, tree_.fixed("nullptr")));
    add(made);
    made->first =
        nested([&] {
          perform(tree_.call("rung_string_put", {tree_.member(tree_.fixed("self"), tree_.kept(name)),
                                                 tree_.number(capacityOf(field.type)), slice, tree_.name(name + 'n')}));
        }).first();
  }
}

// The statements after the last brace: at `leave:` and at `fault:`.
cxx::Statements FunctionWriter::exits() {
  cxx::Statements exits;
  const auto exit = [&](const char* label) { exits.add(tree_.textual(cxx::StmtKind::Exit, label)); };
  if (state_.uses_leave) exit("leave");
  exits.append(nested([&] {
    writeAllBack();
    strings().returnLengths();
  }));
  Ex result = nullptr;
  for (const ir::Local& local : body_->locals)
    if (local.kind == LocalKind::Result && !local.by_reference) result = variable(local);
  if (result != nullptr || state_.uses_fault || state_.uses_leave) {
    cxx::Stmt* const back = tree_.stmt(cxx::StmtKind::Return, result);
    back->begins = true;
    exits.add(back);
  }
  if (!state_.uses_fault) return exits;
  exit("fault");
  exits.append(nested([&] {
    writeAllBack();
    perform(raiseNoted());
  }));
  return exits;
}

// The object of a method, which is also called through tables: one type for all objects.
cxx::Stmt* FunctionWriter::objectOfMethod() {
  const std::string type = recordType(types_, body_->self);
  const Ex memory = tree_.prefix("*", tree_.call("static_cast<" + type + "*>", {tree_.fixed("object")}));
  cxx::Variable* const self = tree_.variable(cxx::Type{tree_.kept(type), "&", {}}, "self", memory);
  self->prefix = "[[maybe_unused]]";
  cxx::Stmt* const made = tree_.declare(self);
  made->begins = true;
  return made;
}

void FunctionWriter::write(ir::BodyId id) {
  if (body_->self) includeRecord(body_->self);
  declareVariables();
  strings().declareLengths();
  const cxx::Statements code = nested([&] {
    statements().stepOfCall();
    statements().block(body_->first);
  });
  const cxx::Statements exits = this->exits();
  if (state_.uses_fault || analysis_->uses.has_try) {
    declare("uint32_t", "at");
    declare("int64_t", "value");
  }
  if (!state_.declarations.empty()) state_.declarations.first()->begins = true;

  cxx::Statements all;
  if (isMethod(*body_)) all.add(objectOfMethod());
  all.append(state_.declarations);
  all.append(code);
  cxx::Function* const function = signatureOf(tree_, module_, *body_);
  function->form = cxx::Function::Form::Lines;
  function->body = all.first();
  function->exits = exits.first();
  cxx::Declarations lines;
  lines.add(tree_.blank());
  addHead(id, *function, lines);
  lines.add(function);
  cxx::print(group_.code, tree_, lines);
}

// The comment with its name, and the attributes.
void FunctionWriter::addHead(ir::BodyId id, cxx::Function& function, cxx::Declarations& lines) {
  if (facts_.is_inlined[id.index] != 0) {
    function.prefix = "static inline";
    return;
  }
  const std::string_view name = string(body_->spelling ? body_->spelling : body_->name);
  const bool is_init = body_->kind == ir::BodyKind::Init;
  lines.add(tree_.textual(cxx::DeclKind::Comment, (is_init ? "initial values of " : "") + std::string(name)));
  const bool is_hot = state_.in.marks.hot[id.index] == state_.in.group_number;
  const bool is_straight = analysis_->effort == Effort::Straight && !is_hot && !options_.optimize_all;
  const char* const attribute = is_straight                                 ? "RUNG_STRAIGHT"
                                : analysis_->effort == Effort::Loops        ? "RUNG_LOOPS"
                                : analysis_->effort == Effort::CheckedLoops ? "RUNG_CHECKED_LOOPS"
                                                                            : "";
  std::string prefix = is_hot ? "RUNG_INLINE" : "";
  if (is_hot && *attribute != 0) prefix += ' ';
  function.prefix = tree_.kept(prefix + attribute);
}

void BodyWriter::write(ir::BodyId id) {
  const ir::Body& body = context_.module.body(id);
  const BodyAnalysis analysis = analyzeBody(context_.module, body, context_.facts);
  tree_.clear();
  BodyState state(context_, body, analysis, tree_);
  BodyParts parts(state);
  FunctionWriter(state).write(id);
}

}  // namespace rung::codegen
