// SPDX-License-Identifier: Apache-2.0
// Renders a list of diagnostics. In: Diagnostics and Sources. Out: text for people (path:line:col: error[E0412]: …, the
// source line, a caret, notes), JSON (one object) or SARIF 2.1.0. Called by the tool at the end of a run.
#pragma once

#include <string>
#include <string_view>

#include "frontend/source/diagnostics.h"

namespace rung {

enum class DiagnosticFormat { Text, Json, Sarif };

struct RenderOptions {
  DiagnosticFormat format = DiagnosticFormat::Text;
  bool color = false;
  // Returns the page of a code, as `rung explain` shows it, for SARIF's rule help; null or empty: the message template
  // is used.
  std::string_view (*page)(std::string_view code) = nullptr;
  uint32_t max_warnings = 0;  // of one code in Text, which counts the rest; 0: all
};

std::string render(const Diagnostics& diagnostics, const Sources& sources, const RenderOptions& options);

// JSON string literal with quotes, control characters escaped, and bytes that are not UTF-8 replaced.
std::string jsonQuote(std::string_view text);

}  // namespace rung
