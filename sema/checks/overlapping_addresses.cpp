// SPDX-License-Identifier: Apache-2.0
// Warns of two located variables that share bytes and are both written, unless they are the same view: equal address
// and type. Bits of a word that others write may be read: views exist for that. Manual 4.1.1; IEC 61131-3 ed. 3, 6.5.5.
//   passes  word AT %MW0 : WORD; bit AT %MX0.3 : BOOL;   only one of them is written
//   fails   low AT %MW0 : DWORD; high AT %MW1 : WORD;    both are
// Called once, when all bodies are checked and all addresses are known. Sorted by position: no pair is compared twice.
#include "sema/checks/rules.h"

#include <algorithm>

#include "sema/project.h"
#include "sema/shorthands.h"

namespace rung::sema {

namespace {

struct Span {
  types::AreaId area;
  uint64_t begin, end;  // in bits
  VarId var;
};

}  // namespace

void checkOverlappingAddresses(Context& context) {
  const Symbols& symbols = context.symbols;
  const types::TypeTable& table = context.types();
  std::vector<Span> spans;
  for (uint32_t i = 1; i < symbols.vars.size(); ++i) {
    const Var& var = symbols.vars[i];
    if (var.storage != Storage::Image || var.external || !var.type || var.type == types::kError) continue;
    if (var.used.writes == 0 && !var.init) continue;
    const ImageView& view = var.image;
    if (context.project.options.areas[view.area.index].owner == types::AreaOwner::Shared) continue;
    const uint64_t begin = uint64_t{view.byte} * 8 + (view.is_bit ? view.bit : 0);
    const uint64_t bits = view.is_bit ? 1 : uint64_t{table.info(table.resolve(var.type)).size} * 8;
    spans.push_back({view.area, begin, begin + bits, {i}});
  }
  std::stable_sort(spans.begin(), spans.end(),
                   [](const Span& a, const Span& b) { return a.area != b.area ? a.area < b.area : a.begin < b.begin; });
  const auto name = [&](const Var& var) { return var.name ? string(context, var.name) : std::string_view("AT"); };
  for (size_t i = 1, last = 0; i < spans.size(); ++i) {  // last: of those before, the one that ends last
    const Span& one = spans[last];
    const Span& other = spans[i];
    const bool overlaps = one.area == other.area && other.begin < one.end;
    const Var& first = symbols.var(one.var);
    const Var& second = symbols.var(other.var);
    const bool same =
        one.begin == other.begin && one.end == other.end && table.resolve(first.type) == table.resolve(second.type);
    // Several variables at one place of a source: channels of a module, whose documentation defines what they share.
    const SourceLocation a = symbols.sources.location(first.loc), b = symbols.sources.location(second.loc);
    const bool is_module = a.file == b.file && a.line == b.line && a.column == b.column;
    if (overlaps && !same && !is_module) {
      const bool in_order = symbols.sources.isBefore(first.loc, second.loc);
      const Var& later = in_order ? second : first;
      const Var& earlier = in_order ? first : second;
      context.report(diag::AddressOverlap, later.loc, {name(later), name(earlier)}).declaredHere(earlier.loc);
    }
    if (!overlaps || other.end > one.end) last = i;
  }
}

}  // namespace rung::sema
