#include "frontend/syntax/clone.h"

#include <algorithm>

namespace rung {
namespace {

Slice<ExprId> cloneList(Tree& tree, Slice<ExprId> list) {
  std::vector<ExprId> copies;
  for (uint32_t k = 0; k < list.count; ++k) copies.push_back(clone(tree, tree.list(list)[k]));
  return tree.addList<ExprId>(copies);
}

Slice<Argument> cloneArguments(Tree& tree, Slice<Argument> list) {
  std::vector<Argument> copies(tree.list(list).begin(), tree.list(list).end());
  for (Argument& argument : copies)
    if (argument.value) argument.value = clone(tree, argument.value);
  return tree.addList<Argument>(copies);
}

template <class Test>
bool anyOf(const Tree& tree, Slice<ExprId> list, Test test) {
  return std::any_of(tree.list(list).begin(), tree.list(list).end(), test);
}

}  // namespace

ExprId clone(Tree& tree, ExprId expr) {
  switch (tree.kind(expr)) {
    case ExprKind::Error: return tree.add<ExprId>(ErrorExpr(tree.as<ErrorExpr>(expr)));
    case ExprKind::Literal: return tree.add<ExprId>(LiteralExpr(tree.as<LiteralExpr>(expr)));
    case ExprKind::Name: return tree.add<ExprId>(NameExpr(tree.as<NameExpr>(expr)));
    case ExprKind::TypedName: return tree.add<ExprId>(TypedNameExpr(tree.as<TypedNameExpr>(expr)));
    case ExprKind::This: return tree.add<ExprId>(ThisExpr(tree.as<ThisExpr>(expr)));
    case ExprKind::Super: return tree.add<ExprId>(SuperExpr(tree.as<SuperExpr>(expr)));
    case ExprKind::Address: return tree.add<ExprId>(AddressExpr(tree.as<AddressExpr>(expr)));
    case ExprKind::Member: {
      MemberExpr node = tree.as<MemberExpr>(expr);
      node.base = clone(tree, node.base);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Index: {
      IndexExpr node = tree.as<IndexExpr>(expr);
      node.base = clone(tree, node.base);
      node.indices = cloneList(tree, node.indices);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Deref: {
      DerefExpr node = tree.as<DerefExpr>(expr);
      node.base = clone(tree, node.base);
      return tree.add<ExprId>(node);
    }
    case ExprKind::BitAccess: {
      BitAccessExpr node = tree.as<BitAccessExpr>(expr);
      node.base = clone(tree, node.base);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Unary: {
      UnaryExpr node = tree.as<UnaryExpr>(expr);
      node.operand = clone(tree, node.operand);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Binary: {
      BinaryExpr node = tree.as<BinaryExpr>(expr);
      node.left = clone(tree, node.left);
      node.right = clone(tree, node.right);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Range: {
      RangeExpr node = tree.as<RangeExpr>(expr);
      node.low = clone(tree, node.low);
      node.high = clone(tree, node.high);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Call: {
      CallExpr node = tree.as<CallExpr>(expr);
      node.callee = clone(tree, node.callee);
      node.arguments = cloneArguments(tree, node.arguments);
      return tree.add<ExprId>(node);
    }
    case ExprKind::ArrayInit: {
      ArrayInitExpr node = tree.as<ArrayInitExpr>(expr);
      node.elements = cloneList(tree, node.elements);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Repeat: {
      RepeatExpr node = tree.as<RepeatExpr>(expr);
      node.count = clone(tree, node.count);
      node.elements = cloneList(tree, node.elements);
      return tree.add<ExprId>(node);
    }
    case ExprKind::StructInit: {
      StructInitExpr node = tree.as<StructInitExpr>(expr);
      std::vector<FieldInit> fields(tree.list(node.fields).begin(), tree.list(node.fields).end());
      for (FieldInit& field : fields) field.value = clone(tree, field.value);
      node.fields = tree.addList<FieldInit>(fields);
      return tree.add<ExprId>(node);
    }
    case ExprKind::New: {
      NewExpr node = tree.as<NewExpr>(expr);
      if (node.count) node.count = clone(tree, node.count);
      return tree.add<ExprId>(node);
    }
    case ExprKind::Convert:
    case ExprKind::Bound:
    case ExprKind::AnyValue:
    case ExprKind::AddressOf: break;  // created only by sema, later
  }
  RUNG_INVARIANT(false, "only what a parser made is copied");
  return {};
}

bool isPlainPath(const Tree& tree, ExprId expr) {
  switch (tree.kind(expr)) {
    case ExprKind::Name:
    case ExprKind::TypedName:
    case ExprKind::Literal:
    case ExprKind::This:
    case ExprKind::Super:
    case ExprKind::Address: return true;
    case ExprKind::Member: return isPlainPath(tree, tree.as<MemberExpr>(expr).base);
    case ExprKind::BitAccess: return isPlainPath(tree, tree.as<BitAccessExpr>(expr).base);
    case ExprKind::Deref: return isPlainPath(tree, tree.as<DerefExpr>(expr).base);
    case ExprKind::Index: {
      const IndexExpr& node = tree.as<IndexExpr>(expr);
      return isPlainPath(tree, node.base) &&
             !anyOf(tree, node.indices, [&](ExprId index) { return !isPlainPath(tree, index); });
    }
    case ExprKind::Error:
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Range:
    case ExprKind::Call:
    case ExprKind::ArrayInit:
    case ExprKind::Repeat:
    case ExprKind::StructInit:
    case ExprKind::New:
    case ExprKind::Convert:
    case ExprKind::Bound:
    case ExprKind::AnyValue:
    case ExprKind::AddressOf: break;
  }
  return false;
}

bool hasCall(const Tree& tree, ExprId expr) {
  const auto within = [&](ExprId part) { return hasCall(tree, part); };
  switch (tree.kind(expr)) {
    case ExprKind::Call:
    case ExprKind::New: return true;
    case ExprKind::Member: return within(tree.as<MemberExpr>(expr).base);
    case ExprKind::BitAccess: return within(tree.as<BitAccessExpr>(expr).base);
    case ExprKind::Deref: return within(tree.as<DerefExpr>(expr).base);
    case ExprKind::Unary: return within(tree.as<UnaryExpr>(expr).operand);
    case ExprKind::Binary: return within(tree.as<BinaryExpr>(expr).left) || within(tree.as<BinaryExpr>(expr).right);
    case ExprKind::Range: return within(tree.as<RangeExpr>(expr).low) || within(tree.as<RangeExpr>(expr).high);
    case ExprKind::Index:
      return within(tree.as<IndexExpr>(expr).base) || anyOf(tree, tree.as<IndexExpr>(expr).indices, within);
    case ExprKind::ArrayInit: return anyOf(tree, tree.as<ArrayInitExpr>(expr).elements, within);
    case ExprKind::Repeat: return anyOf(tree, tree.as<RepeatExpr>(expr).elements, within);
    case ExprKind::StructInit: {
      const auto fields = tree.list(tree.as<StructInitExpr>(expr).fields);
      return std::any_of(fields.begin(), fields.end(), [&](const FieldInit& field) { return within(field.value); });
    }
    case ExprKind::Error:
    case ExprKind::Literal:
    case ExprKind::Name:
    case ExprKind::TypedName:
    case ExprKind::This:
    case ExprKind::Super:
    case ExprKind::Address:
    case ExprKind::Convert:
    case ExprKind::Bound:
    case ExprKind::AnyValue:
    case ExprKind::AddressOf: break;
  }
  return false;
}

}  // namespace rung
