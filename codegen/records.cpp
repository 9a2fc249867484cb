// SPDX-License-Identifier: Apache-2.0
// Definitions of records, in sources or headers: see records.h.
#include "codegen/records.h"

#include <algorithm>

#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/types.h"

namespace rung::codegen {

using types::Field;
using types::RecordKind;
using types::TypeKind;

namespace {

const char* keyword(RecordKind kind) {
  switch (kind) {
    case RecordKind::Struct: return "STRUCT";
    case RecordKind::Union: return "UNION";
    case RecordKind::FunctionBlock: return "FUNCTION_BLOCK";
    case RecordKind::Program: return "PROGRAM";
    case RecordKind::GlobalList: return "VAR_GLOBAL";
    case RecordKind::Interface: return "INTERFACE";
  }
  return "";
}

}  // namespace

RecordDefinitions::RecordDefinitions(const ir::Module& module, const Facts& facts, std::string_view name_space,
                                     bool bundled)
    : module_(module), facts_(facts), name_space_(name_space), max_copies_(bundled ? 1 : kMaxCopies) {
  row_of_.resize(module.types.count());
  for (uint32_t i = 0; i < module.records.size(); ++i) {
    row_of_[module.types.resolve(module.records[i].type).index] = i + 1;
  }
  copies_.resize(module.records.size());
  seen_.resize(module.records.size());
  held_seen_.resize(module.records.size());
  held_.resize(module.records.size());
  is_held_known_.resize(module.records.size());
  definitions_.resize(module.records.size());
}

const std::vector<uint32_t>& RecordDefinitions::held(uint32_t row) {
  std::vector<uint32_t>& rows = held_[row];
  if (is_held_known_[row] != 0) return rows;
  is_held_known_[row] = 1;
  ++held_round_;
  for (const Field& field : module_.types.info(module_.types.resolve(module_.records[row].type)).fields) {
    const TypeId element = elementOf(module_.types, field.type);
    if (field.by_reference || module_.types.kind(element) != TypeKind::Record || row_of_[element.index] == 0) continue;
    const uint32_t other = row_of_[element.index] - 1;
    if (held_seen_[other] == held_round_) continue;
    held_seen_[other] = held_round_;
    rows.push_back(other);
  }
  return rows;
}

template <class F>
void RecordDefinitions::visit(uint32_t row, bool into_headers, F& f) {
  if (seen_[row] == round_) return;
  seen_[row] = round_;
  if (into_headers || !hasHeader(row)) {
    for (uint32_t other : held(row)) visit(other, into_headers, f);
  }
  f(row);
}

template <class F>
void RecordDefinitions::forEachHeld(const std::vector<TypeId>& records, bool into_headers, F&& f) {
  ++round_;
  for (TypeId type : records) {
    if (const uint32_t row = row_of_[type.index]) visit(row - 1, into_headers, f);
  }
}

void RecordDefinitions::need(const std::vector<TypeId>& records, bool shared) {
  forEachHeld(records, true, [&](uint32_t row) { copies_[row] += shared ? kMaxCopies + 1 : 1; });
}

void RecordDefinitions::collect(const std::vector<TypeId>& records, std::vector<std::string>& includes, cxx::Tree& tree,
                                cxx::Declarations& definitions) {
  // By name: the order of first uses in the bodies would make the copies differ.
  std::vector<TypeId> sorted = records;
  std::sort(sorted.begin(), sorted.end(),
            [&](TypeId a, TypeId b) { return recordFile(module_.types, a) < recordFile(module_.types, b); });
  forEachHeld(sorted, false, [&](uint32_t row) {
    if (hasHeader(row)) {
      includes.push_back(recordFile(module_.types, module_.types.resolve(module_.records[row].type)));
    } else {
      definitions.add(tree.blank());
      definitions.add(tree.printed(definition(row)));
    }
  });
}

const std::string& RecordDefinitions::definition(uint32_t row) {
  std::string& text = definitions_[row];
  if (!text.empty()) return text;
  tree_.clear();
  cxx::Declarations lines;
  define(row, tree_, lines);
  cxx::print(text, tree_, lines);
  return text;
}

// Its declaration, and the prototypes of its code; without code, the assertion of its layout is here.
void RecordDefinitions::define(uint32_t row, cxx::Tree& tree, cxx::Declarations& to) const {
  const ir::Record& record = module_.records[row];
  const types::TypeTable& types = module_.types;
  const TypeId type = types.resolve(record.type);
  const std::string name(module_.names.string(record.name));
  to.add(tree.textual(cxx::DeclKind::Comment, keyword(types.info(type).record_kind) + (' ' + name)));
  to.add(recordDefinition(tree, types, type, facts_.is_pointed[type.index] != 0));
  bool has_code = false;
  for (const ir::BodyId id : {record.init, record.body}) {
    if (!id || module_.body(id).native || facts_.is_zeroing[id.index] != 0 || facts_.is_inlined[id.index] != 0)
      continue;
    has_code = true;
    std::string function_name;
    appendFunctionName(function_name, module_, module_.body(id));
    cxx::Function* const function = tree.declaration<cxx::Function>();
    function->result.base = "void";
    function->name = tree.kept(function_name);
    function->parameters.add(tree.variable(cxx::Type{tree.kept(recordName(types, type)), "&", {}}, "self"));
    function->parameters.add(tree.variable(cxx::Type{"rung_context", "*", {}}, "ctx"));
    to.add(function);
  }
  if (!has_code) to.add(layoutAssertion(tree, types, type));
}

void RecordDefinitions::appendHeaders(std::vector<OutputFile>& files) {
  const auto fileOf = [&](uint32_t row) {
    return recordFile(module_.types, module_.types.resolve(module_.records[row].type));
  };
  for (uint32_t row = 0; row < module_.records.size(); ++row) {
    if (!hasHeader(row)) continue;
    cxx::Tree tree;
    cxx::Declarations header;
    header.add(tree.textual(cxx::DeclKind::Directive, "pragma once"));
    header.add(tree.blank());
    header.add(tree.textual(cxx::DeclKind::Include, "rung/code.h"));
    for (uint32_t other : held(row)) header.add(tree.textual(cxx::DeclKind::Include, fileOf(other)));
    header.add(tree.blank());
    cxx::Namespace* const space = hiddenNamespace(tree, name_space_);
    space->members.add(tree.blank());
    space->members.add(tree.printed(definition(row)));
    header.add(space);
    cxx::print(files.emplace_back(OutputFile{fileOf(row), {}}).content, tree, header);
  }
}

}  // namespace rung::codegen
