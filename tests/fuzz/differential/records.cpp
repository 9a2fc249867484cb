// SPDX-License-Identifier: Apache-2.0
// Data of generated programs: nested structures with strings, arrays of them, assigned, compared and returned whole,
// strings of several lengths, enumerations, unions, and blocks with methods and properties of such types. The plain
// part is made in every dialect; references, unions and objects in the codesys dialect, REF_TO in edition 3.
#include "frontend/source/dialect.h"
#include "tests/fuzz/differential/generator.h"

namespace rung::differential {

namespace {

// Variables of P_Inner and of P_Outer, `\1` being a subscript from 1 to 2; those that codesys has in addition.
constexpr const char* kInner[] = {"inner",         "inners[\1]",        "rec.head",          "rec.items[\1]",
                                  "recs[\1].head", "recs[1].items[\1]", "recs[\1].items[3]", "pin^",
                                  "rin",           "pout^.head",        "pout^.items[\1]"};
constexpr const char* kOuter[] = {"rec", "recs[\1]", "recs[2]", "spare", "pout^", "rout"};
constexpr int kPlainInner = 7, kPlainOuter = 4;
constexpr int kWideString = 26;

}  // namespace

// A variable of P_Inner (`outer`: P_Outer); its subscript goes to `parts`.
std::string Generator::record(bool outer, std::vector<Node>& parts) {
  const bool all = codesys();
  const std::string text = outer ? kOuter[below(all ? 6 : kPlainOuter)] : kInner[below(all ? 11 : kPlainInner)];
  if (text.find(kChild) != std::string::npos) parts.push_back(subscript(1, 2, 1));
  return text;
}

// A member or an element of the type, always within its bounds; empty when there is none.
std::string Generator::member(int type) {
  if (body_ != Body::Program) return "";
  const std::string in =
      pick({"inner.", "inners[2].", "rec.head.", "rec.items[3].", "recs[1].items[2].", "recs[2].head.",
            codesys() ? "pin^." : "spare.head.", codesys() ? "rout.items[1]." : "spare.items[1]."});
  const std::string out = pick({"rec.", "recs[1].", "recs[2].", "spare.", codesys() ? "pout^." : "rec."});
  if (type == kInt) return in + "id";
  if (type == kSint) return in + pick({"codes[0]", "codes[1]"});
  if (type == kLreal) return out + "total";
  if (type == kBool) return out + "mark";
  if (type == kTime) return out + "span";
  if (type == kWideString) return chance(50) ? in + "wide" : pick({"wides[0]", "wides[1]", "wide1"});
  if (type == kString) return chance(50) ? in + "name" : pick({"names[0]", "names[3]", "tiny", "others3[1]", "long"});
  if (!codesys()) return "";
  if (type == kLword) return pick({"view.whole", "views[1].whole"});
  if (type == kDint) return pick({"view.halves[0]", "view.halves[1]", "views[0].halves[1]", "view.pair.low"});
  if (type == kByte) return pick({"view.bytes[0]", "views[1].bytes[7]", "letters.bytes[2]"});
  if (type == kWord) return pick({"view.pair.high", "views[1].pair.high", "wide_letters.words[1]"});
  return "";
}

// Types, a function with a structure as its result, a block that takes and gives structures and arrays.
void Generator::makeRecords(std::vector<Node>& parts) {
  const auto number = [&](int limit) { return std::to_string(below(limit)); };
  const std::string p = prefix_ + "_";
  const std::string level = codesys()                   ? "(Low := 2, Middle, High := 9) BYTE"
                            : dialect_ == Dialect::Iec3 ? "USINT (Low := 2, Middle := 3, High := 9)"
                                                        : "(Low, Middle, High)";
  std::string types = "TYPE " + p + "Level : " + level + ";\n" + p + "Inner : STRUCT id : INT := " + number(90) +
                      "; name : STRING[4] := 'abcd'; wide : WSTRING[3] := \"xy\"; level : " + p + "Level := " + p +
                      "Level#Middle; codes : ARRAY[0..1] OF SINT := [1, -" + number(9) + "]; END_STRUCT;\n";
  types += p + "Outer : STRUCT head : " + p + "Inner := (id := 7, name := 'xy'); items : ARRAY[1..3] OF " + p +
           "Inner := [2((id := 1, codes := [5, 6])), (name := 'q')]; total : LREAL := 1.5; mark : BOOL; span : TIME; " +
           "END_STRUCT;\n" + p + "Names : ARRAY[0..3] OF STRING[6] := ['a', 'bcdefg', 2('hi')];\nEND_TYPE\n";
  parts.push_back(Stmt{types});
  if (codesys()) {
    parts.push_back(Stmt{"TYPE " + p + "Halves : STRUCT low : DINT; high : WORD; END_STRUCT END_TYPE\nTYPE " + p +
                         "View : UNION whole : LWORD := 16#123456789ABCDEF0; halves : ARRAY[0..1] OF DINT; bytes : "
                         "ARRAY[0..7] OF BYTE; pair : " +
                         p + "Halves; END_UNION END_TYPE\nTYPE " + p +
                         "Letters : UNION text : STRING[7]; bytes : ARRAY[0..7] OF BYTE; END_UNION END_TYPE\nTYPE " +
                         p +
                         "WideLetters : UNION text : WSTRING[3]; words : ARRAY[0..3] OF WORD; END_UNION END_TYPE\n"});
  }

  own_inputs_ = {kInt};
  own_ = "";
  body_ = Body::Block;
  {
    const std::string self = p + "Make";
    std::vector<Node> lines;
    for (int n = 3 + below(4); n > 0; --n) {
      switch (below(9)) {
        case 0: lines.push_back(Stmt{self + ".name := CONCAT(title, \1);\n", {expr(kString, 1)}}); break;
        case 1: lines.push_back(Stmt{self + " := mine.items[\1];\n", {subscript(1, 3, 1)}}); break;
        case 2: lines.push_back(Stmt{"mine.items[\1] := given.head;\n", {subscript(1, 3, 1)}}); break;
        case 3:
          lines.push_back(
              Stmt{self + ".codes[\1] := " + self + ".codes[0] + mine.head.codes[1];\n", {subscript(0, 1, 1)}});
          break;
        case 4: lines.push_back(Stmt{"mine := given;\n"}); break;
        case 5:
          lines.push_back(Stmt{"IF " + self + ".level = mine.items[\1].level THEN " + self + ".id := \1; END_IF\n",
                               {subscript(1, 3, 1), expr(kInt, 2)}});
          break;
        case 6:
          lines.push_back(Stmt{self + ".level := SEL(\1, given.head.level, " + p + "Level#High);\n", {expr(kBool, 1)}});
          break;
        case 7:
          lines.push_back(Stmt{"mine.items[3].wide := CONCAT(mine.head.wide, \1);\n", {expr(kWideString, 1)}});
          break;
        default: lines.push_back(statement(1));
      }
    }
    Node body = Stmt{std::string(lines.size(), kChild), std::move(lines)};
    // A function has no static variables in the declarations of a block.
    body_ = Body::Function;
    Node vars = declarations({&body});
    parts.push_back(Stmt{"FUNCTION " + self + " : " + p + "Inner\nVAR_INPUT in0 : INT; title : STRING[9]; given : " +
                             p + "Outer; END_VAR\nVAR mine : " + p + "Outer; END_VAR\n\1\1" + self + ".id := " + self +
                             ".id + in0;\nEND_FUNCTION\n\n",
                         {std::move(vars), std::move(body)}});
  }
  parts.push_back(Stmt{"FUNCTION " + p + "Fill : " + p +
                       "Names\nVAR_INPUT text : STRING; END_VAR\nVAR k : INT; END_VAR\n"
                       "FOR k := 0 TO 3 DO " +
                       p + "Fill[k] := MID(text, 3, k + 1); END_FOR\n" + p + "Fill[" + number(4) + "] := CONCAT(" + p +
                       "Fill[0], " + p + "Fill[2]);\nEND_FUNCTION\n\n"});

  body_ = Body::Block;
  std::vector<Node> lines;
  for (int n = 3 + below(5); n > 0; --n) {
    switch (below(10)) {
      case 0: lines.push_back(Stmt{"old[0] := old[1];\nold[1] := kept;\n"}); break;
      case 1: lines.push_back(Stmt{"kept := given;\n"}); break;
      case 2:
        lines.push_back(Stmt{"FOR n := 0 TO 3 DO\nIF names[n] " + pick({"=", "<>", "<", ">="}) +
                             " key THEN hits := hits + 1; best.name := list[n]; END_IF\n" +
                             pick({"names[n] := CONCAT(list[n], names[3 - n]);\n", "mine[n] := names[n];\n", ""}) +
                             "END_FOR\n"});
        break;
      case 3: lines.push_back(Stmt{"io := old[\1].items[\1];\n", {subscript(0, 1, 1), subscript(1, 3, 1)}}); break;
      case 4: lines.push_back(Stmt{"best := io;\n"}); break;
      case 5:
        lines.push_back(Stmt{"kept.items[\1] := " + p +
                                 "Make(in0 := \1, title := key, given := " + pick({"kept", "old[0]", "given"}) + ");\n",
                             {subscript(1, 3, 1), expr(kInt, 1)}});
        break;
      case 6: lines.push_back(Stmt{"kept.items := old[\1].items;\n", {subscript(0, 1, 1)}}); break;
      case 7: lines.push_back(Stmt{"mine := " + (chance(50) ? "names" : p + "Fill(key)") + ";\n"}); break;
      case 8:
        lines.push_back(Stmt{"names[\1] := INSERT(key, io.name, \1);\n", {subscript(0, 3, 1), expr(kInt, 1)}});
        break;
      default: lines.push_back(statement(1));
    }
  }
  Node body = Stmt{std::string(lines.size(), kChild), std::move(lines)};
  Node vars = declarations({&body});
  parts.push_back(Stmt{"FUNCTION_BLOCK " + p + "Store\nVAR_INPUT given : " + p + "Outer; key : STRING[5]; list : " + p +
                           "Names; in0 : INT; END_VAR\nVAR_OUTPUT kept : " + p + "Outer; hits : INT; best : " + p +
                           "Inner; END_VAR\nVAR_IN_OUT io : " + p + "Inner; names : " + p +
                           "Names; END_VAR\nVAR old : "
                           "ARRAY[0..1] OF " +
                           p + "Outer := [(mark := TRUE), (total := 0.25)]; n : INT; mine : " + p +
                           "Names; END_VAR\n\1\1END_FUNCTION_BLOCK\n\n",
                       {std::move(vars), std::move(body)}});
  if (codesys()) makeShelves(parts);
}

// An abstract block with an interface, and two that extend it: methods and properties of structures and strings.
void Generator::makeShelves(std::vector<Node>& parts) {
  const std::string p = prefix_ + "_";
  const std::string inner = p + "Inner", outer = p + "Outer";
  const std::string put = "METHOD Put : BOOL\nVAR_INPUT x : " + inner +
                          "; END_VAR\nVAR_IN_OUT CONSTANT text : STRING; "
                          "END_VAR\nVAR_OUTPUT before : " +
                          inner + "; END_VAR\n";
  const std::string take = "METHOD Take : " + inner + "\nVAR_INPUT n : INT; END_VAR\n";
  const std::string end = "END_METHOD\n";
  parts.push_back(Stmt{"INTERFACE " + p + "IR\n" + take + end +
                       "PROPERTY Title : STRING[6]\nGET\nEND_GET\nSET\nEND_SET\n"
                       "END_PROPERTY\nPROPERTY Whole : " +
                       outer + "\nGET\nEND_GET\nEND_PROPERTY\nEND_INTERFACE\n"});
  parts.push_back(Stmt{"FUNCTION_BLOCK ABSTRACT " + p + "R0 IMPLEMENTS " + p + "IR\nVAR own : " + outer +
                       "; heading : STRING[5] := 'r0'; shelf : ARRAY[0..2] OF " + inner +
                       "; ranks : DINT; END_VAR\n"
                       "ranks := ranks + 1;\nshelf[1] := own.head;\n"
                       "METHOD ABSTRACT Rank : DINT\nVAR_INPUT x : " +
                       inner + "; END_VAR\nEND_METHOD\n" + take +
                       "Take := shelf[LIMIT(0, n, 2)];\nTake.id := Take.id + DINT_TO_INT(Rank(Take) MOD 1000);\n" +
                       end + put + "before := shelf[0];\nshelf[0] := x;\nshelf[0].name := " +
                       pick({"text", "CONCAT(before.name, text)", "RIGHT(text, 3)"}) +
                       ";\nPut := shelf[0].name > before.name;\n" + end +
                       "PROPERTY Title : STRING[6]\nGET\nTitle := CONCAT(heading, shelf[2].name);\nEND_GET\nSET\n" +
                       pick({"heading := Title;\n", "shelf[2].name := Title;\n"}) +
                       "END_SET\nEND_PROPERTY\n"
                       "PROPERTY Whole : " +
                       outer +
                       "\nGET\nWhole := own;\nWhole.items[2] := shelf[0];\nEND_GET\nSET\nown := Whole;\n"
                       "shelf[1] := Whole.items[3];\nEND_SET\nEND_PROPERTY\nEND_FUNCTION_BLOCK\n\n"});
  parts.push_back(Stmt{
      "FUNCTION_BLOCK " + p + "R1 EXTENDS " + p + "R0\nVAR more : " + outer +
      "; END_VAR\nSUPER^();\nmore := own;\n"
      "METHOD Rank : DINT\nVAR_INPUT x : " +
      inner + "; END_VAR\nranks := ranks + 1;\nRank := x.id * " + std::to_string(below(9) - 4) + " + ranks;\n" + end +
      (chance(60) ? take + "Take := SUPER^.Take(n + 1);\nTake.name := Title;\nmore.items[3] := Take;\n" + end : "") +
      "END_FUNCTION_BLOCK\n\nFUNCTION_BLOCK FINAL " + p + "R2 EXTENDS " + p + "R1\n" +
      "METHOD Rank : DINT\nVAR_INPUT x : " + inner + "; END_VAR\nRank := SUPER^.Rank(x) + x.codes[1] + LEN(x.name);\n" +
      end +
      (chance(60) ? put + "Put := SUPER^.Put(x := x, text := " + pick({"text", "x.name", "'fixed'"}) +
                        ", before => before);\nbefore.id := before.id + 1;\n" + end
                  : "") +
      (chance(60) ? "PROPERTY Title : STRING[6]\nGET\nTitle := CONCAT('<', SUPER^.Title);\nEND_GET\nSET\nSUPER^.Title "
                    ":= DELETE(Title, 1, 1);\nEND_SET\nEND_PROPERTY\n"
                  : "") +
      "END_FUNCTION_BLOCK\n\n"});
  parts.push_back(Stmt{
      "FUNCTION " + p + "Visit : INT\nVAR_INPUT shelves : ARRAY[0..2] OF " + p + "IR; copy : " + p +
      "View; END_VAR\n"
      "VAR_IN_OUT base : " +
      p + "R0; view : " + p + "View; END_VAR\nVAR n : INT; got : " + inner +
      "; END_VAR\n"
      "FOR n := 0 TO 2 DO\ngot := shelves[n].Take(n);\n" +
      p + "Visit := " + p +
      "Visit + got.id;\nshelves[n].Title := got.name;\n"
      "END_FOR\nbase.Put(x := got, text := shelves[1].Title, before => got);\nview.pair := copy.pair;\nview.bytes[" +
      std::to_string(below(8)) + "] := INT_TO_BYTE(got.id);\nEND_FUNCTION\n\n"});
}

Node Generator::shelfStatement() {
  const std::string p = prefix_ + "_", shelf = pick({"r1", "r2", "r1b", "shelves[2]", "base^"});
  std::vector<Node> parts;
  switch (below(12)) {
    case 0: {
      const std::string on = shelf;
      const std::string to = record(false, parts);
      parts.push_back(expr(kInt, 2));
      return Stmt{to + " := " + on + ".Take(\1);\n", std::move(parts)};
    }
    case 1: {
      const std::string from = record(false, parts);
      const std::string on = shelf == "shelves[2]" ? "r2" : shelf;
      return Stmt{"v_bool := " + on + ".Put(x := " + from +
                      ", text := " + pick({"names[1]", "v_string", "rec.head.name", "'lit'"}) + ", before => " +
                      pick({"inner", "rec.items[2]", "pin^"}) + ");\n",
                  std::move(parts)};
    }
    case 2: return Stmt{shelf + ".Title := \1;\n", {expr(kString, 2)}};
    case 3: return Stmt{pick({"tiny", "names[2]", "inner.name", "v_string"}) + " := " + shelf + ".Title;\n"};
    case 4: {
      const std::string to = record(true, parts);
      return Stmt{to + " := " + shelf + ".Whole;\n", std::move(parts)};
    }
    case 5: {
      const std::string from = record(true, parts);
      return Stmt{pick({"r1", "r2", "base^"}) + ".Whole := " + from + ";\n", std::move(parts)};
    }
    case 6: return Stmt{pick({"base := ADR(r1);\n", "base := ADR(r2);\n", "base := ADR(r1b);\n"})};
    case 7: return Stmt{"shelves[\1] := " + pick({"r1", "r2", "r1b", "shelves[0]"}) + ";\n", {subscript(0, 2, 1)}};
    case 8: return Stmt{pick({"r1();\n", "r2();\n", "base^();\n", "r1 := r1b;\n"})};
    case 9:
      return Stmt{"v_int := " + p + "Visit(shelves := shelves, copy := views[\1], base := " +
                      pick({"r1", "r2", "base^"}) + ", view := " + pick({"view", "views[0]"}) + ");\n",
                  {subscript(0, 1, 1)}};
    case 10: return Stmt{writable(kInt) + " := " + shelf + ".Whole.items[2].id;\n"};
    default: return Stmt{writable(kDint) + " := base^.Rank(" + pick({"inner", "rec.head", "pin^"}) + ");\n"};
  }
}

Node Generator::unionStatement() {
  switch (below(9)) {
    case 0: return Stmt{"view.whole := \1;\n", {expr(kLword, 2)}};
    case 1: return Stmt{"views[\1].bytes[\1] := \1;\n", {subscript(0, 1, 1), subscript(0, 7, 1), expr(kByte, 2)}};
    case 2: return Stmt{"view.halves[\1] := \1;\n", {subscript(0, 1, 1), expr(kDint, 2)}};
    case 3:
      return Stmt{pick({"view := views[1];\n", "views[0] := view;\n", "views[1] := views[0];\n",
                        "view.pair := views[1].pair;\n", "halved := view.pair;\n", "views[0].pair := halved;\n"})};
    case 4: return Stmt{"letters.text := \1;\n", {expr(kString, 2)}};
    case 5: return Stmt{"wide_letters.text := \1;\n", {expr(kWideString, 2)}};
    case 6: return Stmt{writable(kByte) + " := letters.bytes[\1];\n", {subscript(0, 7, 1)}};
    case 7: return Stmt{writable(kWord) + " := wide_letters.words[\1];\n", {subscript(0, 3, 1)}};
    default: return Stmt{"view.pair.low := \1;\n" + writable(kLword) + " := view.whole;\n", {expr(kDint, 2)}};
  }
}

Node Generator::recordStatement() {
  const std::string p = prefix_ + "_";
  std::vector<Node> parts;
  if (codesys() && chance(35)) return shelfStatement();
  if (codesys() && chance(20)) return unionStatement();
  switch (below(codesys() ? 18 : 15)) {
    case 0: {
      const std::string to = record(false, parts), from = record(false, parts);
      return Stmt{to + " := " + from + ";\n", std::move(parts)};
    }
    case 1: {
      const std::string to = record(true, parts), from = record(true, parts);
      return Stmt{to + " := " + from + ";\n", std::move(parts)};
    }
    case 2:
      return Stmt{pick({"rec.items := recs[1].items;\n", "names := others3;\n", "inner.codes := rec.head.codes;\n",
                        "recs[2].items := rec.items;\n", "recs := recs2;\n", "recs2[1] := recs[2];\n",
                        "inners := inners2;\n"})};
    case 3: {
      const std::string to = record(false, parts);
      parts.push_back(expr(kInt, 2));
      parts.push_back(expr(kString, 2));
      const std::string from = record(true, parts);
      return Stmt{to + " := " + p + "Make(in0 := \1, title := \1, given := " + from + ");\n", std::move(parts)};
    }
    case 4:
    case 5: {
      const std::string from = record(true, parts);
      parts.push_back(expr(kString, 2));
      return Stmt{"store(given := " + from + ", key := \1, list := " + pick({"names", "others3"}) + ", io := " +
                      pick({"inner", "rec.items[1]", "recs[2].head"}) + ", names := " + pick({"names", "others3"}) +
                      pick({"", ", kept => spare", ", best => inners[1], hits => v_int"}) + ");\n",
                  std::move(parts)};
    }
    case 6: return Stmt{pick({"names", "others3"}) + "[\1] := \1;\n", {subscript(0, 3, 1), expr(kString, 3)}};
    case 7: return Stmt{pick({"tiny", "inner.name", "rec.items[2].name"}) + " := \1;\n", {expr(kString, 3)}};
    case 8:
      return Stmt{pick({"wides[1]", "wide1", "inner.wide", "recs[1].head.wide"}) + " := \1;\n", {expr(kWideString, 3)}};
    case 9: {
      ++cases_;
      Node low = statements(1, 1), high = statements(1, 1), other = statements(1, 1);
      --cases_;
      return Stmt{"CASE " + pick({"level", "levels[1]", "rec.head.level", "inner.level"}) + " OF\n" + p +
                      "Level#Low:\n\1" + p + "Level#Middle, " + p + "Level#High:\n\1ELSE\n\1END_CASE\n",
                  {std::move(low), std::move(high), std::move(other)}};
    }
    case 10:
      return Stmt{pick({"level", "levels[0]", "rec.items[1].level", "inner.level"}) +
                  " := " + pick({"level", "levels[2]", "rec.head.level", "inners[1].level"}) + ";\n"};
    case 11: {
      const std::string to = pick({"level", "levels[\1]", "inner.level"});
      if (to.find(kChild) != std::string::npos) parts.push_back(subscript(0, 2, 1));
      parts.push_back(expr(kBool, 2));
      return Stmt{to + " := SEL(\1, " + p + "Level#Low, " + pick({"levels[1]", "inner.level"}) + ");\n",
                  std::move(parts)};
    }
    case 12:
      if (codesys() && chance(50)) return Stmt{writable(kString) + " := " + p + "Fill(\1)[2];\n", {expr(kString, 1)}};
      return Stmt{pick({"names", "others3"}) + " := " + p + "Fill(\1);\n", {expr(kString, 1)}};
    case 13:
      return Stmt{
          "FOR i2 := 1 TO 2 DO\nrecs[i2].items[i2] := rec.items[3 - i2];\nrecs[i2].total := recs[3 - i2].total * 0.5 + "
          "\1;\nEND_FOR\n",
          {expr(kLreal, 1)}};
    case 14:
      return Stmt{"IF " + pick({"names[1]", "tiny", "inner.name", "long"}) + pick({" = ", " < ", " <> ", " >= "}) +
                      pick({"names[2]", "others3[0]", "rec.head.name"}) + " THEN\n\1END_IF\n",
                  {statements(1, 1)}};
    case 15:
      return Stmt{pick({"pin := ADR(inner);\n", "pin := ADR(rec.items[2]);\n", "pin := ADR(recs[1].head);\n",
                        "rin REF= rec.head;\n", "rin REF= recs[2].items[3];\n", "pout := ADR(recs[2]);\n",
                        "pout := ADR(rec);\n", "rout REF= recs[1];\n", "rout REF= spare;\n", "rin REF= pin^;\n",
                        "pin := ADR(rout.head);\n"})};
    case 16:
      return Stmt{pick({"names[1]", "long", "v_string"}) + "[\1] := \1;\n", {subscript(0, 5, 1), expr(kByte, 1)}};
    default:
      return Stmt{writable(kByte) + " := " + pick({"names[2]", "long", "others3[1]"}) + "[\1];\n",
                  {subscript(0, 5, 1)}};
  }
}

std::vector<Lvalue> Generator::recordLvalues() const {
  const std::string p = prefix_ + "_";
  std::vector<Lvalue> all = {
      {"rec", p + "Outer", ""},
      {"recs", "ARRAY[1..2] OF " + p + "Outer := [(mark := TRUE, head := (wide := \"z\")), (total := 2.5)]", ""},
      {"recs2", "ARRAY[1..2] OF " + p + "Outer", ""},
      {"spare", p + "Outer := (items := [3((name := 'n', level := " + p + "Level#High))])", ""},
      {"inner", p + "Inner := (id := -3, name := 'long')", ""},
      {"inners", "ARRAY[1..2] OF " + p + "Inner", ""},
      {"inners2", "ARRAY[1..2] OF " + p + "Inner := [(id := 44), (codes := [8, 9])]", ""},
      {"names", p + "Names", ""},
      {"others3", p + "Names := [2('xyz'), '', '123456']", ""},
      {"wides", "ARRAY[0..1] OF WSTRING[5] := [\"wide\"]", ""},
      {"wide1", "WSTRING[1]", ""},
      {"tiny", "STRING[1] := 't'", ""},
      {"long", "STRING[200] := 'a long one'", ""},
      {"level", p + "Level := " + p + "Level#High", ""},
      {"levels", "ARRAY[0..2] OF " + p + "Level := [2(" + p + "Level#Low), " + p + "Level#Middle]", ""},
      {"store", p + "Store", ""},
      {"i2", "INT", ""}};
  if (!codesys()) return all;
  const std::vector<Lvalue> more = {
      {"view", p + "View", ""},
      {"views", "ARRAY[0..1] OF " + p + "View", ""},
      {"halved", p + "Halves := (low := -1, high := 16#FEDC)", ""},
      {"letters", p + "Letters", ""},
      {"wide_letters", p + "WideLetters", ""},
      {"r1", p + "R1", ""},
      {"r1b", p + "R1 := (heading := 'b', own := (mark := TRUE))", ""},
      {"r2", p + "R2", ""},
      {"shelves", "ARRAY[0..2] OF " + p + "IR", "shelves[0] := r1;\nshelves[1] := r1b;\nshelves[2] := r2;\n"},
      {"base", "POINTER TO " + p + "R0", "base := ADR(r2);\n"},
      {"pin", "POINTER TO " + p + "Inner", "pin := ADR(inners[1]);\n"},
      {"rin", "REFERENCE TO " + p + "Inner", "rin REF= rec.items[2];\n"},
      {"pout", "POINTER TO " + p + "Outer", "pout := ADR(recs2[2]);\n"},
      {"rout", "REFERENCE TO " + p + "Outer", "rout REF= recs2[1];\n"}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace rung::differential
