// The description of the module: see module.h. Every table is numbered in the order in which the blocks, sorted by
// name, reach its rows, so that the order of the inputs does not show.
#include "codegen/module.h"

#include <algorithm>
#include <unordered_map>

#include "codegen/body.h"
#include "codegen/names.h"
#include "codegen/types.h"

namespace rung::codegen {

using types::Field;
using types::FieldRole;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

class Describer {
 public:
  Describer(const ir::Module& module, const EmitOptions& options, const Facts& facts, std::string_view name_space)
      : module_(module), types_(module.types), options_(options), facts_(facts), name_space_(name_space) {
    pool_.emplace("", 0);
    bytes_ += '\0';
  }

  Description run(const std::vector<Group>& groups) {
    addBodiesAndFiles();
    for (uint32_t i = 0; i < facts_.blocks.size(); ++i) addBlock(i);
    addSymbols();
    addTasks();
    addTests();
    return {moduleText(), sitesText(groups)};
  }

 private:
  uint32_t text(std::string_view string) {
    const auto [at, is_new] = pool_.try_emplace(std::string(string), static_cast<uint32_t>(bytes_.size()));
    if (is_new) {
      bytes_ += string;
      bytes_ += '\0';
    }
    return at->second;
  }
  uint32_t text(NameId name) { return text(module_.names.text(name)); }

  // Names of sites stand first: they do not depend on which bodies have checks.
  void addBodiesAndFiles() {
    std::vector<std::string_view> names;
    for (uint32_t i = 1; i < module_.bodies.size(); ++i) {
      const ir::Body& body = module_.bodies[i];
      if (!body.native) names.push_back(module_.names.text(body.spelling ? body.spelling : body.name));
    }
    const size_t files = names.size();
    for (uint32_t i = 1; i < module_.bodies.size(); ++i) {
      const ir::Body& body = module_.bodies[i];
      if (body.native) continue;
      names.push_back(body.origin.path ? module_.names.text(body.origin.path) : module_.sources.path(body.file));
    }
    std::sort(names.begin(), names.begin() + static_cast<ptrdiff_t>(files));
    std::sort(names.begin() + static_cast<ptrdiff_t>(files), names.end());
    for (std::string_view name : names) text(name);
  }

  // ---- rows of the tables, in braces

  static void row(std::string& table, std::initializer_list<std::string_view> cells) {
    table += '{';
    bool first = true;
    for (std::string_view cell : cells) {
      if (!first) table += ',';
      first = false;
      table += cell;
    }
    table += "},\n";
  }
  static std::string number(uint64_t value) { return std::to_string(value); }
  static std::string unsignedOrNone(uint32_t value) { return value == ~0u ? "RUNG_NONE" : std::to_string(value); }
  static std::string signedNumber(int64_t value) {
    return value == INT64_MIN ? std::string("INT64_MIN") : std::to_string(value) + "LL";
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
    const auto index = static_cast<uint32_t>(type_rows_.size());
    type_number_.emplace(id.index, index);
    type_rows_.emplace_back();

    uint32_t element = ~0u, first = 0, count = 0;
    const char* kind = typeKindName(types_, id);
    if (info->kind == TypeKind::Enum) {
      kind = "RUNG_ENUM";
      element = type(info->base);
      first = item_count_;
      count = static_cast<uint32_t>(info->items.size());
      for (const auto& [name, value] : info->items) row(item_rows_, {number(text(name)), signedNumber(value)});
      item_count_ += count;
    } else if (info->kind == TypeKind::Array) {
      element = type(info->base);
      first = dimension_count_;
      count = static_cast<uint32_t>(info->dimensions.size());
      for (const types::Dimension& d : info->dimensions) {
        row(dimension_rows_, {signedNumber(d.low), signedNumber(d.high)});
      }
      dimension_count_ += count;
    } else if (info->kind == TypeKind::Pointer || info->kind == TypeKind::Reference) {
      element = type(info->base);
    } else if (info->kind == TypeKind::Record) {
      first = static_cast<uint32_t>(field_rows_.size());
      count = static_cast<uint32_t>(info->fields.size());
      field_rows_.resize(first + count);
      for (uint32_t i = 0; i < count; ++i) {
        const Field& field = info->fields[i];
        std::string made;
        row(made, {number(text(field.name)), number(type(field.type)), number(field.offset), number(flags(field))});
        field_rows_[first + i] = std::move(made);
      }
    }
    const TypeKind plain = types_.plainKind(id);
    const bool is_signed = TypeTable::isScalar(plain) && types_.isSigned(plain);
    std::string made;
    row(made, {kind, is_signed ? "1" : "0", number(text(types_.spell(id))), number(info->size), unsignedOrNone(element),
               number(info->length), number(first), number(count)});
    type_rows_[index] = std::move(made);
    return index;
  }

  static uint32_t flags(const Field& field) {
    uint32_t bits = 0;
    if (field.by_reference) bits |= 1;
    if (field.constant) bits |= 2;
    if (field.retain) bits |= 4;
    if (field.persistent) bits |= 8;
    if (field.role == FieldRole::Input) bits |= 16;
    if (field.role == FieldRole::Output) bits |= 32;
    return bits;
  }

  // ---- blocks and what is kept of them

  bool keeps(TypeId id) {
    id = types_.resolve(id);
    const TypeInfo& info = types_.info(id);
    if (info.kind == TypeKind::Array) return keeps(info.base);
    if (info.kind != TypeKind::Record) return false;
    const auto known = keeps_.find(id.index);
    if (known != keeps_.end()) return known->second;
    keeps_[id.index] = false;
    bool found = false;
    for (const Field& field : info.fields) {
      found = found || field.retain || field.persistent || (!field.by_reference && keeps(field.type));
    }
    return keeps_[id.index] = found;
  }

  struct Range {
    uint32_t block;
    uint64_t offset, size;
  };
  static void add(std::vector<Range>& ranges, uint32_t block, uint64_t offset, uint64_t size) {
    if (!ranges.empty() && ranges.back().block == block && ranges.back().offset + ranges.back().size == offset) {
      ranges.back().size += size;
    } else {
      ranges.push_back({block, offset, size});
    }
  }

  void collectKept(TypeId id, uint32_t block, uint64_t offset) {
    id = types_.resolve(id);
    if (!keeps(id)) return;
    const TypeInfo& info = types_.info(id);
    if (info.kind == TypeKind::Array) {
      const uint64_t size = types_.info(types_.resolve(info.base)).size;
      for (uint64_t at = 0; size > 0 && at < info.size; at += size) collectKept(info.base, block, offset + at);
      return;
    }
    for (const Field& field : info.fields) {
      if (field.by_reference) continue;
      const uint64_t size = types_.info(types_.resolve(field.type)).size;
      if (field.retain) add(retain_, block, offset + field.offset, size);
      if (field.persistent) add(persistent_, block, offset + field.offset, size);
      if (!field.retain && !field.persistent) collectKept(field.type, block, offset + field.offset);
    }
  }

  void addBlock(uint32_t index) {
    const Facts::Block& block = facts_.blocks[index];
    const TypeInfo& info = types_.info(types_.resolve(block.record));
    row(block_rows_, {number(text(block.name)), number(info.size), number(info.align)});
    type(block.record);
    collectKept(block.record, index, 0);
  }

  // ---- symbols

  void symbol(std::string_view name, TypeId type_id, const char* place, uint32_t bit, bool is_program, uint32_t block,
              uint64_t offset, uint32_t bits, std::string_view path) {
    std::string made;
    row(made, {number(text(name)), number(type(type_id)), place, number(bit), is_program ? "1" : "0", number(block),
               number(offset), number(bits), number(text(path))});
    symbol_rows_.push_back({std::string(name), std::move(made)});
  }

  std::string programPath(const ir::ProgramInstance& program) {
    std::string path;
    for (NameId part : {program.configuration, program.resource}) {
      if (!part) continue;
      path += module_.names.text(part);
      path += '.';
    }
    return path;
  }

  void addSymbols() {
    for (uint32_t i = 0; i < module_.programs.size(); ++i) {
      const ir::ProgramInstance& program = module_.programs[i];
      symbol(module_.names.text(program.name), program.record, "RUNG_IN_BLOCK", 255, true, facts_.program_block[i], 0,
             0, programPath(program));
    }
    for (uint32_t i = 0; i < module_.lists.size(); ++i) {
      const TypeInfo& record = types_.info(types_.resolve(module_.lists[i].record));
      const std::string path = std::string(module_.names.text(module_.lists[i].name)) + ".";
      for (const Field& field : record.fields) {
        symbol(module_.names.text(field.name), field.type, "RUNG_IN_BLOCK", 255, false, facts_.list_block[i],
               field.offset, flags(field), path);
      }
    }
    constexpr const char* kAreas[] = {"RUNG_IN_INPUTS", "RUNG_IN_OUTPUTS", "RUNG_IN_MEMORY"};
    for (const ir::Located& located : module_.located) {
      std::string name, path;
      if (located.owner_program != 0) {
        const ir::ProgramInstance& owner = module_.programs[located.owner_program - 1];
        name = module_.names.text(owner.name);
        name += '.';
        path = programPath(owner);
      }
      name += module_.names.text(located.name);
      symbol(name, located.type, kAreas[located.area], located.bit == ir::kNoBit ? 255 : located.bit, false, 0,
             located.byte, 0, path);
    }
    // The order of the input files shows nowhere: programs stay first within equal names.
    std::stable_sort(symbol_rows_.begin(), symbol_rows_.end(), [](const auto& a, const auto& b) {
      return std::lexicographical_compare(
          a.first.begin(), a.first.end(), b.first.begin(), b.first.end(), [](char x, char y) {
            auto fold = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
            return fold(x) < fold(y);
          });
    });
  }

  // ---- code: tasks, tests, initial values

  // Calls a body on a block of the module.
  std::string callOn(ir::BodyId id, TypeId record, uint32_t block) {
    declare(id);
    const std::string type = recordName(types_, record);
    std::string out = "  ";
    appendFunctionName(out, module_, module_.body(id));
    return out + "(*static_cast<" + type + "*>(ctx->blocks[" + number(block) + "]), ctx);\n";
  }
  std::string callOf(ir::BodyId function) {
    declare(function);
    std::string out = "  ";
    appendFunctionName(out, module_, module_.body(function));
    return out + "(ctx);\n";
  }
  std::string runOf(const ir::ProgramInstance& program, uint32_t block) {
    return program.run ? callOf(program.run) : callOn(program.body, program.record, block);
  }
  // The memory is cleared anyway.
  bool hasCode(ir::BodyId init) const { return init && facts_.is_zeroing[init.index] == 0; }
  void declare(ir::BodyId id) {
    if (std::find(declared_.begin(), declared_.end(), id.index) != declared_.end()) return;
    declared_.push_back(id.index);
    BodyWriter::appendSignature(prototypes_, module_, module_.body(id));
    prototypes_ += ";\n";
  }

  void addTasks() {
    constexpr const char* kKinds[] = {"RUNG_CYCLIC", "RUNG_FREEWHEELING", "RUNG_EVENT", "RUNG_STATUS", "RUNG_EXTERNAL"};
    for (uint32_t i = 0; i < module_.tasks.size(); ++i) {
      const ir::Task& task = module_.tasks[i];
      const std::string function = "task" + number(i);
      code_ += "static void " + function + "(rung_context* ctx) {\n  (void)ctx;\n";
      for (uint32_t p = 0; p < module_.programs.size(); ++p) {
        const ir::ProgramInstance& program = module_.programs[p];
        if (program.task == i + 1 && program.body) {
          code_ += runOf(program, facts_.program_block[p]);
        }
      }
      code_ += "}\n";
      row(task_rows_, {number(text(task.name)), kKinds[static_cast<size_t>(task.kind)], number(task.priority),
                       signedNumber(task.interval_ns), signedNumber(task.watchdog_ns), number(task.sensitivity),
                       number(text(task.trigger)), number(text(task.external_event)), function});
    }
  }

  void addTests() {
    if (!options_.with_tests) return;
    for (ir::BodyId id : module_.tests) {
      const ir::Body& body = module_.body(id);
      const std::string name = "test" + number(test_count_++);
      std::string init = "nullptr", done_block = "RUNG_NONE", done_offset = "0";
      std::string run = "static void " + name + "(rung_context* ctx) {\n";
      if (body.kind == ir::BodyKind::Function) {
        declare(id);
        run += functionCall(body);
      } else {
        for (uint32_t p = 0; p < module_.programs.size(); ++p) {
          const ir::ProgramInstance& program = module_.programs[p];
          if (!(program.body == id)) continue;
          const uint32_t block = facts_.program_block[p];
          const TypeInfo& record = types_.info(types_.resolve(program.record));
          run += runOf(program, block);
          init = name + "_init";
          code_ += "static void " + init + "(rung_context* ctx) {\n  memset(ctx->blocks[" + number(block) + "], 0, " +
                   number(record.size) + ");\n";
          if (hasCode(program.init)) code_ += callOn(program.init, program.record, block);
          if (program.setup) code_ += callOf(program.setup);
          code_ += "}\n";
          for (const Field& field : record.fields) {
            if (!sameIdentifier(module_.names.text(field.name), "done") ||
                types_.plainKind(field.type) != TypeKind::Bool)
              continue;
            done_block = number(block);
            done_offset = number(field.offset);
          }
          break;
        }
      }
      code_ += run + "}\n";
      std::string_view path;
      uint32_t line;
      if (body.origin.path) {
        path = module_.names.text(body.origin.path);
        line = body.origin.line;
      } else {
        const Place place = module_.sources.place(body.loc);
        path = module_.sources.path(body.file ? body.file : place.file);
        line = place.line;
      }
      row(test_rows_, {number(text(body.spelling ? body.spelling : body.name)), number(text(path)), number(line),
                       done_block, done_offset, init, name});
    }
  }

  // A test that is a function: its parameters are zero, its results dropped.
  std::string functionCall(const ir::Body& body) {
    std::string variables, call = "  ";
    appendFunctionName(call, module_, body);
    call += "(ctx";
    uint32_t count = 0;
    for (const ir::Local& local : body.locals) {
      const bool is_result = local.kind == ir::LocalKind::Result;
      const bool is_pin = local.kind == ir::LocalKind::Input || local.kind == ir::LocalKind::Output ||
                          local.kind == ir::LocalKind::InOut;
      if (!is_pin && !(is_result && local.by_reference)) continue;
      const std::string name = "p" + number(++count);
      if (types_.kind(elementOf(types_, local.type)) == TypeKind::Record) return "";  // sema wants tests without pins
      variables += "  ";
      appendDeclaration(variables, types_, local.type, name);
      variables += " = {};\n";
      call += ", ";
      if (local.by_reference && !TypeTable::isText(types_.kind(local.type))) call += '&';
      call += name;
    }
    return variables + call + ");\n";
  }

  uint64_t layoutHash() const {
    uint64_t hash = kHashStart;
    auto add = [&](const std::string& table) { hash = hashBytes(hash, table.data(), table.size()); };
    add(block_rows_);
    for (const std::string& made : type_rows_) add(made);
    for (const std::string& made : field_rows_) add(made);
    add(dimension_rows_);
    return hash;
  }

  static void table(std::string& out, const char* type, const char* name, const std::string& rows) {
    if (rows.empty()) return;
    out += "static const ";
    out += type;
    out += ' ';
    out += name;
    out += "[] = {\n" + rows + "};\n";
  }
  // The two cells of a table in the description.
  static std::string cells(const char* name, const std::string& rows, uint64_t count) {
    return std::string(rows.empty() ? "nullptr" : name) + ", " + number(rows.empty() ? 0 : count);
  }

  std::string moduleText() {
    std::string type_rows, field_rows, symbol_rows, retain_rows, persistent_rows;
    for (const std::string& made : type_rows_) type_rows += made;
    for (const std::string& made : field_rows_) field_rows += made;
    for (const auto& made : symbol_rows_) symbol_rows += made.second;
    for (const Range& range : retain_)
      row(retain_rows, {number(range.block), number(range.offset), number(range.size)});
    for (const Range& range : persistent_) {
      row(persistent_rows, {number(range.block), number(range.offset), number(range.size)});
    }
    std::string init = "static void init(rung_context* ctx) {\n  (void)ctx;\n";
    for (uint32_t i = 0; i < facts_.blocks.size(); ++i) {
      init += "  memset(ctx->blocks[" + number(i) + "], 0, " +
              number(types_.info(types_.resolve(facts_.blocks[i].record)).size) + ");\n";
    }
    for (uint32_t i = 0; i < module_.lists.size(); ++i) {
      if (hasCode(module_.lists[i].init))
        init += callOn(module_.lists[i].init, module_.lists[i].record, facts_.list_block[i]);
    }
    std::vector<uint32_t> order(module_.programs.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return facts_.program_block[a] < facts_.program_block[b]; });
    for (uint32_t i : order) {
      const ir::ProgramInstance& program = module_.programs[i];
      if (hasCode(program.init)) init += callOn(program.init, program.record, facts_.program_block[i]);
    }
    for (uint32_t i : order) {
      if (module_.programs[i].setup) init += callOf(module_.programs[i].setup);
    }
    init += "}\n";

    std::string out = "// The description of the module: see rung/module.h.\n#include <string.h>\n\n";
    out += "#include \"rung/module.h\"\n\nnamespace " + name_space_ + " {\n\n";
    out += "extern const rung_site sites[];\nextern const uint32_t site_count;\n" + prototypes_ + "\n";
    out += "static const char text[] =\n";
    for (size_t at = 0; at < bytes_.size();) {  // a line per name
      size_t end = bytes_.find('\0', at);
      out += "  ";
      appendQuoted(out, std::string_view(bytes_).substr(at, end - at));
      out += " \"\\0\"\n";
      at = end + 1;
    }
    out += "  ;\n";
    table(out, "rung_block", "blocks", block_rows_);
    table(out, "rung_type", "types", type_rows);
    table(out, "rung_field", "fields", field_rows);
    table(out, "rung_enum_item", "enum_items", item_rows_);
    table(out, "rung_dimension", "dimensions", dimension_rows_);
    table(out, "rung_symbol", "symbols", symbol_rows);
    table(out, "rung_range", "retain", retain_rows);
    table(out, "rung_range", "persistent", persistent_rows);
    out += '\n' + code_;
    table(out, "rung_task", "tasks", task_rows_);
    table(out, "rung_test", "tests", test_rows_);
    out += init;
    out += "\nstatic const rung_module description = {\n  RUNG_MODULE_ABI, " + number(types_.pointerSize()) + ", ";
    appendQuoted(out, options_.module_name);
    out += ", \"rung " RUNG_VERSION "\", text, " + number(layoutHash()) + "ULL,\n  ";
    out += cells("blocks", block_rows_, facts_.blocks.size()) + ",\n  {" + number(module_.image_bytes[0]) + ", " +
           number(module_.image_bytes[1]) + ", " + number(module_.image_bytes[2]) + "},\n  ";
    out += cells("tasks", task_rows_, module_.tasks.size()) + ", ";
    out += cells("symbols", symbol_rows, symbol_rows_.size()) + ", ";
    out += cells("types", type_rows, type_rows_.size()) + ", ";
    out += cells("fields", field_rows, field_rows_.size()) + ", ";
    out += cells("enum_items", item_rows_, item_count_) + ", ";
    out += cells("dimensions", dimension_rows_, dimension_count_) + ",\n  ";
    out += cells("retain", retain_rows, retain_.size()) + ", ";
    out += cells("persistent", persistent_rows, persistent_.size()) + ", ";
    out += "sites, site_count, ";
    out += cells("tests", test_rows_, test_count_) + ", init\n};\n";
    out += "\n}  // namespace " + name_space_ + "\n\nextern \"C\" const rung_module* " + options_.module_name +
           "_module(void);\nextern \"C\" const rung_module* " + options_.module_name + "_module(void) { return &" +
           name_space_ + "::description; }\n";
    return out;
  }

  std::string sitesText(const std::vector<Group>& groups) {
    std::string numbers, rows;
    uint32_t count = 0;
    for (const Group& group : groups) {
      if (group.sites.empty()) continue;
      numbers += "extern const uint32_t sites_" + group.stem + " = " + number(count) + ";\n";
      for (const Site& site : group.sites) {
        row(rows,
            {number(text(site.pou)),
             number(text(site.origin_path ? module_.names.text(site.origin_path) : module_.sources.path(site.file))),
             number(site.line), number(site.column), signedNumber(site.low), signedNumber(site.high)});
        ++count;
      }
    }
    if (rows.empty()) row(rows, {"0", "0", "0", "0", "0", "0"});
    return "// Where the checks stand: see rung_site in rung/module.h.\n#include \"rung/module.h\"\n\nnamespace " +
           name_space_ + " {\n\n" + numbers + "extern const uint32_t site_count = " + number(count) +
           ";\nextern const rung_site sites[] = {\n" + rows + "};\n\n}  // namespace " + name_space_ + "\n";
  }

  const ir::Module& module_;
  const TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  const std::string name_space_;

  std::unordered_map<std::string, uint32_t> pool_;
  std::string bytes_;
  std::unordered_map<uint32_t, uint32_t> type_number_;
  std::unordered_map<uint32_t, bool> keeps_;
  std::vector<std::string> type_rows_, field_rows_;
  std::vector<std::pair<std::string, std::string>> symbol_rows_;  // name, row
  std::string block_rows_, item_rows_, dimension_rows_, task_rows_, test_rows_, code_, prototypes_;
  std::vector<Range> retain_, persistent_;
  std::vector<uint32_t> declared_;
  uint32_t item_count_ = 0, dimension_count_ = 0, test_count_ = 0;
};

}  // namespace

Description describe(const ir::Module& module, const EmitOptions& options, const Facts& facts,
                     const std::vector<Group>& groups, std::string_view name_space) {
  return Describer(module, options, facts, name_space).run(groups);
}

}  // namespace rung::codegen
