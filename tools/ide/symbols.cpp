// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/symbols.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "frontend/syntax/node_at.h"
#include "frontend/syntax/sfc.h"
#include "tools/ide/source_text.h"

namespace rung::ide {

SymbolKind symbolKindOf(PouKind kind) {
  switch (kind) {
    case PouKind::Function: return SymbolKind::Function;
    case PouKind::FunctionBlock: return SymbolKind::FunctionBlock;
    case PouKind::Program: return SymbolKind::Program;
    case PouKind::Class: return SymbolKind::Class;
    case PouKind::Interface: return SymbolKind::Interface;
    case PouKind::Method: return SymbolKind::Method;
    case PouKind::Action: return SymbolKind::Action;
  }
  return SymbolKind::Program;
}

namespace {

SymbolKind kindOf(TypeExprKind kind) {
  if (kind == TypeExprKind::Enum) return SymbolKind::Enumeration;
  return kind == TypeExprKind::Struct ? SymbolKind::Structure : SymbolKind::Type;
}

// Makes the outline of one file.
class Outline {
 public:
  Outline(const View& view, FileId file) : view_(view), tree_(view.tree()), file_(file) {}

  std::vector<Symbol> of(const FileUnit& unit) { return of(unit.decls); }

 private:
  using Symbols = std::vector<Symbol>;

  Symbols of(Slice<DeclId> decls) {
    Symbols symbols;
    for (const DeclId decl : tree_.list(decls)) add(decl, symbols);
    return symbols;
  }
  void append(Symbols& to, Symbols symbols) {
    to.insert(to.end(), std::make_move_iterator(symbols.begin()), std::make_move_iterator(symbols.end()));
  }

  // A declaration of which only a part is in the file is left out, and its children take its place.
  void add(Symbols& symbols, std::string name, std::string detail, SymbolKind kind, Range range, Loc name_loc,
           Symbols children = {}) {
    Symbol symbol{std::move(name), std::move(detail), kind, view_.inFile(range), view_.tokenInFile(name_loc), {}};
    if (symbol.range.file != file_ || symbol.name_range.file != file_ || symbol.name.empty())
      return append(symbols, std::move(children));
    symbol.range.begin = std::min(symbol.range.begin, symbol.name_range.begin);
    symbol.range.end = std::max(symbol.range.end, symbol.name_range.end);
    for (const Symbol& child : children) symbol.range.end = std::max(symbol.range.end, child.range.end);
    symbol.children = std::move(children);
    symbols.push_back(std::move(symbol));
  }
  std::string text(NameId name) const { return std::string(view_.names().string(name)); }
  std::string text(TypeExprId type) const {
    return type ? sourceOnOneLine(view_.sources(), tree_.range(type)) : std::string();
  }

  void add(DeclId id, Symbols& symbols) {
    const Range range = extentOf(tree_, id);
    const Loc loc = tree_.loc(id);
    switch (tree_.kind(id)) {
      case DeclKind::Pou: return addPou(tree_.as<PouDecl>(id), range, symbols);
      case DeclKind::Type: return addType(tree_.as<TypeDecl>(id), range, symbols);
      case DeclKind::Section: return append(symbols, section(tree_.as<SectionDecl>(id)));
      case DeclKind::Var: return addVar(tree_.as<VarDecl>(id), SymbolKind::Variable, symbols);
      case DeclKind::Property: return addProperty(tree_.as<PropertyDecl>(id), range, symbols);
      case DeclKind::Namespace: {
        const NamespaceDecl& space = tree_.as<NamespaceDecl>(id);
        std::string name;
        for (const Ident& part : tree_.list(space.path)) name += (name.empty() ? "" : ".") + text(part.name);
        return add(symbols, name, {}, SymbolKind::Namespace, range, loc, of(space.decls));
      }
      case DeclKind::Configuration: {
        const ConfigurationDecl& configuration = tree_.as<ConfigurationDecl>(id);
        return add(symbols, text(configuration.name), {}, SymbolKind::Configuration, range, loc,
                   of(configuration.members));
      }
      case DeclKind::Resource: {
        const ResourceDecl& resource = tree_.as<ResourceDecl>(id);
        return add(symbols, text(resource.name), text(resource.target), SymbolKind::Resource, range, loc,
                   of(resource.members));
      }
      case DeclKind::Task: return add(symbols, text(tree_.as<TaskDecl>(id).name), {}, SymbolKind::Task, range, loc);
      case DeclKind::ProgramInstance: {
        const ProgramInstanceDecl& instance = tree_.as<ProgramInstanceDecl>(id);
        const auto type = tree_.list(instance.type);
        return add(symbols, text(instance.name), type.empty() ? std::string() : text(type.back().name),
                   SymbolKind::Variable, range, loc);
      }
      case DeclKind::Using: return;
    }
  }

  void addPou(const PouDecl& pou, Range range, Symbols& symbols) {
    Symbols children;
    for (const DeclId id : tree_.list(pou.sections)) append(children, section(tree_.as<SectionDecl>(id)));
    append(children, of(pou.members));
    for (const SfcStep& step : tree_.list(pou.steps))
      add(children, text(step.name.name), {}, SymbolKind::Step, {step.name.loc, {}}, step.name.loc);
    for (const SfcTransition& transition : tree_.list(pou.transitions))
      add(children, text(transition.name.name), {}, SymbolKind::Transition, {transition.begin, transition.end},
          transition.name.loc);
    add(symbols, text(pou.name), text(pou.result), symbolKindOf(pou.pou_kind), range, pou.h.loc, std::move(children));
  }

  void addType(const TypeDecl& type, Range range, Symbols& symbols) {
    Symbols children;
    const TypeExprKind kind = tree_.kind(type.type);
    if (kind == TypeExprKind::Struct)
      for (const DeclId field : tree_.list(tree_.as<StructTypeExpr>(type.type).fields))
        addVar(tree_.as<VarDecl>(field), SymbolKind::Field, children);
    if (kind == TypeExprKind::Enum)
      for (const EnumItem& item : tree_.list(tree_.as<EnumTypeExpr>(type.type).items))
        add(children, text(item.item.name), {}, SymbolKind::Item, {item.item.loc, {}}, item.item.loc);
    const std::string detail = children.empty() ? text(type.type) : std::string();
    add(symbols, text(type.name), detail, kindOf(kind), range, type.h.loc, std::move(children));
  }

  void addProperty(const PropertyDecl& property, Range range, Symbols& symbols) {
    add(symbols, text(property.name), text(property.type), SymbolKind::Property, range, property.h.loc);
  }

  Symbols section(const SectionDecl& section) {
    Symbols symbols;
    const SymbolKind kind = section.qualifiers.constant ? SymbolKind::Constant : SymbolKind::Variable;
    if (section.maker == SectionMaker::None)
      for (const DeclId var : tree_.list(section.vars)) addVar(tree_.as<VarDecl>(var), kind, symbols);
    return symbols;
  }

  // `a, b : INT;` are two symbols, each with the range of its name.
  void addVar(const VarDecl& var, SymbolKind kind, Symbols& symbols) {
    const auto names = tree_.list(var.names);
    const std::string type = text(var.type);
    for (const Ident& name : names) {
      const bool is_only = names.size() == 1;
      add(symbols, text(name.name), type, kind, is_only ? Range{var.h.begin, var.h.end} : Range{name.loc, {}},
          name.loc);
    }
  }

  const View& view_;
  const Tree& tree_;
  FileId file_;
};

// ---- matching

bool isUpperCase(char c) { return c >= 'A' && c <= 'Z'; }
bool isLetterBefore(std::string_view name, size_t at) { return at > 0 && name[at - 1] != '_' && name[at - 1] != '.'; }

// The first letter, one after `_`, or a capital after a small letter.
bool beginsWord(std::string_view name, size_t at) {
  return !isLetterBefore(name, at) || (isUpperCase(name[at]) && !isUpperCase(name[at - 1]));
}

// Finds what matches in all files, and makes symbols of these names only.
class Finder {
 public:
  Finder(const View& view, std::string_view query) : view_(view), tree_(view.tree()), query_(query) {}

  std::vector<FoundSymbol> find() {
    for (const FileUnit& unit : tree_.files)
      for (const DeclId decl : tree_.list(unit.decls)) visit(decl, {});
    return std::move(found_);
  }

 private:
  std::string_view text(NameId name) const { return view_.names().string(name); }

  void consider(NameId name, Loc loc, SymbolKind kind, const std::string& container) {
    const int score = name ? matchScore(text(name), query_) : 0;
    if (score <= 0) return;
    const FileRange at = view_.tokenInFile(loc);
    if (at && !view_.pathOf(at.file).empty())
      found_.push_back({{std::string(text(name)), {}, kind, at, at, {}}, container, score});
  }

  void all(Slice<DeclId> decls, const std::string& container) {
    for (const DeclId decl : tree_.list(decls)) visit(decl, container);
  }

  void visit(DeclId id, const std::string& container) {
    const Loc loc = tree_.loc(id);
    switch (tree_.kind(id)) {
      case DeclKind::Pou: {
        const PouDecl& pou = tree_.as<PouDecl>(id);
        consider(pou.name, loc, symbolKindOf(pou.pou_kind), container);
        return all(pou.members, std::string(text(pou.name)));
      }
      case DeclKind::Type: return type(tree_.as<TypeDecl>(id), container);
      case DeclKind::Section: return section(tree_.as<SectionDecl>(id), container);
      case DeclKind::Property: return consider(tree_.as<PropertyDecl>(id).name, loc, SymbolKind::Property, container);
      case DeclKind::Namespace: return all(tree_.as<NamespaceDecl>(id).decls, container);
      case DeclKind::Configuration: {
        const ConfigurationDecl& configuration = tree_.as<ConfigurationDecl>(id);
        consider(configuration.name, loc, SymbolKind::Configuration, container);
        return all(configuration.members, std::string(text(configuration.name)));
      }
      case DeclKind::Resource: {
        const ResourceDecl& resource = tree_.as<ResourceDecl>(id);
        consider(resource.name, loc, SymbolKind::Resource, container);
        return all(resource.members, std::string(text(resource.name)));
      }
      case DeclKind::Task: return consider(tree_.as<TaskDecl>(id).name, loc, SymbolKind::Task, container);
      case DeclKind::ProgramInstance:
        return consider(tree_.as<ProgramInstanceDecl>(id).name, loc, SymbolKind::Variable, container);
      case DeclKind::Var:
      case DeclKind::Using: return;
    }
  }

  void type(const TypeDecl& type, const std::string& container) {
    const TypeExprKind kind = tree_.kind(type.type);
    consider(type.name, type.h.loc, kindOf(kind), container);
    const std::string name(text(type.name));
    if (kind == TypeExprKind::Struct)
      for (const DeclId field : tree_.list(tree_.as<StructTypeExpr>(type.type).fields))
        variables(tree_.as<VarDecl>(field), SymbolKind::Field, name);
    if (kind == TypeExprKind::Enum)
      for (const EnumItem& item : tree_.list(tree_.as<EnumTypeExpr>(type.type).items))
        consider(item.item.name, item.item.loc, SymbolKind::Item, name);
  }

  void section(const SectionDecl& section, const std::string& container) {
    const SymbolKind kind = section.qualifiers.constant ? SymbolKind::Constant : SymbolKind::Variable;
    for (const DeclId var : tree_.list(section.vars)) variables(tree_.as<VarDecl>(var), kind, container);
  }
  void variables(const VarDecl& var, SymbolKind kind, const std::string& container) {
    for (const Ident& name : tree_.list(var.names)) consider(name.name, name.loc, kind, container);
  }

  const View& view_;
  const Tree& tree_;
  std::string_view query_;
  std::vector<FoundSymbol> found_;
};

}  // namespace

int matchScore(std::string_view name, std::string_view query) {
  if (query.size() > name.size()) return 0;
  int score = 1000 + (sameIdentifier(name, query) ? 500 : 0) -
              static_cast<int>(std::min<size_t>(name.size(), 200));  // short names first
  size_t at = 0, last = std::string_view::npos;
  for (const char letter : query) {
    // The next beginning of a word with this letter is better than a letter before it.
    size_t any = std::string_view::npos, chosen = std::string_view::npos;
    for (size_t i = at; i < name.size() && chosen == std::string_view::npos; ++i) {
      if (foldedCharacter(name[i]) != foldedCharacter(letter)) continue;
      if (any == std::string_view::npos) any = i;
      if (beginsWord(name, i) || i == last + 1) chosen = i;
    }
    if (chosen == std::string_view::npos) chosen = any;
    if (chosen == std::string_view::npos) return 0;
    if (chosen == 0) score += 100;
    if (beginsWord(name, chosen)) score += 50;
    if (chosen > 0 && chosen == last + 1) score += 60;
    last = chosen;
    at = chosen + 1;
  }
  return score;
}

std::vector<Symbol> symbolsOf(const View& view, FileId file) {
  std::vector<Symbol> symbols;
  for (const FileUnit* unit : view.unitsOf(file)) {
    std::vector<Symbol> of_unit = Outline(view, file).of(*unit);
    symbols.insert(symbols.end(), std::make_move_iterator(of_unit.begin()), std::make_move_iterator(of_unit.end()));
  }
  std::stable_sort(symbols.begin(), symbols.end(),
                   [](const Symbol& a, const Symbol& b) { return a.range.begin < b.range.begin; });
  return symbols;
}

std::vector<FoundSymbol> symbolsMatching(const View& view, std::string_view query, size_t most) {
  std::vector<FoundSymbol> found = Finder(view, query).find();
  std::stable_sort(found.begin(), found.end(), [](const FoundSymbol& a, const FoundSymbol& b) {
    return a.score != b.score ? a.score > b.score : a.symbol.name < b.symbol.name;
  });
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace rung::ide
