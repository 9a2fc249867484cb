// SPDX-License-Identifier: Apache-2.0
// See appends.h.
#include "codegen/appends.h"

#include "ir/description.h"
#include "ir/walk.h"

namespace rung::codegen {

using ir::ExprId;
using ir::StmtId;
using types::TypeKind;

namespace {

constexpr uint32_t kLongest = 255;  // of a result of CONCAT

class Finder {
 public:
  Finder(const StringsOfBody& strings, const KnownLengths& lengths)
      : strings_(strings),
        module_(strings.module),
        body_(strings.body),
        lengths_(lengths),
        read_once_(module_, body_) {}

  Appends run() {
    for (uint32_t i = 1; i < body_.stmts.size(); ++i) tryCall(StmtId{i});
    return std::move(appends_);
  }

 private:
  void tryCall(StmtId id) {
    const auto* make = body_.stmt(id).tryAs<ir::CallStmt>();
    const StmtId next = body_.stmt(id).next;
    const auto* append = make != nullptr && next ? body_.stmt(next).tryAs<ir::CallStmt>() : nullptr;
    if (append == nullptr || !makesText(*make) || !appendsTo(*append, *make) || !countsOnly(next, *append)) return;
    appends_.appended_by.resize(body_.stmts.size());
    appends_.appended_by[id.index] = appends_.appended_by[next.index] = next;
    appends_.needs_no_memory.resize(body_.locals.size());
    appends_.needs_no_memory[*ir::localOf(body_.expr(make->result))] = 1;
  }

  // What is counted in front of the second statement is counted in front of the first: no more than the string itself.
  bool countsOnly(StmtId id, const ir::CallStmt& append) const {
    if (!lengths_.countsBefore(id)) return true;
    const std::vector<ExprId>& counted = lengths_.counted[id.index];
    return counted.size() == 1 && strings_.variables.stringAt(counted[0]) == strings_.variables.stringAt(append.result);
  }

  bool isNarrow(ExprId id) const { return module_.types.kind(body_.expr(id).type) == TypeKind::String; }

  // A text made of numbers or other scalars, in a temporary that is read once.
  bool makesText(const ir::CallStmt& call) const {
    const ir::Body& callee = module_.body(call.callee);
    if (!callee.native || !callee.pure || call.self || read_once_.madeBy(call) == nullptr) return false;
    if (!isNarrow(call.result)) return false;
    if (module_.types.kind(callee.result) != TypeKind::String) return false;
    for (const ExprId operand : body_.list(call.operands))
      if (!operand || !types::TypeTable::isScalar(module_.types.plainKind(body_.expr(operand).type))) return false;
    return true;
  }
  // CONCAT of a measured string and the text, back to the string.
  bool appendsTo(const ir::CallStmt& call, const ir::CallStmt& make) const {
    const ir::Body& callee = module_.body(call.callee);
    if (!callee.sized || ir::nativeName(module_, callee) != "rung_standard_CONCAT__STRING_255") return false;
    const std::span<const ExprId> operands = body_.list(call.operands);
    if (operands.size() != 2 || !call.result || !isNarrow(call.result) || !strings_.isMeasured(call.result))
      return false;
    if (module_.types.info(module_.types.resolve(body_.expr(call.result).type)).length > kLongest) return false;
    const uint32_t* text = ir::localOf(body_.expr(operands[1]));
    return text != nullptr && *text == *ir::localOf(body_.expr(make.result)) &&
           strings_.variables.stringAt(operands[0]) == strings_.variables.stringAt(call.result);
  }

  const StringsOfBody& strings_;
  const ir::Module& module_;
  const ir::Body& body_;
  const KnownLengths& lengths_;
  ReadOnce read_once_;
  Appends appends_;
};

}  // namespace

Appends analyzeAppends(const StringsOfBody& strings, const KnownLengths& lengths) {
  if (!strings.measured.any) return {};
  return Finder(strings, lengths).run();
}

}  // namespace rung::codegen
