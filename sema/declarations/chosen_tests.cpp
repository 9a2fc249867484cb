// SPDX-License-Identifier: Apache-2.0
#include "sema/declarations/chosen_tests.h"

#include <algorithm>

#include "sema/project.h"
#include "sema/scopes.h"
#include "sema/shorthands.h"

namespace rung::sema {

void chooseTests(Context& context) {
  Symbols& symbols = context.symbols;
  const Options& options = context.project.options;
  std::vector<NameId> chosen;
  for (const std::string& name : options.mocks) chosen.push_back(keyOf(context, context.names().intern(name)));
  const auto byIndex = [](NameId a, NameId b) { return a.index < b.index; };
  std::sort(chosen.begin(), chosen.end(), byIndex);
  for (uint32_t i = 1; i < symbols.pous.size(); ++i) {
    Pou& pou = symbols.pous[i];
    for (const Pragma& pragma : context.tree().list(context.tree().decl(pou.decl).pragmas)) {
      if (keyOf(context, pragma.name) != context.scopes.known_names.mock) continue;
      pou.pragmas.mocks.push_back(keyOf(context, context.names().intern(context.tree().string(pragma.value))));
    }
    std::sort(pou.pragmas.mocks.begin(), pou.pragmas.mocks.end(), byIndex);
    if (pou.pragmas.test) {
      pou.excluded = !options.with_tests || pou.pragmas.mocks != chosen;
    } else if (pou.pragmas.replaces && std::count(chosen.begin(), chosen.end(), keyOf(context, pou.name)) != 0) {
      pou.pragmas.test_only = false;  // the program uses it now
      const std::string_view dotted = context.names().string(pou.pragmas.replaces);
      const NameId last = context.names().intern(dotted.substr(dotted.rfind('.') + 1));
      context.scopes.mocks.push_back({.key = keyOf(context, last), .mock = PouId{i}});
    } else {
      pou.excluded = pou.pragmas.replaces || (pou.pragmas.test_only && !options.with_tests);
    }
  }
}

}  // namespace rung::sema
