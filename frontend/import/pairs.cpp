// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/pairs.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "frontend/import/diagnostics.h"
#include "frontend/import/formats.h"
#include "frontend/import/source_mapped_text.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer {
namespace {

// Where the members of a block can be inserted.
struct Block {
  size_t file;  // in the list of candidates
  size_t end;   // before its END_…
};

struct MemberName {
  std::string_view block, member;
  bool in_folder;  // Motor/Start.st
};

FileId joined(Sources& sources, FileId declaration, FileId body) {
  xml::SourceMappedText program(sources);
  const auto whole = [&](FileId file) {
    const Loc begin = sources.begin(file);
    program.add(begin, {begin.offset + static_cast<uint32_t>(sources.sourceText(file).size())});
    program.word("\n");
  };
  whole(declaration);
  const std::string_view end = endWordOf(firstWord(sources.sourceText(declaration)));
  whole(body);
  program.word(end);
  return program.finish(sources, declaration);
}

bool isModifier(std::string_view word) {
  for (const std::string_view known : {"PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "ABSTRACT", "FINAL"})
    if (sameIdentifier(word, known)) return true;
  return false;
}

// The POUs in a source that may have members, by name in upper case.
void findBlocks(std::string_view text, size_t file, std::unordered_map<std::string, std::vector<Block>>& blocks) {
  Scanner scanner(text);
  std::string name, end_word;
  size_t last_end = 0;  // of the code so far
  const auto close = [&](size_t at) {
    if (!name.empty()) blocks[name].push_back({file, at});
    name.clear();
  };
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    const std::string_view word = scanner.textOf(unit);
    if (unit.kind == UnitKind::Name && !name.empty() && sameIdentifier(word, end_word)) {
      close(unit.begin);
    } else if (unit.kind == UnitKind::Name && sameIdentifier(word, "CONFIGURATION")) {
      close(last_end);
      while (unit.kind != UnitKind::End && !sameIdentifier(scanner.textOf(unit), "END_CONFIGURATION"))
        unit = scanner.nextCode();
    } else if (unit.kind == UnitKind::Name &&
               (sameIdentifier(word, "CLASS") || sameIdentifier(word, "TYPE") || !endWordOf(word).empty())) {
      const bool is_member = sameIdentifier(word, "METHOD") || sameIdentifier(word, "ACTION");
      const size_t behind = scanner.at();
      Unit named = scanner.nextCode();
      while (named.kind == UnitKind::Name && isModifier(scanner.textOf(named))) named = scanner.nextCode();
      if (named.kind == UnitKind::Name && !is_member) {
        close(last_end);
        if (!sameIdentifier(word, "TYPE") && !sameIdentifier(word, "FUNCTION")) {
          name = upper(scanner.textOf(named));
          end_word = "END_" + upper(word);
        }
      } else {
        scanner.moveTo(behind);
      }
    }
    last_end = std::min(scanner.at(), text.size());
  }
  close(last_end);
}

// Motor.Start.st, or Start.st in a folder Motor.
MemberName memberNameOf(std::string_view path) {
  const size_t slash = path.rfind('/');
  std::string_view folder = slash == std::string_view::npos ? std::string_view() : path.substr(0, slash);
  std::string_view stem = path.substr(slash == std::string_view::npos ? 0 : slash + 1);
  stem = stem.substr(0, stem.rfind('.'));
  const size_t dot = stem.rfind('.');
  if (dot == std::string_view::npos) return {folder.substr(folder.rfind('/') + 1), stem, true};
  const std::string_view block = stem.substr(0, dot);
  return {block.substr(block.rfind('.') + 1), stem.substr(dot + 1), false};
}

bool isMember(std::string_view first_word) {
  return first_word == "METHOD" || first_word == "ACTION" || first_word.starts_with("PROPERTY");
}

bool holdsStatements(std::string_view text) {
  const std::string first = firstWord(text);
  return !startsDeclaration(text) && !first.starts_with("VAR") && first != "CLASS" && first != "USING";
}

std::string lastWord(std::string_view text) {
  Scanner scanner(text);
  std::string last;
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode())
    if (unit.kind == UnitKind::Name) last = upper(scanner.textOf(unit));
  return last;
}

Loc locationAt(const Sources& sources, FileId file, size_t at) {
  return {sources.begin(file).offset + static_cast<uint32_t>(at)};
}

// Writes a member and its END_…, which the file may leave out.
void writeMember(const Sources& sources, FileId file, std::string_view name, xml::SourceMappedText& out) {
  const std::string_view text = sources.sourceText(file);
  const std::string first = firstWord(text);
  const std::string end = isMember(first) ? "END_" + first.substr(0, first.find('_')) : "END_ACTION";
  const Loc begin = locationAt(sources, file, text.size() - withoutMark(text).size());
  out.put(begin, isMember(first) ? "\n" : "\nACTION " + std::string(name) + ":\n");
  out.add(begin, locationAt(sources, file, text.size()));
  out.word(lastWord(text) == end ? "\n" : "\n" + end + "\n");
}

}  // namespace

std::string pairName(std::string_view path) {
  const size_t slash = path.rfind('/');
  const size_t dot = path.rfind('.');
  if (dot != std::string_view::npos && (slash == std::string_view::npos || dot > slash)) path = path.substr(0, dot);
  std::string name = upper(path);
  for (const std::string_view part : {"DECLARATION", "DECL", "IMPLEMENTATION", "IMPL", "BODY"}) {
    if (!name.ends_with(part)) continue;
    const size_t rest = name.size() - part.size();
    if (rest != 0 && std::string_view("._-/").find(name[rest - 1]) == std::string_view::npos) continue;
    name.resize(rest == 0 ? 0 : rest - 1);
    break;
  }
  return name;
}

void joinPairs(Sources& sources, std::vector<PairCandidate>& files) {
  std::vector<std::pair<std::string, size_t>> bodies, declarations;
  for (size_t i = 0; i < files.size(); i++) {
    const std::string_view text = sources.sourceText(files[i].file);
    const std::string word = firstWord(text);
    if (word == "PROGRAM" || word == "FUNCTION" || word == "FUNCTION_BLOCK" || word == "METHOD")
      declarations.emplace_back(pairName(files[i].path), i);
    else if (!startsDeclaration(text))
      bodies.emplace_back(pairName(files[i].path), i);
  }
  std::sort(bodies.begin(), bodies.end());
  std::sort(declarations.begin(), declarations.end());
  for (size_t i = 0; i < bodies.size(); i++) {
    const std::string& name = bodies[i].first;
    if ((i > 0 && bodies[i - 1].first == name) || (i + 1 < bodies.size() && bodies[i + 1].first == name)) continue;
    const auto from = std::lower_bound(declarations.begin(), declarations.end(), std::pair{name, size_t{0}});
    if (from == declarations.end() || from->first != name) continue;
    if (from + 1 != declarations.end() && (from + 1)->first == name) continue;
    PairCandidate& declaration = files[from->second];
    PairCandidate& body = files[bodies[i].second];
    declaration.file = joined(sources, declaration.file, body.file);
    body.file = {};
  }
}

// Forbids a member without its block.
//   fails   Pump.Start.st: METHOD Start        E0162, unless a file declares Pump
bool joinMembers(Sources& sources, std::vector<PairCandidate>& files, Diagnostics& diagnostics) {
  std::vector<size_t> members;
  for (size_t i = 0; i < files.size(); i++) {
    if (!files[i].file) continue;
    const std::string_view text = sources.sourceText(files[i].file);
    if (isMember(firstWord(text)) || holdsStatements(text)) members.push_back(i);
  }
  if (members.empty()) return true;
  std::unordered_map<std::string, std::vector<Block>> blocks;
  for (size_t i = 0; i < files.size(); i++)
    if (files[i].file && !std::binary_search(members.begin(), members.end(), i))
      findBlocks(sources.sourceText(files[i].file), i, blocks);

  const auto folderOf = [&](size_t i) { return upper(files[i].path.substr(0, files[i].path.rfind('/') + 1)); };
  bool ok = true;
  std::vector<std::pair<std::pair<size_t, size_t>, size_t>> placed;  // file and offset of the block's end, member
  for (const size_t i : members) {
    const std::string first = firstWord(sources.sourceText(files[i].file));
    const MemberName name = memberNameOf(files[i].path);
    const auto found = blocks.find(upper(name.block));
    if (found == blocks.end()) {
      if (!isMember(first) || name.in_folder) continue;  // the parser reports what it is
      Scanner scanner(sources.sourceText(files[i].file));
      const Unit word = scanner.nextCode();
      diagnostics.report(diag::MemberWithoutBlock, locationAt(sources, files[i].file, word.begin), {first, name.block})
          .length(static_cast<uint32_t>(first.size()));
      files[i].file = {};
      ok = false;
      continue;
    }
    const bool is_half = pairName(files[i].path) != upper(files[i].path.substr(0, files[i].path.rfind('.')));
    if (!isMember(first) && (is_half || name.in_folder || !isIdentifier(name.member))) continue;
    const Block* block = &found->second[0];
    for (const Block& other : found->second)
      if (folderOf(other.file) == folderOf(i)) block = &other;
    placed.push_back({{block->file, block->end}, i});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  for (size_t i = 0; i < placed.size();) {
    const size_t target = placed[i].first.first;
    const FileId file = files[target].file;
    xml::SourceMappedText program(sources);
    size_t from = 0;
    for (; i < placed.size() && placed[i].first.first == target; i++) {
      const size_t at = placed[i].first.second;
      program.add(locationAt(sources, file, from), locationAt(sources, file, at));
      from = at;
      PairCandidate& member = files[placed[i].second];
      writeMember(sources, member.file, memberNameOf(member.path).member, program);
      member.file = {};
    }
    program.add(locationAt(sources, file, from), locationAt(sources, file, sources.sourceText(file).size()));
    files[target].file = program.finish(sources, file);
  }
  return ok;
}

}  // namespace rung::importer
