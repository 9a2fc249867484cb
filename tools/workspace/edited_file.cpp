// SPDX-License-Identifier: Apache-2.0
#include "tools/workspace/edited_file.h"

#include <algorithm>
#include <utility>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/parse.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/node_at.h"
#include "sema/project.h"

namespace rung::workspace {
namespace {

// Pragmas that count from their place on, or change what is parsed.
bool hasDirectives(std::string_view text) {
  return hasPragma(text, {"warning", "IF", "ELSIF", "ELSE", "END_IF", "define", "undefine"});
}

// What is said of a name where it comes first in the project.
bool isOfUnderscores(const Diagnostic& said) {
  return said.diag == diag::UnderscoresInName || said.diag == diag::UnderscoresInNameWarning;
}

// Whether a word that has a character in [begin, end) may be a name that the standard forbids for its underscores.
bool hasOddUnderscores(std::string_view text, uint32_t begin, uint32_t end) {
  while (begin > 0 && isNameCharacter(text[begin - 1])) --begin;
  while (end < text.size() && isNameCharacter(text[end])) ++end;
  const std::string_view words = text.substr(begin, end - begin);
  for (size_t at = words.find('_'); at != std::string_view::npos; at = words.find('_', at + 1))
    if (at + 1 == words.size() || words[at + 1] == '_' || !isNameCharacter(words[at + 1])) return true;
  return false;
}

}  // namespace

EditedFile::EditedFile(driver::Compilation& of, FileId file) : of_(of), file_(file) {
  const auto input = std::find_if(of.inputs.files.begin(), of.inputs.files.end(),
                                  [&](const driver::InputFile& candidate) { return candidate.file == file; });
  const Loc begin = of.sources.begin(file);
  is_plain_ = input != of.inputs.files.end() && input->kind == driver::FileKind::St && !input->is_library &&
              of.sources.originalLocation(begin) == begin && !hasDirectives(of.sources.sourceText(file));
  has_regions_ = is_plain_ && findRegions();
}

// In the tree; none: it does not have the file.
std::span<const DeclId> EditedFile::decls() const {
  const Tree& tree = of_.tree;
  const auto unit =
      std::find_if(tree.files.begin(), tree.files.end(), [&](const FileUnit& of) { return of.file == file_; });
  return unit == tree.files.end() ? std::span<const DeclId>() : tree.list(unit->decls);
}

// False: the file has declarations inside of each other in a way that is not expected.
bool EditedFile::findRegions() {
  const std::string_view text = of_.sources.sourceText(file_);
  const Loc base = of_.sources.begin(file_);
  decls_.assign(decls().begin(), decls().end());
  uint32_t at = 0;
  for (size_t i = 0; i < decls_.size(); ++i) {
    const Range extent = extentOf(of_.tree, decls_[i]);
    const Span span{extent.begin.offset - base.offset, extent.end.offset - base.offset};
    std::vector<Span> spans;
    if (span.begin < at || span.end < span.begin || span.end > text.size()) return false;
    if (of_.tree.kind(decls_[i]) == DeclKind::Pou && findBodies(decls_[i], base, text, spans)) {
      regions_.push_back({i, span, bodies_.size(), spans.size(), {}, {}});
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
    return !property.in_halves && (!property.get || findBodies(property.get, base, text, out)) &&
           (!property.set || findBodies(property.set, base, text, out));
  }
  if (tree.kind(id) != DeclKind::Pou) return false;
  const PouDecl& pou = tree.as<PouDecl>(id);
  if (pou.body_kind != BodyKind::St || !pou.closed || !pou.transitions.empty()) return false;
  Span span{pou.body_begin.offset - base.offset, pou.body_end.offset - base.offset};
  if (span.begin > span.end || span.end > text.size()) return false;
  while (span.begin > 0 && isBlankCharacter(text[span.begin - 1])) --span.begin;
  while (span.end < text.size() && isBlankCharacter(text[span.end])) ++span.end;
  out.push_back(span);
  for (const DeclId member : tree.list(pou.members))
    if (!findBodies(member, base, text, out)) return false;
  std::sort(out.begin(), out.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
  return true;
}

bool EditedFile::replace(const std::string& text) {
  if (!has_regions_ || of_.diagnostics.droppedCount() + of_.diagnostics.droppedWarningCount() > 0) return false;
  if (text == of_.sources.sourceText(file_)) return true;
  const Change change = changeTo(text);
  size_t body = 0;
  Region* const region = regionOf(change, body);
  if (region == nullptr || !mayStay(change, text) || !isApart(bodies_[body], change, text)) return false;
  if (region->pous.empty()) region->pous = pousOf(decls_[region->decl]);
  if (region->pous.size() != region->bodies || !speaksOfItself(*region)) return false;

  freeLastEdit(*region);
  if (!edit(text)) return false;
  const FileId gone = std::exchange(region->text, {});
  last_ = region;
  shift(change, *region, body);
  region->begin = region->span.begin;
  mapTexts();
  const bool is_parsed = of_.parseAgain(file_) && hasSameBodies();
  if (gone) of_.sources.forget(gone);
  std::vector<NewBody> bodies = region->pous;
  if (!is_parsed || !splice(decls_[region->decl], decls()[region->decl], bodies)) return false;
  if (!of_.checked->replaceBodies(bodies) || !speaksOfItself(*region)) return false;
  size_after_ = of_.tree.size();
  return true;
}

// Uses the memory of the bodies that are to be replaced again, when it is the last and nothing else refers to it.
void EditedFile::freeLastEdit(const Region& region) {
  const size_t known = of_.checked->knownBesideBodies();
  if (&region == last_ && of_.tree.size() == size_after_ && known == known_) {
    for (const NewBody& first : region.pous) of_.project->pou(first.pou).decl = first.decl;
    of_.tree.truncate(size_before_);
  } else {
    size_before_ = of_.tree.size();
  }
  known_ = known;
}

bool EditedFile::take(const std::string& text) {
  if (!is_plain_ || !mayStay(changeTo(text), text)) return false;
  has_regions_ = false;
  return text == of_.sources.sourceText(file_) || edit(text);
}

void EditedFile::release() {
  if (declarations_) of_.sources.forget(declarations_);
  for (const Region& region : regions_)
    if (region.text) of_.sources.forget(region.text);
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

// Whether other files say the same with this text. What is wrong with the underscores of a name is said where it comes
// first in the project.
bool EditedFile::mayStay(const Change& change, std::string_view text) const {
  const auto is_said = [&](const Diagnostic& said) {
    return isOfUnderscores(said) && of_.sources.editedFile(of_.sources.fileOf(said.loc)) == file_;
  };
  const std::vector<Diagnostic>& all = of_.diagnostics.all();
  return isUtf8(text) && !hasDirectives(text) && std::none_of(all.begin(), all.end(), is_said) &&
         !hasOddUnderscores(of_.sources.sourceText(file_), change.begin, change.old_end) &&
         !hasOddUnderscores(text, change.begin, change.new_end);
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

// Whether no message about a declaration is on a line of the body: an error there may hide it. Pragmas in a body may
// count outside of it.
bool EditedFile::isApart(const Body& body, const Change& change, std::string_view text) {
  const std::string_view now = text.substr(body.span.begin, body.span.end - body.span.begin + change.delta());
  const std::string_view blanks = now.substr(0, std::min(now.find_first_not_of(" \t\r\n"), now.size()));
  return blanks.find('\n') != std::string_view::npos && isBlankCharacter(now.back()) &&
         now.find('{') == std::string_view::npos;
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

// Gives the sources the new text. The one before is that of the declarations, or of the bodies that were parsed last.
bool EditedFile::edit(const std::string& text) {
  const FileId before = of_.sources.edit(file_, text);
  (last_ != nullptr ? last_->text : declarations_) = before;
  return static_cast<bool>(before);
}

// Lets the locations of what stays lead into the new text.
void EditedFile::mapTexts() {
  const Loc base = of_.sources.begin(file_);
  std::vector<Segment> segments = {{0, base, true}};
  for (const Body& body : bodies_) {
    const Loc from{base.offset + body.span.end};
    if (from.offset - body.was_end != segments.back().from.offset - segments.back().at)
      segments.push_back({body.was_end, from, true});
  }
  of_.sources.remap(declarations_, std::move(segments));
  for (const Region& region : regions_)
    if (region.text) of_.sources.remap(region.text, {{0, {base.offset + region.span.begin - region.begin}, true}});
}

// Whether the file that was just parsed has its bodies where they are expected, and thus the same declarations.
bool EditedFile::hasSameBodies() const {
  const std::string_view text = of_.sources.sourceText(file_);
  const Loc base = of_.sources.begin(file_);
  const std::span<const DeclId> parsed = decls();
  if (parsed.size() != decls_.size()) return false;
  return std::all_of(regions_.begin(), regions_.end(), [&](const Region& region) {
    std::vector<Span> found;
    const DeclId decl = parsed[region.decl];
    const Range extent = extentOf(of_.tree, decl);
    const Span span{extent.begin.offset - base.offset, extent.end.offset - base.offset};
    if (span != region.span || !findBodies(decl, base, text, found) || found.size() != region.bodies) return false;
    return std::equal(found.begin(), found.end(), bodies_.begin() + static_cast<std::ptrdiff_t>(region.first_body),
                      [](const Span& a, const Body& b) { return a == b.span; });
  });
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

// The POUs of a declaration and its members, and how they are declared.
std::vector<EditedFile::NewBody> EditedFile::pousOf(DeclId decl) const {
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
  std::vector<NewBody> found;
  const std::deque<sema::Pou>& pous = of_.project->pous;
  for (uint32_t i = 1; i < pous.size(); ++i)
    if (std::find(inside.begin(), inside.end(), pous[i].decl) != inside.end()) found.push_back({{i}, pous[i].decl});
  return found;
}

// Whether all that its bodies say is said in the region: else another body may say it, too.
bool EditedFile::speaksOfItself(const Region& region) const {
  const uint32_t base = of_.sources.begin(file_).offset;
  const auto is_one = [&](uint32_t reporter) {
    return std::any_of(region.pous.begin(), region.pous.end(),
                       [&](const NewBody& body) { return body.pou.index == reporter; });
  };
  const std::vector<Diagnostic>& all = of_.diagnostics.all();
  return std::all_of(all.begin(), all.end(), [&](const Diagnostic& diagnostic) {
    if (!is_one(diagnostic.reporter)) return true;
    const uint32_t at = of_.sources.originalLocation(diagnostic.loc).offset - base;
    return region.span.contains(at, at);
  });
}

}  // namespace rung::workspace
