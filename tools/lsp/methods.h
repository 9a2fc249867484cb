// SPDX-License-Identifier: Apache-2.0
// The methods of the protocol that the server has, by name.
#pragma once

#include <string_view>

#include "tools/lsp/session.h"

namespace rung::lsp {

struct RequestMethod {
  const char* name;
  Answer (*answer)(Session& session, const Json& params);
};
struct NotificationMethod {
  const char* name;
  void (*take)(Session& session, const Json& params);
};

// Null: the server does not have it.
const RequestMethod* findRequest(std::string_view method);
const NotificationMethod* findNotification(std::string_view method);

}  // namespace rung::lsp
