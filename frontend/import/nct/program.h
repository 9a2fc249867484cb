// SPDX-License-Identifier: Apache-2.0
// An NCT program as it is written: its symbols, messages and the elements of its modules, line by line. In: a `.nct`
// file (docs/nct.md). Out: a Program whose words point into the file. Used by the reader (read.cpp), the resolver of
// addresses (memory.h) and the writer of ST (write.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/files.h"

namespace rung::importer::nct {

enum class Shape : uint8_t {
  Contact,         // IN, INN
  CompareContact,  // CLT, FLGE …
  Coil,            // closes its row: OUT, SET …
  Compare,         // closes its row: CMP, FCMP
  Box,             // computes its first operand while it has power
  Timer,           // an instance
  Pinned,          // an instance whose inputs are pins: CNT, ROT …
  Order,           // does something else while it has power, and says whether it could
  Message,
  Service,  // asks the numerical control
  Jump,     // closes its row: JMP, SBS, RET
  Marker,   // alone in column 1: SEC, END, JME, SBN
  // The structure of rungs: lines of their own.
  Rung,         // RUNG
  GroupBegin,   // (
  PinsBegin,    // [
  BranchBegin,  // | in a group or between pins
  GroupEnd,     // )
  PinsEnd,      // ]
  To,           // TO name
  At,           // AT name
};

struct Instruction {
  std::string_view word;
  Shape shape;
  std::string_view operands;
  uint8_t flags;
  std::string_view flagged, plain;
};
// The rows of instructions.def; null: no such word. Any case.
const Instruction* findInstruction(std::string_view word);
std::span<const Instruction> allInstructions();

struct Word {  // of a line
  std::string_view text;
  Loc loc;
  bool empty() const { return text.empty(); }
};

// Underlines the word.
inline Report reportAt(Diagnostics& diagnostics, Diag diag, const Word& at,
                       std::initializer_list<std::string_view> arguments) {
  return diagnostics.report(diag, at.loc, arguments).length(static_cast<uint32_t>(at.text.size()));
}

inline constexpr size_t kMostOperands = 5;

// A line of a module.
struct Element {
  Shape shape;
  const Instruction* instruction = nullptr;
  Word word;
  std::array<Word, kMostOperands> operands{};
  uint8_t operand_count = 0;
  Word pin;  // of PinsBegin and BranchBegin: the name of the pin that begins
  std::string_view remark;
  bool is_broken = false;  // of Rung: one of its lines has been reported and is missing
  // GroupBegin, PinsBegin, BranchBegin: the next branch or end. PinsEnd: its beginning.
  uint32_t next = 0;
};

// The index after the element at `at` with all of its branches.
inline uint32_t afterElement(std::span<const Element> elements, uint32_t at) {
  while (elements[at].shape == Shape::GroupBegin || elements[at].shape == Shape::PinsBegin ||
         elements[at].shape == Shape::BranchBegin)
    at = elements[at].next;
  return at + 1;
}

struct SymbolLine {
  Word name, value, marker;
};
struct MessageLine {
  uint32_t number;
  Word written;  // its text in the ladder, without its quotes, or in a message file
  std::string text;
};
struct ButtonLine {
  uint32_t number;
  std::string title;
};

struct Module {
  bool given = false;
  Loc loc;
  std::vector<Element> elements;
};

struct Program {
  Word name;
  std::vector<SymbolLine> symbols;
  std::vector<MessageLine> messages;
  bool lost_messages = false;  // a line has been reported: missing texts may be in it
  std::vector<ButtonLine> buttons;
  Module main, int0;
  Loc end;  // of the file
};

// Reports what is not a line of the language, and what is not balanced.
Program read(const Sources& sources, FileId file, Diagnostics& diagnostics);

}  // namespace rung::importer::nct
