// SPDX-License-Identifier: Apache-2.0
// The parts of a file: see declaration_files.h.
#include "tools/driver/declaration_files.h"

#include <algorithm>

#include "frontend/source/scanner.h"

namespace rung::driver {
namespace {

// The first word of a pragma, in upper case: IF of `{IF defined (x)}`.
std::string pragmaWord(std::string_view pragma) {
  size_t begin = 1;
  while (begin < pragma.size() && isBlankCharacter(pragma[begin])) ++begin;
  size_t end = begin;
  while (end < pragma.size() && isNameCharacter(pragma[end])) ++end;
  return upper(pragma.substr(begin, end - begin));
}

bool isAboutWhatFollows(const std::string& word) {
  constexpr std::string_view kWords[] = {"IF",       "ELSIF",   "ELSE",   "END_IF",   "DEFINE",
                                         "UNDEFINE", "WARNING", "REGION", "ENDREGION"};
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

class Splitter {
 public:
  Splitter(const Tree& tree, const Names& names, const Sources& sources, const FileUnit& unit,
           const std::string& list_of_file)
      : tree_(tree),
        names_(names),
        unit_(unit),
        text_(sources.original(unit.file)),
        base_(sources.begin(unit.file).offset),
        list_(list_of_file) {}

  std::vector<FilePart> parts();

 private:
  std::string nameOf(DeclId id);
  std::string string(NameId name) const { return std::string(names_.string(name)); }
  size_t endOf(DeclId id) const;
  bool isAboutAll(size_t begin, size_t end) const;

  const Tree& tree_;
  const Names& names_;
  const FileUnit& unit_;
  std::string_view text_;
  uint32_t base_;
  std::string list_;
};

std::string Splitter::nameOf(DeclId id) {
  switch (tree_.kind(id)) {
    case DeclKind::Type: return string(tree_.as<TypeDecl>(id).name);
    case DeclKind::Pou: return string(tree_.as<PouDecl>(id).name);
    case DeclKind::Configuration: return string(tree_.as<ConfigurationDecl>(id).name);
    case DeclKind::Namespace: {
      std::string path;
      for (const Ident& part : tree_.list(tree_.as<NamespaceDecl>(id).path))
        path += (path.empty() ? "" : ".") + string(part.name);
      return path;
    }
    case DeclKind::Section:
      for (const Pragma& pragma : tree_.list(tree_.as<SectionDecl>(id).h.pragmas))
        if (upper(names_.string(pragma.name)) == "LIST") list_ = tree_.string(pragma.value);
      return list_;
    case DeclKind::Using:
    case DeclKind::Property:
    case DeclKind::Var:
    case DeclKind::Resource:
    case DeclKind::Task:
    case DeclKind::ProgramInstance: return {};
  }
  return {};
}

// After the declaration, what closes it, and the comment beside it. 0: the TYPE block goes on.
size_t Splitter::endOf(DeclId id) const {
  size_t end = tree_.decl(id).end.offset - base_;
  if (tree_.kind(id) == DeclKind::Pou)
    for (const DeclId member :
         tree_.list(tree_.as<PouDecl>(id).members))  // exports write them after END_FUNCTION_BLOCK
      end = std::max<size_t>(end, tree_.decl(member).end.offset - base_);
  Scanner scanner(text_);
  scanner.moveTo(end);
  if (tree_.kind(id) == DeclKind::Type) {
    Unit unit = scanner.nextCode();
    while (scanner.textOf(unit) == ";") unit = scanner.nextCode();
    if (upper(scanner.textOf(unit)) != "END_TYPE") return 0;
    end = unit.end;
    scanner.moveTo(end);
  }
  while (end < text_.size()) {
    const Unit unit = scanner.next();
    if (text_.substr(end, unit.begin - end).find('\n') != std::string_view::npos) break;
    if (unit.kind != UnitKind::Comment && scanner.textOf(unit) != ";") return end;
    end = unit.end;
  }
  return std::min(text_.find('\n', end), text_.size() - 1) + 1;
}

bool Splitter::isAboutAll(size_t begin, size_t end) const {
  Scanner scanner(text_.substr(0, end));
  scanner.moveTo(begin);
  for (Unit unit = scanner.next(); unit.kind != UnitKind::End; unit = scanner.next())
    if (unit.kind == UnitKind::Pragma && isAboutWhatFollows(pragmaWord(scanner.textOf(unit)))) return true;
  return false;
}

std::vector<FilePart> Splitter::parts() {
  std::vector<FilePart> parts;
  size_t done = 0;  // up to here the text belongs to a part
  std::string name;
  for (const DeclId id : tree_.list(unit_.decls)) {
    const std::string own = nameOf(id);
    if (own.empty()) return {};
    if (name.empty()) name = own;
    if (isAboutAll(done, tree_.decl(id).loc.offset - base_)) return {};
    const size_t end = endOf(id);
    if (end == 0) continue;
    parts.push_back({std::move(name), {base_ + static_cast<uint32_t>(done)}, {base_ + static_cast<uint32_t>(end)}});
    name.clear();
    done = end;
  }
  if (parts.empty() || !name.empty() || isAboutAll(done, text_.size())) return {};
  parts.back().end = {base_ + static_cast<uint32_t>(text_.size())};
  return parts;
}

}  // namespace

std::vector<FilePart> declarationFiles(const Tree& tree, const Names& names, const Sources& sources,
                                       const FileUnit& unit, const std::string& list_of_file) {
  return Splitter(tree, names, sources, unit, list_of_file).parts();
}

}  // namespace rung::driver
