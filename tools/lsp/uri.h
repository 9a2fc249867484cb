// SPDX-License-Identifier: Apache-2.0
// The URIs of files. In: an absolute path. Out: `file:///…`, and back.
#pragma once

#include <string>
#include <string_view>

namespace rung::lsp {

std::string uriOf(std::string_view path);
// Empty: it is not a file of this machine.
std::string pathOfUri(std::string_view uri);

}  // namespace rung::lsp
