// SPDX-License-Identifier: Apache-2.0
// The comments in which tools keep their data, at the beginning of an exported file: `(* @PATH := …`, `(*@KEY@: …`.
#pragma once

#include <initializer_list>
#include <string_view>

namespace rung::importer {

// Tells whether a comment with one of these tags is among the comments before the first code of the source.
bool hasToolComment(std::string_view source, std::initializer_list<std::string_view> tags);

}  // namespace rung::importer
