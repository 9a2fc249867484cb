// The function around the statements of a body: signature, variables, exits. See body.h.
#include "codegen/body.h"

#include "frontend/source/invariant.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::BodyKind;
using ir::LocalKind;
using types::TypeTable;

namespace {

// Arrays and records have no C type that a library could know.
void appendParameter(std::string& out, const TypeTable& types, const ir::Local& local, std::string_view name,
                     bool native) {
  const bool read_only = local.kind == LocalKind::Input;
  const types::TypeKind kind = types.kind(local.type);
  if (!local.by_reference) {
    appendDeclaration(out, types, local.type, name);
  } else if (native && (kind == types::TypeKind::Array || kind == types::TypeKind::Record)) {
    out += read_only ? "const void* " : "void* ";
    out += name;
  } else {
    appendPointer(out, types, local.type, name, read_only);
  }
}

}  // namespace

void BodyWriter::appendSignature(std::string& out, const ir::Module& module, const ir::Body& body,
                                 std::string_view function, std::string_view self) {
  const TypeTable& types = module.types;
  const ir::Local* result = nullptr;
  for (const ir::Local& local : body.locals) {
    if (local.kind == LocalKind::Result) result = &local;
  }
  const bool by_value = body.result && !ir::isAggregate(types, body.result);
  if (by_value) {
    const char* type = scalarType(types, body.result);
    out += type;
  } else if (body.native && body.result && TypeTable::isString(types.kind(body.result))) {
    out += "uint32_t";  // the length
  } else {
    out += "void";
  }
  out += ' ';
  if (!function.empty()) {
    out += function;
  } else if (body.native) {
    out += ir::nativeName(module, body);
  } else {
    appendFunctionName(out, module, body);
  }
  out += '(';
  if (body.native) {
    out += "rung_context* ctx";
    if (body.self) {
      out += ", ";
      out += self.empty() ? "void" : self;
      out += "* self";
    }
  } else if (isMethod(body)) {
    out += "void* object, rung_context* ctx";
  } else if (body.self) {
    appendRecordType(out, types, body.self);
    out += "& self, rung_context* ctx";
  } else {
    out += "rung_context* ctx";
  }
  std::string name;
  for (const ir::Local& local : ir::parameters(body)) {
    out += ", ";
    name.clear();
    appendMangled(name, module.names.string(local.name));
    appendParameter(out, types, local, name, body.native);
  }
  if (body.result && !by_value) {
    name.clear();
    if (result != nullptr && !body.native) {
      appendMangled(name, module.names.string(result->name));
    } else {
      name = "out";
    }
    out += ", ";
    if (body.native && !TypeTable::isString(types.kind(body.result))) {
      out += "void* out";
    } else {
      appendPointer(out, types, body.result, name);
    }
    if (body.native && TypeTable::isString(types.kind(body.result))) out += ", uint32_t capacity";
  }
  out += ')';
}

void BodyWriter::includeRecord(TypeId type) {
  type = elementOf(types_, type);
  if (types_.kind(type) != TypeKind::Record || marks_.record[type.index] == group_number_) return;
  marks_.record[type.index] = group_number_;
  group_.records.push_back(type);
}

void BodyWriter::call(ir::BodyId id) {
  if (marks_.body[id.index] == group_number_) return;
  marks_.body[id.index] = group_number_;
  (facts_.is_inlined[id.index] != 0 ? group_.inlined : group_.callees).push_back(id);
}

std::string BodyWriter::newName(const char* prefix) {
  std::string name = prefix;
  appendUnsigned(name, ++names_created_);
  return name;
}

std::string BodyWriter::newVariable(TypeId type, const char* prefix) {
  std::string name = newName(prefix);
  includeRecord(type);
  declarations_ += ' ';
  appendDeclaration(declarations_, types_, type, name);
  declarations_ += ';';
  return name;
}

void BodyWriter::variable(std::string& out, const ir::Local& local) const {
  if (local.kind == LocalKind::Temp) {
    out += string(local.name);
  } else {
    appendMangled(out, string(local.name));
  }
}

void BodyWriter::declareVariables() {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = 0; i < variables.localCount(); ++i) declareLocal(i);
  for (uint32_t i = variables.localCount(); i < variables.count(); ++i) {
    if (analysis_->fields.is_cached[i] != 0) declareCached(i);
  }
}

void BodyWriter::declareLocal(uint32_t number) {
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
  if (analysis_->slices.has(number)) return;
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

void BodyWriter::declareCached(uint32_t number) {
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

void BodyWriter::writeBack(std::string& out) {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = variables.localCount(); i < variables.count(); ++i) {
    const types::Field& field = variables.field(i);
    std::string name;
    if (analysis_->slices.has(i)) {
      appendMangled(name, string(field.name));
      out += " if (" + name + "v != nullptr) rung_string_put(self." + name + ", ";
      appendUnsigned(out, capacityOf(field.type));
      out += ", " + name + "v, " + name + "n);";
    } else if (isWrittenBack(i)) {
      appendMangled(name, string(field.name));
      out += " self." + name + " = ";
      if (analysis_->loops.wide[i] != 0) out += '(' + std::string(scalarType(types_, field.type)) + ')';
      out += name + ';';
    }
  }
}

bool BodyWriter::isWrittenBack(uint32_t number) const {
  return analysis_->fields.is_cached[number] != 0 && analysis_->uses.of[number].written;
}

bool BodyWriter::writesFieldsBack() const {
  const Variables& variables = analysis_->uses.variables;
  for (uint32_t i = variables.localCount(); i < variables.count(); ++i) {
    if (isWrittenBack(i)) return true;
  }
  return false;
}

uint8_t BodyWriter::wideOf(ExprId place) const {
  const uint32_t number = analysis_->uses.variables.at(place);
  return number == kNoVariable ? uint8_t{0} : analysis_->loops.wide[number];
}

bool BodyWriter::isCached(ExprId place) const {
  const uint32_t number = analysis_->uses.variables.at(place);
  return number != kNoVariable && analysis_->fields.is_cached[number] != 0;
}

bool BodyWriter::isSlice(ExprId place) const {
  return !analysis_->slices.is_slice.empty() && analysis_->slices.has(analysis_->uses.variables.stringAt(place));
}

void BodyWriter::writeExits() {
  std::string result;
  for (const ir::Local& local : body_->locals) {
    if (local.kind == LocalKind::Result && !local.by_reference) variable(result, local);
  }
  if (uses_leave_) out_ += "\nleave:";
  writeBack(out_);
  if (!result.empty()) {
    out_ += "\n  return ";
    out_ += result;
    out_ += ';';
  } else if (uses_fault_ || uses_leave_) {
    out_ += "\n  return;";
  }
  if (uses_fault_) {
    out_ += "\nfault:";
    writeBack(out_);
    out_ += " rung_raise(ctx, at & 15, sites_";
    out_ += group_.stem;
    out_ += " + (at >> 4), value);";
  }
}

void BodyWriter::write(ir::BodyId id) {
  const Body& body = module_.body(id);
  body_ = &body;
  out_.clear();
  declarations_.clear();
  materialized_.clear();
  loops_.clear();
  frames_.clear();
  blocks_declared_.clear();
  areas_declared_ = 0;
  uses_fault_ = uses_leave_ = false;
  names_created_ = 0;
  depth_ = 1;
  closes_ = 0;
  line_ = 0;
  line_file_ = {};

  const BodyAnalysis analysis = analyzeBody(module_, body, facts_);
  analysis_ = &analysis;
  if (body.self) includeRecord(body.self);
  declareVariables();
  declareLengths();
  block(body.first);
  flushCloses(0);
  writeExits();

  const bool is_inlined = facts_.is_inlined[id.index] != 0;
  std::string& to = group_.code;
  if (uses_fault_ || analysis.uses.has_try) declarations_ += " uint32_t at; int64_t value;";
  if (is_inlined) {
    to += "\nstatic inline ";
  } else {
    to += "\n// ";
    if (body.kind == BodyKind::Init) to += "initial values of ";
    to += string(body.spelling ? body.spelling : body.name);
    to += '\n';
    const bool is_hot = marks_.hot[id.index] == group_number_;
    if (is_hot) to += "RUNG_INLINE ";
    if (analysis.effort == Effort::Straight && !is_hot && !options_.optimize_all) to += "RUNG_STRAIGHT ";
    if (analysis.effort == Effort::Loops) to += "RUNG_LOOPS ";
  }
  appendSignature(to, module_, body);
  to += " {";
  if (isMethod(body)) {  // also called through tables: one type for all objects
    to += "\n  [[maybe_unused]] ";
    appendRecordType(to, types_, body.self);
    to += "& self = *static_cast<";
    appendRecordType(to, types_, body.self);
    to += "*>(object);";
  }
  if (!declarations_.empty()) {
    to += "\n ";
    to += declarations_;
  }
  to += out_;
  to += "\n}\n";
}

}  // namespace rung::codegen
