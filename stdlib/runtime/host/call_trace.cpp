// SPDX-License-Identifier: Apache-2.0
// The calls of a cycle: see call_trace.h.
#include "call_trace.h"

#include <cstring>

#include "symbols.h"

namespace rung::host {

void CallTrace::called(const char* pou, const void* instance) {
  const auto [at, is_new] = index_.try_emplace({instance, pou}, calls_.size());
  if (is_new) calls_.push_back({nameOf(pou, static_cast<const uint8_t*>(instance)), 0});
  ++calls_[at->second].count;
}

std::string CallTrace::line(int64_t cycle) {
  std::string out = "cycle " + std::to_string(cycle) + ':';
  const char* separator = " ";
  for (const Call& call : calls_) {
    out += separator + call.name;
    if (call.count > 1) out += " x" + std::to_string(call.count);
    separator = ", ";
  }
  calls_.clear();
  index_.clear();
  return out + '\n';
}

// An instance in a variable of a function has no path: only its type is printed.
std::string CallTrace::nameOf(const char* pou, const uint8_t* instance) const {
  if (instance == nullptr) return pou;
  for (uint32_t i = 0; i < module_.symbols.size(); ++i) {
    const rung_symbol& symbol = module_.symbols[i];
    if (symbol.storage != RUNG_IN_BLOCK) continue;
    const rung_type& type = module_.types[symbol.type];
    const uint8_t* const begin = memory_.block(symbol.index) + symbol.offset;
    if (instance < begin || instance >= begin + (type.size == 0 ? 1 : type.size)) continue;
    std::string name = module_.strings + symbol.name;
    const std::string inside = pathInside(&type, static_cast<uint32_t>(instance - begin), pou);
    if (inside.empty()) continue;
    if (inside == "." && lowerCase(name) == lowerCase(pou)) return name;  // the instance of a program
    return name + (inside == "." ? "" : inside) + " (" + pou + ')';
  }
  return pou;
}

// `.field[1]` from a variable to the instance at `offset` in it; `.` is the variable itself. Empty: not found.
std::string CallTrace::pathInside(const rung_type* type, uint32_t offset, const char* pou) const {
  std::string path;
  for (;;) {
    if (type->kind == RUNG_ARRAY) {
      const rung_type* const element = &module_.types[type->element];
      if (element->size == 0) return "";
      uint32_t number = offset / element->size;
      std::string indices;
      for (uint32_t d = type->count; d-- > 0;) {
        const rung_dimension& dimension = module_.dimensions[type->first + d];
        const auto length = static_cast<uint32_t>(dimension.high - dimension.low + 1);
        indices = std::to_string(dimension.low + number % length) + (indices.empty() ? "" : ",") + indices;
        number /= length;
      }
      path += '[' + indices + ']';
      offset %= element->size;
      type = element;
      continue;
    }
    if (type->kind != RUNG_RECORD) return "";
    if (offset == 0 && strcmp(module_.strings + type->name, pou) == 0) return path.empty() ? "." : path;
    const rung_field* inside = nullptr;
    for (uint32_t i = 0; i < type->count; ++i) {
      const rung_field& field = module_.fields[type->first + i];
      if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0 || offset < field.offset) continue;
      if (offset < field.offset + module_.types[field.type].size) inside = &field;
    }
    if (inside == nullptr) return "";
    if ((inside->flags & RUNG_FIELD_BASE) == 0) path += std::string(".") + (module_.strings + inside->name);
    offset -= inside->offset;
    type = &module_.types[inside->type];
  }
}

}  // namespace rung::host
