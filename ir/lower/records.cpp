// SPDX-License-Identifier: Apache-2.0
// Records of the module and whether they begin with zeros: see records.h.
#include "ir/lower/lowering.h"

namespace rung::ir {

namespace {

bool isSetByChange(const sema::Var& var) { return var.constant || var.pragmas.set_by_change; }

}  // namespace

RecordLowering::RecordLowering(ModuleLowering& of) : ModulePart(of) {
  pou_of_.resize(types.count());
  list_of_.resize(types.count());
  for (uint32_t i = 1; i < project.pous.size(); ++i)
    if (project.pous[i].record) pou_of_[project.pous[i].record.index] = {i};
  for (uint32_t i = 1; i < project.global_lists.size(); ++i)
    if (project.global_lists[i].record) list_of_[project.global_lists[i].record.index] = {i};
}

void RecordLowering::readMarks() {
  for (const sema::Var& var : project.vars) {
    const bool is_marked = var.start.constructor.index != 0 || var.pragmas.no_exit || isSetByChange(var);
    if (!is_marked || var.storage == sema::Storage::Local) continue;
    const TypeId record = var.list  ? project.global_lists[var.list.index].record
                          : var.pou ? project.pou(var.pou).record
                                    : var.record;
    marked_[uint64_t{record.index} << 32 | var.field] = &var;
  }
}

void RecordLowering::declare(TypeId type) {
  to_declare_.push_back(type);
  if (is_declaring_) return;  // asked for by a record that is being declared
  is_declaring_ = true;
  while (!to_declare_.empty()) {
    const TypeId next = to_declare_.back();
    to_declare_.pop_back();
    declareOne(next);
  }
  is_declaring_ = false;
}

// The records that a record holds come before it, those that it only points to after it: they may hold it.
void RecordLowering::declareOne(TypeId type) {
  type = types.resolve(type);
  const TypeInfo& info = types.info(type);
  if (info.kind == TypeKind::Array) return declareOne(info.base);
  if (info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference) return to_declare_.push_back(info.base);
  if (info.kind != TypeKind::Record) return;
  if (!seen_.insert(type.index).second) return;
  for (const types::Field& f : info.fields) {
    if (f.by_reference)
      to_declare_.push_back(f.type);
    else
      declareOne(f.type);
  }
  add(type);
}

void RecordLowering::add(TypeId type) {
  const TypeInfo& info = types.info(type);
  Record record;
  record.type = type;
  record.name = info.name;
  if (sema::PouId pou = pou_of_[type.index]) {
    takeHeader(record, project.pou(pou));
  }
  record_of_[type.index] = static_cast<uint32_t>(module.records.size());
  module.records.push_back(record);
  if (info.record_kind == types::RecordKind::Interface) return;
  if (sema::PouId pou = pou_of_[type.index]) {
    BodyId body = all.bodyOf(pou);  // may add records
    find(type)->body = body;
  }
}

Record* RecordLowering::find(TypeId type) {
  const auto found = record_of_.find(type.index);
  return found == record_of_.end() ? nullptr : &module.records[found->second];
}

bool RecordLowering::isZero(TypeId declared) {
  auto known = zero_.find(declared.index);
  if (known != zero_.end()) return known->second;
  zero_[declared.index] = false;  // ends the recursion for a record with a pointer to itself
  const bool result = beginsWithZeros(declared, types.info(declared));
  zero_[declared.index] = result;
  return result;
}

bool RecordLowering::beginsWithZeros(TypeId declared, const TypeInfo& info) {
  if (declared.index < project.type_inits.size() && project.type_inits[declared.index]) return false;
  if (info.kind == TypeKind::Alias || info.kind == TypeKind::Array) return isZero(info.base);
  if (info.kind == TypeKind::Enum || info.kind == TypeKind::Subrange)
    return types::defaultValue(types, module.names, declared).bits == 0;
  if (info.kind != TypeKind::Record) return true;
  if (sema::PouId pou = pou_of_[declared.index]) {
    if (project.pou(pou).kind == PouKind::Interface) return true;
    if (project.pou(pou).object.dispatched || !all.lifeMethodsOf(pou, "FB_Init").empty()) return false;
    if (!all.calledAfterInit(pou).empty()) return false;
    for (sema::VarId id : project.pou(pou).vars) {
      const sema::Var& var = project.var(id);
      if (var.storage == sema::Storage::Image && var.init) return false;
      if (var.storage == sema::Storage::Field && (var.init || (var.section != SectionKind::InOut && !isZero(var.type))))
        return false;
    }
    return true;
  }
  if (sema::ListId list = list_of_[declared.index]) {
    for (sema::VarId id : project.global_lists[list.index].vars) {
      const sema::Var& var = project.var(id);
      if (var.init || (var.storage == sema::Storage::Global && !isZero(var.type))) return false;
    }
    return true;
  }
  bool has_inits = declared.index < project.field_inits.size();
  for (size_t i = 0; i < info.fields.size(); ++i) {
    if (has_inits && i < project.field_inits[declared.index].size() && project.field_inits[declared.index][i])
      return false;
    if (!isZero(info.fields[i].type)) return false;
    if (info.record_kind == types::RecordKind::Union && !info.overlaps) break;
  }
  return true;
}

const sema::Var* RecordLowering::constructedVar(TypeId record, uint32_t field) const {
  const auto found = marked_.find(uint64_t{record.index} << 32 | field);
  if (found == marked_.end()) return nullptr;
  const sema::Var* var = found->second;
  if (var->sharing.holds) var = &project.var(var->sharing.holds);
  if (var->sharing.copy_of) var = &project.var(var->sharing.copy_of);
  return var->start.constructor.index != 0 ? var : nullptr;
}

bool RecordLowering::isKeptFromExit(TypeId record, uint32_t field) const {
  const auto found = marked_.find(uint64_t{record.index} << 32 | field);
  return found != marked_.end() && found->second->pragmas.no_exit;
}

const sema::Var* RecordLowering::setByChange(TypeId record, uint32_t field) const {
  const auto found = marked_.find(uint64_t{record.index} << 32 | field);
  return found != marked_.end() && isSetByChange(*found->second) ? found->second : nullptr;
}

}  // namespace rung::ir
