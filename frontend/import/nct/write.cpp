// SPDX-License-Identifier: Apache-2.0
// Writes an NCT program as ST; see write.h.
//
// Power becomes a BOOL expression as long as nothing may change what it reads, and a temporary `_p1` before each
// element that may: so every element acts at its own place, from left to right and from top to bottom.
#include "frontend/import/nct/write.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "frontend/import/diagnostics.h"
#include "frontend/import/nct/bodies.h"
#include "frontend/import/nct/operands.h"
#include "frontend/import/nct/places.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::nct {
namespace {

// The power at a place of a rung.
struct Power {
  std::string text = "TRUE";
  bool is_atom = true;       // a temporary or a constant: nothing changes it
  bool is_or = false;        // needs parentheses as an operand of AND
  bool has_contact = false;  // on every way from the left rail
};

// Sums and addresses are cut to 32 bits, whatever --checks says.
constexpr std::string_view kWraps = "{attribute 'no_check'}\n";

struct Branch {
  Power power;
  bool closed = false;
};

class Writer {
 public:
  Writer(const Program& program, Memory& memory, const LadderSettings& settings, Diagnostics& diagnostics,
         xml::SourceMappedText& out)
      : program_(program),
        memory_(memory),
        settings_(settings),
        diagnostics_(diagnostics),
        out_(out),
        places_(program, memory),
        operands_(program, memory, diagnostics) {}

  void run() {
    keeps_flags_ = readsFlags(program_.main) || readsFlags(program_.int0);
    // Int0 first: what it drives with `!` is known when Main is checked.
    if (program_.int0.given) writeModule(program_.int0, "Int0");
    writeModule(program_.main, "Main");
    operands_.checkDrivers();
    places_.writeTo(out_);
    writeTasks();
  }

 private:
  // ---- names

  std::string fresh(std::string_view kind, uint32_t& counter) {
    std::string name;
    do name = "_" + std::string(kind) + std::to_string(++counter);
    while (memory_.find(name) != nullptr);
    return name;
  }
  std::string temporary() {
    while (powers_used_ >= powers_.size()) {
      powers_.push_back(fresh("p", power_count_));
    }
    return powers_[powers_used_++];
  }
  std::string hidden(std::string_view kind, std::string_view type) {
    std::string name = fresh(kind, hidden_count_[std::string(kind)]);
    state_.put(loc_, "  " + name + " : " + std::string(type) + ";\n");
    return name;
  }

  Report report(Diag diag, const Word& at, std::initializer_list<std::string_view> arguments) {
    return reportAt(diagnostics_, diag, at, arguments);
  }

  // Tells whether anything may read word 0000. A symbol of a constant index counts as one of a register.
  bool readsFlags(const Module& module) const {
    const auto may = [](std::string_view text) {
      const size_t comma = text.find_first_of(",;");
      if (comma != std::string_view::npos && text.substr(comma + 1, 1) != "#") return true;
      const std::string upper_case = upper(text);
      return upper_case.find("FL_") != std::string::npos || upper_case.find("FLAGS") != std::string::npos ||
             text.find("#-") != std::string_view::npos || upper_case.find("0000") != std::string::npos ||
             upper_case == "PLCBIT" || upper_case == "PLCINT" || upper_case == "PLCDOUBLE";
    };
    for (const SymbolLine& line : program_.symbols)
      if (may(line.value.text)) return true;
    for (const Element& element : module.elements)
      for (size_t k = 0; k < element.operand_count; ++k)
        if (may(element.operands[k].text)) return true;
    return false;
  }

  // ---- modules

  void writeModule(const Module& module, std::string_view title) {
    in_int0_ = title == "Int0";
    elements_ = module.elements;
    state_ = {};
    hidden_count_.clear();
    finds_messages_ = false;
    operands_.enterModule(in_int0_);
    bodies_ = findBodies(module, diagnostics_);
    Pieces bodies;
    std::swap(bodies, text_);
    for (const Body& body : bodies_.list) writeBody(body);
    std::swap(bodies, text_);

    const Loc loc = module.given ? module.loc : program_.end;
    const std::string name = std::string(program_.name.text) + "_" + std::string(title);
    out_.put(program_.name.loc, std::string(kWraps) + "PROGRAM " + name + "\n");
    out_.put(loc, in_int0_ ? "VAR\n  _flags, _flags_of_main : DWORD;\n  _started : BOOL;\n" : "VAR\n");
    state_.addTo(out_);
    out_.put(loc, "END_VAR\n");
    if (in_int0_) {
      out_.put(loc, "IF NOT _started THEN\n  _started := TRUE;\n");
      for (const auto& [word, bit] : operands_.owned())
        out_.put(loc, "  NCT_OWN(" + std::to_string(word) + ", " + std::to_string(bit) + ");\n");
      out_.put(loc,
               "END_IF\nNCT_BEGIN_INT0();\n_flags_of_main := NCT_FLAGS;\nNCT_FLAGS := _flags;\n_cyclic();\n"
               "_flags := NCT_FLAGS;\nNCT_FLAGS := _flags_of_main;\n");
    } else {
      writeTitles(loc);
      out_.put(loc, "NCT_BEGIN_MAIN();\n_cyclic();\nNCT_END_MAIN();\n");
    }
    bodies.addTo(out_);
    writeMessageFinder(loc);
    out_.put(module.given ? module.loc : program_.end, "END_PROGRAM\n");
  }

  void writeTitles(Loc loc) {
    if (program_.buttons.empty()) return;
    std::string text = "IF NCT_CYCLES = 0 THEN\n";
    for (const ButtonLine& button : program_.buttons)
      text += "  NCT_CONTROL_TITLE(" + std::to_string(button.number) + ", " + stringLiteral(button.title) + ");\n";
    out_.put(loc, text + "END_IF\n");
  }

  // ---- bodies

  void writeBody(const Body& body) {
    powers_.clear();
    power_count_ = 0;
    Pieces statements;
    std::swap(statements, text_);
    bool returns = false;
    for (uint32_t k = body.begin; k < body.end;) {
      const Element& element = elements_[k];
      if (element.shape != Shape::Rung) {
        if (isMarker(elements_[k], "JME") && labelOf(element) >= 0)
          text_.put(element.word.loc, "l" + std::to_string(labelOf(element)) + ": ;\n");
        ++k;
        continue;
      }
      uint32_t end = k + 1;
      while (end < body.end && elements_[end].shape != Shape::Rung && elements_[end].shape != Shape::Marker) ++end;
      returns = writeRung(k, end, body.label >= 0);
      k = end;
    }
    std::swap(statements, text_);
    if (body.label >= 0 && body.label <= kMostLabel && !returns)
      diagnostics_.report(diag::NctNoReturn, body.loc, {std::to_string(body.label)});

    text_.put(body.loc, std::string(kWraps) + "METHOD PRIVATE " + nameOf(body) + "\n");
    if (!powers_.empty()) {
      std::string section = "VAR\n ";
      for (const std::string& name : powers_) section += (&name == powers_.data() ? " " : ", ") + name;
      text_.put(body.loc, section + " : BOOL;\nEND_VAR\n");
    }
    text_.add(statements);
    text_.put(body.loc, "END_METHOD\n");
  }
  static std::string nameOf(const Body& body) {
    return body.label < 0 ? "_cyclic" : "_sub" + std::to_string(body.label);
  }

  // True: an unconditional RET ends it.
  bool writeRung(uint32_t rung, uint32_t end, bool in_subroutine) {
    powers_used_ = 0;
    nodes_.clear();
    in_subroutine_ = in_subroutine;
    loc_ = elements_[rung].word.loc;
    if (elements_[rung].is_broken) return true;
    if (rung + 1 == end) {
      report(diag::NctRowOpen, elements_[rung].word, {"this rung is empty; write its elements or delete it"});
      return false;
    }
    returned_ = false;
    writeSeries(rung + 1, end, {}, true);
    for (const auto& [name, node] : nodes_)
      if (!node.read) report(diag::NctNode, node.word, {node.word.text, "no AT follows it in this rung"});
    return returned_;
  }

  // A series of elements. `is_last`: nothing reads the power after it.
  Branch writeSeries(uint32_t begin, uint32_t end, Power power, bool is_last) {
    uint32_t at = begin;
    const Element* last = nullptr;
    bool closed = false;
    while (at < end) {
      const Element& element = elements_[at];
      if (closed) {
        report(diag::NctRowOpen, element.word,
               {"`" + std::string(element.word.text) + "` follows an element that closes the row; branch before it"});
        return {power, true};
      }
      loc_ = element.word.loc;
      uint32_t next = afterElement(elements_, at);
      const bool takes_box = element.shape == Shape::PinsBegin && next < end && elements_[next].shape == Shape::Pinned;
      if (takes_box) ++next;  // writePins writes it
      last = takes_box ? &elements_[next - 1] : &element;
      const bool is_end = is_last && next >= end;
      closed = writeElement(at, power, is_end);
      at = next;
    }
    if (is_last && !closed) checkEnd(last);
    return {power, closed};
  }

  // Checks the element at the end of a row.
  //   fails   a contact, or nothing                                                 E1412
  void checkEnd(const Element* last) {
    if (last == nullptr) {
      diagnostics_.report(diag::NctRowOpen, loc_, {"this branch is empty and leads nowhere"});
      return;
    }
    switch (last->shape) {
      case Shape::Contact:
      case Shape::CompareContact:
      case Shape::At:
        report(diag::NctRowOpen, last->word,
               {"`" + std::string(last->word.text) + "` cannot close a row; add a coil or a box"});
        break;
      case Shape::Timer:
      case Shape::Pinned:
      case Shape::Message: report(diag::NctUnusedOutput, last->word, {last->word.text}); break;
      case Shape::Coil:
      case Shape::Compare:
      case Shape::Box:
      case Shape::Order:
      case Shape::Service:
      case Shape::Jump:
      case Shape::Marker:
      case Shape::Rung:
      case Shape::GroupBegin:
      case Shape::PinsBegin:
      case Shape::BranchBegin:
      case Shape::GroupEnd:
      case Shape::PinsEnd:
      case Shape::To: break;
    }
  }

  void put(std::string_view text) { text_.put(loc_, text); }

  static void join(Power& power, const std::string& term, bool is_or = false) {
    if (power.text == "TRUE") {
      power.text = term;
      power.is_or = is_or;
    } else {
      power.text = (power.is_or ? "(" + power.text + ")" : power.text) + " AND " + (is_or ? "(" + term + ")" : term);
      power.is_or = false;
    }
    power.is_atom = false;
  }

  // Reads all that the power depends on now.
  void settle(Power& power) {
    if (power.is_atom) return;
    const std::string name = temporary();
    put(name + " := " + power.text + ";\n");
    power.text = name;
    power.is_atom = true;
    power.is_or = false;
  }

  // Statements that run while there is power.
  void beginIf(const Power& power) {
    if (power.text != "TRUE") put("IF " + power.text + " THEN\n");
  }
  void endIf(const Power& power) {
    if (power.text != "TRUE") put("END_IF\n");
  }

  // True: the row is closed.
  bool writeElement(uint32_t at, Power& power, bool is_end) {
    const Element& element = elements_[at];
    switch (element.shape) {
      case Shape::Contact: writeContact(element, power); return false;
      case Shape::CompareContact: writeCompareContact(element, power); return false;
      case Shape::Coil: writeCoil(element, power); return true;
      case Shape::Compare: writeOrder(element, power); return true;
      case Shape::Box: writeBox(element, power, is_end); return false;
      case Shape::Order: writeOrder(element, power); return false;
      case Shape::Timer: writeTimer(element, power); return false;
      case Shape::Message: writeMessage(element, power); return false;
      case Shape::Service: writeService(element, power); return false;
      case Shape::Pinned:
        report(diag::NctPins, element.word, {element.word.text, "write its inputs before it: `[ CK` … `]`"});
        return false;
      case Shape::Jump: writeJump(element, power); return true;
      case Shape::GroupBegin: return writeGroup(at, power, is_end);
      case Shape::PinsBegin: writePins(at, power); return false;
      case Shape::To: writeTo(element, power); return true;
      case Shape::At: writeAt(element, power); return false;
      case Shape::PinsEnd:
      case Shape::Marker:
      case Shape::Rung:
      case Shape::BranchBegin:
      case Shape::GroupEnd: return false;
    }
    return false;
  }

  // Boxes and coils are not connected to the left rail without a contact. NCT manual 6.2.
  //   fails   RUNG / OUT 6000.00                                                   E1413
  void needContact(const Element& element, const Power& power) {
    if (!power.has_contact) report(diag::NctOnRail, element.word, {element.word.text});
  }

  void writeContact(const Element& element, Power& power) {
    power.has_contact = true;
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    const Operand& operand = operands[0];
    const Address& address = operand.address;
    const bool negated = sameIdentifier(element.word.text, "INN");
    const Space space = operand.query == Query::Immediate ? Space::TimeSlice : Space::Plc;
    const bool conducts =
        address.symbol != nullptr && !address.symbol->is_user && address.symbol->name == (negated ? "N_OFF" : "N_ON");
    if (conducts && operand.query == Query::Level) return;
    const bool edge = operand.query == Query::Rising || operand.query == Query::Falling;
    std::string term;
    if (!address.is_static()) {
      settle(power);  // a bad address sets FL_ER
      term = temporary();
      const std::string what = !address.is_bit             ? "NCT_IS_SET("
                               : space == Space::TimeSlice ? "NCT_IMMEDIATE("
                                                           : "NCT_BIT(";
      const std::string place = places_.wordOf(address) + (address.is_bit ? ", " + places_.bitOf(address) : "");
      if (edge) {
        const std::string shadow = hidden("edges", address.bit_from >= 0 ? "NCT_BIT_EDGES" : "NCT_WORD_EDGES");
        const std::string bit = address.is_bit ? places_.bitOf(address) : "-1";
        put(shadow + "(address := " + places_.wordOf(address) + ", bit := " + bit +
            ", falling := " + (operand.query == Query::Falling ? "TRUE" : "FALSE") + ");\n");
        put(term + " := " + shadow + (negated ? ".reached AND NOT " + shadow + ".Q" : ".Q") + ";\n");
      } else {
        put(term + " := " + what + place + (negated ? ", negated := TRUE" : "") + ");\n");
      }
      join(power, term);
      return;
    }
    const std::string place = places_.of(address, address.is_bit ? Part::Bit : Part::Word, space);
    const std::string value = address.is_bit ? place : place + " <> 0";
    if (!edge) {
      if (!address.is_bit)
        join(power, place + (negated ? " = DWORD#0" : " <> DWORD#0"));
      else
        join(power, (negated ? "NOT " : "") + place);
      return;
    }
    const std::string before = hidden("edge", "BOOL");
    const std::string now = address.is_bit ? place : "(" + place + " <> DWORD#0)";
    term = temporary();
    put(term + " := " + (operand.query == Query::Rising ? now + " AND NOT " + before : before + " AND NOT " + now) +
        ";\n");
    put(before + " := " + (address.is_bit ? place : place + " <> DWORD#0") + ";\n");
    join(power, (negated ? "NOT " : "") + term);
  }

  // `FL_ER := FALSE` of an instruction that cannot fail.
  std::string clearError() { return keeps_flags_ ? errorFlag() + " := FALSE; " : ""; }
  // FL_ER, which has this name where the ladder writes it.
  static std::string errorFlag() { return "NCT_ERROR"; }

  // Tells whether all dynamic operands are in memory; empty: there are none. `result`: operand 0 is written.
  std::string reaches(const Element& element, std::span<const Operand> operands) {
    std::string text;
    const std::string_view kinds = element.instruction->operands;
    size_t at = 0;
    for (const char kind : kinds) {
      if (kind == '?') continue;
      if (at >= operands.size()) break;
      const Operand& operand = operands[at++];
      if (!operand.isDynamic()) continue;
      const bool is_double = kind == 'W' || kind == 'R' || kind == 'f';
      const bool writes = kind == 'w' || kind == 'W' || kind == 't' || kind == 'b' || kind == 'u';
      if (!text.empty()) text += " AND ";
      text += std::string(writes ? "NCT_MAY_WRITE(" : "NCT_REACHES(") + places_.wordOf(operand.address) + ", " +
              (is_double                ? "-2"
               : operand.address.is_bit ? places_.bitOf(operand.address)
                                        : "-1") +
              ")";
    }
    return text;
  }

  void writeCompareContact(const Element& element, Power& power) {
    power.has_contact = true;
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    std::string_view pattern = element.instruction->flagged;
    const bool fails = pattern.starts_with("!");
    if (fails) pattern.remove_prefix(1);
    const std::string guard = reaches(element, operands), term = places_.filled(pattern, operands);
    if (!fails && guard.empty() && !keeps_flags_) return join(power, "(" + term + ")");
    settle(power);
    const std::string name = temporary();
    put(name + " := FALSE;\n");
    beginIf(power);
    if (guard.empty()) {
      put("  " + name + " := " + term + "; " + (fails ? "" : clearError()) + "\n");
    } else {
      putGuarded(element, guard, name + " := " + term + ";" + (fails ? "" : " " + errorFlag() + " := FALSE;"));
    }
    endIf(power);
    power.text = name;
  }

  void writeCoil(const Element& element, Power& power) {
    needContact(element, power);
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    const Address& address = operands[0].address;
    const std::string word = upper(element.word.text);
    const bool immediate = operands[0].query == Query::Immediate;
    std::string value = power.text;
    if (word == "DIFU" || word == "DIFD") {
      settle(power);
      const std::string before = hidden("edge", "BOOL"), pulse = temporary();
      put(pulse + " := " + (word == "DIFU" ? power.text + " AND NOT " + before : before + " AND NOT " + power.text) +
          ";\n");
      put(before + " := " + power.text + ";\n");
      value = pulse;
    } else if (word == "OUTN") {
      value = "NOT " + (power.is_atom ? power.text : "(" + power.text + ")");
    }
    const bool stores = word == "SET" || word == "RST";
    if (stores) beginIf(power);
    const std::string stored = stores ? (word == "SET" ? "TRUE" : "FALSE") : value;
    if (address.is_static())
      put(places_.of(address, Part::Bit, immediate ? Space::TimeSlice : Space::Plc) + " := " + stored + ";");
    else
      put((immediate ? "NCT_PUT_IMMEDIATE(" : "NCT_PUT_BIT(") + places_.wordOf(address) + ", " +
          places_.bitOf(address) + ", " + stored + ");");
    put("\n");
    if (stores) endIf(power);
  }

  // Runs a statement if `guard` holds; else FL_ER, and no other flag of the instruction.
  void putGuarded(const Element& element, const std::string& guard, const std::string& statement) {
    put("  IF " + guard + " THEN " + statement + "\n  ELSE NCT_REFUSE(" + std::to_string(element.instruction->flags) +
        "); END_IF\n");
  }

  void writeBox(const Element& element, Power& power, bool is_end) {
    needContact(element, power);
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    std::string_view pattern =
        keeps_flags_ || element.instruction->plain.empty() ? element.instruction->flagged : element.instruction->plain;
    const bool fails = pattern.starts_with("!");
    if (fails) pattern.remove_prefix(1);
    // An instruction without flags of its own leaves FL_ER to the writer.
    const bool clears = !fails && pattern.find("NCT_") == std::string_view::npos;
    const bool is_double = element.instruction->operands[0] == 'W';
    const std::string guard = reaches(element, operands), value = places_.filled(pattern, operands);
    const Operand& result = operands[0];
    const std::string stored =
        result.isDynamic()
            ? std::string(is_double ? "NCT_PUT_DOUBLE(" : "NCT_PUT_WORD(") + places_.wordOf(result.address) + ", " +
                  value + ");"
            : places_.of(result.address, is_double ? Part::Double : Part::Word, Space::Plc) + " := " + value + ";";
    const bool may_fail = fails || !guard.empty();
    if (!is_end) settle(power);
    beginIf(power);
    if (guard.empty()) {
      put("  " + stored + (clears ? " " + clearError() : std::string()) + "\n");  // an operand may be FLAGS
    } else {
      putGuarded(element, guard, stored + (clears ? " " + errorFlag() + " := FALSE;" : std::string()));
    }
    endIf(power);
    if (!is_end && may_fail) outputUnlessError(power);
  }
  void outputUnlessError(Power& power) {
    const std::string name = temporary();
    put(name + " := " + power.text + " AND NOT " + errorFlag() + ";\n");
    power.text = name;
  }

  // An instruction that writes nothing by itself, or not as its result.
  void writeOrder(const Element& element, Power& power) {
    needContact(element, power);
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    std::string_view pattern = element.instruction->flagged;
    const bool fails = pattern.starts_with("!");
    if (fails) pattern.remove_prefix(1);
    const std::string guard = reaches(element, operands), call = places_.filled(pattern, operands) + ";";
    settle(power);
    beginIf(power);
    if (guard.empty()) {
      put("  " + call + "\n");
    } else {
      putGuarded(element, guard, call);
    }
    endIf(power);
    if (element.shape == Shape::Order) outputUnlessError(power);
  }

  // A timer, or a counter with the inputs in `pins`.
  void callInstance(const Element& element, std::span<const Operand> operands, const std::string& pins,
                    std::string_view inputs, Power& power) {
    const std::string instance = hidden("box", element.instruction->flagged);
    const std::string guard = reaches(element, operands);
    const bool is_dynamic = operands[0].isDynamic();
    const std::string place =
        is_dynamic ? hidden("word", "DWORD") : places_.of(operands[0].address, Part::Word, Space::Plc);
    std::string call = instance + "(" + pins + (guard.empty() ? "" : ", reached := " + guard) + ", value := " + place;
    for (size_t k = 1, begin = 0; k < operands.size(); ++k) {
      const size_t end = std::min(inputs.find(' ', begin), inputs.size());
      call += ", " + std::string(inputs.substr(begin, end - begin)) + " := " + places_.asInteger(operands[k]);
      begin = end + 1;
    }
    // Outside of memory a word reads as 0 and is not written.
    if (is_dynamic) put(place + " := NCT_WORD(" + places_.wordOf(operands[0].address) + ");\n");
    put(call + ");\n");
    if (is_dynamic) put("NCT_PUT_WORD(" + places_.wordOf(operands[0].address) + ", " + place + ");\n");
    takeOutput(instance, power);
  }

  // Nothing calls an instance again in the rung.
  static void takeOutput(const std::string& instance, Power& power) {
    power.text = instance + ".Q";
    power.is_atom = true;
    power.is_or = false;
    power.has_contact = true;
  }

  void writeTimer(const Element& element, Power& power) {
    needContact(element, power);
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    settle(power);
    const std::string enable = "EN := " + power.text;
    const int64_t ms = writtenTime(operands);
    if (ms < 0 || operands[0].isDynamic()) return callInstance(element, operands, enable, "preset basis", power);
    const std::string instance = hidden("box", element.instruction->plain);
    put(instance + "(" + enable + ", preset := " + std::to_string(ms) +
        ", value := " + places_.of(operands[0].address, Part::Word, Space::Plc) + "); " + clearError() + "\n");
    takeOutput(instance, power);
  }
  // The time of a timer in milliseconds, where it is written in the ladder and right; else -1.
  static int64_t writtenTime(std::span<const Operand> operands) {
    constexpr int64_t kUnits[] = {1, 1000, 60'000, 3'600'000};
    if (operands[1].kind != OperandKind::Integer || operands[2].kind != OperandKind::Integer) return -1;
    const int64_t preset = operands[1].value, basis = operands[2].value;
    if (basis < 0 || basis > 3 || preset < 0) return -1;
    const int64_t ms = preset * kUnits[basis];
    return ms <= INT32_MAX ? ms : -1;
  }

  // An instance of the library that asks the numerical control; `inputs` are those after EN. It is called in each
  // cycle, because it does something when the power falls, too.
  void askControl(const Element& element, std::span<const Operand> operands, std::string_view type,
                  const std::string& inputs, Power& power) {
    settle(power);
    const std::string guard = reaches(element, operands), instance = hidden("request", type), output = temporary();
    std::string enable = power.text;
    if (!guard.empty()) {
      enable = temporary();
      put(enable + " := " + power.text + " AND_THEN (" + guard + ");\n");
    }
    put(instance + "(EN := " + enable + inputs + ");\n");
    if (keeps_flags_ || !guard.empty()) {
      beginIf(power);
      put("  " + errorFlag() + " := " + (guard.empty() ? "" : "NOT " + enable + " OR ") + instance + ".ER;\n");
      endIf(power);
    }
    put(output + " := " + instance + ".Q;\n");
    power.text = output;
    power.is_atom = true;
    power.is_or = false;
    power.has_contact = true;
  }

  // MSG, ALR, REM and their forms with F. NCT manual 6.13.
  void writeMessage(const Element& element, Power& power) {
    needContact(element, power);
    std::vector<Operand> operands;
    if (!operands_.take(element, operands) || !operands_.checkMessage(element, operands)) return;
    const std::string word = upper(element.word.text);
    const bool is_double = word.ends_with("F");
    const int kind = (word.starts_with("REM") ? 2 : word.starts_with("ALR") ? 3 : 1) + (is_double ? 4 : 0);
    std::string text;
    if (operands[0].kind == OperandKind::Integer) {
      text = textOf(operands[0].value);
    } else {
      text = "_message(number := " + places_.asInteger(operands[0]) + ")";
      finds_messages_ = true;
    }
    std::string inputs = ", kind := " + std::to_string(kind) + ", number := " + places_.asInteger(operands[0]) +
                         ", channel := " + places_.asInteger(operands[1]) +
                         ", index := " + places_.asInteger(operands[2]) + ", text := " + text;
    if (operands.size() > 3)
      inputs +=
          is_double ? ", double := " + places_.asDouble(operands[3]) : ", integer := " + places_.asInteger(operands[3]);
    askControl(element, operands, "NCT_MESSAGE", inputs, power);
  }
  std::string textOf(int64_t number) const {
    for (const MessageLine& line : program_.messages)
      if (line.number == number) return stringLiteral(line.text);
    return "''";
  }
  // In ST: `$` and quotes are escaped there.
  static std::string stringLiteral(std::string_view text) {
    std::string literal = "'";
    for (const char c : text) {
      if (c == '\'' || c == '$') literal += '$';
      literal += c;
    }
    return literal + "'";
  }
  // The text of a message whose number is in a word.
  void writeMessageFinder(Loc loc) {
    if (!finds_messages_) return;
    std::string text = "METHOD PRIVATE _message : STRING(255)\nVAR_INPUT number : DINT; END_VAR\nCASE number OF\n";
    for (const MessageLine& line : program_.messages)
      text += "  " + std::to_string(line.number) + ": _message := " + stringLiteral(line.text) + ";\n";
    out_.put(loc, text + "END_CASE\nEND_METHOD\n");
  }

  // MOVCMND, MR, MW. NCT manual 6.15, 6.18.
  void writeService(const Element& element, Power& power) {
    needContact(element, power);
    std::vector<Operand> operands;
    if (!operands_.take(element, operands)) return;
    if (element.instruction->word == "MOVCMND") {
      askControl(element, operands, "NCT_MOVCMND",
                 ", axis := " + places_.asInteger(operands[0]) + ", code := " + places_.asInteger(operands[1]) +
                     ", speed := " + places_.asDouble(operands[2]) + ", distance := " + places_.asDouble(operands[3]),
                 power);
      return;
    }
    operands_.checkService(element, operands);
    const bool writes = element.instruction->word == "MW";
    askControl(element, operands, "NCT_SERVICE",
               std::string(", writes := ") + (writes ? "TRUE" : "FALSE") + ", address := " +
                   places_.wordOf(operands[0].address) + ", service := " + places_.asInteger(operands[1]),
               power);
  }

  void writeJump(const Element& element, Power& power) {
    needContact(element, power);
    const std::string word = upper(element.word.text);
    if (word == "RET") {
      if (!in_subroutine_) report(diag::NctMisplaced, element.word, {"`RET`", "only a subroutine returns"});
      returned_ = power.text == "TRUE";
      beginIf(power);
      put("RETURN;\n");
      endIf(power);
      return;
    }
    std::vector<Operand> operands;
    if (!operands_.take(element, operands) || bodies_.broken_jumps.count(&element) != 0) return;
    const std::string label = std::to_string(operands[0].value);
    settle(power);
    beginIf(power);
    put((word == "JMP" ? "JMP l" + label : "_sub" + label + "()") + ";\n");
    endIf(power);
  }

  // ---- branches

  // Tells whether the elements only read, so that they can be one expression.
  bool onlyReads(uint32_t begin, uint32_t end) const {
    for (uint32_t k = begin; k < end; ++k) {
      const Element& element = elements_[k];
      const bool structural =
          element.shape == Shape::GroupBegin || element.shape == Shape::BranchBegin || element.shape == Shape::GroupEnd;
      if (structural) continue;
      if (element.shape != Shape::Contact || element.operand_count == 0) return false;
      const std::string_view text = element.operands[0].text;
      const size_t comma = text.find_first_of(",;:");
      if (comma != std::string_view::npos && (text[comma] == ':' || text.substr(comma + 1, 1) != "#")) return false;
    }
    return true;
  }

  bool writeGroup(uint32_t at, Power& power, bool is_end) {
    const uint32_t end = afterElement(elements_, at) - 1;
    const bool pure = !is_end && onlyReads(at + 1, end);
    const bool had_contact = power.has_contact;
    if (!pure) settle(power);
    std::string sum, name;
    bool all_closed = true, all_contacts = true, wired = false;
    for (uint32_t branch = at; branch != end; branch = elements_[branch].next) {
      Power start = power;
      if (pure) start.text = "TRUE", start.is_atom = true;
      start.has_contact = had_contact;
      const Branch result = writeSeries(branch + 1, elements_[branch].next, start, is_end);
      if (result.closed) continue;
      all_closed = false;
      all_contacts = all_contacts && result.power.has_contact;
      const bool wire = pure && result.power.text == "TRUE";
      wired = wired || wire;
      if (is_end) continue;
      if (pure) {
        sum += (sum.empty() ? "" : " OR ") + (result.power.is_or ? "(" + result.power.text + ")" : result.power.text);
      } else if (name.empty()) {
        name = temporary();
        put(name + " := " + result.power.text + ";\n");
      } else {
        put(name + " := " + name + " OR " + (result.power.is_atom ? result.power.text : "(" + result.power.text + ")") +
            ";\n");
      }
    }
    if (all_closed) return true;
    power.has_contact = had_contact || all_contacts;
    if (is_end) return true;  // each branch was checked
    if (!pure) {
      power.text = name;
      power.is_atom = true;
      power.is_or = false;
    } else if (!wired) {
      join(power, sum, sum.find(" OR ") != std::string::npos);
    }
    return false;
  }

  struct PinForm {
    std::string_view word, pins, inputs;
  };
  static constexpr PinForm kPinForms[] = {
      {"CNT", "CK U/D R", "first last compare"},
      {"CNTR", "CK U/D R", "first last compare"},
      {"SHTR", "CK L/R D", ""},
      {"ROT", "EN BID DIR INC PRE", "current goal first last"},
  };

  // [ CK … | U/D … ] and the box after it.
  void writePins(uint32_t at, Power& power) {
    const uint32_t close = afterElement(elements_, at) - 1;
    const Element* const box = close + 1 < elements_.size() ? &elements_[close + 1] : nullptr;
    if (box == nullptr || box->shape != Shape::Pinned) {
      report(diag::NctPins, elements_[at].word, {"`[`", "CNT, CNTR, SHTR or ROT follows the `]`"});
      return;
    }
    const PinForm* form = nullptr;
    for (const PinForm& row : kPinForms)
      if (sameIdentifier(row.word, box->word.text)) form = &row;
    settle(power);
    std::string given, pins;
    bool all = true;
    for (uint32_t branch = at; branch != close; branch = elements_[branch].next) {
      const Element& pin = elements_[branch];
      if (!given.empty()) given += " ";
      given += pin.pin.text;
      const Branch result = writeSeries(branch + 1, elements_[branch].next, power, false);
      loc_ = pin.word.loc;
      if (result.closed || !result.power.has_contact || elements_[branch].next == branch + 1) {
        report(diag::NctPins, pin.word,
               {"`" + std::string(pin.pin.text) + "`",
                result.closed ? "a coil cannot end a pin" : "a pin needs a contact"});
        all = false;
      }
      Power value = result.power;
      settle(value);
      const std::string name = pin.pin.text == "U/D" ? "UD" : pin.pin.text == "L/R" ? "LR" : std::string(pin.pin.text);
      pins += (pins.empty() ? "" : ", ") + name + " := " + value.text;
    }
    if (given != form->pins) {
      report(diag::NctPins, box->word, {box->word.text, "its pins are " + std::string(form->pins) + ", in this order"});
      all = false;
    }
    loc_ = box->word.loc;
    std::vector<Operand> operands;
    power.has_contact = true;
    if (!operands_.take(*box, operands) || !all) return;
    callInstance(*box, operands, pins, form->inputs, power);
  }

  void writeTo(const Element& element, Power& power) {
    if (element.operand_count == 0) return;
    Node& node = nodes_[upper(element.operands[0].text)];
    if (node.read) {
      report(diag::NctNode, element.operands[0], {element.operands[0].text, "all TO of a node are before its AT"});
      return;
    }
    const bool is_new = node.name.empty();
    if (is_new) {
      node.name = temporary();
      node.word = element.operands[0];
      node.has_contact = true;
    }
    node.has_contact = node.has_contact && power.has_contact;
    put(node.name + " := " +
        (is_new ? power.text : node.name + " OR " + (power.is_atom ? power.text : "(" + power.text + ")")) + ";\n");
  }
  void writeAt(const Element& element, Power& power) {
    if (element.operand_count == 0) return;
    const auto node = nodes_.find(upper(element.operands[0].text));
    if (node == nodes_.end() || node->second.read) {
      report(diag::NctNode, element.operands[0],
             {element.operands[0].text, node == nodes_.end() ? "no TO is before it" : "a node has one AT"});
      return;
    }
    node->second.read = true;
    power.text = (power.is_atom || !power.is_or ? power.text : "(" + power.text + ")") + " OR " + node->second.name;
    power.is_or = true;
    power.is_atom = false;
    power.has_contact = power.has_contact && node->second.has_contact;
  }

  void writeTasks() {
    const std::string name(program_.name.text);
    std::string text = "CONFIGURATION _nct RESOURCE _control ON PLC\n";
    const auto time = [](int64_t ns) { return "LTIME#" + std::to_string(ns) + "ns"; };
    if (program_.int0.given) text += "TASK Int0(INTERVAL := " + time(settings_.time_slice_ns) + ", PRIORITY := 0);\n";
    text += "TASK Main(INTERVAL := " + time(settings_.plc_period_ns) + ", PRIORITY := 1);\n";
    if (program_.int0.given) text += "PROGRAM Int0 WITH Int0 : " + name + "_Int0;\n";
    text += "PROGRAM Main WITH Main : " + name + "_Main;\nEND_RESOURCE END_CONFIGURATION\n";
    out_.put(program_.name.loc, text);
  }

  struct Node {
    std::string name;
    Word word;
    bool read = false, has_contact = false;
  };

  const Program& program_;
  Memory& memory_;
  const LadderSettings& settings_;
  Diagnostics& diagnostics_;
  xml::SourceMappedText& out_;

  Places places_;
  Operands operands_;
  Pieces text_, state_;
  Loc loc_;  // of the element that is being written
  bool keeps_flags_ = false;
  bool finds_messages_ = false;  // in the module

  std::span<const Element> elements_;
  bool in_int0_ = false;
  Bodies bodies_;
  std::unordered_map<std::string, uint32_t> hidden_count_;

  bool in_subroutine_ = false, returned_ = false;
  std::vector<std::string> powers_;  // of the body
  size_t powers_used_ = 0;           // in the rung
  uint32_t power_count_ = 0;
  std::map<std::string, Node> nodes_;
};

}  // namespace

void write(const Program& program, Memory& memory, const LadderSettings& settings, Diagnostics& diagnostics,
           xml::SourceMappedText& out) {
  Writer(program, memory, settings, diagnostics, out).run();
}

}  // namespace rung::importer::nct
