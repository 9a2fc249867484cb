// SPDX-License-Identifier: Apache-2.0
// Formatting and parsing of variables: see value_format.h.
#include "value_format.h"

#include <cstring>
#include <vector>

#include "rung/values.h"

namespace rung::host {
namespace {

const char* const kKindNames[] = {
    "BOOL",  "BYTE",  "WORD",  "DWORD", "LWORD",  "SINT",    "INT",     "DINT",        "LINT",  "USINT",     "UINT",
    "UDINT", "ULINT", "REAL",  "LREAL", "TIME",   "LTIME",   "DATE",    "LDATE",       "TOD",   "LTOD",      "DT",
    "LDT",   "CHAR",  "WCHAR", "UCHAR", "STRING", "WSTRING", "USTRING", "enumeration", "array", "structure", "pointer"};

uint8_t integerKind(const LoadedModule& module, const rung_type& type) {
  if (type.kind == RUNG_ENUM && type.element != RUNG_NONE) return module.types[type.element].kind;
  return type.kind;
}

int64_t loadInteger(uint8_t kind, uint32_t size, const uint8_t* from) {
  uint64_t bits = 0;
  memcpy(&bits, from, size <= 8 ? size : 8);
  const bool is_signed = kind >= RUNG_SINT && kind <= RUNG_LINT;
  const uint32_t shift = 64 - 8 * (size <= 8 ? size : 8);
  return is_signed ? static_cast<int64_t>(bits << shift) >> shift : static_cast<int64_t>(bits);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string assignEnum(const LoadedModule& module, const rung_type& type, std::string_view text, uint8_t* to) {
  std::string_view item = text;
  const size_t separator = item.find_first_of("#.");
  if (separator != std::string_view::npos && (item.empty() || item[0] < '0' || item[0] > '9') &&
      lowerCase(item.substr(0, separator)) == lowerCase(module.strings + type.name))
    item.remove_prefix(separator + 1);
  const std::string wanted = lowerCase(item);
  std::vector<std::string_view> names;
  for (uint32_t i = 0; i < type.count; ++i) {
    const rung_enum_item& entry = module.enum_items[type.first + i];
    names.push_back(module.strings + entry.name);
    if (lowerCase(names.back()) != wanted) continue;
    memcpy(to, &entry.value, type.size);
    return "";
  }
  uint64_t scratch;
  if (rung_parse(integerKind(module, type), false, 0, text.data(), text.size(), &scratch)) {
    memcpy(to, &scratch, type.size);
    return "";
  }
  return "`" + std::string(text) + "` is not an item of " + typeName(module, type) + didYouMean(item, names);
}

}  // namespace

std::string typeName(const LoadedModule& module, const rung_type& type) {
  if (type.name != 0 && module.strings[type.name] != 0) return module.strings + type.name;
  return type.kind <= RUNG_POINTER ? kKindNames[type.kind] : "unknown type";
}

bool integerOf(const LoadedModule& module, const Variable& variable, Integer& value) {
  const uint8_t* const at = variable.address();
  const rung_type& type = *variable.type;
  if (at == nullptr || type.kind == RUNG_REAL || type.kind == RUNG_LREAL ||
      (type.kind >= RUNG_STRING && type.kind <= RUNG_USTRING) || type.kind >= RUNG_ARRAY)
    return false;
  if (type.kind == RUNG_BOOL) {
    value = {(variable.bit == 255 ? *at != 0 : (*at >> variable.bit & 1) != 0) ? 1 : 0, false};
    return true;
  }
  const bool is_signed_time = type.is_signed != 0 && (type.kind == RUNG_TIME || type.kind == RUNG_LTIME);
  const uint8_t kind = is_signed_time ? static_cast<uint8_t>(RUNG_LINT) : integerKind(module, type);
  value = {loadInteger(kind, type.size, at), kind < RUNG_SINT || kind > RUNG_LINT};
  return true;
}

bool numberOf(const LoadedModule& module, const Variable& variable, double& value) {
  const uint8_t* const at = variable.address();
  if (at == nullptr) return false;
  const rung_type& type = *variable.type;
  Integer integer;
  if (type.kind == RUNG_REAL) {
    float number;
    memcpy(&number, at, sizeof number);
    value = static_cast<double>(number);
  } else if (type.kind == RUNG_LREAL) {
    memcpy(&value, at, sizeof value);
  } else if ((type.kind <= RUNG_LTIME || type.kind == RUNG_ENUM) && integerOf(module, variable, integer)) {
    value = integer.isBeyondSigned() ? static_cast<double>(static_cast<uint64_t>(integer.bits))
                                     : static_cast<double>(integer.bits);
  } else {
    return false;
  }
  return true;
}

namespace {

// The scalar at `at`, as the runtime prints it.
void appendScalar(std::string& to, uint8_t kind, bool is_signed, const uint8_t* at) {
  char room[RUNG_FORMATTED_SCALAR + 1];
  to.append(room, rung_format(kind, is_signed, at, room, RUNG_FORMATTED_SCALAR));
}

// The name of the item, or the number where there is none.
void appendEnum(std::string& to, const LoadedModule& module, const rung_type& type, const uint8_t* at) {
  const uint8_t kind = integerKind(module, type);
  const int64_t value = loadInteger(kind, type.size, at);
  for (uint32_t i = 0; i < type.count; ++i) {
    const rung_enum_item& item = module.enum_items[type.first + i];
    if (item.value == value) {
      to += module.strings + item.name;
      return;
    }
  }
  appendScalar(to, kind, false, at);
}

void appendString(std::string& to, const rung_type& type, const uint8_t* at) {
  const size_t begin = to.size();
  std::vector<uint8_t> ended(at, at + type.size);  // other variables may overlap its final zero
  const size_t unit = type.kind == RUNG_WSTRING ? 2 : 1;
  memset(ended.data() + type.length * unit, 0, unit);
  to.resize(begin + 5 * size_t{type.length} + 2);
  to.resize(begin +
            rung_format(type.kind, false, ended.data(), to.data() + begin, static_cast<uint32_t>(to.size() - begin)));
}

void appendPointer(std::string& to, const uint8_t* at) {
  const void* target;
  memcpy(&target, at, sizeof target);
  char room[24] = "NULL";
  if (target != nullptr)
    snprintf(room, sizeof room, "16#%llX", static_cast<unsigned long long>(reinterpret_cast<uintptr_t>(target)));
  to += room;
}

}  // namespace

void formatValue(const LoadedModule& module, const Variable& variable, std::string& to) {
  const uint8_t* const at = variable.address();
  if (at == nullptr) return;
  const rung_type& type = *variable.type;
  switch (static_cast<rung_type_kind>(type.kind)) {
    case RUNG_BOOL: to += (variable.bit == 255 ? *at != 0 : (*at >> variable.bit & 1) != 0) ? "TRUE" : "FALSE"; return;
    case RUNG_ENUM: return appendEnum(to, module, type, at);
    case RUNG_STRING:
    case RUNG_WSTRING:
    case RUNG_USTRING: return appendString(to, type, at);
    case RUNG_POINTER: return appendPointer(to, at);
    case RUNG_ARRAY:
    case RUNG_RECORD: return;  // their elements are printed
    case RUNG_BYTE:
    case RUNG_WORD:
    case RUNG_DWORD:
    case RUNG_LWORD:
    case RUNG_SINT:
    case RUNG_INT:
    case RUNG_DINT:
    case RUNG_LINT:
    case RUNG_USINT:
    case RUNG_UINT:
    case RUNG_UDINT:
    case RUNG_ULINT:
    case RUNG_REAL:
    case RUNG_LREAL:
    case RUNG_TIME:
    case RUNG_LTIME:
    case RUNG_DATE:
    case RUNG_LDATE:
    case RUNG_TOD:
    case RUNG_LTOD:
    case RUNG_DT:
    case RUNG_LDT:
    case RUNG_CHAR:
    case RUNG_WCHAR:
    case RUNG_UCHAR: break;
  }
  appendScalar(to, type.kind, type.is_signed != 0, at);
}

std::string assignValue(const LoadedModule& module, const Variable& variable, std::string_view text, bool dry) {
  text = trimmed(text);
  const rung_type& type = *variable.type;
  if ((variable.flags & RUNG_FIELD_CONSTANT) != 0) return "`" + variable.path + "` is a constant";
  if ((variable.flags & RUNG_FIELD_READ_ONLY) != 0) return "`" + variable.path + "` is READ_ONLY";
  if (type.kind == RUNG_ARRAY || type.kind == RUNG_RECORD)
    return "`" + variable.path + "` is " + (type.kind == RUNG_ARRAY ? "an array" : "a structure") +
           "; set its elements one by one";
  if (type.kind == RUNG_POINTER) return "`" + variable.path + "` is a pointer and cannot be set from outside";

  uint8_t* const at = variable.address();
  if (at == nullptr && !dry) return "`" + variable.path + "` goes through a null pointer";
  std::vector<uint8_t> scratch(dry || variable.bit != 255 ? size_t{type.size} + 8 : 0);
  uint8_t* const to = scratch.empty() ? at : scratch.data();
  if (type.kind == RUNG_ENUM) return assignEnum(module, type, text, to);
  if (!rung_parse(type.kind, type.is_signed != 0, type.length, text.data(), text.size(), to)) {
    std::string hint;
    if (type.kind == RUNG_STRING || type.kind == RUNG_USTRING) hint = "; write '...'";
    if (type.kind == RUNG_WSTRING) hint = "; write \"...\"";
    if (type.kind == RUNG_TIME) hint = "; write T#1s500ms";
    return "`" + std::string(text) + "` is not a value of type " + typeName(module, type) + hint;
  }
  if (variable.bit != 255 && !dry) {
    const uint8_t mask = static_cast<uint8_t>(1u << variable.bit);
    *at = static_cast<uint8_t>(to[0] != 0 ? *at | mask : *at & ~mask);
  }
  return "";
}

}  // namespace rung::host
