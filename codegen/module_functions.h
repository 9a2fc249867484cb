// SPDX-License-Identifier: Apache-2.0
// The functions of a module that its tables name: initial values, tasks, tests, exit and safe state. In: the IR module,
// its facts and its description. Out: functions of C++ (cxx/nodes.h), and declarations of what they call. Called by
// module.cpp.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "codegen/cxx/nodes.h"
#include "codegen/facts.h"
#include "ir/description.h"

namespace rung::codegen {

class ModuleFunctions {
 public:
  ModuleFunctions(const ir::Module& module, const Facts& facts, const ir::Description& description)
      : module_(module), types_(module.types), facts_(facts), is_(description) {}

  // Whether the initial value of a record is more than cleared memory.
  bool hasCode(ir::BodyId init) const { return init && facts_.is_zeroing[init.index] == 0; }

  // Functions with a name of the caller, who puts it into a table.
  void addInitialiser(const std::string& name, ir::BodyId init);
  void addTask(const std::string& name, uint32_t task);
  // Of a block, for an online change. Returns what the table has: the name, or nullptr for a function without code.
  std::string addBlockInit(const std::string& name, const ir::Description::Life& life);
  std::string addBlockFunction(const std::string& name, const ir::Description::Life& life, ir::BodyId body);
  struct TestNames {
    std::string init = "nullptr", run, exit = "nullptr";
  };
  TestNames addTest(const std::string& name, const ir::Description::Test& test);
  // `init`, and `exit` and `safe` where the program has them.
  void addEntries();

  // As text: declarations of records and functions, the functions of the tables, the entries.
  std::string declarations() const;
  std::string functions() const { return printed(functions_); }
  std::string entries() const { return printed(entries_); }

 private:
  std::string printed(const cxx::Declarations& all) const;
  cxx::Function* function(std::string_view prefix, std::string_view name);
  void add(cxx::Statements& to, cxx::Ex e);
  cxx::Ex block(uint32_t number);
  // `*static_cast<Ramp_type*>(instance)`
  cxx::Ex asRecord(TypeId record, cxx::Ex instance);
  cxx::Ex clearing(uint32_t number);
  cxx::Ex callWith(ir::BodyId id, cxx::Ex instance);
  cxx::Ex callOn(ir::BodyId id, TypeId record, cxx::Ex instance);
  cxx::Ex callOf(ir::BodyId id);
  cxx::Ex runOf(const ir::ProgramInstance& program, uint32_t number);
  void addFunctionTest(cxx::Statements& to, const ir::Body& body);
  void addEntry(std::string_view name, const cxx::Statements& body);
  void define(cxx::Declarations& where, cxx::Function* made, const cxx::Statements& body);
  void declare(ir::BodyId id);

  const ir::Module& module_;
  const types::TypeTable& types_;
  const Facts& facts_;
  const ir::Description& is_;
  cxx::Tree tree_;
  // `records_` names them in this namespace: `struct rung_type` alone would be that of rung/module.h.
  cxx::Declarations records_, prototypes_, functions_, entries_;
  std::unordered_set<uint32_t> declared_, named_records_;  // by BodyId, by TypeId
};

}  // namespace rung::codegen
