// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/edition.h"

#include <algorithm>
#include <set>

#include "frontend/source/files.h"
#include "frontend/syntax/children.h"
#include "tools/conformance/program.h"

namespace rung::conformance {
namespace {

constexpr const char* kOfEdition3 = " of edition 3";
constexpr const char* kOfNone = " not of the standard";
constexpr int kOnlyEdition3 = 4;  // in keywords.tsv

constexpr const char* kFunctionBlocks[] = {"SR",   "RS", "R_TRIG", "F_TRIG", "CTU", "CTD",
                                           "CTUD", "TP", "TON",    "TOF",    "SEMA"};
constexpr const char* kBitStrings[] = {"BYTE", "WORD", "DWORD", "LWORD"};

template <size_t n>
bool isIn(const char* const (&list)[n], std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

// ---- the text: words, literals, signs

class Lexis {
 public:
  Lexis(int edition, const Source& source, const Vocabulary& vocabulary)
      : edition_(edition), source_(source), vocabulary_(vocabulary) {}

  std::string foreignWord() const {
    for (size_t i = 0; i < source_.units.size(); ++i) {
      if (!isName(i)) continue;
      std::string found = ofWord(i, upper(textOf(i)));
      if (!found.empty()) return found;
    }
    return {};
  }
  std::string foreign() const {
    for (size_t i = 0; i < source_.units.size(); ++i) {
      std::string found = ofUnit(i);
      if (!found.empty()) return found;
    }
    return {};
  }

 private:
  std::string_view textOf(size_t i) const {
    return i < source_.units.size() ? source_.textOf(source_.units[i]) : std::string_view();
  }
  bool isName(size_t i) const { return i < source_.units.size() && source_.units[i].kind == UnitKind::Name; }
  // The unit of code before `i`; units.size(): there is none.
  size_t before(size_t i) const {
    while (i-- > 0)
      if (source_.units[i].kind != UnitKind::Comment && source_.units[i].kind != UnitKind::Pragma) return i;
    return source_.units.size();
  }
  bool isFollowedBy(size_t i, std::string_view sign) const { return textOf(source_.nextCode(i)) == sign; }
  bool isPin(size_t i) const {
    const size_t colon = source_.nextCode(i);
    return textOf(colon) == ":" && textOf(colon + 1) == "=";
  }
  static bool hasForeignCharacters(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 128; });
  }

  std::string ofUnit(size_t i) const {
    const Unit& unit = source_.units[i];
    const std::string_view text = textOf(i);
    switch (unit.kind) {
      case UnitKind::Name: return ofName(i, upper(text));
      case UnitKind::Number: return ofNumber(i, text);
      case UnitKind::String:
        if (edition_ == 2 && hasForeignCharacters(text)) return "characters outside of ISO/IEC 646 are of edition 3";
        return {};
      case UnitKind::Other:
        if (edition_ == 2 && text == "%" && textOf(before(i)) == ".") return partOfBits();
        return {};
      case UnitKind::Comment:
        if (edition_ == 2 && (text.starts_with("//") || text.starts_with("/*")))
          return "this form of comment is of edition 3";
        return {};
      case UnitKind::Pragma:
      case UnitKind::End: return {};
    }
    return {};
  }
  static std::string partOfBits() { return "the part of a bit string is of edition 3"; }

  std::string ofWord(size_t i, const std::string& word) const {
    const std::string_view previous = textOf(before(i));
    const bool is_bit_row = word == "BIT" && previous != ":" && upper(previous) != "OF";
    const auto found = is_bit_row ? vocabulary_.words.end() : vocabulary_.words.find(word);
    const bool has_it = found == vocabulary_.words.end() || (found->second != 0 && found->second <= edition_);
    const bool is_instruction = word == "LD" || word == "LT" || ((word == "SET" || word == "RESET") && !isPin(i));
    if (!has_it && !(is_instruction && !isFollowedBy(i, "#")))
      return "`" + word + "` is" + (found->second == 0 ? kOfNone : kOfEdition3);
    return {};
  }
  std::string ofName(size_t i, const std::string& word) const {
    std::string foreign = ofWord(i, word);
    if (!foreign.empty()) return foreign;
    if ((word == "TIME" || word == "LTIME") && isFollowedBy(i, "(")) return "`" + word + "()` is" + kOfNone;
    if ((word == "STRING" || word == "WSTRING") && isFollowedBy(i, "("))
      return "a string length in parentheses is not of the standard";
    if (isFollowedBy(i, "#")) return ofTypedLiteral(i, word);
    if (isConversionOfCodes(word)) return "`" + word + "` is of edition 4";
    if (edition_ != 2) return {};
    if (word.starts_with("TO_") || word.starts_with("BCD_TO_") || word.find("_TO_BCD") != std::string::npos ||
        (word.find("_TRUNC_") != std::string::npos && isFollowedBy(i, "(")))
      return "`" + word + "` is" + kOfEdition3;
    // The pins of NOT: its call begins like an operand in parentheses.
    if (word == "NOT" && isFollowedBy(i, "(") && isPin(source_.nextCode(source_.nextCode(i))))
      return "in annex B of edition 2 NOT is an operator of ST";
    return {};
  }

  // CHAR_TO_USINT, UINT_TO_WCHAR: table 27 of edition 3 has characters and strings only.
  static bool isConversionOfCodes(std::string_view word) {
    const size_t at = word.find("_TO_");
    if (at == std::string_view::npos) return false;
    const auto isCharacter = [](std::string_view type) { return type == "CHAR" || type == "WCHAR"; };
    const auto isText = [&](std::string_view type) {
      return isCharacter(type) || type == "STRING" || type == "WSTRING";
    };
    const std::string_view from = word.substr(0, at), to = word.substr(at + 4);
    return (isCharacter(from) && !isText(to)) || (isCharacter(to) && !isText(from));
  }

  // REAL#1 has no point, T#1d5s leaves out the hours.
  std::string ofTypedLiteral(size_t i, const std::string& word) const {
    const size_t value = i + 2;
    if (word == "REAL" || word == "LREAL") {
      const size_t number = textOf(value) == "-" || textOf(value) == "+" ? value + 1 : value;
      const bool is_number = number < source_.units.size() && source_.units[number].kind == UnitKind::Number;
      if (is_number && textOf(number).find('.') == std::string_view::npos && textOf(number + 1) != ".")
        return "a REAL literal without a decimal point is not of the standard";
    }
    if ((word == "T" || word == "TIME") && edition_ == 2) return ofDuration(i);
    return {};
  }
  // In annex B.1.2.3.1 each unit is followed by the next smaller one.
  std::string ofDuration(size_t i) const {
    const size_t begin = source_.units[i + 1].end;
    const std::string_view text = source_.text();
    std::string units;
    for (size_t at = begin; at < text.size() && (isNameCharacter(text[at]) || text[at] == '.' || text[at] == '-');
         ++at) {
      const char c = upper(text[at]);
      if (c == 'D' || c == 'H') units += c;
      if (c == 'M') units += upper(text[at + 1]) == 'S' ? (++at, '_') : 'M';
      if (c == 'S') units += 'S';
      if (c == 'U' || c == 'N') return "units of less than a millisecond are of edition 3";
    }
    if (!units.empty() && std::string("DHMS_").find(units) == std::string::npos)
      return "a duration that leaves out a unit is of edition 3";
    return {};
  }

  std::string ofNumber(size_t i, std::string_view text) const {
    const size_t previous = before(i);
    const bool after_point = textOf(previous) == ".";
    const size_t base = after_point ? before(previous) : source_.units.size();
    if (edition_ == 2 && after_point && source_.units[i].begin == source_.units[previous].end &&
        (isName(base) || textOf(base) == "]"))
      return partOfBits();
    const bool is_decimal = text.find('#') == std::string_view::npos && textOf(i + 1) != "#" && textOf(previous) != "#";
    const size_t e = text.find_first_of("eE");
    if (is_decimal && !after_point && e != std::string_view::npos && e > 0 &&
        text.substr(0, e).find('.') == std::string_view::npos)
      return "a REAL literal without a decimal point is not of the standard";
    return {};
  }

  int edition_;
  const Source& source_;
  const Vocabulary& vocabulary_;
};

// ---- the tree: productions

class Productions {
 public:
  Productions(int edition, const Source& source, const Vocabulary& vocabulary)
      : edition_(edition), source_(source), tree_(source.tree), vocabulary_(vocabulary) {
    for (const DeclId id : source.decls) noteDeclaration(id);
  }

  std::string foreign() {
    for (const DeclId id : source_.decls) visit(id);
    return found_;
  }

 private:
  void noteDeclaration(DeclId id) {
    if (tree_.kind(id) == DeclKind::Namespace)
      for (const DeclId inner : tree_.list(tree_.as<NamespaceDecl>(id).decls)) noteDeclaration(inner);
    if (tree_.kind(id) == DeclKind::Type) {
      const auto& type = tree_.as<TypeDecl>(id);
      if (hasLength(type.type)) strings_.insert(key(type.name));
      if (type.type && tree_.kind(type.type) == TypeExprKind::Enum)
        for (const EnumItem& item : tree_.list(tree_.as<EnumTypeExpr>(type.type).items))
          items_.insert(key(item.item.name));
      return;
    }
    if (tree_.kind(id) != DeclKind::Pou) return;
    const auto& pou = tree_.as<PouDecl>(id);
    if (pou.pou_kind == PouKind::FunctionBlock || pou.pou_kind == PouKind::Class) blocks_.insert(key(pou.name));
    if (pou.pou_kind == PouKind::Function) functions_.insert(key(pou.name));
  }
  std::string key(NameId name) const { return upper(source_.names.string(name)); }

  void of3(std::string_view what) {
    if (edition_ == 2) note(what, kOfEdition3);
  }
  void ofNone(std::string_view what) { note(what, kOfNone); }
  void note(std::string_view what, std::string_view of) {
    if (!found_.empty()) return;
    found_.append(what);
    found_.append(of);
  }
  void name(NameId id) {
    const auto keyword = vocabulary_.keywords.find(key(id));
    if (!found_.empty() || keyword == vocabulary_.keywords.end()) return;
    const bool is_of_one = keyword->second == kOnlyEdition3 || keyword->second == 2;
    if (is_of_one && edition_ != (keyword->second == 2 ? 2 : 3)) return;
    found_ =
        "`" + source_.spelling(id) + "` is a keyword" + (is_of_one ? " of edition " + std::to_string(edition_) : "");
  }

  template <class Id>
  void visit(Id id) {
    if (!found_.empty()) return;
    check(id);
    forEachChild(tree_, id, [&](const auto& child) { visit(child); });
  }

  // ---- types

  // The name of a type that is written as one identifier.
  std::string nameOf(TypeExprId id) const {
    if (!id || tree_.kind(id) != TypeExprKind::Named) return {};
    const std::span<const Ident> path = tree_.list(tree_.as<NamedTypeExpr>(id).path);
    return path.size() == 1 ? key(path[0].name) : std::string();
  }
  bool isNamed(TypeExprId id, const std::set<std::string>& names) const { return names.count(nameOf(id)) != 0; }
  bool isBlock(TypeExprId id) const { return isIn(kFunctionBlocks, nameOf(id)) || isNamed(id, blocks_); }
  bool hasLength(TypeExprId id) const {
    return id && tree_.kind(id) == TypeExprKind::String && tree_.as<StringTypeExpr>(id).length;
  }
  bool isNumber(ExprId id) const {
    if (id && tree_.kind(id) == ExprKind::Unary) return isNumber(tree_.as<UnaryExpr>(id).operand);
    return id && tree_.kind(id) == ExprKind::Literal && tree_.as<LiteralExpr>(id).literal() == LiteralKind::Integer;
  }
  bool isPlainNumber(ExprId id) const {
    if (id && tree_.kind(id) == ExprKind::Unary) return isPlainNumber(tree_.as<UnaryExpr>(id).operand);
    return isNumber(id) && !tree_.as<LiteralExpr>(id).prefix && !tree_.as<LiteralExpr>(id).form.is_based;
  }

  void check(TypeExprId id) {
    switch (tree_.kind(id)) {
      case TypeExprKind::Array: return checkArray(tree_.as<ArrayTypeExpr>(id));
      case TypeExprKind::Enum: return checkEnumeration(tree_.as<EnumTypeExpr>(id));
      case TypeExprKind::Struct: return checkStructure(tree_.as<StructTypeExpr>(id));
      case TypeExprKind::Subrange: return checkSubrange(tree_.as<SubrangeTypeExpr>(id));
      case TypeExprKind::Named:
        if (tree_.list(tree_.as<NamedTypeExpr>(id).path).size() > 1) of3("a type in a namespace is");
        return;
      case TypeExprKind::String:
        if (hasLength(id) && !isPlainNumber(tree_.as<StringTypeExpr>(id).length))
          ofNone("a length of a string that is not a number is");
        return;
      case TypeExprKind::Error:
      case TypeExprKind::Pointer: return;
    }
  }
  void checkArray(const ArrayTypeExpr& array) {
    for (const ArrayBound& bound : tree_.list(array.bounds))
      for (const ExprId side : {bound.low, bound.high})
        if (!isPlainNumber(side)) of3("array bounds that are not numbers are");
    const TypeExprKind element = tree_.kind(array.element);
    if (element != TypeExprKind::Named && element != TypeExprKind::String && element != TypeExprKind::Pointer)
      ofNone("an array of elements whose type has no name is");
    if (hasLength(array.element)) of3("an array of STRING[n] is");
    if (isBlock(array.element)) of3("an array of function blocks is");
  }
  void checkEnumeration(const EnumTypeExpr& type) {
    if (type.base) of3("an enumeration with a base type is");
    for (const EnumItem& item : tree_.list(type.items)) {
      if (item.value) of3("items of enumerations with values are");
      name(item.item.name);
    }
  }
  void checkStructure(const StructTypeExpr& type) {
    if (type.fields.empty()) of3("a structure without elements is");
    if (type.base) ofNone("a structure with EXTENDS is");
    for (const DeclId id : tree_.list(type.fields)) {
      const auto& field = tree_.as<VarDecl>(id);
      if (field.located) of3("places in structures are");
      if (field.names.count > 1) ofNone("two elements of a structure in one declaration are");
      if (isBlock(field.type)) of3("a function block in a structure is");
      if (hasLength(field.type) || isNamed(field.type, strings_)) of3("STRING[n] in a structure is");
      if (field.type && tree_.kind(field.type) == TypeExprKind::Struct) ofNone("a structure without a name is");
    }
  }
  void checkSubrange(const SubrangeTypeExpr& type) {
    if (tree_.kind(type.base) == TypeExprKind::Named) {
      const std::span<const Ident> path = tree_.list(tree_.as<NamedTypeExpr>(type.base).path);
      if (!path.empty() && isIn(kBitStrings, key(path.back().name))) ofNone("a subrange of a bit string is");
    }
    if (!isPlainNumber(type.low) || !isPlainNumber(type.high)) of3("subranges whose limits are not numbers are");
  }

  // ---- declarations

  void check(DeclId id) {
    switch (tree_.kind(id)) {
      case DeclKind::Type: return name(tree_.as<TypeDecl>(id).name);
      case DeclKind::Pou: return checkPou(tree_.as<PouDecl>(id));
      case DeclKind::Section: return checkSection(tree_.as<SectionDecl>(id));
      case DeclKind::Var: return checkVariable(tree_.as<VarDecl>(id));
      case DeclKind::Configuration: return checkConfiguration(tree_.as<ConfigurationDecl>(id));
      case DeclKind::Resource: return checkResource(tree_.as<ResourceDecl>(id));
      case DeclKind::ProgramInstance: return checkProgramInstance(tree_.as<ProgramInstanceDecl>(id));
      case DeclKind::Property: return ofNone("PROPERTY is");
      case DeclKind::Namespace: return checkNamespace(tree_.as<NamespaceDecl>(id));
      case DeclKind::Using: return of3("USING is");
      case DeclKind::Task: return checkTask(tree_.as<TaskDecl>(id));
    }
  }
  void checkTask(const TaskDecl& task) {
    bool has_priority = false;
    for (const Argument& setting : tree_.list(task.settings))
      has_priority = has_priority || (setting.pin.name && key(setting.pin.name) == "PRIORITY");
    if (!has_priority) ofNone("a TASK without PRIORITY is");
  }
  void checkPou(const PouDecl& pou) {
    name(pou.name);
    if (pou.pou_kind == PouKind::Function) checkFunction(pou);
    for (const DeclId s : tree_.list(pou.sections)) checkSectionOf(pou, tree_.as<SectionDecl>(s));
    const bool has_own_body = pou.pou_kind == PouKind::Function || pou.pou_kind == PouKind::FunctionBlock ||
                              pou.pou_kind == PouKind::Program || pou.pou_kind == PouKind::Action;
    if (has_own_body && pou.body_kind == BodyKind::St && pou.body.empty()) of3("an empty body is");
    if (pou.body_kind == BodyKind::Il) checkInstructions(tree_.list(pou.il));
    for (const SfcStep& step : tree_.list(pou.steps)) checkStep(step);
    for (const SfcTransition& transition : tree_.list(pou.transitions)) checkTransition(transition);
  }
  void checkFunction(const PouDecl& pou) {
    if (!pou.result) of3("a function without a result is");
    if (hasLength(pou.result)) of3("STRING[n] as a result is");
    if (pou.result && tree_.kind(pou.result) != TypeExprKind::Named && tree_.kind(pou.result) != TypeExprKind::String)
      ofNone("a result whose type has no name is");
  }
  void checkSectionOf(const PouDecl& pou, const SectionDecl& section) {
    const SectionKind kind = section.section;
    if (kind == SectionKind::Global) of3("VAR_GLOBAL of a program is");
    if (pou.pou_kind == PouKind::Function && (kind == SectionKind::External || kind == SectionKind::Temp))
      of3("VAR_EXTERNAL and VAR_TEMP of functions are");
    if (kind == SectionKind::Input || kind == SectionKind::Output || kind == SectionKind::InOut)
      if (section.qualifiers.constant) ofNone("CONSTANT of an input, output or in-out is");
    for (const DeclId v : tree_.list(section.vars)) {
      if (tree_.kind(v) != DeclKind::Var) continue;
      const auto& var = tree_.as<VarDecl>(v);
      if (kind == SectionKind::External && var.names.count > 1)
        ofNone("two names in one declaration of VAR_EXTERNAL are");
      if (kind == SectionKind::External && hasLength(var.type)) of3("VAR_EXTERNAL of STRING[n] is");
      if (kind == SectionKind::External && var.init) ofNone("an initial value of VAR_EXTERNAL is");
      if (kind == SectionKind::Temp && var.init) of3("an initial value of VAR_TEMP is");
      if (kind == SectionKind::InOut && var.init) ofNone("an initial value of VAR_IN_OUT is");
      if (kind == SectionKind::Temp && isBlock(var.type)) ofNone("a function block in VAR_TEMP is");
      if (pou.pou_kind == PouKind::Function && kind == SectionKind::Local && isBlock(var.type))
        ofNone("a function block in a function is");
      if (pou.pou_kind != PouKind::Program && var.located && !var.address.incomplete)
        ofNone("a located variable of a function block is");
    }
  }
  void checkSection(const SectionDecl& section) {
    if (section.vars.empty()) of3("a section without variables is");
  }
  void checkVariable(const VarDecl& var) {
    for (const Ident& one : tree_.list(var.names)) name(one.name);
    if (var.init) checkInitialValue(var.init);
  }
  void checkInitialValue(ExprId id) {
    const ExprKind kind = tree_.kind(id);
    const bool is_item = kind == ExprKind::Name && items_.count(key(tree_.as<NameExpr>(id).name)) != 0;
    const bool is_sign = kind == ExprKind::Unary && tree_.kind(tree_.as<UnaryExpr>(id).operand) == ExprKind::Literal;
    const bool is_operation =
        kind == ExprKind::Name || kind == ExprKind::Unary || kind == ExprKind::Binary || kind == ExprKind::Call;
    if (is_operation && !is_item && !is_sign) of3("initial values that are expressions are");
  }
  void checkConfiguration(const ConfigurationDecl& configuration) {
    name(configuration.name);
    bool runs = false;
    for (const DeclId member : tree_.list(configuration.members)) {
      runs = runs || tree_.kind(member) == DeclKind::Resource || tree_.kind(member) == DeclKind::ProgramInstance;
    }
    if (!runs) ofNone("a CONFIGURATION without a program is");
  }
  void checkProgramInstance(const ProgramInstanceDecl& instance) {
    name(instance.name);
    for (const Argument& connection : tree_.list(instance.arguments))
      if (connection.negated) ofNone("NOT of a connection of a program is");
  }
  void checkNamespace(const NamespaceDecl& space) {
    of3("NAMESPACE is");
    for (const DeclId member : tree_.list(space.decls))
      if (tree_.kind(member) == DeclKind::Section) ofNone("VAR_GLOBAL of a namespace is");
  }
  void checkResource(const ResourceDecl& resource) {
    name(resource.name);
    bool runs = false;
    for (const DeclId member : tree_.list(resource.members)) {
      runs = runs || tree_.kind(member) == DeclKind::ProgramInstance;
    }
    if (!runs) ofNone("a RESOURCE without a program is");
  }

  // ---- bodies

  void checkStep(const SfcStep& step) {
    name(step.name.name);
    if (step.min.value || step.max.value) ofNone("TMIN and TMAX of a step are");
    for (const SfcAssociation& one : tree_.list(step.actions)) {
      if (one.qualifier == SfcQualifier::Entry || one.qualifier == SfcQualifier::Active ||
          one.qualifier == SfcQualifier::Exit || (one.word && key(one.word) == "R0"))
        ofNone("this qualifier of an action is");
      if (one.time.value && tree_.kind(one.time.value) != ExprKind::Literal &&
          tree_.kind(one.time.value) != ExprKind::Name)
        ofNone("a time of an action that is neither a duration nor a variable is");
    }
  }
  // Annex B.1.6: a simple instruction list, which neither jumps nor calls.
  void checkTransition(const SfcTransition& transition) {
    const bool is_elsewhere = !transition.body && !transition.condition.value;
    if (is_elsewhere || transition.from.empty()) of3("a condition apart from its transition is");
    if (!transition.body) return;
    if (tree_.as<PouDecl>(transition.body).body_kind == BodyKind::St) ofNone("a condition of statements is");
    for (const IlInstruction& one : tree_.list(tree_.as<PouDecl>(transition.body).il))
      if (one.kind == IlKind::Jump || one.kind == IlKind::Call || one.kind == IlKind::Return)
        ofNone("a condition in IL that jumps, calls or returns is");
  }
  // Operators of jumps, calls and returns have N only after C; a list of pins has a line for each.
  void checkInstructions(std::span<const IlInstruction> list) {
    for (const IlInstruction& one : list) {
      if (isIn({"JMPN", "CALN", "RETN"}, key(one.word)))
        ofNone("`" + source_.spelling(one.word) + "`, N without C, is");
      if ((one.flags & kIlAttempt) != 0) of3("`ST?` is");
      if ((one.flags & kIlDeferred) != 0) checkDeferred(one);
      const bool in_parentheses = (one.flags & kIlInParens) != 0 && (one.flags & kIlFormal) == 0;
      if (in_parentheses && (one.kind == IlKind::Binary || one.kind == IlKind::Function))
        ofNone("a list of operands in parentheses is");
    }
  }
  // `ADD( 5` ends its line: the operator's instructions follow, and the parenthesis closes on a line of its own.
  void checkDeferred(const IlInstruction& one) {
    if (one.kind == IlKind::Function) ofNone("a deferred function is");
    const auto open = std::find_if(source_.unitAt(source_.at(one.loc)), source_.units.end(),
                                   [&](const Unit& unit) { return source_.textOf(unit) == "("; });
    if (open == source_.units.end()) return;
    const size_t end = std::min(source_.text().find('\n', open->end), source_.text().size());
    if (source_.text().substr(open->end, end - open->end).find(')') != std::string_view::npos)
      ofNone("a deferred operator that closes on its line is");
  }

  void check(StmtId id) {
    switch (tree_.kind(id)) {
      case StmtKind::Jump:
      case StmtKind::Label:
        if (tree_.stmt(id).loc && source_.sources.fileOf(tree_.stmt(id).loc) == source_.file) ofNone("a jump in ST is");
        return;
      case StmtKind::Call: return checkCall(tree_.as<CallStmt>(id).call);
      case StmtKind::Case: return checkCase(tree_.as<CaseStmt>(id));
      case StmtKind::For: {
        const auto& loop = tree_.as<ForStmt>(id);
        if (loop.control && tree_.kind(loop.control) != ExprKind::Name)
          ofNone("a control variable that is not an identifier is");
        return checkList(loop.body);
      }
      case StmtKind::If: {
        const auto& stmt = tree_.as<IfStmt>(id);
        for (const IfBranch& branch : tree_.list(stmt.branches)) checkList(branch.body);
        return;
      }
      case StmtKind::While: return checkList(tree_.as<WhileStmt>(id).body);
      case StmtKind::Repeat: return checkList(tree_.as<RepeatStmt>(id).body);
      case StmtKind::Try: return ofNone("__TRY is");
      case StmtKind::Assign:
        if (tree_.as<AssignStmt>(id).op() != AssignOp::Assign && tree_.as<AssignStmt>(id).op() != AssignOp::Attempt)
          ofNone("`" + std::string(spelling(tree_.as<AssignStmt>(id).op())) + "` is");
        return;
      case StmtKind::Error:
      case StmtKind::Empty:
      case StmtKind::Exit:
      case StmtKind::Continue:
      case StmtKind::Return: return;
    }
  }
  void checkList(Slice<StmtId> list) {
    if (list.empty()) of3("an empty list of statements is");
  }
  void checkCall(ExprId id) {
    if (!id || tree_.kind(id) != ExprKind::Call) return;
    const auto& call = tree_.as<CallExpr>(id);
    if (call.is_bare) ofNone("a call without parentheses is");
    if (tree_.kind(call.callee) != ExprKind::Name) return of3("a call of anything but an identifier is");
    if (functions_.count(key(tree_.as<NameExpr>(call.callee).name)) != 0) of3("a function called as a statement is");
  }
  void checkCase(const CaseStmt& stmt) {
    if (stmt.branches.empty()) ofNone("a CASE without a branch is");
    for (const CaseBranch& branch : tree_.list(stmt.branches)) {
      checkList(branch.body);
      for (const ExprId label : tree_.list(branch.labels)) checkLabel(label);
    }
  }
  void checkLabel(ExprId id) {
    if (tree_.kind(id) == ExprKind::Range) {
      checkLabel(tree_.as<RangeExpr>(id).low);
      return checkLabel(tree_.as<RangeExpr>(id).high);
    }
    const bool is_item = tree_.kind(id) == ExprKind::TypedName ||
                         (tree_.kind(id) == ExprKind::Name && items_.count(key(tree_.as<NameExpr>(id).name)) != 0);
    if (!is_item && !isPlainNumber(id)) of3("a label of CASE that is neither a number nor an item is");
  }

  void check(ExprId id) {
    if (tree_.kind(id) == ExprKind::Unary && tree_.as<UnaryExpr>(id).op() == UnaryOp::Plus) of3("the sign + is");
    if (tree_.kind(id) == ExprKind::Repeat && tree_.as<RepeatExpr>(id).elements.count > 1)
      ofNone("several values in a repetition are");
    if (tree_.kind(id) == ExprKind::Assign) ofNone("an assignment in an expression is");
    if (tree_.kind(id) == ExprKind::Call) checkPins(tree_.as<CallExpr>(id));
  }
  // The library's pins by other names.
  void checkPins(const CallExpr& call) {
    if (tree_.kind(call.callee) != ExprKind::Name) return;
    const auto function = vocabulary_.keywords.find(key(tree_.as<NameExpr>(call.callee).name));
    if (function == vocabulary_.keywords.end() || function->second != 2) return;
    for (const Argument& argument : tree_.list(call.arguments))
      if (argument.pin.name && isIn({"STR", "STR1", "STR2", "SIZE", "LEN", "POS"}, key(argument.pin.name)))
        ofNone("the name `" + source_.spelling(argument.pin.name) + "` of a pin is");
  }
  static bool isIn(std::initializer_list<const char*> list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  }
  template <size_t n>
  static bool isIn(const char* const (&list)[n], std::string_view word) {
    return conformance::isIn(list, word);
  }

  int edition_;
  const Source& source_;
  const Tree& tree_;
  const Vocabulary& vocabulary_;
  std::set<std::string> items_, blocks_, functions_, strings_;
  std::string found_;
};

std::string readWords(const std::string& root, const std::string& name, std::map<std::string, int>& words) {
  const std::string path = "tools/conformance/" + name;
  const ReadResult read = readFile(root + "/" + path);
  if (!read.error.empty()) return path + ": " + read.error;
  for (const std::string& line : linesOf(read.content)) {
    const size_t tab = line.find('\t');
    if (tab != std::string::npos) words[line.substr(0, tab)] = line[tab + 1] - '0';
  }
  return {};
}

}  // namespace

std::string readVocabulary(const std::string& root, Vocabulary& vocabulary) {
  std::string problem = readWords(root, "words.tsv", vocabulary.words);
  return problem.empty() ? readWords(root, "keywords.tsv", vocabulary.keywords) : problem;
}

std::string foreignWordIn(const Source& source, int edition, const Vocabulary& vocabulary) {
  return Lexis(edition, source, vocabulary).foreignWord();
}

std::string foreignTo(int edition, const Source& source, const Vocabulary& vocabulary) {
  std::string found = Lexis(edition, source, vocabulary).foreign();
  return found.empty() ? Productions(edition, source, vocabulary).foreign() : found;
}

}  // namespace rung::conformance
