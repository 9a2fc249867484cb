// SPDX-License-Identifier: Apache-2.0
// The tokens of a file with what they mean, for colours. In: a view. Out: tokens on one line each, in the order of the
// file.
#pragma once

#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

// In the order of the legend of the protocol (tools/lsp/semantic_tokens.cpp).
enum class TokenKind : uint8_t {
  Namespace,
  Type,
  Block,
  Interface,
  Structure,
  Enumeration,
  Item,
  Variable,
  Parameter,
  Field,
  Function,
  Method,
  Property,
  Keyword,
  Comment,
  String,
  Number,
  Operator,
  Pragma
};
enum TokenTrait : uint8_t { kDeclaration = 1, kReadOnly = 2, kGlobal = 4, kOfLibrary = 8, kDocumentation = 16 };

struct Token {
  FileRange range;
  TokenKind kind;
  uint8_t traits = 0;
};
std::vector<Token> tokensOf(const View& view, FileId file);

}  // namespace rung::ide
