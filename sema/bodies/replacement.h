// SPDX-License-Identifier: Apache-2.0
// Another body in the place of one that was checked. In: POUs of a checked project. Out: a project that knows nothing
// of their bodies, as before ensureBody(). Called for editors, at each key.
#pragma once

#include <span>
#include <vector>

#include "sema/context.h"
#include "sema/entities.h"

namespace rung::sema {

// Whether the body is in ST, and neither declarations nor other bodies depend on it.
bool isReplaceable(Context& context, PouId pou);

// Takes back what these bodies said and noted.
void takeBackBodies(Context& context, std::span<const PouId> pous);

// Gives a POU another body that is not checked yet, for as long as this lives; then all is as it was but for what
// outlives bodies, as a library block in use.
class OtherBody {
 public:
  OtherBody(Context& context, PouId pou, DeclId decl);
  ~OtherBody();
  OtherBody(const OtherBody&) = delete;
  OtherBody& operator=(const OtherBody&) = delete;

 private:
  Context& context_;
  PouId pou_;
  DeclId own_decl_;
  Pou::Body own_body_;
  Pou::Progress::Body own_state_;
  std::vector<bool> used_;  // by POU
  size_t edges_, writes_, reported_;
};

}  // namespace rung::sema
