#include "tests/fuzz/differential/program.h"

#include <initializer_list>

namespace rung::differential {
namespace {

enum class Kind : uint8_t { Bool, Signed, Unsigned, Bits, Real, Duration, Date, Letter, Text, WideText };

struct Type {
  const char* name;
  Kind kind;
  const char* zero;  // a literal
};

const Type kTypes[] = {
    {"BOOL", Kind::Bool, "FALSE"},
    {"SINT", Kind::Signed, "SINT#0"},
    {"INT", Kind::Signed, "INT#0"},
    {"DINT", Kind::Signed, "DINT#0"},
    {"LINT", Kind::Signed, "LINT#0"},
    {"USINT", Kind::Unsigned, "USINT#0"},
    {"UINT", Kind::Unsigned, "UINT#0"},
    {"UDINT", Kind::Unsigned, "UDINT#0"},
    {"ULINT", Kind::Unsigned, "ULINT#0"},
    {"BYTE", Kind::Bits, "BYTE#0"},
    {"WORD", Kind::Bits, "WORD#0"},
    {"DWORD", Kind::Bits, "DWORD#0"},
    {"LWORD", Kind::Bits, "LWORD#0"},
    {"REAL", Kind::Real, "REAL#0.0"},
    {"LREAL", Kind::Real, "LREAL#0.0"},
    {"TIME", Kind::Duration, "T#0s"},
    {"LTIME", Kind::Duration, "LTIME#0s"},
    {"DATE", Kind::Date, "D#1970-01-01"},
    {"TIME_OF_DAY", Kind::Date, "TOD#00:00:00"},
    {"DATE_AND_TIME", Kind::Date, "DT#1970-01-01-00:00:00"},
    {"LDATE", Kind::Date, "LDATE#1970-01-01"},
    {"LTIME_OF_DAY", Kind::Date, "LTOD#00:00:00"},
    {"LDATE_AND_TIME", Kind::Date, "LDT#1970-01-01-00:00:00"},
    {"CHAR", Kind::Letter, "CHAR#'a'"},
    {"WCHAR", Kind::Letter, "WCHAR#\"a\""},
    {"STRING", Kind::Text, "''"},
    {"WSTRING", Kind::WideText, "\"\""},
};
constexpr int kTypeCount = sizeof kTypes / sizeof kTypes[0];
constexpr int kBool = 0, kSint = 1, kInt = 2, kDint = 3, kLint = 4, kUsint = 5, kUint = 6, kUdint = 7, kWord = 10,
              kReal = 13, kTime = 15, kLtime = 16, kTod = 18, kDt = 19, kLtod = 21, kLdt = 22, kChar = 23, kString = 25;

class Generator {
 public:
  Generator(uint64_t seed, unsigned index, Faults faults)
      : state_(seed * 0x9E3779B97F4A7C15u + 1), prefix_("P" + std::to_string(index)), faults_(faults) {}

  Node program();

 private:
  // splitmix64: the same numbers with every C++ library.
  uint64_t random() {
    uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  int below(int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }
  bool chance(int percent) { return below(100) < percent; }
  std::string pick(std::initializer_list<const char*> words) {
    return words.begin()[below(static_cast<int>(words.size()))];
  }
  int anyType() { return below(kTypeCount); }
  int anyNumber() { return 1 + below(14); }
  int anyInteger() { return 1 + below(8); }

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
  Node variable(int type);
  Node divisor(int type, int depth);
  Node subscript(int first, int last, int depth);

  Node statement(int depth);
  Node statements(int depth, int count);
  Node assignment();
  Node loop(int depth);
  Node choice(int depth);
  Node blockCall();
  Node guardedCall();

  Node makeFunction(int number);
  Node makeBlock(int number);
  Node makeAccess();
  Node declarations();

  struct Function {
    std::string name;
    int result;
    std::vector<int> inputs;
  };

  uint64_t state_;
  std::string prefix_;
  Faults faults_;
  enum class Body : uint8_t { Function, Block, Program } body_ = Body::Program;
  std::string own_;  // name of the function whose body this is
  int own_result_ = 0;
  std::vector<int> own_inputs_;  // types of in0, in1, …
  std::vector<Function> functions_;
  std::vector<std::vector<int>> blocks_;  // input types
  int loops_ = 0;                         // around the statement
};

// Made with braces, so that the random numbers are drawn from left to right with every compiler.
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

// ---- leaves

std::string Generator::literal(int type) {
  const std::string name = kTypes[type].name;
  static const int kBitsOf[] = {8, 16, 32, 64};
  switch (kTypes[type].kind) {
    case Kind::Bool: return pick({"TRUE", "FALSE"});
    case Kind::Signed: {
      const int bits = kBitsOf[type - kSint];
      if (chance(15)) {
        const uint64_t top = (uint64_t{1} << (bits - 1)) - 1 - static_cast<unsigned>(below(3));
        return name + "#" + (chance(50) ? "-" : "") + std::to_string(top);
      }
      return name + "#" + std::to_string(below(20) - 6);
    }
    case Kind::Unsigned:
    case Kind::Bits: {
      const int bits = kBitsOf[(type - kUsint) % 4];
      if (chance(20))
        return name + "#" + std::to_string((~uint64_t{0} >> (64 - bits)) - static_cast<unsigned>(below(3)));
      return name + "#" + std::to_string(below(20));
    }
    case Kind::Real:
      return name + "#" + pick({"0.0", "1.0", "-1.5", "0.1", "2.5", "1.0E10", "-3.0E-7", "1234.5678", "0.5", "1.0E30"});
    case Kind::Duration:
      return (type == kTime ? "T#" : "LTIME#") + pick({"0s", "10ms", "25ms", "1s", "1h2m3s", "7d", "40d"});
    case Kind::Date:
      if (type == kTod) return pick({"TOD#00:00:00", "TOD#12:34:56.789", "TOD#23:59:59.999"});
      if (type == kDt) return pick({"DT#1970-01-01-00:00:00", "DT#2024-02-29-12:34:56", "DT#2099-12-31-23:59:59"});
      if (type == kLtod) return pick({"LTOD#00:00:00", "LTOD#12:34:56.789012345"});
      if (type == kLdt) return pick({"LDT#1970-01-01-00:00:00", "LDT#2024-02-29-12:34:56.000000001"});
      return (type == kLtod - 1 ? "LDATE#" : "D#") + pick({"1970-01-01", "2024-02-29", "2099-12-31"});
    case Kind::Letter:
      return type == kChar ? pick({"CHAR#'a'", "CHAR#'Z'", "CHAR#'$FF'"}) : pick({"WCHAR#\"a\"", "WCHAR#\"$1234\""});
    case Kind::Text:
      return pick({"''", "'a'", "'Rung'", "'12'", "'-3.5'", "'A longer text, with $$ and $''", "'xyzzy'"});
    case Kind::WideText: return pick({"\"\"", "\"a\"", "\"Rung\"", "\"12\"", "\"wide and long\""});
  }
  return "0";
}

std::string lowered(const char* name) {
  std::string text = name;
  for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return text;
}

std::string Generator::readable(int type) {
  if (body_ != Body::Program && chance(40)) {
    for (size_t i = 0; i < own_inputs_.size(); ++i) {
      if (own_inputs_[i] == type) return "in" + std::to_string(i);
    }
  }
  return writable(type);
}

// A variable of the type. Every body has the same local ones.
std::string Generator::writable(int type) {
  const std::string name = lowered(kTypes[type].name);
  if (body_ == Body::Program) {
    if (type == kDint && chance(25))
      return chance(50) ? "pair.count" : "table[" + std::to_string(below(6) - 1) + "].count";
    if (type == kReal && chance(25)) return "pair.share";
    if (type == kString && chance(30)) return chance(50) ? "short" : "pair.title";
    if (type == kBool && chance(15)) return "flags." + std::to_string(below(16));
    if (type == kInt && chance(20)) return "percent";
    if (type == kInt && chance(20))
      return "grid[" + std::to_string(below(2) + 1) + ", " + std::to_string(below(3)) + "]";
  }
  if (chance(12) && (type == kDint || type == kReal || type == kString)) return prefix_ + "_g_" + name;
  return "v_" + name + (chance(40) ? "2" : "");
}

Node Generator::leaf(int type) {
  if (chance(25)) return Expr{type, literal(type)};
  return Expr{type, readable(type)};
}

// ---- expressions

Node Generator::expr(int type, int depth) {
  if (depth <= 0 || chance(15)) return leaf(type);
  if (chance(14)) return conversion(type, depth - 1);
  if (chance(10)) return call(type, depth - 1);
  if (chance(6)) {
    return Expr{type, "SEL(\1, \1, \1)", {expr(kBool, depth - 1), expr(type, depth - 1), expr(type, depth - 1)}};
  }
  if (chance(4)) {
    return Expr{type,
                "MUX(LIMIT(0, \1, 2), \1, \1, \1)",
                {expr(kInt, depth - 1), expr(type, depth - 1), expr(type, depth - 1), expr(type, depth - 1)}};
  }
  if (chance(5) && type != kBool) {
    return Expr{type, pick({"MIN", "MAX"}) + "(\1, \1)", {expr(type, depth - 1), expr(type, depth - 1)}};
  }
  if (chance(3) && type != kBool) {
    return Expr{type, "LIMIT(\1, \1, \1)", {expr(type, depth - 1), expr(type, depth - 1), expr(type, depth - 1)}};
  }
  switch (kTypes[type].kind) {
    case Kind::Bool: return boolean(depth - 1);
    case Kind::Signed:
    case Kind::Unsigned: return integer(type, depth - 1);
    case Kind::Bits: return bits(type, depth - 1);
    case Kind::Real: return real(type, depth - 1);
    case Kind::Duration: return duration(type, depth - 1);
    case Kind::Date: return date(type, depth - 1);
    case Kind::Letter: return leaf(type);
    case Kind::Text:
    case Kind::WideText: return text(type, depth - 1);
  }
  return leaf(type);
}

Node Generator::boolean(int depth) {
  switch (below(10)) {
    case 0: return Expr{kBool, "NOT \1", {expr(kBool, 0)}};
    case 1:
      return Expr{kBool, "(\1 " + pick({"AND_THEN", "OR_ELSE"}) + " \1)", {expr(kBool, depth), expr(kBool, depth)}};
    case 2:
    case 3: return Expr{kBool, "(\1 " + pick({"AND", "OR", "XOR"}) + " \1)", {expr(kBool, depth), expr(kBool, depth)}};
    case 4: return Expr{kBool, "\1." + std::to_string(below(8)), {Fixed{chance(50) ? "v_word" : "v_byte"}}};
    case 5:
      return body_ == Body::Program
                 ? Expr{kBool, pick({"ton.Q", "tof.Q", "tp.Q", "ctu.Q", "rise.Q", "fall.Q", "latch.Q1"})}
                 : leaf(kBool);
    default: {
      if (body_ == Body::Program && chance(10)) {
        return Expr{kBool, "(colour " + pick({"=", "<>", "<"}) + " other_colour)"};
      }
      const int type = anyType();
      return Expr{
          kBool, "(\1 " + pick({"=", "<>", "<", "<=", ">", ">="}) + " \1)", {expr(type, depth), expr(type, depth)}};
    }
  }
}

// What may be 0 but is not known to be: rung refuses a division by a constant 0.
Node Generator::variable(int type) {
  Node node = Expr{type, readable(type)};
  node.fixed = true;
  return node;
}

Node Generator::divisor(int type, int depth) {
  if (faults_ == Faults::Division && chance(30)) return variable(type);
  if (kTypes[type].kind == Kind::Unsigned) {
    Node node = Expr{type, "MAX(\1, " + std::string(kTypes[type].name) + "#1)", {expr(type, depth)}};
    node.simple = std::string(kTypes[type].name) + "#1";
    node.type = -1;
    return node;
  }
  Node node = Expr{type, std::string(kTypes[type].name) + "#" + pick({"-3", "-1", "1", "2", "3", "7", "8", "100"})};
  node.simple = std::string(kTypes[type].name) + "#1";
  node.type = -1;
  return node;
}

Node Generator::integer(int type, int depth) {
  switch (below(12)) {
    case 0:
    case 1: return Expr{type, "(\1 / \1)", {expr(type, depth), divisor(type, depth)}};
    case 2: return Expr{type, "(\1 MOD \1)", {expr(type, depth), divisor(type, depth)}};
    case 3: return kTypes[type].kind == Kind::Signed ? Expr{type, "(-\1)", {Expr{type, readable(type)}}} : leaf(type);
    case 4: return Expr{type, "ABS(\1)", {expr(type, depth)}};
    case 5:
      if (type == kInt) return Expr{type, "LEN(\1)", {expr(kString, depth)}};
      if (type == kDint && body_ == Body::Program) {
        return Expr{type, "table[\1].count", {subscript(-1, 4, depth)}};
      }
      return leaf(type);
    case 6:
      if (type == kInt) return Expr{type, "FIND(\1, \1)", {expr(kString, depth), expr(kString, depth)}};
      if (type == kLint) return Expr{type, "(\1 + \1)", {expr(kDint, depth), expr(type, depth)}};
      if (type == kDint) return Expr{type, "(\1 * \1)", {expr(kInt, depth), expr(type, depth)}};
      return leaf(type);
    case 7:
      if (type == kInt && body_ == Body::Program) {
        return Expr{type, "grid[\1, \1]", {subscript(1, 2, depth), subscript(0, 2, depth)}};
      }
      return leaf(type);
    default: return Expr{type, "(\1 " + pick({"+", "-", "*"}) + " \1)", {expr(type, depth), expr(type, depth)}};
  }
}

Node Generator::subscript(int first, int last, int depth) {
  const std::string low = std::to_string(first), high = std::to_string(last);
  if (faults_ == Faults::Index && chance(40)) {
    Node node = Expr{
        kInt, "LIMIT(" + low + ", \1 + \1, " + std::to_string(last + 2) + ")", {variable(kInt), expr(kInt, depth)}};
    node.simple = high;
    node.type = -1;
    return node;
  }
  Node node = Expr{kInt, "LIMIT(" + low + ", \1, " + high + ")", {expr(kInt, depth)}};
  node.simple = low;
  node.type = -1;
  return node;
}

Node Generator::bits(int type, int depth) {
  switch (below(6)) {
    case 0: return Expr{type, "NOT \1", {leaf(type)}};
    case 1:
    case 2: {
      Node count = Expr{kUsint, std::to_string(below(70))};
      count.simple = "1";
      return Expr{type,
                  pick({"SHL", "SHR", "ROL", "ROR"}) + "(\1, \1)",
                  {expr(type, depth), chance(50) ? std::move(count) : expr(kUsint, depth)}};
    }
    case 3: return Expr{type, "(\1 " + pick({"+", "-", "*"}) + " \1)", {expr(type, depth), expr(type, depth)}};
    default: return Expr{type, "(\1 " + pick({"AND", "OR", "XOR"}) + " \1)", {expr(type, depth), expr(type, depth)}};
  }
}

Node Generator::real(int type, int depth) {
  switch (below(7)) {
    case 6: return Expr{type, "EXPT(\1, \1)", {expr(type, depth), expr(chance(50) ? kInt : kReal, depth)}};
    case 0: return Expr{type, pick({"SQRT", "LN", "EXP", "SIN", "COS", "ATAN", "ABS"}) + "(\1)", {expr(type, depth)}};
    case 1: return Expr{type, "(-\1)", {Expr{type, readable(type)}}};
    case 2: return Expr{type, "(\1 * \1)", {expr(type, depth), expr(kReal, depth)}};
    case 3: return Expr{type, "(\1 / \1)", {expr(type, depth), variable(type)}};
    default: return Expr{type, "(\1 " + pick({"+", "-", "*"}) + " \1)", {expr(type, depth), expr(type, depth)}};
  }
}

Node Generator::duration(int type, int depth) {
  switch (below(4)) {
    case 0: return Expr{type, "(\1 * \1)", {expr(type, depth), expr(kInt, depth)}};
    case 1: return type == kTime ? Expr{type, "(\1 - \1)", {expr(kDt, depth), expr(kDt, depth)}} : leaf(type);
    default: return Expr{type, "(\1 " + pick({"+", "-"}) + " \1)", {expr(type, depth), expr(type, depth)}};
  }
}

Node Generator::date(int type, int depth) {
  const bool is_long = type == kLtod || type == kLdt;
  if (type != kTod && type != kDt && !is_long) return leaf(type);
  return Expr{type,
              "(\1 " + pick({"+", "-"}) + " \1)",
              {expr(type, depth), expr(is_long && chance(50) ? kLtime : kTime, depth)}};
}

Node Generator::text(int type, int depth) {
  switch (below(6)) {
    case 0: return Expr{type, pick({"LEFT", "RIGHT"}) + "(\1, \1)", {expr(type, depth), expr(kInt, depth)}};
    case 1:
      return Expr{
          type, pick({"MID", "DELETE"}) + "(\1, \1, \1)", {expr(type, depth), expr(kInt, depth), expr(kInt, depth)}};
    case 2: return Expr{type, "INSERT(\1, \1, \1)", {expr(type, depth), expr(type, depth), expr(kInt, depth)}};
    case 3:
      return Expr{type,
                  "REPLACE(\1, \1, \1, \1)",
                  {expr(type, depth), expr(type, depth), expr(kInt, depth), expr(kInt, depth)}};
    default: return Expr{type, "CONCAT(\1, \1)", {expr(type, depth), expr(type, depth)}};
  }
}

Node Generator::conversion(int type, int depth) {
  const int from = anyType();
  const bool letter = kTypes[from].kind == Kind::Letter || kTypes[type].kind == Kind::Letter;
  const Kind other = kTypes[kTypes[from].kind == Kind::Letter ? type : from].kind;
  const bool letter_converts = other == Kind::Signed || other == Kind::Unsigned || other == Kind::Bits;
  if (from == type || (letter && !letter_converts)) return leaf(type);
  return Expr{type,
              (chance(70) ? std::string(kTypes[from].name) + "_TO_" : "TO_") + kTypes[type].name + "(\1)",
              {expr(from, depth)}};
}

Node Generator::call(int type, int depth) {
  for (const Function& function : functions_) {
    if (function.result != type || loops_ > 1) continue;
    std::string text = function.name + "(";
    std::vector<Node> arguments;
    for (size_t i = 0; i < function.inputs.size(); ++i) {
      text += (i == 0 ? "in" : ", in") + std::to_string(i) + " := \1";
      arguments.push_back(expr(function.inputs[i], depth));
    }
    return Expr{type, text + ")", std::move(arguments)};
  }
  return expr(type, depth);
}

// ---- statements

Node Generator::assignment() {
  const int type = anyType();
  if (body_ == Body::Program && chance(12)) {
    Node index = subscript(-1, 4, 1);
    return Stmt{"table[\1].count := \1;\n", {std::move(index), expr(kDint, 2)}};
  }
  if (body_ == Body::Program && chance(6)) {
    return Stmt{"grid[\1, \1] := \1;\n", {subscript(1, 2, 1), subscript(0, 2, 1), expr(kInt, 2)}};
  }
  if (body_ == Body::Program && chance(4)) return Stmt{pick({"pair := table[2];\n", "table[0] := pair;\n"})};
  if (body_ == Body::Program && chance(4)) {
    return Stmt{
        chance(50) ? "colour := " + prefix_ + "_Colour#" + pick({"Red", "Green", "Blue"}) + ";\n" : "small := \1;\n",
        {expr(kUsint, 2)}};
  }
  if (chance(3)) return Stmt{"v_int := v_int2 := \1;\n", {expr(kInt, 2)}};
  if (chance(3)) return Stmt{"v_dword.%B" + std::to_string(below(4)) + " := \1;\n", {expr(kWord - 1, 2)}};
  if (chance(3)) return Stmt{"v_lint := \1;\n", {expr(kDint, 3)}};  // widened
  if (body_ == Body::Program && chance(4)) {
    return Stmt{"colour := SEL(\1, other_colour, " + prefix_ + "_Colour#Blue);\n", {expr(kBool, 2)}};
  }
  if (body_ == Body::Function && chance(25)) return Stmt{own_ + " := \1;\n", {expr(own_result_, 3)}};
  return Stmt{writable(type) + " := \1;\n", {expr(type, 3)}};
}

Node Generator::loop(int depth) {
  const std::string n = std::to_string(loops_);
  ++loops_;
  Node result;
  switch (below(4)) {
    case 3: {
      const bool narrow = chance(50);
      result = Stmt{narrow ? "FOR v_usint2 := " + std::to_string(250 + below(6)) + " TO 255 DO\n\1END_FOR\n"
                           : "FOR v_sint2 := -" + std::to_string(120 + below(9)) + " TO -128 BY -" +
                                 std::to_string(1 + below(4)) + " DO\n\1END_FOR\n",
                    {Stmt{"v_lint := v_lint + \1;\n", {Expr{kDint, narrow ? "v_usint2" : "v_sint2"}}}}};
      break;
    }
    case 0: {
      const int type = below(3);
      const std::string control = "i" + n, first = std::to_string(below(5) - (type == 0 ? 2 : 0));
      const bool down = chance(25) && type == 0;
      std::string bounds = down ? "4 TO " + first + " BY -" + std::to_string(1 + below(2)) : first + " TO \1";
      if (!down && chance(30)) bounds += " BY " + std::to_string(1 + below(3));
      std::vector<Node> parts;
      if (!down) {
        Node limit = Expr{kInt, "MIN(\1, 5)", {expr(kInt, 1)}};
        limit.type = -1;
        parts.push_back(std::move(limit));
      }
      parts.push_back(statements(depth, 1 + below(3)));
      result = Stmt{"FOR " + control + " := " + bounds + " DO\n\1END_FOR\n", std::move(parts)};
      break;
    }
    case 1:
      result = Stmt{"n" + n + " := 0;\nWHILE n" + n + " < " + std::to_string(1 + below(5)) + " AND \1 DO\nn" + n +
                        " := n" + n + " + 1;\n\1END_WHILE\n",
                    {expr(kBool, 2), statements(depth, 1 + below(3))}};
      break;
    default:
      result = Stmt{"n" + n + " := 0;\nREPEAT\nn" + n + " := n" + n + " + 1;\n\1UNTIL n" + n +
                        " >= " + std::to_string(1 + below(4)) + " OR \1 END_REPEAT\n",
                    {statements(depth, 1 + below(3)), expr(kBool, 2)}};
  }
  --loops_;
  return result;
}

Node Generator::choice(int depth) {
  if (chance(60)) {
    std::string text = "IF \1 THEN\n\1";
    std::vector<Node> parts{expr(kBool, 3), statements(depth, 1 + below(3))};
    if (chance(40)) {
      text += "ELSIF \1 THEN\n\1";
      parts.push_back(expr(kBool, 2));
      parts.push_back(statements(depth, 1 + below(2)));
    }
    if (chance(50)) {
      text += "ELSE\n\1";
      parts.push_back(statements(depth, 1 + below(2)));
    }
    return Stmt{text + "END_IF\n", std::move(parts)};
  }
  const int type = anyInteger();
  std::string text = "CASE \1 OF\n";
  std::vector<Node> parts{expr(type, 2)};
  int label = 0;
  for (int n = 1 + below(4); n > 0; --n) {
    text += std::to_string(label);
    if (chance(30)) text += ", " + std::to_string(label + 1);
    if (chance(30)) text += ", " + std::to_string(label + 2) + ".." + std::to_string(label + 5);
    label += 6 + below(4);
    text += ":\n\1";
    parts.push_back(statements(depth, 1 + below(2)));
  }
  if (chance(60)) {
    text += "ELSE\n\1";
    parts.push_back(statements(depth, 1));
  }
  return Stmt{text + "END_CASE\n", std::move(parts)};
}

Node Generator::blockCall() {
  switch (below(11)) {
    case 9:
    case 10: {
      const std::string en = chance(30) ? "EN := v_bool, ENO => v_bool2, " : "";
      const std::string io = pick({"pair", "table[0]", "table[3]"});
      return Stmt{pick({"short", "v_string", "pair.title"}) + " := " + prefix_ + "_Access(" + en + "io := " + io +
                      ", given := table[\1], row := row, title := \1, done => v_bool);\n",
                  {subscript(-1, 4, 1), expr(kString, 2)}};
    }
    case 0: return Stmt{pick({"ton", "tof", "tp"}) + "(IN := \1, PT := \1);\n", {expr(kBool, 2), expr(kTime, 1)}};
    case 1: return Stmt{"ctu(CU := \1, RESET := \1, PV := 3, CV => v_word);\n", {expr(kBool, 2), expr(kBool, 1)}};
    case 2: return Stmt{pick({"rise", "fall"}) + "(CLK := \1, Q => v_bool2);\n", {expr(kBool, 2)}};
    case 3: return Stmt{"latch(SET1 := \1, RESET := \1);\n", {expr(kBool, 2), expr(kBool, 1)}};
    default: {
      const int n = below(static_cast<int>(blocks_.size()));
      std::string text = "block" + std::to_string(n) + (chance(25) ? "b(" : "(");
      std::vector<Node> arguments;
      for (size_t i = 0; i < blocks_[n].size(); ++i) {
        if (chance(20)) continue;
        text += "in" + std::to_string(i) + " := \1, ";
        arguments.push_back(expr(blocks_[n][i], 2));
      }
      if (chance(20)) {
        text += "EN := \1, ";
        arguments.push_back(expr(kBool, 1));
      }
      if (chance(20)) text += "ENO => v_bool, ";
      if (chance(50)) text += "out0 => v_dint2, ";
      return Stmt{text + "io := " + pick({"v_dint", "v_dint2", "pair.count", "table[1].count"}) + ");\n",
                  std::move(arguments)};
    }
  }
}

// An operator or function by its call, with EN and ENO: a fault then clears ENO.
Node Generator::guardedCall() {
  const int type = anyInteger();
  const std::string target = "v_" + lowered(kTypes[type].name);
  const std::string en = chance(40) ? "EN := \1, " : "";
  std::vector<Node> arguments;
  if (!en.empty()) arguments.push_back(expr(kBool, 2));
  arguments.push_back(expr(type, 2));
  arguments.push_back(variable(type));
  return Stmt{target + " := " + pick({"DIV", "MOD", "DIV"}) + "(" + en + "IN1 := \1, IN2 := \1, ENO => v_bool);\n",
              std::move(arguments)};
}

Node Generator::statement(int depth) {
  if (loops_ > 0 && chance(7)) {
    return Stmt{"IF \1 THEN " + pick({"EXIT", "CONTINUE"}) + "; END_IF\n", {expr(kBool, 2)}};
  }
  if (body_ != Body::Program && chance(4)) return Stmt{"IF \1 THEN RETURN; END_IF\n", {expr(kBool, 2)}};
  if (depth > 0 && loops_ < 2 && chance(12)) return loop(depth - 1);
  if (depth > 0 && chance(15)) return choice(depth - 1);
  if (body_ == Body::Program && chance(18)) return blockCall();
  if (chance(7)) return guardedCall();
  return assignment();
}

Node Generator::statements(int depth, int count) {
  std::vector<Node> parts;
  std::string text;
  for (int i = 0; i < count; ++i) {
    parts.push_back(statement(depth));
    text += kChild;
  }
  return Stmt{text, std::move(parts)};
}

// ---- POUs

// Two variables of each type, with initial values, and those that loops need.
Node Generator::declarations() {
  std::string text;
  std::vector<Node> parts;
  for (int type = 0; type < kTypeCount; ++type) {
    for (const char* suffix : {"", "2"}) {
      Node init = Expr{type, literal(type)};
      parts.push_back(Stmt{"v_" + lowered(kTypes[type].name) + suffix + " : " + kTypes[type].name + " := \1;\n",
                           {std::move(init)}});
      text += kChild;
    }
  }
  for (const char* line : {"i0 : INT;\n", "i1 : DINT;\n", "n0 : INT;\n", "n1 : USINT;\n"}) {
    parts.push_back(Stmt{line});
    text += kChild;
  }
  return Fixed{"VAR\n" + text + "END_VAR\n", std::move(parts)};
}

Node Generator::makeFunction(int number) {
  Function function;
  function.name = prefix_ + "_F" + std::to_string(number);
  function.result = anyType();
  for (int n = 1 + below(3); n > 0; --n) function.inputs.push_back(anyType());
  own_inputs_ = function.inputs;
  own_ = function.name;
  own_result_ = function.result;
  body_ = Body::Function;
  std::string head = "FUNCTION " + function.name + " : " + kTypes[function.result].name + "\nVAR_INPUT ";
  for (size_t i = 0; i < function.inputs.size(); ++i) {
    head += "in" + std::to_string(i) + " : " + kTypes[function.inputs[i]].name + "; ";
  }
  Node vars = declarations();
  Node body = statements(1, 2 + below(4));
  Node last = Stmt{own_ + " := \1;\n", {expr(own_result_, 3)}};
  functions_.push_back(std::move(function));
  return Stmt{head + "END_VAR\n\1\1\1END_FUNCTION\n\n", {std::move(vars), std::move(body), std::move(last)}};
}

// A function with what goes by reference: an in-out, a structure, an array and a text.
Node Generator::makeAccess() {
  own_inputs_.clear();
  own_ = prefix_ + "_Access";
  own_result_ = kString;
  body_ = Body::Function;
  Node vars = declarations();
  std::vector<Node> lines;
  std::string text;
  for (int n = 2 + below(4); n > 0; --n) {
    text += kChild;
    switch (below(7)) {
      case 0: lines.push_back(Stmt{"io.count := io.count + row[\1];\n", {subscript(0, 2, 1)}}); break;
      case 1: lines.push_back(Stmt{"io.title := CONCAT(title, \1);\n", {expr(kString, 1)}}); break;
      case 2: lines.push_back(Stmt{"io := given;\n"}); break;
      case 3: lines.push_back(Stmt{"done := given.share > io.share;\n"}); break;
      case 4: lines.push_back(Stmt{"given.count := io.count;\n"}); break;
      case 5: lines.push_back(Stmt{own_ + " := CONCAT(title, io.title);\n"}); break;
      default: lines.push_back(statement(1));
    }
  }
  const std::string pair = prefix_ + "_Pair";
  return Stmt{"FUNCTION " + own_ + " : STRING[20]\nVAR_IN_OUT io : " + pair + "; END_VAR\nVAR_INPUT given : " + pair +
                  "; row : ARRAY[0..2] OF INT; title : STRING[5]; END_VAR\nVAR_OUTPUT done : BOOL; "
                  "END_VAR\n\1\1END_FUNCTION\n\n",
              {std::move(vars), Stmt{text, std::move(lines)}}};
}

Node Generator::makeBlock(int number) {
  std::vector<int> inputs;
  for (int n = 1 + below(3); n > 0; --n) inputs.push_back(anyType());
  own_inputs_ = inputs;
  body_ = Body::Block;
  std::string head = "FUNCTION_BLOCK " + prefix_ + "_B" + std::to_string(number) + "\nVAR_INPUT ";
  for (size_t i = 0; i < inputs.size(); ++i) {
    head += "in" + std::to_string(i) + " : " + kTypes[inputs[i]].name + "; ";
  }
  Node vars = declarations();
  Node body = statements(2, 4 + below(5));
  const std::string inner = number > 0 && chance(60) ? "VAR inner : " + prefix_ + "_B0; END_VAR\n" : "";
  const std::string call = inner.empty() ? "" : "inner(io := io);\nv_dint := inner.out0;\n";
  blocks_.push_back(std::move(inputs));
  return Stmt{head + "END_VAR\nVAR_OUTPUT out0 : DINT; END_VAR\nVAR_IN_OUT io : DINT; END_VAR\n" + inner +
                  "\1\1\1END_FUNCTION_BLOCK\n\n",
              {std::move(vars), std::move(body),
               Stmt{call + "io := io + \1;\nout0 := \1;\n", {expr(kDint, 2), expr(kDint, 2)}}}};
}

Node Generator::program() {
  std::vector<Node> parts;
  std::string text;
  parts.push_back(Stmt{"TYPE " + prefix_ + "_Colour : (Red, Green := 4, Blue);\n" + prefix_ +
                       "_Percent : INT (0..100);\n" + prefix_ + "_Small : USINT (3..9);\n" + prefix_ +
                       "_Pair : STRUCT count : DINT; share : REAL := 0.5; title : STRING[7]; END_STRUCT; END_TYPE\n"});
  parts.push_back(Stmt{"VAR_GLOBAL " + prefix_ + "_g_dint : DINT; " + prefix_ + "_g_real : REAL; " + prefix_ +
                       "_g_string : STRING; END_VAR\n"});
  for (int i = 0, n = 1 + below(3); i < n; ++i) parts.push_back(makeFunction(i));
  parts.push_back(makeAccess());
  const int blocks = 1 + below(2);
  for (int i = 0; i < blocks; ++i) parts.push_back(makeBlock(i));
  body_ = Body::Program;
  own_inputs_.clear();

  std::string more = "VAR\n";
  std::vector<Node> lines;
  const auto line = [&](const std::string& content) {
    lines.push_back(Stmt{content + ";\n"});
    more += kChild;
  };
  line("pair : " + prefix_ + "_Pair");
  line("table : ARRAY[-1..4] OF " + prefix_ + "_Pair");
  line("grid : ARRAY[1..2, 0..2] OF INT := [3(1), 2, -5]");
  line("short : STRING[3]");
  line("flags : WORD := 16#A5");
  line("percent : " + prefix_ + "_Percent");
  line("row : ARRAY[0..2] OF INT := [7, -8, 9]");
  line("small : " + prefix_ + "_Small");
  line("colour, other_colour : " + prefix_ + "_Colour");
  line("ton : TON");
  line("tof : TOF");
  line("tp : TP");
  line("ctu : CTU");
  line("rise : R_TRIG");
  line("fall : F_TRIG");
  line("latch : SR");
  for (int i = 0; i < blocks; ++i) {
    const std::string n = std::to_string(i);
    line("block" + n + " : " + prefix_ + "_B" + n);
    line("block" + n + "b : " + prefix_ + "_B" + n);
  }
  line("g_dint : DINT");
  line("g_real : REAL");
  line("g_string : STRING");
  Node vars = declarations();

  line("noise : ULINT := " + std::to_string(random()));
  Node body = statements(3, 8 + below(12));
  Node extra = Fixed{more + "END_VAR\n", std::move(lines)};
  std::vector<Node> inputs{Stmt{"noise := noise * 6364136223846793005 + 1442695040888963407;\n"}};
  for (int i = 0; i < 8; ++i) {
    const int type = chance(40) ? 13 + below(2) : anyType();
    const std::string name = kTypes[type].name;
    const bool is_text = kTypes[type].kind >= Kind::Letter;
    inputs.push_back(is_text ? Stmt{"v_string := ULINT_TO_STRING(noise);\n"}
                             : Stmt{"v_" + lowered(kTypes[type].name) + " := ULINT_TO_" + name + "(SHR(noise, " +
                                    std::to_string(below(60)) + "));\n"});
  }
  Node noise = Stmt{std::string(inputs.size(), kChild), std::move(inputs)};
  parts.push_back(Fixed{"PROGRAM " + prefix_ + "\n\1\1\1\1\1END_PROGRAM\n\n",
                        {std::move(vars), std::move(extra), std::move(noise), std::move(body),
                         Stmt{"g_dint := " + prefix_ + "_g_dint;\ng_real := " + prefix_ +
                              "_g_real;\ng_string := " + prefix_ + "_g_string;\n"}}});
  text.assign(parts.size(), kChild);
  return Fixed{std::move(text), std::move(parts)};
}

void append(const Node& node, std::string& out) {
  if (node.simplified) {
    out += node.simple;
    return;
  }
  if (node.hoisted >= 0) return append(node.children[static_cast<size_t>(node.hoisted)], out);
  size_t next = 0;
  for (const char c : node.text) {
    if (c == kChild) {
      append(node.children[next++], out);
    } else {
      out += c;
    }
  }
}

}  // namespace

std::string Node::print() const {
  std::string out;
  append(*this, out);
  return out;
}

Node generate(uint64_t seed, unsigned index, Faults faults) { return Generator(seed, index, faults).program(); }

}  // namespace rung::differential
