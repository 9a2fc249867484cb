// SPDX-License-Identifier: Apache-2.0
// Definitions of records, in sources or headers: see records.h.
#include "codegen/records.h"

#include <algorithm>

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

void RecordDefinitions::collect(const std::vector<TypeId>& records, std::vector<std::string>& includes,
                                std::string& definitions) {
  // By name: the order of first uses in the bodies would make the copies differ.
  std::vector<TypeId> sorted = records;
  std::sort(sorted.begin(), sorted.end(),
            [&](TypeId a, TypeId b) { return recordFile(module_.types, a) < recordFile(module_.types, b); });
  forEachHeld(sorted, false, [&](uint32_t row) {
    if (hasHeader(row)) {
      includes.push_back(recordFile(module_.types, module_.types.resolve(module_.records[row].type)));
    } else {
      definitions += '\n';
      definitions += definition(row);
    }
  });
}

std::string RecordDefinitions::definition(uint32_t row) const {
  const ir::Record& record = module_.records[row];
  const types::TypeTable& types = module_.types;
  const TypeId type = types.resolve(record.type);
  std::string out = "// ";
  out += keyword(types.info(type).record_kind);
  out += ' ';
  out += module_.names.string(record.name);
  out += '\n';
  appendRecordDefinition(out, types, type, facts_.is_pointed[type.index] != 0);
  bool has_code = false;
  for (ir::BodyId body : {record.init, record.body}) {
    if (!body || module_.body(body).native || facts_.is_zeroing[body.index] != 0 || facts_.is_inlined[body.index] != 0)
      continue;
    has_code = true;
    out += "void ";
    appendFunctionName(out, module_, module_.body(body));
    out += '(';
    out += recordName(types, type);
    out += "& self, rung_context* ctx);\n";
  }
  if (!has_code) appendLayoutAssert(out, types, type);
  return out;
}

void RecordDefinitions::appendHeaders(std::vector<OutputFile>& files) {
  for (uint32_t row = 0; row < module_.records.size(); ++row) {
    if (!hasHeader(row)) continue;
    const TypeId type = module_.types.resolve(module_.records[row].type);
    std::string out = "#pragma once\n\n#include \"rung/code.h\"\n";
    for (uint32_t other : held(row)) {
      out += "#include \"" + recordFile(module_.types, module_.types.resolve(module_.records[other].type)) + "\"\n";
    }
    out += '\n' + openNamespace(name_space_) + '\n' + definition(row) + "\n}  // namespace " + name_space_ + '\n';
    files.push_back({recordFile(module_.types, type), std::move(out)});
  }
}

}  // namespace rung::codegen
