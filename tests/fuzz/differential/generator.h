// SPDX-License-Identifier: Apache-2.0
// Generates a program from a seed: types, random numbers, and the parts that make expressions, statements and
// POUs. Private to this folder: expressions.cpp, statements.cpp, objects.cpp, classes.cpp, records.cpp,
// charts.cpp, program.cpp.
#pragma once

#include <initializer_list>

#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/program.h"
#include "tests/fuzz/generated/options.h"

namespace rung::differential {

enum class Kind : uint8_t { Bool, Signed, Unsigned, Bits, Real, Duration, Date, Letter, String, WideString };

struct Type {
  const char* name;
  Kind kind;
  const char* zero;  // a literal
  bool in_edition2;
};

inline const Type kTypes[] = {
    {"BOOL", Kind::Bool, "FALSE", true},
    {"SINT", Kind::Signed, "SINT#0", true},
    {"INT", Kind::Signed, "INT#0", true},
    {"DINT", Kind::Signed, "DINT#0", true},
    {"LINT", Kind::Signed, "LINT#0", true},
    {"USINT", Kind::Unsigned, "USINT#0", true},
    {"UINT", Kind::Unsigned, "UINT#0", true},
    {"UDINT", Kind::Unsigned, "UDINT#0", true},
    {"ULINT", Kind::Unsigned, "ULINT#0", true},
    {"BYTE", Kind::Bits, "BYTE#0", true},
    {"WORD", Kind::Bits, "WORD#0", true},
    {"DWORD", Kind::Bits, "DWORD#0", true},
    {"LWORD", Kind::Bits, "LWORD#0", true},
    {"REAL", Kind::Real, "REAL#0.0", true},
    {"LREAL", Kind::Real, "LREAL#0.0", true},
    {"TIME", Kind::Duration, "T#0s", true},
    {"LTIME", Kind::Duration, "LTIME#0s", false},
    {"DATE", Kind::Date, "D#1970-01-01", true},
    {"TIME_OF_DAY", Kind::Date, "TOD#00:00:00", true},
    {"DATE_AND_TIME", Kind::Date, "DT#1970-01-01-00:00:00", true},
    {"LDATE", Kind::Date, "LDATE#1970-01-01", false},
    {"LTIME_OF_DAY", Kind::Date, "LTOD#00:00:00", false},
    {"LDATE_AND_TIME", Kind::Date, "LDT#1970-01-01-00:00:00", false},
    {"CHAR", Kind::Letter, "CHAR#'a'", false},
    {"WCHAR", Kind::Letter, "WCHAR#\"a\"", false},
    {"STRING", Kind::String, "''", true},
    {"WSTRING", Kind::WideString, "\"\"", true},
};
constexpr int kTypeCount = sizeof kTypes / sizeof kTypes[0];
constexpr int kBool = 0, kSint = 1, kInt = 2, kDint = 3, kLint = 4, kUsint = 5, kUint = 6, kUdint = 7, kByte = 9,
              kWord = 10, kDword = 11, kLword = 12, kReal = 13, kLreal = 14, kTime = 15, kLtime = 16, kTod = 18,
              kDt = 19, kLtod = 21, kLdt = 22, kChar = 23, kString = 25;

constexpr unsigned kCoils = 16;  // bits of the memory that at_dword and at_byte show, too

std::string lowered(const char* name);

// Made with braces, so the random numbers are drawn from left to right with every compiler.
struct Fixed : Node {
  Fixed(std::string text_, std::vector<Node> children_ = {}) {
    text = std::move(text_);
    children = std::move(children_);
    fixed = true;
  }
};

struct Stmt : Node {
  Stmt(std::string text_, std::vector<Node> children_ = {}) {
    text = std::move(text_);
    children = std::move(children_);
  }
};

struct Expr : Stmt {
  Expr(int type_, std::string text_, std::vector<Node> children_ = {}) : Stmt(std::move(text_), std::move(children_)) {
    type = type_;
    simple = kTypes[type].zero;
  }
};

// A variable of a generated program that can be assigned, and the statement that makes it valid.
struct Lvalue {
  std::string name, type, binding;
};

class Generator {
 public:
  Generator(uint64_t seed, unsigned index, Faults faults, Dialect dialect)
      : state_(seed), index_(index), prefix_("P" + std::to_string(index)), faults_(faults), dialect_(dialect) {
    state_ = random();  // the sequence of the next seed must not be this one, shifted by one
  }

  Node program();

 private:
  uint64_t random() { return generated::nextRandom(state_); }
  int below(int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }
  bool chance(int percent) { return below(100) < percent; }
  std::string pick(std::initializer_list<const char*> words) {
    return words.begin()[below(static_cast<int>(words.size()))];
  }
  int anyType() {
    int type = below(kTypeCount);
    while (dialect_ == Dialect::Iec2 && !kTypes[type].in_edition2) type = below(kTypeCount);
    return type;
  }
  int anyInteger() { return 1 + below(8); }
  bool codesys() const { return dialect_ == Dialect::Codesys; }
  bool inObject() const { return body_ == Body::Class || body_ == Body::Method; }
  bool bitArithmetic() const { return codesys(); }

  Node expr(int type, int depth);
  Node leaf(int type);
  Node boolean(int depth);
  Node integer(int type, int depth);
  Node bits(int type, int depth);
  Node real(int type, int depth);
  Node duration(int type, int depth);
  Node date(int type, int depth);
  Node text(int type, int depth);
  Node conversion(int type, int depth);
  Node call(int type, int depth);
  std::string literal(int type);
  std::string readable(int type);
  std::string writable(int type);
  std::string part(int type);
  Node variable(int type);
  Node divisor(int type, int depth);
  Node subscript(int first, int last, int depth);
  Node offset(int first, int last, int depth);

  Node statement(int depth);
  Node statements(int depth, int count);
  Node assignment();
  Node loop(int depth);
  Node choice(int depth);
  Node jump(int depth);
  Node attempt(int depth);
  Node blockCall();
  Node guardedCall();
  Node rungs();
  Node contacts(int depth);
  std::string coil() { return prefix_ + "_coil" + std::to_string(below(static_cast<int>(kCoils))); }

  Node methodCall(const std::string& receiver, int number, std::vector<Node> before, int depth);
  bool methodOf(int type, int depth, Node& result);
  std::string receiver(int number, bool is_block, std::vector<Node>& parts);
  std::string instance(bool second);
  std::string led(int type);
  Node bindObject();
  Node objectStatement();
  Node pointerStatement();
  Node pointerQuestion();

  const std::vector<Lvalue>& lvalues();
  std::vector<Lvalue> objectLvalues() const;

  // records.cpp
  void makeRecords(std::vector<Node>& parts);
  void makeShelves(std::vector<Node>& parts);
  std::string record(bool outer, std::vector<Node>& parts);
  std::string member(int type);
  Node recordStatement();
  Node shelfStatement();
  Node unionStatement();
  std::vector<Lvalue> recordLvalues() const;

  // charts.cpp
  struct Chart {
    std::vector<Node> parts;
    int steps = 0, priority = 0;
  };
  std::string makeStep(Chart& chart);
  void connectSteps(Chart& chart, const std::string& from, const std::string& to);
  std::string makeSequence(Chart& chart, std::string last, int depth);
  Node makeChart();
  Node chartStatement();

  // classes.cpp: edition 3
  void makeClasses(std::vector<Node>& parts);
  Node classStatement();
  std::vector<Lvalue> classLvalues() const;

  Node makeMethod(int number, const std::string& base);
  Node makeClass(int number);
  void makeObjects(std::vector<Node>& parts);
  Node makeFunction(int number);
  Node makeBlock(int number);
  Node makeAccess();
  Node declarations(std::initializer_list<const Node*> users);

  struct Method {
    int result = 0;
    std::vector<int> inputs;
  };

  struct Function {
    std::string name;
    int result;
    std::vector<int> inputs;
  };

  uint64_t state_;
  unsigned index_;
  std::string prefix_;
  Faults faults_;
  Dialect dialect_;
  enum class Body : uint8_t { Function, Block, Class, Method, Program } body_ = Body::Program;
  std::string own_;  // name of the function whose body this is
  int own_result_ = 0;
  std::vector<int> own_inputs_;  // types of in0, in1, …
  std::vector<Function> functions_;
  std::vector<std::vector<int>> blocks_;  // input types
  std::vector<Method> methods_;           // M0, M1, M2 of every block with a base; empty: not made, or not yet
  int method_ = -1;                       // in a method: its number; it calls only methods with smaller ones
  bool chained_ = false;                  // O2 extends O1; otherwise O0, like O1
  int start_ = 0;                         // type of the input of these blocks
  std::vector<int> chart_inputs_;         // types
  std::vector<Lvalue> lvalues_;
  int loops_ = 0;   // around the statement
  int cases_ = 0;   // around it, in which a label would belong to the CASE
  int labels_ = 0;  // of the body so far
};

}  // namespace rung::differential
