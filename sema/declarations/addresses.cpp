// SPDX-License-Identifier: Apache-2.0
// Located variables and direct addresses: %IX0.3, %QW4, %ID48 as views of the process image. A number counts units of
// the size letter (%ID48 begins at byte 192); %IX5 is byte 0, bit 5.
#include "sema/declarations/addresses.h"

#include <algorithm>

#include <algorithm>
#include "frontend/parse/diagnostics.h"

#include "sema/declarations/diagnostics.h"
#include "sema/declarations/mentions.h"
#include "sema/declarations/objects.h"
#include "sema/declarations/resolve.h"
#include "sema/declarations/variables.h"
#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

std::string addressText(const Context& context, const DirectAddress& address) {
  std::string text = "%";
  text += address.area;
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

bool isBitAddress(const DirectAddress& address) { return !address.size_given || unitBytes(address.size) == 0; }

// Marks the bytes before `end` of an area as used.
void use(Project& project, types::AreaId area, uint64_t end) {
  uint32_t& bytes = project.area_bytes[area.index];
  bytes = std::max(bytes, static_cast<uint32_t>(end));
}

}  // namespace

std::optional<types::AreaId> areaOf(Context& context, const DirectAddress& address, Loc loc) {
  if (const auto area = types::findArea(context.project.options.areas, address.area)) return area;
  context.report(diag::AddressForm, loc, {addressText(context, address)});
  return std::nullopt;
}

uint64_t areaLimit(const Context& context, types::AreaId area) {
  const uint32_t bytes = context.project.options.areas[area.index].bytes;
  return bytes != 0 ? bytes : types::kMaxAreaBytes;
}

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

// Forbids addresses outside the image, and types that do not fit a bit. Manuals 4.1.1, IEC 61131-3 ed. 3 table 16.
//   passes  v AT %QX5.1 : BOOL; w AT %QW28 : INT;
//   fails   v AT %QX5.9 : BOOL;                         E0340
//   fails   v AT %QX5.1 : INT;                          E0341
//   fails   v AT %QW5 : BOOL; in iec                    E0374
//   fails   VAR_CONFIG Main.v AT %QW5.1 : INT;          E0344 (see isHierarchical)
std::optional<ImageView> resolveAddress(Context& context, const DirectAddress& address, Loc loc, TypeId type) {
  const std::string text = addressText(context, address);
  const auto path = context.tree().list(address.path);
  const uint32_t unit = address.size_given ? unitBytes(address.size) : 0;
  const bool is_bit = unit == 0;
  if (path.empty()) return std::nullopt;  // reported by the lexer
  if (path.size() > (is_bit ? 2 : 1)) {
    context.report(diag::AddressParts, loc, {text, is_bit ? "`byte.bit`" : "one number"});
    return std::nullopt;
  }
  const std::optional<types::AreaId> area = areaOf(context, address, loc);
  if (!area) return std::nullopt;
  ImageView view;
  view.area = *area;
  uint64_t byte = 0, bytes = 1;
  if (is_bit) {
    if (path.size() == 2 && path[1] > 7) {
      context.report(diag::AddressBit, loc, {text});
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
    // Beremiz: a structure or array AT %I3.0, without a size, begins with that byte.
    const types::TypeKind kind = context.types().kind(type);
    const bool is_aggregate = kind == types::TypeKind::Record || kind == types::TypeKind::Array;
    if (is_aggregate && !address.size_given && path.size() == 2 && path[1] == 0) {
      view.is_bit = false;
    } else if (is_bit && !is_bool) {
      context.report(diag::AddressType, loc, {text, context.types().toString(type)});
      return std::nullopt;
    }
    if (is_bool && !is_bit && !context.profile().bools_at_bytes) {
      context.report(diag::AddressOfBool, loc, {text});
      return std::nullopt;
    }
    if (is_bool) view.is_bit = true;  // codesys: BOOL at %QB0 is its bit 0
    if (!is_bool) {
      if (!ensureLayout(context, type)) return std::nullopt;  // reported with the variable
      bytes = context.types().info(context.types().resolve(type)).size;
    }
  }
  if (byte + bytes > areaLimit(context, view.area)) {
    context.report(diag::AddressTooLarge, loc, {text, std::to_string(areaLimit(context, view.area))});
    return std::nullopt;
  }
  view.byte = static_cast<uint32_t>(byte);
  use(context.project, view.area, byte + bytes);
  return view;
}

// Two numbers of a bit, one of everything else are flat; the standard leaves the meaning of more numbers open.
// IEC 61131-3 ed. 3 table 16, ed. 2 table 15.
bool isHierarchical(const Context& context, const DirectAddress& address) {
  return !address.incomplete && context.tree().list(address.path).size() > (isBitAddress(address) ? 2u : 1u);
}

// The type of the user must be known. Equal addresses share a location, as large as its largest user.
VarId hierarchicalVar(Context& context, const DirectAddress& address, Loc loc, VarId user) {
  Project& project = context.project;
  Scopes& scopes = context.scopes;
  const TypeId type = user ? project.var(user).type : addressType(address);
  const std::string text = addressText(context, address);
  if (!type || type == types::kError) return {};
  if (isBitAddress(address) && context.types().kind(type) != types::TypeKind::Bool) {
    context.report(diag::AddressType, loc, {text, context.types().toString(type)});
    return {};
  }
  if (!ensureLayout(context, type)) return {};
  const std::optional<types::AreaId> area = areaOf(context, address, loc);
  if (!area) return {};
  noteEffect(context);  // on the places of all others
  const NameId name = context.names().intern(text);
  Entity known = scopes.addresses.names.find(keyOf(context, name));
  if (!known) {
    if (!context.profile().hierarchical_addresses) context.report(diag::HierarchicalAddress, loc, {text});
    known = Entity::of(EntityKind::Var, static_cast<uint32_t>(scopes.addresses.hierarchical.size()));
    scopes.addresses.names.insert(keyOf(context, name), known);
    Var var;
    var.name = name;
    var.loc = loc;
    var.type = addressType(address);
    var.section = SectionKind::Global;
    var.storage = Storage::Image;
    var.image.area = *area;
    var.image.is_bit = isBitAddress(address);
    var.hierarchical = true;
    const VarId named{static_cast<uint32_t>(project.vars.size())};
    project.vars.push_back(var);
    scopes.addresses.hierarchical.push_back({named, uint64_t{1}, 1, {}});
  }
  Scopes::HierarchicalAddress& allocation = scopes.addresses.hierarchical[known.index];
  for (const TypeId held : {type, addressType(address)}) {
    const types::TypeInfo& info = context.types().info(context.types().resolve(held));
    allocation.bytes = std::max<uint64_t>(allocation.bytes, info.size);
    allocation.align = std::max<uint64_t>(allocation.align, info.align);
  }
  if (user) {
    Var& var = project.var(user);
    var.hierarchical = true;
    var.image.area = *area;
    var.image.is_bit = context.types().kind(type) == types::TypeKind::Bool;
    allocation.users.push_back(user);
  }
  return allocation.named;
}

// After the last byte of the other addresses, by name, each at the next byte aligned for it. Bits get a byte each, so
// that each address leads to its own byte.
void allocateHierarchical(Context& context) {
  Project& project = context.project;
  std::vector<Scopes::HierarchicalAddress>& allocations = context.scopes.addresses.hierarchical;
  std::sort(allocations.begin(), allocations.end(), [&](const auto& a, const auto& b) {
    return context.names().string(project.var(a.named).name) < context.names().string(project.var(b.named).name);
  });
  for (const Scopes::HierarchicalAddress& allocation : allocations) {
    Var& named = project.var(allocation.named);
    const uint64_t end = project.area_bytes[named.image.area.index];
    const uint64_t byte = (end + allocation.align - 1) / allocation.align * allocation.align;
    const uint64_t limit = areaLimit(context, named.image.area);
    if (byte + allocation.bytes > limit) {
      context.report(diag::AddressTooLarge, named.loc, {context.names().string(named.name), std::to_string(limit)});
      return;
    }
    named.image.byte = static_cast<uint32_t>(byte);
    for (const VarId user : allocation.users) project.var(user).image.byte = static_cast<uint32_t>(byte);
    use(project, named.image.area, byte + allocation.bytes);
  }
}

uint64_t addressKey(const Context& context, const DirectAddress& address) {
  const auto path = context.tree().list(address.path);
  uint64_t key = static_cast<uint64_t>(static_cast<unsigned char>(address.area)) << 56 |
                 static_cast<uint64_t>(static_cast<unsigned char>(address.size)) << 48;
  for (const uint32_t part : path) key = (key & ~uint64_t{0} << 48) | ((key * 0x10001 + part + 1) & 0xffffffffffff);
  return key;
}

TypeId declaredAddressType(Context& context, const DirectAddress& address) {
  const auto found = context.scopes.addresses.unnamed.find(addressKey(context, address));
  if (found == context.scopes.addresses.unnamed.end()) return {};
  const auto path = context.tree().list(address.path);
  const PouId object = objectOf(context);
  TypeId type;
  for (const VarId id : found->second) {
    const DirectAddress& other = context.tree().as<VarDecl>(context.symbols.var(id).decl).address;
    const PouId pou = context.symbols.var(id).pou;
    if (pou && pou != context.pou && pou != object) continue;
    const auto written = context.tree().list(other.path);
    if (!std::equal(path.begin(), path.end(), written.begin(), written.end())) continue;
    ensureVarType(context, id);
    const TypeId declared = context.symbols.var(id).type;
    if (declared == types::kError) continue;
    const uint32_t width = types::TypeTable::bitWidth(context.types().plainKind(declared));
    if (width == types::TypeTable::bitWidth(context.types().kind(addressType(address)))) type = declared;
    if (pou) break;
  }
  return type;
}

}  // namespace rung::sema
