// SPDX-License-Identifier: Apache-2.0
#include "sema/project.h"

#include <utility>

namespace rung::sema {

Project::Project(Sources& the_sources, Names& the_names, Diagnostics& the_diagnostics, Tree& the_tree,
                 Options the_options)
    : Symbols{the_sources,
              the_names,
              the_diagnostics,
              the_tree,
              the_tree,
              profileOf(the_options.dialect),
              the_options.native_width,
              types::TypeTable(the_names, the_options.pointer_size)},
      options(std::move(the_options)) {
  for (const types::MemoryArea& area : options.areas) area_bytes.push_back(area.bytes);
  types.time_is_signed = !profile.unsigned_time;
  types.long_time_is_signed = profile.signed_long_time;
}

std::span<const DeclId> Project::madeSections(const PouDecl& pou) const {
  const auto found = made_sections.find(&pou);
  return found == made_sections.end() ? std::span<const DeclId>() : std::span<const DeclId>(found->second);
}

VarId ResourceGlobals::of(NameId resource) const {
  VarId found = all.front().var;
  bool is_outer = false;
  for (const Own& own : all) {
    if (own.resource == resource) return own.var;
    if (own.resource || is_outer) continue;
    found = own.var;
    is_outer = true;
  }
  return found;
}

}  // namespace rung::sema
