// SPDX-License-Identifier: Apache-2.0
#include "frontend/parse/conditions.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/parse/diagnostics.h"
#include "frontend/parse/foreign.h"
#include "frontend/source/dialect.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/tree.h"

namespace rung::text {
namespace {

enum class Truth : uint8_t { No, Yes, Unknown };  // Unknown: asks about a declaration that has not been parsed yet

Truth both(Truth a, Truth b) {
  if (a == Truth::No || b == Truth::No) return Truth::No;
  return a == Truth::Unknown || b == Truth::Unknown ? Truth::Unknown : Truth::Yes;
}
Truth either(Truth a, Truth b) {
  if (a == Truth::Yes || b == Truth::Yes) return Truth::Yes;
  return a == Truth::Unknown || b == Truth::Unknown ? Truth::Unknown : Truth::No;
}
Truth opposite(Truth a) { return a == Truth::Unknown ? a : a == Truth::Yes ? Truth::No : Truth::Yes; }
Truth truth(bool value) { return value ? Truth::Yes : Truth::No; }

// ---- declarations

// The declared names of a project that conditions can ask about.
class Declared {
 public:
  Declared(const Tree& tree, const Names& names, const Sources& sources);

  struct Row {
    std::string_view kind;  // "variable", "type", "pou", "task" or "resource"
    Loc begin, end;         // of the POU that declares the variable; none: visible everywhere
    Slice<Pragma> pragmas;
    TypeExprId type;
  };
  // The declaration of the name that is visible at `loc`; null: not declared.
  const Row* find(std::string_view kind, std::string_view name, Loc loc) const;
  bool hasAttribute(const Row& row, std::string_view attribute) const;
  bool hasType(const Row& row, std::string_view type) const;

 private:
  void add(Slice<DeclId> decls, Loc begin, Loc end);
  void addNamed(NameId name, Row row) { rows_.emplace(names_.key(name).index, row); }

  const Tree& tree_;
  const Names& names_;
  const Sources& sources_;
  std::unordered_multimap<uint32_t, Row> rows_;
};

Declared::Declared(const Tree& tree, const Names& names, const Sources& sources)
    : tree_(tree), names_(names), sources_(sources) {
  for (const FileUnit& unit : tree.files) add(unit.decls, {}, {});
}

void Declared::add(Slice<DeclId> decls, Loc begin, Loc end) {
  for (const DeclId id : tree_.list(decls)) {
    const Slice<Pragma> pragmas = tree_.decl(id).pragmas;
    switch (tree_.kind(id)) {
      case DeclKind::Type: addNamed(tree_.as<TypeDecl>(id).name, {"type", {}, {}, pragmas, {}}); break;
      case DeclKind::Task: addNamed(tree_.as<TaskDecl>(id).name, {"task", {}, {}, pragmas, {}}); break;
      case DeclKind::Configuration: add(tree_.as<ConfigurationDecl>(id).members, {}, {}); break;
      case DeclKind::Section: add(tree_.as<SectionDecl>(id).vars, begin, end); break;
      case DeclKind::Property:
      case DeclKind::Using:
      case DeclKind::ProgramInstance: break;
      case DeclKind::Namespace: add(tree_.as<NamespaceDecl>(id).decls, {}, {}); break;
      case DeclKind::Resource: {
        const ResourceDecl& resource = tree_.as<ResourceDecl>(id);
        addNamed(resource.name, {"resource", {}, {}, pragmas, {}});
        add(resource.members, {}, {});
        break;
      }
      case DeclKind::Pou: {
        const PouDecl& pou = tree_.as<PouDecl>(id);
        addNamed(pou.name, {"pou", {}, {}, pragmas, {}});
        add(pou.sections, pou.h.begin, pou.h.end);
        break;
      }
      case DeclKind::Var: {
        const VarDecl& var = tree_.as<VarDecl>(id);
        for (const Ident& name : tree_.list(var.names))
          addNamed(name.name, {"variable", begin, end, pragmas, var.type});
        break;
      }
    }
  }
}

const Declared::Row* Declared::find(std::string_view kind, std::string_view name, Loc loc) const {
  const NameId id = names_.find(name);
  if (!id) return nullptr;
  const Row* found = nullptr;
  const auto [first, last] = rows_.equal_range(names_.key(id).index);
  for (auto it = first; it != last; ++it) {
    const Row& row = it->second;
    if (row.kind != kind || (row.begin && (loc < row.begin || row.end <= loc))) continue;
    if (found == nullptr || row.begin) found = &row;  // a local variable hides a global one
  }
  return found;
}

bool Declared::hasAttribute(const Row& row, std::string_view attribute) const {
  for (const Pragma& pragma : tree_.list(row.pragmas))
    if (sameIdentifier(names_.string(pragma.name), attribute)) return true;
  return false;
}

bool Declared::hasType(const Row& row, std::string_view type) const {
  return row.type && sameIdentifier(sources_.tokenAt(tree_.loc(row.type)), type);
}

// ---- one file

struct Blank {
  uint32_t begin, end;  // in the file
};

class FileConditions {
 public:
  FileConditions(std::string_view text, Loc base, std::vector<Define> defines, Dialect dialect,
                 const Declared* declared, Diagnostics& diagnostics)
      : source_(text),
        base_(base),
        defines_(std::move(defines)),
        profile_(profileOf(dialect)),
        declared_(declared),
        diagnostics_(diagnostics) {}

  void run();

  std::vector<Blank> blanks;
  bool asked = false;  // a condition asked about a declaration

 private:
  struct Open {
    uint32_t at;
    bool around;  // the code around it is read
    bool reads;   // the current branch is read
    bool chosen;  // a branch was read, or may be when declarations are known
    bool has_else;
  };
  bool reads() const { return open_.empty() || open_.back().reads; }
  Loc loc(size_t at) const { return {base_.offset + static_cast<uint32_t>(at)}; }
  size_t pragma(size_t at);
  bool directive(uint32_t at);
  void choose(Open& open, Truth value);

  void define(bool set);
  const Define* find(std::string_view name) const;

  // ---- the condition
  Truth condition();
  Truth disjunction();
  Truth conjunction();
  bool acceptWord(std::string_view wanted);
  Truth negation();
  Truth question(std::string_view word);
  Truth ask(std::string_view kind, std::string_view name, std::string_view function, std::string_view value);
  void skipBlanks();
  std::string_view word();
  bool accept(char c);
  bool quoted(std::string_view& out);
  Truth failed();

  std::string_view source_;
  Loc base_;
  std::vector<Define> defines_;
  const LanguageProfile& profile_;
  const Declared* declared_;
  Diagnostics& diagnostics_;
  std::vector<Open> open_;
  size_t blank_from_ = 0;          // of the excluded part
  size_t p_ = 0, pragma_end_ = 0;  // in the current pragma
  uint32_t depth_ = 0;
  bool failed_ = false;
};

constexpr uint32_t kMaxConditionDepth = 100;

void FileConditions::run() {
  size_t at = 0;
  while (at < source_.size()) {
    const char c = source_[at], next = at + 1 < source_.size() ? source_[at + 1] : '\0';
    if (c == '/' && next == '/') {
      at = std::min(source_.find('\n', at), source_.size());
    } else if ((c == '(' || c == '/') && next == '*') {
      at = endOfComment(source_, at, profile_.nested_comments);
    } else if (c == '\'' || c == '"') {
      at = endOfString(source_, at);
    } else if (c == '{') {
      at = pragma(at);
    } else {
      ++at;
    }
  }
  for (const Open& open : open_) diagnostics_.report(diag::ConditionNotClosed, loc(open.at)).length(1);
  if (!reads()) blanks.push_back({static_cast<uint32_t>(blank_from_), static_cast<uint32_t>(source_.size())});
}

// Returns the offset after the pragma.
size_t FileConditions::pragma(size_t at) {
  size_t end = endOfDoubleBrace(source_, at);
  if (end != std::string_view::npos) return end;
  end = endOfPragma(source_, at) - 1;
  if (end == at || source_[end] != '}') return at + 1;  // reported by the lexer
  p_ = at + 1;
  pragma_end_ = end;
  const bool read = reads();
  if (!directive(static_cast<uint32_t>(at))) return end + 1;
  if (!read) {
    blanks.push_back({static_cast<uint32_t>(blank_from_), static_cast<uint32_t>(end + 1)});
  } else {
    blanks.push_back({static_cast<uint32_t>(at), static_cast<uint32_t>(end + 1)});
  }
  blank_from_ = end + 1;
  return end + 1;
}

void FileConditions::choose(Open& open, Truth value) {
  open.reads = open.around && !open.chosen && value == Truth::Yes;
  open.chosen = open.chosen || value != Truth::No;
}

// False: a pragma of another kind, which is kept.
bool FileConditions::directive(uint32_t at) {
  const std::string_view name = word();
  if (holdsC(source_.substr(at + 1, pragma_end_ - at - 1)) && !sameIdentifier(name, "define")) return false;
  const bool is_if = sameIdentifier(name, "IF"), is_elsif = sameIdentifier(name, "ELSIF"),
             is_else = sameIdentifier(name, "ELSE"), is_end = sameIdentifier(name, "END_IF"),
             is_define = sameIdentifier(name, "define"), is_undefine = sameIdentifier(name, "undefine");
  if (is_define || is_undefine) {
    if (reads()) define(is_define);
    return true;
  }
  if (is_if) {
    const bool around = reads();
    open_.push_back({at, around, false, false, false});
    // Conditions in excluded code are not evaluated.
    choose(open_.back(), around ? condition() : Truth::No);
    return true;
  }
  if (!is_elsif && !is_else && !is_end) return false;
  if (open_.empty() || (!is_end && open_.back().has_else)) {
    diagnostics_.report(diag::ConditionStray, loc(at), {name})
        .length(static_cast<uint32_t>(pragma_end_ + 1 - at))
        .remove(loc(at), loc(pragma_end_ + 1), std::string("{").append(name).append("}"), Sureness::Proposal);
    return true;
  }
  Open& open = open_.back();
  if (is_end) {
    open_.pop_back();
  } else if (is_else) {
    open.has_else = true;
    choose(open, Truth::Yes);
  } else {
    choose(open, open.around && !open.chosen ? condition() : Truth::No);
  }
  return true;
}

// {define NAME}  {define NAME value}  {define NAME 'value'}  {undefine NAME}
void FileConditions::define(bool set) {
  const std::string_view name = word();
  skipBlanks();
  std::string_view value;
  if (!quoted(value)) value = source_.substr(p_, pragma_end_ - p_);
  while (!value.empty() && static_cast<unsigned char>(value.back()) <= ' ') value.remove_suffix(1);
  if (name.empty()) {
    failed();
    return;
  }
  std::erase_if(defines_, [&](const Define& d) { return sameIdentifier(d.name, name); });
  if (set) defines_.push_back({std::string(name), std::string(value)});
}

const Define* FileConditions::find(std::string_view name) const {
  const auto found =
      std::find_if(defines_.rbegin(), defines_.rend(), [&](const Define& d) { return sameIdentifier(d.name, name); });
  return found == defines_.rend() ? nullptr : &*found;
}

// ---- conditions

void FileConditions::skipBlanks() {
  while (p_ < pragma_end_ && static_cast<unsigned char>(source_[p_]) <= ' ') ++p_;
}

std::string_view FileConditions::word() {
  skipBlanks();
  const size_t begin = p_;
  while (p_ < pragma_end_ && isNameCharacter(source_[p_])) ++p_;
  return source_.substr(begin, p_ - begin);
}

bool FileConditions::accept(char c) {
  skipBlanks();
  if (p_ >= pragma_end_ || source_[p_] != c) return false;
  ++p_;
  return true;
}

bool FileConditions::quoted(std::string_view& out) {
  skipBlanks();
  if (p_ >= pragma_end_ || (source_[p_] != '\'' && source_[p_] != '"')) return false;
  const size_t close = source_.find(source_[p_], p_ + 1);
  if (close >= pragma_end_) return false;
  out = source_.substr(p_ + 1, close - p_ - 1);
  p_ = close + 1;
  return true;
}

// One error per pragma, where it cannot be parsed.
Truth FileConditions::failed() {
  if (!failed_) {
    skipBlanks();
    const size_t at = std::min(p_, pragma_end_);
    diagnostics_.report(diag::ConditionForm, loc(at)).length(1);
  }
  failed_ = true;
  return Truth::No;
}

// condition = conjunction {OR conjunction}, up to the closing brace
Truth FileConditions::condition() {
  failed_ = false;
  depth_ = 0;
  const Truth value = disjunction();
  skipBlanks();
  return p_ == pragma_end_ || failed_ ? value : failed();
}

Truth FileConditions::disjunction() {
  Truth value = conjunction();
  while (acceptWord("OR")) value = either(value, conjunction());
  return value;
}

Truth FileConditions::conjunction() {
  Truth value = negation();
  while (acceptWord("AND")) value = both(value, negation());
  return value;
}

bool FileConditions::acceptWord(std::string_view wanted) {
  const size_t before = p_;
  if (sameIdentifier(word(), wanted)) return true;
  p_ = before;
  return false;
}

// negation = {NOT} ( "(" condition ")" | question )
Truth FileConditions::negation() {
  bool negated = false;
  std::string_view name = word();
  for (; sameIdentifier(name, "NOT"); name = word()) negated = !negated;
  Truth value;
  if (name.empty()) {
    if (depth_ >= kMaxConditionDepth || !accept('(')) return failed();
    ++depth_;
    value = disjunction();
    --depth_;
    if (!accept(')')) return failed();
  } else {
    value = question(name);
  }
  return negated ? opposite(value) : value;
}

// question = defined "(" [kind ":"] name ")" | hasvalue "(" name "," string ")"
//          | hasattribute "(" kind ":" name "," string ")" | hastype "(" variable ":" name "," type ")"
Truth FileConditions::question(std::string_view function) {
  const bool defined = sameIdentifier(function, "defined"), has_value = sameIdentifier(function, "hasvalue"),
             has_attribute = sameIdentifier(function, "hasattribute"), has_type = sameIdentifier(function, "hastype");
  if (!defined && !has_value && !has_attribute && !has_type) {
    p_ -= function.size();
    return failed();
  }
  if (!accept('(')) return failed();
  std::string_view name = word(), kind, value;
  if (accept(':')) {
    kind = name;
    name = word();
  }
  if (name.empty() || (kind.empty() && (has_attribute || has_type)) || (!kind.empty() && has_value)) return failed();
  if (!defined) {
    if (!accept(',')) return failed();
    if (!quoted(value)) value = word();
    if (value.empty() && !has_value) return failed();
  }
  if (!accept(')')) return failed();
  if (!kind.empty()) return ask(kind, name, function, value);
  const Define* found = find(name);
  return truth(found != nullptr && (defined || found->value == value));
}

Truth FileConditions::ask(std::string_view kind, std::string_view name, std::string_view function,
                          std::string_view value) {
  static constexpr std::string_view kKinds[] = {"variable", "type", "pou", "task", "resource"};
  const std::string_view* known =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](std::string_view k) { return sameIdentifier(k, kind); });
  if (known == std::end(kKinds)) return failed();
  asked = true;
  if (declared_ == nullptr) return Truth::Unknown;
  const Declared::Row* row = declared_->find(*known, name, loc(p_));
  if (row == nullptr || sameIdentifier(function, "defined")) return truth(row != nullptr);
  return truth(sameIdentifier(function, "hastype") ? declared_->hasType(*row, value)
                                                   : declared_->hasAttribute(*row, value));
}

// Most sources have no condition: they are scanned once, for a brace followed by one of the keywords.
bool mayHaveConditions(std::string_view text) {
  return hasPragma(text, {"IF", "ELSIF", "ELSE", "END_IF", "define", "undefine"});
}

std::string blanked(std::string_view text, const std::vector<Blank>& blanks) {
  std::string out(text);
  for (const Blank& range : blanks)
    for (uint32_t i = range.begin; i < range.end; ++i)
      if (out[i] != '\n' && out[i] != '\r') out[i] = ' ';
  return out;
}

}  // namespace

bool applyConditions(Sources& sources, std::span<const FileId> files, std::span<const Define> defines, Dialect dialect,
                     Diagnostics& diagnostics) {
  std::vector<FileId> with;
  for (const FileId file : files)
    if (mayHaveConditions(sources.sourceText(file))) with.push_back(file);
  if (with.empty()) return false;

  const auto evaluate = [&](FileId file, const Declared* declared, Diagnostics& to) {
    FileConditions conditions(sources.sourceText(file), sources.begin(file), {defines.begin(), defines.end()}, dialect,
                              declared, to);
    conditions.run();
    return conditions;
  };
  // First pass: everything except conditions that ask about declarations. Errors are reported in the second pass.
  Diagnostics silent(sources);
  std::vector<std::string> texts(sources.fileCount() + 1);
  bool asked = false;
  for (const FileId file : with) {
    const FileConditions conditions = evaluate(file, nullptr, silent);
    asked |= conditions.asked;
    texts[file.index] = blanked(sources.sourceText(file), conditions.blanks);
  }
  Sources scratch;  // the same files at the same locations
  Tree tree;
  Names names;
  if (asked) {
    for (uint32_t i = 1; i < texts.size(); ++i) {
      if (texts[i].empty()) texts[i] = sources.sourceText(FileId{i});
      scratch.add(std::string(sources.path(FileId{i})), std::move(texts[i]));
    }
    Diagnostics dropped(scratch);
    for (const FileId file : files) parseFile(tree, names, scratch, file, dialect, dropped);
  }
  const Declared declared(tree, names, scratch);
  for (const FileId file : with) {
    const FileConditions conditions = evaluate(file, &declared, diagnostics);
    sources.activate(file, blanked(sources.sourceText(file), conditions.blanks));
  }
  return asked;
}

}  // namespace rung::text
