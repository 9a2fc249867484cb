// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/edited_file.h"

#include <algorithm>
#include <utility>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parse.h"
#include "frontend/source/names.h"
#include "frontend/syntax/node_at.h"
#include "sema/project.h"

namespace rung::workspace {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Pragmas that count from their place on, or change what is parsed.
bool hasDirectives(std::string_view text) {
  for (size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    const size_t begin = std::min(text.find_first_not_of(" \t\r\n", at + 1), text.size());
    const std::string_view rest = text.substr(begin);
    for (const std::string_view word : {"warning", "IF", "ELSIF", "ELSE", "END_IF", "define", "undefine"})
      if (sameIdentifier(rest.substr(0, word.size()), word)) return true;
  }
  return false;
}

// What is said of a name where it comes first in the project.
bool isOfUnderscores(const Diagnostic& said) {
  return said.diag == diag::UnderscoresInName || said.diag == diag::UnderscoresInNameWarning;
}

// What is wrong in how the text is divided into words may reach beyond a declaration.
bool isOfWords(const Diagnostic& said) {
  static constexpr Diag kOfWords[] = {diag::UnterminatedComment, diag::UnterminatedString, diag::NestedComment,
                                      diag::UnterminatedPragma, diag::StrayBrace};
  return isOfUnderscores(said) || std::find(std::begin(kOfWords), std::end(kOfWords), said.diag) != std::end(kOfWords);
}

bool isWordCharacter(char c) {
  return (c >= '0' && c <= '9') || (foldedCharacter(c) >= 'a' && foldedCharacter(c) <= 'z') || c == '_';
}

// Whether a word that has a character in [begin, end) may be a name that the standard forbids for its underscores.
bool hasOddUnderscores(std::string_view text, uint32_t begin, uint32_t end) {
  while (begin > 0 && isWordCharacter(text[begin - 1])) --begin;
  while (end < text.size() && isWordCharacter(text[end])) ++end;
  const std::string_view words = text.substr(begin, end - begin);
  for (size_t at = words.find('_'); at != std::string_view::npos; at = words.find('_', at + 1))
    if (at + 1 == words.size() || words[at + 1] == '_' || !isWordCharacter(words[at + 1])) return true;
  return false;
}

bool namesLine(const Diagnostic& diagnostic) { return diagnostic.message.find(" line ") != std::string::npos; }

}  // namespace

EditedFile::EditedFile(driver::Compilation& of, FileId file) : of_(of), file_(file) {
  const auto input = std::find_if(of.inputs.files.begin(), of.inputs.files.end(),
                                  [&](const driver::InputFile& candidate) { return candidate.file == file; });
  const Loc begin = of.sources.begin(file);
  is_plain_ = input != of.inputs.files.end() && input->kind == driver::FileKind::St && !input->is_library &&
              of.sources.originalLocation(begin) == begin && !hasDirectives(of.sources.sourceText(file));
  has_regions_ = is_plain_ && findRegions();
}

FileUnit& EditedFile::unit() {
  return *std::find_if(of_.tree.files.begin(), of_.tree.files.end(),
                       [&](const FileUnit& unit) { return unit.file == file_; });
}

// False: the file is not in the tree, or has declarations inside of each other in a way that is not expected.
bool EditedFile::findRegions() {
  const std::vector<FileUnit>& files = of_.tree.files;
  if (std::none_of(files.begin(), files.end(), [&](const FileUnit& unit) { return unit.file == file_; })) return false;
  const std::string_view text = of_.sources.sourceText(file_);
  const Loc base = of_.sources.begin(file_);
  const std::span<const DeclId> decls = std::as_const(of_.tree).list(unit().decls);
  uint32_t at = 0;
  for (size_t i = 0; i < decls.size(); ++i) {
    const Range extent = extentOf(of_.tree, decls[i]);
    const Span span{extent.begin.offset - base.offset, extent.end.offset - base.offset};
    std::vector<Span> spans;
    if (span.begin < at || span.end < span.begin || span.end > text.size()) return false;
    if (of_.tree.kind(decls[i]) == DeclKind::Pou && findBodies(decls[i], base, text, spans)) {
      regions_.push_back({i, span, span, bodies_.size(), spans.size(), {}});
      for (const Span& body : spans) bodies_.push_back({body, body.end});
    }
    at = span.end;
  }
  return std::is_sorted(bodies_.begin(), bodies_.end(),
                        [](const Body& a, const Body& b) { return a.span.end < b.span.begin; });
}

// The bodies of a POU and its members, sorted. False: one of them is not in ST.
bool EditedFile::findBodies(DeclId id, Loc base, std::string_view text, std::vector<Span>& out) const {
  const Tree& tree = of_.tree;
  if (tree.kind(id) == DeclKind::Property) {
    const PropertyDecl& property = tree.as<PropertyDecl>(id);
    if (property.in_halves) return false;
    return (!property.get || findBodies(property.get, base, text, out)) &&
           (!property.set || findBodies(property.set, base, text, out));
  }
  if (tree.kind(id) != DeclKind::Pou) return false;
  const PouDecl& pou = tree.as<PouDecl>(id);
  if (pou.body_kind != BodyKind::St || !pou.closed || !pou.transitions.empty()) return false;
  Span span{pou.body_begin.offset - base.offset, pou.body_end.offset - base.offset};
  if (span.begin > span.end || span.end > text.size()) return false;
  while (span.begin > 0 && isBlank(text[span.begin - 1])) --span.begin;
  while (span.end < text.size() && isBlank(text[span.end])) ++span.end;
  out.push_back(span);
  for (const DeclId member : tree.list(pou.members))
    if (!findBodies(member, base, text, out)) return false;
  std::sort(out.begin(), out.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
  return true;
}

bool EditedFile::replace(const std::string& text) {
  const Diagnostics& diagnostics = of_.diagnostics;
  if (!has_regions_ || diagnostics.droppedCount() + diagnostics.droppedWarningCount() > 0) return false;
  if (text == of_.sources.sourceText(file_)) return true;
  const Change change = changeTo(text);
  size_t body = 0;
  Region* const region = regionOf(change, body);
  if (region == nullptr || !isUtf8(text) || !keepsWords(bodies_[body], change, text) ||
      !keepsMessages(*region, change, text))
    return false;
  std::vector<DeclId> decls;
  for (const DeclId decl : of_.tree.list(unit().decls)) decls.push_back(decl);
  std::vector<NewBody> bodies = bodiesOf(decls[region->decl]);
  if (bodies.size() != region->bodies || !speaksOfItself(*region, bodies)) return false;

  if (retractSyntaxErrors(*region) && of_.tree.lost_names) return false;  // perhaps those that this region had
  shift(change, *region, body);
  FileUnit parsed;
  if (!mapSources(*region, text) || !parse(*region, parsed)) return false;
  DeclId& decl = decls[region->decl];
  decl = splice(decl, of_.tree.list(parsed.decls)[0], bodies);
  if (!decl) return false;
  unit().decls = of_.tree.addList<DeclId>(decls);
  return of_.checked->replaceBodies(bodies) && speaksOfItself(*region, bodies);
}

bool EditedFile::take(const std::string& text) {
  const std::string_view old = of_.sources.sourceText(file_);
  const Change change = changeTo(text);
  if (!is_plain_ || !isUtf8(text) || hasDirectives(text) || hasOddUnderscores(old, change.begin, change.old_end) ||
      hasOddUnderscores(text, change.begin, change.new_end))
    return false;
  const std::vector<Diagnostic>& all = of_.diagnostics.all();
  if (std::any_of(all.begin(), all.end(), [&](const Diagnostic& said) {
        return isOfUnderscores(said) && of_.sources.wholeOf(of_.sources.fileOf(said.loc)) == file_;
      }))
    return false;
  has_regions_ = false;
  if (text == old) return true;
  before_ = of_.sources.edit(file_, text);
  return static_cast<bool>(before_);
}

size_t EditedFile::bytesAround(std::string_view text) const {
  const uint32_t at = changeTo(text).begin;
  const auto region =
      std::find_if(regions_.begin(), regions_.end(), [&](const Region& of) { return of.span.contains(at, at); });
  return region == regions_.end() ? 0 : region->span.end - region->span.begin;
}

void EditedFile::release() {
  for (const FileId text : {was_, before_})
    if (text) of_.sources.forget(text);
  for (const Region& region : regions_)
    if (region.copy) of_.sources.forget(region.copy);
}

// Whether the words around the body stay words of their own, and no message about a declaration is on a line of the
// body. Pragmas in a body may count outside of it.
bool EditedFile::keepsWords(const Body& body, const Change& change, std::string_view text) {
  const std::string_view now = text.substr(body.span.begin, body.span.end - body.span.begin + change.delta());
  const std::string_view blanks = now.substr(0, std::min(now.find_first_not_of(" \t\r\n"), now.size()));
  return blanks.find('\n') != std::string_view::npos && isBlank(now.back()) && now.find('{') == std::string_view::npos;
}

// Whether what is said outside of the region stays true.
bool EditedFile::keepsMessages(const Region& region, const Change& change, std::string_view text) const {
  const std::string_view old = of_.sources.sourceText(file_);
  if (hasOddUnderscores(old, change.begin, change.old_end) || hasOddUnderscores(text, change.begin, change.new_end))
    return false;
  const bool moves_lines = std::count(old.begin(), old.end(), '\n') != std::count(text.begin(), text.end(), '\n');
  const uint32_t base = of_.sources.begin(file_).offset;
  const std::vector<Diagnostic>& all = of_.diagnostics.all();
  return std::none_of(all.begin(), all.end(), [&](const Diagnostic& diagnostic) {
    const uint32_t at = diagnostic.original_loc.offset - base;
    const bool is_here = at <= old.size();
    return is_here &&
           (isOfWords(diagnostic) || (moves_lines && namesLine(diagnostic) && !region.span.contains(at, at)));
  });
}

EditedFile::Change EditedFile::changeTo(std::string_view text) const {
  const std::string_view old = of_.sources.sourceText(file_);
  const auto differ = std::mismatch(old.begin(), old.end(), text.begin(), text.end());
  const auto begin = static_cast<uint32_t>(differ.first - old.begin());
  const std::string_view old_rest = old.substr(begin), rest = text.substr(begin);
  const auto same = std::mismatch(old_rest.rbegin(), old_rest.rend(), rest.rbegin(), rest.rend());
  const auto tail = static_cast<uint32_t>(same.first - old_rest.rbegin());
  return {begin, static_cast<uint32_t>(old.size()) - tail, static_cast<uint32_t>(text.size()) - tail};
}

// The region with the body that the change lies in; null: there is none.
EditedFile::Region* EditedFile::regionOf(const Change& change, size_t& body) {
  const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& candidate) {
    return candidate.span.contains(change.begin, change.old_end);
  });
  if (found == bodies_.end()) return nullptr;
  body = static_cast<size_t>(found - bodies_.begin());
  return &*std::find_if(regions_.begin(), regions_.end(),
                        [&](const Region& region) { return body < region.first_body + region.bodies; });
}

// The offsets of the new text.
void EditedFile::shift(const Change& change, const Region& region, size_t body) {
  bodies_[body].span.end += change.delta();
  for (size_t i = body + 1; i < bodies_.size(); ++i) {
    bodies_[i].span.begin += change.delta();
    bodies_[i].span.end += change.delta();
  }
  for (Region& at : regions_) {
    if (at.span.begin > region.span.begin) at.span.begin += change.delta();
    if (at.span.begin >= region.span.begin) at.span.end += change.delta();
  }
}

// Lets the locations of what stays lead into the new text.
bool EditedFile::mapSources(Region& region, const std::string& text) {
  Sources& sources = of_.sources;
  const FileId before = sources.edit(file_, text);
  if (!before) return false;
  if (was_)
    sources.forget(before);
  else
    was_ = before;
  const Loc base = sources.begin(file_);
  std::vector<Segment> segments = {{0, base, true}};
  for (const Body& body : bodies_)
    if (const Loc from{base.offset + body.span.end};
        from.offset - body.was_end != segments.back().from.offset - segments.back().at)
      segments.push_back({body.was_end, from, true});
  sources.remap(was_, std::move(segments));
  if (region.copy) sources.forget(region.copy);
  region.copy = sources.addPart(file_, text.substr(region.span.begin, region.span.end - region.span.begin));
  if (!region.copy) return false;
  for (const Region& at : regions_)
    if (at.copy) sources.remap(at.copy, {{0, {base.offset + at.span.begin}, true}});
  return true;
}

// Whether there were any.
bool EditedFile::retractSyntaxErrors(const Region& region) {
  const Sources& sources = of_.sources;
  const uint32_t errors = of_.diagnostics.errorCount();
  const FileId whole = was_ ? was_ : file_;
  of_.diagnostics.retract([&](const Diagnostic& diagnostic) {
    if (diagnostic.reporter != 0 || !diagnostic.loc) return false;
    const FileId file = sources.fileOf(diagnostic.loc);
    if (region.copy && file == region.copy) return true;
    const uint32_t at = diagnostic.loc.offset - sources.begin(whole).offset;
    return file == whole && region.was.contains(at, at);
  });
  return of_.diagnostics.errorCount() != errors;
}

// The declaration of the region. False: it declares something else than it did.
bool EditedFile::parse(Region& region, FileUnit& unit) {
  Tree& tree = of_.tree;
  const std::vector<bool> eno_read_of = tree.eno_read_of;
  const bool lost_names = std::exchange(tree.lost_names, false);
  unit = text::parseFile(tree, of_.names, of_.sources, region.copy, of_.options.dialect, of_.diagnostics);
  tree.files.pop_back();
  const std::vector<Diagnostic>& all = of_.diagnostics.all();
  if (std::any_of(all.begin(), all.end(), [&](const Diagnostic& said) {
        return isOfWords(said) && of_.sources.fileOf(said.loc) == region.copy;
      }))
    return false;
  if (tree.lost_names || tree.eno_read_of != eno_read_of || unit.decls.count != 1) return false;
  tree.lost_names = lost_names;
  std::vector<Span> expected, found;
  for (size_t i = 0; i < region.bodies; ++i) {
    const Span span = bodies_[region.first_body + i].span;
    expected.push_back({span.begin - region.span.begin, span.end - region.span.begin});
  }
  const std::string_view text = of_.sources.sourceText(region.copy);
  const Loc base = of_.sources.begin(region.copy);
  const DeclId decl = std::as_const(tree).list(unit.decls)[0];
  return extentOf(tree, decl).end.offset - base.offset == text.size() && findBodies(decl, base, text, found) &&
         found == expected;
}

// The old declaration with the bodies of the new one; none: they differ in more. Tells `bodies` their declarations.
DeclId EditedFile::splice(DeclId old, DeclId parsed, std::vector<NewBody>& bodies) const {
  Tree& tree = of_.tree;
  if (tree.kind(old) != tree.kind(parsed)) return {};
  if (tree.kind(old) == DeclKind::Property) {
    PropertyDecl property = tree.as<PropertyDecl>(old);
    const PropertyDecl& with = tree.as<PropertyDecl>(parsed);
    for (DeclId PropertyDecl::*const accessor : {&PropertyDecl::get, &PropertyDecl::set}) {
      DeclId& had = property.*accessor;
      if (had.word == 0 && (with.*accessor).word == 0) continue;
      if (had.word == 0 || (with.*accessor).word == 0) return {};
      had = splice(had, with.*accessor, bodies);
      if (!had) return {};
    }
    return tree.add<DeclId>(property);
  }
  PouDecl pou = tree.as<PouDecl>(old);
  const PouDecl& with = tree.as<PouDecl>(parsed);
  if (pou.name != with.name || pou.is_broken != with.is_broken || pou.uses_eno != with.uses_eno ||
      pou.sections.count != with.sections.count || pou.members.count != with.members.count)
    return {};
  pou.body = with.body;
  pou.body_begin = with.body_begin;
  pou.body_end = with.body_end;
  std::vector<DeclId> members;
  for (uint32_t i = 0; i < pou.members.count; ++i) {
    members.push_back(splice(tree.list(pou.members)[i], tree.list(with.members)[i], bodies));
    if (!members.back()) return {};
  }
  pou.members = tree.addList<DeclId>(members);
  const DeclId spliced = tree.add<DeclId>(pou);
  const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const NewBody& of) { return of.decl == old; });
  if (body == bodies.end()) return {};
  body->decl = spliced;
  return spliced;
}

// The POUs of a declaration and its members, as they are declared now.
std::vector<EditedFile::NewBody> EditedFile::bodiesOf(DeclId decl) const {
  std::vector<DeclId> inside = {decl};
  const auto add = [&](DeclId id) {
    if (id) inside.push_back(id);
  };
  for (size_t i = 0; i < inside.size(); ++i) {
    if (of_.tree.kind(inside[i]) == DeclKind::Property) {
      const PropertyDecl& property = of_.tree.as<PropertyDecl>(inside[i]);
      add(property.get);
      add(property.set);
    } else {
      for (const DeclId member : of_.tree.list(of_.tree.as<PouDecl>(inside[i]).members)) add(member);
    }
  }
  std::vector<NewBody> bodies;
  const std::deque<sema::Pou>& pous = of_.project->pous;
  for (uint32_t i = 1; i < pous.size(); ++i)
    if (std::find(inside.begin(), inside.end(), pous[i].decl) != inside.end()) bodies.push_back({{i}, pous[i].decl});
  return bodies;
}

// Whether all that these bodies say is said in the region: else another body may say it, too.
bool EditedFile::speaksOfItself(const Region& region, const std::vector<NewBody>& bodies) const {
  const uint32_t base = of_.sources.begin(file_).offset;
  const auto is_one = [&](uint32_t reporter) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const NewBody& body) { return body.pou.index == reporter; });
  };
  const std::vector<Diagnostic>& all = of_.diagnostics.all();
  return std::all_of(all.begin(), all.end(), [&](const Diagnostic& diagnostic) {
    if (!is_one(diagnostic.reporter)) return true;
    const uint32_t at = of_.sources.originalLocation(diagnostic.loc).offset - base;
    return region.span.contains(at, at);
  });
}

}  // namespace rung::workspace
