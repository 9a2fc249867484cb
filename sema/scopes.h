// SPDX-License-Identifier: Apache-2.0
// Scopes: the hash tables for names, and sema's state while it resolves declarations on demand. Lives as long as one
// check(). Tables are keyed by Names::key, so every spelling of an identifier is the same. Internal to sema/.
#pragma once

#include <deque>
#include <map>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sema/entities.h"

namespace rung::sema {

// From a name key to its meaning. Open addressing; one allocation; 8 bytes a slot.
class NameMap {
 public:
  Entity find(NameId key) const {
    if (count_ == 0) return {};
    for (uint32_t i = hash(key);; ++i) {
      const Slot& slot = slots_[i & (slots_.size() - 1)];
      if (slot.key == key) return slot.entity;
      if (!slot.key) return {};
    }
  }
  // False when the key is in use.
  bool insert(NameId key, Entity entity);
  template <class Visit>
  void forEach(Visit visit) const {
    for (const Slot& slot : slots_)
      if (slot.key) visit(slot.key, slot.entity);
  }

 private:
  struct Slot {
    NameId key;
    Entity entity;
  };
  static uint32_t hash(NameId key) { return (key.index * 0x9e3779b1u) >> 7; }
  std::vector<Slot> slots_;
  uint32_t count_ = 0;
};

enum class State : uint8_t { New, Busy, Done };

// What is known of nodes of one kind, by their id. As NameMap; references are valid until the next insertion.
template <class Id, class T>
class NodeMap {
 public:
  T& operator[](Id id) {
    if (2 * count_ >= slots_.size()) grow();
    Slot& slot = slotOf(id);
    if (!slot.id) {
      slot.id = id;
      ++count_;
    }
    return slot.value;
  }
  size_t size() const { return count_; }
  // As it is when nothing is known.
  T find(Id id) const { return slots_.empty() ? T{} : const_cast<NodeMap*>(this)->slotOf(id).value; }

 private:
  struct Slot {
    Id id;
    T value{};
  };
  Slot& slotOf(Id id) {
    for (uint32_t i = (id.word * 0x9e3779b1u) >> 7;; ++i) {
      Slot& slot = slots_[i & (slots_.size() - 1)];
      if (slot.id == id || !slot.id) return slot;
    }
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 64 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.id) slotOf(slot.id) = slot;
  }
  std::vector<Slot> slots_;
  uint32_t count_ = 0;
};

// A named type, or the record of a POU or global list.
struct NamedType {
  DeclId decl;      // TypeDecl; none for records of POUs and lists, and for types written in place
  TypeExprId type;  // as written
  PouId pou;        // the POU whose record it is
  PouId owner;      // the POU in whose VAR it is written
  FileId file;
  State resolved = State::New;
  State cut = State::New;  // visited by the search for types that contain themselves
  uint32_t depth = 0;      // of what records hold, when `cut` is Done
  bool library = false;
  bool internal = false;  // INTERNAL of a type; that of a POU is its access
  RegionId region;
  NameMap members;            // of records: Var; of enumerations: EnumValue
  std::vector<VarId> fields;  // of records, by field index
  std::vector<VarId> bits;    // of records: members of type BIT
};

struct Substitution {  // of an instance of a generic function
  types::TypeKind generic;
  TypeId type;
};

struct PouScope {
  State resolved = State::New;
  bool declared = false;  // its variables have their names
  RegionId region;
  NameId resource;  // of a program with instances in one resource only: its key
  NameMap names;
  std::vector<Substitution> substitutions;
};

struct ListScope {
  State resolved = State::New;
  NameMap names;
  std::vector<DeclId> decls;  // VarDecl, in order
  FileId file;
};

// ---- libraries: the index, and the declarations read so far

// One declaration of a library file: a POU, a TYPE block or a VAR_GLOBAL block.
struct LibraryBlock {
  uint32_t file = 0;  // index into Options::libraries
  uint32_t begin = 0, end = 0;
  bool loaded = false;
  bool qualified = false;  // found only through its namespace
};
struct LibraryName {
  NameId name;  // in the library's spelling
  uint32_t block = 0;
  uint32_t next = 0;  // another declaration of the name, 0: none
};

// A library, the project itself, a library among the sources, or a NAMESPACE (namespaces.cpp), in this order.
struct Namespace {
  NameId name;             // `Standard`, `Simatic.Ax`
  NameMap names;           // POUs, types, namespaces; of a library those read so far
  NameMap globals, items;  // of a NAMESPACE: its variables; enumeration items by their bare name
  uint32_t outer = ~0u;    // the NAMESPACE around it
  bool internal = false;
  uint32_t also = ~0u;      // of a library: another one that its alias names too
  bool of_library = false;  // a library among the sources: `names` holds what the project or another library has too
  Loc loc;
};
// A piece of source with its own view of names: a NAMESPACE block, a file or a POU with USING.
struct Region {
  RegionId outer;
  uint32_t space = ~0u;    // the namespace that the block declares
  uint32_t library = ~0u;  // of a file of a library among the sources: its Namespace
  bool of_file = false;
  std::vector<DeclId> usings;  // as written
  std::vector<uint32_t> open;  // the namespaces that they open
};
struct Libraries {
  std::deque<Namespace> list;             // by namespace index
  std::vector<uint32_t> library_of_file;  // of Options::libraries
  std::vector<uint32_t> of_source;        // by FileId: the Namespace of the library among the sources, or none
  std::vector<FileId> sources;            // of Options::libraries; none: not yet added to Sources
  std::vector<LibraryBlock> blocks;
  std::vector<LibraryName> names{1};
  NameMap index;           // name -> LibraryName (the entity's index; its kind is unused)
  NameMap namespaces;      // name or alias of a library -> Namespace
  NameMap hidden;          // name -> Options::libraries, of a file that another library hides
  NameMap extended;        // names of blocks that a library block extends: a set
  uint32_t project = ~0u;  // the index of the Namespace of the project itself
};

// The type of a written type expression.
struct WrittenType {
  TypeId type;        // none: not known yet
  bool busy = false;  // being resolved
};

struct Scopes {
  NodeMap<TypeExprId, WrittenType> written_types;
  NodeMap<DeclId, State> initial_values;      // of declarations
  std::unordered_map<uint32_t, ExprId> code;  // of expressions of declarations, by what is written
  struct Reported {                           // an unknown name
    uint64_t key;                             // the POU or type, and the name
    PouId body;                               // which has it; none: a declaration
    friend bool operator==(const Reported&, const Reported&) = default;
  };
  std::vector<Reported> reported;
  bool reports_all = false;  // an unknown name is reported wherever it is, also where declarations were lost
  NameMap pous_and_types;
  NameMap globals;
  NameMap items;             // enumeration items by their bare name: the first that was declared
  NameMap qualifiers;        // global lists, program instances
  NameMap resource_globals;  // name -> Project::resource_globals; the entity's kind is unused
  struct Instantiated {      // sets of programs
    NameMap once, again;
  } instantiated;
  std::vector<bool> item_is_ambiguous;  // by index of the first EnumValue

  struct NamedTypes {
    std::deque<NamedType> list{1};
    std::vector<uint32_t> of_type;  // by TypeId: index into the list, 0: none
  } named_types;
  std::deque<PouScope> pous{1};
  std::deque<ListScope> lists{1};
  NameMap member_names;  // unique names of methods and actions; a set
  NameMap instances;     // of generic functions, by unique name
  struct Mock {          // in use
    NameId key;          // of what it replaces, without its namespace
    PouId mock;
    PouId original = {};  // none: not looked up yet
    bool busy = false;
  };
  std::vector<Mock> mocks;
  struct HierarchicalAddress {  // of %QW0.1.2 (declarations/addresses.cpp)
    VarId named;                // the hidden variable that has the address as its name
    uint64_t bytes = 0, align = 1;
    std::vector<VarId> users;
  };
  struct Addresses {
    std::vector<HierarchicalAddress> hierarchical;
    NameMap names;  // address -> Var; the entity's index counts in `hierarchical`
    std::unordered_map<uint64_t, std::vector<VarId>> unnamed;  // VAR AT %QW5 : INT: by addressKey
  } addresses;
  struct LiteralStorage {  // whose address is taken (bodies/literal_storage.cpp)
    struct Entry {
      PouId pou;
      VarId var;
    };
    std::map<std::pair<uint32_t, uint64_t>, VarId> variables;  // by POU, and by string and kind
    std::vector<Entry> undeclared;                             // not yet in a list
  } literal_storage;

  // Everything declared, in order; resolveDeclarations() resolves from these positions on.
  std::vector<TypeId> declared_types;
  struct Positions {
    size_t types = 0, pous = 1, lists = 1;
  } resolved, checked;
  bool resolving = false;
  std::vector<VarId> reading_inits;  // variables whose initial values, or arguments of FB_Init, may read others
  uint32_t depth = 0;                // of declarations resolved within each other

  Libraries libraries;
  NameMap namespaces;  // NAMESPACEs that are not inside another
  struct Regions {
    std::deque<Region> list{1};                        // 0: file level without USING
    std::unordered_map<uint32_t, RegionId> of_file;    // by FileId: of files with USING
    std::unordered_map<uint32_t, RegionId> of_global;  // by VarId: of globals in a region
  } regions;
  struct OpenList {  // the list of globals that the last {list 'name'} opened, and its file
    std::string name;
    FileId file;
  } open_list;
  // Name keys of pragmas and keywords that declarations look for.
  struct KnownNames {
    NameId test, test_only, replaces, mock, skip, setup, teardown, test_case, safe_values, before_task, after_task,
        alias, required, optional, lazy, extensible, long_time, prefix, sized, slice, pure, native, op, std,
        no_final_scan, list, fault, no_copy, bytes;
    struct Attributes {  // {attribute 'name'}
      NameId qualified_only, strict, instance_path, no_check, no_virtual_actions, obsolete, to_string, call_after_init,
          pack_mode, global_init_slot, after_globals, initialize_on_call, is_connected, no_exit, reflection, symbol,
          unique_name, no_copy, init_on_change;
    } attributes;
  } known_names;

  struct ImplicitChecks {
    std::array<PouId, static_cast<size_t>(ImplicitCheck::Count_)> functions;  // of the project
    bool found = false;
  } implicit_checks;

  NamedType* named(TypeId type) {
    const uint32_t index = type.index < named_types.of_type.size() ? named_types.of_type[type.index] : 0;
    return index == 0 ? nullptr : &named_types.list[index];
  }
};

}  // namespace rung::sema
