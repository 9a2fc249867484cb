// SPDX-License-Identifier: Apache-2.0
// Where the source names what. In: each name that was resolved. Out: Pou::body.mentions and Project::mentions, when
// Options::records_mentions asks for them; editors find references there. Called by declarations and bodies.
#pragma once

#include <vector>

#include "sema/context.h"

namespace rung::sema {

void noteMention(Context& context, Entity entity, Loc loc, Access access);
// A name that is neither read nor written there: a type, a qualifier, a part of a path.
inline void noteName(Context& context, Entity entity, Loc loc) { noteMention(context, entity, loc, Access::Qualifier); }
// The value of a pragma is the name: {replaces 'Pump'}, {replaces 'Plant.Pump'}.
void noteNameInPragma(Context& context, Entity entity, const Pragma& pragma);
// The name means this entity, and not what was noted there last, which counts as used all the same.
void noteNameInstead(Context& context, Entity entity, Loc loc);
// What the check says elsewhere depends on the body that is being checked, so that another body in its place means a
// new check of the project.
void noteEffect(Context& context);

// The bodies that mention one of these variables, by VarId, for rules that would walk all of them. Where mentions are
// not recorded, any body may.
class BodiesWith {
 public:
  BodiesWith(const Project& project, std::vector<bool> wanted);
  bool mayMention(const Pou& pou) const;

 private:
  bool is_recorded_;
  std::vector<bool> wanted_;
};

}  // namespace rung::sema
