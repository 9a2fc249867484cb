// SPDX-License-Identifier: Apache-2.0
// The state that the parts of sema share: the project, the current scope, and how lower layers reach later ones:
// through `rules` and `expressions`. Internal to sema/, whose layers are what lies directly in it, declarations/,
// bodies/, checks/ and, above all, check.h; each uses only those before it.
#pragma once

#include <string_view>

#include "frontend/source/dialect.h"
#include "sema/code.h"
#include "sema/entities.h"

namespace rung::sema {

struct Project;     // project.h
class Rules;        // hooks.h
class Expressions;  // declarations/expressions.h
struct Scopes;      // scopes.h: hash tables of the project, of each POU, of libraries
struct BodyState;   // bodies/body.h: state shared by the statements of one body

// A piece of source with its own view of names (declarations/namespaces.cpp); 0: file level without USING.
struct RegionId {
  uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
};

struct Context {
  Symbols& symbols;
  Project& project;  // the same object, with fields that only few rules read
  Scopes& scopes;
  PouId pou;    // whose declarations or body are being checked; none: file level
  FileId file;  // for diagnostics and for names that a library file sees first
  uint32_t loop_depth = 0, try_depth = 0;
  uint32_t depth = 0;            // of the current expression, limits nesting in the input
  BodyState* body = nullptr;     // none outside of a body
  TypeId items_of = {};          // an enumeration that is being declared: its items need no qualifier
  bool library = false;          // inside a library: read as codesys, names of the project are not visible
  RegionId region = {};          // the namespaces around the current location
  TypeId record = {};            // a structure whose members get their initial values: THIS
  NameId resource = {};          // the key of the only resource that runs this code, or none: whose globals it sees
  ListId list = {};              // a list of globals that is being declared: its variables need no qualifier
  const Rules* rules = nullptr;  // hooks.h: what looks at each use, statement, body … that is checked
  const Expressions* expressions = nullptr;  // declarations/expressions.h: how declarations check their expressions

  // What was written, and the code that is made of it.
  const Tree& tree() const { return symbols.tree; }
  Code code() const { return Code(symbols.arena); }
  Meaning& meaning(ExprId expr) const { return sema::meaning(symbols.tree, expr); }
  TypeId& type(ExprId expr) const { return meaning(expr).type; }
  types::TypeTable& types() const { return symbols.types; }
  Names& names() const { return symbols.names; }
  // Nodes that make explicit what the source leaves implicit; replace() puts one into the slot of another.
  TreeBuilder build() const { return code().build(); }
  void replace(ExprId& slot, ExprId by) const { code().replace(slot, by); }
  Report report(Diag diag, Loc loc, std::initializer_list<std::string_view> args = {}) const {
    return symbols.diagnostics.report(diag, loc, args);
  }
  // What the language of the current code allows and means.
  const LanguageProfile& profile() const { return library ? profileOf(Dialect::Library) : symbols.profile; }
  // Integers compute in the native width: sema/intermediate.h.
  bool isWide() const { return profile().narrow_integers_widen; }
};

// The code of an expression of a declaration, made when it is first asked for: what is written in one place is checked
// once. The slot takes what replaces it; none: no expression, or none that can be used.
ExprId& codeOf(Context& context, ExprId written);

// The same project seen from another location; from file level and from within a POU.
Context at(Context& context, PouId pou, FileId file, bool library, RegionId region = {});
Context atPou(Context& context, PouId pou);

}  // namespace rung::sema
