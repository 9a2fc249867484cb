// SPDX-License-Identifier: Apache-2.0
#include "frontend/syntax/source_view.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "frontend/syntax/children.h"

namespace rung {
namespace {

struct Part {
  NodeRef node;
  Range range;
};

class Divider {
 public:
  // `deep`: the children are divided too.
  Divider(const Tree& tree, bool deep) : tree_(tree), deep_(deep) {}

  void file(Slice<DeclId> decls, Range whole);
  void node(NodeRef node);

  std::vector<SourcePiece> pieces;

 private:
  void add(NodeRef child, std::vector<Part>& parts) const;
  std::vector<Part> childrenOf(NodeRef node) const;
  void divide(NodeRef node, Range range, std::vector<Part> children);
  void own(NodeRef node, Loc end);

  const Tree& tree_;
  bool deep_;
  Loc done_;  // what is before it belongs to some piece
};

void Divider::add(NodeRef child, std::vector<Part>& parts) const {
  if (child.word == 0) return;
  const Range range = extentOf(tree_, child);
  if (range.begin < range.end) parts.push_back({child, range});
  if (child.category != NodeRef::Category::Decl || tree_.kind(DeclId{child.word}) != DeclKind::Property) return;
  // The second half of a property is a part of the block.
  const PropertyDecl& property = tree_.as<PropertyDecl>(DeclId{child.word});
  for (const DeclId accessor : {property.get, property.set})
    if (accessor && tree_.range(accessor).begin >= range.end) parts.push_back({accessor, tree_.range(accessor)});
}

// Without those that were not written.
std::vector<Part> Divider::childrenOf(NodeRef node) const {
  std::vector<Part> parts;
  withId(node, [&](auto id) { forEachChild(tree_, id, [&](auto child) { add(child, parts); }); });
  return parts;
}

// What is left over up to `end` belongs to the node.
void Divider::own(NodeRef node, Loc end) {
  if (done_ < end) pieces.push_back({{done_, end}, node});
  done_ = std::max(done_, end);
}

// Of nodes that overlap, such as the statements made of a chain, the first has the source.
void Divider::divide(NodeRef node, Range range, std::vector<Part> children) {
  std::stable_sort(children.begin(), children.end(),
                   [](const Part& a, const Part& b) { return a.range.begin < b.range.begin; });
  for (const Part& child : children) {
    if (child.range.begin < done_ || child.range.end > range.end) continue;
    own(node, child.range.begin);
    if (deep_) divide(child.node, child.range, childrenOf(child.node));
    done_ = child.range.end;
  }
  own(node, range.end);
}

void Divider::file(Slice<DeclId> decls, Range whole) {
  std::vector<Part> parts;
  for (const DeclId decl : tree_.list(decls)) add(decl, parts);
  done_ = whole.begin;
  divide({}, whole, std::move(parts));
}

void Divider::node(NodeRef node) {
  const Range range = extentOf(tree_, node);
  done_ = range.begin;
  divide(node, range, childrenOf(node));
}

std::string_view textOf(const Sources& sources, Range range) {
  const FileId file = sources.fileOf(range.begin);
  return sources.sourceText(file).substr(range.begin.offset - sources.begin(file).offset,
                                         range.end.offset - range.begin.offset);
}

}  // namespace

std::vector<SourcePiece> piecesOf(const Tree& tree, const FileUnit& unit, const Sources& sources) {
  const Loc begin = sources.begin(unit.file);
  Divider divider(tree, true);
  divider.file(unit.decls, {begin, {begin.offset + static_cast<uint32_t>(sources.sourceText(unit.file).size())}});
  return std::move(divider.pieces);
}

std::string printSource(const Tree& tree, const FileUnit& unit, const Sources& sources) {
  const std::string_view source = sources.original(unit.file);  // with what conditional pragmas exclude
  const uint32_t base = sources.begin(unit.file).offset;
  std::string out;
  for (const SourcePiece& piece : piecesOf(tree, unit, sources))
    out += source.substr(piece.range.begin.offset - base, piece.range.end.offset - piece.range.begin.offset);
  return out;
}

std::vector<Range> tokensOf(const Tree& tree, const Sources& sources, NodeRef node) {
  Divider divider(tree, false);
  divider.node(node);
  std::vector<Range> tokens;
  for (const SourcePiece& piece : divider.pieces) {
    Scanner scanner(textOf(sources, piece.range));
    for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
      tokens.push_back({{piece.range.begin.offset + static_cast<uint32_t>(unit.begin)},
                        {piece.range.begin.offset + static_cast<uint32_t>(unit.end)}});
  }
  return tokens;
}

}  // namespace rung
