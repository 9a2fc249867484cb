// SPDX-License-Identifier: Apache-2.0
// Bodies in LD, FBD, CFC and SFC as pictures that an engineer recognises. In: the tree as parsed, before a scheduler
// takes the networks or the chart: so the picture shows exactly what is written, even of a program whose library is
// missing; what others know about it is in notes. With paths of values the picture also carries what a monitor needs to
// show it running, in attributes that docs/monitor.md lists. Out: SVG, equal bytes for equal bodies. Elements are drawn
// at the file's positions, or laid out where it has none. First comes a plan (positions, pins, lines), then its SVG, so
// tests can check the plan for overlaps. One router serves both kinds of positions. Corner points of wires in the file
// are not used: they fit only boxes of the editor's size. Called by `rung graph` and for the monitor
// (tools/driver/pou_views.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/function_ref.h"
#include "frontend/syntax/tree.h"

namespace rung::picture {

// Where the value of an expression is in the running program: `.pump.on` in an instance of the POU, `level` or `%IX0.3`
// anywhere; empty: nowhere.
using PathOf = FunctionRef<std::string(ExprId)>;

// A picture of networks shows this besides what is written.
struct NetworkNotes {
  // The elements that run, by their index: an element without a number in the file gets one from its place here. Empty:
  // it gets none.
  std::vector<uint32_t> execution_order = {};
  const std::vector<bool>* in_outs = nullptr;  // by the index of a pin in the tree: an in-out of what its box calls
  const PathOf* path_of = nullptr;
};

// `name`: the title of the picture, `Pump.Start`. `page`: the width in pixels beyond which networks are continued in a
// band below; 0: unlimited.
std::string drawNetworks(const Tree& tree, const Names& names, const Diagram& diagram, std::string_view name,
                         int32_t page = 0, const NetworkNotes& notes = {});
std::string drawChart(const Tree& tree, const Names& names, const PouDecl& pou, std::string_view name,
                      const PathOf* path_of = nullptr);

// The ids of what a picture with paths has: those of an element of networks, a step, the actions at a step and a
// transition, by their indices.
std::string elementId(uint64_t number);
std::string stepId(uint32_t step);
std::string actionId(uint32_t step, uint32_t action);
std::string transitionId(uint32_t transition);

}  // namespace rung::picture
