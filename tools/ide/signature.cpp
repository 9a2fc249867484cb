// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/signature.h"

#include "frontend/parse/parse.h"
#include "frontend/syntax/keywords.h"
#include "tools/ide/meanings.h"
#include "tools/ide/source_text.h"

namespace rung::ide {
namespace {

// A declaration in its tree: that of a project, or one that was only parsed for this.
struct Parsed {
  const Tree& tree;
  const Sources& sources;
  const Names& names;

  std::string text(NameId name) const { return std::string(names.string(name)); }
  std::string text(Range range) const { return sourceOnOneLine(sources, range); }
  std::string text(TypeExprId type) const { return type ? text(tree.range(type)) : std::string(); }
};

void addPins(const Parsed& in, const PouDecl& pou, PouSignature& signature) {
  for (const DeclId id : in.tree.list(pou.sections)) {
    const SectionDecl& section = in.tree.as<SectionDecl>(id);
    const bool has_pins = section.section == SectionKind::Input || section.section == SectionKind::Output ||
                          section.section == SectionKind::InOut;
    if (!has_pins || section.maker == SectionMaker::Networks) continue;
    for (const DeclId var_id : in.tree.list(section.vars)) {
      const VarDecl& var = in.tree.as<VarDecl>(var_id);
      for (const Ident& name : in.tree.list(var.names))
        signature.pins.push_back({in.text(name.name), in.text(var.type),
                                  var.init ? in.text(in.tree.range(var.init)) : std::string(),
                                  documentationOf(in.sources, var.h), section.section});
    }
  }
}

std::string list(const Parsed& in, const char* word, Slice<TypeExprId> types) {
  std::string out;
  for (const TypeExprId type : in.tree.list(types)) out += (out.empty() ? word : ", ") + in.text(type);
  return out;
}

PouSignature heading(const Parsed& in, const PouDecl& pou) {
  PouSignature signature;
  signature.kind = pou.pou_kind;
  signature.name = in.text(pou.name);
  signature.result = in.text(pou.result);
  signature.relations = list(in, " EXTENDS ", pou.bases) + list(in, " IMPLEMENTS ", pou.implements);
  signature.documentation = documentationOf(in.sources, pou.h);
  return signature;
}

}  // namespace

std::string PouSignature::declaration() const {
  std::string out = std::string(keywordOf(kind)) + " " + name + relations;
  if (!result.empty()) out += " : " + result;
  const char* section = nullptr;
  for (const SignaturePin& pin : pins) {
    if (section != keywordOf(pin.section)) {
      if (section != nullptr) out += "\nEND_VAR";
      section = keywordOf(pin.section);
      out += std::string("\n") + section;
    }
    out += "\n  " + pin.name + " : " + pin.type;
    if (!pin.initial.empty()) out += " := " + pin.initial;
    out += ";";
    if (!pin.documentation.empty()) out += "  /// " + pin.documentation.substr(0, pin.documentation.find('\n'));
  }
  return section == nullptr ? out : out + "\nEND_VAR";
}

PouSignature signatureOf(const View& view, PouId pou) {
  const sema::Project& project = *view.snapshot().project();
  const Parsed in{view.tree(), view.sources(), view.names()};
  PouSignature signature;
  const sema::Pou& of = project.pou(pou);
  signature.kind = of.kind;
  signature.name = in.text(of.name);
  if (of.decl && in.tree.kind(of.decl) == DeclKind::Pou) {
    signature = heading(in, in.tree.as<PouDecl>(of.decl));
    signature.name = in.text(of.name);
  }
  std::vector<PouId> line;
  for (PouId at = pou; at && line.size() < 100; at = project.pou(at).base) line.push_back(at);
  for (auto at = line.rbegin(); at != line.rend(); ++at) {
    const DeclId decl = project.pou(*at).decl;
    if (decl && in.tree.kind(decl) == DeclKind::Pou) addPins(in, in.tree.as<PouDecl>(decl), signature);
  }
  return signature;
}

std::optional<PouSignature> signatureOf(const LibraryName& name) {
  Sources sources;
  Names names;
  Tree tree;
  Diagnostics unused(sources);
  const FileId file = sources.add(std::string(name.library), std::string(name.source));
  const uint32_t base = sources.begin(file).offset;
  const Slice<DeclId> decls =
      text::parseDeclarations(tree, names, sources, {base + name.begin}, {base + name.end}, Dialect::Library, unused);
  const Parsed in{tree, sources, names};
  for (const DeclId decl : tree.list(decls)) {
    if (tree.kind(decl) != DeclKind::Pou || !sameIdentifier(in.text(tree.as<PouDecl>(decl).name), name.name)) continue;
    PouSignature signature = heading(in, tree.as<PouDecl>(decl));
    addPins(in, tree.as<PouDecl>(decl), signature);
    return signature;
  }
  return std::nullopt;
}

}  // namespace rung::ide
