// SPDX-License-Identifier: Apache-2.0
// A body of networks as the parser creates it: the elements of LD, FBD and CFC with their wires, in the order of the
// file. The scheduler (frontend/schedule/network_schedule.h) turns it into statements. One
// model serves the three languages, which differ only in how an editor shows them. IEC 61131-3 ed. 3, 8; TM/TP
// manual 5.1 to 5.3 and 5.6. `rung graph` draws from here too, so an element keeps its position where the file has one.
#pragma once

#include <cstdint>
#include <string_view>

#include "frontend/syntax/ids.h"
#include "frontend/syntax/pin.h"

namespace rung {

enum class ElementKind : uint8_t {
  Rail,          // the left power rail: TRUE
  RightRail,     // end of wires
  Contact,       // `operand`
  Coil,          // `operand`
  Box,           // `path` names the function or type that is called, `operand` its instance
  Input,         // `operand` is read
  Output,        // `operand` is written
  InOut,         // `operand` is read, and written where a wire comes in
  Connector,     // one wire in; its continuations and the elements that refer to it read that wire
  Continuation,  // of the connector `name`
  Jump,          // to the label `name`
  Label,         // `name`
  Return,
  Execute,  // a box of statements, `body`
  Compose,  // CFC: a structure of type `path` from its members, the inputs
  Select,   // CFC: the members, the outputs, of a structure of type `path`
  Comment,  // `text`
};
// Their words in the notation of networks, in the order of ElementKind.
constexpr std::string_view kElementWords[] = {"rail",   "right_rail", "contact",   "coil",         "box",    "input",
                                              "output", "inout",      "connector", "continuation", "jump",   "label",
                                              "return", "execute",    "compose",   "select",       "comment"};
enum class NetworkLanguage : uint8_t { Ladder, Blocks, Continuous };  // LD, FBD, CFC
enum class PinStorage : uint8_t { None, Set, Reset };

constexpr uint32_t kNoElement = UINT32_MAX;

struct DiagramWire {
  uint32_t from;  // index in the elements of the body; kNoElement: source not found, which was reported
  Ident pin;      // of the element; none: its only one
  Loc loc;
};
struct DiagramPin {
  Ident name;  // none: of an element with one input
  PinDirection direction;
  bool negated;
  EdgeKind edge;
  PinStorage storage;
  Slice<DiagramWire> wires;  // several wires are joined by OR
};
struct DiagramElement {
  ElementKind kind;
  bool negated;
  EdgeKind edge;
  PinStorage storage;
  uint32_t network;  // the number of its network; 0: inferred from wires
  uint32_t order;    // its place in the execution order; 0: inferred from wires and positions
  Ident name;
  ExprId path;
  ExprId operand;
  Slice<DiagramPin> pins;  // inputs, in-outs and outputs in the order of the file
  Slice<StmtId> body;
  uint32_t comment, comment_length;  // StringId
  uint64_t number;                   // localId
  Loc loc, end;                      // the number; one past the source of the element
  int32_t x, y, width, height;
  bool placed;   // x and y are given
  bool holding;  // coil of a retentive variable: M, SM, RM of the TM/TP manual
};
struct DiagramNetwork {
  uint32_t number;
  uint32_t title, title_length;  // StringId
  Loc loc;
  bool disabled;  // none of its elements run
};

}  // namespace rung
