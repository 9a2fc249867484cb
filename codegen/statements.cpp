// Statements of a body and their lines: see body.h. The lines of the generated code follow those of the source; `#line`
// appears only where they diverge, which keeps the code small.
#include <algorithm>

#include "codegen/body.h"
#include "ir/assertion.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::codegen {

using types::Fault;

namespace {

constexpr uint32_t kMaxBlankLines = 6, kAnyLines = ~0u;
constexpr uint32_t kDeepestIndent = 40;
constexpr uint32_t kDeepestBraces = 200;  // clang++ takes 256

size_t indentOf(uint32_t depth) { return 2 * static_cast<size_t>(std::min(depth, kDeepestIndent)); }

struct Position {
  FileId file;
  uint32_t line = 0;
};

Position positionOf(const ir::Module& module, const ir::Body& body, Loc loc) {
  if (body.origin.path) return {{}, body.origin.line};
  if (!loc) return {};
  const SourceLocation location = module.sources.location(loc);
  return {location.file, location.line};
}

}  // namespace

// ---- lines

// Writes the pending braces, at most `lines` of them on separate lines.
void BodyWriter::flushCloses(uint32_t lines) {
  for (; closes_ > 0; --closes_) {
    if (lines > 0) {
      out_ += '\n';
      out_.append(indentOf(depth_ + closes_ - 1), ' ');
      if (line_ != 0) ++line_;
      --lines;
    } else {
      out_ += ' ';
    }
    out_ += '}';
  }
}

void BodyWriter::begin(Loc loc) {
  const Position at = options_.line_directives ? positionOf(module_, *body_, loc) : Position{};
  const size_t indent = indentOf(depth_);
  if (at.line == 0) {
    flushCloses(kAnyLines);
    out_ += '\n';
    if (line_ != 0) ++line_;
    out_.append(indent, ' ');
    return;
  }
  const bool same_file = line_ != 0 && at.file == line_file_;
  if (same_file && at.line == line_) {
    flushCloses(0);
    out_ += ' ';
    return;
  }
  if (same_file && at.line > line_ && at.line - line_ <= kMaxBlankLines + closes_) {
    flushCloses(at.line - line_ - 1);
    out_.append(at.line - line_, '\n');
  } else {
    flushCloses(kAnyLines);
    out_ += "\n#line ";
    appendUnsigned(out_, at.line);
    if (!same_file) {
      out_ += ' ';
      appendQuoted(out_, body_->origin.path ? string(body_->origin.path) : module_.sources.path(at.file));
    }
    out_ += '\n';
  }
  out_.append(indent, ' ');
  line_ = at.line;
  line_file_ = at.file;
}

void BodyWriter::open() {
  out_ += " {";
  ++depth_;
}

void BodyWriter::close() {
  --depth_;
  ++closes_;
}

// ---- statements

void BodyWriter::block(StmtId first) {
  const size_t mark = known_.size();
  for (StmtId id = first; id; id = body_->stmt(id).next) statement(id, body_->stmt(id));
  forgetLengths(mark);
}

void BodyWriter::statement(StmtId id, const Stmt& stmt) {
  if (stmt.kind == StmtKind::Call && facts_.is_zeroing[stmt.a] != 0) {
    // An initialiser begins by clearing the whole record.
    if (body_->kind == ir::BodyKind::Init && expr(ir::rootOf(*body_, ExprId{stmt.b})).kind == ExprKind::Self) return;
    begin(stmt.loc);
    prepare(ExprId{stmt.b});
    const std::string name = captured([&] { place(ExprId{stmt.b}); });
    out_ += "memset(&" + name + ", 0, sizeof " + name + ");";
    return;
  }
  begin(stmt.loc);
  measure(stmt);
  switch (stmt.kind) {
    case StmtKind::None: out_ += ';'; return;
    case StmtKind::Assign: assign(stmt); return;
    case StmtKind::Bind: {
      prepareChildren(expr(ExprId{stmt.a}));  // the field itself holds no variable yet
      if (stmt.b != 0) prepare(ExprId{stmt.b});
      const Expr& field = expr(ExprId{stmt.a});
      member(ExprId{field.a});
      const types::Field& info = types_.info(types_.resolve(expr(ExprId{field.a}).type)).fields[field.b];
      appendMangled(out_, string(info.name));
      out_ += " = ";
      if (stmt.b == 0) {
        out_ += "nullptr";
      } else if (isString(info.type)) {
        place(ExprId{stmt.b});
      } else {
        // The variable may have another type with the same memory.
        out_ += '(';
        appendPointer(out_, types_, info.type, "");
        out_ += ")&";
        place(ExprId{stmt.b});
      }
      out_ += ';';
      return;
    }
    case StmtKind::Call: callStatement(stmt); return;
    case StmtKind::If: ifStatement(stmt); return;
    case StmtKind::Switch: switchStatement(stmt); return;
    case StmtKind::Loop: loopStatement(id, stmt); return;
    case StmtKind::For: forStatement(id, stmt); return;
    case StmtKind::Break: breakLoop(); return;
    case StmtKind::Continue: continueLoop(); return;
    case StmtKind::Return: leave(); return;
    case StmtKind::Jump:
      out_ += "goto ";
      appendMangled(out_, string(body_->labels[stmt.a]));
      out_ += ';';
      return;
    case StmtKind::Label:
      appendMangled(out_, string(body_->labels[stmt.a]));
      out_ += ":;";
      return;
    case StmtKind::Try: tryStatement(stmt); return;
    case StmtKind::Fault: faultStatement(stmt); return;
    case StmtKind::Assert: assertStatement(stmt); return;
    case StmtKind::Evaluate: prepare(ExprId{stmt.a}); return;
  }
}

// `return`, after the locals are written back; in the frame of a try the frame's caller does that.
void BodyWriter::leave() {
  if (!frames_.empty()) {
    frames_.back().returns = true;
    out_ += frames_.back().exit;
    out_ += " = 1; return;";
    return;
  }
  for (const ir::Local& local : body_->locals) {
    if (local.kind != ir::LocalKind::Result || local.by_reference) continue;
    out_ += "return ";
    variable(out_, local);
    out_ += ';';
    return;
  }
  const bool has_written =
      std::any_of(fields_.begin(), fields_.end(), [](const Variable& v) { return v.cached && v.written; });
  if (has_written) uses_leave_ = true;
  out_ += has_written ? "goto leave;" : "return;";
}

bool BodyWriter::endsInJump(StmtId first) const {
  StmtKind last = StmtKind::None;
  for (StmtId id = first; id; id = body_->stmt(id).next) last = body_->stmt(id).kind;
  return last == StmtKind::Break || last == StmtKind::Continue || last == StmtKind::Return || last == StmtKind::Jump ||
         last == StmtKind::Fault;
}

// Without braces: every variable is declared at the top, so jumps cross no initialisation.
void BodyWriter::deepIf(const Stmt& stmt) {
  const std::string otherwise = newName("else"), end = newName("end");
  prepare(ExprId{stmt.a});
  out_ += "if (!";
  condition(ExprId{stmt.a}, Prec::Unary);
  out_ += ") goto " + otherwise + ";";
  block(StmtId{stmt.b});
  flushCloses(0);
  if (stmt.c != 0) out_ += " goto " + end + ";";
  out_ += " " + otherwise + ":;";
  if (stmt.c == 0) return;
  block(StmtId{stmt.c});
  flushCloses(0);
  out_ += " " + end + ":;";
}

void BodyWriter::ifStatement(const Stmt& stmt) {
  const Stmt* at = &stmt;
  for (;;) {
    if (depth_ > kDeepestBraces) {
      deepIf(*at);
      return;
    }
    prepare(ExprId{at->a});
    out_ += "if (";
    condition(ExprId{at->a}, Prec::Comma);
    out_ += ')';
    open();
    block(StmtId{at->b});
    close();
    if (at->c == 0) return;
    const Stmt& other = body_->stmt(StmtId{at->c});
    // A brace gets its own line where the source leaves room for it.
    const Position next = options_.line_directives ? positionOf(module_, *body_, other.loc) : Position{};
    uint32_t room = kAnyLines;
    if (next.line != 0 && line_ != 0 && next.file == line_file_) {
      room = next.line > line_ ? next.line - line_ - 1 : 0;
      if (room > kMaxBlankLines) room = kAnyLines;
    }
    flushCloses(room);
    out_ += " else";
    const bool is_chain = other.kind == StmtKind::If && !other.next && !needsPreparation(ExprId{other.a}) &&
                          !needsMeasuring(ExprId{other.a});
    if (!is_chain) {
      open();
      block(StmtId{at->c});
      close();
      return;
    }
    if (next.line != 0 && line_ != 0 && next.line == line_ + 1 && next.file == line_file_) {
      out_ += '\n';
      out_.append(indentOf(depth_), ' ');
      ++line_;
    } else {
      out_ += ' ';
    }
    at = &other;
  }
}

void BodyWriter::switchStatement(const Stmt& stmt) {
  prepare(ExprId{stmt.a});
  const TypeKind kind = kindOf(ExprId{stmt.a});
  const bool is_unsigned = !types_.isSigned(kind);
  out_ += "switch (";
  if (kind == TypeKind::Bool) out_ += "(int)";
  value(ExprId{stmt.a}, kind == TypeKind::Bool ? Prec::Unary : Prec::Comma);
  out_ += ')';
  open();
  const bool had_loop = !loops_.empty();
  const bool was_in_switch = had_loop && loops_.back().in_switch;
  if (had_loop) loops_.back().in_switch = true;

  // The first case that holds a value takes it: later ranges keep the rest.
  struct Range {
    uint64_t low, high;  // order-preserving
  };
  const uint64_t flip = is_unsigned ? 0 : uint64_t{1} << 63;
  std::vector<Range> taken;
  std::vector<Range> rest;
  auto label = [&](uint64_t bits) { appendConstant(out_, types_, expr(ExprId{stmt.a}).type, bits); };
  for (uint32_t i = 0; i < stmt.c; ++i) {
    const ir::Case& one = body_->cases[stmt.b + i];
    rest.clear();
    for (uint32_t r = 0; r < one.range_count; ++r) {
      const ir::CaseRange& range = body_->ranges[one.first_range + r];
      std::vector<Range> parts{{static_cast<uint64_t>(range.low) ^ flip, static_cast<uint64_t>(range.high) ^ flip}};
      // `taken` is sorted and disjoint.
      auto from = std::lower_bound(taken.begin(), taken.end(), parts[0].low,
                                   [](const Range& t, uint64_t low) { return t.high < low; });
      for (auto it = from; it != taken.end() && it->low <= parts.back().high; ++it) {
        const Range last = parts.back();
        parts.pop_back();
        if (last.low < it->low) parts.push_back({last.low, it->low - 1});
        if (last.high > it->high) {
          parts.push_back({it->high + 1, last.high});
        } else {
          break;
        }
        if (parts.empty()) break;
      }
      for (const Range& part : parts) {
        rest.push_back(part);
        taken.insert(std::lower_bound(taken.begin(), taken.end(), part.low,
                                      [](const Range& t, uint64_t low) { return t.low < low; }),
                     part);
      }
    }
    if (rest.empty()) continue;  // unreachable
    if (one.block) {
      begin(body_->stmt(one.block).loc);
    } else {
      out_ += ' ';
    }
    for (const Range& range : rest) {
      out_ += "case ";
      label(range.low ^ flip);
      if (range.low != range.high) {
        out_ += " ... ";
        label(range.high ^ flip);
      }
      out_ += ": ";
    }
    out_ += '{';
    ++depth_;
    block(one.block);
    if (!endsInJump(one.block)) {
      flushCloses(0);
      out_ += " break;";
    }
    close();
  }
  if (stmt.d != 0) {
    begin(body_->stmt(StmtId{stmt.d}).loc);
    out_ += "default: {";
    ++depth_;
    block(StmtId{stmt.d});
    if (!endsInJump(StmtId{stmt.d})) {
      flushCloses(0);
      out_ += " break;";
    }
    close();
  }
  close();
  if (had_loop) loops_.back().in_switch = was_in_switch;
}

void BodyWriter::callStatement(const Stmt& stmt) {
  const ir::BodyId callee_id{stmt.a};
  const Body& callee = module_.body(callee_id);
  if (stmt.b != 0) prepare(ExprId{stmt.b});
  for (uint32_t i = 0; i < stmt.d; ++i) {
    if (const ExprId operand = body_->operands[stmt.c + i]) prepare(operand);
  }
  if (stmt.e != 0) prepare(ExprId{stmt.e});
  const bool is_sized = stmt.b == 0 && isSizedCall(callee, stmt.c, stmt.d, ExprId{stmt.e});
  const bool is_virtual = (stmt.op & ir::kVirtual) != 0;
  if (is_virtual) {
    if (std::find(group_.virtuals.begin(), group_.virtuals.end(), callee_id) == group_.virtuals.end())
      group_.virtuals.push_back(callee_id);
    if ((stmt.op & ir::kChecked) != 0) classCheck(stmt);
  } else if ((callee.kind == ir::BodyKind::Function || callee.native) && !is_sized) {
    call(callee_id);
  }

  if (is_sized && stmt.e != 0 && slicedString(ExprId{stmt.e}) != nullptr) {
    sliceName(ExprId{stmt.e});
    out_ += " = ";
    sizedCall(callee, stmt.c, stmt.d, "slice");
    out_ += ", ";
    appendUnsigned(out_, capacityOf(expr(ExprId{stmt.e}).type));
    out_ += ", &";
    lengthName(ExprId{stmt.e});
    out_ += ");";
    return;
  }

  // A string whose length lives in a local: the call returns the length, or it is counted.
  const std::string length =
      stmt.e != 0 && measuredString(ExprId{stmt.e}) != nullptr ? captured([&] { lengthName(ExprId{stmt.e}); }) : "";
  std::string before, after;  // parameters that are not variables in memory: bits, views of the image
  const std::string arguments = captured([&] {
    uint32_t i = 0;
    for (const ir::Local& parameter : callee.locals) {
      if (!isParameter(parameter)) continue;
      if (i >= stmt.d) break;
      const ExprId operand = body_->operands[stmt.c + i++];
      out_ += ", ";
      if (parameter.by_reference && operand && ir::isPlace(expr(operand).kind) && !isLvalue(operand)) {
        const std::string copy = newVariable(parameter.type, "v");
        before += copy + " = " + captured([&] { value(operand, Prec::Ternary); }) + "; ";
        if (parameter.kind != ir::LocalKind::Input) {
          after += " ";
          after += captured([&] { store(operand, copy); });
          after += ';';
        }
        if (!isString(parameter.type)) out_ += '&';
        out_ += copy;
        continue;
      }
      if (parameter.by_reference) {
        reference(parameter, callee.native, operand);
      } else {
        value(operand, Prec::Ternary);
      }
    }
  });
  out_ += before;

  // The result: by value, or written by the callee to an address of ours, which must not be one of its inputs.
  std::string result, copy;
  const bool by_reference = callee.result && ir::isAggregate(types_, callee.result);
  if (by_reference) {
    const bool has_place = stmt.e != 0;
    const TypeId place_type = has_place ? expr(ExprId{stmt.e}).type : callee.result;
    bool direct = has_place && isLvalue(ExprId{stmt.e});
    if (direct && !callee.native) {
      const Expr& root = expr(ir::rootOf(*body_, ExprId{stmt.e}));
      direct = root.kind == ExprKind::Local && !body_->locals[root.a].by_reference;
      for (uint32_t i = 0; direct && i < stmt.d; ++i) {
        const ExprId operand = body_->operands[stmt.c + i];
        if (!operand || !ir::isPlace(expr(operand).kind)) continue;
        const Expr& other = expr(ir::rootOf(*body_, operand));
        direct = !(other.kind == ExprKind::Local && other.a == root.a);
      }
      if (isString(callee.result) && capacityOf(place_type) < capacityOf(callee.result)) direct = false;
    }
    if (isString(callee.result) && isWide(place_type) != isWide(callee.result)) direct = false;
    uint32_t capacity = 0;
    if (direct) {
      result = captured([&] { place(ExprId{stmt.e}); });
      if (isString(callee.result)) capacity = capacityOf(place_type);
    } else {
      result = copy = newVariable(callee.result, "v");
      if (isString(callee.result)) capacity = capacityOf(callee.result);
    }
    if (!isString(callee.result)) result.insert(0, "&");
    if (callee.native && isString(callee.result)) {
      result += ", ";
      appendUnsigned(result, capacity);
    }
  }

  const std::string function = captured([&] {
    if (is_sized) {
      sizedCall(callee, stmt.c, stmt.d);
      if (by_reference) {
        out_ += ", ";
        out_ += result;
      }
      out_ += ')';
      return;
    }
    if (callee.native) {
      out_ += ir::nativeName(module_, callee);
      out_ += "(ctx";
      if (stmt.b != 0) {
        out_ += ", &";
        place(ExprId{stmt.b});
      }
    } else {
      if (is_virtual) {
        out_ += methodName(module_, callee_id, "table") + '[' + indexOfMethod(stmt) + ']';
      } else {
        appendFunctionName(out_, module_, callee);
      }
      out_ += '(';
      if (stmt.b != 0) {
        if (isMethod(callee)) out_ += '&';
        place(ExprId{stmt.b});
        out_ += ", ";
      }
      out_ += "ctx";
    }
    out_ += arguments;
    if (by_reference) {
      out_ += ", ";
      out_ += result;
    }
    out_ += ')';
  });
  if (callee.result && !by_reference && stmt.e != 0) {
    store(ExprId{stmt.e}, function);
    out_ += ';';
  } else {
    if (callee.native && copy.empty() && !length.empty()) out_ += length + " = ";
    out_ += function;
    out_ += ';';
  }
  if (!copy.empty() && stmt.e != 0) {
    out_ += ' ';
    const TypeId to = expr(ExprId{stmt.e}).type;
    if (isString(to)) {
      const bool wide = isWide(to), from_wide = isWide(callee.result);
      if (!length.empty()) out_ += length + " = ";
      out_ += wide == from_wide ? (wide         ? "rung_wstring_assign("
                                   : isUtf8(to) ? "rung_ustring_assign("
                                                : "rung_string_assign(")
                                : (wide ? "rung_wstring_of_string(" : "rung_string_of_wstring(");
      place(ExprId{stmt.e});
      out_ += ", ";
      appendUnsigned(out_, capacityOf(to));
      out_ += ", " + copy + ");";
    } else {
      out_ += "memcpy(&";
      place(ExprId{stmt.e});
      out_ += ", &" + copy + ", sizeof " + copy + ");";
    }
  }
  if (!length.empty()) {
    if (!callee.native && copy.empty()) {
      out_ += ' ' + length + " = rung_string_length(";
      place(ExprId{stmt.e});
      out_ += ");";
    }
    setKnown(ExprId{stmt.e});
  }
  out_ += after;
}

// ---- faults and tests

// The row of a dispatch table for the object's class.
std::string BodyWriter::indexOfMethod(const Stmt& stmt) {
  return "rung_class_of(&" + captured([&] { place(ExprId{stmt.b}); }) + ") - " +
         methodName(module_, ir::BodyId{stmt.a}, "first");
}

// In front of a virtual call: a pointer bound by mistake has the number of no class, or of an unrelated one.
void BodyWriter::classCheck(const Stmt& stmt) {
  const ir::BodyId method{stmt.a};
  const std::string index = indexOfMethod(stmt);
  beginCheck();
  out_ += index + " >= " + methodName(module_, method, "count") + " || " + methodName(module_, method, "table") + '[' +
          index + "] == nullptr";
  endCheck(stmt.loc, types::Fault::Cast, "RUNG_NO_SUCH_METHOD");
}

void BodyWriter::faultStatement(const Stmt& stmt) {
  if (stmt.a != 0) prepare(ExprId{stmt.a});
  const auto fault = static_cast<Fault>(stmt.op);
  out_ += "at = ";
  // The bounds of an ARRAY[*] are not known here: low above high marks that.
  appendUnsigned(out_, fault == Fault::Index ? site(stmt.loc, fault, 1, 0) : site(stmt.loc, fault));
  out_ += "; value = ";
  if (stmt.a != 0) {
    out_ += "(int64_t)";
    value(ExprId{stmt.a}, Prec::Unary);
  } else {
    out_ += '0';
  }
  out_ += "; goto fault;";
}

// A block of a try is a separate function that the runtime calls between setjmp and longjmp: what it shares with the
// body is then in memory, and the compiler knows it.
void BodyWriter::guarded(const std::string& frame, const std::string& fault, StmtId first) {
  std::vector<Loop> outer_loops = loops_;
  for (Loop& loop : loops_) loop.try_depth += 1;
  out_ += "{ auto " + frame + " = [&]()";  // in a separate scope: a jump to `fault` from before must not enter it
  open();
  const bool outer_uses_fault = uses_fault_;
  uses_fault_ = false;
  block(first);
  flushCloses(0);
  out_ += " return;";
  if (uses_fault_) {
    out_ += " fault: rung_raise(ctx, at & 15, sites_" + group_.stem + " + (at >> 4), value);";
  }
  uses_fault_ = outer_uses_fault;
  --depth_;
  out_ += " }; " + fault + " = rung_try(ctx, [](void* frame) { (*static_cast<decltype(" + frame +
          ")*>(frame))(); }, &" + frame + "); }";
  loops_ = std::move(outer_loops);
}

void BodyWriter::tryStatement(const Stmt& stmt) {
  const std::string exit = newName("x"), fault = newName("k");
  declarations_ += " uint32_t " + exit + " = 0; uint8_t " + fault + " = 0;";
  frames_.push_back({});
  frames_.back().exit = exit;
  out_ += exit + " = 0; ";
  guarded(newName("f"), fault, StmtId{stmt.a});
  if (stmt.op != 0) {
    TryFrame frame = frames_.back();
    const bool has_finally = stmt.c != 0;
    if (!has_finally) frames_.pop_back();
    out_ += " if (" + fault + " != 0)";
    open();
    if (stmt.d != 0) {
      out_ += ' ';
      store(ExprId{stmt.d}, fault);
      out_ += ';';
    }
    if (has_finally) {
      out_ += ' ';
      guarded(newName("f"), fault, StmtId{stmt.b});
    } else {
      block(StmtId{stmt.b});
    }
    close();
    flushCloses(0);
    if (!has_finally) frames_.push_back(frame);
  }
  const TryFrame frame = frames_.back();
  frames_.pop_back();
  if (stmt.c != 0) {
    out_ += " {";
    ++depth_;
    block(StmtId{stmt.c});
    close();
    flushCloses(0);
  }
  if (stmt.op == 0 || stmt.c != 0) {
    out_ += " if (" + fault + " != 0) rung_raise(ctx, ctx->fault.kind, ctx->fault.site, ctx->fault.value);";
  }
  if (frame.returns) {
    out_ += " if (" + exit + " == 1) { ";
    leave();
    out_ += " }";
  }
  if (frame.breaks) {
    out_ += " if (" + exit + " == 2) { ";
    breakLoop();
    out_ += " }";
  }
  if (frame.continues) {
    out_ += " if (" + exit + " == 3) { ";
    continueLoop();
    out_ += " }";
  }
}

void BodyWriter::assertStatement(const Stmt& stmt) {
  for (uint32_t slot : {stmt.a, stmt.b, stmt.c}) {
    if (slot != 0) prepare(ExprId{slot});
  }
  const ir::AssertionReport report = ir::assertionReport(module_, *body_, stmt);
  const auto quotedOrNull = [&](std::string_view string) {
    if (string.empty()) {
      out_ += "nullptr";
    } else {
      appendQuoted(out_, string);
    }
  };
  out_ += "{ static const rung_assertion assertion = {";
  appendQuoted(out_, report.position.path);
  out_ += ", ";
  appendUnsigned(out_, report.position.line);
  out_ += ", ";
  appendUnsigned(out_, report.position.column);
  for (const std::string_view string : {report.source, report.message, report.shown, std::string_view(report.items)}) {
    out_ += ", ";
    quotedOrNull(string);
  }
  out_ += "}; ";

  const auto kind = [&](TypeId type) {
    if (types_.info(types_.resolve(type)).kind == TypeKind::Enum) {
      out_ += "RUNG_ENUM";
    } else {
      out_ += typeKindName(types_, type);
    }
  };
  const auto bits = [&](ExprId id) {
    out_ += ", ";
    if (!isString(expr(id).type)) return scalarBits(id);
    out_ += "(uint64_t)(uintptr_t)";
    stringValue(id);
  };
  const ExprId first{stmt.a}, second{stmt.b}, third{stmt.c};
  switch (static_cast<ir::Assertion>(stmt.op)) {
    case ir::Assertion::Assert:
      out_ += second ? "rung_assert_compared(ctx, &assertion, " : "rung_assert(ctx, &assertion, ";
      condition(first, Prec::Ternary);
      if (!second) break;
      out_ += ", ";
      kind(expr(second).type);
      bits(second);
      bits(third);
      break;
    case ir::Assertion::AssertNear:
      out_ += "rung_assert_near(ctx, &assertion, ";
      kind(expr(second).type);
      for (ExprId id : {first, second, third}) {
        out_ += ", ";
        value(id, Prec::Ternary);
      }
      break;
    case ir::Assertion::AssertEq: {
      const TypeId type = expr(second).type;
      if (isAggregate(type) && !isString(type)) {
        out_ += "rung_assert(ctx, &assertion, memcmp(&";
        place(first);
        out_ += ", &";
        place(second);
        out_ += ", ";
        appendUnsigned(out_, types_.info(types_.resolve(type)).size);
        out_ += ") == 0";
      } else {
        out_ += "rung_assert_equal(ctx, &assertion, ";
        kind(type);
        bits(first);
        bits(second);
      }
      break;
    }
  }
  out_ += "); }";
}

}  // namespace rung::codegen
