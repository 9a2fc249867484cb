// SPDX-License-Identifier: Apache-2.0
// The tests of the module: each POU marked {test} is a test, or each of its cases ({case a := 1}). In: POUs with
// checked cases. Out: Module::tests. A block with cases has one instance: a function sets its inputs before the first
// cycle. A function with parameters is called by one without: its open inputs have their initial values.
#include <algorithm>

#include "ir/lower/lowering.h"

namespace rung::ir {

void ModuleLowering::addTests() {
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    const sema::Pou& pou = project.pous[i];
    const BodyId body = body_of_[i];
    if (!body || !pou.pragmas.test || pou.excluded) continue;
    const bool calls = module.body(body).kind == BodyKind::Function && !parameters(module.body(body)).empty();
    if (pou.pragmas.cases.empty()) {
      const BodyId code = calls ? addTestCall({i}, {}, "~test") : body;
      module.tests.push_back({code, pou.unique_name, {}, pou.loc});
    }
    uint32_t number = 0;
    for (const sema::TestCase& one : pou.pragmas.cases) {
      const std::string suffix = "~case" + std::to_string(++number);
      if (calls)
        module.tests.push_back({addTestCall({i}, one.inputs, suffix), one.name, {}, one.loc});
      else
        module.tests.push_back({body, one.name, addTestSetup({i}, one.inputs, suffix), one.loc});
    }
  }
  std::sort(module.tests.begin(), module.tests.end(),
            [](const Test& a, const Test& b) { return a.loc.offset < b.loc.offset; });
}

BodyId ModuleLowering::addTestCall(sema::PouId test, std::span<const sema::TestCase::Input> inputs,
                                   const std::string& suffix) {
  const BodyId created = addHelper(project.pou(test).unique_name, test, suffix.c_str());
  Body& body = module.body(created);
  BodyLowering lowering(*this, body, {});
  lowering.calls.lowerTestCall(test, inputs, body.loc);
  lowering.finish();
  return created;
}

BodyId ModuleLowering::addTestSetup(sema::PouId test, std::span<const sema::TestCase::Input> inputs,
                                    const std::string& suffix) {
  const uint32_t program = instances.instanceOf(test);
  const BodyId created = addHelper(project.pou(test).unique_name, test, suffix.c_str());
  Body& body = module.body(created);
  BodyLowering lowering(*this, body, {});
  for (const sema::TestCase::Input& input : inputs) {
    const sema::Var& var = project.var(input.var);
    const bool located = var.storage == sema::Storage::Image;
    const ExprId place = located
                             ? lowering.places.varPlace(input.var, body.loc)
                             : lowering.places.pinPlace(lowering.places.programPlace(program, body.loc), var, body.loc);
    lowering.objects.storeInitial(place, var.type, input.value, false);
  }
  lowering.finish();
  return created;
}

}  // namespace rung::ir
