// SPDX-License-Identifier: Apache-2.0
// The description of the module as C++: see module.h. Its content comes from ir/description.h.
#include "codegen/module.h"

#include <algorithm>
#include <array>

#include "codegen/module_functions.h"
#include "codegen/names.h"
#include "codegen/symbols.h"
#include "codegen/types.h"
#include "ir/description.h"

namespace rung::codegen {

using types::TypeKind;
using types::TypeTable;

namespace {

constexpr const char* kTypeKinds[] = {
    "RUNG_BOOL",    "RUNG_BYTE", "RUNG_WORD",  "RUNG_DWORD",  "RUNG_LWORD",  "RUNG_SINT",   "RUNG_INT",
    "RUNG_DINT",    "RUNG_LINT", "RUNG_USINT", "RUNG_UINT",   "RUNG_UDINT",  "RUNG_ULINT",  "RUNG_REAL",
    "RUNG_LREAL",   "RUNG_TIME", "RUNG_LTIME", "RUNG_DATE",   "RUNG_LDATE",  "RUNG_TOD",    "RUNG_LTOD",
    "RUNG_DT",      "RUNG_LDT",  "RUNG_CHAR",  "RUNG_WCHAR",  "RUNG_UCHAR",  "RUNG_STRING", "RUNG_WSTRING",
    "RUNG_USTRING", "RUNG_ENUM", "RUNG_ARRAY", "RUNG_RECORD", "RUNG_POINTER"};
static_assert(std::size(kTypeKinds) == RUNG_POINTER + 1);
constexpr const char* kStorages[] = {"RUNG_IN_BLOCK", "RUNG_IN_AREA"};
constexpr const char* kOwners[] = {"RUNG_AREA_INPUT", "RUNG_AREA_OUTPUT", "RUNG_AREA_MEMORY", "RUNG_AREA_SHARED"};
constexpr const char* kTaskKinds[] = {"RUNG_CYCLIC", "RUNG_FREEWHEELING", "RUNG_EVENT", "RUNG_STATUS", "RUNG_EXTERNAL"};

constexpr const char* kExtern = "extern const ";  // for sites.cpp, where the description is
constexpr struct {
  uint32_t flag;
  const char* name;
} kFieldFlags[] = {{RUNG_FIELD_BY_REFERENCE, "RUNG_FIELD_BY_REFERENCE"},
                   {RUNG_FIELD_CONSTANT, "RUNG_FIELD_CONSTANT"},
                   {RUNG_FIELD_RETAIN, "RUNG_FIELD_RETAIN"},
                   {RUNG_FIELD_PERSISTENT, "RUNG_FIELD_PERSISTENT"},
                   {RUNG_FIELD_INPUT, "RUNG_FIELD_INPUT"},
                   {RUNG_FIELD_OUTPUT, "RUNG_FIELD_OUTPUT"},
                   {RUNG_FIELD_BASE, "RUNG_FIELD_BASE"},
                   {RUNG_FIELD_READ_ONLY, "RUNG_FIELD_READ_ONLY"},
                   {RUNG_FIELD_NO_EXTERNAL_READ, "RUNG_FIELD_NO_EXTERNAL_READ"},
                   {RUNG_FIELD_NO_EXTERNAL_WRITE, "RUNG_FIELD_NO_EXTERNAL_WRITE"},
                   {RUNG_FIELD_NO_COPY, "RUNG_FIELD_NO_COPY"},
                   {RUNG_FIELD_OPEN_ARRAY, "RUNG_FIELD_OPEN_ARRAY"}};

std::string number(uint64_t value) { return std::to_string(value); }
std::string unsignedOrNone(uint32_t value) { return value == RUNG_NONE ? "RUNG_NONE" : number(value); }
std::string signedNumber(int64_t value) { return value == INT64_MIN ? "INT64_MIN" : std::to_string(value); }

// `RUNG_FIELD_INPUT | 3 << RUNG_FIELD_BIT_SHIFT`
std::string fieldFlags(uint32_t flags) {
  std::string out;
  uint32_t left = flags & ~uint32_t{RUNG_FIELD_BIT};
  const auto add = [&out](const std::string& word) { out += (out.empty() ? "" : " | ") + word; };
  for (const auto& known : kFieldFlags) {
    if ((flags & known.flag) != 0) add(known.name);
    left &= ~known.flag;
  }
  RUNG_INVARIANT(left == 0, "a flag of a field has no name here");
  if ((flags & RUNG_FIELD_BIT) != 0)
    add(number((flags & RUNG_FIELD_BIT) >> RUNG_FIELD_BIT_SHIFT) + " << RUNG_FIELD_BIT_SHIFT");
  return out.empty() ? "0" : out;
}

// A table of the description: a comment that names its columns, and a row per line that ends with what it is about.
class Table {
 public:
  Table(const char* type, const char* name, const char* columns) : type_(type), name_(name), columns_(columns) {}

  void row(std::initializer_list<std::string_view> cells, std::string_view about = {}) {
    ++count_;
    const bool is_number = cells.size() == 1;
    rows_ += is_number ? "  " : "  {";
    bool is_first = true;
    for (const std::string_view cell : cells) {
      if (!is_first) rows_ += ", ";
      is_first = false;
      rows_ += cell;
    }
    rows_ += is_number ? "," : "},";
    if (!about.empty()) comment(about);
    rows_ += '\n';
  }
  // A number of a table of numbers, many in a line.
  void cell(uint64_t is) {
    constexpr uint64_t kInALine = 16;
    rows_ += (count_ % kInALine == 0 ? "  " : " ") + number(is) + ',';
    if (++count_ % kInALine == 0) rows_ += '\n';
  }
  bool empty() const { return count_ == 0; }
  uint64_t count() const { return count_; }

  std::string declaration() const { return std::string(type_) + ' ' + name_ + "[]"; }
  void define(std::string& out, const char* storage) const {
    if (!empty())
      out += std::string("\n// ") + columns_ + '\n' + storage + declaration() + " = {\n" + rows_ +
             (rows_.back() == '\n' ? "" : "\n") + "};\n";
  }
  // The table in the description.
  std::string cell() const {
    return std::string("{") + (empty() ? "nullptr" : name_) + ", " + number(count_) + ", sizeof(" + type_ + ")}";
  }

 private:
  // Names of files and foreign names may have any character: what could end or continue the line is left out.
  void comment(std::string_view about) {
    rows_ += "  // ";
    for (const char c : about) rows_ += c < ' ' || c > '~' || c == '\\' || c == '?' ? '_' : c;
  }

  const char *type_, *name_, *columns_;
  std::string rows_;
  uint64_t count_ = 0;
};

class Describer {
 public:
  Describer(const ir::Module& module, const EmitOptions& options, const Facts& facts, std::string_view name_space)
      : module_(module),
        types_(module.types),
        options_(options),
        facts_(facts),
        name_space_(name_space),
        is_(module, facts, options.with_tests) {}

  Description run(const std::vector<Group>& groups) {
    addInitialisers();
    addLives();
    addTasks();
    addTests();
    addSites(groups);  // may add strings
    Description out;
    out.module = moduleSource();
    out.sites = sitesSource();
    out.symbols = symbolFile(is_, options_.module_name, types_.pointerSize());
    return out;
  }

 private:
  std::string_view text(uint32_t offset) const { return is_.strings.bytes().c_str() + offset; }
  std::string typeName(uint32_t number) const { return std::string(text(is_.types[number].name)); }

  // ---- what has a function: initial values, tasks, tests

  void addInitialisers() {
    for (const ir::Description::Initialiser& is : is_.initialisers) {
      if (!functions_.hasCode(is.body)) continue;
      const std::string function = "init" + number(is.type);
      functions_.addInitialiser(function, is.body);
      initialisers_.row({number(is.type), function}, typeName(is.type));
    }
  }

  void addLives() {
    for (const ir::Description::Life& is : is_.lives) {
      const std::string block = "block" + number(is.block);
      const std::string init = functions_.addBlockInit(block + "_init", is),
                        refresh = functions_.addBlockFunction(block + "_refresh", is, is.refresh),
                        reinit = functions_.addBlockFunction(block + "_reinit", is, is.reinit),
                        exit = functions_.addBlockFunction(block + "_exit", is, is.exit);
      lives_.row({number(is.block), number(is.type), init, refresh, reinit, exit}, text(is_.blocks[is.block].name));
    }
    for (const uint32_t type : is_.classes) classes_.row({number(type)}, typeName(type));
  }

  void addTasks() {
    for (uint32_t i = 0; i < is_.tasks.size(); ++i) {
      const rung_task& task = is_.tasks[i];
      const std::string function = "task" + number(i);
      functions_.addTask(function, i);
      tasks_.row({number(task.name), kTaskKinds[task.kind], number(task.priority), signedNumber(task.interval_ns),
                  signedNumber(task.watchdog_ns), number(task.sensitivity), number(task.trigger),
                  number(task.external_event), number(task.resource), number(task.first_write),
                  number(task.write_count), signedNumber(task.duration_ns), function},
                 text(task.name));
    }
  }

  void addTests() {
    uint32_t count = 0;
    for (const ir::Description::Test& test : is_.tests) {
      const ModuleFunctions::TestNames names = functions_.addTest("test" + number(count++), test);
      tests_.row({number(test.row.name), number(test.row.file), number(test.row.line),
                  unsignedOrNone(test.row.done_block), number(test.row.done_offset), names.init, names.run, names.exit},
                 text(test.row.name));
    }
  }

  // ---- tables

  void addTables() {
    for (const rung_block& is : is_.blocks) {
      blocks_.row({number(is.name), number(is.size), number(is.align)}, text(is.name));
    }
    for (const rung_area& is : is_.areas) {
      areas_.row({number(is.name), number(is.prefix), number(is.size), kOwners[is.owner]}, text(is.prefix));
    }
    for (uint32_t i = 0; i < is_.types.size(); ++i) {
      const rung_type& is = is_.types[i];
      types_rows_.row(
          {kTypeKinds[is.kind], is.is_signed != 0 ? "1" : "0", is.library != 0 ? "1" : "0", number(is.name),
           number(is.size), unsignedOrNone(is.element), number(is.length), number(is.first), number(is.count)},
          number(i) + " " + typeName(i));
    }
    for (const rung_field& is : is_.fields) {
      fields_.row({number(is.name), number(is.type), number(is.offset), fieldFlags(is.flags)},
                  std::string(text(is.name)) + " : " + typeName(is.type));
    }
    for (const rung_enum_item& is : is_.enum_items) {
      enum_items_.row({number(is.name), signedNumber(is.value)}, text(is.name));
    }
    for (const rung_dimension& is : is_.dimensions) dimensions_.row({signedNumber(is.low), signedNumber(is.high)});
    for (const rung_symbol& is : is_.symbols) {
      symbols_.row({number(is.name), number(is.type), kStorages[is.storage], number(is.bit), number(is.is_program),
                    number(is.index), number(is.offset), fieldFlags(is.flags), number(is.path)},
                   std::string(text(is.name)) + " : " + typeName(is.type));
    }
    addKept(retain_, is_.retain);
    addKept(persistent_, is_.persistent);
    for (const uint32_t is : is_.names) names_.cell(is);
    for (const uint32_t is : is_.resources) resources_.row({number(is)}, text(is));
    for (const rung_write& is : is_.writes) {
      writes_.row({number(is.area), number(is.mask), number(is.offset), number(is.size)},
                  text(is_.areas[is.area].prefix));
    }
    for (const rung_io_module& is : is_.io_modules) {
      io_modules_.row({number(is.name), number(is.type), number(is.station), unsignedOrNone(is.task),
                       number(is.input_offset), number(is.output_offset)},
                      text(is.name));
    }
  }
  void addKept(Table& table, const std::vector<rung_range>& ranges) {
    for (const rung_range& is : ranges) {
      const uint32_t index = is.block & ~(RUNG_RANGE_AREA | RUNG_RANGE_BIT);
      std::string block = number(index);
      if ((is.block & RUNG_RANGE_AREA) != 0) block += " | RUNG_RANGE_AREA";
      if ((is.block & RUNG_RANGE_BIT) != 0) block += " | RUNG_RANGE_BIT";
      table.row({block, number(is.offset), number(is.size)},
                text((is.block & RUNG_RANGE_AREA) != 0 ? is_.areas[index].prefix : is_.blocks[index].name));
    }
  }

  // One line per name.
  std::string textSource() const {
    std::string out = "// The names to which the tables refer by their offset.\nextern const char text[] =\n";
    const std::string& bytes = is_.strings.bytes();
    for (size_t at = 0; at < bytes.size();) {
      const size_t end = bytes.find('\0', at);
      out += "  ";
      appendQuoted(out, std::string_view(bytes).substr(at, end - at));
      out.insert(out.size() - 1, "\\0");
      out += '\n';
      at = end + 1;
    }
    return out + "  ;\n";
  }

  std::string moduleSource() {
    addTables();
    functions_.addEntries();
    std::string out =
        "// The tables of the module, its tasks and its initial values. The columns are those of rung/module.h; a row\n"
        "// ends with what it is about.\n#include <string.h>\n\n" +
        includes() + '\n' + openNamespace(name_space_) + '\n' + functions_.declarations() + '\n' + textSource();
    for (const Table* table : {&blocks_, &areas_, &types_rows_, &fields_, &enum_items_, &dimensions_, &symbols_,
                               &names_, &retain_, &persistent_, &resources_, &writes_, &io_modules_})
      table->define(out, kExtern);
    out += functions_.functions();
    for (const Table* table : {&initialisers_, &lives_, &classes_, &tasks_, &tests_}) table->define(out, kExtern);
    return out + functions_.entries() + "\n}  // namespace " + name_space_ + '\n';
  }

  void addSites(const std::vector<Group>& groups) {
    for (const Group& group : groups) {
      if (group.sites.empty()) continue;
      site_numbers_ += "extern const uint32_t sites_" + group.stem + " = " + number(sites_.count()) + ";\n";
      for (const Site& site : group.sites) {
        sites_.row({number(is_.strings.add(module_.names.string(site.pou))),
                    number(is_.strings.add(site.origin_path ? module_.names.string(site.origin_path)
                                                            : module_.sources.path(site.file))),
                    number(site.line), number(site.column), signedNumber(site.low), signedNumber(site.high)});
      }
    }
  }

  // The description is here because it counts the sites: a count of another file would be an initial value that is
  // computed at run time, in a static constructor.
  std::string sitesSource() const {
    std::string out =
        "// Where the checks and calls are, and the description of the module: see rung/module.h.\n#include "
        "\"rung/call_paths.h\"\n" +
        includes() + '\n' + openNamespace(name_space_) + '\n' + site_numbers_;
    sites_.define(out, "static const ");
    out += "\nextern const char text[];\n";
    for (const Table* table : tables())
      if (table != &sites_ && !table->empty()) out += kExtern + table->declaration() + ";\n";
    out += extensionsSource();
    out += "void init(rung_context* ctx);\n";
    if (module_.exit) out += "void exit(rung_context* ctx);\n";
    if (module_.safe) out += "void safe(rung_context* ctx);\n";
    return out + '\n' + descriptionSource() + "\n}  // namespace " + name_space_ +
           "\n\nextern \"C\" RUNG_EXPORT const rung_module* " + options_.module_name +
           "_module(void);\nextern \"C\" const rung_module* " + options_.module_name + "_module(void) { return &" +
           name_space_ + "::description; }\n";
  }

  // The tables in the order of rung_module.
  std::array<const Table*, 16> tables() const {
    return {&blocks_, &areas_,      &resources_,  &tasks_,  &writes_,     &io_modules_, &symbols_,      &types_rows_,
            &fields_, &enum_items_, &dimensions_, &retain_, &persistent_, &sites_,      &initialisers_, &tests_};
  }

  std::string includes() const {
    return std::string(lives_.empty() ? "" : "#include \"rung/change.h\"\n") + "#include \"rung/module.h\"\n";
  }

  // The extension that finds names, and that for online changes.
  std::string extensionsSource() const {
    std::string out, rows;
    if (!names_.empty()) {
      out += kExtern + names_.declaration() + ";\nstatic const rung_names name_table = {" + names_.cell() + "};\n";
      rows += "{RUNG_NAMES, &name_table, sizeof name_table}";
    }
    if (!lives_.empty()) {
      out += kExtern + lives_.declaration() + ";\n";
      if (!classes_.empty()) out += kExtern + classes_.declaration() + ";\n";
      out += "static const rung_change_tables change_tables = {" + lives_.cell() + ", " + classes_.cell() + "};\n";
      rows += std::string(rows.empty() ? "" : ", ") + "{RUNG_CHANGE, &change_tables, sizeof change_tables}";
    }
    return rows.empty() ? out : out + "static const rung_extension extensions[] = {" + rows + "};\n";
  }

  std::string descriptionSource() const {
    std::string out = "static const rung_module description = {\n  RUNG_MODULE_ABI, RUNG_MODULE_LAYOUT, " +
                      number(types_.pointerSize()) + ", " + (module_.aligned_globals ? "RUNG_ALIGNED_GLOBALS" : "0") +
                      ", ";
    appendQuoted(out, options_.module_name);
    out += ", \"rung " RUNG_VERSION "\", text, " + number(is_.layout_hash) + "ULL,\n";
    for (const Table* table : tables()) out += "  " + table->cell() + ",\n";
    const int count = (names_.empty() ? 0 : 1) + (lives_.empty() ? 0 : 1);
    const std::string extensions = count == 0 ? "{nullptr, 0" : "{extensions, " + std::to_string(count);
    return out + "  " + extensions + ", sizeof(rung_extension)},\n  init, " + (module_.exit ? "exit" : "nullptr") +
           ", " + (module_.safe ? "safe" : "nullptr") + ", nullptr, RUNG_CALL_PATH_FUNCTIONS\n};\n";
  }

  const ir::Module& module_;
  const TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  const std::string name_space_;
  ir::Description is_;
  ModuleFunctions functions_{module_, facts_, is_};
  std::string site_numbers_;
  Table blocks_{"rung_block", "blocks", "name, size, align"};
  Table lives_{"rung_block_life", "lives", "block, type, init, refresh, reinit, exit"};
  Table classes_{"uint32_t", "classes", "type"};
  Table areas_{"rung_area", "areas", "name, prefix, size, owner"};
  Table types_rows_{"::rung_type", "types", "kind, is_signed, library, name, size, element, length, first, count"};
  Table fields_{"rung_field", "fields", "name, type, offset, flags"};
  Table enum_items_{"rung_enum_item", "enum_items", "name, value"};
  Table dimensions_{"rung_dimension", "dimensions", "low, high"};
  Table symbols_{"rung_symbol", "symbols", "name, type, storage, bit, is_program, index, offset, flags, path"};
  Table names_{is_.names.size() <= UINT16_MAX ? "uint16_t" : "uint32_t", "names",
               "1 + the number of a symbol or field"};
  Table retain_{"rung_range", "retain", "block, offset, size"};
  Table persistent_{"rung_range", "persistent", "block, offset, size"};
  Table initialisers_{"rung_initialiser", "initialisers", "type, init"};
  Table resources_{"uint32_t", "resources", "name"};
  Table writes_{"rung_write", "writes", "area, mask, offset, size"};
  Table io_modules_{"rung_io_module", "io_modules", "name, type, station, task, input_offset, output_offset"};
  Table tasks_{"rung_task", "tasks",
               "name, kind, priority, interval_ns, watchdog_ns, sensitivity, trigger, external_event, resource, "
               "first_write, write_count, duration_ns, run"};
  Table tests_{"rung_test", "tests", "name, file, line, done_block, done_offset, init, run, exit"};
  Table sites_{"rung_site", "sites", "pou, file, line, column, low, high"};
};

}  // namespace

Description describe(const ir::Module& module, const EmitOptions& options, const Facts& facts,
                     const std::vector<Group>& groups, std::string_view name_space) {
  return Describer(module, options, facts, name_space).run(groups);
}

}  // namespace rung::codegen
