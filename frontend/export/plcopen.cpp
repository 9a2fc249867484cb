// SPDX-License-Identifier: Apache-2.0
// The project, its POUs and their members as TC6; see plcopen.h and exporter.h.
#include "frontend/export/plcopen.h"

#include <algorithm>
#include <deque>

#include "frontend/export/diagnostics.h"
#include "frontend/export/exporter.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/inline_actions.h"
#include "frontend/syntax/st_printer.h"

namespace rung::exporter {

namespace {

std::string_view accessWord(AccessLevel level) {
  switch (level) {
    case AccessLevel::None: break;
    case AccessLevel::Public: return "Public";
    case AccessLevel::Private: return "Private";
    case AccessLevel::Protected: return "Protected";
    case AccessLevel::Internal: return "Internal";
  }
  return {};
}

class PouExport {
 public:
  PouExport(Export& to, const PouDecl& pou) : to_(to), pou_(pou), source_(*to.source) {}

  void run();        // <pou>
  void interface();  // <Interface>

 private:
  void interfaceOf(const PouDecl& pou);
  void extensions(AddData& data);
  void inheritance(AddData& data);
  void modifiers(AccessLevel access, uint8_t modifiers, AddData& data);
  void members(AddData& data);
  void method(const PouDecl& method);
  void property(const PropertyDecl& property);
  void accessor(DeclId accessor, std::string_view element, const PropertyDecl& of);
  void actions();
  std::string header(const PouDecl& pou) const;
  std::string documentationOf(const PouDecl& pou) const;
  size_t endOfHeader(const PouDecl& pou) const;
  size_t beginOf(DeclId member) const;
  std::string sections(const PouDecl& pou) const;
  bool isOwnAction(DeclId member) const;
  static bool hasOwnText(const PouDecl& pou) { return !pou.members.empty(); }
  void ownText(const PouDecl& pou);

  Export& to_;
  const PouDecl& pou_;
  const SourceText& source_;
};

// False for actions that the parser made of transitions: they have a body only.
bool PouExport::isOwnAction(DeclId member) const {
  if (to_.tree.kind(member) != DeclKind::Pou) return false;
  const auto& action = to_.tree.as<PouDecl>(member);
  return action.pou_kind == PouKind::Action &&
         !(action.h.begin == action.body_begin && !action.h.pragmas.count && action.h.end == action.body_end);
}

size_t PouExport::beginOf(DeclId member) const {
  if (to_.tree.kind(member) == DeclKind::Pou) return source_.at(to_.tree.decl(member).begin);
  const auto& property = to_.tree.as<PropertyDecl>(member);
  size_t begin = source_.at(property.h.begin);
  for (const Pragma& pragma : to_.tree.list(property.h.pragmas)) begin = std::min(begin, source_.at(pragma.loc));
  return begin;
}

// The offset after the last section; without sections, the start of the members or the body.
size_t PouExport::endOfHeader(const PouDecl& pou) const {
  size_t last = 0;
  for (const DeclId section : to_.tree.list(pou.sections))
    if (to_.tree.loc(section) != pou_.h.loc) last = std::max(last, source_.at(to_.tree.loc(section)));
  if (last != 0) {
    size_t end = source_.endOfWord(last, "END_VAR");
    for (const auto list : {pou.bases, pou.implements})  // after VAR_GENERIC CONSTANT
      for (const TypeExprId id : to_.tree.list(list))
        end = std::max(end, source_.at(to_.tree.as<NamedTypeExpr>(id).h.end));
    return end;
  }
  size_t end = source_.commentsBefore(source_.at(pou.body_begin), true);
  for (const DeclId member : to_.tree.list(pou.members))
    end = std::min(end, source_.commentsBefore(beginOf(member), true));
  return std::max(end, source_.at(pou.h.loc));
}

// The declaration as written, with the comments above it.
std::string PouExport::header(const PouDecl& pou) const {
  const size_t begin = source_.commentsBefore(source_.at(pou.h.begin)), end = endOfHeader(pou);
  std::string text(source_.cut(begin, end));
  if (pou.cpp_file_begin != pou.cpp_file_end) {  // it goes with the body
    const size_t first = source_.at(pou.cpp_file_begin);
    if (first < end) text.erase(first - begin, source_.at(pou.cpp_file_end) - first);
  }
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.pop_back();
  return text;
}

std::string PouExport::documentationOf(const PouDecl& pou) const {
  const size_t begin = source_.at(pou.h.begin);
  return source_.comments(source_.commentsBefore(begin), begin);
}

std::string PouExport::sections(const PouDecl& pou) const {
  std::string text;
  for (const DeclId id : to_.tree.list(pou.sections)) {
    const auto& section = to_.tree.as<SectionDecl>(id);
    size_t begin = source_.at(section.h.loc);
    if (!source_.wordFollows(begin, "VAR")) continue;  // the implicit input of SET
    const size_t end = source_.endOfWord(begin, "END_VAR");
    for (const Pragma& pragma : to_.tree.list(section.h.pragmas)) begin = std::min(begin, source_.at(pragma.loc));
    text.append(source_.cut(begin, end)).append("\n");
  }
  return text;
}

// <interface>, without the parts that its structure cannot express.
void PouExport::interfaceOf(const PouDecl& pou) {
  to_.xml.open("interface");
  if (pou.result && to_.tree.kind(pou.result) != TypeExprKind::Error && to_.tree.loc(pou.result)) {
    to_.xml.open("returnType");
    exportType(to_, pou.result);
    to_.xml.close();
  }
  for (const DeclId id : to_.tree.list(pou.sections)) {
    const auto& section = to_.tree.as<SectionDecl>(id);
    if (!source_.wordFollows(source_.at(section.h.loc), "VAR")) continue;
    if (section.section == SectionKind::Stat || section.section == SectionKind::Inst) to_.is_lossless = false;
    if (section.section == SectionKind::Access || section.section == SectionKind::Config) {
      to_.is_lossless = false;
      continue;
    }
    exportSection(to_, id, sectionElement(section.section));
    {
      AddData data(to_);
      exportAttributes(to_, section.h.pragmas, data);
    }
    to_.xml.close();
  }
  to_.xml.close();
}

void PouExport::modifiers(AccessLevel access, uint8_t bits, AddData& data) {
  const std::string_view word = accessWord(access);
  if (word.empty() && bits == 0) return;
  data.open("accessmodifiers");
  to_.xml.open("AccessModifiers");
  if (!word.empty()) to_.xml.attribute(word, "true");
  if ((bits & kFinal) != 0) to_.xml.attribute("Final", "true");
  if ((bits & kAbstract) != 0) to_.xml.attribute("Abstract", "true");
  if ((bits & kOverride) != 0) to_.xml.attribute("Override", "true");
  to_.xml.close();
  data.close();
}

void PouExport::inheritance(AddData& data) {
  if (pou_.bases.empty() && pou_.implements.empty()) return;
  data.open("pouinheritance");
  to_.xml.open("Inheritance");
  for (const auto& [list, element] : {std::pair{pou_.bases, "Extends"}, std::pair{pou_.implements, "Implements"}}) {
    for (const TypeExprId id : to_.tree.list(list)) {
      std::string name;
      for (const Ident& part : to_.tree.list(to_.tree.as<NamedTypeExpr>(id).path))
        name += (name.empty() ? "" : ".") + std::string(to_.string(part.name));
      to_.xml.element(element, name);
    }
  }
  to_.xml.close();
  data.close();
}

void PouExport::method(const PouDecl& method) {
  to_.is_lossless = method.usings.empty();
  to_.xml.open("Method").attribute("name", to_.string(method.name));
  interfaceOf(method);
  if (pou_.pou_kind != PouKind::Interface) exportBody(to_, method);
  if (hasOwnText(method)) {
    ownText(method);
  } else {
    AddData data(to_);
    exportAttributes(to_, method.h.pragmas, data);
    modifiers(method.access, method.modifiers, data);
    if (!to_.is_lossless) exportPlainText(to_, header(method), data);
  }
  to_.documentation(documentationOf(method));
  to_.xml.close();
}

// Adds the whole source of an action or method with members, as text that only Rung reads.
//   warns   an ACTION inside of an ACTION whose body is a chart          W1099
void PouExport::ownText(const PouDecl& pou) {
  if (!hasOwnText(pou)) return;
  to_.onlyRung(pou.h.loc, "actions and conditions inside an action or method");
  AddData data(to_);
  exportOwnText(to_, source_.cut(source_.at(pou.h.begin), source_.at(pou.h.end)), data);
}

void PouExport::accessor(DeclId id, std::string_view element, const PropertyDecl& of) {
  if (!id) return;
  const auto& accessor = to_.tree.as<PouDecl>(id);
  to_.is_lossless = true;
  to_.xml.open(element);
  to_.xml.open("interface");
  for (const DeclId s : to_.tree.list(accessor.sections)) {
    const auto& section = to_.tree.as<SectionDecl>(s);
    if (!source_.wordFollows(source_.at(section.h.loc), "VAR")) continue;
    if (section.section == SectionKind::Stat || section.section == SectionKind::Inst) to_.is_lossless = false;
    exportSection(to_, s, sectionElement(section.section));
    to_.xml.close();
  }
  to_.xml.close();
  if (pou_.pou_kind != PouKind::Interface) exportBody(to_, accessor);
  {
    AddData data(to_);
    if (accessor.access != of.access || accessor.modifiers != of.modifiers)
      modifiers(accessor.access, accessor.modifiers, data);
    if (!to_.is_lossless) exportPlainText(to_, sections(accessor), data);
  }
  to_.xml.close();
}

void PouExport::property(const PropertyDecl& property) {
  to_.is_lossless = true;
  const size_t name = source_.at(property.h.loc);
  to_.xml.open("Property").attribute("name", to_.string(property.name));
  to_.xml.open("interface").open("returnType");
  exportType(to_, property.type);
  to_.xml.close();
  to_.xml.close();
  const bool is_lossless = to_.is_lossless;
  accessor(property.get, "GetAccessor", property);
  accessor(property.set, "SetAccessor", property);
  {
    AddData data(to_);
    exportAttributes(to_, property.h.pragmas, data);
    modifiers(property.access, property.modifiers, data);
    if (!is_lossless) {
      size_t end = source_.endOfWord(name, "END_PROPERTY");
      end = source_.wordBefore(end, "END_PROPERTY");
      for (const DeclId id : {property.get, property.set})
        if (id) end = std::min(end, source_.at(to_.tree.decl(id).begin));
      const size_t behind_word = source_.at(property.h.begin) + (property.in_halves ? 12 : 8);
      exportPlainText(to_, "PROPERTY" + std::string(source_.cut(behind_word, end)), data);
    }
  }
  const size_t begin = source_.at(property.h.begin);
  to_.documentation(source_.comments(source_.commentsBefore(begin), begin));
  to_.xml.close();
}

void PouExport::members(AddData& data) {
  for (const DeclId member : to_.tree.list(pou_.members)) {
    if (to_.tree.kind(member) == DeclKind::Property) {
      data.open("property");
      property(to_.tree.as<PropertyDecl>(member));
      data.close();
    } else if (to_.tree.as<PouDecl>(member).pou_kind == PouKind::Method) {
      data.open("method");
      method(to_.tree.as<PouDecl>(member));
      data.close();
    }
  }
}

void PouExport::actions() {
  bool any = false;
  for (const DeclId member : to_.tree.list(pou_.members)) {
    if (!isOwnAction(member) || isInlineAction(to_.tree, to_.names, member)) continue;
    const auto& action = to_.tree.as<PouDecl>(member);
    if (!any) to_.xml.open("actions");
    any = true;
    to_.xml.open("action").attribute("name", to_.string(action.name));
    exportBody(to_, action);
    ownText(action);
    to_.documentation(documentationOf(action));
    to_.xml.close();
  }
  if (any) to_.xml.close();
}

void PouExport::run() {
  to_.is_lossless = pou_.usings.empty();
  for (const TypeExprId base : to_.tree.list(pou_.bases))
    if (!to_.tree.as<NamedTypeExpr>(base).generics.empty()) to_.is_lossless = false;
  to_.xml.open("pou").attribute("name", to_.string(pou_.name));
  to_.xml.attribute("pouType", pou_.pou_kind == PouKind::Function  ? "function"
                               : pou_.pou_kind == PouKind::Program ? "program"
                                                                   : "functionBlock");
  const bool is_class = pou_.pou_kind == PouKind::Class;
  if (is_class) to_.onlyRung(pou_.h.loc, "classes");
  interfaceOf(pou_);
  const bool is_lossless = to_.is_lossless;
  actions();
  exportTransitions(to_, pou_, exportBody);
  if (!is_class) exportBody(to_, pou_);
  {
    AddData data(to_);
    if (is_class) {
      data.openOwn();
      to_.xml.open("kind").attribute("pouType", "class").close();
      data.close();
    }
    to_.is_lossless = is_lossless;
    extensions(data);
  }
  to_.documentation(documentationOf(pou_));
  to_.xml.close();
}

// Writes the parts that TC6 has no elements for.
void PouExport::extensions(AddData& data) {
  exportAttributes(to_, pou_.h.pragmas, data);
  const bool is_lossless = to_.is_lossless;
  inheritance(data);
  modifiers(pou_.access, pou_.modifiers, data);
  members(data);
  if (!is_lossless) exportPlainText(to_, header(pou_), data);
}

void PouExport::interface() {
  to_.is_lossless = pou_.usings.empty();
  to_.xml.open("Interface").attribute("name", to_.string(pou_.name));
  {
    AddData data(to_);
    extensions(data);
  }
  to_.documentation(documentationOf(pou_));
  to_.xml.close();
}

// The declarations of all files, sorted by kind.
class ProjectExport {
 public:
  ProjectExport(Export& to, std::span<const FileUnit> files) : to_(to), files_(files) {
    for (const FileUnit& unit : files) texts_.emplace_back(to.sources, unit.file);
  }
  void run(const std::string& project);

 private:
  template <class Visit>
  void forEach(DeclKind kind, Visit visit) {
    for (size_t i = 0; i < texts_.size(); ++i) {
      const FileUnit& unit = files_[i];
      to_.source = &texts_[i];
      for (const DeclId id : to_.tree.list(unit.decls))
        if (to_.tree.kind(id) == kind) visit(id, unit.file);
    }
  }
  void checkTexts();
  void headers(const std::string& project);
  void globals(AddData& data);
  size_t endOf(DeclId space) const;
  void ownTexts(AddData& data);
  bool sharesWithInner(const PouDecl& pou) const;

  Export& to_;
  std::span<const FileUnit> files_;
  std::deque<SourceText> texts_;
};

// The first byte outside of comments that is not UTF-8. In comments it is Latin-1, of which the writer makes UTF-8.
size_t findInvalidCode(std::string_view text) {
  if (findInvalidUtf8(text) == std::string_view::npos) return text.size();
  Scanner scanner(text);
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    const size_t bad = findInvalidUtf8(scanner.textOf(unit));
    if (bad != std::string_view::npos) return unit.begin + bad;
  }
  return text.size();
}

// Forbids characters that XML cannot contain: bytes that are not UTF-8, and control characters. XML 1.0, 2.2.
void ProjectExport::checkTexts() {
  for (const FileUnit& unit : files_) {
    const std::string_view text = to_.sources.sourceText(unit.file);
    size_t bad = findInvalidCode(text);
    for (size_t p = 0; p < bad; ++p)
      if (static_cast<unsigned char>(text[p]) < ' ' && text[p] != '\t' && text[p] != '\n' && text[p] != '\r') bad = p;
    if (bad == text.size()) continue;
    to_.diagnostics.report(diag::XmlCharacter, {to_.sources.begin(unit.file).offset + static_cast<uint32_t>(bad)})
        .length(1);
  }
}

void ProjectExport::headers(const std::string& project) {
  // Without the current time: equal programs give equal files.
  to_.xml.open("fileHeader")
      .attribute("companyName", "")
      .attribute("productName", "Rung")
      .attribute("productVersion", "1")
      .attribute("creationDateTime", "2000-01-01T00:00:00")
      .close();
  to_.xml.open("contentHeader").attribute("name", project).open("coordinateInfo");
  for (const std::string_view language : {"fbd", "ld", "sfc"}) {
    to_.xml.open(language).open("scaling").attribute("x", "1").attribute("y", "1").close();
    to_.xml.close();
  }
  to_.xml.close();
  to_.xml.close();
}

void ProjectExport::globals(AddData& data) {
  FileId file;
  std::string list;  // {list 'name'} applies to all sections after it
  forEach(DeclKind::Section, [&](DeclId id, FileId of) {
    const auto& section = to_.tree.as<SectionDecl>(id);
    if (file != of) list = listNameOf(to_.sources.path(of));
    file = of;
    for (const Pragma& pragma : to_.tree.list(section.h.pragmas))
      if (sameIdentifier(to_.string(pragma.name), "list") && pragma.value.length != 0)
        list = to_.tree.string(pragma.value);
    to_.is_lossless = section.section == SectionKind::Global;
    data.open("globalvars");
    size_t begin = to_.source->at(section.h.loc);
    const size_t end = to_.source->endOfWord(begin, "END_VAR");
    if (to_.is_lossless) {
      exportSection(to_, id, "globalVars", list);
    } else {
      to_.xml.open("globalVars").attribute("name", list);
    }
    {
      AddData inner(to_);
      exportAttributes(to_, section.h.pragmas, inner);
      for (const Pragma& pragma : to_.tree.list(section.h.pragmas))
        if (to_.string(pragma.name) != "list") begin = std::min(begin, to_.source->at(pragma.loc));
      if (!to_.is_lossless) exportPlainText(to_, to_.source->cut(begin, end), inner);
    }
    to_.documentation(to_.source->comments(to_.source->commentsBefore(begin), begin));
    to_.xml.close();
    data.close();
  });
}

size_t ProjectExport::endOf(DeclId space) const {
  size_t end = to_.source->at(to_.tree.loc(space));
  for (const DeclId inner : to_.tree.list(to_.tree.as<NamespaceDecl>(space).decls))
    if (to_.tree.kind(inner) == DeclKind::Namespace) end = endOf(inner);
  return to_.source->endOfWord(end, "END_NAMESPACE");
}

// Declarations without a TC6 element are written as text that only Rung reads. Forbids a USING that would affect
// another file.
//   warns   NAMESPACE Plant … END_NAMESPACE          W1099
//   fails   USING Plant; in one of two files         E1095
void ProjectExport::ownTexts(AddData& data) {
  forEach(DeclKind::Using, [&](DeclId id, FileId) {
    const Loc loc = to_.tree.loc(id);
    if (files_.size() > 1) return to_.reportInexpressible(loc, "USING for one of several files");
    to_.onlyRung(loc, "USING");
    const size_t begin = to_.source->wordBefore(to_.source->at(loc) + 1, "USING");
    const std::string_view rest = to_.source->cut(begin, std::string_view::npos);
    exportOwnText(to_, rest.substr(0, rest.find(';') + 1), data);
  });
  forEach(DeclKind::Namespace, [&](DeclId id, FileId) {
    const Loc loc = to_.tree.loc(id);
    to_.onlyRung(loc, "namespaces");
    const size_t begin = to_.source->wordBefore(to_.source->at(loc), "NAMESPACE");
    exportOwnText(to_, to_.source->cut(to_.source->commentsBefore(begin), endOf(id)), data);
  });
  forEach(DeclKind::Pou, [&](DeclId id, FileId) {
    const auto& pou = to_.tree.as<PouDecl>(id);
    if (!sharesWithInner(pou)) return;
    to_.onlyRung(pou.h.loc, "actions and conditions inside an action or method");
    const size_t begin = to_.source->at(pou.h.begin);
    exportOwnText(to_, to_.source->cut(to_.source->commentsBefore(begin), to_.source->at(pou.h.end)), data);
  });
}

// Tells whether charts in actions, which are exported as text, may use conditions of the block: then the block is
// exported as text, too.
bool ProjectExport::sharesWithInner(const PouDecl& pou) const {
  const auto members = to_.tree.list(pou.members);
  const bool inner = std::any_of(members.begin(), members.end(), [&](DeclId member) {
    return to_.tree.kind(member) == DeclKind::Pou && !to_.tree.as<PouDecl>(member).members.empty();
  });
  return inner && !pou.transitions.empty();
}

void ProjectExport::run(const std::string& project) {
  checkTexts();
  if (to_.diagnostics.hasErrors()) return;
  to_.xml.open("project")
      .attribute("xmlns", "http://www.plcopen.org/xml/tc6_0201")
      .attribute("xmlns:xhtml", "http://www.w3.org/1999/xhtml");
  headers(project);
  to_.xml.open("types").open("dataTypes");
  forEach(DeclKind::Type, [&](DeclId id, FileId) { exportDataType(to_, id); });
  to_.xml.close();
  to_.xml.open("pous");
  forEach(DeclKind::Pou, [&](DeclId id, FileId) {
    const auto& pou = to_.tree.as<PouDecl>(id);
    if (pou.pou_kind != PouKind::Interface && !sharesWithInner(pou)) PouExport(to_, pou).run();
  });
  to_.xml.close();
  to_.xml.close();
  to_.xml.open("instances").open("configurations");
  forEach(DeclKind::Configuration, [&](DeclId id, FileId) { exportConfiguration(to_, id); });
  to_.xml.close();
  to_.xml.close();
  {
    AddData data(to_);
    ownTexts(data);
    globals(data);
    forEach(DeclKind::Pou, [&](DeclId id, FileId) {
      const auto& pou = to_.tree.as<PouDecl>(id);
      if (pou.pou_kind != PouKind::Interface) return;
      data.open("interface");
      PouExport(to_, pou).interface();
      data.close();
    });
  }
  to_.xml.close();
}

}  // namespace

std::string writeProject(const Program& program, const std::string& project, Diagnostics& diagnostics) {
  Export to{program.tree, program.names, program.sources, diagnostics};
  ProjectExport(to, program.files).run(project);
  return to.xml.out();
}

}  // namespace rung::exporter
