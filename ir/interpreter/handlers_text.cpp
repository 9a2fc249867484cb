// Texts: see handlers.h. The runtime's functions do the work, as in generated code.
#include "ir/interpreter/dispatch.h"
#include "ir/interpreter/handlers.h"
#include "ir/interpreter/select.h"

namespace rung::ir::interpreter {

namespace {

template <bool Wide>
using Unit = std::conditional_t<Wide, char16_t, char>;

template <bool Wide, Base B>
auto* text(const Insn* ip, uint8_t* fp, uint8_t* self, uint32_t offset) {
  return reinterpret_cast<Unit<Wide>*>(address<B>(ip, fp, self, offset));
}
template <bool Wide>
auto* textIn(uint8_t* fp, uint32_t slot) {
  return load<Unit<Wide>*>(fp + slot);
}

template <bool Wide, bool FromWide, Base D, Base A>
void assign(RUNG_HANDLER_PARAMETERS) {
  auto* const to = text<Wide, D>(ip, fp, self, ip->a);
  const auto* const from = text<FromWide, A>(ip, fp, self, ip->b);
  if constexpr (!Wide && !FromWide) rung_text_assign(to, ip->c, from);
  if constexpr (Wide && FromWide) rung_wtext_assign(to, ip->c, from);
  if constexpr (!Wide && FromWide) rung_text_of_wtext(to, ip->c, from);
  if constexpr (Wide && !FromWide) rung_wtext_of_text(to, ip->c, from);
  RUNG_NEXT;
}

template <Base D, Base A>
void assignUtf8(RUNG_HANDLER_PARAMETERS) {
  rung_utext_assign(text<false, D>(ip, fp, self, ip->a), ip->c, text<false, A>(ip, fp, self, ip->b));
  RUNG_NEXT;
}

template <bool Wide, Base A, Base B>
void compareStrings(RUNG_HANDLER_PARAMETERS) {
  const auto* const a = text<Wide, A>(ip, fp, self, ip->b);
  const auto* const b = text<Wide, B>(ip, fp, self, ip->c);
  if constexpr (Wide) store<int32_t>(fp + ip->a, rung_wtext_compare(a, b));
  if constexpr (!Wide) store<int32_t>(fp + ip->a, rung_text_compare(a, b));
  RUNG_NEXT;
}

template <bool Wide, Base D>
void empty(RUNG_HANDLER_PARAMETERS) {
  *text<Wide, D>(ip, fp, self, ip->a) = 0;
  RUNG_NEXT;
}

template <bool Wide>
void textOfScalar(RUNG_HANDLER_PARAMETERS) {
  const uint64_t bits = load<uint64_t>(fp + ip->b);
  const auto kind = static_cast<uint8_t>(ip->d);
  if constexpr (Wide) rung_wtext_of_scalar(textIn<true>(fp, ip->a), ip->c, kind, bits);
  if constexpr (!Wide) rung_text_of_scalar(textIn<false>(fp, ip->a), ip->c, kind, bits);
  RUNG_NEXT;
}
template <bool Wide>
void scalarOfText(RUNG_HANDLER_PARAMETERS) {
  const auto kind = static_cast<uint8_t>(ip->d);
  if constexpr (Wide) store<uint64_t>(fp + ip->a, rung_scalar_of_wtext(kind, textIn<true>(fp, ip->b)));
  if constexpr (!Wide) store<uint64_t>(fp + ip->a, rung_scalar_of_text(kind, textIn<false>(fp, ip->b)));
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

Handler assignTextHandler(bool wide, bool from_wide, Base to, Base from) {
  if (wide) return from_wide ? assignOf<true, true>(to, from) : assignOf<true, false>(to, from);
  return from_wide ? assignOf<false, true>(to, from) : assignOf<false, false>(to, from);
}
Handler assignUtf8Handler(Base to, Base from) {
  return withAddress(
      to, [&](auto d) { return withAnyAddress(from, [&](auto a) -> Handler { return assignUtf8<d(), a()>; }); });
}
Handler compareTextHandler(bool wide, Base left, Base right) {
  return wide ? compareStringsOf<true>(left, right) : compareStringsOf<false>(left, right);
}
Handler emptyTextHandler(bool wide, Base to) {
  return withAddress(to, [&](auto d) -> Handler { return wide ? empty<true, d()> : empty<false, d()>; });
}
Handler textOfScalarHandler(bool wide) { return wide ? textOfScalar<true> : textOfScalar<false>; }
Handler scalarOfTextHandler(bool wide) { return wide ? scalarOfText<true> : scalarOfText<false>; }

}  // namespace rung::ir::interpreter
