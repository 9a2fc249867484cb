// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/references.h"

#include <algorithm>

#include "frontend/syntax/children.h"
#include "tools/ide/matching_words.h"
#include "tools/ide/navigation.h"
#include "tools/ide/outer_names.h"

namespace rung::ide {
namespace {

using sema::Access;

// Of several at one place the one that says most.
void sortByPlace(std::vector<Reference>& references) {
  const auto key = [](const Reference& of) { return std::pair(of.at.file.index, of.at.begin); };
  std::stable_sort(references.begin(), references.end(),
                   [&](const Reference& a, const Reference& b) { return key(a) < key(b); });
  size_t count = 0;
  for (const Reference& reference : references) {
    if (count != 0 && key(references[count - 1]) == key(reference)) {
      Reference& known = references[count - 1];
      known.kind = std::max(known.kind, reference.kind);
      known.is_declaration |= reference.is_declaration;
    } else {
      references[count++] = reference;
    }
  }
  references.resize(count);
}

class ReferenceFinder {
 public:
  ReferenceFinder(const View& view, const Family& family, std::string_view written)
      : view_(view), scope_(view.meanings().scope()), project_(scope_.project()), family_(family), written_(written) {
    name_ = view.names().string(family.name());
    name_ = name_.substr(name_.rfind('.') + 1);
  }

  std::vector<Reference> find() {
    for (const Entity entity : family_.members()) add(scope_.locOf(entity), kindOfDeclaration(entity), true);
    add(project_.mentions);
    for (const sema::Pou& pou : project_.pous) add(pou.body.mentions);
    addUnchecked();
    sortByPlace(references_);
    return std::move(references_);
  }

  bool isComplete() const { return is_complete_; }

 private:
  void add(const std::vector<sema::Mention>& mentions) {
    for (const sema::Mention& mention : mentions)
      if (family_.has(mention.entity)) add(mention.loc, kindOf(mention), false);
  }

  // Code that was made from a name has its location too, but names something else.
  void add(Loc loc, ReferenceKind kind, bool is_declaration) {
    const FileRange at = view_.nameInFile(loc);
    if (!at) return;
    const std::string_view text = view_.textOf(at.file).substr(at.begin, at.end - at.begin);
    if (!sameIdentifier(text, name_) && !sameIdentifier(text, written_)) {
      is_complete_ = false;
      return;
    }
    if (!view_.pathOf(at.file).empty()) references_.push_back({at, kind, is_declaration});
  }

  ReferenceKind kindOfDeclaration(Entity entity) const {
    const bool has_value = entity.entityKind() == EntityKind::Var && project_.vars[entity.index].init;
    return has_value ? ReferenceKind::Write : ReferenceKind::Name;
  }

  ReferenceKind kindOf(const sema::Mention& mention) const {
    const EntityKind kind = mention.entity.entityKind();
    if (mention.access == Access::Qualifier || kind == EntityKind::Pou) return ReferenceKind::Name;
    if (mention.access == Access::Call) return ReferenceKind::Read;
    const bool is_output =
        kind == EntityKind::Var && project_.vars[mention.entity.index].section == SectionKind::Output;
    if (mention.access == Access::Pin) return is_output ? ReferenceKind::Read : ReferenceKind::Write;
    return sema::writesValue(mention.access) ? ReferenceKind::Write : ReferenceKind::Read;
  }

  // What the check does not record: names in files with errors, and those that charts and networks have beside the
  // statements that are made of them.
  void addUnchecked() {
    std::vector<bool> has_errors(view_.sources().fileCount() + 1);
    for (const Diagnostic& diagnostic : view_.snapshot().diagnostics())
      if (diagnostic.severity == Severity::Error)
        has_errors[view_.sources().fileOf(view_.sources().current(diagnostic.loc)).index] = true;
    for (const FileUnit& unit : view_.tree().files) {
      if (!has_errors[unit.file.index] && !isDrawn(unit.decls)) continue;
      for (const NamePlace& place : view_.meanings().of(unit))
        if (family_.has(place.entity)) add(place.loc, ReferenceKind::Name, place.is_declaration);
    }
  }

  bool isDrawn(Slice<DeclId> decls) const {
    const Tree& tree = view_.tree();
    const std::span<const DeclId> list = tree.list(decls);
    return std::any_of(list.begin(), list.end(), [&](DeclId id) {
      if (tree.kind(id) == DeclKind::Namespace) return isDrawn(tree.as<NamespaceDecl>(id).decls);
      if (tree.kind(id) != DeclKind::Pou) return false;
      const PouDecl& pou = tree.as<PouDecl>(id);
      return !pou.steps.empty() || !pou.diagram.elements.empty() || isDrawn(pou.members);
    });
  }

  const View& view_;
  const Scope& scope_;
  const sema::Project& project_;
  const Family& family_;
  std::string_view name_, written_;
  bool is_complete_ = true;
  std::vector<Reference> references_;
};

// The labels and jumps of a body.
class Labels {
 public:
  Labels(const View& view, const sema::Pou& pou) : view_(view), tree_(view.tree()) {
    for (const StmtId stmt : tree_.list(pou.body.statements)) visit(stmt);
  }

  std::vector<Reference> at(Loc at) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const Label& label) {
      const FileRange range = view_.nameInFile(label.name.loc);
      const Loc begin = view_.sources().current(label.name.loc);
      return begin <= at && at.offset <= begin.offset + (range.end - range.begin);
    });
    std::vector<Reference> result;
    if (found == all_.end()) return result;
    for (const Label& label : all_)
      if (view_.names().same(label.name.name, found->name.name))
        if (const FileRange range = view_.nameInFile(label.name.loc))
          result.push_back({range, ReferenceKind::Name, label.is_declaration});
    sortByPlace(result);
    return result;
  }

 private:
  struct Label {
    Ident name;
    bool is_declaration;
  };
  void visit(StmtId id) {
    if (tree_.kind(id) == StmtKind::Label) all_.push_back({tree_.as<LabelStmt>(id).label, true});
    if (tree_.kind(id) == StmtKind::Jump) all_.push_back({tree_.as<JumpStmt>(id).label, false});
    forEachChild(tree_, id, [&](const auto& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, StmtId>) visit(child);
    });
  }

  const View& view_;
  const Tree& tree_;
  std::vector<Label> all_;
};

}  // namespace

std::vector<Reference> referencesTo(const View& view, const Family& family, std::string_view written,
                                    bool* is_complete) {
  if (family.members().empty()) return {};
  ReferenceFinder finder(view, family, written);
  std::vector<Reference> references = finder.find();
  if (is_complete != nullptr) *is_complete = finder.isComplete();
  return references;
}

std::vector<Reference> labelsAt(const View& view, Loc at) {
  const PouId pou = at ? view.meanings().pouAt(at) : PouId{};
  if (!pou) return {};
  return Labels(view, view.meanings().scope().project().pou(pou)).at(at);
}

std::vector<Reference> referencesAt(const View& view, FileId file, uint32_t byte) {
  if (view.snapshot().project() == nullptr) return {};
  if (std::optional<OuterName> name = outerNameAt(view, file, byte)) return std::move(name->references);
  if (const std::optional<NamePlace> place = nameAt(view, file, byte)) {
    const FileRange at = view.nameInFile(place->loc);
    const std::string_view written = view.textOf(at.file).substr(at.begin, at.end - at.begin);
    return referencesTo(view, Family(view.meanings().scope(), place->entity), written);
  }
  return labelsAt(view, view.parsedAt(file, byte));
}

std::vector<Reference> highlightsAt(const View& view, FileId file, uint32_t byte) {
  std::vector<Reference> references = referencesAt(view, file, byte);
  std::erase_if(references, [&](const Reference& reference) { return reference.at.file != file; });
  if (!references.empty()) return references;
  for (const FileRange& word : matchingWords(view, file, byte)) references.push_back({word});
  return references;
}

}  // namespace rung::ide
