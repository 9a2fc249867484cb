// Located variables and direct addresses: %IX0.3, %QW4, %ID48 as views of the process image. A number counts units of
// the size letter (%ID48 begins at byte 192); %IX5 is byte 0, bit 5.
#include "sema/declarations/declarations.h"

namespace rung::sema {

namespace {

std::string spelledAddress(const Context& context, const DirectAddress& address) {
  std::string text = "%";
  text += address.area == ImageArea::Input ? 'I' : address.area == ImageArea::Output ? 'Q' : 'M';
  if (address.size_given) text += address.size;
  if (address.incomplete) return text + '*';
  bool first = true;
  for (const uint32_t part : context.tree().list(address.path)) {
    if (!first) text += '.';
    text += std::to_string(part);
    first = false;
  }
  return text;
}

uint32_t unitBytes(char size) { return size == 'B' ? 1 : size == 'W' ? 2 : size == 'D' ? 4 : size == 'L' ? 8 : 0; }

}  // namespace

TypeId addressType(const DirectAddress& address) {
  if (!address.size_given) return types::kBool;
  switch (unitBytes(address.size)) {
    case 1: return types::kByte;
    case 2: return types::kWord;
    case 4: return types::kDWord;
    case 8: return types::kLWord;
    default: return types::kBool;
  }
}

// Forbids addresses that name no place, and types that do not fit a bit. Manuals 4.1.1, IEC 61131-3 ed. 3 table 16.
//   passes  v AT %QX5.1 : BOOL; w AT %QW28 : INT;
//   fails   v AT %QX5.9 : BOOL;                         E0340
//   fails   v AT %QX5.1 : INT;                          E0341
std::optional<ImageView> resolveAddress(Context& context, const DirectAddress& address, Loc loc, TypeId type) {
  const std::string text = spelledAddress(context, address);
  const auto path = context.tree().list(address.path);
  const uint32_t unit = address.size_given ? unitBytes(address.size) : 0;
  const bool is_bit = unit == 0;
  if (path.empty()) return std::nullopt;  // reported by the lexer
  if (path.size() > (is_bit ? 2 : 1)) {
    context.report(Diag::AddressParts, loc, {text, is_bit ? "`byte.bit`" : "one number"});
    return std::nullopt;
  }
  ImageView view;
  view.area = address.area;
  uint64_t byte = 0, bytes = 1;
  if (is_bit) {
    if (path.size() == 2 && path[1] > 7) {
      context.report(Diag::AddressBit, loc, {text});
      return std::nullopt;
    }
    byte = path.size() == 2 ? path[0] : path[0] / 8;
    view.bit = static_cast<uint8_t>(path.size() == 2 ? path[1] : path[0] % 8);
    view.is_bit = true;
  } else {
    byte = uint64_t{path[0]} * unit;
    bytes = unit;
  }
  if (type == types::kError) return std::nullopt;
  if (type) {
    const bool is_bool = context.types().kind(type) == types::TypeKind::Bool;
    if (is_bit && !is_bool) {
      context.report(Diag::AddressType, loc, {text, context.types().spell(type)});
      return std::nullopt;
    }
    if (is_bool) view.is_bit = true;  // BOOL at %QB0: its bit 0
    if (!is_bool) {
      if (!ensureLayout(context, type)) return std::nullopt;  // reported with the variable
      bytes = context.types().info(context.types().resolve(type)).size;
    }
  }
  if (byte + bytes > kMaxImageBytes) {
    context.report(Diag::AddressTooLarge, loc, {text, std::to_string(kMaxImageBytes)});
    return std::nullopt;
  }
  view.byte = static_cast<uint32_t>(byte);
  uint32_t& end = context.project.image_bytes[static_cast<size_t>(view.area)];
  if (byte + bytes > end) end = static_cast<uint32_t>(byte + bytes);
  return view;
}

}  // namespace rung::sema
