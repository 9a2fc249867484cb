// SPDX-License-Identifier: Apache-2.0
// Prints the text form of the IR: see text.h and docs/ir.md. One item a line, blocks indented by two; the order is that
// of the module, so equal modules give equal bytes.
#include "frontend/source/quoting.h"
#include "ir/text_writer.h"

namespace rung::ir {

namespace text_form {

using types::Field;
using types::FieldRole;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;

namespace {

const char* symbolAccessWord(types::SymbolAccess access) {
  switch (access) {
    case types::SymbolAccess::ReadWrite: return "";
    case types::SymbolAccess::Read: return "symbol_read ";
    case types::SymbolAccess::Write: return "symbol_write ";
    case types::SymbolAccess::None: return "symbol_none ";
  }
  return "";
}

}  // namespace

// ---- characters

void Printer::name(std::string_view text) {
  bool plain = !text.empty() && !(text[0] >= '0' && text[0] <= '9') && !isReserved(text) && text != "_";
  for (char c : text) {
    plain = plain && ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_');
  }
  if (plain)
    put(text);
  else
    quoted(text, '`');
}

void Printer::quoted(std::string_view text, char quote) {
  out += quote;
  for (const char c : text) appendInQuotes(out, c, quote, static_cast<unsigned char>(c) >= 0x7f || isControl(c));
  out += quote;
}

// ---- types

void Printer::giveName(TypeId type, NameId wanted) {
  if (type_names_.size() < types_.count()) type_names_.resize(types_.count());
  std::string base(module_.names.string(wanted)), unique = base;
  for (uint32_t n = 2; !used_names_.insert(unique).second; ++n) unique = base + "." + std::to_string(n);
  std::string saved;
  saved.swap(out);
  put("@");
  name(base.empty() ? std::string_view("_") : std::string_view(base));
  if (unique.size() > base.size()) put(std::string_view(unique).substr(base.size()));
  saved.swap(out);
  type_names_[type.index] = saved;
}

void Printer::collect(TypeId type) {
  type = types_.resolve(type);
  if (collected_.size() < types_.count()) collected_.resize(types_.count());
  if (!type || collected_[type.index]) return;
  collected_[type.index] = true;
  const TypeInfo& info = types_.info(type);
  if (info.kind == TypeKind::Enum || info.kind == TypeKind::Subrange) {
    declared_.push_back(type);
    giveName(type, info.name);
  } else if (info.kind == TypeKind::Array || info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference) {
    collect(info.base);
  } else if (info.kind == TypeKind::Record) {
    if (type_names_.size() <= type.index || type_names_[type.index].empty()) {
      declared_.push_back(type);
      giveName(type, info.name);
    }
    for (const Field& field : info.fields) collect(field.type);
  }
}

void Printer::nameRecords() {
  for (const Record& record : module_.records) giveName(types_.resolve(record.type), record.name);
}

void Printer::nameTypesOf(const Body& body) {
  for (const Local& local : body.locals) collect(local.type);
  collect(body.result);
  collect(body.self);
  for (size_t i = 1; i < body.exprs.size(); ++i) collect(body.exprs[i].type);
}

void Printer::type(TypeId id) {
  id = types_.resolve(id);
  const TypeInfo& info = types_.info(id);
  if (TypeTable::isString(info.kind)) {
    put(info.kind == TypeKind::String ? "string[" : info.kind == TypeKind::WString ? "wstring[" : "ustring[");
    number(info.length);
    put("]");
  } else if (info.kind == TypeKind::Array) {
    put("array[");
    if (info.dimensions.empty()) put("*");
    for (size_t i = 0; i < info.dimensions.size(); ++i) {
      if (i > 0) put(", ");
      signedNumber(info.dimensions[i].low);
      put("..");
      signedNumber(info.dimensions[i].high);
    }
    put("] of ");
    type(info.base);
  } else if (info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference) {
    put(info.kind == TypeKind::Pointer ? "pointer to " : "reference to ");
    type(info.base);
  } else if (info.kind == TypeKind::Enum || info.kind == TypeKind::Subrange || info.kind == TypeKind::Record) {
    if (type_names_.size() <= id.index || type_names_[id.index].empty()) giveName(id, info.name);
    put(type_names_[id.index]);
  } else {
    const char* word = keywordOf(info.kind);
    put(word != nullptr ? word : "none");
  }
}

void Printer::record(TypeId id, const Record* listed) {
  const TypeInfo& info = types_.info(id);
  switch (info.record_kind) {
    case RecordKind::Struct: put("struct "); break;
    case RecordKind::Union: put("union "); break;
    case RecordKind::FunctionBlock: put("block "); break;
    case RecordKind::Program: put("program "); break;
    case RecordKind::GlobalList: put("globals "); break;
    case RecordKind::Interface: put("interface "); break;
  }
  type(id);
  if (listed != nullptr) {
    origin(listed->origin, listed->loc);
    if (listed->library) put(" library");
  } else {
    put(" unlisted");
  }
  put(" {");
  bool first = true;
  for (const Field& field : info.fields) {
    put(first ? " " : "; ");
    first = false;
    switch (field.role) {
      case FieldRole::Member: break;
      case FieldRole::Local: put("var "); break;
      case FieldRole::Input: put("in "); break;
      case FieldRole::Output: put("out "); break;
      case FieldRole::InOut: put("inout "); break;
      case FieldRole::Base: put("base "); break;
    }
    if (field.by_reference != (field.role == FieldRole::InOut)) put(field.by_reference ? "ref " : "value ");
    if (field.retain) put("retain ");
    if (field.non_retain) put("non_retain ");
    if (field.persistent) put("persistent ");
    if (field.constant) put("constant ");
    put(symbolAccessWord(field.symbol_access));
    name(field.name);
    put(": ");
    type(field.type);
    if (field.pack != 0) {
      put(" pack ");
      number(field.pack);
    }
    if (field.given_offset != 0 && info.record_kind == RecordKind::Union) {
      put(" at ");
      number(field.given_offset);
    }
  }
  put(first ? "}\n" : " }\n");
}

void Printer::typeDeclarations() {
  for (TypeId id : declared_) {
    const TypeInfo& info = types_.info(id);
    if (info.kind == TypeKind::Record) {
      record(id, nullptr);
      continue;
    }
    put(info.kind == TypeKind::Enum ? "enum " : "subrange ");
    type(id);
    put(": ");
    type(info.base);
    if (info.kind == TypeKind::Subrange) {
      put(" ");
      const bool is_signed = types_.isSigned(types_.plainKind(id));
      is_signed ? signedNumber(info.low) : number(static_cast<uint64_t>(info.low));
      put("..");
      is_signed ? signedNumber(info.high) : number(static_cast<uint64_t>(info.high));
      put("\n");
      continue;
    }
    put(info.strict ? " strict {" : " {");
    for (size_t i = 0; i < info.items.size(); ++i) {
      put(i == 0 ? " " : "; ");
      name(info.items[i].first);
      put(" = ");
      signedNumber(info.items[i].second);
    }
    put(" }\n");
  }
}

// ---- module items

void Printer::origin(const Origin& origin, Loc loc) {
  std::string_view path;
  uint32_t line = 0;
  if (origin.from_string) {
    path = module_.names.string(origin.path);
    line = origin.line;
  } else if (loc) {
    SourceLocation location = module_.sources.location(loc);
    path = module_.sources.path(location.file);
    line = location.line;
  }
  if (line == 0) return;
  put(" ");
  quoted(path, '"');
  put(":");
  number(line);
}

// A word and a number, a name or a body; nothing for 0 or none.
void Printer::clause(const char* word, uint64_t value) {
  if (value == 0) return;
  put(word);
  number(value);
}
void Printer::clause(const char* word, NameId value) {
  if (!value) return;
  put(word);
  name(value);
}
void Printer::clause(const char* word, BodyId value) {
  if (value) clause(word, module_.body(value).name);
}

void Printer::dataItem(size_t index) {
  static constexpr char kHex[] = "0123456789abcdef";
  const Data& data = module_.data[index];
  put("data ");
  number(index);
  put(": ");
  type(data.type);
  put(" \"");
  for (size_t k = 0; k < data.bytes.size(); ++k) {
    if (k > 0 && k % 32 == 0)
      put("\"\n  \"");
    else if (k > 0 && k % 4 == 0)
      put(" ");
    out += kHex[data.bytes[k] >> 4];
    out += kHex[data.bytes[k] & 15];
  }
  put("\"\n");
}

void Printer::ioModule(const types::IoModule& module) {
  put("io_module ");
  quoted(module.name, '"');
  put(" ");
  quoted(module.type, '"');
  if (!module.station.empty()) {
    put(" station ");
    quoted(module.station, '"');
  }
  clause(" bus_task ", module.task);
  clause(" inputs ", module.input_offset);
  clause(" outputs ", module.output_offset);
  put("\n");
}

void Printer::task(uint32_t index) {
  static constexpr const char* kKinds[] = {"cyclic", "freewheeling", "event", "status", "external"};
  const Task& task = module_.tasks[index];
  put("task ");
  numbered(module_.tasks, index);
  put(" ");
  put(kKinds[static_cast<size_t>(task.kind)]);
  clause(" resource ", task.resource);
  if (task.interval_ns != 0) {
    put(" interval ");
    signedNumber(task.interval_ns);
  }
  clause(" priority ", task.priority);
  if (!task.trigger.empty()) {
    put(" trigger ");
    quoted(task.trigger, '"');
  }
  if (!task.external_event.empty()) {
    put(" external ");
    quoted(task.external_event, '"');
  }
  if (task.watchdog_ns != 0) {
    put(" watchdog ");
    signedNumber(task.watchdog_ns);
  }
  clause(" sensitivity ", task.sensitivity);
  if (task.duration_ns != 0) {
    put(" duration ");
    signedNumber(task.duration_ns);
  }
  put("\n");
}

// around_task t before @t~before after @t~after
void Printer::taskCalls(uint32_t index) {
  const Task& task = module_.tasks[index];
  if (!task.before && !task.after) return;
  put("around_task ");
  numbered(module_.tasks, index);
  clause(" before @", task.before);
  clause(" after @", task.after);
  put("\n");
}

void Printer::programName(uint32_t index) {
  put("$");
  numbered(module_.programs, index);
}

void Printer::instance(uint32_t index) {
  const ProgramInstance& instance = module_.programs[index];
  put("instance ");
  programName(index);
  put(": ");
  type(instance.record);
  if (instance.task != 0) {
    put(" task ");
    numbered(module_.tasks, instance.task - 1);
  }
  if (instance.retain) put(" retain");
  if (instance.is_test) put(" test");
  clause(" resource ", instance.resource);
  clause(" configuration ", instance.configuration);
  clause(" run @", instance.run);
  clause(" setup @", instance.setup);
  if (instance.slot != kProgramSlot) {
    put(" slot ");
    signedNumber(instance.slot);
  }
  clause(" after_init @", instance.after_init);
  clause(" exit @", instance.exit);
  put("\n");
}

void Printer::located(const Located& located) {
  put("located ");
  if (located.retain) put("retain ");
  if (located.persistent) put("persistent ");
  put(symbolAccessWord(located.symbol_access));
  if (located.name)
    name(located.name);
  else
    put("_");
  put(": ");
  type(located.type);
  put("%");
  out += module_.areas[located.area].letter;
  number(located.byte);
  if (located.bit != kNoBit) {
    put(".");
    number(located.bit);
  }
  if (located.owner_program != 0) {
    put(" of ");
    programName(located.owner_program - 1);
  }
  clause(" of_list @", located.list);
  clause(" configuration ", located.configuration);
  put("\n");
}

// classes @Base, @Pump of @Base      dispatch @Base__Run from 1: @Base__Run, @Pump__Run
void Printer::classes() {
  for (size_t i = 0; i < module_.classes.size(); ++i) {
    put(i == 0 ? "classes " : ", ");
    type(module_.classes[i].record);
    if (module_.classes[i].base) {
      put(" of ");
      type(module_.classes[i].base);
    }
    if (i + 1 == module_.classes.size()) put("\n");
  }
  for (const Dispatch& dispatch : module_.dispatches) {
    clause("dispatch @", dispatch.method);
    put(" from ");
    number(dispatch.first);
    put(":");
    for (size_t i = 0; i < dispatch.bodies.size(); ++i) {
      put(i == 0 ? " " : ", ");
      dispatch.bodies[i] ? clause("@", dispatch.bodies[i]) : put("_");
    }
    put("\n");
  }
}

void Printer::items() {
  for (const types::MemoryArea& area : module_.areas) {
    if (area.bytes == 0) continue;
    put("area ");
    out += area.letter;
    put(" ");
    put(spelling(area.owner));
    put(" ");
    number(area.bytes);
    put("\n");
  }
  for (size_t i = 0; i < module_.data.size(); ++i) dataItem(i);
  for (const List& list : module_.lists) {
    clause("list @", list.name);
    put(": ");
    type(list.record);
    if (list.slot != kListSlot) {
      put(" slot ");
      signedNumber(list.slot);
    }
    clause(" configuration ", list.configuration);
    put("\n");
  }
  if (module_.aligned_globals) put("aligned_globals\n");
  for (const types::IoModule& module : module_.io_modules) ioModule(module);
  for (uint32_t i = 0; i < module_.tasks.size(); ++i) task(i);
  for (uint32_t i = 0; i < module_.programs.size(); ++i) instance(i);
  for (const Located& one : module_.located) located(one);
  classes();
  for (uint32_t i = 0; i < module_.tasks.size(); ++i) taskCalls(i);
  if (module_.after_init) {
    clause("after_init @", module_.after_init);
    put("\n");
  }
  if (module_.safe) {
    clause("safe @", module_.safe);
    put("\n");
  }
  if (module_.exit) {
    clause("exit @", module_.exit);
    put("\n");
  }
  for (const BodyId maker : module_.makers) {
    clause("maker @", maker);
    put("\n");
  }
  for (const Test& test : module_.tests) {
    clause("test @", test.body);
    clause(" setup @", test.setup);
    clause(" before @", test.before);
    clause(" after @", test.after);
    if (test.name != module_.body(test.body).spelling) {
      put(" as ");
      quoted(module_.names.string(test.name), '"');
    }
    put("\n");
  }
}

// Name, origin and attributes of a body.
void Printer::header(const Body& body) {
  put("@");
  name(body.name);
  origin(body.origin, body.loc);
  if (body.spelling && body.spelling != body.name) {
    put(" as ");
    quoted(module_.names.string(body.spelling), '"');
  }
  if (body.kind == BodyKind::Function && body.self) {
    put(" on ");
    type(body.self);
  }
  if (body.native) {
    put(" native ");
    if (body.library_name)
      name(body.library_name);
    else
      put("_");
  }
  if (body.abstract) put(" abstract");
  if (body.pure) put(" pure");
  if (body.sized) put(" sized");
  if (body.slice) put(" slice");
  if (body.may_fault) put(" faults");
  if (body.library) put(" library");
  if (body.test) put(" test");
}

void Printer::printBody(const Body& body) {
  body_ = &body;
  local_names_.clear();
  for (const Local& local : body.locals)
    if (local.kind != LocalKind::Temp && local.kind != LocalKind::Result) local_names_.insert(local.name.index);

  if (body.kind == BodyKind::Function) {
    put("function ");
    header(body);
    put(" {");
    bool first = true;
    for (const Local& local : body.locals) {
      if (local.kind == LocalKind::Temp || local.kind == LocalKind::Variable) continue;
      put(first ? " " : "; ");
      first = false;
      if (local.kind == LocalKind::Result) {
        put("result ");
      } else {
        put(local.kind == LocalKind::Input ? "in " : local.kind == LocalKind::Output ? "out " : "inout ");
        name(local.name);
        put(": ");
      }
      type(local.type);
    }
    put(first ? "}\n" : " }\n");
    if (body.native || body.abstract) return;
    put("body @");
    name(body.name);
  } else {
    put(body.kind == BodyKind::Init ? "init " : "body ");
    header(body);
  }
  put(" {");
  indent_ = 1;
  for (const Local& local : body.locals) {
    if (local.kind != LocalKind::Temp && local.kind != LocalKind::Variable) continue;
    newLine();
    put(local.kind == LocalKind::Temp ? "temp " : "var ");
    name(local.name);
    put(": ");
    type(local.type);
  }
  indent_ = 0;
  block(body.first);
  put("\n");
}

void Printer::printModule() {
  nameRecords();
  for (const Record& record : module_.records) collect(record.type);
  for (const Data& data : module_.data) collect(data.type);
  for (const Located& located : module_.located) collect(located.type);
  for (size_t i = 1; i < module_.bodies.size(); ++i) nameTypesOf(module_.bodies[i]);
  typeDeclarations();
  for (const Record& listed : module_.records) record(types_.resolve(listed.type), &listed);
  items();
  for (size_t i = 1; i < module_.bodies.size(); ++i) {
    if (!out.empty()) put("\n");
    printBody(module_.bodies[i]);
  }
}

}  // namespace text_form

using text_form::Printer;

std::string print(const Module& module) {
  Printer printer(module);
  printer.printModule();
  return std::move(printer.out);
}

std::string print(const Module& module, const Body& body) {
  Printer printer(module);
  printer.nameRecords();
  printer.nameTypesOf(body);
  printer.printBody(body);
  return std::move(printer.out);
}

}  // namespace rung::ir
