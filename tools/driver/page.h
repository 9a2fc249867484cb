// SPDX-License-Identifier: Apache-2.0
// A page of docs/errors for people: no Markdown, code indented; styled for a terminal on request. Called by
// explain.cpp.
#pragma once

#include <string>
#include <string_view>

namespace rung::driver {

std::string renderPage(std::string_view page, bool styled);

}  // namespace rung::driver
