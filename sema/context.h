// SPDX-License-Identifier: Apache-2.0
// The state that the parts of sema share: the project, the current scope, and the few functions through which
// declarations (declarations/, types, constants, libraries) and bodies (bodies/, calls, checks/) use each other.
// Internal to sema/.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "frontend/source/dialect.h"
#include "frontend/syntax/tree_builder.h"
#include "sema/entities.h"

namespace rung::sema {

struct Project;    // project.h
struct Scopes;     // scopes.h: hash tables of the project, of each POU, of libraries
struct BodyState;  // bodies/bodies.h: state shared by the statements of one body

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
  uint32_t depth = 0;         // of the current expression, limits nesting in the input
  BodyState* body = nullptr;  // none outside of a body
  TypeId items_of = {};       // an enumeration that is being declared: its items need no qualifier
  bool library = false;       // inside a library: read as codesys, names of the project are not visible
  RegionId region = {};       // the namespaces around the current location
  TypeId record = {};         // a structure whose members get their initial values: THIS
  NameId resource = {};       // the key of the only resource that runs this code, or none: whose globals it sees
  ListId list = {};           // a list of globals that is being declared: its variables need no qualifier

  Tree& tree() const { return symbols.tree; }
  types::TypeTable& types() const { return symbols.types; }
  Names& names() const { return symbols.names; }
  // Nodes that make explicit what the source leaves implicit; replace() puts one into the slot of what was written.
  TreeBuilder build() const { return TreeBuilder(tree(), TreeBuilder::Origin::Inserted); }
  void replace(ExprId& slot, ExprId by) const { tree().replace(slot, by); }
  Report report(Diag diag, Loc loc, std::initializer_list<std::string_view> args = {}) const {
    return symbols.diagnostics.report(diag, loc, args);
  }
  // What the language of the current code allows and means.
  const LanguageProfile& profile() const { return library ? profileOf(Dialect::Library) : symbols.profile; }
  // Integers compute in the native width: sema/intermediate.h.
  bool isWide() const { return profile().narrow_integers_widen; }
};

// ---- declarations (declarations/)

// The meaning of a name at `context`: variables of the POU, then the namespaces around it, then POUs, types, globals,
// enumeration items and lists of the project, then libraries, which are read on first use. None when unknown. Reports
// only if `loc` is given, and only a name that USINGs make ambiguous or that is INTERNAL elsewhere.
Entity lookUp(Context& context, NameId name, Loc loc = {});
// The meaning of a written name: `.name` is looked up outside of POUs.
Entity lookUp(Context& context, const NameExpr& name, Loc loc = {});
// `qualifier.name`: members of a GVL, of a namespace, of an enumeration type.
Entity lookUpIn(Context& context, Entity qualifier, NameId name);
// Whether `context` may use `found`; reports an entity that is INTERNAL to another namespace.
bool checkVisible(Context& context, Entity found, Loc loc);
// Whether `context` is in the namespace of a region, or in one within it.
bool isInside(const Context& context, RegionId declared);
// True when several enumerations have an item of this bare name: its context must decide which is meant.
bool isAmbiguousItem(Context& context, Entity item);
// The visible name most similar to a misspelled one, or empty.
std::string_view nearestName(Context& context, NameId written);
// The same among what a call can name: functions, programs, methods and variables.
std::string_view nearestCallable(Context& context, NameId written);

// Syntax errors took declarations from this POU, or its base is not known: a missing name is not a second mistake.
bool isBroken(const Context& context, PouId pou);
// Whether to report that a name, or a member of a record, is not declared: once per POU, and only where no declaration
// was lost to a syntax error.
bool isFirstReport(Context& context, NameId name);
bool isFirstReportOfMember(Context& context, TypeId record, NameId name);

// ---- objects (declarations/objects.cpp)

// The object whose members a body may name: its block, or the owner of the method. None in functions.
PouId objectOf(const Context& context);
// A variable, method, action or property of an object or of its bases; none when there is none.
Entity findInObject(Context& context, PouId object, NameId name);
// Whether `object` is `base`, extends it or implements it.
bool isKindOf(Context& context, PouId object, PouId base);
// The interface or block whose record, or pointer to an interface, a type is; none for other types.
PouId interfaceOf(Context& context, TypeId type);

// FB_Init of an object, its own or inherited; none when it has none.
PouId constructorOf(const Context& context, PouId object);
// Checks the arguments for FB_Init in the declaration of a variable; `type` is as written. (bodies/objects.cpp)
// For an array whose elements have separate arguments, `elements` calls follow each other.
CallId checkConstructor(Context& context, TypeExprId type, uint32_t& elements);

// Resolves a type as written; after a report kError. Writes TypeExprHeader::type.
TypeId resolveType(Context& context, TypeExprId type);
// Makes sure that a POU's result, pins and variables are resolved (not its body). Safe against cycles.
void resolvePou(Context& context, PouId pou);
// A field or pin of a record, by name or by a pin's alias; none when there is none.
VarId findMember(Context& context, TypeId record, NameId name);

// A variable or pin of a POU by name or alias; none when there is none.
VarId findPin(Context& context, PouId pou, NameId name);
// The view of the image at an address; none after a report. `type`: of the variable, or none for a bare address, whose
// type follows from its size (see addressType). Records the bytes used.
std::optional<ImageView> resolveAddress(Context& context, const DirectAddress& address, Loc loc, TypeId type);
// Hierarchical addresses, %QW0.1.2: each gets a separate location, chosen by allocateHierarchical when all other
// addresses are known.
bool isHierarchical(const Context& context, const DirectAddress& address);
// The hidden variable of such an address; `user`: a variable located there, or none. None after a report.
VarId hierarchicalVar(Context& context, const DirectAddress& address, Loc loc, VarId user);
void allocateHierarchical(Context& context);
// BOOL, BYTE, WORD, DWORD or LWORD, by the size letter.
TypeId addressType(const DirectAddress& address);
// The type that `VAR AT %QW5 : INT; END_VAR` without a name gives to an address of this size; none: it gives none.
TypeId declaredAddressType(Context& context, const DirectAddress& address);

// The value of an expression that was checked, when it is constant (literals, constants, operators on them,
// conversions, SIZEOF). Faults in it (1/0, overflow) are reported once.
std::optional<types::Value> evaluate(Context& context, ExprId expr);
// The same; an expression that is not constant is an error.
std::optional<types::Value> requireConstant(Context& context, ExprId expr, TypeId type);

// Checks the initial value of a variable, field or type against its type, converting in place; arrays, structures and
// FB instances by their initialisers.
void checkInitializer(Context& context, ExprId& init, TypeId type);

// A new instance of a generic or extensible library function for these pin types (parsed again from its source).
// `types_by_pin` has one type per declared pin; extra inputs of an extensible pin share that pin's type.
PouId instantiate(Context& context, PouId generic, std::span<const TypeId> types_by_pin, TypeId result);

// ---- bodies (bodies/)

// Checks an expression and returns its type (kError after a report). `expected` (or none) is the type that the context
// wants: it types literals and picks enumeration items; nothing is converted. May replace the expression.
TypeId checkExpr(Context& context, ExprId& expr, TypeId expected = {});
// Checks, then converts implicitly to `to` if the dialect allows it (wraps in ConvertExpr), else reports. `what`
// describes the use, for the message: "assigned to `x`".
bool checkExprAs(Context& context, ExprId& expr, TypeId to, std::string_view what);
// Makes an lvalue the target of a reference of this type; reports when the reference cannot be bound to it.
bool bindReference(Context& context, ExprId& lvalue, TypeId reference);
// Gives a new node its type (synthesized_nodes.cpp).
ExprId typed(Context& context, ExprId created, TypeId type);
// A literal of a known type.
ExprId makeLiteral(Context& context, LiteralKind kind, TypeId type, int64_t value, Loc loc);
// A string that lives in the tree, of the type STRING(its length).
ExprId makeStringLiteral(Context& context, std::string_view text, Loc loc);
void checkBody(Context& context, PouId pou);
// Checks the body of a POU unless that is done. False: it has errors, or is being checked.
bool ensureBody(Context& context, PouId pou);
// Checks the arguments of PROGRAM p WITH t : Main(...), like those of a call of that program.
void checkConnections(Context& context, ExprId call, PouId program);
// The list of the strings in a POU whose address is taken; of all POUs without one yet. (bodies/literal_storage.cpp)
void declareLiteralStorage(Context& context, PouId pou);
void declareLiteralStorage(Context& context);
// The rules that need all bodies: recursion, unused variables. check() calls it once, when every body is checked.
void checkAfterBodies(Context& context);

}  // namespace rung::sema
