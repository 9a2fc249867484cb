// Prints the code of a body: statements, places, values (docs/ir.md). Called by text_printer.cpp.
#include <cmath>

#include "ir/text_writer.h"

namespace rung::ir::text_form {

using types::Field;
using types::TypeInfo;
using types::TypeKind;

// ---- statements

// The statements and the closing brace; the caller has printed the opening one.
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
    if (!isParameter(local)) continue;
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
      if (s.kind == StmtKind::Bind && s.b == 0) return put("null");
      expr(ExprId{s.b}, typeOf(ExprId{s.a}));
      return;
    case StmtKind::Call: {
      const Body& callee = module_.body(BodyId{s.a});
      if (s.e != 0) {
        expr(ExprId{s.e}, {});
        put(" = ");
      }
      put(callee.kind == BodyKind::Init ? "call init @"
          : (s.op & kVirtual) == 0      ? "call @"
          : (s.op & kChecked) != 0      ? "call virtual checked @"
                                        : "call virtual @");
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
      if (s.op != 0) {
        put(" catch ");
        if (s.d != 0) {
          expr(ExprId{s.d}, {});
          put(" ");
        }
        put("{");
        block(StmtId{s.b});
      }
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
      const auto assertion = static_cast<Assertion>(s.op);
      if (assertion == Assertion::Assert) {
        put("assert ");
        expr(ExprId{s.a}, types::kBool);
        if (s.b != 0) {
          put(" shows ");
          expr(ExprId{s.b}, {});
          put(", ");
          expr(ExprId{s.c}, typeOf(ExprId{s.b}));
          put(" as ");
          quoted(module_.names.string(NameId{s.e}), '\'');
        }
      } else {
        put(assertion == Assertion::AssertEq ? "assert_eq " : "assert_near ");
        expr(ExprId{s.a}, {});
        put(", ");
        expr(ExprId{s.b}, typeOf(ExprId{s.a}));
        if (assertion == Assertion::AssertNear) {
          put(", ");
          expr(ExprId{s.c}, typeOf(ExprId{s.a}));
        }
      }
      if (s.d != 0) {
        put(" text ");
        quoted(module_.names.string(NameId{s.d}), '\'');
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
  for (const CheckKeyword& row : checkKeywords()) {
    if ((e.checks & row.check) == 0) continue;
    if (!first) put(", ");
    first = false;
    put(row.word);
  }
  put(")");
}

void Printer::constant(const Expr& e, TypeId expected) {
  if (e.kind == ExprKind::Const && e.c != 0) {
    put("class ");
    return type(TypeId{e.c});
  }
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
  } else if (e.kind == ExprKind::String) {
    quoted(module_.names.string(NameId{e.a}), '\'');
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

// As operand of a prefix keyword or base of a postfix: in parentheses unless it is one token.
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
    case ExprKind::String:
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
    case ExprKind::String:
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
      out += module_.areas[e.a].letter;
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

}  // namespace rung::ir::text_form
