// SPDX-License-Identifier: Apache-2.0
// The choice of counted loops: see counted_loops.h.
#include "codegen/counted_loops.h"

#include <algorithm>

#include "codegen/names.h"

namespace rung::codegen {

using ir::StmtId;

namespace {

// True when the control never takes a value outside of its type.
bool boundsFit(const ir::Module& module, const ir::Body& body, const ir::ForStmt& loop) {
  if (!ir::isConst(body.expr(loop.to))) return false;
  const uint64_t to = ir::bitsOf(body.expr(loop.to));
  const types::TypeKind kind = module.types.plainKind(body.expr(loop.control).type);
  const auto step = static_cast<__int128>(static_cast<int64_t>(ir::bitsOf(body.expr(loop.step))));
  const uint32_t width = types::TypeTable::bitWidth(kind);
  const bool is_signed = module.types.isSigned(kind);
  const __int128 low = is_signed ? -(static_cast<__int128>(1) << (width - 1)) : 0;
  const __int128 high = (static_cast<__int128>(1) << (is_signed ? width - 1 : width)) - 1;
  const __int128 bound = is_signed ? static_cast<__int128>(static_cast<int64_t>(to)) : static_cast<__int128>(to);
  return bound + step >= low && bound + step <= high;
}

}  // namespace

CountedLoops analyzeLoops(const ir::Module& module, const ir::Body& body, const Uses& uses,
                          const CachedFields& fields) {
  const Variables& variables = uses.variables;
  CountedLoops counted;
  counted.wide.resize(variables.count());
  if (uses.has_try) return counted;
  for (const StmtId id : uses.quiet_loops) {
    const ir::ForStmt& loop = body.stmt(id).as<ir::ForStmt>();
    const uint32_t control = variables.at(loop.control);
    if (control == kNoVariable || uses.of[control].exposed) continue;
    if (variables.isField(control) && fields.is_cached[control] == 0) continue;
    const uint32_t width = types::TypeTable::bitWidth(module.types.plainKind(body.expr(loop.control).type));
    if (width == 0) continue;
    const bool fits = boundsFit(module, body, loop);
    if (width == 64) {
      if (fits) counted.loops.push_back({id, fits});
      continue;
    }
    const bool is_parameter = !variables.isField(control) && variables.local(control).kind == ir::LocalKind::Input;
    if (is_parameter) continue;
    counted.loops.push_back({id, fits});
    if (width <= 16) {
      counted.wide[control] = 32;
    } else if (!fits) {
      counted.wide[control] = 64;
    }
  }
  std::sort(counted.loops.begin(), counted.loops.end(),
            [](const CountedLoop& a, const CountedLoop& b) { return a.loop.index < b.loop.index; });
  return counted;
}

const CountedLoop* CountedLoops::find(StmtId loop) const {
  const auto it = std::lower_bound(loops.begin(), loops.end(), loop,
                                   [](const CountedLoop& a, StmtId id) { return a.loop.index < id.index; });
  return it != loops.end() && it->loop == loop ? &*it : nullptr;
}

std::string CountedLoops::toString(const Variables& variables) const {
  std::vector<std::string> rows(wide.size());
  for (uint32_t i = 0; i < rows.size(); ++i) {
    if (wide[i] == 0) continue;
    rows[i] = " wide ";
    appendUnsigned(rows[i], wide[i]);
  }
  std::string out = variables.lines(rows);
  for (const CountedLoop& loop : loops) out += loop.fits ? "loop fits\n" : "loop\n";
  return out;
}

}  // namespace rung::codegen
