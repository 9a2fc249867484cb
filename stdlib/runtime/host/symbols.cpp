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
const rung_type kLRealType = elementary(RUNG_LREAL, 8);

constexpr size_t kLongestPath = 16384;

// The indices of `[1, 2]`, without blanks; none of `[]`.
std::vector<std::string_view> indicesOf(std::string_view step) {
  const size_t close = step.find(']');
  std::string_view list = step.substr(1, close - 1);
  std::vector<std::string_view> indices;
  if (list.find_first_not_of(' ') == std::string_view::npos) return indices;
  for (;;) {
    const size_t comma = list.find(',');
    std::string_view index = list.substr(0, comma);
    while (!index.empty() && index.front() == ' ') index.remove_prefix(1);
    while (!index.empty() && index.back() == ' ') index.remove_suffix(1);
    indices.push_back(index);
    if (comma == std::string_view::npos) return indices;
    list.remove_prefix(comma + 1);
  }
}

}  // namespace

std::string backquoted(std::string_view text) { return "`" + std::string(text) + "`"; }

std::string withoutIndices(const std::string& path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) text += c;
    if (c == '[') {
      inside = true;
      text += "..";
    }
  }
  return text;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = rung_lower(c);
  return lower;
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
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
  char quote = 0;  // of the string that is open
  size_t begin = 0;
  for (size_t i = 0; i <= list.size(); ++i) {
    const char c = i < list.size() ? list[i] : ',';
    if (i < list.size() && quote != 0) {
      if (c == '$') ++i;
      if (c == quote) quote = 0;
      continue;
    }
    if (c == '\'' || c == '"') quote = c;
    if (c == '[') ++depth;
    if (c == ']') --depth;
    if (i < list.size() && (c != ',' || depth > 0 || quote != 0)) continue;
    std::string_view part = list.substr(begin, i - begin);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    if (!part.empty()) parts.emplace_back(part);
    begin = i + 1;
  }
  return parts;
}

Symbols::Symbols(const LoadedModule& module, const Memory& memory) : module_(module), memory_(memory) {}

void Symbols::addTerminal(std::string_view module, Terminal& wire) {
  Variable variable;
  variable.path = std::string(module) + '.' + wire.name;
  variable.type = wire.is_bool ? &kBoolType : &kLRealType;
  variable.bit = 255;
  variable.index = static_cast<uint32_t>(terminal_blocks_.size());
  variable.context = &terminal_context_;
  terminal_blocks_.push_back(wire.is_bool ? static_cast<void*>(&wire.state) : &wire.value);
  terminal_context_.blocks = terminal_blocks_.data();
  terminal_context_.module = &module_.description;
  terminals_.emplace(lowerCase(variable.path), variable);
}

Variable Symbols::root(uint32_t index) const {
  Variable variable;
  char path[kLongestPath];
  variable.path.assign(path, rung_path_of_symbol(&module_.description, index, path, sizeof path));
  rung_variable_of_symbol(&module_.description, index, &variable);
  variable.context = &memory_.common();
  return variable;
}

// ---- one path

// Appends what rung_find_step has taken, names as they are declared.
void Symbols::appendStep(std::string& path, std::string_view step, uint32_t detail) const {
  if (step[0] != '[') {
    path += step[0];
    path += detail != RUNG_NONE ? text(module_.fields[detail].name) : step.substr(1);
    return;
  }
  const char* separator = "[";
  for (const std::string_view index : indicesOf(step)) {
    int64_t number = 0;
    std::from_chars(index.data(), index.data() + index.size(), number);
    path += separator + std::to_string(number);
    separator = ",";
  }
  path += ']';
}

std::string Symbols::explainRoot(rung_path_error problem, std::string_view path, uint32_t area) const {
  if (problem == RUNG_PATH_ADDRESS) return backquoted(path) + " is not an address; write `%IX0.0`, `%QB1` or `%MW2`";
  if (problem == RUNG_PATH_WIDTH) return backquoted(path) + " has an unknown size; write X, B, W, D or L";
  if (problem == RUNG_PATH_OUTSIDE)
    return backquoted(path) + " is outside the image, of which the program uses " +
           std::to_string(module_.areas[area].size) + " bytes";
  if (const std::string inside = inPrograms(path); !inside.empty())
    return "unknown variable " + backquoted(path) + "; did you mean " + backquoted(inside) + "?";
  std::vector<std::string_view> names;
  for (const rung_symbol& symbol : module_.symbols) names.push_back(text(symbol.name));
  return "unknown variable " + backquoted(path) + didYouMean(path.substr(0, path.find_first_of(".[^")), names);
}

std::string Symbols::explainIndices(rung_path_error problem, const rung_path& rest, const Variable& variable) const {
  const std::vector<std::string_view> indices = indicesOf({rest.at, static_cast<size_t>(rest.end - rest.at)});
  if (problem == RUNG_PATH_DIMENSIONS)
    return backquoted(variable.path) + " has " + std::to_string(variable.type->count) + " dimension(s), not " +
           std::to_string(indices.size());
  const std::string written(indices[rest.detail]);
  if (problem == RUNG_PATH_INDEX) return backquoted(written) + " is not an index; write a number";
  const rung_dimension& dimension = module_.dimensions[variable.type->first + rest.detail];
  return "index " + written + " of " + backquoted(variable.path) + " is outside " + std::to_string(dimension.low) +
         ".." + std::to_string(dimension.high);
}

std::string Symbols::explainStep(rung_path_error problem, const rung_path& rest, const Variable& variable) const {
  const std::string before = backquoted(variable.path);
  if (problem == RUNG_PATH_DIMENSIONS || problem == RUNG_PATH_INDEX || problem == RUNG_PATH_RANGE)
    return explainIndices(problem, rest, variable);
  if (problem == RUNG_PATH_NO_POINTER) return before + " is not a pointer";
  if (problem == RUNG_PATH_NO_ARRAY) return before + " is not an array";
  if (problem == RUNG_PATH_BRACKET) return "expected `]` after " + before + "[";
  if (problem == RUNG_PATH_NO_RECORD) return before + " has no fields";
  if (problem == RUNG_PATH_DEPTH)
    return "the path goes through more than " + std::to_string(RUNG_VARIABLE_POINTERS) + " pointers after " + before;
  if (problem == RUNG_PATH_STEP) return "expected `.field`, `[index]` or nothing after " + before;
  const std::string_view step(rest.at + 1, static_cast<size_t>(rest.end - rest.at - 1));
  const std::string_view name = step.substr(0, step.find_first_of(".[^"));
  if (problem == RUNG_PATH_NO_BIT) return before + " has no bit " + backquoted(name);
  std::vector<std::string_view> names;
  fieldNames(*variable.type, names);
  return before + " has no variable " + backquoted(name) + didYouMean(name, names);
}

// The names of the fields of a record, then those that it inherits.
void Symbols::fieldNames(const rung_type& record, std::vector<std::string_view>& names) const {
  const rung_type* base = nullptr;
  for (uint32_t i = 0; i < record.count; ++i) {
    const rung_field& field = module_.fields[record.first + i];
    if ((field.flags & RUNG_FIELD_BASE) != 0)
      base = &module_.types[field.type];
    else
      names.push_back(text(field.name));
  }
  if (base != nullptr) fieldNames(*base, names);
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
  if (!terminals_.empty())
    if (const auto terminal = terminals_.find(lowerCase(path)); terminal != terminals_.end())
      return variable = terminal->second, true;

  variable = Variable();
  variable.context = &memory_.common();
  rung_path rest{path.data(), path.data() + path.size(), RUNG_NONE};
  rung_path_error problem = rung_find_step(&module_.description, &rest, &variable);
  if (problem != RUNG_PATH_OK) return error = explainRoot(problem, path, rest.detail), false;
  variable.path = rest.detail != RUNG_NONE ? root(rest.detail).path : std::string(path);
  while (rest.at != rest.end) {
    const char* const begin = rest.at;
    problem = rung_find_step(&module_.description, &rest, &variable);
    if (problem != RUNG_PATH_OK) return error = explainStep(problem, rest, variable), false;
    appendStep(variable.path, {begin, static_cast<size_t>(rest.at - begin)}, rest.detail);
  }
  return true;
}

// ---- many variables

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

std::vector<std::string> Symbols::findAgain(std::vector<Variable>& variables) const {
  std::vector<std::string> missing;
  for (Variable& variable : variables) {
    Variable found;
    std::string ignored;
    const bool exists = find(variable.path, found, ignored);
    if (!exists && !variable.isEmpty()) missing.push_back(variable.path);
    found.path = std::move(variable.path);
    if (!exists) found.type = nullptr;
    variable = std::move(found);
  }
  return missing;
}

void Symbols::expand(const Variable& variable, std::vector<Variable>& to, Detail detail, size_t most) const {
  struct Expansion {
    const Symbols& symbols;
    const rung_context* context;
    std::vector<Variable>& to;
    Detail detail;
    size_t most;
  } all{*this, variable.context, to, detail, most};
  const auto visit = [](void* data, const rung_part* part) {
    Expansion& list = *static_cast<Expansion*>(data);
    if (list.to.size() >= list.most) return RUNG_WALK_END;
    if (part->field != nullptr && !list.symbols.isListed(*part->owner, *part->field, list.detail))
      return RUNG_WALK_SKIP;
    if (part->variable->type->kind >= RUNG_ARRAY) return RUNG_WALK_ENTER;
    Variable& leaf = list.to.emplace_back();
    static_cast<rung_variable&>(leaf) = *part->variable;
    leaf.path.assign(part->path, part->path_size);
    leaf.context = list.context;
    return RUNG_WALK_ENTER;
  };
  char path[kLongestPath];
  if (variable.path.size() >= sizeof path) return;
  memcpy(path, variable.path.c_str(), variable.path.size() + 1);
  rung_walk_variable(&module_.description, &variable, path, sizeof path, visit, &all);
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
