// SPDX-License-Identifier: Apache-2.0
// Which cached fields must be in memory before a call: a fault of the callee leaves this body by longjmp, past its
// exits, and a caller that catches it (EN/ENO, __TRY), the host and the debugger read the instance. In: a body and its
// cached fields. Out: for each call of what may fault, the fields that may have been written since the last write-back.
// Called by analysis.cpp; calls.cpp writes them.
#pragma once

#include "codegen/locals.h"

namespace rung::codegen {

struct WriteBacks {
  struct Call {
    ir::StmtId call;
    std::vector<uint32_t> fields;  // by number of the variable
  };
  std::vector<Call> calls;  // by statement; those with no such field are left out

  const Call* find(ir::StmtId call) const;
  std::string toString(const Variables& variables) const;
};

WriteBacks analyzeWriteBacks(const ir::Module& module, const ir::Body& body, const Uses& uses,
                             const CachedFields& fields);

}  // namespace rung::codegen
