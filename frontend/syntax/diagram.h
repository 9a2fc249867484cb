// A body of networks as the parser leaves it: the elements of LD, FBD and CFC with their wires, in the order of the
// file, until the scheduler (frontend/diagram/schedule.h) makes statements of them. One model for the three languages:
// which of them an editor showed is a view. IEC 61131-3 ed. 3, 8; TM/TP manual 5.1 to 5.3 and 5.6.
// `rung graph` draws from here too, so an element keeps its place where the file has one.
#pragma once

#include <cstdint>

#include "frontend/syntax/ids.h"
#include "frontend/syntax/pin.h"

namespace rung {

enum class ElementKind : uint8_t {
  Rail,          // the left power rail: TRUE
  RightRail,     // ends wires
  Contact,       // `operand`
  Coil,          // `operand`
  Box,           // `path` names what is called, `operand` its instance
  Input,         // `operand` is read
  Output,        // `operand` is written
  InOut,         // `operand` is written where a wire comes in, and read
  Connector,     // one wire in; its continuations and whoever refers to it go on with that wire
  Continuation,  // of the connector `name`
  Jump,          // to the label `name`
  Label,         // `name`
  Return,
  Execute,  // a box of statements, `body`
  Compose,  // CFC: a structure of type `path` from its members, the inputs
  Select,   // CFC: the members, the outputs, of a structure of type `path`
  Comment,  // `text`
};
enum class NetworkLanguage : uint8_t { Ladder, Blocks, Continuous };  // LD, FBD, CFC
enum class PinStorage : uint8_t { None, Set, Reset };

constexpr uint32_t kNoElement = UINT32_MAX;

struct DiagramWire {
  uint32_t from;  // index in the elements of the body; kNoElement: of nothing, which was reported
  Ident pin;      // of the element; none: it has one
  Loc loc;
};
struct DiagramPin {
  Ident name;  // none: of an element with one input
  PinDirection direction;
  bool negated;
  EdgeKind edge;
  PinStorage storage;
  Slice<DiagramWire> wires;  // several are joined: OR
  NameId hidden;             // declareNetworks(): the instance that senses its edge
};
struct DiagramElement {
  ElementKind kind;
  bool negated;
  EdgeKind edge;
  PinStorage storage;
  uint32_t network;  // the number of its network; 0: wires tell
  uint32_t order;    // its turn in the body; 0: wires and places tell
  Ident name;
  NameId hidden;  // declareNetworks(): the instance that senses its edge; of a box or structure: what it works on
  NameId stored;  // declareNetworks(): of a function that is read before its turn: what keeps its value
  ExprId path;
  ExprId operand;
  Slice<DiagramPin> pins;  // inputs, in-outs and outputs as the file orders them
  Slice<StmtId> body;
  uint32_t comment, comment_length;  // StringId
  uint64_t number;                   // localId
  Loc loc, end;                      // the number; one past the element's text
  int32_t x, y, width, height;
  bool placed;   // x and y are given
  bool holding;  // a coil of a variable that is kept: M, SM, RM of the TM/TP manual
};
struct DiagramNetwork {
  uint32_t number;
  uint32_t title, title_length;  // StringId
  Loc loc;
  bool disabled;  // nothing in it runs
};

}  // namespace rung
