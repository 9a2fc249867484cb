// SPDX-License-Identifier: Apache-2.0
// Expressions of generated programs: each has a type, and a depth that it does not exceed.
#include "frontend/source/dialect.h"
#include "frontend/source/text.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

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
      if (type == kTime) return "T#" + pick({"0s", "10ms", "25ms", "1s", "1h2m3s", "7d", codesys() ? "40d" : "20d"});
      return "LTIME#" + pick({"0s", "10ms", "25us", "1s", "1h2m3s", "7d", "40d"});
    case Kind::Date:
      if (type == kTod) return pick({"TOD#00:00:00", "TOD#12:34:56.789", "TOD#23:59:59.999"});
      if (type == kDt) return pick({"DT#1970-01-01-00:00:00", "DT#2024-02-29-12:34:56", "DT#2099-12-31-23:59:59"});
      if (type == kLtod) return pick({"LTOD#00:00:00", "LTOD#12:34:56.789012345"});
      if (type == kLdt) return pick({"LDT#1970-01-01-00:00:00", "LDT#2024-02-29-12:34:56.000000001"});
      return (type == kLtod - 1 ? "LDATE#" : "D#") + pick({"1970-01-01", "2024-02-29", "2099-12-31"});
    case Kind::Letter:
      return type == kChar ? pick({"CHAR#'a'", "CHAR#'Z'", "CHAR#'$FF'"}) : pick({"WCHAR#\"a\"", "WCHAR#\"$1234\""});
    case Kind::String:
      return pick({"''", "'a'", "'Rung'", "'12'", "'-3.5'", "'A longer text, with $$ and $''", "'xyzzy'"});
    case Kind::WideString: return pick({"\"\"", "\"a\"", "\"Rung\"", "\"12\"", "\"wide and long\""});
  }
  return "0";
}

std::string lowered(const char* name) {
  std::string text = name;
  for (char& c : text) c = foldedCharacter(c);
  return text;
}

std::string Generator::readable(int type) {
  if (body_ != Body::Program && chance(40)) {
    for (size_t i = 0; i < own_inputs_.size(); ++i) {
      if (own_inputs_[i] == type) return "in" + std::to_string(i);
    }
  }
  if (chance(5)) return "c_" + lowered(kTypes[type].name);
  if (chance(12)) {
    if (const std::string parts = part(type); !parts.empty()) return parts;
  }
  return writable(type);
}

// A variable of the type. Every body may use the same local ones; declarations() finds those that it uses.
std::string Generator::writable(int type) {
  const std::string name = lowered(kTypes[type].name);
  if (chance(25)) {
    if (const std::string place = led(type); !place.empty()) return place;
  }
  if (chance(12)) {
    if (const std::string place = member(type); !place.empty()) return place;
  }
  if (body_ == Body::Program) {
    if (type == kDint && chance(25))
      return chance(50) ? "pair.count" : "table[" + std::to_string(below(6) - 1) + "].count";
    if (type == kReal && chance(25)) return "pair.share";
    if (type == kString && chance(30)) return chance(50) ? "short" : "pair.title";
    if (type == kInt && codesys() && chance(20)) return "percent";
    if (type == kInt && chance(20))
      return "grid[" + std::to_string(below(2) + 1) + ", " + std::to_string(below(3)) + "]";
    if (type == kDword && codesys() && chance(20)) return "mix.whole";
    if (type == kByte && codesys() && chance(20)) return "mix.bytes[" + std::to_string(below(4)) + "]";
  }
  if (chance(12) && (type == kDint || type == kReal || type == kString)) return prefix_ + "_g_" + name;
  if (chance(12) && (type == kBool || type == kByte || type == kWord || type == kDword || type == kInt))
    return prefix_ + "_at_" + name;
  return "v_" + name + (chance(40) ? "2" : "");
}

// A bit, byte, word or double word of a variable; empty when the type is none of them.
std::string Generator::part(int type) {
  if (dialect_ == Dialect::Iec2 || (type != kBool && (type < kByte || type > kDword))) return "";
  int whole = (type == kBool ? kByte : type + 1) + below(type == kBool ? 4 : kLword - type);
  int bits = 8 << (whole - kByte);
  const int wide = type == kBool ? 1 : 8 << (type - kByte);
  std::string name = "v_" + lowered(kTypes[whole].name);
  if (codesys() && chance(40)) {
    const std::string place = led(whole);
    if (!place.empty()) name = place;
  } else if (whole != kLword && chance(15)) {
    name = prefix_ + "_at_" + lowered(kTypes[whole].name);
  } else if (codesys() && chance(20)) {
    name = "v_" + lowered(kTypes[whole - kByte + kSint].name);
  }
  name += ".";
  const char* letter[] = {"B", "W", "D"};
  // A part of a part: the last decides.
  if (codesys() && whole - 1 > (type == kBool ? kByte - 1 : type) && chance(25)) {
    --whole;
    bits /= 2;
    name += std::string("%") + letter[whole - kByte] + std::to_string(below(2)) + ".";
  }
  const std::string place = std::to_string(below(bits / wide));
  if (type == kBool && codesys() && chance(20)) return name + prefix_ + "_k5";
  if (type == kBool) return name + (codesys() && chance(50) ? "" : "%X") + place;
  return name + "%" + letter[type - kByte] + place;
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
  if (Node method; chance(15) && methodOf(type, depth - 1, method)) return method;
  if (type == kDint && body_ == Body::Program && codesys() && loops_ < 2 && chance(8)) {
    std::vector<Node> parts;
    const std::string object = receiver(0, false, parts);
    return Expr{type, object + "Level", std::move(parts)};
  }
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
    case Kind::String:
    case Kind::WideString: return text(type, depth - 1);
  }
  return leaf(type);
}

Node Generator::boolean(int depth) {
  switch (below(10)) {
    case 0: return Expr{kBool, "NOT \1", {expr(kBool, 0)}};
    case 1:
      if (!codesys()) return leaf(kBool);
      return Expr{kBool, "(\1 " + pick({"AND_THEN", "OR_ELSE"}) + " \1)", {expr(kBool, depth), expr(kBool, depth)}};
    case 2:
    case 3: return Expr{kBool, "(\1 " + pick({"AND", "OR", "XOR"}) + " \1)", {expr(kBool, depth), expr(kBool, depth)}};
    case 4: {
      const std::string parts = part(kBool);
      return parts.empty() ? leaf(kBool) : Expr{kBool, parts};
    }
    case 5:
      return body_ == Body::Program
                 ? Expr{kBool, pick({"ton.Q", "tof.Q", "tp.Q", "ctu.Q", "rise.Q", "fall.Q", "latch.Q1"})}
                 : leaf(kBool);
    default: {
      if (body_ == Body::Program && chance(10)) {
        return Expr{kBool, "(colour " + pick({"=", "<>", codesys() ? "<" : "="}) + " other_colour)"};
      }
      const int type = anyType();
      return Expr{
          kBool, "(\1 " + pick({"=", "<>", "<", "<=", ">", ">="}) + " \1)", {expr(type, depth), expr(type, depth)}};
    }
  }
}

// A value that may be 0 but is not known to be: rung rejects a division by a constant 0.
Node Generator::variable(int type) {
  Node node = Expr{type, writable(type)};
  node.fixed = true;
  return node;
}

Node Generator::divisor(int type, int depth) {
  if (faults_ == Faults::Division && chance(30)) return variable(type);
  if (kTypes[type].kind != Kind::Signed) {
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
  return offset(first, last, depth);
}

// Always inside the array: nothing checks where a pointer points.
Node Generator::offset(int first, int last, int depth) {
  const std::string low = std::to_string(first), high = std::to_string(last);
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
    case 3:
      if (bitArithmetic())
        return Expr{type, "(\1 " + pick({"+", "-", "*"}) + " \1)", {expr(type, depth), expr(type, depth)}};
      return leaf(type);
    default: return Expr{type, "(\1 " + pick({"AND", "OR", "XOR"}) + " \1)", {expr(type, depth), expr(type, depth)}};
  }
}

Node Generator::real(int type, int depth) {
  switch (below(7)) {
    case 6: {
      const int exponent = chance(50) ? kInt : kReal;
      return Expr{type, chance(50) ? "EXPT(\1, \1)" : "(\1 ** \1)", {expr(type, depth), expr(exponent, depth)}};
    }
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
}  // namespace rung::differential
