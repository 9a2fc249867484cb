// SPDX-License-Identifier: Apache-2.0
// The symbol file: see symbols.h. A changed meaning of a key, or a key that goes, needs a new kFormat.
#include "codegen/symbols.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "frontend/source/render.h"

namespace rung::codegen {
namespace {

constexpr uint32_t kFormat = 1;
constexpr const char* kTypeWords[] = {
    "bool",  "byte",  "word",  "dword", "lword",  "sint",    "int",     "dint",  "lint",  "usint",  "uint",
    "udint", "ulint", "real",  "lreal", "time",   "ltime",   "date",    "ldate", "tod",   "ltod",   "dt",
    "ldt",   "char",  "wchar", "uchar", "string", "wstring", "ustring", "enum",  "array", "record", "pointer"};
static_assert(std::size(kTypeWords) == RUNG_POINTER + 1);
constexpr const char* kOwnerWords[] = {"input", "output", "memory", "shared"};
constexpr const char* kTaskWords[] = {"cyclic", "freewheeling", "event", "status", "external"};
static_assert(std::size(kTaskWords) == RUNG_EXTERNAL + 1);

// One object: `{"name": "Main", "size": 24}`.
class Object {
 public:
  Object& text(const char* key, std::string_view value) { return raw(key, jsonQuote(value)); }
  Object& number(const char* key, int64_t value) { return raw(key, std::to_string(value)); }
  Object& flag(const char* key, bool value) { return value ? raw(key, "true") : *this; }
  Object& raw(const char* key, std::string_view json) {
    out_ += out_.size() == 1 ? "\"" : ", \"";
    out_ += key;
    out_ += "\": ";
    out_ += json;
    return *this;
  }
  std::string end() const { return out_ + "}"; }

 private:
  std::string out_ = "{";
};

class SymbolWriter {
 public:
  explicit SymbolWriter(const ir::Description& is) : is_(is) {}

  std::string write(std::string_view module_name, uint32_t pointer_size) {
    Object versions;
    versions.number("format", kFormat).text("module", module_name).text("compiler", "rung " RUNG_VERSION);
    versions.number("abi", RUNG_MODULE_ABI).number("layout", RUNG_MODULE_LAYOUT);
    versions.text("layout_hash", std::to_string(is_.layout_hash)).number("pointer_size", pointer_size);
    std::string out = versions.end();
    out.pop_back();
    list(out, "blocks", is_.blocks, [&](const rung_block& row) {
      return Object().text("name", name(row.name)).number("size", row.size).number("align", row.align).end();
    });
    list(out, "areas", is_.areas, [&](const rung_area& row) {
      return Object().text("name", name(row.name)).text("owner", kOwnerWords[row.owner]).number("size", row.size).end();
    });
    list(out, "tasks", is_.tasks, [&](const rung_task& row) { return task(row); });
    std::vector<rung_symbol> symbols;
    for (const rung_symbol& row : is_.symbols)
      if (!isHidden(row.flags)) symbols.push_back(row);
    list(out, "symbols", symbols, [&](const rung_symbol& row) { return symbol(row); });
    list(out, "types", is_.types, [&](const rung_type& row) { return type(row); });
    const auto range = [this](const rung_range& row) {
      Object kept;
      const uint32_t index = row.block & ~(RUNG_RANGE_AREA | RUNG_RANGE_BIT);
      if ((row.block & RUNG_RANGE_AREA) == 0)
        kept.number("block", index);
      else
        kept.text("area", name(is_.areas[index].name));
      const bool is_bit = (row.block & RUNG_RANGE_BIT) != 0;
      kept.number("offset", is_bit ? row.offset / 8 : row.offset);
      if (is_bit) kept.number("bit", row.offset % 8);
      return kept.number("size", row.size).end();
    };
    list(out, "retain", is_.retain, range);
    list(out, "persistent", is_.persistent, range);
    return out + "\n}\n";
  }

 private:
  std::string_view name(uint32_t offset) const { return is_.strings.bytes().c_str() + offset; }

  template <class Rows, class Print>
  static void list(std::string& out, const char* key, const Rows& rows, Print print) {
    out += std::string(",\n\"") + key + "\": [";
    bool is_first = true;
    for (const auto& row : rows) {
      out += is_first ? "\n" : ",\n";
      is_first = false;
      out += print(row);
    }
    out += ']';
  }

  void typeOf(Object& to, uint32_t number) const {
    const rung_type& row = is_.types[number];
    to.text("type", name(row.name)).number("type_id", number);
  }

  // {attribute 'symbol' := 'none'}
  static bool isHidden(uint32_t flags) {
    constexpr uint32_t kBoth = RUNG_FIELD_NO_EXTERNAL_READ | RUNG_FIELD_NO_EXTERNAL_WRITE;
    return (flags & kBoth) == kBoth;
  }

  static void flags(Object& to, uint32_t flags) {
    if ((flags & RUNG_FIELD_NO_EXTERNAL_WRITE) != 0) to.text("access", "read");
    if ((flags & RUNG_FIELD_NO_EXTERNAL_READ) != 0) to.text("access", "write");
    to.flag("input", (flags & RUNG_FIELD_INPUT) != 0).flag("output", (flags & RUNG_FIELD_OUTPUT) != 0);
    to.flag("constant", (flags & RUNG_FIELD_CONSTANT) != 0).flag("read_only", (flags & RUNG_FIELD_READ_ONLY) != 0);
    to.flag("by_reference", (flags & RUNG_FIELD_BY_REFERENCE) != 0).flag("base", (flags & RUNG_FIELD_BASE) != 0);
  }

  std::string task(const rung_task& row) const {
    Object out;
    out.text("name", name(row.name)).text("kind", kTaskWords[row.kind]).number("priority", row.priority);
    if (row.kind == RUNG_CYCLIC) out.number("interval_ns", row.interval_ns);
    if (row.kind == RUNG_EVENT || row.kind == RUNG_STATUS) out.text("trigger", name(row.trigger));
    if (row.kind == RUNG_EXTERNAL) out.text("event", name(row.external_event));
    return out.end();
  }

  std::string symbol(const rung_symbol& row) const {
    const rung_type& type = is_.types[row.type];
    Object out;
    out.text("name", name(row.name));
    if (!name(row.path).empty()) out.text("prefix", name(row.path));
    out.flag("program", row.is_program != 0);
    typeOf(out, row.type);
    out.number("size", type.size);
    if (row.storage == RUNG_IN_AREA)
      out.text("area", name(is_.areas[row.index].name));
    else
      out.number("block", row.index);
    out.number("offset", row.offset);
    if (row.bit != 255) out.number("bit", row.bit);
    if (row.storage == RUNG_IN_AREA) out.text("address", address(row, type));
    flags(out, row.flags);
    if (row.storage == RUNG_IN_BLOCK) {
      kept(out, "retain", kept_, row.index, row.offset, type.size);  // what is persistent is retained too
      kept(out, "persistent", is_.persistent, row.index, row.offset, type.size);
    }
    return out.end();
  }

  // `%QX0.1`, `%IW4`, and `%MB12` where the offset is not a multiple of the size.
  std::string address(const rung_symbol& row, const rung_type& type) const {
    std::string out(name(is_.areas[row.index].prefix));
    if (row.bit != 255) return out + 'X' + std::to_string(row.offset) + '.' + std::to_string(row.bit);
    const char* const letter = type.size == 2 ? "W" : type.size == 4 ? "D" : type.size == 8 ? "L" : "B";
    if (*letter == 'B' || type.kind >= RUNG_STRING || row.offset % type.size != 0)
      return out + 'B' + std::to_string(row.offset);
    return out + letter + std::to_string(row.offset / type.size);
  }

  // Ranges are sorted, and neighbours are joined.
  static void kept(Object& out, const char* key, std::span<const rung_range> ranges, uint32_t block, uint32_t offset,
                   uint32_t size) {
    for (const rung_range& range : ranges) {
      if (range.block != block || range.offset >= offset + size || range.offset + range.size <= offset) continue;
      const bool is_whole = range.offset <= offset && range.offset + range.size >= offset + size;
      out.raw(key, is_whole ? "true" : "\"partly\"");
      return;
    }
  }

  std::string items(const rung_type& row) const {
    Object items;
    for (uint32_t i = row.first; i < row.first + row.count; ++i) {
      const std::string key(name(is_.enum_items[i].name));
      items.number(key.c_str(), is_.enum_items[i].value);
    }
    return items.end();
  }

  std::string dimensions(const rung_type& row) const {
    std::string dimensions;
    for (uint32_t i = row.first; i < row.first + row.count; ++i)
      dimensions += (dimensions.empty() ? "[" : ", [") + std::to_string(is_.dimensions[i].low) + ", " +
                    std::to_string(is_.dimensions[i].high) + "]";
    return "[" + dimensions + "]";
  }

  std::string fields(const rung_type& row) const {
    std::string fields;
    for (uint32_t i = row.first; i < row.first + row.count; ++i)
      if (!isHidden(is_.fields[i].flags)) fields += (fields.empty() ? "\n  " : ",\n  ") + field(is_.fields[i]);
    return "[" + fields + "]";
  }

  std::string type(const rung_type& row) const {
    Object out;
    out.text("name", name(row.name)).text("kind", kTypeWords[row.kind]).number("size", row.size);
    switch (static_cast<rung_type_kind>(row.kind)) {
      case RUNG_TIME:
      case RUNG_LTIME: out.flag("signed", row.is_signed != 0); break;
      case RUNG_STRING:
      case RUNG_WSTRING:
      case RUNG_USTRING: out.number("length", row.length); break;
      case RUNG_ENUM:
        typeOf(out, row.element);
        out.raw("items", items(row));
        break;
      case RUNG_ARRAY:
        typeOf(out, row.element);
        out.raw("dimensions", dimensions(row));
        break;
      case RUNG_RECORD: out.raw("fields", fields(row)); break;
      case RUNG_POINTER:
        if (row.element != RUNG_NONE) typeOf(out, row.element);
        break;
      case RUNG_BOOL:
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
    return out.end();
  }

  std::string field(const rung_field& row) const {
    Object out;
    out.text("name", name(row.name));
    typeOf(out, row.type);
    out.number("offset", row.offset).number("size", is_.types[row.type].size);
    if ((row.flags & RUNG_FIELD_BIT) != 0)
      out.number("bit", ((row.flags & RUNG_FIELD_BIT) >> RUNG_FIELD_BIT_SHIFT) - 1);
    flags(out, row.flags);
    out.flag("retain", (row.flags & RUNG_FIELD_RETAIN) != 0)
        .flag("persistent", (row.flags & RUNG_FIELD_PERSISTENT) != 0);
    return out.end();
  }

  static std::vector<rung_range> keptRanges(const ir::Description& is) {
    std::vector<rung_range> all = is.retain, joined;
    all.insert(all.end(), is.persistent.begin(), is.persistent.end());
    std::sort(all.begin(), all.end(), [](const rung_range& a, const rung_range& b) {
      return a.block != b.block ? a.block < b.block : a.offset < b.offset;
    });
    for (const rung_range& range : all) {
      if (!joined.empty() && joined.back().block == range.block &&
          joined.back().offset + joined.back().size == range.offset)
        joined.back().size += range.size;
      else
        joined.push_back(range);
    }
    return joined;
  }

  const ir::Description& is_;
  const std::vector<rung_range> kept_ = keptRanges(is_);
};

}  // namespace

std::string symbolFile(const ir::Description& description, std::string_view module_name, uint32_t pointer_size) {
  return SymbolWriter(description).write(module_name, pointer_size);
}

}  // namespace rung::codegen
