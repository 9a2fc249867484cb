// Reads IR text (docs/ir.md) into a module. Three walks over the items: names of types, then declarations and
// signatures, then code; so an item may use what stands below it. A mistake ends its item and the next one is read.
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "frontend/source/invariant.h"
#include "ir/builder.h"
#include "ir/text.h"
#include "ir/text_lexer.h"
#include "ir/text_words.h"

namespace rung::ir {

using types::Dimension;
using types::Field;
using types::FieldRole;
using types::RecordKind;
using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

namespace {

using namespace text_form;

constexpr uint32_t kMaxDepth = 1000;

class Reader {
 public:
  Reader(const Sources& sources, FileId file, Module& module, Diagnostics& diagnostics)
      : module_(module), types_(module.types), diagnostics_(diagnostics), file_(file) {
    tokens_ = tokenize(sources.text(file), sources.begin(file));
  }
  bool read();

 private:
  using Map = std::unordered_map<uint32_t, uint32_t>;

  // ---- tokens
  const Token& token(size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  bool isPunct(std::string_view text, size_t ahead = 0) const {
    return token(ahead).kind == TokenKind::Punct && token(ahead).text == text;
  }
  bool isWord(std::string_view word, size_t ahead = 0) const {
    return token(ahead).kind == TokenKind::Name && !token(ahead).quoted && token(ahead).text == word;
  }
  bool accept(std::string_view text) {
    if (failed_ || !(isPunct(text) || isWord(text))) return false;
    ++at_;
    return true;
  }
  void expect(std::string_view text) {
    if (!accept(text)) expected(text);
  }
  void expected(std::string_view what);
  void fail(Diag diag, Loc loc, std::initializer_list<std::string_view> args);
  NameId name();            // of anything; a keyword without backticks is none
  std::string sigilName();  // after `@`: `Color`, `Color.2`
  std::string quotedText(TokenKind kind);
  int64_t integer();  // with sign; up to 2^64-1 as bits

  // ---- items
  void findItems();
  void declareType();
  void declareItem();
  void recordFields(TypeId type);
  void record();
  void dataItem();
  void task();
  void instance();
  void located();
  void function();
  void blockBody(BodyKind kind);
  void attributes(Body& body);
  Origin origin();
  void code();

  // ---- types
  TypeId type();
  bool atType() const;
  TypeId typeNamed(const std::string& name, Loc loc);

  // ---- code
  StmtId block();
  void stmt();
  void callStmt(ExprId result);
  void switchStmt();
  ExprId expr(TypeId wanted);
  ExprId primary(TypeId wanted);
  ExprId postfix(ExprId base);
  ExprId literal(TypeId type);
  ExprId variable();
  ExprId afterType(TypeId type);
  std::vector<ExprId> operands(const Body& callee);
  uint8_t checks(ExprId id);
  TypeId typeOf(ExprId id) const { return builder_->body.expr(id).type; }
  uint32_t fieldOf(TypeId record, NameId field);

  Module& module_;
  TypeTable& types_;
  Diagnostics& diagnostics_;
  FileId file_;
  std::vector<Token> tokens_;
  size_t at_ = 0;
  bool failed_ = false;
  uint32_t depth_ = 0;

  std::vector<size_t> items_;
  std::unordered_map<std::string, TypeId> type_by_name_;
  Map list_by_name_, program_by_name_, task_by_name_, body_by_name_, init_by_name_, record_by_type_;
  std::unordered_map<uint64_t, uint32_t> field_by_name_;  // record type and name
  std::vector<bool> fields_known_;                        // by TypeId
  struct Code {
    size_t at;  // of the `{`
    BodyId body;
  };
  std::vector<Code> codes_;

  // of the body at hand
  Builder* builder_ = nullptr;
  Map local_by_name_, temp_by_name_, label_by_name_;
  uint32_t result_ = ~0u;
};

// ---- tokens

void Reader::fail(Diag diag, Loc loc, std::initializer_list<std::string_view> args) {
  if (!failed_) diagnostics_.report(diag, loc, args);
  failed_ = true;
}

void Reader::expected(std::string_view what) {
  const Token& seen = token();
  std::string quoted;
  if (what.size() < 3 || isReserved(what)) quoted = "`" + std::string(what) + "`";
  fail(Diag::IrExpected, seen.loc,
       {quoted.empty() ? what : quoted, seen.kind == TokenKind::End ? std::string_view("end of file") : seen.text});
}

NameId Reader::name() {
  if (failed_) return {};
  const Token& t = token();
  if (t.kind != TokenKind::Name || (!t.quoted && isReserved(t.text))) {
    expected("a name");
    return {};
  }
  ++at_;
  return module_.names.intern(t.quoted ? unescape(t.text) : std::string(t.text));
}

std::string Reader::sigilName() {
  expect("@");
  NameId id = name();
  std::string text(module_.names.text(id));
  if (isPunct(".") && token(1).kind == TokenKind::Number) {
    text += "." + std::string(token(1).text);
    at_ += 2;
  }
  return text;
}

std::string Reader::quotedText(TokenKind kind) {
  if (failed_) return {};
  if (token().kind != kind) {
    expected(kind == TokenKind::Text ? "a text in single quotes" : "a text in double quotes");
    return {};
  }
  return unescape(tokens_[at_++].text);
}

int64_t Reader::integer() {
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

bool isItemWord(std::string_view word) {
  for (const char* item : {"enum", "subrange", "struct", "union", "block", "program", "globals", "image", "data",
                           "list", "task", "instance", "located", "test", "function", "body", "init"})
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
  else if (word != "struct" && word != "enum" && word != "subrange")
    return;
  ++at_;
  const Loc loc = token().loc;
  const std::string text = sigilName();
  if (failed_) return;
  // `@Color.2` is a second type that the user also named Color; `@_` has no name.
  const std::string_view base_name = std::string_view(text).substr(0, text.find('.'));
  const NameId id = base_name == "_" ? NameId{} : module_.names.intern(base_name);
  TypeId made;
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
    made = word == "enum" ? types_.addEnum(id, base) : types_.addSubrange(id, base, low, high);
  } else {
    made = types_.addRecord(kind, id);
  }
  if (!type_by_name_.emplace(text, made).second) fail(Diag::IrRepeatedName, loc, {text});
}

Origin Reader::origin() {
  Origin result;
  result.from_text = true;
  if (failed_ || token().kind != TokenKind::String) return result;
  result.path = module_.names.intern(quotedText(TokenKind::String));
  expect(":");
  result.line = static_cast<uint32_t>(integer());
  return result;
}

// { in up: bool; out ref retain y: real }
void Reader::recordFields(TypeId type_id) {
  expect("{");
  while (!failed_ && !accept("}")) {
    Field field;
    if (accept("in"))
      field.role = FieldRole::Input;
    else if (accept("out"))
      field.role = FieldRole::Output;
    else if (accept("inout"))
      field.role = FieldRole::InOut;
    else if (accept("var"))
      field.role = FieldRole::Local;
    field.by_reference = field.role == FieldRole::InOut;
    if (accept("ref"))
      field.by_reference = true;
    else if (accept("value"))
      field.by_reference = false;
    field.retain = accept("retain");
    field.persistent = accept("persistent");
    field.constant = accept("constant");
    field.name = name();
    expect(":");
    field.type = type();
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
  Record made;
  made.type = type_id;
  made.name = module_.names.intern(text);
  made.loc = loc;
  made.file = file_;
  made.origin = origin();
  made.library = accept("library");
  const bool unlisted = accept("unlisted");
  recordFields(type_id);
  if (failed_ || unlisted) return;
  record_by_type_[type_id.index] = static_cast<uint32_t>(module_.records.size());
  module_.records.push_back(made);
}

void Reader::dataItem() {
  ++at_;
  const Loc loc = token().loc;
  if (static_cast<uint64_t>(integer()) != module_.data.size()) fail(Diag::IrExpected, loc, {"the next number", "this"});
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
      fail(Diag::IrExpected, loc, {"hexadecimal bytes", "this"});
    data.bytes.push_back(byte);
  }
  if (!failed_) module_.data.push_back(std::move(data));
}

void Reader::task() {
  ++at_;
  Task made;
  made.name = name();
  if (accept("cyclic"))
    made.kind = TaskKind::Cyclic;
  else if (accept("freewheeling"))
    made.kind = TaskKind::Freewheeling;
  else if (accept("event"))
    made.kind = TaskKind::Event;
  else if (accept("status"))
    made.kind = TaskKind::Status;
  else if (accept("external"))
    made.kind = TaskKind::External;
  else
    expected("the task's kind");
  if (accept("interval")) made.interval_ns = integer();
  if (accept("priority")) made.priority = static_cast<uint32_t>(integer());
  if (accept("trigger")) made.trigger = quotedText(TokenKind::String);
  if (accept("external")) made.external_event = quotedText(TokenKind::String);
  if (accept("watchdog")) made.watchdog_ns = integer();
  if (accept("sensitivity")) made.sensitivity = static_cast<uint32_t>(integer());
  if (failed_) return;
  task_by_name_[made.name.index] = static_cast<uint32_t>(module_.tasks.size());
  module_.tasks.push_back(std::move(made));
}

void Reader::instance() {
  ++at_;
  expect("$");
  ProgramInstance made;
  made.name = name();
  expect(":");
  made.record = type();
  if (accept("task")) {
    const Loc loc = token().loc;
    const NameId wanted = name();
    auto found = task_by_name_.find(wanted.index);
    if (found == task_by_name_.end())
      fail(Diag::IrUnknownName, loc, {module_.names.text(wanted), "task"});
    else
      made.task = found->second + 1;
  }
  if (accept("resource")) made.resource = name();
  if (accept("configuration")) made.configuration = name();
  if (failed_) return;
  program_by_name_[made.name.index] = static_cast<uint32_t>(module_.programs.size());
  module_.programs.push_back(made);
}

// located start: bool%I0.5 of $Main
void Reader::located() {
  ++at_;
  Located made{};
  if (!accept("_")) made.name = name();
  expect(":");
  made.type = type();
  made.bit = kNoBit;
  expect("%");
  if (failed_) return;
  const std::string_view area = token().text;
  const size_t letter = std::string_view("IQM").find(area.empty() ? '?' : area[0]);
  if (token().kind != TokenKind::Name || letter == std::string_view::npos || area.size() < 2)
    return expected("an area and a byte such as I4");
  std::from_chars(area.data() + 1, area.data() + area.size(), made.byte);
  made.area = static_cast<uint8_t>(letter);
  ++at_;
  if (accept(".")) made.bit = static_cast<uint32_t>(integer());
  if (accept("of")) {
    expect("$");
    const Loc loc = token().loc;
    const NameId wanted = name();
    auto found = program_by_name_.find(wanted.index);
    if (found == program_by_name_.end())
      fail(Diag::IrUnknownName, loc, {module_.names.text(wanted), "program"});
    else
      made.owner_program = found->second + 1;
  }
  if (!failed_) module_.located.push_back(made);
}

void Reader::attributes(Body& body) {
  body.origin = origin();
  body.spelling = accept("as") ? module_.names.intern(quotedText(TokenKind::String)) : body.name;
  if (accept("on")) body.self = type();
  if (accept("native")) {
    body.native = true;
    if (!accept("_")) body.library_name = name();
  }
  body.pure = accept("pure");
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
    if (accept("out"))
      kind = LocalKind::Output;
    else if (accept("inout"))
      kind = LocalKind::InOut;
    else
      expect("in");
    const NameId local = name();
    expect(":");
    const TypeId local_type = type();
    if (!failed_) builder.local(local, local_type, kind);
  }
  if (failed_) return;
  if (!body_by_name_.emplace(body.name.index, id.index).second)
    fail(Diag::IrRepeatedName, body.loc, {module_.names.text(body.name)});
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
    if (module_.body(known).kind != BodyKind::Function) return fail(Diag::IrRepeatedName, loc, {text});
    for (const Code& code : codes_)
      if (code.body == known) return fail(Diag::IrRepeatedName, loc, {text});
    codes_.push_back({at_, known});
    return;
  }
  auto record_type = type_by_name_.find(text);
  if (record_type == type_by_name_.end())
    return fail(Diag::IrUnknownName, loc, {text, kind == BodyKind::Init ? "record" : "function or block"});
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

void Reader::declareItem() {
  if (isWord("enum")) {
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
  } else if (isWord("image")) {
    ++at_;
    for (int area = 0; area < 3; ++area) {
      constexpr std::string_view kAreas[] = {"I", "Q", "M"};
      expect(kAreas[area]);
      module_.image_bytes[area] = static_cast<uint32_t>(integer());
    }
  } else if (isWord("list")) {
    ++at_;
    expect("@");
    List made;
    made.name = name();
    expect(":");
    made.record = type();
    if (failed_) return;
    list_by_name_[made.name.index] = static_cast<uint32_t>(module_.lists.size());
    module_.lists.push_back(made);
  } else if (isWord("data")) {
    dataItem();
  } else if (isWord("task")) {
    task();
  } else if (isWord("instance")) {
    instance();
  } else if (isWord("located")) {
    located();
  } else if (isWord("function")) {
    function();
  } else if (isWord("body") || isWord("init")) {
    blockBody(isWord("body") ? BodyKind::Block : BodyKind::Init);
  } else if (!isWord("subrange") && !isWord("test")) {
    record();
  }
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
        !isWord("test"))
      expected("the end of the line");
  });
  for (const auto& entry : type_by_name_)
    if (!diagnostics_.hasErrors()) types_.layout(entry.second);
  if (!diagnostics_.hasErrors())
    for (const Data& data : module_.data) types_.layout(data.type);
  auto initOf = [&](TypeId record) {
    auto found = record_by_type_.find(record.index);
    return found == record_by_type_.end() ? Record{} : module_.records[found->second];
  };
  for (List& list : module_.lists) list.init = initOf(list.record).init;
  for (ProgramInstance& program : module_.programs) {
    program.init = initOf(program.record).init;
    program.body = initOf(program.record).body;
  }
  forEachItem([&] {
    if (!accept("test")) return;
    const Loc loc = token().loc;
    const std::string text = sigilName();
    auto found = body_by_name_.find(module_.names.intern(text).index);
    if (found == body_by_name_.end()) return fail(Diag::IrUnknownName, loc, {text, "body"});
    module_.tests.push_back(BodyId{found->second});
  });
  if (diagnostics_.hasErrors() && !had_errors) return false;
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
  return !diagnostics_.hasErrors() || had_errors;
}

// ---- types

bool Reader::atType() const {
  const Token& t = token();
  if (t.kind != TokenKind::Name || t.quoted) return false;
  for (const char* word : {"string", "wstring", "array", "pointer", "reference"})
    if (t.text == word) return true;
  for (const TypeWord& row : typeWords())
    if (t.text == row.word) return true;
  return false;
}

TypeId Reader::typeNamed(const std::string& text, Loc loc) {
  auto found = type_by_name_.find(text);
  if (found != type_by_name_.end()) return found->second;
  fail(Diag::IrUnknownName, loc, {text, "type"});
  return types::kError;
}

TypeId Reader::type() {
  if (failed_) return types::kError;
  if (++depth_ > kMaxDepth) {
    fail(Diag::IrTooDeep, token().loc, {"1000"});
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
  if (word == "string" || word == "wstring") {
    expect("[");
    const auto length = static_cast<uint32_t>(integer());
    expect("]");
    return word == "string" ? types_.string(length) : types_.wstring(length);
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
  for (const TypeWord& row : typeWords())
    if (word == row.word) return types::idOf(row.kind);
  return types::kError;
}

// ---- code

void Reader::code() {
  Body& body = builder_->body;
  local_by_name_.clear();
  temp_by_name_.clear();
  label_by_name_.clear();
  result_ = ~0u;
  for (uint32_t i = 0; i < body.locals.size(); ++i) {
    if (body.locals[i].kind == LocalKind::Result)
      result_ = i;
    else if (!local_by_name_.emplace(body.locals[i].name.index, i).second)
      fail(Diag::IrRepeatedName, body.locals[i].loc, {module_.names.text(body.locals[i].name)});
  }
  const StmtId first = block();
  body.first = first;
  if (!failed_ && !token().first_in_line) expected("the end of the line");
}

StmtId Reader::block() {
  const Block outer = builder_->open();
  if (++depth_ > kMaxDepth) fail(Diag::IrTooDeep, token().loc, {"1000"});
  expect("{");
  while (!failed_ && !accept("}")) stmt();
  --depth_;
  return builder_->close(outer);
}

void Reader::stmt() {
  Builder& b = *builder_;
  b.loc = token().loc;
  if (accept("temp") || accept("var")) {
    const bool is_temp = tokens_[at_ - 1].text == "temp";
    const Loc loc = token().loc;
    const NameId id = name();
    expect(":");
    const TypeId local_type = type();
    if (failed_) return;
    const uint32_t index = b.local(id, local_type, is_temp ? LocalKind::Temp : LocalKind::Variable);
    if (!(is_temp ? temp_by_name_ : local_by_name_).emplace(id.index, index).second)
      fail(Diag::IrRepeatedName, loc, {module_.names.text(id)});
  } else if (accept("bind")) {
    const ExprId field = expr({});
    expect("=");
    const ExprId place = expr({});
    if (!failed_) b.bind(field, place);
  } else if (accept("call")) {
    callStmt({});
  } else if (accept("if")) {
    const Loc loc = b.loc;
    const ExprId condition = expr(types::kBool);
    const StmtId then_block = block();
    const StmtId else_block = accept("else") ? block() : StmtId{};
    b.loc = loc;
    if (!failed_) b.ifElse(condition, then_block, else_block);
  } else if (accept("switch")) {
    switchStmt();
  } else if (accept("loop")) {
    const Loc loc = b.loc;
    const StmtId body_block = block();
    const StmtId next_block = accept("next") ? block() : StmtId{};
    b.loc = loc;
    if (!failed_) b.loop(body_block, next_block);
  } else if (accept("for")) {
    const Loc loc = b.loc;
    const ExprId control = expr({});
    if (failed_) return;
    const TypeId control_type = typeOf(control);
    expect("=");
    const ExprId from = expr(control_type);
    expect("to");
    const ExprId to = expr(control_type);
    expect("by");
    const ExprId step = expr(control_type);
    const StmtId body_block = block();
    b.loc = loc;
    if (!failed_) b.forLoop(control, from, to, step, body_block);
  } else if (accept("break")) {
    b.breakLoop();
  } else if (accept("continue")) {
    b.continueLoop();
  } else if (accept("return")) {
    if (!token().first_in_line && !isPunct("}")) {
      if (result_ == ~0u) return fail(Diag::IrUnknownName, b.loc, {"result", "local"});
      const ExprId place = b.localPlace(result_);
      const ExprId value = expr(typeOf(place));
      if (!failed_) b.assign(place, value);
    }
    if (!failed_) b.returnBody();
  } else if (isWord("jump") || isWord("label")) {
    const bool is_jump = isWord("jump");
    ++at_;
    const NameId id = name();
    if (failed_) return;
    auto [found, is_new] = label_by_name_.emplace(id.index, 0);
    if (is_new) found->second = b.label(id);
    is_jump ? b.jump(found->second) : b.placeLabel(found->second);
  } else if (accept("try")) {
    const Loc loc = b.loc;
    const StmtId body_block = block();
    expect("catch");
    const ExprId number = isPunct("{") ? ExprId{} : expr({});
    const StmtId catch_block = block();
    const StmtId finally_block = accept("finally") ? block() : StmtId{};
    b.loc = loc;
    if (!failed_) b.tryCatch(body_block, catch_block, finally_block, number);
  } else if (accept("fault")) {
    constexpr types::Fault kFaults[] = {types::Fault::Div,     types::Fault::Index,    types::Fault::Null,
                                        types::Fault::Cast,    types::Fault::Subrange, types::Fault::Convert,
                                        types::Fault::Overflow};
    auto kind = types::Fault::None;
    for (types::Fault one : kFaults)
      if (isWord(types::word(one))) kind = one;
    if (kind == types::Fault::None) return expected("the fault's kind");
    ++at_;
    ExprId value;
    if (!token().first_in_line && accept("(")) {
      value = expr({});
      expect(")");
    }
    if (!failed_) b.fault(kind, value);
  } else if (isWord("assert") || isWord("assert_eq") || isWord("assert_near")) {
    const auto what = isWord("assert")      ? Assertion::Assert
                      : isWord("assert_eq") ? Assertion::AssertEq
                                            : Assertion::AssertNear;
    ++at_;
    const ExprId first = expr(what == Assertion::Assert ? types::kBool : TypeId{});
    ExprId second, third;
    if (failed_) return;
    const TypeId first_type = typeOf(first);
    if (what != Assertion::Assert) {
      expect(",");
      second = expr(first_type);
    }
    if (what == Assertion::AssertNear) {
      expect(",");
      third = expr(first_type);
    }
    NameId text;
    if (accept("text")) text = module_.names.intern(quotedText(TokenKind::Text));
    if (!failed_) b.assertion(what, first, second, third, text);
  } else if (accept("evaluate")) {
    const ExprId value = expr({});
    if (!failed_) b.evaluate(value);
  } else {
    const Loc loc = b.loc;
    const ExprId place = expr({});
    expect("=");
    if (failed_) return;
    if (accept("call")) return callStmt(place);
    const ExprId value = expr(typeOf(place));
    b.loc = loc;
    if (!failed_) b.assign(place, value);
  }
}

// call @F(a, _)   call @Ramp on r   call init @Ramp on r
void Reader::callStmt(ExprId result) {
  Builder& b = *builder_;
  const Loc loc = b.loc;
  const bool is_init = accept("init");
  const Loc name_loc = token().loc;
  const std::string text = sigilName();
  if (failed_) return;
  const Map& by_name = is_init ? init_by_name_ : body_by_name_;
  auto found = by_name.find(module_.names.intern(text).index);
  if (found == by_name.end()) return fail(Diag::IrUnknownName, name_loc, {text, "body"});
  const BodyId callee{found->second};
  std::vector<ExprId> given;
  if (isPunct("(") && !token().first_in_line) given = operands(module_.body(callee));
  const ExprId self = accept("on") ? expr({}) : ExprId{};
  b.loc = loc;
  if (!failed_) b.callStmt(callee, self, given, result);
}

std::vector<ExprId> Reader::operands(const Body& callee) {
  std::vector<ExprId> given;
  expect("(");
  if (accept(")")) return given;
  size_t parameter = 0;
  do {
    auto isParameter = [&](const Local& local) {
      return local.kind == LocalKind::Input || local.kind == LocalKind::Output || local.kind == LocalKind::InOut;
    };
    while (parameter < callee.locals.size() && !isParameter(callee.locals[parameter])) ++parameter;
    const TypeId wanted = parameter < callee.locals.size() ? callee.locals[parameter].type : TypeId{};
    ++parameter;
    given.push_back(accept("_") ? ExprId{} : expr(wanted));
  } while (accept(","));
  expect(")");
  return given;
}

void Reader::switchStmt() {
  Builder& b = *builder_;
  const Loc loc = b.loc;
  const ExprId selector = expr({});
  std::vector<Case> cases;
  StmtId else_block;
  expect("{");
  while (!failed_ && accept("case")) {
    std::vector<CaseRange> ranges;
    do {
      CaseRange range;
      range.low = integer();
      range.high = accept("..") ? integer() : range.low;
      ranges.push_back(range);
    } while (accept(","));
    const StmtId case_block = block();
    cases.push_back(b.makeCase(ranges, case_block));
  }
  if (accept("else")) else_block = block();
  expect("}");
  b.loc = loc;
  if (!failed_) b.switchStmt(selector, cases, else_block);
}

// `!` or `!(div, overflow)`
uint8_t Reader::checks(ExprId id) {
  if (failed_ || !isPunct("!") || token().first_in_line) return 0;
  ++at_;
  if (!isPunct("(") || token().first_in_line) return naturalCheck(types_, builder_->body.expr(id));
  uint8_t result = 0;
  expect("(");
  do {
    bool known = false;
    for (const CheckWord& row : checkWords()) {
      if (!isWord(row.word)) continue;
      result |= row.check;
      known = true;
    }
    if (!known) expected("the name of a check");
    ++at_;
  } while (!failed_ && accept(","));
  expect(")");
  return result;
}

uint32_t Reader::fieldOf(TypeId record_type, NameId field) {
  if (fields_known_.size() < types_.count()) fields_known_.resize(types_.count());
  const std::vector<Field>& fields = types_.info(record_type).fields;
  if (!fields_known_[record_type.index]) {
    fields_known_[record_type.index] = true;
    for (uint32_t i = 0; i < fields.size(); ++i)
      field_by_name_.emplace(uint64_t{record_type.index} << 32 | fields[i].name.index, i);
  }
  auto found = field_by_name_.find(uint64_t{record_type.index} << 32 | field.index);
  return found == field_by_name_.end() ? ~0u : found->second;
}

// expr := primary postfix*
ExprId Reader::expr(TypeId wanted) {
  if (failed_) return {};
  if (++depth_ > kMaxDepth) {
    fail(Diag::IrTooDeep, token().loc, {"1000"});
    return {};
  }
  ExprId id = primary(wanted ? types_.resolve(wanted) : wanted);
  --depth_;
  return failed_ ? ExprId{} : id;
}

ExprId Reader::primary(TypeId wanted) {
  Builder& b = *builder_;
  b.loc = token().loc;
  if (accept("(")) {
    const ExprId inner = expr(wanted);
    expect(")");
    return postfix(inner);
  }
  if (isPunct("@")) {
    // A type before `#` or `%`, a function before `(`, else a global list.
    const size_t start = at_;
    const Loc loc = token().loc;
    const std::string text = sigilName();
    if (failed_) return {};
    if (isPunct("#") || isPunct("%")) {
      at_ = start;
      const TypeId of = type();
      return failed_ ? ExprId{} : afterType(of);
    }
    const NameId id = module_.names.intern(text);
    if (isPunct("(") && !token().first_in_line) {
      auto found = body_by_name_.find(id.index);
      if (found == body_by_name_.end()) {
        fail(Diag::IrUnknownName, loc, {text, "function"});
        return {};
      }
      const std::vector<ExprId> given = operands(module_.body(BodyId{found->second}));
      b.loc = loc;
      return failed_ ? ExprId{} : postfix(b.call(BodyId{found->second}, given));
    }
    auto found = list_by_name_.find(id.index);
    if (found == list_by_name_.end()) {
      fail(Diag::IrUnknownName, loc, {text, "list"});
      return {};
    }
    return postfix(b.global(found->second));
  }
  if (accept("$")) {
    const Loc loc = token().loc;
    const NameId id = name();
    auto found = program_by_name_.find(id.index);
    if (!failed_ && found == program_by_name_.end())
      fail(Diag::IrUnknownName, loc, {module_.names.text(id), "program"});
    return failed_ ? ExprId{} : postfix(b.program(found->second));
  }
  if (accept("%")) {
    const Loc loc = token().loc;
    const NameId id = name();
    auto found = temp_by_name_.find(id.index);
    if (!failed_ && found == temp_by_name_.end()) fail(Diag::IrUnknownName, loc, {module_.names.text(id), "temp"});
    return failed_ ? ExprId{} : postfix(b.localPlace(found->second));
  }
  if (token().kind == TokenKind::Number || token().kind == TokenKind::Text || isPunct("-")) return literal(wanted);
  if (token().kind != TokenKind::Name) {
    expected("an expression");
    return {};
  }
  if (token().quoted) return variable();
  if (atType()) {
    const TypeId of = type();
    return failed_ ? ExprId{} : afterType(of);
  }
  for (const char* word : {"true", "false", "inf", "nan", "null", "zero"})
    if (isWord(word)) return literal(wanted);
  const Loc loc = b.loc;
  if (accept("data")) {
    const auto number = static_cast<uint64_t>(integer());
    if (!failed_ && number >= module_.data.size()) fail(Diag::IrUnknownName, loc, {"data", "data item"});
    return failed_ ? ExprId{} : b.data(static_cast<uint32_t>(number));
  }
  if (accept("self")) {
    if (!b.body.self) {
      fail(Diag::IrUnknownName, loc, {"self", "instance"});
      return {};
    }
    return postfix(b.self());
  }
  if (accept("result")) {
    if (result_ == ~0u) {
      fail(Diag::IrUnknownName, loc, {"result", "local"});
      return {};
    }
    return postfix(b.localPlace(result_));
  }
  auto finish = [&](ExprId id, uint8_t set) {
    if (id) b.body.expr(id).checks = set;
    return id;
  };
  // The checks stand after the word, before the type is known: read as if the node were there.
  if (accept("convert")) {
    const size_t mark = at_;
    const bool checked = isPunct("!");
    if (checked) {  // passed over, and read again below
      ++at_;
      if (isPunct("("))
        while (token().kind != TokenKind::End && !accept(")")) ++at_;
    }
    const TypeId to = type();
    const ExprId operand = expr({});
    if (failed_) return {};
    b.loc = loc;
    const ExprId id = b.convert(to, operand);
    const size_t end = at_;
    at_ = mark;
    const uint8_t set = checks(id);
    at_ = end;
    return finish(id, set);
  }
  if (accept("select")) {
    const TypeId of = type();
    const ExprId condition = expr(types::kBool);
    expect(",");
    const ExprId yes = expr(of);
    expect(",");
    const ExprId no = expr(of);
    if (failed_) return {};
    b.loc = loc;
    const ExprId id = b.select(condition, yes, no);
    b.body.expr(id).type = types_.resolve(of);
    return id;
  }
  if (accept("address")) {
    const TypeId of = type();
    const ExprId place = expr({});
    b.loc = loc;
    return failed_ ? ExprId{} : b.address(of, place);
  }
  Op op;
  if (types::findOp(token().text, op)) {
    ++at_;
    const bool is_unary = types::operandCount(op) == 1;
    Expr shape;
    shape.kind = is_unary ? ExprKind::Unary : ExprKind::Binary;
    shape.op = op;
    b.body.exprs.resize(std::max<size_t>(b.body.exprs.size(), 1));
    b.body.exprs[0] = shape;
    const uint8_t set = checks(ExprId{0});
    b.body.exprs[0] = Expr{};
    const TypeId of = type();
    const ExprId first = expr(of);
    ExprId second;
    if (!is_unary) {
      expect(",");
      second = expr(of);
    }
    if (failed_) return {};
    b.loc = loc;
    const ExprId id = is_unary ? b.unary(op, first) : b.binary(op, first, second);
    if (!types::isComparison(op)) b.body.expr(id).type = types_.resolve(of);
    return finish(id, set);
  }
  return variable();
}

// A local, or a field of self.
ExprId Reader::variable() {
  Builder& b = *builder_;
  const Loc loc = token().loc;
  const NameId id = name();
  if (failed_) return {};
  if (auto found = local_by_name_.find(id.index); found != local_by_name_.end())
    return postfix(b.localPlace(found->second));
  const uint32_t field = b.body.self ? fieldOf(b.body.self, id) : ~0u;
  if (field == ~0u) {
    fail(Diag::IrUnknownName, loc, {module_.names.text(id), "variable"});
    return {};
  }
  const ExprId place = b.field(b.self(), field);
  b.body.expr(place).checks = checks(place);
  return postfix(place);
}

// int#3   @Color#Red   bool%I0.5
ExprId Reader::afterType(TypeId of) {
  Builder& b = *builder_;
  if (accept("#")) return literal(types_.resolve(of));
  expect("%");
  if (failed_) return {};
  const std::string_view area = token().text;
  const size_t letter = std::string_view("IQM").find(area.empty() ? '?' : area[0]);
  if (token().kind != TokenKind::Name || letter == std::string_view::npos || area.size() < 2) {
    expected("an area and a byte such as I4");
    return {};
  }
  uint32_t byte = 0, bit = kNoBit;
  std::from_chars(area.data() + 1, area.data() + area.size(), byte);
  ++at_;
  if (isPunct(".") && token(1).kind == TokenKind::Number) {
    ++at_;
    bit = static_cast<uint32_t>(integer());
  }
  return failed_ ? ExprId{} : postfix(b.image(of, static_cast<uint32_t>(letter), byte, bit));
}

ExprId Reader::literal(TypeId of) {
  Builder& b = *builder_;
  if (failed_) return {};
  b.loc = token().loc;
  const Loc loc = b.loc;
  auto kindOf = [&](TypeId id) { return id ? types_.plainKind(id) : TypeKind::None; };
  auto misfit = [&](std::string_view seen) {
    fail(Diag::IrLiteralType, loc, {seen, of ? types_.spell(of) : "an unknown type"});
    return ExprId{};
  };
  if (token().kind == TokenKind::Text) {
    if (!TypeTable::isText(kindOf(of))) return misfit("a text");
    return b.text(of, module_.names.intern(quotedText(TokenKind::Text)));
  }
  if (accept("zero")) return of ? b.zero(of) : misfit("zero");
  if (isWord("true") || isWord("false")) {
    const bool value = tokens_[at_++].text == "true";
    if (!of) of = types::kBool;
    return kindOf(of) == TypeKind::Bool ? b.constant(of, value) : misfit(value ? "true" : "false");
  }
  if (accept("null")) {
    const TypeKind kind = kindOf(of);
    return kind == TypeKind::Pointer || kind == TypeKind::Reference ? b.constant(of, 0) : misfit("null");
  }
  if (token().kind == TokenKind::Name && of && types_.kind(of) == TypeKind::Enum) {
    const NameId item = name();
    for (const auto& [item_name, value] : types_.info(of).items)
      if (item_name == item) return b.integer(of, value);
    fail(Diag::IrUnknownName, loc, {module_.names.text(item), "item"});
    return {};
  }
  const bool negative = accept("-");
  if (accept("inf")) {
    if (!of) of = types::kReal;
    return TypeTable::isReal(kindOf(of)) ? b.real(of, negative ? -INFINITY : INFINITY) : misfit("inf");
  }
  if (!negative && accept("nan")) {
    if (!of) of = types::kReal;
    if (!TypeTable::isReal(kindOf(of))) return misfit("nan");
    if (!isPunct("(") || token().first_in_line) return b.real(of, std::nan(""));
    expect("(");
    const auto bits = static_cast<uint64_t>(integer());
    expect(")");
    return failed_ ? ExprId{} : b.constant(of, bits);
  }
  if (token().kind != TokenKind::Number) {
    expected("a literal");
    return {};
  }
  const std::string_view text = token().text;
  const bool is_integer = text.find_first_of(".eE") == std::string_view::npos;
  if (!of) of = is_integer ? kDefaultInteger : types::kReal;
  const TypeKind kind = kindOf(of);
  if (TypeTable::isReal(kind)) {
    double value = 0;
    if (kind == TypeKind::Real) {
      float narrow = 0;
      std::from_chars(text.data(), text.data() + text.size(), narrow);
      value = narrow;
    } else {
      std::from_chars(text.data(), text.data() + text.size(), value);
    }
    ++at_;
    return b.real(of, negative ? -value : value);
  }
  const bool is_pointer = kind == TypeKind::Pointer || kind == TypeKind::Reference;
  uint64_t magnitude = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), magnitude);
  if (!is_integer || parsed.ec != std::errc() || (!TypeTable::isScalar(kind) && !is_pointer)) return misfit(text);
  ++at_;
  const uint32_t width = is_pointer ? 64 : TypeTable::bitWidth(kind);
  const bool is_signed = types_.isSigned(kind);
  const uint64_t limit = is_signed ? (uint64_t{1} << (width - 1)) - (negative ? 0 : 1)
                                   : (width >= 64 ? ~uint64_t{0} : (uint64_t{1} << width) - 1);
  if (magnitude > limit || (negative && !is_signed && magnitude != 0)) return misfit(text);
  return b.constant(of, negative ? 0 - magnitude : magnitude);
}

ExprId Reader::postfix(ExprId base) {
  Builder& b = *builder_;
  while (!failed_ && base) {
    b.loc = token().loc;
    const TypeInfo& info = types_.info(types_.resolve(typeOf(base)));
    auto need = [&](bool holds, std::string_view access, std::string_view what) {
      if (!holds) fail(Diag::IrWrongBase, b.loc, {access, what, types_.spell(typeOf(base))});
      return holds;
    };
    ExprId made;
    if (isPunct(".") && isPunct("%", 1) && token(2).kind == TokenKind::Name) {
      at_ += 2;
      const std::string_view part = token().text;
      const TypeKind kind = part[0] == 'X'   ? TypeKind::Bool
                            : part[0] == 'B' ? TypeKind::Byte
                            : part[0] == 'W' ? TypeKind::Word
                            : part[0] == 'D' ? TypeKind::DWord
                                             : TypeKind::None;
      uint32_t position = 0;
      const auto parsed = std::from_chars(part.data() + 1, part.data() + part.size(), position);
      if (kind == TypeKind::None || parsed.ec != std::errc() || parsed.ptr != part.data() + part.size()) {
        expected("X, B, W or D and a position");
        return {};
      }
      ++at_;
      made = b.bits(base, types::idOf(kind), position);
    } else if (isPunct(".") && token(1).kind == TokenKind::Name) {
      ++at_;
      const Loc loc = token().loc;
      const NameId id = name();
      if (failed_ || !need(info.kind == TypeKind::Record, "`.`", "a record")) return {};
      const uint32_t field = fieldOf(types_.resolve(typeOf(base)), id);
      if (field == ~0u) {
        fail(Diag::IrUnknownName, loc, {module_.names.text(id), "field"});
        return {};
      }
      made = b.field(base, field);
    } else if (isPunct("[") && !token().first_in_line) {
      if (!need(info.kind == TypeKind::Array, "`[`", "an array")) return {};
      const Loc loc = b.loc;
      ++at_;
      std::vector<ExprId> indices;
      do indices.push_back(expr({}));
      while (accept(","));
      expect("]");
      if (failed_) return {};
      b.loc = loc;
      made = b.index(base, indices);
    } else if (isPunct("^")) {
      if (!need(info.kind == TypeKind::Pointer || info.kind == TypeKind::Reference, "`^`", "a pointer")) return {};
      ++at_;
      made = b.deref(base);
    } else {
      return base;
    }
    const uint8_t set = checks(made);
    b.body.expr(made).checks = set;
    base = made;
  }
  return base;
}

}  // namespace

bool parse(const Sources& sources, FileId file, Module& module, Diagnostics& diagnostics) {
  return Reader(sources, file, module, diagnostics).read();
}

}  // namespace rung::ir
