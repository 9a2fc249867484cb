// SPDX-License-Identifier: Apache-2.0
// A program that runs elsewhere and is watched by its monitor: the part of the debug adapter for `attach`. In: the URL
// that the program has printed. Out: its tasks, variables and faults as an editor shows them; it can be stopped and
// started, and its variables written and forced, but it is not at any statement.
#pragma once

#include <string>
#include <vector>

#include "tools/dap/connection.h"
#include "tools/monitor/client.h"

namespace rung::dap {

class Attached {
 public:
  explicit Attached(Connection& connection) : connection_(connection) {}

  // Empty, or why the program is not reached.
  std::string connect(const std::string& url);
  // False: the request is not one of these.
  bool take(const Json& request, std::string_view command, const Json& arguments);

 private:
  void threads(const Json& request);
  void stackTrace(const Json& request);
  void scopes(const Json& request);
  void variables(const Json& request, const Json& arguments);
  void evaluate(const Json& request, const Json& arguments);
  void write(const Json& request, const std::string& path, std::string_view value);
  void setVariable(const Json& request, const Json& arguments);
  void command(const Json& request, const char* what, const char* reason);
  void refuseBreakpoints(const Json& request, const Json& arguments);
  Json valueOf(const std::string& path, std::string& error);

  Connection& connection_;
  monitor::Client client_;
  std::vector<std::string> roots_;  // by variablesReference - 2
};

}  // namespace rung::dap
