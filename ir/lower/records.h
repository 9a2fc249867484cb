// SPDX-License-Identifier: Apache-2.0
// Which records the module has, in an order in which each comes after those that it holds, and what is known of them.
// In: types that bodies, lists and instances name. Out: Module::records. A part of ModuleLowering (lowering.h).
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ir/ir.h"
#include "ir/lower/module_part.h"
#include "sema/project.h"

namespace rung::ir {

// The name and source of the POU to which a record or a body belongs.
template <class T>
void takeHeader(T& to, const sema::Pou& owner) {
  to.name = owner.unique_name ? owner.unique_name : owner.name;
  to.library = owner.library;
  to.loc = owner.loc;
  to.file = owner.file;
}

class RecordLowering : ModulePart {
 public:
  explicit RecordLowering(ModuleLowering& of);
  // Variables with arguments of FB_Init, kept from FB_Exit, or set by online changes; once, before anything is lowered.
  void readMarks();

  // The module gets the records that the type is made of and those that it points to.
  void declare(TypeId type);
  bool isDeclared(TypeId record) const { return seen_.count(record.index) != 0; }
  Record* find(TypeId type);
  // Tells whether the initial value of a type has zeros in all bytes.
  bool isZero(TypeId type);
  // The POU or list of which this is the record; or none.
  sema::PouId pouOf(TypeId record) const {
    return record.index < pou_of_.size() ? pou_of_[record.index] : sema::PouId{};
  }
  sema::ListId listOf(TypeId record) const { return list_of_[record.index]; }
  // The variable whose declaration gives arguments to FB_Init, in a field of a record; or null.
  const sema::Var* constructedVar(TypeId record, uint32_t field) const;
  bool isKeptFromExit(TypeId record, uint32_t field) const;  // {attribute 'no-exit'}
  // The variable in a field that every online change sets: a constant, or one with {attribute 'init_on_onlchange'}; or
  // null.
  const sema::Var* setByChange(TypeId record, uint32_t field) const;

 private:
  void declareOne(TypeId type);
  void add(TypeId record);
  bool beginsWithZeros(TypeId type, const types::TypeInfo& info);

  std::unordered_set<uint32_t> seen_;                 // by TypeId
  std::unordered_map<uint32_t, uint32_t> record_of_;  // by TypeId: indices of module.records
  std::vector<TypeId> to_declare_;
  bool is_declaring_ = false;
  std::unordered_map<uint32_t, bool> zero_;                // by TypeId
  std::unordered_map<uint64_t, const sema::Var*> marked_;  // by record and field: see readMarks
  std::vector<sema::PouId> pou_of_;                        // by TypeId
  std::vector<sema::ListId> list_of_;                      // by TypeId
};

}  // namespace rung::ir
