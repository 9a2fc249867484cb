// SPDX-License-Identifier: Apache-2.0
// Strings: see handlers.h. The runtime's functions do the work, as in generated code.
#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"
#include "ir/interpreter/select.h"

namespace rung::ir::interpreter {

namespace {

template <bool Wide>
using Unit = std::conditional_t<Wide, char16_t, char>;

template <bool Wide, Base B>
auto* string(const Insn* ip, uint8_t* fp, uint8_t* self, uint32_t offset) {
  return reinterpret_cast<Unit<Wide>*>(address<B>(ip, fp, self, offset));
}
template <bool Wide>
auto* stringIn(uint8_t* fp, uint32_t slot) {
  return load<Unit<Wide>*>(fp + slot);
}

template <bool Wide, bool FromWide, Base D, Base A>
void assign(RUNG_HANDLER_PARAMETERS) {
  auto* const to = string<Wide, D>(ip, fp, self, ip->a);
  const auto* const from = string<FromWide, A>(ip, fp, self, ip->b);
  if constexpr (!Wide && !FromWide) rung_string_assign(to, ip->c, from);
  if constexpr (Wide && FromWide) rung_wstring_assign(to, ip->c, from);
  if constexpr (!Wide && FromWide) rung_string_of_wstring(to, ip->c, from);
  if constexpr (Wide && !FromWide) rung_wstring_of_string(to, ip->c, from);
  RUNG_NEXT;
}

template <Base D, Base A>
void assignUtf8(RUNG_HANDLER_PARAMETERS) {
  rung_ustring_assign(string<false, D>(ip, fp, self, ip->a), ip->c, string<false, A>(ip, fp, self, ip->b));
  RUNG_NEXT;
}

template <bool Wide, Base A, Base B>
void compareStrings(RUNG_HANDLER_PARAMETERS) {
  const auto* const a = string<Wide, A>(ip, fp, self, ip->b);
  const auto* const b = string<Wide, B>(ip, fp, self, ip->c);
  if constexpr (Wide) store<int32_t>(fp + ip->a, rung_wstring_compare(a, b));
  if constexpr (!Wide) store<int32_t>(fp + ip->a, rung_string_compare(a, b));
  RUNG_NEXT;
}

template <bool Wide, Base D>
void empty(RUNG_HANDLER_PARAMETERS) {
  *string<Wide, D>(ip, fp, self, ip->a) = 0;
  RUNG_NEXT;
}

template <bool Wide>
void stringOfScalar(RUNG_HANDLER_PARAMETERS) {
  const uint64_t bits = load<uint64_t>(fp + ip->b);
  const auto kind = static_cast<uint8_t>(ip->d);
  if constexpr (Wide) rung_wstring_of_scalar(stringIn<true>(fp, ip->a), ip->c, kind, bits);
  if constexpr (!Wide) rung_string_of_scalar(stringIn<false>(fp, ip->a), ip->c, kind, bits);
  RUNG_NEXT;
}
template <bool Wide>
void scalarOfString(RUNG_HANDLER_PARAMETERS) {
  const auto kind = static_cast<uint8_t>(ip->d);
  if constexpr (Wide) store<uint64_t>(fp + ip->a, rung_scalar_of_wstring(kind, stringIn<true>(fp, ip->b)));
  if constexpr (!Wide) store<uint64_t>(fp + ip->a, rung_scalar_of_string(kind, stringIn<false>(fp, ip->b)));
  RUNG_NEXT;
}

template <bool Wide, bool FromWide>
Handler assignOf(Base to, Base from) {
  return withAddress(to, [&](auto d) {
    return withAnyAddress(from, [&](auto a) -> Handler { return assign<Wide, FromWide, d(), a()>; });
  });
}
template <bool Wide>
Handler compareStringsOf(Base left, Base right) {
  return withAddress(left, [&](auto a) {
    return withAnyAddress(right, [&](auto b) -> Handler { return compareStrings<Wide, a(), b()>; });
  });
}

}  // namespace

Handler assignStringHandler(bool wide, bool from_wide, Base to, Base from) {
  if (wide) return from_wide ? assignOf<true, true>(to, from) : assignOf<true, false>(to, from);
  return from_wide ? assignOf<false, true>(to, from) : assignOf<false, false>(to, from);
}
Handler assignUtf8Handler(Base to, Base from) {
  return withAddress(
      to, [&](auto d) { return withAnyAddress(from, [&](auto a) -> Handler { return assignUtf8<d(), a()>; }); });
}
Handler compareStringHandler(bool wide, Base left, Base right) {
  return wide ? compareStringsOf<true>(left, right) : compareStringsOf<false>(left, right);
}
Handler emptyStringHandler(bool wide, Base to) {
  return withAddress(to, [&](auto d) -> Handler { return wide ? empty<true, d()> : empty<false, d()>; });
}
Handler stringOfScalarHandler(bool wide) { return wide ? stringOfScalar<true> : stringOfScalar<false>; }
Handler scalarOfStringHandler(bool wide) { return wide ? scalarOfString<true> : scalarOfString<false>; }

}  // namespace rung::ir::interpreter
