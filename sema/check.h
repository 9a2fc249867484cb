// SPDX-License-Identifier: Apache-2.0
// The check of a project: declarations, bodies and rules (declarations/, bodies/, checks/), in this order. Called by
// the tools once for each project.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sema/bodies/constant_cams.h"
#include "sema/project.h"

namespace rung::sema {

// A context at file level, with which a tool resolves single declarations; `scopes` is empty and outlives it.
Context contextOf(Project& project, Scopes& scopes);

// Checks the whole project: collects the declarations of tree.files, resolves types and layout, checks every body,
// resolves libraries on demand. Errors go to project.diagnostics. Bodies of library POUs are checked when used.
// Afterwards each expression of a checked body has its type, implicit conversions are ConvertExpr nodes, untyped
// literals have their context's type, and project.pous lists user POUs and the library POUs in use.
void check(Project& project);

// A checked project, of which bodies may be replaced while declarations stay: what an editor does at each key.
class CheckedProject {
 public:
  // As check() does.
  explicit CheckedProject(Project& project);
  ~CheckedProject();

  // The sources of Options::libraries, so that the next project of the same Sources need not add them again.
  std::span<const FileId> librarySources() const;

  // The same POU with another body, in ST.
  struct NewBody {
    PouId pou;
    DeclId decl;
  };
  // Checks these bodies in the place of those that the POUs have, and the rules of the project. What was said of them
  // is taken back. False: declarations or other bodies depend on one of them, so that the project is to be checked
  // again, and what is known of it now is of no use.
  bool replaceBodies(std::span<const NewBody> bodies);
  // Checks a body in the place of that of its POU, to see what is wrong with it. What is known of the project is of no
  // use afterwards: for a copy of the process, which ends then.
  void tryBody(const NewBody& body);
  // The type of a declaration that was parsed for this, as a POU or, without one, the project sees its names; its
  // initial value is checked with it. The project is of no use afterwards.
  TypeId typeOfDeclaration(PouId pou, DeclId var);
  // Whether another body of the POU can be tried and its own one put back. It may not name an address.
  bool canTryBody(PouId pou);
  // Does so. What is said of the body stays in the diagnostics.
  void tryBodyForNow(const NewBody& body);
  // Grows with what outlives bodies, such as a library block that one used first.
  size_t knownBesideBodies() const;

 private:
  Project& project_;
  std::unique_ptr<Scopes> scopes_;
};

// For pictures: the pins of boxes that are in-outs of what they call, by their index in the tree. Collects and resolves
// declarations as check() does; bodies stay as parsed.
std::vector<bool> inOutsOfBoxes(Project& project);

// The cams whose table the source declares, after check().
std::vector<ConstantCam> constantCams(Project& project);

}  // namespace rung::sema
