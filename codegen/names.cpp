// SPDX-License-Identifier: Apache-2.0
// Mangling and literals: see names.h.
#include "codegen/names.h"

#include <charconv>

#include "codegen/emit.h"
#include "frontend/source/text.h"

namespace rung::codegen {

namespace {

constexpr char kHex[] = "0123456789abcdef";

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

struct PlainCharacters {
  bool is[256] = {};
  constexpr PlainCharacters() {
    for (const std::string_view range : {"az", "AZ", "09", "__"})
      for (char c = range[0]; c <= range[1]; ++c) is[static_cast<unsigned char>(c)] = true;
  }
};
constexpr PlainCharacters kPlain;

bool isPlain(std::string_view name) {
  if (name.empty() || !isLetter(name[0])) return false;
  for (const char c : name)
    if (!kPlain.is[static_cast<unsigned char>(c)]) return false;
  return true;
}

}  // namespace

void appendMangled(std::string& out, std::string_view name) {
  if (isPlain(name)) {
    out += name;
    out += '_';
    return;
  }
  out += 'u';
  for (size_t i = 0; i < name.size();) {
    const size_t begin = i;
    while (i < name.size() && (isLetter(name[i]) || isDigit(name[i]))) ++i;
    out.append(name, begin, i - begin);
    if (i == name.size()) break;
    const auto byte = static_cast<unsigned char>(name[i++]);
    if (byte == '_') {
      out += "__";
    } else {
      out += "_x";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    }
  }
  out += "0u";
}

std::string mangle(std::string_view name) {
  std::string out;
  appendMangled(out, name);
  return out;
}

std::string openNamespace(std::string_view name_space) {
  return "namespace " + std::string(name_space) + " RUNG_HIDDEN {\n";
}

std::string fileStem(std::string_view name) {
  constexpr size_t kLongest = 100;
  std::string stem = mangle(name);
  if (stem.size() <= kLongest) return stem;
  const uint64_t hash = nameHash(name);
  stem.resize(kLongest - 17);
  stem += '_';
  for (int shift = 60; shift >= 0; shift -= 4) stem += kHex[hash >> shift & 15];
  return stem;
}

void appendUnsigned(std::string& out, uint64_t value) {
  char buffer[24];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void appendSigned(std::string& out, int64_t value) {
  char buffer[24];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void appendQuoted(std::string& out, std::string_view text) {
  out += '"';
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\' || c == '?') {
      out += '\\';
      out += c;
    } else if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {  // three octal digits end by themselves
      out += '\\';
      out += static_cast<char>('0' + (byte >> 6));
      out += static_cast<char>('0' + (byte >> 3 & 7));
      out += static_cast<char>('0' + (byte & 7));
    }
  }
  out += '"';
}

void appendQuotedWide(std::string& out, std::string_view text) {
  out += "u\"";
  for (Utf16Units units(text.substr(0, text.find('\0'))); !units.done();) {
    const uint32_t unit = units.next();
    if (unit >= 0x20 && unit < 0x7f && unit != '"' && unit != '\\' && unit != '?') {
      out += static_cast<char>(unit);
      continue;
    }
    out += "\\x";
    for (int shift = 12; shift >= 0; shift -= 4) out += kHex[unit >> shift & 15];
    out += "\" u\"";  // a hex escape would swallow hex digits that follow
  }
  out += '"';
}

uint32_t wideLength(std::string_view text) {
  uint32_t length = 0;
  for (Utf16Units units(text.substr(0, text.find('\0'))); !units.done(); units.next()) ++length;
  return length;
}

uint64_t nameHash(std::string_view name) {
  uint64_t hash = kHashStart;
  for (const char letter : name) {
    const char c = foldedCharacter(letter);
    hash = hashBytes(hash, &c, 1);
  }
  return hash;
}

uint64_t hashBytes(uint64_t hash, const void* bytes, size_t size) {
  const auto* p = static_cast<const unsigned char*>(bytes);
  for (size_t i = 0; i < size; ++i) hash = (hash ^ p[i]) * 0x100000001b3u;
  return hash;
}

}  // namespace rung::codegen
