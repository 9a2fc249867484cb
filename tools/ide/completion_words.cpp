// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/completion_words.h"

#include <algorithm>

#include "frontend/source/names.h"
#include "tools/driver/project_file.h"
#include "tools/ide/pragma_words.h"

namespace rung::ide {
namespace {

void addPragma(const PragmaWord& word, Completion& result) {
  CompletionItem& item = result.items.emplace_back();
  item.label = word.name;
  item.kind = CompletionKind::Pragma;
  item.documentation = word.meaning;
  if (!item.label.ends_with("''")) return;
  item.insert = item.label.substr(0, item.label.size() - 1) + "$1'";
  item.is_snippet = true;
}

// The values in `{attribute 'symbol' := '`.
void addAttributeValues(std::string_view attribute, Completion& result) {
  for (const PragmaWord& word : pragmaWords()) {
    if (!word.is_attribute || word.values == nullptr || !sameIdentifier(word.name, attribute)) continue;
    for (std::string_view values = word.values; !values.empty();) {
      const std::string_view value = values.substr(0, values.find(' '));
      CompletionItem& item = result.items.emplace_back();
      item.label = value;
      item.kind = CompletionKind::Item;
      values.remove_prefix(std::min(value.size() + 1, values.size()));
    }
  }
}

}  // namespace

// A pragma after its brace, the name of an attribute in quotes, or the value of one.
void addPragmas(const Cursor& cursor, Completion& result) {
  const std::string_view text = cursor.prefix;  // from the brace on
  const auto quotes = std::count(text.begin(), text.end(), '\'');
  const size_t open = text.find('\''), close = text.find('\'', open + 1);
  const bool is_attribute = sameIdentifier(text.substr(0, 10), "{attribute");
  if (quotes == 3 && is_attribute) addAttributeValues(text.substr(open + 1, close - open - 1), result);
  if (quotes > 1 || (quotes == 1 && !is_attribute)) return;
  for (const PragmaWord& word : pragmaWords())
    if (word.is_attribute == (quotes == 1)) addPragma(word, result);
}

// The sections after `[`, and the keys of the section around the cursor.
void addProjectKeys(std::string_view source, size_t offset, Completion& result) {
  const size_t begin = source.find_last_of("\r\n", offset == 0 ? 0 : offset - 1);
  const size_t line = begin == std::string_view::npos || offset == 0 ? 0 : begin + 1;
  const std::string_view before = source.substr(line, offset - line);
  if (before.find('=') != std::string_view::npos) return;
  const bool is_section = before.starts_with('[');
  const size_t header = line < 2 ? std::string_view::npos : source.rfind("\n[", line - 2);
  const size_t section = header == std::string_view::npos ? (source.starts_with('[') ? 0 : source.size()) : header + 1;
  const std::string_view kind = source.substr(section, source.find_first_of(" ]\r\n", section) - section);
  for (const driver::ProjectSchema& schema : driver::projectSchemas()) {
    if (is_section) {
      CompletionItem& item = result.items.emplace_back();
      item.label = schema.kind;
      item.kind = CompletionKind::Key;
      item.insert = std::string(schema.kind) + (schema.named ? " " : "");
    } else if (schema.keys != nullptr && kind == "[" + std::string(schema.kind)) {
      std::string_view keys = schema.keys;
      while (!keys.empty()) {
        const std::string_view key = keys.substr(0, keys.find(' '));
        CompletionItem& item = result.items.emplace_back();
        item.label = key;
        item.kind = CompletionKind::Key;
        item.insert = std::string(key) + " = ";
        keys.remove_prefix(std::min(key.size() + 1, keys.size()));
      }
    }
  }
}

}  // namespace rung::ide
