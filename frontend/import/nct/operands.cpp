// SPDX-License-Identifier: Apache-2.0
// Operands of NCT instructions; see operands.h.
#include "frontend/import/nct/operands.h"

#include <algorithm>
#include <iterator>

#include "frontend/import/diagnostics.h"
#include "frontend/import/nct/messages.h"
#include "frontend/import/nct/services.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::nct {
namespace {

#define NC_SCOPE(name, last) {#name, last},
constexpr Scope kScopes[] = {
#include "frontend/import/nct/nc_scopes.def"
};
#undef NC_SCOPE

}  // namespace

std::span<const Scope> scopes() { return kScopes; }

bool Operands::take(const Element& element, std::vector<Operand>& operands) {
  const std::string_view kinds = element.instruction->operands;
  bool good = true;
  size_t at = 0;
  for (const char kind : kinds) {
    if (kind == '?') continue;
    if (at >= element.operand_count) {
      good = good && kinds.find('?') != std::string_view::npos;
      break;
    }
    operands.push_back(takeOperand(element, element.operands[at++], kind));
    good = good && operands.back().kind != OperandKind::Broken;
  }
  return good;
}

Operand Operands::takeOperand(const Element& element, const Word& word, char kind) {
  if (kind == 'l') return takeLabel(word);
  if (kind == 'n') return takeScope(word);
  const bool coil = element.shape == Shape::Coil && !sameIdentifier(element.word.text, "DIFU") &&
                    !sameIdentifier(element.word.text, "DIFD");
  const bool takes_query = kind == 'c' || (coil && word.text.front() == '!');
  Operand operand = memory_.operandOf(word, takes_query);
  if (operand.kind == OperandKind::Broken) return operand;
  const bool is_word = operand.kind == OperandKind::Address && !operand.address.is_bit;
  const bool is_bit = operand.kind == OperandKind::Address && operand.address.is_bit;
  const bool integer = operand.kind == OperandKind::Integer, pattern = operand.kind == OperandKind::Pattern;
  const bool number = operand.kind == OperandKind::Number;
  std::string_view wanted;
  switch (kind) {
    case 'b': wanted = is_bit ? "" : "a bit"; break;
    case 'c': wanted = is_bit || is_word ? "" : "a bit or a word"; break;
    case 'k': wanted = is_word || integer ? "" : "a word or a `#` constant"; break;
    case 's': wanted = is_word || integer || pattern ? "" : "a word, a `#` or a `#$` constant"; break;
    case 'h': wanted = is_word || pattern || isIdentifier(word.text) ? "" : "a word or a `#$` constant"; break;
    case 'f': wanted = is_word || number ? "" : "a double or a `*` constant"; break;
    case 'i': wanted = integer ? "" : "a `#` constant"; break;
    default: wanted = is_word ? "" : "a word"; break;  // w W t r R u
  }
  if (!wanted.empty()) {
    report(diag::NctOperandKind, word,
           {word.text, "here " + std::string(element.word.text) + " takes " + std::string(wanted)});
    operand.kind = OperandKind::Broken;
    return operand;
  }
  if (operand.kind == OperandKind::Address && !checkAddress(element, operand, kind)) operand.kind = OperandKind::Broken;
  return operand;
}

bool Operands::checkAddress(const Element& element, Operand& operand, char kind) {
  const Address& address = operand.address;
  const bool is_double = kind == 'W' || kind == 'R' || kind == 'f';
  if (is_double && address.is_static() && address.word > kWords - 2) {
    report(diag::NctAddress, operand.word,
           {operand.word.text, "a double needs two words, so its last address is 9998"});
    return false;
  }
  if (operand.query == Query::Immediate) {
    const char* const wrong = !in_int0_         ? "only Int0 reaches the TimeSlice memory"
                              : !address.is_bit ? "words have no immediate form"
                              : address.is_static() && (address.word < 2 || address.word >= memory_.limits().kept)
                                  ? "the TimeSlice memory reaches from 0002 to PLCNVRAM - 1"
                                  : nullptr;
    if (wrong != nullptr) {
      report(diag::NctOperandKind, operand.word, {operand.word.text, wrong});
      return false;
    }
  }
  const bool writes = kind == 'b' || kind == 'w' || kind == 'W' || kind == 't' || kind == 'u';
  if (!writes) return true;
  const int32_t last = address.word + (kind == 'W' ? 1 : 0);
  if (address.is_static() && (address.word < 2 || isInputWord(address.word) || isInputWord(last))) {
    report(diag::NctReadOnly, operand.word,
           {operand.word.text, address.word < 2 ? "the status flags" : "an input of the numerical control"});
    return false;
  }
  if (kind == 't' && address.is_static() && address.word < memory_.limits().kept)
    report(diag::NctRegisterPlace, operand.word, {operand.word.text});
  if (address.is_static() && (kind == 'b' || kind == 't')) noteDriver(element, operand, kind);
  return true;
}

Operand Operands::takeLabel(const Word& word) {
  Operand operand;
  operand.word = word;
  operand.value = -1;
  const bool digits = std::all_of(word.text.begin(), word.text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || word.text.size() > 2) {
    report(diag::NctConstant, word, {word.text, "a label is a number from 0 to 99, without `#`"});
    return operand;
  }
  operand.kind = OperandKind::Integer;
  operand.value = std::stoi(std::string(word.text));
  return operand;
}

Operand Operands::takeScope(const Word& word) {
  Operand operand;
  operand.word = word;
  std::vector<std::string_view> names;
  for (const Scope& scope : kScopes) {
    names.push_back(scope.name);
    if (!sameIdentifier(scope.name, word.text)) continue;
    operand.kind = OperandKind::Integer;
    operand.value = &scope - kScopes;
    return operand;
  }
  report(diag::NctUnknownSymbol, word, {word.text}).didYouMean(nearest(word.text, names));
  return operand;
}

// Each output, timer and counter has one driver. NCT manual 1.
//   fails   OUT 6000.00 twice                                                   E1414
//   fails   OUT !P_HOLD0 in Int0 and OUT P_HOLD0 in Main                        E1415
void Operands::noteDriver(const Element& element, const Operand& operand, char kind) {
  const bool repeats = sameIdentifier(element.word.text, "SET") || sameIdentifier(element.word.text, "RST");
  const uint32_t key = static_cast<uint32_t>(operand.address.word) * 64 +
                       (kind == 't' ? 63u : static_cast<uint32_t>(operand.address.bit));
  const Driver driver{operand.word.loc, operand.query == Query::Immediate, !repeats};
  std::vector<Driver>& others = drivers_[key];
  for (const Driver& other : others) {
    if (other.immediate != driver.immediate) {
      report(diag::NctBothWays, operand.word, {operand.word.text}).declaredHere(other.loc);
      return;
    }
    if (other.is_coil && driver.is_coil) {
      report(diag::NctDrivenTwice, operand.word, {operand.word.text}).declaredHere(other.loc);
      return;
    }
  }
  others.push_back(driver);
  if (driver.immediate) owned_.insert({operand.address.word, operand.address.bit});
}

void Operands::checkDrivers() {
  for (const auto& [key, drivers] : drivers_) {
    const auto coil = std::find_if(drivers.begin(), drivers.end(), [](const Driver& d) { return d.is_coil; });
    const auto set = std::find_if(drivers.begin(), drivers.end(), [](const Driver& d) { return !d.is_coil; });
    if (coil != drivers.end() && set != drivers.end())
      diagnostics_.report(diag::NctCoilAndSet, set->loc, {}).declaredHere(coil->loc);
  }
}

// NCT manual 6.13.
//   fails   MSG #5 #0 #0, without a text 5 in MESSAGES or a file                  E1421
//   fails   MSGF #5 …, whose text has {#0:F0}                                     E1422
//   fails   MSG #5 #100 #0, MSG #1000 #0 #0                                       E1433
bool Operands::checkMessage(const Element& element, std::span<const Operand> operands) {
  static constexpr struct {
    std::string_view what;
    int64_t least, most;
  } kNumbers[] = {{"number", 1, kMostMessage}, {"channel", 0, 99}, {"index", 0, 99}};
  for (size_t k = 0; k < std::size(kNumbers); ++k) {
    const auto& [what, least, most] = kNumbers[k];
    if (operands[k].kind != OperandKind::Integer || (operands[k].value >= least && operands[k].value <= most)) continue;
    report(diag::NctMessageNumber, element.operands[k],
           {element.operands[k].text, what, std::to_string(least), std::to_string(most)});
    return false;
  }
  if (operands[0].kind != OperandKind::Integer) return true;
  const auto number = operands[0].value;
  const auto text = std::find_if(program_.messages.begin(), program_.messages.end(),
                                 [&](const MessageLine& line) { return line.number == number; });
  if (text == program_.messages.end()) {
    if (!program_.lost_messages) report(diag::NctNoMessage, element.operands[0], {element.operands[0].text});
    return false;
  }
  const bool is_double = upper(element.word.text).ends_with("F");
  const bool has_integer = text->text.find("{#") != std::string_view::npos;
  const bool has_double = text->text.find("{*") != std::string_view::npos;
  if ((has_integer && is_double) || (has_double && !is_double)) {
    report(diag::NctMessageItem, element.word, {element.word.text, has_integer ? "an integer" : "a double"})
        .declaredHere(text->written.loc);
    return false;
  }
  return true;
}

// A request ends with an execution code in its block, which belongs to it alone. NCT manual 6.18.
//   warns   MR 6000 #9                                                            W1450
//   warns   MR 6000 #34                                                           W1451
//   warns   MR in Int0                                                            W1452
//   warns   MR 6000 #10 and MW 6000 #11                                           W1453
void Operands::checkService(const Element& element, std::span<const Operand> operands) {
  const std::string word = upper(element.word.text);
  const Operand &block = operands[0], &code = operands[1];
  if (in_int0_) report(diag::NctServiceInInt0, element.word, {word});
  if (code.kind == OperandKind::Integer) {
    const Service* const service = findService(code.value);
    if (service == nullptr)
      report(diag::NctUnknownService, code.word, {word + std::to_string(code.value)});
    else if (wordOf(service->direction) != word)
      report(diag::NctServiceDirection, code.word, {std::to_string(code.value), word, wordOf(service->direction)});
  }
  if (!block.address.is_static()) return;
  const auto [other, is_new] = blocks_.emplace(block.address.word, block.word);
  if (!is_new) report(diag::NctSharedBlock, block.word, {block.word.text}).declaredHere(other->second.loc);
}

}  // namespace rung::importer::nct
