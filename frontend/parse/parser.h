// The parser of Structured Text: recursive descent for declarations and statements, precedence climbing for
// expressions, over the token array of lexer.h whose blocks recover.h has balanced. Private to frontend/parse:
// parser.cpp (files, POUs, configurations), objects.cpp, declarations.cpp, types.cpp, initial_values.cpp,
// statements.cpp, expressions.cpp, il.cpp, sfc.cpp, network.cpp.
//
// Errors. fail() reports and sets panic_: no further errors are reported until the current construct has found its
// synchronization point (`;`, a keyword, a line that begins a statement). slip() reports an error whose intended
// meaning is clear and continues as if it had been written correctly. One line gets at most one syntax error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "frontend/parse/lexer.h"
#include "frontend/parse/literals.h"
#include "frontend/parse/parse.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/il.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

class Parser {
 public:
  Parser(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect, Diagnostics& diagnostics);

  // Lexes [begin, end) of the file and balances its blocks.
  void read(uint32_t begin, uint32_t end);
  Slice<DeclId> parseDecls();
  ExprId parseLoneExpression();
  Slice<DeclId> parseLoneSections();
  Slice<StmtId> parseLoneStatements();

 private:
  // ---- tokens
  Tok kind() const { return t_->kind; }
  bool at(Tok kind) const { return t_->kind == kind; }
  Tok peek(uint32_t n = 1) const { return t_[n].kind; }
  bool atLineStart() const { return (t_->flags & kLineStart) != 0; }
  void advance() {
    if (t_->kind != Tok::End) ++t_;
  }
  bool accept(Tok kind) {
    if (t_->kind != kind) return false;
    ++t_;
    return true;
  }
  uint32_t index() const { return static_cast<uint32_t>(t_ - tokens_.data()); }
  Loc loc(const Token* t) const { return {base_ + t->offset}; }
  Loc here() const { return loc(t_); }
  NameId nameOf(const Token* t) const { return {t->value}; }
  Ident ident(const Token* t) const { return {nameOf(t), loc(t)}; }
  uint32_t lengthOf(const Token* t) const;
  std::string_view textOf(const Token* t) const { return source_.substr(t->offset, lengthOf(t)); }
  Loc endOf(const Token* t) const { return {base_ + t->offset + lengthOf(t)}; }
  bool is(const Token* t, std::string_view word) const { return sameIdentifier(textOf(t), word); }
  std::string describe(const Token* t) const;  // "`x`", "the end of the file"

  // ---- errors
  Report fail(Diag diag, const Token* t, std::initializer_list<std::string_view> args = {});
  Report slip(Diag diag, const Token* t, std::initializer_list<std::string_view> args = {});
  Report missing(Diag diag, std::initializer_list<std::string_view> args);  // at the end of the previous token
  bool mayReport(const Token* t);
  bool nameReserved(const Token* t) const { return isReserved(t->kind) || isTypeWord(t->kind); }
  // Consumes `wanted`. If it is missing: slip(), or fail() when the next token makes no sense. True when it was there.
  bool expect(Tok wanted);
  // The keyword of `candidates` that is nearest to the name at t, or End.
  Tok nearKeyword(const Token* t, std::span<const Tok> candidates) const;
  bool correctSpelling(Tok wanted);  // t_ is a misspelled `wanted`: reports and corrects it
  void tooDeep(const char* what, uint32_t limit);

  // ---- files, POUs, configurations (parser.cpp)
  void parseTopLevel(std::vector<DeclId>& out);
  void skipToTopLevel();
  bool atTopLevelWord() const;
  DeclId parsePou();
  void parsePouParts(PouDecl& d);
  void parseBody(PouDecl& d);
  bool pouCloses();
  DeclId parseConfiguration();
  DeclId parseResource();
  DeclId parseTask();
  DeclId parseProgramInstance();
  void parseMembers(Tok end, std::vector<DeclId>& out);
  bool parseTaskName(Ident& out);

  // ---- objects (objects.cpp)
  bool atMember() const { return at(Tok::Method) || at(Tok::Property) || at(Tok::Action); }
  bool acceptAccess(AccessLevel& access);
  void parseModifiers(AccessLevel& access, uint8_t& modifiers, bool before_name);
  Slice<TypeExprId> parseTypeNames();
  void parseMember(std::vector<DeclId>& out);
  bool atAccessor() const;
  DeclId parseProperty();
  void parseHalfProperty(std::vector<DeclId>& out);
  Ident parsePropertyHeader(PropertyDecl& d);
  DeclId parseAccessor(const Ident& property, const PropertyDecl& of);
  DeclId parseAccessorBody(PouDecl& d, const Ident& property, const PropertyDecl& of, bool is_set, Tok end);
  DeclId parseNamespace();
  void parseUsing(std::vector<DeclId>& out);

  // ---- declarations (declarations.cpp)
  void parseTypes(std::vector<DeclId>& out);
  DeclId parseTypeEntry(Slice<Pragma> pragmas, Loc doc, AccessLevel access);
  DeclId parseSection();
  bool atSection() const { return kind() >= Tok::Var && kind() <= Tok::VarConfig; }
  DeclId parseVar(SectionKind section);
  void parseVars(SectionKind section, Tok end, std::vector<DeclId>& out);
  void syncDeclaration(Tok end);
  void skipStray(bool fits_after, Diag diag);
  bool beginsType(const Token* t) const;
  bool parseName(Ident& out);
  // CODESYS knows NULL as a value only: items and members may have this name.
  bool isNullName(const Token* t) const { return t->kind == Tok::Null && dialect_ == Dialect::Codesys; }
  bool parsePath(std::vector<Ident>& out);
  TypeExprId parseType();
  TypeExprId parseStruct();
  TypeExprId parseEnum(TypeExprId base);
  TypeExprId parseArray();
  TypeExprId parseNamedType();
  bool rangeFollows() const;
  void parseNamePath(Slice<Ident>& out);
  ExprId parseDeclaredInit(TypeExprId type);
  ExprId parseInit();
  void parseElements(Tok close);
  ExprId parseArrayInit();
  ExprId parseStructInit();
  Slice<Pragma> takePragmas();
  Pragma readPragma(const PragmaRange& pragma);
  Loc takeDoc();
  Loc docAfter(const Token* t) const;
  bool pragmaNamed(Slice<Pragma> pragmas, std::string_view name) const;

  // ---- statements (statements.cpp)
  enum Stops : uint8_t {
    kStopElse = 1,
    kStopElsif = 2,
    kStopUntil = 4,
    kStopLabel = 8,
    kStopTry = 16
  };  // keywords that end a list, besides END_…
  Slice<StmtId> parseStatements(uint8_t stops);
  bool atBlockEnd();
  void parseStatement();
  void parseIf();
  void parseCase();
  void parseFor();
  void parseWhile();
  void parseRepeat();
  void parseTry();
  bool chartInSt();
  void parseExprStatement();
  void parseChain(ExprId target, ExprId value, Token* value_start, const Token* op);
  bool atCaseLabel() const;
  ExprId parseHeader(Tok connective);
  void finishHeader(Tok connective);
  bool enterBlock();
  void parseCaseLabels(std::vector<ExprId>& out);
  void closeBlock(const Token* open, Tok end);
  void endStatement(const Token* first);
  void syncStatement();
  bool startsStatement(const Token* t) const;
  bool misspelledStart(const Token* first);
  StmtHeader header(StmtKind kind, Loc loc, uint8_t op = 0) const { return {kind, op, 0, loc}; }

  // ---- Instruction List (il.cpp)
  bool atIl() const;
  Slice<IlInstruction> parseIl(bool nested);
  bool isInstruction(const Token* t) const;
  bool isPlainInstruction(const Token* t) const;
  void parseInstruction();
  void resynchronize(IlInstruction& i);
  void endInstruction();
  void parseOperands(IlInstruction& i, const Token* op);
  void parseIlList(IlInstruction& i, const Token* op);
  ExprId parseIlCallee();
  void parseIlPins(IlInstruction& i);
  void parseIlParens(IlInstruction& i, const Token* op);
  bool listFollows(const Token* first) const;
  bool atNestedIl() const;
  void parseNestedIl(uint32_t operand);
  void closeIlParen(Tok close);
  bool instructionInSt();
  bool statementInIl();

  // ---- networks (network.cpp)
  void parseNetworks(PouDecl& d);
  void parseElement(std::vector<DiagramElement>& out, uint32_t network);
  void parsePins(std::vector<DiagramPin>& out);
  void parseWires(DiagramPin& pin);
  ExprId parseElementPath(Ident& name);
  template <class Modifiable>
  bool takeModifier(Modifiable& out);
  bool takeWord(Ident& out);
  bool takeNumber(uint64_t& out);
  bool takeCoordinate(int32_t& out);
  void parsePosition(SfcPosition& position);
  void connectWires(const std::vector<DiagramElement>& elements, uint32_t first_wire);

  // ---- Sequential Function Chart (sfc.cpp)
  struct SfcMacro {
    Ident name, entry, exit;
    uint32_t first_step;  // index of the first step inside; the steps end at `end_step`
    uint32_t end_step;
    uint32_t errors;  // number of errors before it
    const Token* open;
  };
  bool atSfc() const;
  bool atMacroEnd() const { return is(t_, "END_MACRO_STEP"); }
  bool atCondition() const;
  bool atOwnAction() const;
  void parseMembersOf(const PouDecl& d, std::vector<DeclId>& members, std::vector<SfcTransition>& conditions);
  void parseSfc(PouDecl& d, std::vector<DeclId>& members, std::vector<SfcTransition>& transitions);
  void openMacro(std::vector<SfcMacro>& macros, std::vector<uint32_t>& open, size_t steps);
  void closeMacro(std::vector<SfcMacro>& macros, std::vector<uint32_t>& open, std::span<const SfcStep> steps);
  void inlineMacros(std::span<const SfcMacro> macros, std::span<const SfcStep> steps,
                    std::vector<SfcTransition>& transitions);
  void parseStep(std::vector<SfcStep>& out);
  void parseStepTimes(SfcStep& step);
  bool parseAssociation(std::vector<SfcAssociation>& out);
  bool parseTransition(std::vector<SfcTransition>& out, std::vector<DeclId>& members);
  bool parseSteps(Slice<Ident>& out);
  SfcExpr parseSfcExpr();
  void parseCondition(SfcTransition& t, std::vector<DeclId>& members);
  void syncChart(Tok end);

  // ---- expressions (expressions.cpp)
  ExprId parseExpr(uint32_t least = 1);
  ExprId parseUnary();
  ExprId parsePostfix(ExprId base, bool calls = true);
  void parseAccessPath(VarDecl& d);
  void readRelativeAddress(VarDecl& d);
  bool isNew(ExprId callee) const;
  ExprId parseNew(ExprId callee);
  ExprId parsePrimary();
  ExprId parseTyped();
  ExprId parseNumber(NameId prefix, bool negative, Loc loc);
  ExprId parseStringLiteral(NameId prefix, Loc loc);
  ExprId parseTime();
  ExprId parseAddress();
  Slice<Argument> parseArguments(Loc& end);
  ExprId parseCompared(ExprId left);
  ExprId errorExpr(Loc loc) { return tree_.add<ExprId>(ErrorExpr{exprHeader(ExprKind::Error, loc)}); }
  ExprHeader exprHeader(ExprKind kind, Loc loc, uint8_t op = 0, uint8_t bits = 0) const {
    return {kind, 0, 0, 0, op, bits, loc, {}};
  }
  ExprId boolLiteral(bool value, NameId prefix, Loc loc);
  bool isOperand(Tok kind) const;
  void closeParen(Tok close, bool continues_lines);

  template <class T>
  Slice<T> listFrom(std::vector<T>& scratch, size_t first) {
    const Slice<T> slice = tree_.addList<T>(std::span<const T>(scratch).subspan(first));
    scratch.resize(first);
    return slice;
  }

  Tree& tree_;
  Names& names_;
  const Sources& sources_;
  FileId file_;
  Dialect dialect_;
  Diagnostics& diagnostics_;
  uint32_t base_;
  std::string_view source_;
  TokenStream stream_;
  std::vector<Token> tokens_;
  Token* t_ = nullptr;
  bool panic_ = false;
  bool declared_in_body_ = false;     // reported once per POU
  bool in_variable_ = false;          // in the type of a variable, which may have arguments
  uint32_t in_property_ = 0;          // in its accessors
  bool in_program_instance_ = false;  // in PROGRAM p : Main (…) of a resource
  std::vector<Ident> block_tasks_;    // its blocks with separate tasks, each followed by the task
  bool in_structure_ = false;         // in a STRUCT or UNION
  bool address_reported_ = false;     // reported once per structure
  bool in_il_ = false;                // in a list of instructions
  bool il_file_ = false;              // the file name ends in .il
  bool il_line_reported_ = false;     // reported once per file
  NameId eno_;
  bool eno_used_ = false;   // ENO is an operand in the current POU
  bool lost_ = false;       // declarations of the current POU or TYPE entry could not be read
  Tok pou_end_ = Tok::End;  // the END_… of the current POU
  enum class Known : uint8_t { NotYet, Yes, No } pou_closes_ = Known::NotYet;  // whether the current POU has that END_…
  const Token* last_error_ = nullptr;
  const Token* statement_start_ = nullptr;
  uint32_t expr_depth_ = 0, stmt_depth_ = 0;
  uint32_t height_ = 0;  // of the tree of the expression read last
  std::string buffer_;
  // Scratch stacks of lists that are being built.
  std::vector<StmtId> stmts_;
  std::vector<ExprId> exprs_;
  std::vector<Argument> arguments_;
  std::vector<DeclId> decls_;
  std::vector<IfBranch> if_branches_;
  std::vector<CaseBranch> case_branches_;
  std::vector<Ident> idents_;
  std::vector<uint32_t> numbers_;
  std::vector<IlInstruction> il_;
  std::vector<IlNested> il_nested_;
  std::vector<const Token*> il_open_;  // operators whose `(` is open
  size_t il_outside_ = 0;              // how many of them enclose the current list
  std::vector<DiagramWire> wires_;
  std::vector<uint64_t> wire_numbers_;  // of the body's wires: numbers of the source elements
  uint32_t type_depth_ = 0;
};

constexpr uint32_t kMaxExprDepth = 1000;
constexpr uint32_t kMaxChain = 2000;  // operators in a row: a left-deep tree
constexpr uint32_t kMaxExprHeight = kMaxChain + 1;
constexpr uint32_t kMaxStmtDepth = 2000;
constexpr uint32_t kMaxTypeDepth = 200;

// Keywords after which the current block has no further variable or type (declarations.cpp).
bool endsDeclarations(Tok kind);

}  // namespace rung::text
