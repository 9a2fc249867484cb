// SPDX-License-Identifier: Apache-2.0
// Class numbers and dispatch tables: see classes.h.
#include "codegen/classes.h"

#include <algorithm>
#include <vector>

#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/types.h"

namespace rung::codegen {

std::string declareDispatch(const ir::Module& module, ir::BodyId method) {
  const std::string call = methodName(module, method, "call");
  std::string out = "typedef ";
  appendSignature(out, module, module.body(method), call);
  out += ";\nextern " + call + "* const " + methodName(module, method, "table") + "[];\n";
  out += "extern const uint32_t " + methodName(module, method, "first") + ";\n";
  return out += "extern const uint32_t " + methodName(module, method, "count") + ";\n";
}

std::string classesSource(const ir::Module& module, std::string_view name_space) {
  std::string numbers, tables;
  std::vector<uint32_t> used;
  for (size_t i = 0; i < module.classes.size(); ++i) {
    numbers += "extern const uint32_t " + className(module.types, module.classes[i].record) + " = " +
               std::to_string(i + 1) + ";\n";
  }
  for (const ir::Dispatch& dispatch : module.dispatches) {
    tables += declareDispatch(module, dispatch.method);
    tables += "extern const uint32_t " + methodName(module, dispatch.method, "first") + " = " +
              std::to_string(dispatch.first) + ";\n";
    tables += "extern const uint32_t " + methodName(module, dispatch.method, "count") + " = " +
              std::to_string(dispatch.bodies.size()) + ";\n";
    tables += methodName(module, dispatch.method, "call") + "* const " + methodName(module, dispatch.method, "table") +
              "[] = {";
    for (ir::BodyId body : dispatch.bodies) {
      if (body) used.push_back(body.index);
      tables += body ? "" : "nullptr";
      if (body) appendFunctionName(tables, module, module.body(body));
      tables += ", ";
    }
    if (dispatch.bodies.empty()) tables += "nullptr";
    tables += "};\n";
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<std::string> prototypes;
  for (uint32_t body : used) {
    appendSignature(prototypes.emplace_back(), module, module.bodies[body]);
    prototypes.back() += ";\n";
  }
  std::sort(prototypes.begin(), prototypes.end());
  std::string out =
      "// The numbers of classes, and which method each of them has.\n#define RUNG_GENERATED\n#include "
      "\"rung/code.h\"\n\n";
  out.append(openNamespace(name_space)).append("\n").append(numbers).append("\n");
  for (const std::string& line : prototypes) out += line;
  return out + "\n" + tables + "\n}  // namespace " + std::string(name_space) + "\n";
}

}  // namespace rung::codegen
