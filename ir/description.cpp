// SPDX-License-Identifier: Apache-2.0
// The description of a module: see description.h.
#include "ir/description.h"

#include <algorithm>
#include <unordered_set>

#include "ir/image_writes.h"

namespace rung::ir {

using types::Field;
using types::FieldRole;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

class Describer {
 public:
  Describer(const Module& module, const MemoryBlocks& blocks, Description& out)
      : module_(module), types_(module.types), blocks_(blocks), out_(out) {}

  void run(bool with_tests, bool with_locals) {
    addBodiesAndFiles();
    findLibraryBlocks();
    for (uint32_t i = 0; i < blocks_.blocks.size(); ++i) addBlock(i);
    for (const types::MemoryArea& area : module_.areas) addArea(area);
    addSymbols();
    addTasks();
    addIoModules();
    if (with_tests) addTests();
    addInitialisers();
    addLives();
    out_.layout_hash = layoutHash();
    if (with_locals) addLocals();
    addNames();
    out_.aligned_globals = module_.aligned_globals;
  }

 private:
  uint32_t string(std::string_view string) { return out_.strings.add(string); }
  uint32_t string(NameId name) { return string(module_.names.string(name)); }

  void findLibraryBlocks() {
    for (const Record& record : module_.records) {
      const TypeId id = types_.resolve(record.type);
      if (record.library && types_.info(id).record_kind == types::RecordKind::FunctionBlock)
        library_blocks_.insert(id.index);
    }
  }

  void addBodiesAndFiles() {
    std::vector<std::string_view> names, files;
    for (size_t i = 1; i < module_.bodies.size(); ++i) {
      const Body& body = module_.bodies[i];
      if (body.native) continue;
      names.push_back(module_.names.string(body.spelling ? body.spelling : body.name));
      files.push_back(body.origin.path ? module_.names.string(body.origin.path) : module_.sources.path(body.file));
    }
    std::sort(names.begin(), names.end());
    std::sort(files.begin(), files.end());
    for (std::string_view name : names) string(name);
    for (std::string_view file : files) string(file);
  }

  // ---- types

  uint32_t type(TypeId id) {
    id = types_.resolve(id);
    const TypeInfo* info = &types_.info(id);
    if (info->kind == TypeKind::Subrange) {
      id = types_.plain(id);
      info = &types_.info(id);
    }
    const auto known = type_number_.find(id.index);
    if (known != type_number_.end()) return known->second;
    const auto index = static_cast<uint32_t>(out_.types.size());
    type_number_.emplace(id.index, index);
    out_.types.emplace_back();

    rung_type row{};
    row.kind = static_cast<uint8_t>(hostKind(types_, id));
    row.element = RUNG_NONE;
    if (info->kind == TypeKind::Enum) {
      row.kind = RUNG_ENUM;
      row.element = type(info->base);
      row.first = static_cast<uint32_t>(out_.enum_items.size());
      row.count = static_cast<uint32_t>(info->items.size());
      for (const auto& [name, value] : info->items) out_.enum_items.push_back({string(name), value});
    } else if (info->kind == TypeKind::Array) {
      row.element = type(info->base);
      row.first = static_cast<uint32_t>(out_.dimensions.size());
      row.count = static_cast<uint32_t>(info->dimensions.size());
      for (const types::Dimension& d : info->dimensions) out_.dimensions.push_back({d.low, d.high});
    } else if (info->kind == TypeKind::Pointer || info->kind == TypeKind::Reference) {
      row.element = type(info->base);
    } else if (info->kind == TypeKind::Record) {
      row.first = static_cast<uint32_t>(out_.fields.size());
      row.count = static_cast<uint32_t>(info->fields.size() + info->bits.size());
      for (uint32_t i = 0; i < info->fields.size(); ++i) row.count -= holdsBits(*info, i) ? 1 : 0;
      out_.fields.resize(row.first + row.count);
      uint32_t next = row.first;
      const auto add = [&](rung_field created) { out_.fields[next++] = created; };  // type() may have added fields
      for (uint32_t i = 0; i < info->fields.size(); ++i) {
        const Field& field = info->fields[i];
        if (!holdsBits(*info, i)) add({string(field.name), type(field.type), field.offset, flags(field)});
        for (const types::BitMember& bit : info->bits)  // one field per bit, not one for the byte that holds them
          if (bit.field == i)
            add({string(bit.name), type(types::kBool), field.offset,
                 flags(field) | (bit.bit + 1u) << RUNG_FIELD_BIT_SHIFT});
      }
    }
    const TypeKind plain = types_.plainKind(id);
    row.library = library_blocks_.count(types_.resolve(id).index) != 0 ? 1 : 0;
    row.is_signed = TypeTable::isScalar(plain) && types_.isSigned(plain) ? 1 : 0;
    // A structure written in place is STRUCT in messages; tools know it by its C++ name.
    const bool is_unnamed = info->shown_name && types_.names().string(info->shown_name) == "STRUCT";
    row.name = string(is_unnamed ? std::string(types_.names().string(info->name)) : types_.toString(id));
    row.size = static_cast<uint32_t>(info->size);
    row.length = info->length;
    out_.types[index] = row;
    return index;
  }

  // The records of the table of types that have initial values, or FB_Init.
  void addInitialisers() {
    std::unordered_map<uint32_t, BodyId> bodies;  // by record
    for (const Record& record : module_.records) bodies[types_.resolve(record.type).index] = record.init;
    for (const BodyId maker : module_.makers) bodies[types_.resolve(module_.body(maker).self).index] = maker;
    for (const auto& [record, body] : bodies) {
      const auto known = type_number_.find(record);
      if (body && known != type_number_.end()) out_.initialisers.push_back({known->second, body});
    }
    std::sort(out_.initialisers.begin(), out_.initialisers.end(),
              [](const auto& a, const auto& b) { return a.type < b.type; });
  }

  void addLocals() {
    out_.self_types.assign(module_.bodies.size(), RUNG_NONE);
    out_.local_types.resize(module_.bodies.size());
    for (uint32_t i = 1; i < module_.bodies.size(); ++i) {
      const Body& body = module_.bodies[i];
      if (body.native) continue;
      if (body.self) out_.self_types[i] = type(body.self);
      for (const Local& local : body.locals) out_.local_types[i].push_back(type(local.type));
    }
  }

  // ---- online changes

  const BlockLife* lifeOf(const InitStep& step) const {
    const auto found = std::find_if(module_.lives.begin(), module_.lives.end(), [&](const BlockLife& life) {
      return life.is_list == step.is_list && life.index == step.index;
    });
    return found == module_.lives.end() ? nullptr : &*found;
  }
  void addLives() {
    if (module_.lives.empty()) return;
    for (const InitStep& step : initOrder(module_, blocks_)) {
      const BlockLife* const life = lifeOf(step);
      if (life == nullptr) continue;
      const uint32_t block = step.is_list ? blocks_.list_block[step.index] : blocks_.program_block[step.index];
      const TypeId record = blocks_.blocks[block].record;
      const BodyId init = step.is_list ? module_.lists[step.index].init : module_.programs[step.index].init;
      const BodyId setup = step.is_list ? BodyId{} : module_.programs[step.index].setup;
      out_.lives.push_back({block, type(record), record, init, setup, life->refresh, life->reinit, life->exit});
    }
    for (const Class& object : module_.classes) out_.classes.push_back(type(object.record));
  }

  static bool holdsBits(const TypeInfo& record, uint32_t field) {
    return std::any_of(record.bits.begin(), record.bits.end(), [&](const auto& bit) { return bit.field == field; });
  }

  static uint32_t flags(const Field& field) {
    uint32_t bits = 0;
    if (field.by_reference) bits |= RUNG_FIELD_BY_REFERENCE;
    if (field.constant) bits |= RUNG_FIELD_CONSTANT;
    if (field.retain) bits |= RUNG_FIELD_RETAIN;
    if (field.persistent) bits |= RUNG_FIELD_PERSISTENT;
    if (field.role == FieldRole::Input) bits |= RUNG_FIELD_INPUT;
    if (field.role == FieldRole::Output) bits |= RUNG_FIELD_OUTPUT;
    if (field.role == FieldRole::Base) bits |= RUNG_FIELD_BASE;
    if (field.no_copy) bits |= RUNG_FIELD_NO_COPY;
    if (field.role == FieldRole::InOut && !field.by_reference) bits |= RUNG_FIELD_OPEN_ARRAY;
    return bits | accessFlags(field.symbol_access);
  }
  static uint32_t accessFlags(types::SymbolAccess access) {
    switch (access) {
      case types::SymbolAccess::ReadWrite: return 0;
      case types::SymbolAccess::Read: return RUNG_FIELD_NO_EXTERNAL_WRITE;
      case types::SymbolAccess::Write: return RUNG_FIELD_NO_EXTERNAL_READ;
      case types::SymbolAccess::None: return RUNG_FIELD_NO_EXTERNAL_READ | RUNG_FIELD_NO_EXTERNAL_WRITE;
    }
    return 0;
  }

  // ---- blocks and the ranges of them that are kept

  // The strength with which a variable is kept: not, over warm starts, or over downloads too. The stronger one holds
  // where two meet.
  enum class Keeping : uint8_t { None, Retain, Persistent };

  // The wish of the variables in a type: to be kept, or not to be.
  struct Kept {
    Keeping keeps = Keeping::None;
    bool excludes = false;
  };
  static Keeping keepingOf(const Field& field) {
    return field.persistent ? Keeping::Persistent : field.retain ? Keeping::Retain : Keeping::None;
  }
  Kept keptIn(TypeId id) {
    id = types_.resolve(id);
    const TypeInfo& info = types_.info(id);
    if (info.kind == TypeKind::Array) return keptIn(info.base);
    if (info.kind != TypeKind::Record) return {};
    const auto known = kept_.find(id.index);
    if (known != kept_.end()) return known->second;
    kept_[id.index] = {};
    Kept found;
    for (const Field& field : info.fields) {
      const Kept inside = field.by_reference ? Kept{} : keptIn(field.type);
      found.keeps = std::max({found.keeps, keepingOf(field), inside.keeps});
      found.excludes = found.excludes || field.non_retain || inside.excludes;
    }
    return kept_[id.index] = found;
  }

  static void add(std::vector<rung_range>& ranges, uint32_t block, uint64_t offset, uint64_t size) {
    if (!ranges.empty() && ranges.back().block == block && ranges.back().offset + ranges.back().size == offset) {
      ranges.back().size += static_cast<uint32_t>(size);
    } else {
      ranges.push_back({block, static_cast<uint32_t>(offset), static_cast<uint32_t>(size)});
    }
  }
  std::vector<rung_range>& rangesOf(Keeping keeping) {
    return keeping == Keeping::Persistent ? out_.persistent : out_.retain;
  }

  // RETAIN, PERSISTENT and NON_RETAIN of a variable hold for what is in it, except where a variable of a block says
  // otherwise; what is RETAIN in something PERSISTENT is PERSISTENT. No byte is in two ranges.
  void collectKept(TypeId id, uint32_t block, uint64_t offset, Keeping keeping) {
    id = types_.resolve(id);
    const TypeInfo& info = types_.info(id);
    const Kept inside = keptIn(id);
    if (keeping == Keeping::None && inside.keeps == Keeping::None) return;
    if (keeping != Keeping::None && keeping >= inside.keeps && !inside.excludes)
      return add(rangesOf(keeping), block, offset, info.size);
    if (info.kind == TypeKind::Array) {
      const uint64_t size = types_.info(types_.resolve(info.base)).size;
      for (uint64_t at = 0; size > 0 && at < info.size; at += size) collectKept(info.base, block, offset + at, keeping);
      return;
    }
    for (const Field& field : info.fields) {
      if (field.by_reference) continue;
      const Keeping kept = field.non_retain ? Keeping::None : std::max(keeping, keepingOf(field));
      collectKept(field.type, block, offset + field.offset, kept);
    }
  }

  // Inputs come from the process.
  void keepLocated(const Located& located) {
    const bool is_input = module_.areas[located.area].owner == types::AreaOwner::Input;
    if (is_input || (!located.retain && !located.persistent)) return;
    std::vector<rung_range>& ranges = rangesOf(located.persistent ? Keeping::Persistent : Keeping::Retain);
    const uint32_t area = RUNG_RANGE_AREA | located.area;
    if (located.bit != kNoBit)
      ranges.push_back({area | RUNG_RANGE_BIT, located.byte * 8 + located.bit, 1});
    else
      add(ranges, area, located.byte, types_.info(types_.resolve(located.type)).size);
  }

  void addBlock(uint32_t index) {
    const MemoryBlocks::Block& block = blocks_.blocks[index];
    const TypeInfo& info = types_.info(types_.resolve(block.record));
    out_.blocks.push_back({string(block.name), static_cast<uint32_t>(info.size), info.align});
    type(block.record);
    collectKept(block.record, index, 0, block.retain ? Keeping::Retain : Keeping::None);
  }

  // ---- symbols

  std::string programPath(const ProgramInstance& program) {
    std::string path;
    for (NameId part : {program.configuration, program.resource}) {
      if (!part) continue;
      path += module_.names.string(part);
      path += '.';
    }
    return path;
  }

  void addArea(const types::MemoryArea& area) {
    const uint8_t owner = area.owner == types::AreaOwner::Input    ? RUNG_AREA_INPUT
                          : area.owner == types::AreaOwner::Output ? RUNG_AREA_OUTPUT
                          : area.owner == types::AreaOwner::Shared ? RUNG_AREA_SHARED
                                                                   : RUNG_AREA_MEMORY;
    const std::string prefix = {'%', area.letter};
    out_.areas.push_back({string(prefix.substr(1)), string(prefix), area.bytes, owner});
  }

  struct SymbolRow {
    std::string key;  // the name in lower case
    rung_symbol symbol;
  };
  using SymbolRows = std::vector<SymbolRow>;

  void addSymbols() {
    SymbolRows rows;
    addPrograms(rows);
    addLists(rows);
    for (const Located& located : module_.located) addLocated(located, rows);
    for (const AccessPath& access : module_.access_paths) addAccessPath(access, rows);
    // The order of the input files does not show: programs stay first among equal names.
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
    for (const SymbolRow& row : rows) out_.symbols.push_back(row.symbol);
  }

  void add(SymbolRows& rows, rung_symbol symbol, std::string_view name, std::string_view path) {
    symbol.name = string(name);
    symbol.path = string(path);
    rows.push_back({foldedIdentifier(name), symbol});
  }

  rung_symbol inBlock(TypeId type_id, uint32_t block, uint64_t offset) {
    rung_symbol symbol{};
    symbol.type = type(type_id);
    symbol.storage = RUNG_IN_BLOCK;
    symbol.bit = 255;
    symbol.index = block;
    symbol.offset = static_cast<uint32_t>(offset);
    return symbol;
  }

  void addPrograms(SymbolRows& rows) {
    for (uint32_t i = 0; i < module_.programs.size(); ++i) {
      const ProgramInstance& program = module_.programs[i];
      rung_symbol symbol = inBlock(program.record, blocks_.program_block[i], 0);
      symbol.is_program = 1;
      add(rows, symbol, module_.names.string(program.name), programPath(program));
    }
  }

  void addLists(SymbolRows& rows) {
    for (uint32_t i = 0; i < module_.lists.size(); ++i) {
      const TypeInfo& record = types_.info(types_.resolve(module_.lists[i].record));
      const std::string configuration(module_.names.string(module_.lists[i].configuration));
      const std::string path = (configuration.empty() ? "" : configuration + ".") +
                               std::string(module_.names.string(module_.lists[i].name)) + ".";
      for (const Field& field : record.fields) {
        rung_symbol symbol = inBlock(field.type, blocks_.list_block[i], field.offset);
        symbol.flags = flags(field);
        add(rows, symbol, module_.names.string(field.name), path);
      }
    }
  }

  void addLocated(const Located& located, SymbolRows& rows) {
    std::string name, path;
    if (located.owner_program != 0) {
      const ProgramInstance& owner = module_.programs[located.owner_program - 1];
      name = module_.names.string(owner.name);
      name += '.';
      path = programPath(owner);
    }
    for (const NameId prefix : {located.configuration, located.list})
      if (prefix) path.append(module_.names.string(prefix)).append(".");
    name += module_.names.string(located.name);
    rung_symbol symbol = inBlock(located.type, 0, located.byte);
    symbol.storage = RUNG_IN_AREA;
    symbol.index = located.area;
    if (located.bit != kNoBit) symbol.bit = static_cast<uint8_t>(located.bit);
    symbol.flags = accessFlags(located.symbol_access);
    if (located.retain) symbol.flags |= RUNG_FIELD_RETAIN;
    if (located.persistent) symbol.flags |= RUNG_FIELD_PERSISTENT;
    keepLocated(located);
    add(rows, symbol, name, path);
  }

  void addAccessPath(const AccessPath& access, SymbolRows& rows) {
    std::string name, path;
    if (access.configuration) path.append(module_.names.string(access.configuration)).append(".");
    if (access.prefix) name.append(module_.names.string(access.prefix)).append(".");
    name += module_.names.string(access.name);
    const bool in_image = access.root == AccessPath::Root::Image;
    const uint32_t block = in_image                                   ? access.index
                           : access.root == AccessPath::Root::Program ? blocks_.program_block[access.index]
                                                                      : blocks_.list_block[access.index];
    rung_symbol symbol = inBlock(access.type, block, access.offset);
    if (in_image) symbol.storage = RUNG_IN_AREA;
    if (access.bit != kNoBit) symbol.bit = static_cast<uint8_t>(access.bit);
    if (access.read_only) symbol.flags = RUNG_FIELD_READ_ONLY;
    add(rows, symbol, name, path);
  }

  // ---- the names of symbols and fields

  void addName(uint32_t owner, uint32_t name, uint32_t row) {
    uint32_t hash = rung_name_seed(owner);
    for (const char* c = out_.strings.bytes().c_str() + name; *c != 0; ++c) hash = rung_name_hash(hash, *c);
    const auto count = static_cast<uint32_t>(out_.names.size());
    uint32_t at = rung_name_slot(hash, count);
    while (out_.names[at] != 0) at = at + 1 == count ? 0 : at + 1;
    out_.names[at] = row + 1;
  }

  // Twice as many rows as names keep the way to a name short, and the way to the end of a search for none.
  void addNames() {
    constexpr size_t kFew = 32;
    const size_t count = out_.symbols.size() + out_.fields.size();
    if (count <= kFew) return;
    out_.names.resize(2 * count);
    uint32_t row = 0;
    for (const rung_symbol& symbol : out_.symbols) addName(RUNG_NONE, symbol.name, row++);
    std::vector<uint32_t> owners(out_.fields.size());
    for (const rung_type& type : out_.types)
      if (type.kind == RUNG_RECORD) std::fill_n(owners.begin() + type.first, type.count, type.first);
    for (size_t i = 0; i < out_.fields.size(); ++i) addName(owners[i], out_.fields[i].name, row++);
  }

  // ---- tasks and tests

  void addTasks() {
    for (uint32_t i = 0; i < module_.tasks.size(); ++i) {
      const Task& task = module_.tasks[i];
      rung_task row{};
      row.name = string(task.name);
      row.kind = static_cast<uint8_t>(task.kind);  // in the order of rung_task_kind
      row.priority = task.priority;
      row.interval_ns = task.interval_ns;
      row.watchdog_ns = task.watchdog_ns;
      row.sensitivity = task.sensitivity;
      row.trigger = string(task.trigger);
      row.external_event = string(task.external_event);
      row.resource = resource(task.resource);
      row.duration_ns = task.duration_ns;
      const std::vector<rung_write> writes = imageWrites(module_, i);
      row.first_write = static_cast<uint32_t>(out_.writes.size());
      row.write_count = static_cast<uint32_t>(writes.size());
      out_.writes.insert(out_.writes.end(), writes.begin(), writes.end());
      out_.tasks.push_back(row);
    }
  }

  void addIoModules() {
    for (const types::IoModule& module : module_.io_modules)
      out_.io_modules.push_back({string(module.name), string(module.type), string(module.station),
                                 module.task == 0 ? RUNG_NONE : module.task - 1, module.input_offset,
                                 module.output_offset});
  }

  uint32_t resource(NameId name) {
    const uint32_t text = name ? string(name) : 0;
    const auto known = std::find(out_.resources.begin(), out_.resources.end(), text);
    const auto index = static_cast<uint32_t>(known - out_.resources.begin());
    if (known == out_.resources.end()) out_.resources.push_back(text);
    return index;
  }

  void addTests() {
    for (const ir::Test& described : module_.tests) {
      const BodyId id = described.body;
      const Body& body = module_.body(id);
      Description::Test test{{}, id, RUNG_NONE, {}, {}, described.before, described.after};
      const auto ofFile = [&](const std::vector<BodyId>& all) {
        std::vector<BodyId> found;
        for (const BodyId one : all)
          if (module_.body(one).file == body.file) found.push_back(one);
        return found;
      };
      test.setups = ofFile(module_.setups);
      if (described.setup) test.setups.insert(test.setups.begin(), described.setup);
      test.teardowns = ofFile(module_.teardowns);
      test.row.done_block = RUNG_NONE;
      for (uint32_t p = 0; body.kind != BodyKind::Function && p < module_.programs.size(); ++p) {
        if (!(module_.programs[p].body == id)) continue;
        test.program = p;
        for (const Field& field : types_.info(types_.resolve(module_.programs[p].record)).fields) {
          if (!sameIdentifier(module_.names.string(field.name), "done") ||
              types_.plainKind(field.type) != TypeKind::Bool) {
            continue;
          }
          test.row.done_block = blocks_.program_block[p];
          test.row.done_offset = field.offset;
        }
        break;
      }
      const FilePosition position = filePosition(module_, body, described.loc);
      test.row.name = string(described.name);
      test.row.file = string(position.path);
      test.row.line = position.line;
      out_.tests.push_back(test);
    }
  }

  // Hash of everything that decides where data lies: retained data with another hash does not fit.
  uint64_t layoutHash() const {
    uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    const auto add = [&](std::string_view bytes) {
      for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    };
    const auto numbers = [&](std::initializer_list<int64_t> values) {
      for (const int64_t value : values) add(std::to_string(value) + ",");
    };
    numbers({RUNG_MODULE_LAYOUT});
    const auto name = [&](uint32_t offset) { add(out_.strings.bytes().c_str() + offset); };
    for (const rung_block& row : out_.blocks) {
      name(row.name);
      numbers({row.size, row.align});
    }
    for (const rung_type& row : out_.types) {
      name(row.name);
      numbers({row.kind, row.is_signed, row.size, row.element, row.length, row.first, row.count});
    }
    for (const rung_field& row : out_.fields) {
      name(row.name);
      constexpr uint32_t kAccess = RUNG_FIELD_NO_EXTERNAL_READ | RUNG_FIELD_NO_EXTERNAL_WRITE;  // moves nothing
      numbers({row.type, row.offset, row.flags & ~kAccess});
    }
    for (const rung_dimension& row : out_.dimensions) numbers({row.low, row.high});
    return hash;
  }

  const Module& module_;
  const TypeTable& types_;
  const MemoryBlocks& blocks_;
  Description& out_;
  std::unordered_map<uint32_t, uint32_t> type_number_;
  std::unordered_map<uint32_t, Kept> kept_;
  std::unordered_set<uint32_t> library_blocks_;  // TypeIds
};

}  // namespace

MemoryBlocks::MemoryBlocks(const Module& module) {
  struct Row {
    std::string key;
    bool is_program;
    uint32_t index;
  };
  std::vector<Row> rows;
  for (uint32_t i = 0; i < module.lists.size(); ++i)
    rows.push_back({foldedIdentifier(module.names.string(module.lists[i].name)), false, i});
  for (uint32_t i = 0; i < module.programs.size(); ++i)
    rows.push_back({foldedIdentifier(module.names.string(module.programs[i].name)), true, i});
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.key != b.key ? a.key < b.key : a.is_program < b.is_program;
  });
  list_block.resize(module.lists.size());
  program_block.resize(module.programs.size());
  for (const Row& row : rows) {
    (row.is_program ? program_block : list_block)[row.index] = block_count++;
    if (row.is_program) {
      const ProgramInstance& program = module.programs[row.index];
      blocks.push_back({program.name, program.record, program.retain});
    } else {
      blocks.push_back({module.lists[row.index].name, module.lists[row.index].record});
    }
  }
}

StringPool::StringPool() { add(""); }

uint32_t StringPool::add(std::string_view text) {
  const auto [at, is_new] = known_.try_emplace(std::string(text), static_cast<uint32_t>(bytes_.size()));
  if (is_new) {
    bytes_ += text;
    bytes_ += '\0';
  }
  return at->second;
}

Description::Description(const Module& module, const MemoryBlocks& memory, bool with_tests, bool with_locals) {
  Describer(module, memory, *this).run(with_tests, with_locals);
}

rung_type_kind hostKind(const TypeTable& types, TypeId type) {
  const TypeKind kind = types.plainKind(type);
  if (kind == TypeKind::Array) return RUNG_ARRAY;
  if (kind == TypeKind::Record) return RUNG_RECORD;
  if (!TypeTable::isElementary(kind)) return RUNG_POINTER;
  // Both lists name the elementary types in the same order.
  static_assert(static_cast<int>(TypeKind::UString) - static_cast<int>(TypeKind::Bool) == RUNG_USTRING - RUNG_BOOL);
  static_assert(static_cast<int>(TypeKind::Time) - static_cast<int>(TypeKind::Bool) == RUNG_TIME - RUNG_BOOL);
  static_assert(static_cast<int>(TypeKind::LDateTime) - static_cast<int>(TypeKind::Bool) == RUNG_LDT - RUNG_BOOL);
  return static_cast<rung_type_kind>(static_cast<int>(kind) - static_cast<int>(TypeKind::Bool));
}

FilePosition filePosition(const Module& module, const Body& body, Loc loc) {
  if (body.origin.path) return {module.names.string(body.origin.path), body.origin.line, 0};
  if (!loc) loc = body.loc;
  const SourceLocation location = module.sources.location(loc);
  return {module.sources.path(location.file), location.line, location.column};
}

std::vector<InitStep> initOrder(const Module& module, const MemoryBlocks& blocks) {
  std::vector<InitStep> order;
  for (uint32_t i = 0; i < module.lists.size(); ++i) order.push_back({true, i});
  std::vector<uint32_t> programs;
  for (uint32_t i = 0; i < module.programs.size(); ++i)
    if (!module.programs[i].is_test) programs.push_back(i);
  std::sort(programs.begin(), programs.end(),
            [&](uint32_t a, uint32_t b) { return blocks.program_block[a] < blocks.program_block[b]; });
  for (const uint32_t i : programs) order.push_back({false, i});
  const auto slot = [&](const InitStep& step) {
    return step.is_list ? module.lists[step.index].slot : module.programs[step.index].slot;
  };
  std::stable_sort(order.begin(), order.end(), [&](const InitStep& a, const InitStep& b) { return slot(a) < slot(b); });
  return order;
}

}  // namespace rung::ir
