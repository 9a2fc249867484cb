// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/sfc_builder.h"

#include <algorithm>

namespace rung::text {

ExprId SfcBuilder::path(NameId whole) {
  const std::string_view spelling = names_.string(whole);
  size_t end = spelling.find('.');
  if (end == std::string_view::npos) return name(whole);
  ExprId made = name(spelling.substr(0, end));
  while (end != std::string_view::npos) {
    const size_t first = end + 1;
    end = spelling.find('.', first);
    made = member(made, spelling.substr(first, end - first));
  }
  return made;
}

ExprId SfcBuilder::call(ExprId callee, std::initializer_list<ExprId> arguments) {
  std::vector<Argument> list;
  for (const ExprId value : arguments) list.push_back({{}, value, false, false, loc_});
  return build_.call(callee, list, loc_);
}

void SfcBuilder::callBlock(ExprId block, std::string_view pin, ExprId value) {
  const Argument argument{{names_.intern(pin), loc_}, value, false, false, loc_};
  callStatement(build_.call(block, {&argument, 1}, loc_));
}

}  // namespace rung::text
