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
  declarations_ += ' ';
  if (wide != 0) {
    declarations_ += wide == 32 ? "int32_t " : "int64_t ";
    declarations_ += name;
    declarations_ += " = 0;";
    return;
  }
  appendDeclaration(declarations_, types_, local.type, name);
  if (!isAggregate(local.type) && !isString(local.type))
    declarations_ += isPointer(types_.plainKind(local.type)) ? " = nullptr" : " = 0";
  declarations_ += ';';
}

void FunctionWriter::declareCached(uint32_t number) {
  const types::Field& field = analysis_->uses.variables.field(number);
  const uint8_t wide = analysis_->loops.wide[number];
  const bool is_truth = types_.plainKind(field.type) == TypeKind::Bool;
  std::string name;
  appendMangled(name, string(field.name));
  declarations_ += ' ';
  declarations_ += wide == 32 ? "int32_t" : wide == 64 ? "int64_t" : is_truth ? "bool" : scalarType(types_, field.type);
  declarations_ += ' ' + name + " = self." + name;
  if (is_truth) declarations_ += " != 0";
  declarations_ += ';';
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

void FunctionWriter::writeExits(std::string& out) {
  std::string result;
  for (const ir::Local& local : body_->locals) {
    if (local.kind == LocalKind::Result && !local.by_reference) variable(result, local);
  }
  if (state_.uses_leave) out += "\nleave:";
  cxx::print(out, tree_, nested([&] {
               writeAllBack();
               strings().returnLengths();
             }));
  if (!result.empty()) {
    out += "\n  return ";
    out += result;
    out += ';';
  } else if (state_.uses_fault || state_.uses_leave) {
    out += "\n  return;";
  }
  if (state_.uses_fault) {
    out += "\nfault:";
    cxx::print(out, tree_, nested([&] { writeAllBack(); }));
    out += " rung_raise(ctx, at & 15, sites_";
    out += group_.stem;
    out += " + (at >> 4), value);";
  }
}

void FunctionWriter::write(ir::BodyId id) {
  if (body_->self) includeRecord(body_->self);
  declareVariables();
  strings().declareLengths();
  std::string code;
  cxx::print(code, tree_, nested([&] {
               statements().stepOfCall();
               statements().block(body_->first);
             }));
  writeExits(code);
  if (state_.uses_fault || analysis_->uses.has_try) declarations_ += " uint32_t at; int64_t value;";

  writeHead(id);
  std::string& to = group_.code;
  appendSignature(to, module_, *body_);
  to += " {";
  if (isMethod(*body_)) {  // also called through tables: one type for all objects
    to += "\n  [[maybe_unused]] ";
    appendRecordType(to, types_, body_->self);
    to += "& self = *static_cast<";
    appendRecordType(to, types_, body_->self);
    to += "*>(object);";
  }
  if (!declarations_.empty()) {
    to += "\n ";
    to += declarations_;
  }
  to += code;
  to += "\n}\n";
}

// The comment with its name, and the attributes.
void FunctionWriter::writeHead(ir::BodyId id) {
  std::string& to = group_.code;
  if (facts_.is_inlined[id.index] != 0) {
    to += "\nstatic inline ";
    return;
  }
  to += "\n// ";
  if (body_->kind == ir::BodyKind::Init) to += "initial values of ";
  to += string(body_->spelling ? body_->spelling : body_->name);
  to += '\n';
  const bool is_hot = state_.in.marks.hot[id.index] == state_.in.group_number;
  if (is_hot) to += "RUNG_INLINE ";
  if (analysis_->effort == Effort::Straight && !is_hot && !options_.optimize_all) to += "RUNG_STRAIGHT ";
  if (analysis_->effort == Effort::Loops) to += "RUNG_LOOPS ";
  if (analysis_->effort == Effort::CheckedLoops) to += "RUNG_CHECKED_LOOPS ";
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
