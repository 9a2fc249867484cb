// SPDX-License-Identifier: Apache-2.0
// The whole project as sema understands it: the symbols, and what runs them: tasks, instances, addresses, initial
// values. In: the syntax trees of all files and the libraries they use. Out: tables that lowering, code generation, the
// symbol map and the tools read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/schedule/network_variables.h"
#include "sema/entities.h"
#include "sema/options.h"

namespace rung::sema {

enum class TaskKind : uint8_t { Cyclic, Freewheeling, Event, Status, External };
struct Task {
  NameId name;
  NameId resource, configuration;  // none: of the project
  TaskKind kind = TaskKind::Cyclic;
  int64_t interval_ns = 0;
  uint32_t priority = 0;
  std::string trigger;         // Event (SINGLE or TRIGGER), Status: path of a BOOL in the symbol map
  std::string external_event;  // External
  int64_t watchdog_ns = 0;
  uint32_t sensitivity = 0;
  int64_t duration_ns = 0;  // simulated execution time, in virtual time only
  Loc loc;
  Loc priority_loc, interval_loc, watchdog_loc;  // of the values; none: not written
};
struct ProgramInstance {  // without a task it never runs (warned)
  NameId name;
  NameId resource, configuration;
  PouId program;
  uint32_t task = 0;    // index into Project::tasks + 1; 0: none
  bool retain = false;  // PROGRAM RETAIN
  Loc loc;
  ExprId connections;  // PROGRAM p : Main(in := x, out => y): a checked CallExpr of the program; or none
};

// A variable of one instance that has an address (AT %I* in a block) or an initial value of its own (VAR_CONFIG).
struct PathStep {
  VarId var;             // a field, or a global variable; none: an element
  int64_t element = -1;  // of an array, counted row by row
};
struct InstancePath {
  static constexpr uint32_t kNone = ~0u;
  uint32_t instance = kNone;   // index into Project::instances; none: see `program`
  PouId program;               // of the instance, or a test; none: the path begins with a global variable
  std::vector<PathStep> path;  // from there to `var`
  VarId var;
  bool located = false;  // `image` is copied from and to the field
  ImageView image;
  ExprId init;  // none: the declared one
  bool configured = false;
  Loc loc;  // in VAR_CONFIG
};

// A name of VAR_ACCESS and the variable that it means.
struct AccessPath {
  enum class Root : uint8_t { Project, List, Instance } root = Root::Project;  // Project: not resolved, or an address
  uint32_t index = 0;                                                          // of the list or the instance
  uint64_t offset = 0;                                                         // in its memory
  int bit = -1;                                                                // of a member of type BIT
  bool located = false, read_only = true;
  ImageView image;                     // when located
  NameId name, prefix, configuration;  // `prefix`: the program instance whose VAR_ACCESS it is
  TypeId type;
  Loc loc;
};
// PROGRAM p WITH t : Main (block WITH task): an instance of a block that a separate task runs.
struct BlockTask {
  uint32_t instance;  // index into Project::instances
  VarId block;        // a field of its program
  uint32_t task;      // index into Project::tasks + 1
  Loc loc;
};

// Global variables of one name in several resources, or in a resource and outside of all: each resource sees its own,
// else that of its configuration. IEC 61131-3 ed. 3, 6.8.1.
struct ResourceGlobals {
  struct Own {
    NameId resource;  // its key; none: of the configuration or a file
    VarId var;
  };
  std::vector<Own> all;  // in order of declaration; code that several resources run names the first

  VarId of(NameId resource) const;
};

struct Project : Symbols {
  Project(Sources& sources, Names& names, Diagnostics& diagnostics, Tree& tree, Options options);

  Options options;
  std::vector<VarId> late;  // globals whose initial values read others, in the order in which they are set
  std::vector<Task> tasks;
  std::vector<ProgramInstance> instances;
  std::vector<InstancePath> instance_paths;
  std::vector<AccessPath> access_paths;
  std::vector<BlockTask> block_tasks;
  std::vector<ResourceGlobals> resource_globals;
  // The sections that schedulers made for a POU, beside those that it declares.
  std::unordered_map<const PouDecl*, std::vector<DeclId>> made_sections;
  std::span<const DeclId> madeSections(const PouDecl& pou) const;
  diagram::NetworkVariables network_variables;   // that these sections declare
  std::vector<Loc> type_locs;                    // by TypeId: of the name of a declared type, or none
  std::vector<ExprId> type_inits;                // by TypeId: the declared initial value of a named type, or none
  std::vector<std::vector<ExprId>> field_inits;  // by TypeId of a record: declared initial value per field, or none
  // Who calls whom, in the order of the calls, with the location of the call: for the recursion rule.
  struct CallEdge {
    PouId caller, callee;
    Loc loc;
  };
  std::vector<CallEdge> call_edges;
  struct GlobalWrite {
    PouId pou;
    VarId var;
  };
  std::vector<GlobalWrite> global_writes;  // by bodies, of variables outside of the instance: for the rule on tasks
  std::vector<Mention> mentions;  // by declarations: Options::records_mentions; those of bodies are in Pou::body
  std::vector<types::IoModule> io_modules;
  std::vector<uint32_t> area_bytes;  // by AreaId: the declared size, or the end of the last used byte
};

}  // namespace rung::sema
