// SPDX-License-Identifier: Apache-2.0
// Paths of variables: see symbols.h.
#include "symbols.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "src/text.h"

namespace rung::host {
namespace {

rung_type elementary(rung_type_kind kind, uint32_t size) {
  return {static_cast<uint8_t>(kind), 0, 0, 0, size, RUNG_NONE, 0, 0, 0};
}
const rung_type kBoolType = elementary(RUNG_BOOL, 1);
const rung_type kByteType = elementary(RUNG_BYTE, 1);
const rung_type kWordType = elementary(RUNG_WORD, 2);
const rung_type kDWordType = elementary(RUNG_DWORD, 4);
const rung_type kLWordType = elementary(RUNG_LWORD, 8);
const rung_type kLRealType = elementary(RUNG_LREAL, 8);

bool isNameCharacter(char c) {
  return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         static_cast<unsigned char>(c) >= 0x80 || c == '%';
}
// `9056` and `9056.17`, words and bits of the NCT ladder's memory, as addresses: %ND9056, %NX36226.1. Empty: neither.
std::string addressOfNct(std::string_view path) {
  const auto digits = [&](size_t at, size_t count) {
    return std::all_of(path.begin() + static_cast<ptrdiff_t>(at), path.begin() + static_cast<ptrdiff_t>(at + count),
                       [](char c) { return c >= '0' && c <= '9'; });
  };
  if (path.size() == 4 && digits(0, 4)) return "%ND" + std::to_string(std::stoi(std::string(path)));
  if (path.size() != 7 || path[4] != '.' || !digits(0, 4) || !digits(5, 2)) return {};
  const int word = std::stoi(std::string(path.substr(0, 4))), bit = std::stoi(std::string(path.substr(5)));
  if (bit > 31) return {};
  return "%NX" + std::to_string(word * 4 + bit / 8) + "." + std::to_string(bit % 8);
}

// The index `written` of a dimension of the array `path`.
bool readIndex(const std::string& written, const rung_dimension& dimension, std::string_view path, int64_t& index,
               std::string& error) {
  const char* const end = written.data() + written.size();
  const std::from_chars_result read = std::from_chars(written.data(), end, index);
  if (read.ec != std::errc{} || read.ptr != end)
    return error = backquoted(written) + " is not an index; write a number", false;
  if (index >= dimension.low && index <= dimension.high) return true;
  error = "index " + written + " of " + backquoted(path) + " is outside " + std::to_string(dimension.low) + ".." +
          std::to_string(dimension.high);
  return false;
}

bool isInteger(const rung_type& type) { return type.kind >= RUNG_BYTE && type.kind <= RUNG_ULINT; }

}  // namespace

std::string backquoted(std::string_view text) { return "`" + std::string(text) + "`"; }

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = rung_lower(c);
  return lower;
}

std::string didYouMean(std::string_view written, const std::vector<std::string_view>& candidates) {
  const std::string from = lowerCase(written.substr(0, 64));
  size_t best = std::max<size_t>(from.size() < 4 ? 1 : 2, from.size() / 3) + 1;
  std::string_view nearest;
  std::vector<size_t> row;
  for (const std::string_view candidate : candidates) {
    if (candidate.substr(0, 2) == "__") continue;  // hidden
    const std::string to = lowerCase(candidate.substr(0, 64));
    if (to.size() > from.size() + best || from.size() > to.size() + best) continue;
    row.resize(to.size() + 1);
    for (size_t j = 0; j <= to.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= from.size(); ++i) {
      size_t diagonal = row[0];
      row[0] = i;
      for (size_t j = 1; j <= to.size(); ++j) {
        const size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
        diagonal = row[j];
        row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
      }
    }
    if (row[to.size()] < best) {
      best = row[to.size()];
      nearest = candidate;
    }
  }
  return nearest.empty() ? "" : "; did you mean " + backquoted(nearest) + "?";
}

std::vector<std::string> splitList(std::string_view list) {
  std::vector<std::string> parts;
  int depth = 0;
  size_t begin = 0;
  for (size_t i = 0; i <= list.size(); ++i) {
    if (i < list.size() && list[i] == '[') ++depth;
    if (i < list.size() && list[i] == ']') --depth;
    if (i < list.size() && (list[i] != ',' || depth > 0)) continue;
    std::string_view part = list.substr(begin, i - begin);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    if (!part.empty()) parts.emplace_back(part);
    begin = i + 1;
  }
  return parts;
}

Symbols::Symbols(const LoadedModule& module, const Memory& memory) : module_(module), memory_(memory) {
  for (uint32_t i = 0; i < module.symbols.size(); ++i) {
    const std::string name = lowerCase(text(module.symbols[i].name));
    if (name.empty()) continue;
    const auto [first, is_first] = roots_.emplace(name, i);
    if (!is_first) shared_names_.insert({first->second, i});
    // `Config.Resource.` may precede it, or `Resource.` alone.
    const std::string prefix = lowerCase(text(module.symbols[i].path));
    for (size_t begin = 0; begin < prefix.size();) {
      roots_.emplace(prefix.substr(begin) + name, i);
      const size_t dot = prefix.find('.', begin);
      if (dot == std::string::npos) break;
      begin = dot + 1;
    }
  }
}

void Symbols::addTerminal(std::string_view module, Terminal& wire) {
  Variable variable;
  variable.path = std::string(module) + '.' + wire.name;
  variable.type = wire.is_bool ? &kBoolType : &kLRealType;
  variable.base = wire.is_bool ? reinterpret_cast<uint8_t*>(&wire.state) : reinterpret_cast<uint8_t*>(&wire.value);
  terminals_.emplace(lowerCase(variable.path), variable);
}

Variable Symbols::root(uint32_t index) const {
  const rung_symbol& symbol = module_.symbols[index];
  Variable variable;
  variable.path = text(symbol.name);
  if (shared_names_.count(index) != 0) variable.path.insert(0, text(symbol.path));
  variable.type = &module_.types[symbol.type];
  variable.base = symbol.storage == RUNG_IN_BLOCK ? memory_.block(symbol.index) : memory_.area(symbol.index);
  variable.offset = symbol.offset;
  variable.bit = symbol.bit;
  variable.flags = symbol.flags;
  if ((symbol.flags & RUNG_FIELD_BY_REFERENCE) != 0) variable.hops.push_back(0);
  return variable;
}

// `%IX0.3`, `%QB4`, `%MW6`: the image itself, declared or not.
bool Symbols::findAddress(std::string_view path, Variable& variable, std::string& error) const {
  const std::string lower = lowerCase(path);
  size_t at = 0;
  uint32_t index = 0;
  for (; index < module_.areas.size(); ++index) {
    const std::string prefix = lowerCase(text(module_.areas[index].prefix));
    if (prefix.empty() || lower.compare(0, prefix.size(), prefix) != 0) continue;
    at = prefix.size();
    break;
  }
  if (at == 0) {
    error = backquoted(path) + " is not an address; write `%IX0.0`, `%QB1` or `%MW2`";
    return false;
  }
  const rung_type* type = &kBoolType;
  if (at < lower.size() && lower[at] >= 'a') {
    switch (lower[at++]) {
      case 'x': break;
      case 'b': type = &kByteType; break;
      case 'w': type = &kWordType; break;
      case 'd': type = &kDWordType; break;
      case 'l': type = &kLWordType; break;
      default: error = backquoted(path) + " has an unknown size; write X, B, W, D or L"; return false;
    }
  }
  uint64_t byte = 0, bit = 0;
  const char* const end = lower.data() + lower.size();
  std::from_chars_result read = std::from_chars(lower.data() + at, end, byte);
  bool ok = read.ec == std::errc{};
  if (ok && type == &kBoolType && read.ptr != end && *read.ptr == '.') {
    read = std::from_chars(read.ptr + 1, end, bit);
    ok = read.ec == std::errc{} && bit < 8;
  } else if (type == &kBoolType) {
    bit = byte % 8;  // %IX5 is byte 0, bit 5
    byte /= 8;
  }
  if (type != &kBoolType) byte = byte < UINT32_MAX ? byte * type->size : byte;  // %QW2 is the bytes 4 and 5
  if (!ok || read.ptr != end) {
    error = backquoted(path) + " is not an address; write `%IX0.0`, `%QB1` or `%MW2`";
    return false;
  }
  const rung_area& area = module_.areas[index];
  if (byte + type->size > area.size) {
    error =
        backquoted(path) + " is outside the image, of which the program uses " + std::to_string(area.size) + " bytes";
    return false;
  }
  variable = Variable{};
  variable.path = std::string(path);
  variable.type = type;
  variable.base = memory_.area(index);
  variable.offset = static_cast<uint32_t>(byte);
  if (type == &kBoolType) variable.bit = static_cast<uint8_t>(bit);
  return true;
}

// A field of a record, its own or inherited. False: `names` lists the existing ones.
bool Symbols::enter(Variable& variable, std::string_view name, std::vector<std::string_view>& names) const {
  const rung_type& type = *variable.type;
  const rung_field* base = nullptr;
  for (uint32_t i = 0; i < type.count; ++i) {
    const rung_field& field = module_.fields[type.first + i];
    if ((field.flags & RUNG_FIELD_BASE) != 0) {
      base = &field;
      continue;
    }
    names.push_back(text(field.name));
    if (!rung_equal_names(name.data(), name.size(), text(field.name))) continue;
    variable.path += '.';
    variable.path += text(field.name);
    variable.type = &module_.types[field.type];
    variable.lastOffset() += field.offset;
    variable.setFlags(field.flags);
    if ((field.flags & RUNG_FIELD_BY_REFERENCE) != 0) variable.hops.push_back(0);
    return true;
  }
  if (base == nullptr) return false;
  variable.type = &module_.types[base->type];
  variable.lastOffset() += base->offset;
  return enter(variable, name, names);
}

// One `.field`, `[i,j]`, `^` or `.bit` at the front of `rest`.
bool Symbols::step(Variable& variable, std::string_view& rest, std::string& error) const {
  if (rest.front() == '^') return stepToTarget(variable, rest, error);
  if (rest.front() == '[') return stepToElement(variable, rest, error);
  if (rest.front() != '.')
    return error = "expected `.field`, `[index]` or nothing after " + backquoted(variable.path), false;
  rest.remove_prefix(1);
  size_t length = 0;
  while (length < rest.size() && isNameCharacter(rest[length])) ++length;
  const std::string_view name = rest.substr(0, length);
  rest.remove_prefix(length);
  const bool has_bits = isInteger(*variable.type) && variable.bit == 255;
  return has_bits ? stepToBit(variable, name, error) : stepToField(variable, name, error);
}

bool Symbols::stepToTarget(Variable& variable, std::string_view& rest, std::string& error) const {
  if (variable.type->kind != RUNG_POINTER) return error = backquoted(variable.path) + " is not a pointer", false;
  rest.remove_prefix(1);
  variable.type = &module_.types[variable.type->element];
  variable.hops.push_back(0);
  variable.path += '^';
  return true;
}

bool Symbols::stepToElement(Variable& variable, std::string_view& rest, std::string& error) const {
  const rung_type& type = *variable.type;
  if (type.kind != RUNG_ARRAY) return error = backquoted(variable.path) + " is not an array", false;
  const size_t close = rest.find(']');
  if (close == std::string_view::npos) return error = "expected `]` after " + backquoted(variable.path) + "[", false;
  const std::vector<std::string> indices = splitList(rest.substr(1, close - 1));
  if (indices.size() != type.count)
    return error = backquoted(variable.path) + " has " + std::to_string(type.count) + " dimension(s), not " +
                   std::to_string(indices.size()),
           false;
  uint64_t element = 0;
  std::string path = variable.path + '[';
  for (uint32_t d = 0; d < type.count; ++d) {
    const rung_dimension& dimension = module_.dimensions[type.first + d];
    int64_t index = 0;
    if (!readIndex(indices[d], dimension, variable.path, index, error)) return false;
    element = element * static_cast<uint64_t>(dimension.high - dimension.low + 1) +
              static_cast<uint64_t>(index - dimension.low);
    path += (d > 0 ? "," : "") + std::to_string(index);
  }
  variable.path = path + ']';
  variable.type = &module_.types[type.element];
  variable.lastOffset() += static_cast<uint32_t>(element * variable.type->size);
  rest.remove_prefix(close + 1);
  return true;
}

// `name`: `3` or `%X3`.
bool Symbols::stepToBit(Variable& variable, std::string_view name, std::string& error) const {
  std::string_view digits = name;
  if (digits.size() > 2 && digits[0] == '%' && (digits[1] == 'x' || digits[1] == 'X')) digits.remove_prefix(2);
  uint32_t bit = 0;
  const std::from_chars_result read = std::from_chars(digits.data(), digits.data() + digits.size(), bit);
  const bool is_number = read.ec == std::errc{} && read.ptr == digits.data() + digits.size();
  if (!is_number || bit >= variable.type->size * 8)
    return error = backquoted(variable.path) + " has no bit " + backquoted(name), false;
  variable.type = &kBoolType;
  variable.lastOffset() += bit / 8;  // little-endian
  variable.bit = static_cast<uint8_t>(bit % 8);
  variable.path += '.' + std::string(name);
  return true;
}

bool Symbols::stepToField(Variable& variable, std::string_view name, std::string& error) const {
  if (variable.type->kind != RUNG_RECORD) return error = backquoted(variable.path) + " has no fields", false;
  std::vector<std::string_view> names;
  if (enter(variable, name, names)) return true;
  error = backquoted(variable.path) + " has no variable " + backquoted(name) + didYouMean(name, names);
  return false;
}

// `Main.x` for an `x` of the program Main; empty when no program has such a variable.
std::string Symbols::inPrograms(std::string_view path) const {
  for (uint32_t i = 0; i < module_.symbols.size(); ++i) {
    if (!module_.symbols[i].is_program) continue;
    const std::string inside = std::string(text(module_.symbols[i].name)) + '.' + std::string(path);
    Variable variable;
    std::string ignored;
    if (find(inside, variable, ignored)) return inside;
  }
  return {};
}

bool Symbols::find(std::string_view path, Variable& variable, std::string& error) const {
  while (!path.empty() && path.front() == ' ') path.remove_prefix(1);
  while (!path.empty() && path.back() == ' ') path.remove_suffix(1);
  if (path.empty()) return error = "expected the path of a variable", false;

  const std::string lower = lowerCase(path);
  if (const auto terminal = terminals_.find(lower); terminal != terminals_.end())
    return variable = terminal->second, true;
  // The longest root that ends at the end of a name.
  size_t root_length = 0;
  for (size_t i = 1; i <= lower.size(); ++i) {
    if (i < lower.size() && isNameCharacter(lower[i])) continue;
    if (roots_.count(lower.substr(0, i)) != 0) root_length = i;
    if (i < lower.size() && lower[i] != '.') break;
  }
  if (root_length == 0) {
    if (path.front() == '%') return findAddress(path, variable, error);
    if (const std::string address = addressOfNct(path); !address.empty()) return findAddress(address, variable, error);
    if (const std::string inside = inPrograms(path); !inside.empty())
      return error = "unknown variable " + backquoted(path) + "; did you mean " + backquoted(inside) + "?", false;
    std::vector<std::string_view> names;
    for (uint32_t i = 0; i < module_.symbols.size(); ++i) names.push_back(text(module_.symbols[i].name));
    const std::string_view first = path.substr(0, path.find_first_of(".[^"));
    error = "unknown variable " + backquoted(path) + didYouMean(first, names);
    return false;
  }
  variable = root(roots_.at(lower.substr(0, root_length)));
  std::string_view rest = path.substr(root_length);
  while (!rest.empty())
    if (!step(variable, rest, error)) return false;
  return true;
}

// An axis has hundreds of variables, of which these are of interest; the others have to be named.
namespace {

bool isAxis(const char* type) { return strcmp(type, "AXIS_REF_SM3") == 0; }
bool isAxisValue(const char* name) {
  for (const char* const value :
       {"nAxisState", "fSetPosition", "fSetVelocity", "fSetAcceleration", "fSetJerk", "fActPosition"})
    if (strcmp(name, value) == 0) return true;
  return false;
}

uint64_t addCounts(uint64_t a, uint64_t b) { return a > UINT64_MAX - b ? UINT64_MAX : a + b; }

}  // namespace

// Tells whether what lists the variables of `type` lists this one.
bool Symbols::isListed(const rung_type& type, const rung_field& field, Detail detail) const {
  const char* const name = text(field.name);
  if ((field.flags & (RUNG_FIELD_BY_REFERENCE | RUNG_FIELD_CONSTANT)) != 0 || *name == 0 || strncmp(name, "__", 2) == 0)
    return false;
  if (detail != Detail::Everything && isAxis(text(type.name)) && !isAxisValue(name)) return false;
  constexpr uint32_t kSeen = RUNG_FIELD_INPUT | RUNG_FIELD_OUTPUT | RUNG_FIELD_BASE;
  return detail != Detail::Own || type.library == 0 || (field.flags & kSeen) != 0;
}

uint64_t Symbols::count(const rung_type& type, Detail detail) const {
  uint64_t parts = 0;
  if (type.kind == RUNG_RECORD) {
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = module_.fields[type.first + i];
      if (isListed(type, field, detail)) parts = addCounts(parts, count(module_.types[field.type], detail));
    }
    return parts;
  }
  if (type.kind != RUNG_ARRAY) return type.kind == RUNG_POINTER ? 0 : 1;
  const rung_type& element = module_.types[type.element];
  const uint64_t elements = element.size == 0 ? 0 : type.size / element.size;
  parts = elements == 0 ? 0 : count(element, detail);
  return parts != 0 && elements > UINT64_MAX / parts ? UINT64_MAX : elements * parts;
}

void Symbols::expand(const Variable& variable, std::vector<Variable>& to, Detail detail, size_t most) const {
  const rung_type& type = *variable.type;
  if (to.size() >= most) return;
  if (type.kind == RUNG_RECORD) {
    for (uint32_t i = 0; i < type.count; ++i) {
      const rung_field& field = module_.fields[type.first + i];
      if (!isListed(type, field, detail)) continue;
      Variable part = variable;
      if ((field.flags & RUNG_FIELD_BASE) == 0) {
        part.path += '.';
        part.path += text(field.name);
      }
      part.type = &module_.types[field.type];
      part.lastOffset() += field.offset;
      part.setFlags(field.flags);
      expand(part, to, detail, most);
    }
  } else if (type.kind == RUNG_ARRAY) {
    const rung_type& element = module_.types[type.element];
    std::vector<int64_t> index;
    for (uint32_t d = 0; d < type.count; ++d) {
      const rung_dimension& dimension = module_.dimensions[type.first + d];
      if (dimension.high < dimension.low) return;
      index.push_back(dimension.low);
    }
    for (uint32_t n = 0; to.size() < most; ++n) {
      Variable part = variable;
      part.path += '[';
      for (size_t d = 0; d < index.size(); ++d) part.path += (d > 0 ? "," : "") + std::to_string(index[d]);
      part.path += ']';
      part.type = &element;
      part.lastOffset() += n * element.size;
      expand(part, to, detail, most);
      size_t d = index.size();
      while (d > 0 && ++index[d - 1] > module_.dimensions[type.first + d - 1].high) {
        index[d - 1] = module_.dimensions[type.first + d - 1].low;
        --d;
      }
      if (d == 0) return;
    }
  } else if (type.kind != RUNG_POINTER) {
    to.push_back(variable);
  }
}

std::vector<Variable> Symbols::programRoots() const {
  std::vector<Variable> all;
  for (uint32_t i = 0; i < module_.symbols.size(); ++i) {
    if (!module_.symbols[i].is_program) continue;
    all.push_back(root(i));
    // Its located variables are separate roots: `Main.valve`.
    const std::string prefix = std::string(text(module_.symbols[i].name)) + '.';
    for (uint32_t j = 0; j < module_.symbols.size(); ++j)
      if (strncmp(text(module_.symbols[j].name), prefix.c_str(), prefix.size()) == 0 && !module_.symbols[j].is_program)
        all.push_back(root(j));
  }
  return all;
}

std::vector<Variable> Symbols::roots() const {
  std::vector<Variable> all;
  for (uint32_t i = 0; i < module_.symbols.size(); ++i) all.push_back(root(i));
  return all;
}

}  // namespace rung::host
