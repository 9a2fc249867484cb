// Prints IR as text: see text.h and docs/ir.md. One item a line, blocks indented by two; the order is that of the
// module, so equal modules give equal bytes.
#include <charconv>
#include <cmath>
#include <cstring>
#include <unordered_set>

#include "ir/builder.h"
#include "ir/text.h"
#include "ir/text_words.h"
#include "ir/walk.h"

namespace rung::ir {

using types::Field;
using types::FieldRole;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

using namespace text_form;

class Printer {
 public:
  explicit Printer(const Module& module) : module_(module), types_(module.types) {}
  std::string out;

  void printModule();
  void printBody(const Body& body);
  void nameTypesOf(const Body& body);
  void nameRecords();

 private:
  // ---- text
  void put(std::string_view text) { out += text; }
  void number(uint64_t value) {
    char digits[24];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  void signedNumber(int64_t value) {
    char digits[24];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  void name(std::string_view text);
  void name(NameId id) { name(module_.names.text(id)); }
  void quoted(std::string_view text, char quote);
  void newLine() {
    out += '\n';
    out.append(indent_ * 2, ' ');
  }

  // ---- types
  void collect(TypeId type);
  void giveName(TypeId type, NameId wanted);
  void type(TypeId type);
  void typeDeclarations();
  void record(TypeId type, const Record* listed);

  // ---- module items
  void origin(const Origin& origin, Loc loc);
  void items();
  void header(const Body& body);

  // ---- code
  void block(StmtId first);
  void stmt(const Stmt& stmt);
  void expr(ExprId id, TypeId expected);
  void operand(ExprId id, TypeId expected);
  void constant(const Expr& expr, TypeId expected);
  void checks(const Expr& expr);
  void calleeOperands(const Body& callee, uint32_t first, uint32_t count);
  TypeId typeOf(ExprId id) const { return body_->expr(id).type; }

  const Module& module_;
  const TypeTable& types_;
  const Body* body_ = nullptr;
  size_t indent_ = 0;
  std::vector<std::string> type_names_;  // by TypeId: `@Color`
  std::vector<bool> collected_;
  std::vector<TypeId> declared_;  // enumerations, subranges and records outside Module::records, in order of use
  std::unordered_set<std::string> used_names_;
  std::unordered_set<uint32_t> local_names_;
};

// ---- text

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
  static constexpr char kHex[] = "0123456789ABCDEF";
  out += quote;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == quote || c == '$') {
      out += '$';
      out += c;
    } else if (byte < 0x20 || byte >= 0x7f) {
      out += '$';
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  out += quote;
}

// ---- types

void Printer::giveName(TypeId type, NameId wanted) {
  if (type_names_.size() < types_.count()) type_names_.resize(types_.count());
  std::string base(module_.names.text(wanted)), unique = base;
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
  if (TypeTable::isText(info.kind)) {
    put(info.kind == TypeKind::String ? "string[" : "wstring[");
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
    const char* word = wordOf(info.kind);
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
    }
    if (field.by_reference != (field.role == FieldRole::InOut)) put(field.by_reference ? "ref " : "value ");
    if (field.retain) put("retain ");
    if (field.persistent) put("persistent ");
    if (field.constant) put("constant ");
    name(field.name);
    put(": ");
    type(field.type);
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
  if (origin.from_text) {
    path = module_.names.text(origin.path);
    line = origin.line;
  } else if (loc) {
    Place place = module_.sources.place(loc);
    path = module_.sources.path(place.file);
    line = place.line;
  }
  if (line == 0) return;
  put(" ");
  quoted(path, '"');
  put(":");
  number(line);
}

void Printer::items() {
  if (module_.image_bytes[0] + module_.image_bytes[1] + module_.image_bytes[2] != 0) {
    put("image I ");
    number(module_.image_bytes[0]);
    put(" Q ");
    number(module_.image_bytes[1]);
    put(" M ");
    number(module_.image_bytes[2]);
    put("\n");
  }
  for (size_t i = 0; i < module_.data.size(); ++i) {
    static constexpr char kHex[] = "0123456789abcdef";
    const Data& data = module_.data[i];
    put("data ");
    number(i);
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
  for (const List& list : module_.lists) {
    put("list @");
    name(list.name);
    put(": ");
    type(list.record);
    put("\n");
  }
  for (const Task& task : module_.tasks) {
    static constexpr const char* kKinds[] = {"cyclic", "freewheeling", "event", "status", "external"};
    put("task ");
    name(task.name);
    put(" ");
    put(kKinds[static_cast<size_t>(task.kind)]);
    if (task.interval_ns != 0) {
      put(" interval ");
      signedNumber(task.interval_ns);
    }
    if (task.priority != 0) {
      put(" priority ");
      number(task.priority);
    }
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
    if (task.sensitivity != 0) {
      put(" sensitivity ");
      number(task.sensitivity);
    }
    put("\n");
  }
  for (const ProgramInstance& instance : module_.programs) {
    put("instance $");
    name(instance.name);
    put(": ");
    type(instance.record);
    if (instance.task != 0) {
      put(" task ");
      name(module_.tasks[instance.task - 1].name);
    }
    if (instance.resource) {
      put(" resource ");
      name(instance.resource);
    }
    if (instance.configuration) {
      put(" configuration ");
      name(instance.configuration);
    }
    put("\n");
  }
  for (const Located& located : module_.located) {
    put("located ");
    if (located.name)
      name(located.name);
    else
      put("_");
    put(": ");
    type(located.type);
    put("%");
    out += "IQM"[located.area];
    number(located.byte);
    if (located.bit != kNoBit) {
      put(".");
      number(located.bit);
    }
    if (located.owner_program != 0) {
      put(" of $");
      name(module_.programs[located.owner_program - 1].name);
    }
    put("\n");
  }
  for (BodyId test : module_.tests) {
    put("test @");
    name(module_.body(test).name);
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
    quoted(module_.names.text(body.spelling), '"');
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
  if (body.pure) put(" pure");
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
    if (body.native) return;
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

// ---- statements

// The statements and the closing brace; the opening one stands already.
void Printer::block(StmtId first) {
  ++indent_;
  for (StmtId id = first; id;) {
    const Stmt& s = body_->stmt(id);
    newLine();
    id = s.next;
    const bool gives_result = s.kind == StmtKind::Assign && id && body_->stmt(id).kind == StmtKind::Return &&
                              body_->expr(ExprId{s.a}).kind == ExprKind::Local &&
                              body_->locals[body_->expr(ExprId{s.a}).a].kind == LocalKind::Result;
    if (gives_result) {
      put("return ");
      expr(ExprId{s.b}, typeOf(ExprId{s.a}));
      id = body_->stmt(id).next;
    } else {
      stmt(s);
    }
  }
  --indent_;
  newLine();
  put("}");
}

void Printer::calleeOperands(const Body& callee, uint32_t first, uint32_t count) {
  put("(");
  uint32_t i = 0;
  for (const Local& local : callee.locals) {
    if (local.kind != LocalKind::Input && local.kind != LocalKind::Output && local.kind != LocalKind::InOut) continue;
    if (i == count) break;
    if (i > 0) put(", ");
    ExprId id = body_->operands[first + i];
    if (id)
      expr(id, types_.resolve(local.type));
    else
      put("_");
    ++i;
  }
  put(")");
}

void Printer::stmt(const Stmt& s) {
  switch (s.kind) {
    case StmtKind::None: put("none"); return;
    case StmtKind::Assign:
    case StmtKind::Bind:
      if (s.kind == StmtKind::Bind) put("bind ");
      expr(ExprId{s.a}, {});
      put(" = ");
      expr(ExprId{s.b}, typeOf(ExprId{s.a}));
      return;
    case StmtKind::Call: {
      const Body& callee = module_.body(BodyId{s.a});
      if (s.e != 0) {
        expr(ExprId{s.e}, {});
        put(" = ");
      }
      put(callee.kind == BodyKind::Init ? "call init @" : "call @");
      name(callee.name);
      if (callee.kind == BodyKind::Function || s.d != 0) calleeOperands(callee, s.c, s.d);
      if (s.b != 0) {
        put(" on ");
        expr(ExprId{s.b}, {});
      }
      return;
    }
    case StmtKind::If:
      put("if ");
      expr(ExprId{s.a}, types::kBool);
      put(" {");
      block(StmtId{s.b});
      if (s.c != 0) {
        put(" else {");
        block(StmtId{s.c});
      }
      return;
    case StmtKind::Switch: {
      put("switch ");
      expr(ExprId{s.a}, {});
      put(" {");
      const bool is_signed = types_.isSigned(types_.plainKind(typeOf(ExprId{s.a})));
      auto bound = [&](int64_t value) { is_signed ? signedNumber(value) : number(static_cast<uint64_t>(value)); };
      ++indent_;
      for (uint32_t i = 0; i < s.c; ++i) {
        const Case& one = body_->cases[s.b + i];
        newLine();
        put("case ");
        for (uint32_t k = 0; k < one.range_count; ++k) {
          const CaseRange& range = body_->ranges[one.first_range + k];
          if (k > 0) put(", ");
          bound(range.low);
          if (range.high != range.low) {
            put("..");
            bound(range.high);
          }
        }
        put(" {");
        block(one.block);
      }
      if (s.d != 0) {
        newLine();
        put("else {");
        block(StmtId{s.d});
      }
      --indent_;
      newLine();
      put("}");
      return;
    }
    case StmtKind::Loop:
      put("loop {");
      block(StmtId{s.a});
      if (s.b != 0) {
        put(" next {");
        block(StmtId{s.b});
      }
      return;
    case StmtKind::For: {
      TypeId type = typeOf(ExprId{s.a});
      put("for ");
      expr(ExprId{s.a}, {});
      put(" = ");
      expr(ExprId{s.b}, type);
      put(" to ");
      expr(ExprId{s.c}, type);
      put(" by ");
      expr(ExprId{s.d}, type);
      put(" {");
      block(StmtId{s.e});
      return;
    }
    case StmtKind::Break: put("break"); return;
    case StmtKind::Continue: put("continue"); return;
    case StmtKind::Return: put("return"); return;
    case StmtKind::Jump:
    case StmtKind::Label:
      put(s.kind == StmtKind::Jump ? "jump " : "label ");
      name(body_->labels[s.a]);
      return;
    case StmtKind::Try:
      put("try {");
      block(StmtId{s.a});
      put(" catch ");
      if (s.d != 0) {
        expr(ExprId{s.d}, {});
        put(" ");
      }
      put("{");
      block(StmtId{s.b});
      if (s.c != 0) {
        put(" finally {");
        block(StmtId{s.c});
      }
      return;
    case StmtKind::Fault:
      put("fault ");
      put(types::word(static_cast<types::Fault>(s.op)));
      if (s.a != 0) {
        put("(");
        expr(ExprId{s.a}, {});
        put(")");
      }
      return;
    case StmtKind::Assert: {
      const auto what = static_cast<Assertion>(s.op);
      if (what == Assertion::Assert) {
        put("assert ");
        expr(ExprId{s.a}, types::kBool);
      } else {
        put(what == Assertion::AssertEq ? "assert_eq " : "assert_near ");
        expr(ExprId{s.a}, {});
        put(", ");
        expr(ExprId{s.b}, typeOf(ExprId{s.a}));
        if (what == Assertion::AssertNear) {
          put(", ");
          expr(ExprId{s.c}, typeOf(ExprId{s.a}));
        }
      }
      if (s.d != 0) {
        put(" text ");
        quoted(module_.names.text(NameId{s.d}), '\'');
      }
      return;
    }
    case StmtKind::Evaluate:
      put("evaluate ");
      expr(ExprId{s.a}, {});
      return;
  }
}

// ---- expressions

void Printer::checks(const Expr& e) {
  if (e.checks == 0) return;
  put("!");
  if (e.checks == naturalCheck(types_, e)) return;
  put("(");
  bool first = true;
  for (const CheckWord& row : checkWords()) {
    if ((e.checks & row.check) == 0) continue;
    if (!first) put(", ");
    first = false;
    put(row.word);
  }
  put(")");
}

void Printer::constant(const Expr& e, TypeId expected) {
  const TypeId id = types_.resolve(e.type);
  const TypeInfo& info = types_.info(id);
  const TypeKind kind = types_.plainKind(id);
  bool prefix = id != (expected ? types_.resolve(expected) : TypeId{});
  if (!expected && e.kind == ExprKind::Const && (id == kDefaultInteger || id == types::kBool || (id == types::kReal)))
    prefix = false;
  NameId item;
  if (e.kind == ExprKind::Const && info.kind == TypeKind::Enum) {
    for (const auto& [item_name, value] : info.items) {
      if (value != static_cast<int64_t>(e.bits())) continue;
      item = item_name;
      break;
    }
  }
  if (prefix || item) {
    type(id);
    put("#");
  }
  if (e.kind == ExprKind::Zero) {
    put("zero");
  } else if (e.kind == ExprKind::Text) {
    quoted(module_.names.text(NameId{e.a}), '\'');
  } else if (item) {
    name(item);
  } else if (kind == TypeKind::Bool && e.bits() <= 1) {
    put(e.bits() != 0 ? "true" : "false");
  } else if (TypeTable::isReal(kind)) {
    double value = types::Value{id, e.bits()}.asReal();
    uint64_t quiet = types::Value::ofReal(id, std::nan("")).bits;
    if (std::isnan(value)) {
      put("nan");
      if (e.bits() != quiet) {
        put("(");
        number(e.bits());
        put(")");
      }
    } else if (std::isinf(value)) {
      put(value < 0 ? "-inf" : "inf");
    } else {
      char digits[40];
      char* end = kind == TypeKind::Real ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(value)).ptr
                                         : std::to_chars(digits, digits + sizeof digits, value).ptr;
      std::string_view text(digits, static_cast<size_t>(end - digits));
      put(text);
      if (text.find_first_of(".e") == std::string_view::npos) put(".0");
    }
  } else if ((kind == TypeKind::Pointer || kind == TypeKind::Reference) && e.bits() == 0) {
    put("null");
  } else if (types_.isSigned(kind)) {
    signedNumber(static_cast<int64_t>(e.bits()));
  } else {
    number(e.bits());
  }
}

// As operand of a prefix word or base of a postfix: in parentheses unless it is one word.
void Printer::operand(ExprId id, TypeId expected) {
  switch (body_->expr(id).kind) {
    case ExprKind::Unary:
    case ExprKind::Binary:
    case ExprKind::Convert:
    case ExprKind::Select:
    case ExprKind::Address:
      put("(");
      expr(id, expected);
      put(")");
      return;
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::Text:
    case ExprKind::Data:
    case ExprKind::Zero:
    case ExprKind::Local:
    case ExprKind::Self:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Image:
    case ExprKind::Field:
    case ExprKind::Index:
    case ExprKind::Deref:
    case ExprKind::Bits:
    case ExprKind::Call: expr(id, expected); return;
  }
}

void Printer::expr(ExprId id, TypeId expected) {
  const Expr& e = body_->expr(id);
  switch (e.kind) {
    case ExprKind::None: put("none"); return;
    case ExprKind::Const:
    case ExprKind::Text:
    case ExprKind::Zero: constant(e, expected); return;
    case ExprKind::Data:
      put("data ");
      number(e.a);
      return;
    case ExprKind::Local: {
      const Local& local = body_->locals[e.a];
      if (local.kind == LocalKind::Result) {
        put("result");
        return;
      }
      if (local.kind == LocalKind::Temp) put("%");
      name(local.name);
      return;
    }
    case ExprKind::Self: put("self"); return;
    case ExprKind::Global:
      put("@");
      name(module_.lists[e.a].name);
      return;
    case ExprKind::Program:
      put("$");
      name(module_.programs[e.a].name);
      return;
    case ExprKind::Image:
      type(e.type);
      put("%");
      out += "IQM"[e.a];
      number(e.b);
      if (e.c != kNoBit) {
        put(".");
        number(e.c);
      }
      return;
    case ExprKind::Field: {
      const Expr& base = body_->expr(ExprId{e.a});
      const Field& field = types_.info(types_.resolve(base.type)).fields[e.b];
      if (base.kind != ExprKind::Self || local_names_.count(field.name.index) != 0) {
        operand(ExprId{e.a}, {});
        put(".");
      }
      name(field.name);
      checks(e);
      return;
    }
    case ExprKind::Index:
      operand(ExprId{e.a}, {});
      put("[");
      for (uint32_t i = 0; i < e.c; ++i) {
        if (i > 0) put(", ");
        expr(body_->operands[e.b + i], {});
      }
      put("]");
      checks(e);
      return;
    case ExprKind::Deref:
      operand(ExprId{e.a}, {});
      put("^");
      checks(e);
      return;
    case ExprKind::Bits:
      operand(ExprId{e.a}, {});
      put(bitsWord(types_.kind(e.type)));
      number(e.b);
      return;
    case ExprKind::Unary:
      put(types::word(e.op));
      checks(e);
      put(" ");
      type(e.type);
      put(" ");
      operand(ExprId{e.a}, e.type);
      return;
    case ExprKind::Binary: {
      TypeId of = types::isComparison(e.op) ? typeOf(ExprId{e.a}) : e.type;
      put(types::word(e.op));
      checks(e);
      put(" ");
      type(of);
      put(" ");
      operand(ExprId{e.a}, of);
      put(", ");
      operand(ExprId{e.b}, of);
      return;
    }
    case ExprKind::Convert:
      put("convert");
      checks(e);
      put(" ");
      type(e.type);
      put(" ");
      operand(ExprId{e.a}, {});
      return;
    case ExprKind::Select:
      put("select ");
      type(e.type);
      put(" ");
      operand(ExprId{e.a}, types::kBool);
      put(", ");
      operand(ExprId{e.b}, e.type);
      put(", ");
      operand(ExprId{e.c}, e.type);
      return;
    case ExprKind::Call: {
      const Body& callee = module_.body(BodyId{e.a});
      put("@");
      name(callee.name);
      calleeOperands(callee, e.b, e.c);
      return;
    }
    case ExprKind::Address:
      put("address ");
      type(e.type);
      put(" ");
      operand(ExprId{e.a}, {});
      return;
  }
}

}  // namespace

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
