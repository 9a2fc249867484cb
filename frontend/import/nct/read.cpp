// SPDX-License-Identifier: Apache-2.0
// Reads the lines of a `.nct` file; see program.h. One element a line, blanks between words, `//` begins a comment.
#include <algorithm>
#include <charconv>
#include <unordered_map>

#include "frontend/import/diagnostics.h"
#include "frontend/import/nct/messages.h"
#include "frontend/import/nct/program.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::nct {
namespace {

#define NCT_INSTRUCTION(word, shape, operands, flags, flagged, plain) \
  {word, Shape::shape, operands, flags, flagged, plain},
constexpr Instruction kInstructions[] = {
#include "frontend/import/nct/instructions.def"
};
#undef NCT_INSTRUCTION

constexpr std::string_view kPins[] = {"CK", "U/D", "R", "L/R", "D", "EN", "BID", "DIR", "INC", "PRE"};
constexpr uint32_t kMostNesting = 200;
constexpr uint32_t kMostButton = 32;

struct Line {
  std::vector<Word> words;  // without strings
  Word text;                // the string after them, without its quotes
  bool has_text = false;
};

bool readNumber(std::string_view text, uint32_t most, uint32_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value <= most;
}

class ProgramReader {
 public:
  ProgramReader(const Sources& sources, FileId file, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), source_(sources.sourceText(file)), base_(sources.begin(file).offset) {}

  Program run() {
    at_ = source_.size() - withoutMark(source_).size();
    while (begins_part_ || nextLine()) {
      begins_part_ = false;
      readTopLevel();
    }
    program_.end = loc(source_.size());
    if (program_.name.empty() && !says_no_program_)
      diagnostics_.report(diag::NctMisplaced, program_.end, {"the file", "begin it with `PROGRAM name`"});
    return std::move(program_);
  }

 private:
  Loc loc(size_t at) const { return {base_ + static_cast<uint32_t>(at)}; }

  // ---- lines

  // The next line with a word. False: the file ends.
  bool nextLine() {
    while (at_ < source_.size()) {
      line_.words.clear();
      line_.has_text = false;
      readLine();
      if (!line_.words.empty() || line_.has_text) return true;
    }
    return false;
  }

  void readLine() {
    while (at_ < source_.size() && source_[at_] != '\n') {
      if (isBlankCharacter(source_[at_])) {
        ++at_;
      } else if (source_.substr(at_, 2) == "//") {
        at_ = std::min(source_.find('\n', at_), source_.size());
      } else if (source_[at_] == '"') {
        readText();
      } else {
        const size_t begin = at_;
        while (at_ < source_.size() && source_[at_] != '\n' && !isBlankCharacter(source_[at_]) && source_[at_] != '"' &&
               source_.substr(at_, 2) != "//")
          ++at_;
        const Word word{source_.substr(begin, at_ - begin), loc(begin)};
        if (line_.has_text) report(diag::NctMisplaced, word, {quoted(word.text), "a text is the last of its line"});
        line_.words.push_back(word);
      }
    }
    if (at_ < source_.size()) ++at_;
  }

  void readText() {
    const size_t begin = ++at_;
    while (at_ < source_.size() && source_[at_] != '\n') {
      if (source_[at_] == '"') {
        if (at_ + 1 >= source_.size() || source_[at_ + 1] != '"') break;
        ++at_;
      }
      ++at_;
    }
    line_.text = {source_.substr(begin, at_ - begin), loc(begin)};
    line_.has_text = true;
    if (at_ < source_.size() && source_[at_] == '"')
      ++at_;
    else
      diagnostics_.report(diag::NctNotClosed, loc(begin - 1), {"the text", "\""});
  }

  // A quote in a text is doubled.
  static std::string unquoted(std::string_view text) {
    std::string out;
    for (size_t k = 0; k < text.size(); ++k) {
      out += text[k];
      if (text[k] == '"') ++k;
    }
    return out;
  }
  static std::string quoted(std::string_view text) { return "`" + std::string(text) + "`"; }
  Report report(Diag diag, const Word& at, std::initializer_list<std::string_view> arguments) {
    return reportAt(diagnostics_, diag, at, arguments);
  }
  bool is(size_t word, std::string_view keyword) const {
    return word < line_.words.size() && sameIdentifier(line_.words[word].text, keyword);
  }
  Word first() const { return line_.words.empty() ? Word{"\"", line_.text.loc} : line_.words[0]; }
  void expectWords(size_t count, std::string_view form) {
    if (line_.words.size() != count) report(diag::NctMisplaced, first(), {"this line", form});
  }

  // ---- the parts of a file

  void readTopLevel() {
    if (is(0, "PROGRAM")) {
      expectWords(2, "write `PROGRAM name`");
      if (line_.words.size() < 2) return void(says_no_program_ = true);
      if (!program_.name.empty()) report(diag::NctMisplaced, first(), {"a second `PROGRAM`", "a file has one program"});
      program_.name = line_.words[1];
      if (!isIdentifier(program_.name.text))
        report(diag::NctMisplaced, program_.name, {quoted(program_.name.text), "a name has letters, digits and `_`"});
    } else if (is(0, "SYMBOLS")) {
      readBlock("END_SYMBOLS", [&] { readSymbol(); });
    } else if (is(0, "MESSAGES")) {
      readBlock("END_MESSAGES", [&] { readMessage(); });
    } else if (is(0, "BUTTONS")) {
      readBlock("END_BUTTONS", [&] { readButton(); });
    } else if (is(0, "MODULE")) {
      readModule();
    } else {
      const Word word = first();
      report(diag::NctMisplaced, word,
             {quoted(word.text), findInstruction(word.text) != nullptr ? "an instruction belongs into a MODULE"
                                                                       : "here PROGRAM, SYMBOLS, MESSAGES, BUTTONS or "
                                                                         "MODULE is expected"});
    }
  }

  template <class ReadLine>
  void readBlock(std::string_view end, ReadLine read) {
    const Word opener = first();
    expectWords(1, "nothing may follow this word");
    while (nextLine()) {
      if (is(0, end)) return;
      begins_part_ = is(0, "MODULE") || is(0, "PROGRAM") || is(0, "SYMBOLS");
      if (begins_part_) break;
      read();
    }
    report(diag::NctNotClosed, opener, {quoted(opener.text), end});
  }

  void readSymbol() {
    const auto& words = line_.words;
    if (words.size() < 2 || words.size() > 3)
      return void(report(diag::NctMisplaced, first(), {"this line", "write `NAME address` or `NAME #constant`"}));
    SymbolLine symbol{words[0], words[1], words.size() > 2 ? words[2] : Word{}};
    if (!isIdentifier(symbol.name.text))
      return void(
          report(diag::NctMisplaced, symbol.name, {quoted(symbol.name.text), "a name has letters, digits and `_`"}));
    if (!symbol.marker.empty() && !is(2, "DWORD") && !is(2, "DOUBLE"))
      return void(report(diag::NctMisplaced, symbol.marker, {quoted(symbol.marker.text), "write DWORD or DOUBLE"}));
    program_.symbols.push_back(symbol);
  }

  // The number at the begin of a line that ends with a text.
  bool readNumbered(uint32_t most, std::string_view form, uint32_t& number) {
    if (line_.words.size() == 1 && line_.has_text && readNumber(line_.words[0].text, most, number) && number > 0)
      return true;
    report(diag::NctMisplaced, first(), {"this line", form});
    return false;
  }
  void readMessage() {
    uint32_t number = 0;
    if (!readNumbered(kMostMessage, "write a number from 1 to 999 and a text", number))
      return void(program_.lost_messages = true);
    for (const MessageLine& other : program_.messages)
      if (other.number == number)
        return void(
            report(diag::NctTwice, first(), {"message " + std::to_string(number)}).declaredHere(other.written.loc));
    program_.messages.push_back({number, line_.text, unquoted(line_.text.text)});
    checkMessageText(program_.messages.back(), diagnostics_);
  }
  void readButton() {
    uint32_t number = 0;
    if (!readNumbered(kMostButton, "write a number from 1 to 32 and a title", number)) return;
    for (const ButtonLine& other : program_.buttons)
      if (other.number == number) return void(report(diag::NctTwice, first(), {"button " + std::to_string(number)}));
    program_.buttons.push_back({number, unquoted(line_.text.text)});
  }

  // ---- modules

  void readModule() {
    const Word opener = first();
    Module* module = is(1, "MAIN") ? &program_.main : is(1, "INT0") ? &program_.int0 : nullptr;
    if (module == nullptr) {
      report(diag::NctMisplaced, line_.words.size() > 1 ? line_.words[1] : opener,
             {"this line", "the modules are MAIN and INT0"});
      module = &program_.main;
    } else if (module->given) {
      report(diag::NctTwice, line_.words[1], {"module " + std::string(line_.words[1].text)}).declaredHere(module->loc);
      module = &lost_;
    }
    module->given = true;
    module->loc = opener.loc;
    module_ = module;
    in_rung_ = false;
    while (nextLine()) {
      if (is(0, "END_MODULE")) {
        closeRung();
        return;
      }
      begins_part_ = is(0, "MODULE") || is(0, "SYMBOLS") || is(0, "MESSAGES");
      if (begins_part_) break;
      readElement();
    }
    closeRung();
    report(diag::NctNotClosed, opener, {"`MODULE`", "END_MODULE"});
  }

  Element& add(Shape shape, const Word& word) {
    Element element{};
    element.shape = shape;
    element.word = word;
    if (line_.has_text) element.remark = line_.text.text;
    module_->elements.push_back(element);
    return module_->elements.back();
  }
  uint32_t last() const { return static_cast<uint32_t>(module_->elements.size()) - 1; }

  void closeRung() {
    while (!open_.empty()) {
      const Element& opener = module_->elements[open_.back().begin];
      report(diag::NctNotClosed, opener.word, {quoted(opener.word.text), opener.shape == Shape::PinsBegin ? "]" : ")"});
      closeBranches(opener.shape == Shape::PinsBegin ? Shape::PinsEnd : Shape::GroupEnd);
    }
  }

  struct Open {
    uint32_t begin, branch;
  };
  void closeBranches(Shape end) {
    const Open open = open_.back();
    open_.pop_back();
    add(end, module_->elements[open.begin].word).next = open.begin;
    module_->elements[open.branch].next = last();
  }

  void readElement() {
    const Word word = first();
    if (is(0, "RUNG")) {
      closeRung();
      add(Shape::Rung, word);
      expectWords(1, "the elements of a rung have lines of their own");
      in_rung_ = true;
      return;
    }
    if (readStructure(word)) return;
    const Instruction* instruction = findInstruction(word.text);
    if (instruction == nullptr) {
      std::vector<std::string_view> words;
      for (const Instruction& row : kInstructions) words.push_back(row.word);
      report(diag::NctUnknownWord, word, {word.text}).didYouMean(nearest(word.text, words));
      breakRung();
      return;
    }
    if (instruction->shape == Shape::Marker) {
      closeRung();
      in_rung_ = false;
    } else if (!in_rung_) {
      report(diag::NctMisplaced, word, {quoted(word.text), "write RUNG before the first element of a rung"});
      in_rung_ = true;
    }
    Element& element = add(instruction->shape, word);
    element.instruction = instruction;
    takeOperands(element);
  }

  // What follows from a missing line is not reported.
  void breakRung() {
    for (size_t k = module_->elements.size(); k-- > 0;) {
      if (module_->elements[k].shape != Shape::Rung) continue;
      module_->elements[k].is_broken = true;
      return;
    }
  }

  void takeOperands(Element& element) {
    const std::string_view kinds = element.instruction->operands;
    const size_t optional = std::min(kinds.find('?'), kinds.size());
    const size_t most = kinds.size() - (optional < kinds.size() ? 1 : 0);
    const size_t given = line_.words.size() - 1;
    if (given < optional || given > most) {
      const std::string wanted =
          optional == most ? std::to_string(most) : std::to_string(optional) + " or " + std::to_string(most);
      report(diag::NctOperandCount, element.word, {element.word.text, wanted, std::to_string(given)});
      breakRung();
    }
    element.operand_count = static_cast<uint8_t>(std::min(given, most));
    for (size_t k = 0; k < element.operand_count; ++k) element.operands[k] = line_.words[k + 1];
  }

  // ( | ) [ ] TO AT. False: it is another word.
  bool readStructure(const Word& word) {
    const std::string_view text = word.text;
    const bool structural = text == "(" || text == ")" || text == "[" || text == "]" || text == "|" ||
                            sameIdentifier(text, "TO") || sameIdentifier(text, "AT");
    if (!structural) return false;
    if (!in_rung_) {
      report(diag::NctMisplaced, word, {quoted(text), "write RUNG before the first element of a rung"});
      in_rung_ = true;
    }
    if (text == "(" || text == "[") {
      if (open_.size() >= kMostNesting) {
        report(diag::NctMisplaced, word, {quoted(text), "branches are nested too deeply"});
        return true;
      }
      open_.push_back({last() + 1, last() + 1});
      const Word pin = text == "[" ? takePin() : Word{};
      add(text == "(" ? Shape::GroupBegin : Shape::PinsBegin, word).pin = pin;
      return true;
    }
    if (text == ")" || text == "]" || text == "|") {
      const bool in_pins = !open_.empty() && module_->elements[open_.back().begin].shape == Shape::PinsBegin;
      if (open_.empty() || (text == ")" && in_pins) || (text == "]" && !in_pins)) {
        report(diag::NctMisplaced, word,
               {quoted(text), open_.empty() ? "no branch is open here"
                              : in_pins     ? "the pins before it end with `]`"
                                            : "the branches before it end with `)`"});
        return true;
      }
      if (text != "|") {
        closeBranches(text == ")" ? Shape::GroupEnd : Shape::PinsEnd);
        return true;
      }
      const Word pin = in_pins ? takePin() : Word{};
      add(Shape::BranchBegin, word).pin = pin;
      module_->elements[open_.back().branch].next = last();
      open_.back().branch = last();
      return true;
    }
    const bool to = sameIdentifier(text, "TO");
    Element& element = add(to ? Shape::To : Shape::At, word);
    if (line_.words.size() == 2 && isIdentifier(line_.words[1].text)) {
      element.operands[0] = line_.words[1];
      element.operand_count = 1;
    } else {
      report(diag::NctMisplaced, word, {"this line", to ? "write `TO name`" : "write `AT name`"});
    }
    return true;
  }

  Word takePin() {
    for (const std::string_view pin : kPins)
      if (is(1, pin) && line_.words.size() == 2) return {pin, line_.words[1].loc};
    report(diag::NctMisplaced, line_.words.size() > 1 ? line_.words[1] : first(),
           {"this line", "the name of a pin follows: CK, U/D, R, L/R, D, EN, BID, DIR, INC or PRE"});
    return {};
  }

  Diagnostics& diagnostics_;
  std::string_view source_;
  uint32_t base_;
  size_t at_ = 0;
  Line line_;
  Program program_;
  Module lost_;  // one of a name that another has
  Module* module_ = nullptr;
  bool in_rung_ = false, says_no_program_ = false;
  bool begins_part_ = false;  // the line that ended a part without its END_ word
  std::vector<Open> open_;
};

}  // namespace

const Instruction* findInstruction(std::string_view word) {
  static const auto* const by_word = [] {
    auto* const map = new std::unordered_map<std::string_view, const Instruction*>;
    for (const Instruction& row : kInstructions) map->emplace(row.word, &row);
    map->emplace("MOVCMD", map->at("MOVCMND"));  // the manual has both
    return map;
  }();
  const auto found = by_word->find(word);
  if (found != by_word->end()) return found->second;
  const auto any_case = by_word->find(upper(word));
  return any_case == by_word->end() ? nullptr : any_case->second;
}

std::span<const Instruction> allInstructions() { return kInstructions; }

Program read(const Sources& sources, FileId file, Diagnostics& diagnostics) {
  return ProgramReader(sources, file, diagnostics).run();
}

}  // namespace rung::importer::nct
