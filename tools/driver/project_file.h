// SPDX-License-Identifier: Apache-2.0
// rung.project: the INI file that a project folder may have (docs/project.md lists its sections and keys). In: its
// content. Out: settings, which the command line overrides, and one generated CONFIGURATION for the tasks. Unknown
// sections and keys are errors at their location. Called by inputs.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/formats.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "sema/options.h"
#include "sema/types/areas.h"
#include "tools/driver/options.h"

namespace rung::driver {

struct ProjectEntry {
  std::string key, value;
  Loc key_loc, value_loc;
};
struct ProjectSection {
  std::string kind, name;  // [axis conveyor]: "axis", "conveyor"
  Loc loc;
  std::vector<ProjectEntry> entries;

  const ProjectEntry* find(std::string_view key) const;
};

struct ProjectFile {
  FileId file;  // none: the project has no rung.project
  std::string folder;
  std::vector<ProjectSection> sections;  // all, in order: later layers read module, axis, safe, nc, pool

  std::vector<std::string> sources, libraries;  // paths relative to `folder`
  std::string name;
  bool has_dialect = false, has_native_width = false, has_edge_coils = false, has_checks = false, has_level = false;
  Dialect dialect = kDefaultDialect;
  uint32_t native_width = 32;
  diagram::EdgeCoils edge_coils = diagram::EdgeCoils::Pulse;
  uint8_t checks = 0;
  int level = 1;
  uint32_t pool_bytes = 0;  // 0: not given
  importer::LadderSettings ladder;
  format::Style style;
  types::MemoryAreas areas = types::standardAreas();
  bool aligned_globals = false;
  std::vector<sema::TaskDuration> task_durations;
  std::vector<sema::ConfiguredModule> io_modules;
  std::vector<WarningSwitch> warnings;
  std::vector<text::Define> defines;

  FileId module_variables;  // the channels of the [module] sections in ST, mapped to this file; none: no such section
  FileId axis_variables;    // the axes of the [axis] sections in ST, mapped to this file; none: no such section
  FileId safe_values;       // the section [safe] as a function in ST, mapped to this file; none: no such section
  FileId configuration;     // the tasks as a CONFIGURATION in ST, mapped to this file; none: no [task] section
};

void parseProjectFile(Sources& sources, FileId file, Diagnostics& diagnostics, ProjectFile& project);

// The libraries of the file, as -I takes them.
std::vector<std::string> libraryPaths(const ProjectFile& project);

// The sections that the file may have.
struct ProjectSchema {
  const char* kind;
  bool named;        // `[axis conveyor]`
  const char* keys;  // separated by blanks; null: any (paths, parameters)
};
std::span<const ProjectSchema> projectSchemas();

// Applies the settings of the file that the command line does not have.
void applyProjectFile(const ProjectFile& project, ProjectOptions& options);

}  // namespace rung::driver
