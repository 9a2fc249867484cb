// SPDX-License-Identifier: Apache-2.0
// Shared by the files of declarations/. Declarations are resolved on demand: collect() gives every name its entity,
// resolveDeclarations() resolves, lays out and checks everything declared since the last time, and a library
// declaration joins when it is first looked up. The rest of sema uses the functions of context.h.
#pragma once

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

inline constexpr uint32_t kMaxDeclarationDepth = 500;
inline constexpr uint32_t kMaxTypeDepth = 2500;    // structures and blocks inside each other, arrays of arrays
inline constexpr uint32_t kMaxGenericDepth = 100;  // blocks with other generic constants inside each other
inline constexpr uint32_t kMaxBases = 500;         // bases of bases

// The same project seen from another location.
inline Context at(Context& context, PouId pou, FileId file, bool library, RegionId region = {}) {
  return Context{.symbols = context.symbols,
                 .project = context.project,
                 .scopes = context.scopes,
                 .pou = pou,
                 .file = file,
                 .library = library,
                 .region = region};
}
inline Context atPou(Context& context, PouId pou) {
  Context there = at(context, pou, context.symbols.pou(pou).file, context.symbols.pou(pou).library,
                     context.scopes.pous[pou.index].region);
  const PouId owner = context.symbols.pou(pou).owner;
  there.resource = context.scopes.pous[owner ? owner.index : pou.index].resource;
  return there;
}
inline Entity entity(VarId id) { return Entity::of(EntityKind::Var, id.index); }
inline Entity entity(PouId id) { return Entity::of(EntityKind::Pou, id.index); }
inline Entity entity(TypeId id) { return Entity::of(EntityKind::Type, id.index); }
inline NameId keyOf(const Context& context, NameId name) { return context.names().key(name); }
inline std::string toString(const Context& context, NameId name) { return std::string(context.names().string(name)); }

// ---- collect.cpp
void internKnownNames(Context& context);
// The declarations of all files of the tree.
void collectFiles(Context& context);
// One declaration at `context`; of a library when `library` is given.
void collectDecl(Context& context, DeclId decl, FileId file, uint32_t library);
inline constexpr uint32_t kNoLibrary = ~0u;
NamedType& addNamed(Context& context, TypeId type);
// The pragma with this name key, or null.
const Pragma* findPragma(const Context& context, const DeclHeader& header, NameId key);
void reportTwice(Context& context, NameId name, Loc loc, Loc first);
// Adds the items of an enumeration to a table; their values are resolved later.
void declareItems(Context& context, TypeId type, TypeExprId written, NameMap* bare, bool project_wide);

// ---- names.cpp
// A global variable as the resource of `context` sees its name.
Entity globalOfResource(const Context& context, NameId key, Entity global);
// Whether code that several resources run cannot name it, because they declare it differently.
bool differsByResource(Context& context, NameId key);

// ---- namespaces.cpp
struct DeclInRegion {
  DeclId decl;
  FileId file;
  RegionId region;
};
// The declarations of all files with their regions, those in NAMESPACEs included; creates the namespaces.
std::vector<DeclInRegion> collectNamespaces(Context& context);
// The region of a POU declared here: a new one if it has USINGs.
RegionId regionOfPou(Context& context, const PouDecl& decl);
// The NAMESPACE around the current location, or null.
Namespace* namespaceAround(Context& context);
// The namespace that a POU or type of this name is declared in: that NAMESPACE; in a library among the sources, the
// library where another declaration has the name; or null. And the name in it in full: `Simatic.Ax.Motor`.
Namespace* namespaceFor(Context& context, NameId name);
NameId qualifiedName(Context& context, NameId name);
// The Namespace of the library among the sources that a file belongs to, or kNoLibrary.
uint32_t libraryOfSource(const Context& context, FileId file);
// The meaning of a name in the namespaces around `context` and their USINGs; and in the USINGs of the file, which come
// after the names of the project.
Entity lookUpAround(Context& context, NameId key, Loc loc, bool types_only);
Entity lookUpOpened(Context& context, NameId key, Loc loc, bool types_only);
RegionId regionOfFile(const Context& context, FileId file);
// The meaning of `A.B.name`; Error after a report.
Entity lookUpQualified(Context& context, Slice<Ident> path);
// The namespace of a name at `context`: a NAMESPACE, a library, the project.
Entity findNamespace(Context& context, NameId name);
// The entity that a namespace declares under a name.
Entity lookUpNamespace(Context& context, uint32_t space, NameId key);
bool isVisible(Context& context, Entity found);
// The full name of an entity that some NAMESPACE declares under a name unknown here; empty when none does.
std::string_view nameElsewhere(Context& context, NameId key);

// Kinds with locals and parameters instead of an instance.
inline bool isFunction(PouKind kind) {
  return kind == PouKind::Function || kind == PouKind::Method || kind == PouKind::Action;
}

// ---- names.cpp
// What was found under a name, or the mock that replaces it in this program: everywhere except in the mock itself.
Entity orMock(Context& context, NameId key, Entity found);
// The meaning of a name with or without namespaces, perhaps not resolved yet.
Entity findDotted(Context& context, NameId dotted);

// ---- variables.cpp
// VAR_GLOBAL in a PROGRAM: allowed by the standard, not by codesys.
inline bool mayHoldGlobals(const Context& context, PouKind kind) {
  return kind == PouKind::Program && context.profile().globals_in_programs;
}
// Gives the variables of one VarDecl their ids and names. Types follow later.
void declareVars(Context& context, DeclId decl, const SectionDecl& section, PouId pou, ListId list, NameMap* names,
                 std::vector<VarId>& into);
void ensureVarType(Context& context, VarId id);
// The declared initial value of the variables of one VarDecl: checked once; constants get their values.
void ensureInitialValue(Context& context, VarId id);
void declarePou(Context& context, PouId pou);
void resolveList(Context& context, ListId list);
void checkModifiers(Context& context, const SectionDecl& section);
// The field of a record that holds a variable.
void addField(Context& context, TypeId record, VarId id);
// The record type of a STRUCT or UNION, without its members. (types.cpp)
TypeId addStructure(Context& context, TypeExprId written, NameId name);

// ---- bit_members.cpp
bool isNamedBit(const Context& context, NameId name);
bool isBit(Context& context, TypeExprId written);
bool mayBeBit(Context& context, const Var& var, TypeExprId written);
void addBit(Context& context, TypeId record, VarId id);
VarId addByteOfBits(Context& context, TypeId record, VarId first);
void addBitAt(Context& context, TypeId record, VarId id, VarId byte, uint8_t bit);
uint8_t initialBits(Context& context, TypeId record, VarId byte);

// ---- relative_addresses.cpp: fields of a structure whose members have AT offsets (AT %B2), with filler between them
void layOutMembers(Context& context, TypeId record, std::span<const VarId> members);

// ---- objects.cpp
// USTRING and UCHAR of edition 4 are not keywords: the project's own type of such a name, or none.
TypeId ownTypeOfLateName(Context& context, NameId name, types::TypeKind kind);

// METHODs, ACTIONs and PROPERTYs of a POU: a Pou each.
void collectMembers(Context& context, PouId owner);
// FB_Init, FB_Reinit, FB_Exit: called when an instance is created, moved and destroyed (codesys).
bool isLifeMethod(const Context& context, NameId name);
// Resolves what an object extends and implements; checked once.
void resolveHeader(Context& context, PouId object);
// The same for all POUs, so that it is known which blocks are extended before the first is laid out.
void resolveHeaders(Context& context);
// The hidden fields with which an object begins: type id, base.
void addObjectFields(Context& context, PouId object);
// The names of members in the scope of their object, and VAR_INST of its methods.
void declareMembers(Context& context, PouId object);

// ---- shared_temporaries.cpp
// Hidden fields for VAR_TEMP that actions use, variables for those of a base that the body uses.
void shareTemporaries(Context& context, PouId pou);

// ---- addresses.cpp: see resolveAddress in context.h
// None: no area has that letter, which was reported.
std::optional<types::AreaId> areaOf(Context& context, const DirectAddress& address, Loc loc);
// Equal for addresses that are written alike.
uint64_t addressKey(const Context& context, const DirectAddress& address);
// How many bytes an area may have.
uint64_t areaLimit(const Context& context, types::AreaId area);

// ---- types.cpp
void resolveNamed(Context& context, TypeId type);
void reportTooDeep(Context& context, Loc loc, const char* what, uint32_t limit);
TypeId lookUpType(Context& context, NameId name, Loc loc = {});

// ---- resolve.cpp
void resolveDeclarations(Context& context);
// Lays out a type, with what it holds resolved first. False when it is too large.
bool ensureLayout(Context& context, TypeId type);
// Whether the layout of a type can be known now; reports one that the expression with `function` determines itself.
bool checkLayout(Context& context, std::string_view function, TypeId type, Loc loc);

// ---- constants.cpp
// A constant integer, as in bounds and lengths; reports an expression that is not one.
std::optional<int64_t> constantBound(Context& context, ExprId& expr);

// The instance of a block with VAR_GENERIC CONSTANT for the values in `Ring<20>`, created on first use; a block without
// them is its own instance. None: reported.
PouId instantiateBlock(Context& context, PouId block, const NamedTypeExpr& written);

// The function from a number to the name of the item, of an enumeration with {attribute 'to_string'}; else none.
PouId itemNamesOf(Context& context, TypeId type);

// ---- initial_values.cpp
// What an initial value may read in codesys: only constants, variables with the same lifetime, also those of the call.
enum class InitialReads : uint8_t { Constants, Globals, Variables, Call };
// True when it reads variables.
bool checkInitializerAs(Context& context, ExprId& init, TypeId type, std::string_view what,
                        InitialReads may = InitialReads::Constants);
// ---- initial_order.cpp
void orderInitialValues(Context& context);

// ---- libraries.cpp
// An entity of the library __SYSTEM, the compiler's own, by name.
Entity lookUpSystem(Context& context, std::string_view name);
// The structure __SYSTEM.AnyType.
TypeId anyType(Context& context);
void indexLibraries(Context& context);
// A name of the libraries, read on first use; of one library only when `library` is given.
Entity lookUpLibrary(Context& context, NameId name, uint32_t library = kNoLibrary);
// The name by which the module knows a POU or type of a library: with the library's name if the bare name means one of
// the project or of another library.
NameId uniqueNameInLibrary(Context& context, uint32_t library, NameId name);
// `CAA.PVOID`: how messages name it then.
NameId nameWithLibrary(Context& context, uint32_t library, NameId name);

}  // namespace rung::sema
