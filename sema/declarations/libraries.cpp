// SPDX-License-Identifier: Apache-2.0
// Library declarations: indexed by a light scan, read on first use. A library costs a program that does not use it
// nothing but the scan.
#include "sema/declarations/libraries.h"

#include "frontend/source/dialect.h"
#include "frontend/source/scanner.h"
#include "sema/declarations/collect.h"
#include "sema/declarations/resolve.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Words, punctuation and pragmas of a source; comments, strings and numbers are skipped.
class WordScanner {
 public:
  explicit WordScanner(std::string_view source) : source_(source) {}

  enum class Kind : uint8_t { End, Word, Pragma, Punctuation };
  Kind next() {
    while (at_ < source_.size()) {
      const char c = source_[at_];
      begin_ = at_;
      if (isLetter(c)) {
        while (at_ < source_.size() && (isLetter(source_[at_]) || isDigit(source_[at_]))) ++at_;
        return Kind::Word;
      }
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t') {
        ++at_;
      } else if (isDigit(c)) {  // 16#FF, 1.5e3: no words in it
        while (at_ < source_.size() && (isLetter(source_[at_]) || isDigit(source_[at_]) || source_[at_] == '#')) ++at_;
      } else if (c == '/' && peek(1) == '/') {
        at_ = std::min(source_.find('\n', at_), source_.size());
      } else if (c == '/' && peek(1) == '*') {
        const size_t end = source_.find("*/", at_ + 2);
        at_ = end == std::string_view::npos ? source_.size() : end + 2;
      } else if (c == '(' && peek(1) == '*') {
        skipComment();
      } else if (c == '\'' || c == '"') {
        skipString(c);
      } else if (c == '{') {
        at_ = std::min(source_.find('}', at_), source_.size() - 1) + 1;
        return Kind::Pragma;
      } else {
        ++at_;
        return Kind::Punctuation;
      }
    }
    begin_ = at_;
    return Kind::End;
  }

  std::string_view token() const { return source_.substr(begin_, at_ - begin_); }
  bool is(std::string_view word) const { return sameIdentifier(token(), word); }
  bool isPunctuation(char c) const { return source_[begin_] == c; }
  uint32_t begin() const { return static_cast<uint32_t>(begin_); }
  uint32_t end() const { return static_cast<uint32_t>(at_); }

 private:
  char peek(size_t ahead) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }
  void skipComment() {
    uint32_t depth = 0;
    do {
      if (source_[at_] == '(' && peek(1) == '*') {
        ++depth;
        at_ += 2;
      } else if (source_[at_] == '*' && peek(1) == ')') {
        --depth;
        at_ += 2;
      } else {
        ++at_;
      }
    } while (depth > 0 && at_ < source_.size());
  }
  void skipString(char quote) {
    for (++at_; at_ < source_.size() && source_[at_] != quote; ++at_) {
      if (source_[at_] == '$') ++at_;
    }
    at_ = std::min(at_ + 1, source_.size());
  }

  std::string_view source_;
  size_t begin_ = 0, at_ = 0;
};

using Kind = WordScanner::Kind;

// Skips everything up to one of the words; true when it was found.
bool skipTo(WordScanner& scan, std::string_view word) {
  for (Kind kind = scan.next(); kind != Kind::End; kind = scan.next()) {
    if (kind == Kind::Word && (scan.token()[0] | 32) == 'e' && scan.is(word)) return true;
  }
  return false;
}

void skipTo(WordScanner& scan, char punctuation) {
  for (Kind kind = scan.next(); kind != Kind::End; kind = scan.next()) {
    if (kind == Kind::Punctuation && scan.isPunctuation(punctuation)) return;
  }
}

// The items of an enumeration; the opening parenthesis was read.
void scanItems(WordScanner& scan, std::vector<std::string_view>& names) {
  uint32_t depth = 1;
  bool expected = true;
  for (Kind kind = scan.next(); kind != Kind::End && depth > 0; kind = scan.next()) {
    if (kind == Kind::Word && expected) names.push_back(scan.token());
    expected = false;
    if (kind != Kind::Punctuation) continue;
    if (scan.isPunctuation('(')) ++depth;
    if (scan.isPunctuation(')') && --depth == 0) return;
    if (scan.isPunctuation(',') && depth == 1) expected = true;
  }
}

// `bare`: items of enumerations are names in their own right.
void scanTypes(WordScanner& scan, std::vector<std::string_view>& names, bool bare) {
  for (Kind kind = scan.next(); kind != Kind::End; kind = scan.next()) {
    if (kind != Kind::Word) continue;
    if (scan.is("END_TYPE")) return;
    names.push_back(scan.token());
    skipTo(scan, ':');
    kind = scan.next();
    while (kind == Kind::Pragma) kind = scan.next();
    if (kind == Kind::Punctuation && scan.isPunctuation('(')) {
      std::vector<std::string_view> items;
      scanItems(scan, items);
      if (bare) names.insert(names.end(), items.begin(), items.end());
      skipTo(scan, ';');
    } else if (kind == Kind::Word && scan.is("STRUCT")) {
      skipTo(scan, "END_STRUCT");
    } else if (kind == Kind::Word && scan.is("UNION")) {
      skipTo(scan, "END_UNION");
    } else {
      skipTo(scan, ';');
    }
  }
}

void scanGlobals(WordScanner& scan, std::vector<std::string_view>& names) {
  bool in_name = true;
  for (Kind kind = scan.next(); kind != Kind::End; kind = scan.next()) {
    if (kind == Kind::Punctuation) {
      if (scan.isPunctuation(':')) in_name = false;
      if (scan.isPunctuation(';')) in_name = true;
    } else if (kind == Kind::Word) {
      if (scan.is("END_VAR")) return;
      const bool qualifier =
          scan.is("CONSTANT") || scan.is("RETAIN") || scan.is("PERSISTENT") || scan.is("NON_RETAIN") || scan.is("AT");
      if (in_name && !qualifier) names.push_back(scan.token());
    }
  }
}

// The last name of `Library.Base`. Returns the kind of the token after it.
Kind scanBase(WordScanner& scan, std::string_view& base) {
  Kind kind = scan.next();
  while (kind == Kind::Word) {
    base = scan.token();
    kind = scan.next();
    if (kind != Kind::Punctuation || !scan.isPunctuation('.')) break;
    kind = scan.next();
  }
  return kind;
}

// CODESYS 2.3 exports the actions of a POU after it.
void skipActions(WordScanner& scan) {
  for (WordScanner ahead = scan; ahead.next() == Kind::Word && ahead.is("ACTION") && skipTo(ahead, "END_ACTION");)
    scan = ahead;
}

uint8_t standardsOf(std::string_view pragma) {
  uint8_t standards = 0;
  for (const LanguageProfile& profile : kProfiles) {
    const bool has_name = profile.is_chosen && pragma.find(profile.name) != std::string_view::npos;
    if (has_name) standards |= bitOf(profile.dialect);
  }
  return standards;
}

}  // namespace

std::vector<IndexedBlock> indexLibrary(std::string_view source) {
  std::vector<IndexedBlock> blocks;
  WordScanner scan(source);
  bool has_pragma = false, bare = true, is_configuration = false;
  IndexedBlock block;
  for (Kind kind = scan.next(); kind != Kind::End; kind = scan.next()) {
    if (kind == Kind::Pragma) {
      if (!has_pragma) block.begin = scan.begin();
      has_pragma = true;
      std::string_view pragma = scan.token().substr(1);
      while (!pragma.empty() && pragma[0] == ' ') pragma.remove_prefix(1);
      if (pragma.starts_with("std ")) {
        const uint8_t standards = standardsOf(pragma);
        const bool qualified = pragma.find("else qualified") != std::string_view::npos;
        block.standards = qualified ? kAllStandards : standards;
        block.qualified = qualified ? kAllStandards & ~standards : 0;
      }
      if (pragma.find("'qualified_only'") != std::string_view::npos ||
          pragma.find("'strict'") != std::string_view::npos)
        bare = false;
      continue;
    }
    if (kind != Kind::Word) continue;
    if (!has_pragma) block.begin = scan.begin();
    // Of a project that is used as a library, the globals of its configuration count, but no program runs.
    if (scan.is("CONFIGURATION") || scan.is("END_CONFIGURATION")) is_configuration = scan.is("CONFIGURATION");
    const char* end = is_configuration            ? nullptr
                      : scan.is("FUNCTION_BLOCK") ? "END_FUNCTION_BLOCK"
                      : scan.is("FUNCTION")       ? "END_FUNCTION"
                      : scan.is("PROGRAM")        ? "END_PROGRAM"
                      : scan.is("INTERFACE")      ? "END_INTERFACE"
                      : scan.is("CLASS")          ? "END_CLASS"
                                                  : nullptr;
    if (end != nullptr) {
      if (scan.next() != Kind::Word) continue;
      while (scan.is("FINAL") || scan.is("ABSTRACT") || scan.is("PUBLIC") || scan.is("INTERNAL")) scan.next();
      block.names.push_back(scan.token());
      Kind after = scan.next();
      if (after == Kind::Word && scan.is("EXTENDS")) after = scanBase(scan, block.base);
      if (after != Kind::Word || !scan.is(end)) skipTo(scan, end);
      skipActions(scan);
    } else if (scan.is("TYPE")) {
      scanTypes(scan, block.names, bare);
    } else if (scan.is("VAR_GLOBAL")) {
      scanGlobals(scan, block.names);
    } else {
      continue;
    }
    block.end = scan.end();
    blocks.push_back(std::move(block));
    block = {};
    has_pragma = false;
    bare = true;
  }
  return blocks;
}

// A Namespace for each library among the sources.
static void addLibraryProjects(Context& context) {
  Libraries& libraries = context.scopes.libraries;
  for (const LibraryProject& library : context.project.options.library_projects) {
    const auto index = static_cast<uint32_t>(libraries.list.size());
    libraries.list.emplace_back();
    libraries.list.back().of_library = true;
    std::string shown = library.names.empty() ? "" : library.names.front();
    for (char& c : shown)
      if (!isNameCharacter(c)) c = '_';
    libraries.list.back().name = context.names().intern(shown);
    for (const std::string& name : library.names)
      libraries.namespaces.insert(keyOf(context, context.names().intern(name)),
                                  Entity::of(EntityKind::Namespace, index));
    for (const FileId file : library.files) {
      if (libraries.of_source.size() <= file.index) libraries.of_source.resize(file.index + 1, kNoLibrary);
      libraries.of_source[file.index] = index;
    }
  }
}

void indexLibraries(Context& context) {
  Libraries& libraries = context.scopes.libraries;
  const auto files = context.project.options.libraries;
  const uint8_t dialect = bitOf(context.symbols.profile.dialect);
  libraries.library_of_file.resize(files.size());
  libraries.sources.resize(files.size());
  for (uint32_t f = 0; f < files.size(); ++f) {
    if (files[f].hidden_by != nullptr) {
      for (const IndexedBlock& block : indexLibrary(files[f].source))
        for (const std::string_view name : block.names)
          libraries.hidden.insert(keyOf(context, context.names().intern(name)), Entity::of(EntityKind::Namespace, f));
      continue;
    }
    const NameId name = context.names().intern(files[f].library);
    const NameId key = keyOf(context, name);
    Entity space = libraries.namespaces.find(key);
    if (!space) {
      space = Entity::of(EntityKind::Namespace, static_cast<uint32_t>(libraries.list.size()));
      libraries.namespaces.insert(key, space);
      libraries.list.emplace_back().name = name;
    }
    libraries.library_of_file[f] = space.index;
    libraries.sources[f] = files[f].file;
    for (const IndexedBlock& block : indexLibrary(files[f].source)) {
      if ((block.standards & dialect) == 0) continue;
      const auto number = static_cast<uint32_t>(libraries.blocks.size());
      libraries.blocks.push_back({f, block.begin, block.end, false, (block.qualified & dialect) != 0});
      if (!block.base.empty()) libraries.extended.insert(keyOf(context, context.names().intern(block.base)), space);
      for (const std::string_view spelling_of_name : block.names) {
        const NameId spelling = context.names().intern(spelling_of_name);
        const NameId declared = keyOf(context, spelling);
        const auto entry = static_cast<uint32_t>(libraries.names.size());
        libraries.names.push_back({spelling, number, 0});
        if (libraries.index.insert(declared, Entity::of(EntityKind::Namespace, entry))) continue;
        uint32_t last = libraries.index.find(declared).index;
        while (libraries.names[last].next != 0) last = libraries.names[last].next;
        libraries.names[last].next = entry;
      }
    }
  }
  libraries.project = static_cast<uint32_t>(libraries.list.size());
  libraries.list.emplace_back();
  for (const std::string& name : context.project.options.project_names)
    libraries.namespaces.insert(keyOf(context, context.names().intern(name)),
                                Entity::of(EntityKind::Namespace, libraries.project));
  addLibraryProjects(context);
  for (const LibraryAlias& alias : context.project.options.library_aliases) {
    const Entity space = libraries.namespaces.find(keyOf(context, context.names().intern(alias.library)));
    const NameId key = keyOf(context, context.names().intern(alias.alias));
    if (space && !libraries.namespaces.insert(key, space))
      libraries.list[libraries.namespaces.find(key).index].also = space.index;
  }
}

namespace {

void load(Context& context, LibraryBlock& block) {
  block.loaded = true;
  Libraries& libraries = context.scopes.libraries;
  Symbols& symbols = context.symbols;
  const LibraryFile& file = context.project.options.libraries[block.file];
  FileId& source = libraries.sources[block.file];
  if (!source) source = symbols.sources.add(file.path, std::string(file.source));
  if (!source) return;
  const uint32_t base = symbols.sources.begin(source).offset;
  const FileId from = source;
  const uint32_t library = libraries.library_of_file[block.file];
  const Slice<DeclId> decls =
      text::parseDeclarations(symbols.arena, symbols.names, symbols.sources, Loc{base + block.begin},
                              Loc{base + block.end}, Dialect::Library, symbols.diagnostics);
  Context there = at(context, {}, from, true);
  for (uint32_t i = 0; i < decls.count; ++i) collectDecl(there, symbols.tree.list(decls)[i], from, library);
}

}  // namespace

static Entity findInLibraries(Context& context, NameId key, uint32_t library) {
  Libraries& libraries = context.scopes.libraries;
  if (library == libraries.project) {
    for (const NameMap* names : {&context.scopes.pous_and_types, &context.scopes.namespaces, &context.scopes.globals,
                                 &context.scopes.qualifiers})
      if (const Entity found = names->find(key)) return found;
    return {};
  }
  const Entity first = libraries.index.find(key);
  if (!first) return {};
  if (library == kNoLibrary && context.library) {  // a library's own names come first
    for (uint32_t f = 0; f < libraries.sources.size(); ++f) {
      if (!(libraries.sources[f] == context.file)) continue;
      if (const Entity own = findInLibraries(context, key, libraries.library_of_file[f])) return own;
      break;
    }
  }
  for (uint32_t n = first.index; n != 0; n = libraries.names[n].next) {
    LibraryBlock& block = libraries.blocks[libraries.names[n].block];
    const uint32_t from = libraries.library_of_file[block.file];
    if (library == kNoLibrary ? block.qualified : from != library) continue;
    if (!block.loaded) {
      load(context, block);
      resolveDeclarations(context);
    }
    if (const Entity found = libraries.list[from].names.find(key)) return found;
  }
  return {};
}

// The library whose declaration the bare name means, unless the project has one; independent of what is loaded.
static uint32_t libraryOfBareName(const Libraries& libraries, NameId key) {
  const Entity first = libraries.index.find(key);
  if (!first) return kNoLibrary;
  uint32_t chosen = first.index;
  while (chosen != 0 && libraries.blocks[libraries.names[chosen].block].qualified)
    chosen = libraries.names[chosen].next;
  if (chosen == 0) chosen = first.index;
  return libraries.library_of_file[libraries.blocks[libraries.names[chosen].block].file];
}

NameId uniqueNameInLibrary(Context& context, uint32_t library, NameId name) {
  const NameId key = keyOf(context, name);
  const Libraries& libraries = context.scopes.libraries;
  const uint32_t meant = libraryOfBareName(libraries, key);
  if (!context.scopes.pous_and_types.find(key) && (meant == library || meant == kNoLibrary)) return name;
  return context.names().intern(toString(context, libraries.list[library].name) + "__" + toString(context, name));
}

NameId nameWithLibrary(Context& context, uint32_t library, NameId name) {
  const Namespace& space = context.scopes.libraries.list[library];
  return context.names().intern(toString(context, space.name) + "." + toString(context, name));
}

Entity lookUpLibrary(Context& context, NameId key, uint32_t library) {
  const Entity own = findInLibraries(context, key, library);
  if (own || library == kNoLibrary) return own;
  const uint32_t also = context.scopes.libraries.list[library].also;
  if (const Entity other = also == kNoLibrary ? Entity{} : findInLibraries(context, key, also)) return other;
  return context.scopes.libraries.namespaces.find(key);  // a library used by a library: SysFile.SysTypes
}

Entity lookUpSystem(Context& context, std::string_view name) {
  const Entity system = context.scopes.libraries.namespaces.find(keyOf(context, context.names().intern("__SYSTEM")));
  return system ? lookUpLibrary(context, keyOf(context, context.names().intern(name)), system.index) : Entity{};
}

TypeId anyType(Context& context) {
  const Entity found = lookUpSystem(context, "AnyType");
  return found.entityKind() == EntityKind::Type ? TypeId{found.index} : types::kError;
}

}  // namespace rung::sema
