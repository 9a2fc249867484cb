// SPDX-License-Identifier: Apache-2.0
// The description of a module for its host, as the tables of rung/module.h: types, symbols, memory blocks, kept ranges,
// tasks and tests. In: the IR module. Out: tables numbered in the order in which the blocks, sorted by name, reach
// their rows, so that the order of the inputs does not show. Codegen prints them; the interpreter passes them to its
// host.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ir/ir.h"
#include "rung/module.h"

namespace rung::ir {

// The blocks of memory that the host places: one for each global list and program instance, sorted by name.
struct MemoryBlocks {
  explicit MemoryBlocks(const Module& module);

  std::vector<uint32_t> list_block, program_block;  // of list i and of program i
  uint32_t block_count = 0;
  struct Block {
    NameId name;
    TypeId record;
    bool retain = false;  // all of it, except what is NON_RETAIN
  };
  std::vector<Block> blocks;
};

// The lists and programs in the order in which they are initialised; without tests, whose instances begin later.
struct InitStep {
  bool is_list;  // else a program
  uint32_t index;
};
std::vector<InitStep> initOrder(const Module& module, const MemoryBlocks& blocks);

// NUL-terminated strings by offset; the empty string is at 0.
class StringPool {
 public:
  StringPool();
  uint32_t add(std::string_view text);
  const std::string& bytes() const { return bytes_; }

 private:
  std::unordered_map<std::string, uint32_t> known_;
  std::string bytes_;
};

struct Description {
  // `with_locals`: the types of all variables of bodies, too, for debuggers.
  Description(const Module& module, const MemoryBlocks& blocks, bool with_tests, bool with_locals = false);

  StringPool strings;  // names of bodies and files first, so that offsets to them stay when later strings change
  std::vector<rung_block> blocks;
  std::vector<rung_area> areas;
  std::vector<rung_type> types;
  std::vector<rung_field> fields;
  std::vector<rung_enum_item> enum_items;
  std::vector<rung_dimension> dimensions;
  std::vector<rung_symbol> symbols;  // sorted by name
  std::vector<uint32_t> names;       // rung_names::slots; empty where there are few names
  std::vector<rung_range> retain, persistent;
  struct Initialiser {
    uint32_t type;
    BodyId body;  // of kind Init, or a maker
  };
  std::vector<Initialiser> initialisers;  // by type
  struct Life {
    uint32_t block, type;
    TypeId record;
    BodyId init, setup, refresh, reinit, exit;  // on the record, but `setup`; or none
  };
  std::vector<Life> lives;        // in the order in which blocks are initialised; see Module::lives
  std::vector<uint32_t> classes;  // types, by class number - 1
  std::vector<uint32_t> resources;
  std::vector<rung_task> tasks;  // `run` is not set
  std::vector<rung_write> writes;
  std::vector<rung_io_module> io_modules;
  struct Test {
    rung_test row;  // `init` and `run` are not set
    BodyId body;
    uint32_t program;                       // index into Module::programs of its instance; RUNG_NONE: a function
    std::vector<BodyId> setups, teardowns;  // of its case and file
    BodyId before, after;                   // of its run
  };
  std::vector<Test> tests;
  std::vector<uint32_t> self_types;                // by BodyId: of its instance, or RUNG_NONE; with locals
  std::vector<std::vector<uint32_t>> local_types;  // by BodyId and local
  uint64_t layout_hash = 0;
  bool aligned_globals = false;
};

// The rung/module.h kind of a type, through aliases, enumerations and subranges; a pointer for types without a kind.
rung_type_kind hostKind(const types::TypeTable& types, TypeId type);

// The location of a body, check or test.
struct FilePosition {
  std::string_view path;
  uint32_t line = 0, column = 0;
};
FilePosition filePosition(const Module& module, const Body& body, Loc loc);

}  // namespace rung::ir
