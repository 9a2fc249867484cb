// SPDX-License-Identifier: Apache-2.0
// The result type of a box, found without sema: from the name of the operator or function, from the types of the
// sources wired to the box, or from the variables that receive its value.
#include <algorithm>
#include <string>

#include "frontend/schedule/network_feedback.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/children.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/standard_names.h"
#include "frontend/syntax/tree_builder.h"

namespace rung::diagram {
namespace {

constexpr uint32_t kMaxDepth = 100;

bool isOneOf(std::string_view name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return sameIdentifier(word, name); });
}

bool compares(BinaryOp op) { return op >= BinaryOp::Equal && op <= BinaryOp::GreaterEqual; }

}  // namespace

// ---- boxes and wires

// The type of each box is computed once, so that boxes which share their inputs cost linear time.
TypeExprId BoxTypes::ofBox(uint32_t element, uint32_t depth) {
  if (known_.empty()) {
    known_.resize(graph_.elements.size());
    tried_.resize(graph_.elements.size());
  }
  if (depth > kMaxDepth || tried_[element]) return known_[element];
  tried_[element] = true;
  return known_[element] = ofCall(element, depth);
}

TypeExprId BoxTypes::ofCall(uint32_t element, uint32_t depth) {
  const Element& e = graph_.elements[element];
  const std::string_view name = names_.string(e.name.name);
  const OperatorFunction* const function = operatorFunction(name);
  if (function != nullptr && compares(function->op)) return named("BOOL", e.loc);
  const std::string word = upper(name);
  if (const size_t to = word.rfind("TO_"); to == 0 || (to != std::string::npos && word[to - 1] == '_'))
    return named(word.substr(to + 3), e.loc);
  const bool selects = isOneOf(name, {"SEL", "MUX"});
  if (selects || function != nullptr ||
      isOneOf(name, {kNot, kMove, "MAX", "MIN", "LIMIT", "ABS", "SHL", "SHR", "ROL", "ROR", "EXPT"}))
    return ofOperands(element, selects, depth);
  const DeclId callee = e.path && tree_.kind(e.path) == ExprKind::Name ? declared(e.name.name) : DeclId{};
  if (callee && tree_.kind(callee) == DeclKind::Pou && tree_.as<PouDecl>(callee).result)
    return tree_.as<PouDecl>(callee).result;
  if (const TypeExprId result = e.path ? signatures_.of(e.path).result : TypeExprId{}) return result;
  return ofReaders(element);
}

// The common type of the inputs; if their types are unknown, the type of the readers.
TypeExprId BoxTypes::ofOperands(uint32_t element, bool selects, uint32_t depth) {
  const Slice<DiagramPin> pins = graph_.elements[element].pins;
  for (const DiagramPin& pin : tree_.list(pins)) {
    if (pin.direction == PinDirection::Output || isOneOf(names_.string(pin.name.name), {kEnable})) continue;
    if (std::exchange(selects, false) || pin.wires.empty()) continue;
    if (pin.edge != EdgeKind::None) return named("BOOL", pin.name.loc);
    if (const TypeExprId type = ofSource(graph_.sourceOf(pin, 0), depth + 1)) return type;
  }
  return ofReaders(element);
}

TypeExprId BoxTypes::ofReaders(uint32_t element) {
  if (reads_.empty()) {
    for (uint32_t k = 0; k < graph_.elements.size(); ++k)
      for (const DiagramPin& pin : tree_.list(graph_.elements[k].pins))
        for (uint32_t w = 0; w < pin.wires.count; ++w)
          if (const uint32_t source = graph_.sourceOf(pin, w); source != kNone)
            reads_.emplace_back(graph_.sources[source].element, k);
    std::sort(reads_.begin(), reads_.end());
  }
  for (auto at = std::lower_bound(reads_.begin(), reads_.end(), std::pair{element, 0u});
       at != reads_.end() && at->first == element; ++at) {
    const Element& reader = graph_.elements[at->second];
    if (reader.kind == ElementKind::Coil || reader.kind == ElementKind::Contact) return named("BOOL", reader.loc);
    if (reader.kind != ElementKind::Output) continue;
    if (const TypeExprId type = ofExpr(reader.operand, 0)) return type;
  }
  return {};
}

TypeExprId BoxTypes::ofSource(uint32_t source, uint32_t depth) {
  if (source == kNone) return {};
  const Source& s = graph_.sources[source];
  const Element& e = graph_.elements[s.element];
  const NameId pin = s.pin.name;
  switch (e.kind) {
    case ElementKind::Contact:
    case ElementKind::Rail:
    case ElementKind::Coil:
    case ElementKind::Execute: return named("BOOL", e.loc);
    case ElementKind::Input:
    case ElementKind::Output:
    case ElementKind::InOut: return ofExpr(e.operand, 0);
    case ElementKind::Select: {
      const DeclId type = declared(e.name.name);
      return type && tree_.kind(type) == DeclKind::Type ? ofMember(tree_.as<TypeDecl>(type).type, pin, 0)
                                                        : TypeExprId{};
    }
    case ElementKind::Box: break;
    case ElementKind::RightRail:
    case ElementKind::Connector:
    case ElementKind::Continuation:
    case ElementKind::Jump:
    case ElementKind::Label:
    case ElementKind::Return:
    case ElementKind::Compose:
    case ElementKind::Comment: return {};
  }
  if (pin && isOneOf(names_.string(pin), {kEnableOutput})) return named("BOOL", e.loc);
  const DeclId callee = e.path && tree_.kind(e.path) == ExprKind::Name ? declared(e.name.name) : DeclId{};
  const bool pou = callee && tree_.kind(callee) == DeclKind::Pou;
  if (pin && pou)
    if (const TypeExprId type = ofVariable(tree_.as<PouDecl>(callee), pin, 0)) return type;
  if (!e.operand && !e.hidden) {
    const PinSignature* output = pin && e.path ? signatures_.of(e.path).find(names_, pin) : nullptr;
    if (output == nullptr || output->direction != PinDirection::Output) return ofBox(s.element, depth);
    return output->is_bool ? named("BOOL", e.loc) : TypeExprId{};
  }
  const Signature signature = e.operand ? signatures_.of(e.operand) : signatures_.of(e.path);
  const PinSignature* known = pin ? signature.find(names_, pin) : nullptr;
  return known != nullptr && known->is_bool ? named("BOOL", e.loc) : TypeExprId{};
}

// ---- declarations

TypeExprId BoxTypes::ofExpr(ExprId expr, uint32_t depth) {
  if (!expr || depth > kMaxDepth) return {};
  const ExprKind kind = tree_.kind(expr);
  switch (shape(kind)) {
    case ExprShape::Leaf:
      if (kind == ExprKind::Name) return ofName(tree_.as<NameExpr>(expr).name);
      return kind == ExprKind::Literal ? ofLiteral(tree_.as<LiteralExpr>(expr)) : TypeExprId{};
    case ExprShape::Step: return ofStep(expr, depth);
    case ExprShape::Operation:
      if (kind == ExprKind::Unary) return ofExpr(tree_.as<UnaryExpr>(expr).operand, depth + 1);
      return kind == ExprKind::Binary ? ofBinary(tree_.as<BinaryExpr>(expr), depth) : TypeExprId{};
    case ExprShape::Initializer:
    case ExprShape::Inserted: break;
  }
  return {};
}

TypeExprId BoxTypes::ofLiteral(const LiteralExpr& literal) {
  if (literal.prefix) return named(names_.string(literal.prefix), literal.h.loc);
  return literal.literal() == LiteralKind::Bool ? named("BOOL", literal.h.loc) : TypeExprId{};
}

TypeExprId BoxTypes::ofStep(ExprId expr, uint32_t depth) {
  const ExprKind kind = tree_.kind(expr);
  if (kind == ExprKind::Member) {
    const MemberExpr& member = tree_.as<MemberExpr>(expr);
    return ofMember(ofExpr(member.base, depth + 1), member.member, 0);
  }
  if (kind == ExprKind::Index) {
    const TypeExprId base = resolved(ofExpr(tree_.as<IndexExpr>(expr).base, depth + 1));
    const bool array = base && tree_.kind(base) == TypeExprKind::Array;
    return array ? tree_.as<ArrayTypeExpr>(base).element : TypeExprId{};
  }
  const bool bit = kind == ExprKind::BitAccess && tree_.as<BitAccessExpr>(expr).width == 1;
  return bit ? named("BOOL", tree_.loc(expr)) : TypeExprId{};
}

TypeExprId BoxTypes::ofBinary(const BinaryExpr& binary, uint32_t depth) {
  if (compares(static_cast<BinaryOp>(binary.h.op))) return named("BOOL", binary.h.loc);
  const TypeExprId left = ofExpr(binary.left, depth + 1);
  return left ? left : ofExpr(binary.right, depth + 1);
}

TypeExprId BoxTypes::ofName(NameId name) {
  if (const TypeExprId own = ofVariable(pou_, name, 0)) return own;
  const PouDecl* owner = pou_.pou_kind == PouKind::Action || pou_.pou_kind == PouKind::Method ? ownerOf(pou_) : nullptr;
  if (owner != nullptr)
    if (const TypeExprId own = ofVariable(*owner, name, 0)) return own;
  const DeclId global = declared(name);
  return global && tree_.kind(global) == DeclKind::Var ? tree_.as<VarDecl>(global).type : TypeExprId{};
}

TypeExprId BoxTypes::ofMember(TypeExprId type, NameId member, uint32_t depth) {
  type = resolved(type);
  if (!type || depth > kMaxDepth) return {};
  if (tree_.kind(type) == TypeExprKind::Struct) {
    const StructTypeExpr& record = tree_.as<StructTypeExpr>(type);
    const TypeExprId own = ofVariable(record.fields, member);
    return own || !record.base ? own : ofMember(record.base, member, depth + 1);
  }
  if (tree_.kind(type) != TypeExprKind::Named) return {};
  const Slice<Ident> path = tree_.as<NamedTypeExpr>(type).path;
  const DeclId pou = declared(tree_.list(path)[path.count - 1].name);
  return pou && tree_.kind(pou) == DeclKind::Pou ? ofVariable(tree_.as<PouDecl>(pou), member, 0) : TypeExprId{};
}

TypeExprId BoxTypes::ofVariable(const PouDecl& pou, NameId name, uint32_t depth) {
  TypeExprId own;
  forEachSection(tree_, pou, signatures_.madeSections(pou), [&](const SectionDecl& section) {
    if (!own) own = ofVariable(section.vars, name);
  });
  if (own) return own;
  for (uint32_t b = 0; b < pou.bases.count && depth < kMaxDepth; ++b) {
    const TypeExprId base = tree_.list(pou.bases)[b];
    if (!base || tree_.kind(base) != TypeExprKind::Named) continue;
    const Slice<Ident> path = tree_.as<NamedTypeExpr>(base).path;
    const DeclId found = declared(tree_.list(path)[path.count - 1].name);
    if (found && tree_.kind(found) == DeclKind::Pou)
      if (const TypeExprId type = ofVariable(tree_.as<PouDecl>(found), name, depth + 1)) return type;
  }
  return {};
}

TypeExprId BoxTypes::ofVariable(Slice<DeclId> vars, NameId name) {
  for (const DeclId v : tree_.list(vars)) {
    const VarDecl& var = tree_.as<VarDecl>(v);
    for (const Ident& ident : tree_.list(var.names))
      if (names_.same(ident.name, name)) return var.type;
  }
  return {};
}

// Follows the names of TYPE declarations to the type.
TypeExprId BoxTypes::resolved(TypeExprId type) {
  for (uint32_t k = 0; k < kMaxDepth && type && tree_.kind(type) == TypeExprKind::Named; ++k) {
    const Slice<Ident> path = tree_.as<NamedTypeExpr>(type).path;
    const DeclId found = path.empty() ? DeclId{} : declared(tree_.list(path)[path.count - 1].name);
    if (!found || tree_.kind(found) != DeclKind::Type) return type;
    type = tree_.as<TypeDecl>(found).type;
  }
  return type;
}

TypeExprId BoxTypes::named(std::string_view type, Loc loc) {
  const Ident ident{names_.intern(type), loc};
  return TreeBuilder(tree_).namedType({&ident, 1}, loc);
}

DeclId BoxTypes::declared(NameId name) {
  if (declared_.empty()) {
    for (const FileUnit& unit : tree_.files) index(unit.decls);
    std::sort(declared_.begin(), declared_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  const uint32_t key = names_.key(name).index;
  const auto found = std::lower_bound(declared_.begin(), declared_.end(), key,
                                      [](const auto& row, uint32_t wanted) { return row.first < wanted; });
  return found != declared_.end() && found->first == key ? found->second : DeclId{};
}

void BoxTypes::index(Slice<DeclId> decls) {
  const auto add = [&](NameId name, DeclId decl) { declared_.emplace_back(names_.key(name).index, decl); };
  for (const DeclId decl : tree_.list(decls)) {
    const DeclKind kind = tree_.kind(decl);
    if (kind == DeclKind::Namespace) index(tree_.as<NamespaceDecl>(decl).decls);
    if (kind == DeclKind::Type) add(tree_.as<TypeDecl>(decl).name, decl);
    if (kind == DeclKind::Pou) {
      const PouDecl& pou = tree_.as<PouDecl>(decl);
      add(pou.name, decl);
      if (!pou.members.empty()) pous_.push_back(&pou);
    }
    if (kind != DeclKind::Section) continue;
    for (const DeclId var : tree_.list(tree_.as<SectionDecl>(decl).vars))
      for (const Ident& ident : tree_.list(tree_.as<VarDecl>(var).names)) add(ident.name, var);
  }
}

const PouDecl* BoxTypes::ownerOf(const PouDecl& member) {
  declared(member.name);
  for (const PouDecl* pou : pous_)
    for (const DeclId decl : tree_.list(pou->members))
      if (tree_.kind(decl) == DeclKind::Pou && &tree_.as<PouDecl>(decl) == &member) return pou;
  return nullptr;
}

}  // namespace rung::diagram
