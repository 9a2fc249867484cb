// SPDX-License-Identifier: Apache-2.0
// The description of the module as C++: see module.h. Its content comes from ir/description.h.
#include "codegen/module.h"

#include <algorithm>

#include "codegen/names.h"
#include "codegen/signature.h"
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
  static std::string unsignedOrNone(uint32_t value) { return value == RUNG_NONE ? "RUNG_NONE" : std::to_string(value); }
  static std::string signedNumber(int64_t value) {
    return value == INT64_MIN ? std::string("INT64_MIN") : std::to_string(value) + "LL";
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
    appendSignature(prototypes_, module_, module_.body(id));
    prototypes_ += ";\n";
  }

  void addTasks() {
    for (uint32_t i = 0; i < is_.tasks.size(); ++i) {
      const rung_task& task = is_.tasks[i];
      const std::string function = "task" + number(i);
      code_ += "static void " + function + "(rung_context* ctx) {\n  (void)ctx;\n";
      if (module_.tasks[i].before) code_ += callOf(module_.tasks[i].before);
      for (uint32_t p = 0; p < module_.programs.size(); ++p) {
        const ir::ProgramInstance& program = module_.programs[p];
        if (program.task == i + 1 && program.body) code_ += runOf(program, facts_.program_block[p]);
      }
      for (const ir::BlockTask& block : module_.block_tasks)
        if (block.task == i + 1) code_ += callOf(block.run);
      if (module_.tasks[i].after) code_ += callOf(module_.tasks[i].after);
      code_ += "}\n";
      row(task_rows_, {number(task.name), kTaskKinds[task.kind], number(task.priority), signedNumber(task.interval_ns),
                       signedNumber(task.watchdog_ns), number(task.sensitivity), number(task.trigger),
                       number(task.external_event), number(task.resource), number(task.first_write),
                       number(task.write_count), signedNumber(task.duration_ns), function});
    }
  }

  void addTests() {
    uint32_t count = 0;
    for (const ir::Description::Test& test : is_.tests) {
      const ir::Body& body = module_.body(test.body);
      const std::string name = "test" + number(count++);
      std::string init = "nullptr", exit = "nullptr", first, last;
      std::string run = "static void " + name + "(rung_context* ctx) {\n";
      if (test.before) run += callOf(test.before);
      if (body.kind == ir::BodyKind::Function) {
        declare(test.body);
        run += functionCall(body);
      } else if (test.program != RUNG_NONE) {
        const ir::ProgramInstance& program = module_.programs[test.program];
        const uint32_t block = facts_.program_block[test.program];
        run += runOf(program, block);
        first = "  memset(ctx->blocks[" + number(block) + "], 0, " + number(is_.blocks[block].size) + ");\n";
        if (hasCode(program.init)) first += callOn(program.init, program.record, block);
        if (program.setup) first += callOf(program.setup);
        if (program.after_init) first += callOf(program.after_init);
        if (program.exit) last = callOf(program.exit);
      }
      for (const ir::BodyId setup : test.setups) first += callOf(setup);
      std::string teardowns;
      for (const ir::BodyId teardown : test.teardowns) teardowns += callOf(teardown);
      last.insert(0, teardowns);
      if (!first.empty()) {
        init = name + "_init";
        code_ += "static void " + init + "(rung_context* ctx) {\n" + first + "}\n";
      }
      if (!last.empty()) {
        exit = name + "_exit";
        code_ += "static void " + exit + "(rung_context* ctx) {\n" + last + "}\n";
      }
      if (test.after) run += callOf(test.after);
      code_ += run + "}\n";
      row(test_rows_, {number(test.row.name), number(test.row.file), number(test.row.line),
                       unsignedOrNone(test.row.done_block), number(test.row.done_offset), init, name, exit});
    }
  }

  // A test that is a function: its parameters are zero, its results are dropped.
  std::string functionCall(const ir::Body& body) {
    std::string variables, call = "  ";
    appendFunctionName(call, module_, body);
    call += "(ctx";
    uint32_t count = 0;
    for (const ir::Local& local : body.locals) {
      const bool is_result = local.kind == ir::LocalKind::Result;
      const bool is_pin = isParameter(local);
      if (!is_pin && !(is_result && local.by_reference)) continue;
      const std::string name = "p" + number(++count);
      if (types_.kind(elementOf(types_, local.type)) == TypeKind::Record) return "";  // sema rejects tests with pins
      variables += "  ";
      appendDeclaration(variables, types_, local.type, name);
      variables += " = {};\n";
      call += ", ";
      if (local.by_reference && !TypeTable::isString(types_.kind(local.type))) call += '&';
      call += name;
    }
    return variables + call + ");\n";
  }

  // Defines a table for the description, which is in the other file.
  void table(std::string& out, const char* type, const char* name, const std::string& rows) {
    if (rows.empty()) return;
    const std::string declaration = std::string("extern const ") + type + ' ' + name + "[]";
    declarations_ += declaration + ";\n";
    out += declaration + " = {\n" + rows + "};\n";
  }
  // The two cells of a table in the description.
  static std::string cells(const char* name, const std::string& rows, uint64_t count) {
    return std::string(rows.empty() ? "nullptr" : name) + ", " + number(rows.empty() ? 0 : count);
  }

  std::string moduleSource() {
    std::string block_rows, type_rows, field_rows, item_rows, dimension_rows, area_rows, symbol_rows, retain_rows,
        persistent_rows, resource_rows, write_rows, io_module_rows;
    for (const rung_block& is : is_.blocks) row(block_rows, {number(is.name), number(is.size), number(is.align)});
    for (const rung_type& is : is_.types) {
      row(type_rows,
          {kTypeKinds[is.kind], is.is_signed != 0 ? "1" : "0", is.library != 0 ? "1" : "0", number(is.name),
           number(is.size), unsignedOrNone(is.element), number(is.length), number(is.first), number(is.count)});
    }
    for (const rung_field& is : is_.fields) {
      row(field_rows, {number(is.name), number(is.type), number(is.offset), number(is.flags)});
    }
    for (const rung_enum_item& is : is_.enum_items) row(item_rows, {number(is.name), signedNumber(is.value)});
    for (const rung_dimension& is : is_.dimensions) row(dimension_rows, {signedNumber(is.low), signedNumber(is.high)});
    for (const rung_area& is : is_.areas)
      row(area_rows, {number(is.name), number(is.prefix), number(is.size), kOwners[is.owner]});
    for (const rung_symbol& is : is_.symbols) {
      row(symbol_rows, {number(is.name), number(is.type), kStorages[is.storage], number(is.bit), number(is.is_program),
                        number(is.index), number(is.offset), number(is.flags), number(is.path)});
    }
    for (const rung_range& is : is_.retain) row(retain_rows, {number(is.block), number(is.offset), number(is.size)});
    for (const rung_range& is : is_.persistent) {
      row(persistent_rows, {number(is.block), number(is.offset), number(is.size)});
    }
    for (const uint32_t is : is_.resources) resource_rows += number(is) + ",\n";
    for (const rung_write& is : is_.writes)
      row(write_rows, {number(is.area), number(is.mask), number(is.offset), number(is.size)});
    for (const rung_io_module& is : is_.io_modules)
      row(io_module_rows, {number(is.name), number(is.type), number(is.station), unsignedOrNone(is.task),
                           number(is.input_offset), number(is.output_offset)});
    std::string init = "void init(rung_context* ctx) {\n  (void)ctx;\n";
    for (uint32_t i = 0; i < facts_.blocks.size(); ++i) {
      init += "  memset(ctx->blocks[" + number(i) + "], 0, " + number(is_.blocks[i].size) + ");\n";
    }
    const std::vector<ir::InitStep> order = ir::initOrder(module_, facts_);
    for (const ir::InitStep& step : order) {
      const ir::BodyId body = step.is_list ? module_.lists[step.index].init : module_.programs[step.index].init;
      if (!hasCode(body)) continue;
      init += step.is_list ? callOn(body, module_.lists[step.index].record, facts_.list_block[step.index])
                           : callOn(body, module_.programs[step.index].record, facts_.program_block[step.index]);
    }
    for (const ir::InitStep& step : order)
      if (!step.is_list && module_.programs[step.index].setup) init += callOf(module_.programs[step.index].setup);
    if (module_.after_init) init += callOf(module_.after_init);
    init += "}\n";
    if (module_.exit) init += "void exit(rung_context* ctx) {\n" + callOf(module_.exit) + "}\n";
    if (module_.safe) init += "void safe(rung_context* ctx) {\n" + callOf(module_.safe) + "}\n";

    declarations_ = "extern const char text[];\nvoid init(rung_context* ctx);\n";
    if (module_.exit) declarations_ += "void exit(rung_context* ctx);\n";
    if (module_.safe) declarations_ += "void safe(rung_context* ctx);\n";
    std::string out =
        "// The tables of the module, its tasks and its initial values: see rung/module.h.\n#include <string.h>\n\n";
    out += "#include \"rung/module.h\"\n\n" + openNamespace(name_space_) + '\n' + prototypes_ + "\n";
    out += "extern const char text[] =\n";
    const std::string& bytes = is_.strings.bytes();
    for (size_t at = 0; at < bytes.size();) {  // one line per name
      size_t end = bytes.find('\0', at);
      out += "  ";
      appendQuoted(out, std::string_view(bytes).substr(at, end - at));
      out += " \"\\0\"\n";
      at = end + 1;
    }
    out += "  ;\n";
    table(out, "rung_block", "blocks", block_rows);
    table(out, "rung_area", "areas", area_rows);
    table(out, "rung_type", "types", type_rows);
    table(out, "rung_field", "fields", field_rows);
    table(out, "rung_enum_item", "enum_items", item_rows);
    table(out, "rung_dimension", "dimensions", dimension_rows);
    table(out, "rung_symbol", "symbols", symbol_rows);
    table(out, "rung_range", "retain", retain_rows);
    table(out, "rung_range", "persistent", persistent_rows);
    out += '\n' + code_;
    table(out, "uint32_t", "resources", resource_rows);
    table(out, "rung_task", "tasks", task_rows_);
    table(out, "rung_write", "writes", write_rows);
    table(out, "rung_io_module", "io_modules", io_module_rows);
    table(out, "rung_test", "tests", test_rows_);
    out += init + "\n}  // namespace " + name_space_ + '\n';

    description_ = "static const rung_module description = {\n  RUNG_MODULE_ABI, RUNG_MODULE_LAYOUT, " +
                   number(types_.pointerSize()) + ", " + (module_.aligned_globals ? "RUNG_ALIGNED_GLOBALS" : "0") +
                   ", ";
    appendQuoted(description_, options_.module_name);
    description_ += ", \"rung " RUNG_VERSION "\", text, " + number(is_.layout_hash) + "ULL,\n  ";
    description_ += cells("blocks", block_rows, is_.blocks.size()) + ", ";
    description_ += cells("areas", area_rows, is_.areas.size()) + ",\n  ";
    description_ += cells("resources", resource_rows, is_.resources.size()) + ", ";
    description_ += cells("tasks", task_rows_, is_.tasks.size()) + ", ";
    description_ += cells("writes", write_rows, is_.writes.size()) + ", ";
    description_ += cells("io_modules", io_module_rows, is_.io_modules.size()) + ",\n  ";
    description_ += cells("symbols", symbol_rows, is_.symbols.size()) + ", ";
    description_ += cells("types", type_rows, is_.types.size()) + ", ";
    description_ += cells("fields", field_rows, is_.fields.size()) + ", ";
    description_ += cells("enum_items", item_rows, is_.enum_items.size()) + ", ";
    description_ += cells("dimensions", dimension_rows, is_.dimensions.size()) + ",\n  ";
    description_ += cells("retain", retain_rows, is_.retain.size()) + ", ";
    description_ += cells("persistent", persistent_rows, is_.persistent.size()) + ", ";
    description_ += "sites, " + number(site_count_) + ", ";
    description_ += cells("tests", test_rows_, is_.tests.size()) + ", init, " + (module_.exit ? "exit" : "nullptr") +
                    ", " + (module_.safe ? "safe" : "nullptr") + ", nullptr, RUNG_CALL_PATH_FUNCTIONS\n};\n";
    return out;
  }

  void addSites(const std::vector<Group>& groups) {
    for (const Group& group : groups) {
      if (group.sites.empty()) continue;
      site_numbers_ += "extern const uint32_t sites_" + group.stem + " = " + number(site_count_) + ";\n";
      for (const Site& site : group.sites) {
        row(site_rows_, {number(is_.strings.add(module_.names.string(site.pou))),
                         number(is_.strings.add(site.origin_path ? module_.names.string(site.origin_path)
                                                                 : module_.sources.path(site.file))),
                         number(site.line), number(site.column), signedNumber(site.low), signedNumber(site.high)});
        ++site_count_;
      }
    }
    if (site_rows_.empty()) row(site_rows_, {"0", "0", "0", "0", "0", "0"});
  }

  // The description is here because it counts the sites: a count of another file would be an initial value that is
  // computed at run time, in a static constructor.
  std::string sitesSource() const {
    return "// Where the checks and calls are, and the description of the module: see rung/module.h.\n#include "
           "\"rung/call_paths.h\"\n#include \"rung/module.h\"\n\n" +
           openNamespace(name_space_) + '\n' + site_numbers_ + "static const rung_site sites[] = {\n" + site_rows_ +
           "};\n\n" + declarations_ + '\n' + description_ + "\n}  // namespace " + name_space_ +
           "\n\nextern \"C\" RUNG_EXPORT const rung_module* " + options_.module_name +
           "_module(void);\nextern \"C\" const rung_module* " + options_.module_name + "_module(void) { return &" +
           name_space_ + "::description; }\n";
  }

  const ir::Module& module_;
  const TypeTable& types_;
  const EmitOptions& options_;
  const Facts& facts_;
  const std::string name_space_;
  ir::Description is_;
  std::string task_rows_, test_rows_, code_, prototypes_;
  std::string site_rows_, site_numbers_;
  uint32_t site_count_ = 0;
  std::string declarations_, description_;  // for the file of the sites
  std::vector<uint32_t> declared_;
};

}  // namespace

Description describe(const ir::Module& module, const EmitOptions& options, const Facts& facts,
                     const std::vector<Group>& groups, std::string_view name_space) {
  return Describer(module, options, facts, name_space).run(groups);
}

}  // namespace rung::codegen
