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

void formatValue(const LoadedModule& module, const Variable& variable, std::string& to) {
  constexpr uint32_t kMostOften = 127;  // strings and enumerations may be longer
  char room[kMostOften + 1];
  const uint32_t length = rung_read_text(variable.context, &variable, room, kMostOften);
  if (length < kMostOften) {
    to.append(room, length);
    return;
  }
  const size_t begin = to.size();
  const uint32_t capacity = rung_text_capacity(&module.description, &variable);
  to.resize(begin + capacity + 1);
  to.resize(begin + rung_read_text(variable.context, &variable, to.data() + begin, capacity));
}

void formatCopied(const LoadedModule& module, const Variable& variable, const uint8_t* value, std::string& to) {
  void* blocks[] = {const_cast<uint8_t*>(value)};
  rung_context context{};
  context.blocks = blocks;
  context.module = &module.description;
  Variable copy;
  copy.type = variable.type;
  copy.context = &context;
  copy.storage = RUNG_IN_BLOCK;
  copy.bit = 255;
  formatValue(module, copy, to);
}

namespace {

std::string notAValue(const LoadedModule& module, const rung_type& type, std::string_view text) {
  std::string what = "`" + std::string(text) + "` is not ";
  if (type.kind != RUNG_ENUM) {
    what += "a value of type " + typeName(module, type);
    if (type.kind == RUNG_STRING || type.kind == RUNG_USTRING) what += "; write '...'";
    if (type.kind == RUNG_WSTRING) what += "; write \"...\"";
    if (type.kind == RUNG_TIME) what += "; write T#1s500ms";
    return what;
  }
  std::vector<std::string_view> names;
  for (uint32_t i = 0; i < type.count; ++i) names.push_back(module.strings + module.enum_items[type.first + i].name);
  const size_t separator = text.find_first_of("#.");
  const bool has_type = separator != std::string_view::npos &&
                        lowerCase(text.substr(0, separator)) == lowerCase(module.strings + type.name);
  return what + "an item of " + typeName(module, type) +
         didYouMean(has_type ? text.substr(separator + 1) : text, names);
}

}  // namespace

std::string whyRefused(const LoadedModule& module, const Variable& variable, rung_access why, std::string_view text) {
  const std::string name = "`" + variable.path + "`";
  switch (why) {
    case RUNG_ACCESS_OK: return "";
    case RUNG_ACCESS_CONSTANT: return name + " is a constant";
    case RUNG_ACCESS_READ_ONLY: return name + " is READ_ONLY";
    case RUNG_ACCESS_ARRAY: return name + " is an array; set its elements one by one";
    case RUNG_ACCESS_RECORD: return name + " is a structure; set its elements one by one";
    case RUNG_ACCESS_POINTER: return name + " is a pointer and cannot be set from outside";
    case RUNG_ACCESS_NULL: return name + " goes through a null pointer";
    case RUNG_ACCESS_VALUE: return notAValue(module, *variable.type, trimmed(text));
    case RUNG_ACCESS_SIZE: return name + " has another size than the value";
    case RUNG_ACCESS_FULL: return "too many variables are forced; unforce some";
  }
  return "";
}

std::string checkValue(const LoadedModule& module, const Variable& variable, std::string_view text) {
  const std::string_view literal = trimmed(text);
  std::vector<uint8_t> value(variable.type->kind < RUNG_ARRAY ? size_t{variable.type->size} + 8 : 0);
  const rung_access access =
      rung_parse_value(&module.description, &variable, literal.data(), literal.size(), value.data());
  return whyRefused(module, variable, access, literal);
}

std::string assignValue(const LoadedModule& module, const Variable& variable, std::string_view text) {
  const std::string_view literal = trimmed(text);
  const rung_access access = rung_write_text(variable.context, &variable, literal.data(), literal.size());
  return whyRefused(module, variable, access, literal);
}

}  // namespace rung::host
