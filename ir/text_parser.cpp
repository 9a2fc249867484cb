// SPDX-License-Identifier: Apache-2.0
// Reads IR text (docs/ir.md) into a module. Three walks over the items: names of types, then declarations and
// signatures, then code; so an item may use one below it. A mistake ends its item and the next one is read.
#include <charconv>

#include "ir/diagnostics.h"
#include "ir/text_reader.h"

namespace rung::ir {

namespace text_form {

using types::Dimension;
using types::Field;
using types::FieldRole;
using types::RecordKind;

// ---- tokens

void TokenReader::fail(Diag diag, Loc loc, std::initializer_list<std::string_view> args) {
  if (!failed_) diagnostics_.report(diag, loc, args);
  failed_ = true;
}

void TokenReader::expected(std::string_view what) {
  const Token& seen = token();
  std::string quoted;
  if (what.size() < 3 || isReserved(what)) quoted = "`" + std::string(what) + "`";
  fail(diag::IrExpected, seen.loc,
       {quoted.empty() ? what : quoted, seen.kind == TokenKind::End ? std::string_view("end of file") : seen.text});
}

NameId TokenReader::name() {
  if (failed_) return {};
  const Token& t = token();
  if (t.kind != TokenKind::Name || (!t.quoted && isReserved(t.text))) {
    expected("a name");
    return {};
  }
  ++at_;
  return names_.intern(t.quoted ? unescape(t.text) : std::string(t.text));
}

std::string TokenReader::sigilName() {
  expect("@");
  NameId id = name();
  std::string text(names_.string(id));
  if (isPunct(".") && token(1).kind == TokenKind::Number) {
    text += "." + std::string(token(1).text);
    at_ += 2;
  }
  return text;
}

NameId TokenReader::numberedName(NameId& base) {
  base = name();
  if (failed_ || !isPunct(".") || token(1).kind != TokenKind::Number) return base;
  const std::string text = std::string(names_.string(base)) + "." + std::string(token(1).text);
  at_ += 2;
  return names_.intern(text);
}

std::string TokenReader::quotedText(TokenKind kind) {
  if (failed_) return {};
  if (token().kind != kind) {
    expected(kind == TokenKind::Text ? "a string in single quotes" : "a string in double quotes");
    return {};
  }
  return unescape(tokens_[at_++].text);
}

int64_t TokenReader::integer() {
  const bool negative = accept("-");
  if (failed_) return 0;
  const Token& t = token();
  uint64_t value = 0;
  auto [end, error] = std::from_chars(t.text.data(), t.text.data() + t.text.size(), value);
  if (t.kind != TokenKind::Number || error != std::errc() || end != t.text.data() + t.text.size()) {
    expected("an integer");
    return 0;
  }
  ++at_;
  return static_cast<int64_t>(negative ? 0 - value : value);
}

// ---- items

static bool isItemWord(std::string_view word) {
  for (const char* item :
       {"enum", "subrange",  "struct",     "union",      "block",    "program", "globals",  "area",
        "data", "interface", "classes",    "dispatch",   "list",     "task",    "instance", "located",
        "test", "exit",      "maker",      "after_init", "function", "body",    "init",     "aligned_globals",
        "safe", "io_module", "around_task"})
    if (word == item) return true;
  return false;
}

void Reader::findItems() {
  int depth = 0;
  for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
    const Token& t = tokens_[i];
    if (t.kind == TokenKind::Punct && t.text == "{") ++depth;
    if (t.kind == TokenKind::Punct && t.text == "}") --depth;
    if (t.kind != TokenKind::Name || !t.first_in_line || t.quoted || depth > 0) continue;
    if (isItemWord(t.text)) items_.push_back(i);
  }
  if (items_.empty() ? tokens_.size() > 1 : items_[0] != 0) {
    at_ = 0;
    expected("an item (`function`, `body`, `struct`, ...)");
    failed_ = false;
  }
}

// enum @Name: int { … }   subrange @Name: int 0..9   struct @Name …: only the name and the base are read here
void Reader::declareType() {
  const std::string_view word = token().text;
  RecordKind kind = RecordKind::Struct;
  if (word == "union")
    kind = RecordKind::Union;
  else if (word == "block")
    kind = RecordKind::FunctionBlock;
  else if (word == "program")
    kind = RecordKind::Program;
  else if (word == "globals")
    kind = RecordKind::GlobalList;
  else if (word == "interface")
    kind = RecordKind::Interface;
  else if (word != "struct" && word != "enum" && word != "subrange")
    return;
  ++at_;
  const Loc loc = token().loc;
  const std::string text = sigilName();
  if (failed_) return;
  // `@Color.2` is a second type that the user also named Color; `@_` has no name.
  const std::string_view base_name = std::string_view(text).substr(0, text.find('.'));
  const NameId id = base_name == "_" ? NameId{} : module_.names.intern(base_name);
  TypeId created;
  if (word == "enum" || word == "subrange") {
    expect(":");
    const TypeId base = type();
    if (failed_) return;
    int64_t low = 0, high = 0;
    if (word == "subrange") {
      low = integer();
      expect("..");
      high = integer();
      if (failed_) return;
    }
    created = word == "enum" ? types_.addEnum(id, base) : types_.addSubrange(id, base, low, high);
  } else {
    created = types_.addRecord(kind, id);
  }
  if (!type_by_name_.emplace(text, created).second) fail(diag::IrRepeatedName, loc, {text});
}

Origin Reader::origin() {
  Origin result;
  result.from_string = true;
  if (failed_ || token().kind != TokenKind::String) return result;
  result.path = module_.names.intern(quotedText(TokenKind::String));
  expect(":");
  result.line = static_cast<uint32_t>(integer());
  return result;
}

constexpr Meaning<FieldRole> kFieldRoles[] = {{"in", FieldRole::Input},
                                              {"out", FieldRole::Output},
                                              {"inout", FieldRole::InOut},
                                              {"var", FieldRole::Local},
                                              {"base", FieldRole::Base}};
constexpr Meaning<TaskKind> kTaskKinds[] = {{"cyclic", TaskKind::Cyclic},
                                            {"freewheeling", TaskKind::Freewheeling},
                                            {"event", TaskKind::Event},
                                            {"status", TaskKind::Status},
                                            {"external", TaskKind::External}};
constexpr Meaning<LocalKind> kParameterKinds[] = {
    {"in", LocalKind::Input}, {"out", LocalKind::Output}, {"inout", LocalKind::InOut}};

// { in up: bool; out ref retain y: real }
void Reader::recordFields(TypeId type_id) {
  expect("{");
  while (!failed_ && !accept("}")) {
    Field field;
    acceptOneOf(kFieldRoles, field.role);
    field.by_reference = field.role == FieldRole::InOut;
    if (accept("ref"))
      field.by_reference = true;
    else if (accept("value"))
      field.by_reference = false;
    field.retain = accept("retain");
    field.non_retain = accept("non_retain");
    field.persistent = accept("persistent");
    field.constant = accept("constant");
    field.symbol_access = symbolAccess();
    field.name = name();
    expect(":");
    field.type = type();
    if (!failed_ && accept("pack")) field.pack = static_cast<uint8_t>(integer());
    if (!failed_ && accept("at")) field.given_offset = static_cast<uint32_t>(integer());
    if (failed_) return;
    types_.edit(type_id).fields.push_back(field);
  }
}

void Reader::record() {
  const Loc loc = token(1).loc;
  ++at_;
  const std::string text = sigilName();
  if (failed_) return;
  const TypeId type_id = type_by_name_[text];
  Record created;
  created.type = type_id;
  created.name = module_.names.intern(text);
  created.loc = loc;
  created.file = file_;
  created.origin = origin();
  created.library = accept("library");
  const bool unlisted = accept("unlisted");
  recordFields(type_id);
  if (failed_ || unlisted) return;
  record_by_type_[type_id.index] = static_cast<uint32_t>(module_.records.size());
  module_.records.push_back(created);
}

void Reader::dataItem() {
  ++at_;
  const Loc loc = token().loc;
  const std::string number(token().text);
  if (static_cast<uint64_t>(integer()) != module_.data.size()) fail(diag::IrExpected, loc, {"the next number", number});
  expect(":");
  Data data;
  data.type = type();
  std::string digits;
  while (!failed_ && token().kind == TokenKind::String) {
    for (char c : tokens_[at_].text)
      if (c != ' ') digits += c;
    ++at_;
  }
  for (size_t i = 0; i + 1 < digits.size() && !failed_; i += 2) {
    uint8_t byte = 0;
    auto [end, error] = std::from_chars(digits.data() + i, digits.data() + i + 2, byte, 16);
    if (error != std::errc() || end != digits.data() + i + 2)
      fail(diag::IrExpected, loc, {"hexadecimal bytes", std::string_view(digits).substr(i, 2)});
    data.bytes.push_back(byte);
  }
  if (!failed_) module_.data.push_back(std::move(data));
}

// io_module "ad" "AX_EM_4AD" station "rcm" bus_task 1 inputs 4 outputs 8
void Reader::ioModule() {
  ++at_;
  types::IoModule created;
  created.name = quotedText(TokenKind::String);
  created.type = quotedText(TokenKind::String);
  if (accept("station")) created.station = quotedText(TokenKind::String);
  if (accept("bus_task")) created.task = static_cast<uint32_t>(integer());
  if (accept("inputs")) created.input_offset = static_cast<uint32_t>(integer());
  if (accept("outputs")) created.output_offset = static_cast<uint32_t>(integer());
  if (!failed_) module_.io_modules.push_back(std::move(created));
}

void Reader::task() {
  ++at_;
  Task created;
  const NameId key = numberedName(created.name);
  if (!acceptOneOf(kTaskKinds, created.kind)) expected("the task's kind");
  if (accept("resource")) created.resource = name();
  if (accept("interval")) created.interval_ns = integer();
  if (accept("priority")) created.priority = static_cast<uint32_t>(integer());
  if (accept("trigger")) created.trigger = quotedText(TokenKind::String);
  if (accept("external")) created.external_event = quotedText(TokenKind::String);
  if (accept("watchdog")) created.watchdog_ns = integer();
  if (accept("sensitivity")) created.sensitivity = static_cast<uint32_t>(integer());
  if (accept("duration")) created.duration_ns = integer();
  if (failed_) return;
  task_by_name_[key.index] = static_cast<uint32_t>(module_.tasks.size());
  module_.tasks.push_back(std::move(created));
}

void Reader::taskCalls() {
  const uint32_t index = numberOf(task_by_name_, "task", true);
  if (failed_) return;
  Task& task = module_.tasks[index];
  if (accept("before")) task.before = bodyNamed("function");
  if (accept("after")) task.after = bodyNamed("function");
}

BodyId Reader::bodyNamed(std::string_view what) {
  const Loc loc = token().loc;
  const std::string text = sigilName();
  const auto found = body_by_name_.find(module_.names.intern(text).index);
  if (found != body_by_name_.end()) return BodyId{found->second};
  fail(diag::IrUnknownName, loc, {text, what});
  return {};
}

void Reader::instance() {
  ++at_;
  expect("$");
  ProgramInstance created;
  const NameId key = numberedName(created.name);
  expect(":");
  created.record = type();
  if (accept("task")) created.task = numberOf(task_by_name_, "task", true) + 1;
  created.retain = accept("retain");
  created.is_test = accept("test");
  if (accept("resource")) created.resource = name();
  if (accept("configuration")) created.configuration = name();
  if (accept("run")) created.run = bodyNamed("function");
  if (accept("setup")) created.setup = bodyNamed("function");
  if (accept("slot")) created.slot = static_cast<int32_t>(integer());
  if (accept("after_init")) created.after_init = bodyNamed("function");
  if (accept("exit")) created.exit = bodyNamed("function");
  if (failed_) return;
  program_by_name_[key.index] = static_cast<uint32_t>(module_.programs.size());
  module_.programs.push_back(created);
}

// test @Adds setup @`Adds~case1` as "Adds(a := 1)"
void Reader::test(BodyId body) {
  Test created{body, module_.body(body).spelling, {}, module_.body(body).loc};
  if (accept("setup")) created.setup = bodyNamed("function");
  if (accept("before")) created.before = bodyNamed("function");
  if (accept("after")) created.after = bodyNamed("function");
  if (accept("as")) created.name = module_.names.intern(quotedText(TokenKind::String));
  if (!failed_) module_.tests.push_back(created);
}

// area I input 4
void Reader::area() {
  ++at_;
  const std::string_view letter = token().text;
  if (token().kind != TokenKind::Name || letter.size() != 1) return expected("the letter of an area");
  ++at_;
  types::MemoryArea created{.letter = letter[0], .owner = types::AreaOwner::Memory};
  const auto owner = types::ownerCalled(token().text);
  if (!owner) return expected("input, output or memory");
  created.owner = *owner;
  ++at_;
  created.bytes = static_cast<uint32_t>(integer());
  if (failed_) return;
  if (const auto known = types::findArea(module_.areas, created.letter))
    module_.areas[known->index] = created;
  else
    module_.areas.push_back(created);
}

// I4, after the `%`.
std::optional<Reader::AddressInArea> Reader::addressInArea() {
  const std::string_view text = token().text;
  const auto area = text.size() < 2 ? std::nullopt : types::findArea(module_.areas, text[0]);
  if (token().kind != TokenKind::Name || !area) {
    expected("an area and a byte such as I4");
    return std::nullopt;
  }
  AddressInArea address{*area, 0};
  std::from_chars(text.data() + 1, text.data() + text.size(), address.byte);
  ++at_;
  return address;
}

types::SymbolAccess Reader::symbolAccess() {
  if (accept("symbol_read")) return types::SymbolAccess::Read;
  if (accept("symbol_write")) return types::SymbolAccess::Write;
  return accept("symbol_none") ? types::SymbolAccess::None : types::SymbolAccess::ReadWrite;
}

// located start: bool%I0.5 of $Main
void Reader::located() {
  ++at_;
  Located created{};
  created.retain = accept("retain");
  created.persistent = accept("persistent");
  created.symbol_access = symbolAccess();
  if (!accept("_")) created.name = name();
  expect(":");
  created.type = type();
  created.bit = kNoBit;
  expect("%");
  if (failed_) return;
  const std::optional<AddressInArea> address = addressInArea();
  if (!address) return;
  created.area = address->area.index;
  created.byte = address->byte;
  if (accept(".")) created.bit = static_cast<uint32_t>(integer());
  if (accept("of")) {
    expect("$");
    created.owner_program = numberOf(program_by_name_, "program", true) + 1;
  }
  if (accept("of_list")) {
    expect("@");
    created.list = name();
  }
  if (accept("configuration")) created.configuration = name();
  if (!failed_) module_.located.push_back(created);
}

void Reader::attributes(Body& body) {
  body.origin = origin();
  body.spelling = accept("as") ? module_.names.intern(quotedText(TokenKind::String)) : body.name;
  if (accept("on")) body.self = type();
  if (accept("native")) {
    body.native = true;
    if (!accept("_")) body.library_name = name();
  }
  body.abstract = accept("abstract");
  body.pure = accept("pure");
  body.sized = accept("sized");
  body.slice = accept("slice");
  body.may_fault = accept("faults");
  body.library = accept("library");
  body.test = accept("test");
}

// function @Pick "pick.st":1 pure { in x: int; result int }
void Reader::function() {
  ++at_;
  Body& body = module_.bodies.emplace_back();
  const BodyId id{static_cast<uint32_t>(module_.bodies.size()) - 1};
  body.loc = token().loc;
  body.file = file_;
  body.name = module_.names.intern(sigilName());
  attributes(body);
  Builder builder(module_, body);
  expect("{");
  while (!failed_ && !accept("}")) {
    builder.loc = token().loc;
    if (accept("result")) {
      body.result = type();
      if (!failed_) builder.local(body.spelling, body.result, LocalKind::Result);
      continue;
    }
    LocalKind kind = LocalKind::Input;
    if (!acceptOneOf(kParameterKinds, kind)) expected("in");
    const NameId local = name();
    expect(":");
    const TypeId local_type = type();
    if (!failed_) builder.local(local, local_type, kind);
  }
  if (failed_) {
    broken_names_.emplace(body.name.index, id.index);
    return;
  }
  if (!body_by_name_.emplace(body.name.index, id.index).second)
    fail(diag::IrRepeatedName, body.loc, {module_.names.string(body.name)});
}

// body @Ramp { … } of a function declared above or of a record;   init @Ramp { … }
void Reader::blockBody(BodyKind kind) {
  ++at_;
  const Loc loc = token().loc;
  const std::string text = sigilName();
  if (failed_) return;
  const NameId id = module_.names.intern(text);
  Map& by_name = kind == BodyKind::Init ? init_by_name_ : body_by_name_;
  if (auto found = by_name.find(id.index); found != by_name.end()) {
    const BodyId known{found->second};
    if (module_.body(known).kind != BodyKind::Function) return fail(diag::IrRepeatedName, loc, {text});
    for (const Code& code : codes_)
      if (code.body == known) return fail(diag::IrRepeatedName, loc, {text});
    codes_.push_back({at_, known});
    return;
  }
  auto record_type = type_by_name_.find(text);
  if (record_type == type_by_name_.end() && broken_names_.find(id.index) != broken_names_.end()) {
    failed_ = true;  // its declaration has been reported
    return;
  }
  if (record_type == type_by_name_.end())
    return fail(diag::IrUnknownName, loc, {text, kind == BodyKind::Init ? "record" : "function or block"});
  auto listed = record_by_type_.find(record_type->second.index);
  Body& body = module_.bodies.emplace_back();
  const BodyId body_id{static_cast<uint32_t>(module_.bodies.size()) - 1};
  body.kind = kind;
  body.loc = loc;
  body.file = file_;
  body.name = id;
  body.self = record_type->second;
  attributes(body);
  by_name.emplace(id.index, body_id.index);
  if (listed != record_by_type_.end()) {
    Record& of = module_.records[listed->second];
    (kind == BodyKind::Init ? of.init : of.body) = body_id;
  }
  if (!body.native) codes_.push_back({at_, body_id});
}

// classes @Base, @Pump of @Base
void Reader::classes() {
  do {
    ++at_;
    Class created;
    created.record = type();
    if (accept("of")) created.base = type();
    if (failed_) return;
    module_.classes.push_back(created);
  } while (isPunct(","));
}

// dispatch @Base__Run from 1: @Base__Run, _
void Reader::dispatch() {
  Dispatch created;
  auto body = [&] {
    const BodyId named = bodyNamed("body");
    return failed_ ? BodyId{} : named;
  };
  created.method = body();
  expect("from");
  created.first = static_cast<uint32_t>(integer());
  expect(":");
  do created.bodies.push_back(accept("_") ? BodyId{} : body());
  while (!failed_ && accept(","));
  if (!failed_) module_.dispatches.push_back(std::move(created));
}

void Reader::enumItems() {
  ++at_;
  const TypeId enum_type = type_by_name_[sigilName()];
  expect(":");
  type();
  const bool strict = accept("strict");
  expect("{");
  types_.edit(enum_type).strict = strict;
  while (!failed_ && !accept("}")) {
    const NameId item = name();
    expect("=");
    const int64_t value = integer();
    types_.edit(enum_type).items.emplace_back(item, value);
  }
}

void Reader::list() {
  ++at_;
  expect("@");
  List created;
  created.name = name();
  expect(":");
  created.record = type();
  if (accept("slot")) created.slot = static_cast<int32_t>(integer());
  if (accept("configuration")) created.configuration = name();
  if (failed_) return;
  list_by_name_[created.name.index] = static_cast<uint32_t>(module_.lists.size());
  module_.lists.push_back(created);
}

void Reader::declareItem() {
  static constexpr Meaning<void (Reader::*)()> kItems[] = {
      {"enum", &Reader::enumItems},    {"area", &Reader::area},       {"list", &Reader::list},
      {"data", &Reader::dataItem},     {"classes", &Reader::classes}, {"task", &Reader::task},
      {"instance", &Reader::instance}, {"located", &Reader::located}, {"function", &Reader::function},
      {"io_module", &Reader::ioModule}};
  for (const auto& item : kItems) {
    if (isWord(item.text)) return (this->*item.value)();
  }
  if (accept("aligned_globals")) {
    module_.aligned_globals = true;
    return;
  }
  if (isWord("body") || isWord("init")) return blockBody(isWord("body") ? BodyKind::Block : BodyKind::Init);
  // The others have been read before, or are read later.
  if (!isWord("subrange") && !isWord("test") && !isWord("exit") && !isWord("maker") && !isWord("after_init") &&
      !isWord("safe") && !isWord("dispatch") && !isWord("around_task"))
    record();
}

bool Reader::read() {
  const bool had_errors = diagnostics_.hasErrors();
  findItems();
  auto forEachItem = [&](auto&& f) {
    for (size_t item : items_) {
      at_ = item;
      failed_ = false;
      f();
    }
  };
  forEachItem([&] { declareType(); });
  if (diagnostics_.hasErrors() && !had_errors) return false;
  forEachItem([&] {
    declareItem();
    // The code of a body is read below.
    const bool is_code = !codes_.empty() && codes_.back().at == at_;
    if (!failed_ && !is_code && token().kind != TokenKind::End && !token().first_in_line && !isWord("subrange") &&
        !isWord("test") && !isWord("exit") && !isWord("maker") && !isWord("after_init") && !isWord("safe") &&
        !isWord("dispatch") && !isWord("around_task"))
      expected("the end of the line");
  });
  for (const auto& entry : type_by_name_)
    if (!diagnostics_.hasErrors()) types_.layout(entry.second);
  if (!diagnostics_.hasErrors())
    for (const Data& data : module_.data) types_.layout(data.type);
  linkInits();
  forEachItem([&] { entryOrTest(); });
  forEachItem([&] {
    if (accept("dispatch")) dispatch();
    if (accept("around_task")) taskCalls();
  });
  if (diagnostics_.hasErrors() && !had_errors) return false;
  readCodes();
  const bool ok = !diagnostics_.hasErrors() || had_errors;
  for (uint32_t i = 0; ok && i < types_.count(); ++i) types_.layout(TypeId{i});  // those of locals, too
  return ok;
}

// Lists and instances have the bodies of their records.
void Reader::linkInits() {
  auto initOf = [&](TypeId record) {
    auto found = record_by_type_.find(record.index);
    return found == record_by_type_.end() ? Record{} : module_.records[found->second];
  };
  for (List& list : module_.lists) list.init = initOf(list.record).init;
  for (ProgramInstance& program : module_.programs) {
    program.init = initOf(program.record).init;
    program.body = initOf(program.record).body;
  }
}

// exit, maker, after_init, safe or test, and the body that it names.
void Reader::entryOrTest() {
  const bool is_exit = accept("exit"), is_after_init = !is_exit && accept("after_init");
  const bool is_safe = !is_exit && !is_after_init && accept("safe");
  const bool is_maker = !is_exit && !is_after_init && !is_safe && accept("maker");
  if (!is_exit && !is_after_init && !is_safe && !is_maker && !accept("test")) return;
  const BodyId named = bodyNamed("body");
  if (failed_) return;
  if (is_exit)
    module_.exit = named;
  else if (is_after_init)
    module_.after_init = named;
  else if (is_safe)
    module_.safe = named;
  else if (is_maker)
    module_.makers.push_back(named);
  else
    test(named);
}

void Reader::readCodes() {
  for (const Code& one : codes_) {
    at_ = one.at;
    failed_ = false;
    depth_ = 0;
    Body& body = module_.body(one.body);
    Builder builder(module_, body);
    builder_ = &builder;
    code();
    builder_ = nullptr;
  }
}

// ---- types

bool Reader::atType() const {
  const Token& t = token();
  if (t.kind != TokenKind::Name || t.quoted) return false;
  for (const char* word : {"string", "wstring", "ustring", "array", "pointer", "reference"})
    if (t.text == word) return true;
  for (const TypeKeyword& row : typeKeywords())
    if (t.text == row.word) return true;
  return false;
}

TypeId Reader::typeNamed(const std::string& text, Loc loc) {
  auto found = type_by_name_.find(text);
  if (found != type_by_name_.end()) return found->second;
  fail(diag::IrUnknownName, loc, {text, "type"});
  return types::kError;
}

TypeId Reader::type() {
  if (failed_) return types::kError;
  if (++depth_ > kMaxDepth) {
    fail(diag::IrTooDeep, token().loc, {"1000"});
    return types::kError;
  }
  struct Leave {
    uint32_t& depth;
    ~Leave() { --depth; }
  } leave{depth_};
  if (isPunct("@")) {
    const Loc loc = token().loc;
    const std::string text = sigilName();
    return failed_ ? types::kError : typeNamed(text, loc);
  }
  if (!atType()) {
    expected("a type");
    return types::kError;
  }
  const std::string_view word = tokens_[at_++].text;
  if (word == "string" || word == "wstring" || word == "ustring") {
    expect("[");
    const auto length = static_cast<uint32_t>(integer());
    expect("]");
    return types_.string(word[0] == 'w'   ? types::TypeKind::WString
                         : word[0] == 'u' ? types::TypeKind::UString
                                          : types::TypeKind::String,
                         length);
  }
  if (word == "array") {
    std::vector<Dimension> dimensions;
    expect("[");
    if (!accept("*")) {
      do {
        Dimension dimension;
        dimension.low = integer();
        expect("..");
        dimension.high = integer();
        dimensions.push_back(dimension);
      } while (accept(","));
    }
    expect("]");
    expect("of");
    const TypeId element = type();
    return failed_ ? types::kError : types_.array(element, dimensions);
  }
  if (word == "pointer" || word == "reference") {
    expect("to");
    const TypeId target = type();
    if (failed_) return types::kError;
    return word == "pointer" ? types_.pointer(target) : types_.reference(target);
  }
  for (const TypeKeyword& row : typeKeywords())
    if (word == row.word) return types::idOf(row.kind);
  return types::kError;
}

}  // namespace text_form

bool parse(const Sources& sources, FileId file, Module& module, Diagnostics& diagnostics) {
  return text_form::Reader(sources, file, module, diagnostics).read();
}

}  // namespace rung::ir
