// SPDX-License-Identifier: Apache-2.0
// Makes the nodes of the tree: for the parsers, for the schedulers of IL, charts and networks, and for checked code
// (sema/code.h). In: the parts of a node and its location. Out: its id. The parser notes afterwards where a node ends.
#pragma once

#include <span>
#include <string_view>

#include "frontend/syntax/tree.h"

namespace rung {

class TreeBuilder {
 public:
  // `room`: words to leave in front of each expression, for what its owner keeps beside it.
  explicit TreeBuilder(Tree& tree, uint32_t room = 0) : tree_(tree), room_(room) {}

  // ---- expressions
  ExprId error(Loc loc) { return add(ErrorExpr{header(ExprKind::Error, loc)}); }
  ExprId literal(LiteralKind kind, uint64_t value, Loc loc, NameId prefix = {}, LiteralForm form = {}) {
    LiteralExpr node{header(ExprKind::Literal, loc, static_cast<uint8_t>(kind)), prefix, 0, 0, form};
    node.setValue(value);
    return add(node);
  }
  ExprId text(LiteralKind kind, std::string_view characters, Loc loc, NameId prefix = {}) {
    const StringId string = tree_.addString(characters);
    return add(LiteralExpr{
        header(ExprKind::Literal, loc, static_cast<uint8_t>(kind)), prefix, string.first, string.length, {}});
  }
  ExprId boolean(bool value, Loc loc, NameId prefix = {}) {
    return literal(LiteralKind::Bool, value ? 1u : 0u, loc, prefix);
  }
  ExprId name(NameId name, Loc loc) { return add(NameExpr{header(ExprKind::Name, loc), name}); }
  ExprId name(const Ident& ident) { return name(ident.name, ident.loc); }
  ExprId typedName(const Ident& type, const Ident& item) {
    return add(TypedNameExpr{header(ExprKind::TypedName, type.loc), type, item});
  }
  ExprId member(ExprId base, NameId member, Loc loc) {
    return add(MemberExpr{header(ExprKind::Member, loc), base, member});
  }
  ExprId index(ExprId base, Slice<ExprId> indices, Loc loc) {
    return add(IndexExpr{header(ExprKind::Index, loc), base, indices});
  }
  ExprId deref(ExprId base, Loc loc) { return add(DerefExpr{header(ExprKind::Deref, loc), base}); }
  ExprId bitAccess(ExprId base, uint32_t position, uint8_t width, Loc loc) {
    return add(BitAccessExpr{header(ExprKind::BitAccess, loc), base, position, width});
  }
  ExprId thisObject(Loc loc) { return add(ThisExpr{header(ExprKind::This, loc)}); }
  ExprId superObject(Loc loc) { return add(SuperExpr{header(ExprKind::Super, loc)}); }
  ExprId address(const DirectAddress& address, Loc loc) {
    return add(AddressExpr{header(ExprKind::Address, loc), address});
  }
  ExprId unary(UnaryOp op, ExprId operand, Loc loc) {
    return add(UnaryExpr{header(ExprKind::Unary, loc, static_cast<uint8_t>(op)), operand});
  }
  ExprId binary(BinaryOp op, ExprId left, ExprId right, Loc loc) {
    return add(BinaryExpr{header(ExprKind::Binary, loc, static_cast<uint8_t>(op)), left, right});
  }
  ExprId call(ExprId callee, Slice<Argument> arguments, Loc loc, Loc end, bool is_bare = false) {
    return add(CallExpr{header(ExprKind::Call, loc), callee, arguments, end, is_bare});
  }
  ExprId call(ExprId callee, std::span<const Argument> arguments, Loc loc) {
    return call(callee, tree_.addList<Argument>(arguments), loc, loc);
  }
  ExprId range(ExprId low, ExprId high, Loc loc) { return add(RangeExpr{header(ExprKind::Range, loc), low, high}); }
  ExprId arrayInit(Slice<ExprId> elements, Loc loc) {
    return add(ArrayInitExpr{header(ExprKind::ArrayInit, loc), elements});
  }
  ExprId repeat(ExprId count, Slice<ExprId> elements, Loc loc) {
    return add(RepeatExpr{header(ExprKind::Repeat, loc), count, elements});
  }
  ExprId structInit(std::span<const FieldInit> fields, Loc loc) {
    return add(StructInitExpr{header(ExprKind::StructInit, loc), tree_.addList<FieldInit>(fields)});
  }
  ExprId newObject(TypeExprId allocated, ExprId count, Loc loc) {
    return add(NewExpr{header(ExprKind::New, loc), allocated, count, false});
  }
  ExprId assignment(ExprId target, ExprId value, Loc loc) {
    return add(AssignExpr{header(ExprKind::Assign, loc), target, value});
  }
  // The type in SIZEOF(POINTER TO INT).
  ExprId typeOperand(TypeExprId type, Loc loc) { return add(NewExpr{header(ExprKind::New, loc), type, {}, true}); }
  // ---- expressions of checked programs
  ExprId convert(ExprId operand, Loc loc) { return add(ConvertExpr{header(ExprKind::Convert, loc), operand}); }
  ExprId bound(ExprId array, uint32_t index, Loc loc) {
    return add(BoundExpr{header(ExprKind::Bound, loc), array, index});
  }
  ExprId anyValue(ExprId value, ExprId facts, uint32_t type_class, Loc loc) {
    return add(AnyValueExpr{header(ExprKind::AnyValue, loc), value, facts, type_class});
  }
  ExprId addressOf(ExprId lvalue, Loc loc) { return add(AddressOfExpr{header(ExprKind::AddressOf, loc), lvalue}); }

  // ---- statements
  StmtId errorStatement(Loc loc) { return tree_.add<StmtId>(ErrorStmt{header(StmtKind::Error, loc)}); }
  StmtId empty(Loc loc) { return tree_.add<StmtId>(EmptyStmt{header(StmtKind::Empty, loc)}); }
  StmtId assign(AssignOp op, ExprId target, ExprId value, Loc loc) {
    return tree_.add<StmtId>(AssignStmt{header(StmtKind::Assign, loc, static_cast<uint8_t>(op)), target, value});
  }
  StmtId callStatement(ExprId call) {
    return tree_.add<StmtId>(CallStmt{header(StmtKind::Call, tree_.loc(call)), call});
  }
  StmtId ifStatement(Slice<IfBranch> branches, Slice<StmtId> otherwise, Loc loc, uint8_t op = 0) {
    return tree_.add<StmtId>(IfStmt{header(StmtKind::If, loc, op), branches, otherwise});
  }
  // IF condition THEN body
  StmtId ifStatement(ExprId condition, std::span<const StmtId> body, Loc loc, uint8_t op = 0) {
    const IfBranch branch{condition, tree_.addList<StmtId>(body)};
    return ifStatement(tree_.addList<IfBranch>({&branch, 1}), {}, loc, op);
  }
  StmtId caseStatement(ExprId selector, Slice<CaseBranch> branches, Loc loc) {
    return tree_.add<StmtId>(CaseStmt{header(StmtKind::Case, loc), selector, branches, {}, false});
  }
  // FOR control := from TO to DO body
  StmtId forStatement(ExprId control, ExprId from, ExprId to, Slice<StmtId> body, Loc loc) {
    return tree_.add<StmtId>(ForStmt{header(StmtKind::For, loc), control, from, to, {}, body});
  }
  StmtId whileStatement(ExprId condition, Slice<StmtId> body, Loc loc) {
    return tree_.add<StmtId>(WhileStmt{header(StmtKind::While, loc), condition, body});
  }
  StmtId exit(Loc loc) { return tree_.add<StmtId>(ExitStmt{header(StmtKind::Exit, loc)}); }
  StmtId loopContinue(Loc loc) { return tree_.add<StmtId>(ContinueStmt{header(StmtKind::Continue, loc)}); }
  StmtId returnStatement(Loc loc) { return tree_.add<StmtId>(ReturnStmt{header(StmtKind::Return, loc)}); }
  StmtId jump(const Ident& label, Loc loc) { return tree_.add<StmtId>(JumpStmt{header(StmtKind::Jump, loc), label}); }
  StmtId label(const Ident& label) { return tree_.add<StmtId>(LabelStmt{header(StmtKind::Label, label.loc), label}); }

  // ---- types and declarations
  TypeExprId namedType(std::span<const Ident> path, Loc loc) {
    return tree_.add<TypeExprId>(
        NamedTypeExpr{header(TypeExprKind::Named, loc), tree_.addList<Ident>(path), {}, false, {}, {}});
  }
  TypeExprId errorType(Loc loc) { return tree_.add<TypeExprId>(ErrorTypeExpr{header(TypeExprKind::Error, loc)}); }
  TypeExprId arrayType(std::span<const ArrayBound> bounds, TypeExprId element, Loc loc) {
    return tree_.add<TypeExprId>(
        ArrayTypeExpr{header(TypeExprKind::Array, loc), tree_.addList<ArrayBound>(bounds), element});
  }
  // name : type;  Without a type: a temporary.
  DeclId variable(const Ident& name, TypeExprId type) { return variable({&name, 1}, type, {}); }
  // name, name : type := init;
  DeclId variable(std::span<const Ident> names, TypeExprId type, ExprId init) {
    return tree_.add<DeclId>(VarDecl{header(DeclKind::Var, names.front().loc),
                                     tree_.addList<Ident>(names),
                                     type,
                                     init,
                                     EdgeKind::None,
                                     false,
                                     false,
                                     {},
                                     {}});
  }
  DeclId section(SectionKind kind, std::span<const DeclId> variables, Loc loc,
                 SectionMaker maker = SectionMaker::None) {
    return tree_.add<DeclId>(SectionDecl{
        header(DeclKind::Section, loc), kind, AccessLevel::None, {}, maker, tree_.addList<DeclId>(variables)});
  }

 private:
  template <class Node>
  ExprId add(const Node& node) {
    return room_ != 0 ? tree_.add(node, room_) : tree_.add<ExprId>(node);
  }

  Tree& tree_;
  uint32_t room_;
};

}  // namespace rung
