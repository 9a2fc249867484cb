// SPDX-License-Identifier: Apache-2.0
// Strings of the translated code: in memory, NUL-terminated, cut to the capacity of their target. See translate.h.
#include <algorithm>
#include <cstring>

#include "frontend/source/text.h"
#include "ir/interpreter/translate.h"

namespace rung::ir::interpreter {

namespace {

std::u16string utf16(std::string_view string) {
  std::u16string out;
  for (Utf16Units units(string); !units.done();) out += static_cast<char16_t>(units.next());
  return out;
}

}  // namespace

Address BodyTranslator::literal(const Expr& e) {
  const std::string_view characters = module_.names.string(e.as<StringExpr>().characters);
  if (isWide(e.type)) {
    code_.wide_strings.push_back(utf16(characters));
    return {Base::Constant, {}, 0, reinterpret_cast<int64_t>(code_.wide_strings.back().c_str()), kNoBit};
  }
  code_.strings.emplace_back(characters);
  return {Base::Constant, {}, 0, reinterpret_cast<int64_t>(code_.strings.back().c_str()), kNoBit};
}

Address BodyTranslator::stringBuffer(TypeId type) {
  return {Base::Frame, slot(info(type).size, info(type).align), 0, 0, kNoBit};
}

// The address of the characters of a string value: read without a copy where they are in memory.
Address BodyTranslator::string(ExprId id) {
  const Expr& e = expr(id);
  if (isPlace(e.kind)) return place(id);
  switch (valueKind(e.kind)) {
    case ValueKind::String: return literal(e);
    case ValueKind::Zero: {
      static constexpr char16_t kEmpty[] = u"";
      return {Base::Constant, {}, 0, reinterpret_cast<int64_t>(kEmpty), kNoBit};
    }
    case ValueKind::Convert: {
      const Address to = stringBuffer(e.type);
      assignString(to, capacityOf(e.type), isWide(e.type), id);
      return to;
    }
    case ValueKind::Call: return callString(e);
    case ValueKind::Binary: {  // MIN, MAX
      const auto [left, right, op] = e.as<BinaryExpr>();
      const Ref a = pointerTo(string(left)), b = pointerTo(string(right));
      const Operand order = temp(), takes_first = temp(), to = temp();
      emit(compareStringHandler(isWide(e.type), Base::Pointer, Base::Pointer), order.ref, a, b);
      emit(compareHandler(op == Op::Min ? Op::Lt : Op::Ge, Scalar::I32, Mode::Frame, Mode::Constant, Mode::Frame),
           takes_first.ref, order.ref);
      emit(selectHandler(Scalar::U64), to.ref, a, b, takes_first.ref.offset);
      return {Base::Pointer, to.ref, 0, 0, kNoBit};
    }
    case ValueKind::Data:
    case ValueKind::Select:
    case ValueKind::None:
    case ValueKind::Const:
    case ValueKind::Unary:
    case ValueKind::Address: break;
  }
  return place(id);
}

void BodyTranslator::copyString(const Address& to, uint32_t capacity, bool wide, const Address& from, TypeId type) {
  const auto base = [&](const Address& a) -> Address {
    if (a.base != Base::Pointer || a.offset == 0) return a;
    return {Base::Pointer, pointerTo(a), 0, 0, kNoBit};
  };
  const Address a = base(to), b = base(from);
  const bool is_utf8 = !wide && types_.kind(type) == types::TypeKind::UString;  // then `to` is a USTRING, too
  emit(is_utf8 ? assignUtf8Handler(a.base, b.base) : assignStringHandler(wide, isWide(type), a.base, b.base), a.ref,
       b.ref, {capacity, false}, 0, b.imm);
}

void BodyTranslator::assignString(const Address& to, uint32_t capacity, bool wide, ExprId from) {
  const Expr& e = expr(from);
  if (e.kind == ExprKind::Convert && isWide(e.type) == wide) {
    const uint32_t limit = std::min(capacity, capacityOf(e.type));
    const ExprId inner = e.as<ConvertExpr>().operand;
    if (isString(expr(inner).type)) return assignString(to, limit, wide, inner);
    const Operand bits = wideBits(inner);
    emit(stringOfScalarHandler(wide), pointerTo(to), bits.ref, {limit, false},
         static_cast<uint32_t>(hostKind(types_, expr(inner).type)));
    return;
  }
  if (e.kind == ExprKind::Convert) {  // of another width: first its own string
    const Address created = stringBuffer(e.type);
    assignString(created, capacityOf(e.type), isWide(e.type), from);
    return copyString(to, capacity, wide, created, e.type);
  }
  copyString(to, capacity, wide, string(from), e.type);
  // An initial value: the last unit too, since a program may write all characters in front of it one by one.
  if (e.kind == ExprKind::Zero)
    write(shifted(to, uint64_t{capacity} * (wide ? 2 : 1)), wide ? Scalar::U16 : Scalar::U8, {});
}

Operand BodyTranslator::stringOrder(ExprId left, ExprId right) {
  const auto base = [&](Address a, bool may_be_constant) -> Address {
    const bool simple = a.base == Base::Constant ? may_be_constant : a.base != Base::Pointer || a.offset == 0;
    if (simple) return a;
    return {Base::Pointer, pointerTo(a), 0, 0, kNoBit};
  };
  const Address a = base(string(left), false), b = base(string(right), true);
  const Operand order = temp();
  emit(compareStringHandler(isWide(expr(left).type), a.base, b.base), order.ref, a.ref, b.ref, 0, b.imm);
  return order;
}

}  // namespace rung::ir::interpreter
