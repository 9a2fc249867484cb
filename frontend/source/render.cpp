// SPDX-License-Identifier: Apache-2.0
// Text, JSON and SARIF renderings of a list of diagnostics. All three escape what a terminal or a parser could
// interpret as a command: control bytes, bytes that are not UTF-8, and characters that reorder text.
#include "frontend/source/render.h"

#include <algorithm>
#include <map>
#include <vector>

#include "frontend/source/fixes.h"

namespace rung {
namespace {

constexpr size_t kMaxColumns = 200;   // of a source line
constexpr size_t kCaretContext = 80;  // columns kept to the left of the caret when a longer line is cut

const char* severityName(Severity severity) {
  switch (severity) {
    case Severity::Note: return "note";
    case Severity::Info: return "info";
    case Severity::Warning: return "warning";
    case Severity::Error: return "error";
  }
  return "";
}

// The length of the UTF-8 character at the start of the string; 0: not UTF-8.
size_t characterLength(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const size_t length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (length == 0 || length > text.size()) return 0;
  if (length > 1 && findInvalidUtf8(text.substr(0, length)) != std::string_view::npos) return 0;
  return length;
}

// Characters that change how the characters around them are shown: C1 controls and bidirectional overrides.
bool isConfusable(std::string_view character) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 2) return byte(0) == 0xc2 && byte(1) < 0xa0;
  if (character.size() != 3 || byte(0) != 0xe2) return false;
  if (byte(1) == 0x80) return byte(2) >= 0xa8 && byte(2) <= 0xae;  // U+2028..U+202E
  return byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9;    // U+2066..U+2069
}

void appendHex(std::string& out, std::string_view prefix, unsigned value, int digits) {
  out += prefix;
  for (int i = digits - 1; i >= 0; --i) out += "0123456789abcdef"[value >> (4 * i) & 15];
}

// Appends one character, escaped where necessary; returns the bytes consumed and the columns it fills.
struct Shown {
  size_t bytes, columns;
};
Shown appendVisible(std::string& out, std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead >= 0x20 && lead < 0x7f) {
    out += text[0];
    return {1, 1};
  }
  const size_t length = characterLength(text);
  if (length < 2 || isConfusable(text.substr(0, length))) {
    const size_t bytes = std::max<size_t>(length, 1);
    for (size_t i = 0; i < bytes; ++i) appendHex(out, "\\x", static_cast<unsigned char>(text[i]), 2);
    return {bytes, 4 * bytes};
  }
  out += text.substr(0, length);
  return {length, 1};
}

std::string visible(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size();) i += appendVisible(out, text.substr(i)).bytes;
  return out;
}

// ---- the source range of a diagnostic, for all formats

struct Range {
  std::string_view path;
  SourceLocation location;  // line 0: the whole file, or no file
  uint32_t bytes = 0;       // underlined
  uint32_t end_column = 0;  // exclusive
  std::string_view line;    // the source line
  size_t line_at = 0;       // offset of the underline in it
};

Range rangeOf(const Sources& sources, Loc loc, uint32_t length, std::string_view path) {
  Range range;
  range.path = path;
  if (!loc) return range;
  range.location = sources.location(loc);
  if (!range.location.file) return range;
  range.path = sources.displayPath(range.location.file);
  range.line = sources.line(range.location.file, range.location.line);
  const uint32_t offset = sources.originalLocation(loc).offset - sources.begin(range.location.file).offset;
  const auto line_start = static_cast<size_t>(range.line.data() - sources.original(range.location.file).data());
  range.line_at = std::min<size_t>(offset - line_start, range.line.size());
  const size_t wanted = length != 0 ? length : sources.tokenAt(loc).size();
  range.bytes = static_cast<uint32_t>(std::min(wanted, range.line.size() - range.line_at));
  range.end_column =
      range.location.column + std::max(1u, countCharacters(range.line.substr(range.line_at, range.bytes)));
  return range;
}

// ---- text

struct Colors {
  const char *bold, *error, *warning, *note, *caret, *off;
};
constexpr Colors kPlain = {"", "", "", "", "", ""};
constexpr Colors kAnsi = {"\033[1m", "\033[1;31m", "\033[1;35m", "\033[1;36m", "\033[1;32m", "\033[0m"};

class TextRenderer {
 public:
  TextRenderer(const Sources& sources, bool color) : sources_(sources), colors_(color ? kAnsi : kPlain) {}

  void add(const Diagnostic& diagnostic) {
    const Range range = rangeOf(sources_, diagnostic.loc, diagnostic.length, diagnostic.path);
    heading(range, diagnostic.severity, diagInfo(diagnostic.diag).code, diagnostic.message);
    excerpt(range);
    if (!diagnostic.element.empty()) heading(range, Severity::Note, nullptr, "in " + diagnostic.element);
    for (const Diagnostic::Attached& note : diagnostic.notes) {
      if (!note.loc) {
        heading(range, Severity::Note, nullptr, note.message);
        continue;
      }
      const Range there = rangeOf(sources_, note.loc, 0, {});
      heading(there, Severity::Note, nullptr, note.message);
      excerpt(there);
    }
  }

  void notShown(uint32_t count, const char* what) {
    if (count == 0) return;
    out_ += std::to_string(count) + " more " + what + (count == 1 ? "" : "s") + " not shown (--max-errors)\n";
  }
  void notShownOf(std::string_view code, uint32_t count) {
    out_ += std::to_string(count) + " more " + std::string(code) + " not shown (--max-warnings=0 shows all)\n";
  }

  std::string take() { return std::move(out_); }

 private:
  void heading(const Range& range, Severity severity, const char* code, std::string_view message) {
    out_ += colors_.bold;
    if (!range.path.empty()) {
      out_ += visible(range.path);
      if (range.location.line != 0) {
        out_ += ':' + std::to_string(range.location.line) + ':' + std::to_string(range.location.column);
      }
    } else {
      out_ += "rung";
    }
    out_ += ": ";
    out_ += colors_.off;
    out_ += severity == Severity::Error     ? colors_.error
            : severity == Severity::Warning ? colors_.warning
                                            : colors_.note;
    out_ += severityName(severity);
    if (code != nullptr) out_ += std::string("[") + code + "]";
    out_ += ": ";
    out_ += colors_.off;
    out_ += colors_.bold;
    out_ += visible(message);
    out_ += colors_.off;
    out_ += '\n';
  }

  // The source line and the underline below it. A long line is cut on both sides of the underline.
  void excerpt(const Range& range) {
    if (range.location.line == 0) return;
    size_t first = 0;
    if (range.line.size() > kMaxColumns && range.line_at > kCaretContext) {
      first = range.line_at - kCaretContext;
      while (first > 0 && (static_cast<unsigned char>(range.line[first]) & 0xc0) == 0x80) --first;
    }
    std::string text, underline;
    if (first > 0) {
      text = "...";
      underline = "   ";
    }
    const size_t underline_end = range.line_at + range.bytes;
    size_t columns = 0, i = first;
    while (i < range.line.size() && columns < kMaxColumns) {
      if (range.line[i] == '\t') {  // kept, so that the underline is aligned for every tab width
        text += '\t';
        if (i < range.line_at) underline += '\t';
        if (i >= range.line_at && i < underline_end) underline += i == range.line_at ? '^' : '~';
        ++i;
        ++columns;
        continue;
      }
      const Shown shown = appendVisible(text, range.line.substr(i));
      if (i < range.line_at) {
        underline.append(shown.columns, ' ');
      } else if (i < underline_end) {
        underline += i == range.line_at ? '^' : '~';
        underline.append(shown.columns - 1, '~');
      }
      i += shown.bytes;
      columns += shown.columns;
    }
    if (i < range.line.size()) text += "...";
    if (range.bytes == 0) underline += '^';
    const std::string number = std::to_string(range.location.line);
    out_ += ' ' + number + " | " + text + '\n';
    out_.append(number.size() + 2, ' ');
    out_ += "| ";
    out_ += colors_.caret;
    out_ += underline;
    out_ += colors_.off;
    out_ += '\n';
  }

  const Sources& sources_;
  const Colors& colors_;
  std::string out_;
};

std::string renderText(const Diagnostics& diagnostics, const Sources& sources, const RenderOptions& options) {
  TextRenderer text(sources, options.color);
  std::map<std::string_view, uint32_t> counts;  // of warnings by code
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const bool is_warning = diagnostic.severity == Severity::Warning && options.max_warnings != 0;
    if (is_warning && ++counts[diagInfo(diagnostic.diag).code] > options.max_warnings) continue;
    text.add(diagnostic);
  }
  for (const auto& [code, count] : counts)
    if (count > options.max_warnings) text.notShownOf(code, count - options.max_warnings);
  text.notShown(diagnostics.droppedWarningCount(), "warning");
  text.notShown(diagnostics.droppedCount(), "error");
  return text.take();
}

// ---- JSON

void appendField(std::string& out, const char* name, uint32_t value) {
  out += std::string(",\"") + name + "\":" + std::to_string(value);
}

void appendField(std::string& out, const char* name, std::string_view value) {
  out += std::string(",\"") + name + "\":" + jsonQuote(value);
}

void appendJsonLocation(std::string& out, const Range& range) {
  if (!range.path.empty()) appendField(out, "path", range.path);
  if (range.location.line == 0) return;
  appendField(out, "line", range.location.line);
  appendField(out, "column", range.location.column);
  appendField(out, "endColumn", range.end_column);
}

SourceLocation locationOf(const Sources& sources, FileId file, uint32_t byte) {
  return sources.location({sources.begin(file).offset + byte});
}

std::string jsonFix(const Sources& sources, const Fix& fix, const std::vector<FileEdit>& edits) {
  std::string out = "{\"title\":" + jsonQuote(fix.title) + ",\"preferred\":" + (fix.is_sure ? "true" : "false");
  out += ",\"edits\":[";
  for (const FileEdit& edit : edits) {
    const SourceLocation begin = locationOf(sources, edit.file, edit.begin);
    const SourceLocation end = locationOf(sources, edit.file, edit.end);
    if (&edit != edits.data()) out += ',';
    out += "{\"path\":" + jsonQuote(sources.displayPath(edit.file));
    appendField(out, "line", begin.line);
    appendField(out, "column", begin.column);
    appendField(out, "endLine", end.line);
    appendField(out, "endColumn", end.column);
    appendField(out, "text", edit.text);
    out += '}';
  }
  return out + "]}";
}

// The member `fixes`, with a comma before it; empty: there are none.
std::string fixesOf(const Sources& sources, const Diagnostic& diagnostic,
                    std::string (*show)(const Sources&, const Fix&, const std::vector<FileEdit>&)) {
  std::string out;
  for (const Fix& fix : diagnostic.fixes)
    if (const std::vector<FileEdit> edits = fileEdits(sources, diagnostic, fix); !edits.empty())
      out += (out.empty() ? ",\"fixes\":[" : ",") + show(sources, fix, edits);
  return out.empty() ? out : out + "]";
}

std::string renderJson(const Diagnostics& diagnostics, const Sources& sources) {
  std::string out = "{\"diagnostics\":[";
  const char* separator = "\n";
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const Range range = rangeOf(sources, diagnostic.loc, diagnostic.length, diagnostic.path);
    out += separator;
    separator = ",\n";
    out += std::string("{\"code\":\"") + diagInfo(diagnostic.diag).code + "\"";
    appendField(out, "severity", std::string_view(severityName(diagnostic.severity)));
    appendField(out, "message", diagnostic.message);
    appendJsonLocation(out, range);
    if (!diagnostic.element.empty()) appendField(out, "element", diagnostic.element);
    out += ",\"notes\":[";
    for (const Diagnostic::Attached& note : diagnostic.notes) {
      if (&note != diagnostic.notes.data()) out += ',';
      out += "{\"message\":" + jsonQuote(note.message);
      appendJsonLocation(out, note.loc ? rangeOf(sources, note.loc, 0, {}) : range);
      out += '}';
    }
    out += "]" + fixesOf(sources, diagnostic, jsonFix) + "}";
  }
  out += "\n]";
  appendField(out, "errors", diagnostics.errorCount());
  appendField(out, "warnings", diagnostics.warningCount());
  appendField(out, "notShown", diagnostics.droppedCount() + diagnostics.droppedWarningCount());
  return out + "}\n";
}

// ---- SARIF 2.1.0

std::string uriOf(std::string_view path) {
  std::string out = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       std::string_view("/-._~").find(c) != std::string_view::npos;
    if (plain) {
      out += c;
    } else {
      appendHex(out, "%", static_cast<unsigned char>(c), 2);
    }
  }
  return out;
}

// The members of a SARIF location object, without the braces around it. Empty: no location.
std::string sarifLocation(const Range& range) {
  if (range.path.empty()) return {};
  std::string out = "\"physicalLocation\":{\"artifactLocation\":{\"uri\":" + jsonQuote(uriOf(range.path)) + "}";
  if (range.location.line != 0) {
    out += ",\"region\":{\"startLine\":" + std::to_string(range.location.line) +
           ",\"startColumn\":" + std::to_string(range.location.column) +
           ",\"endColumn\":" + std::to_string(range.end_column) + "}";
  }
  return out + "}";
}

const char* sarifLevel(Severity severity) {
  switch (severity) {
    case Severity::Error: return "error";
    case Severity::Warning: return "warning";
    case Severity::Info:
    case Severity::Note: return "note";
  }
  return "none";
}

std::string sarifRule(Diag diag, std::string_view (*page)(std::string_view)) {
  const DiagInfo& info = diagInfo(diag);
  std::string_view help = page != nullptr ? page(info.code) : std::string_view();
  if (help.empty()) help = info.text;
  const std::string text = jsonQuote(help);
  return std::string("{\"id\":\"") + info.code + "\",\"name\":\"" + info.name +
         "\",\"shortDescription\":{\"text\":" + jsonQuote(info.text) + "},\"help\":{\"text\":" + text +
         ",\"markdown\":" + text + "},\"defaultConfiguration\":{\"level\":\"" + sarifLevel(info.severity) + "\"}}";
}

// One artifactChange for each file; the edits are sorted.
std::string sarifFix(const Sources& sources, const Fix& fix, const std::vector<FileEdit>& edits) {
  std::string out = "{\"description\":{\"text\":" + jsonQuote(fix.title) + "},\"artifactChanges\":[";
  for (size_t i = 0; i < edits.size(); ++i) {
    const FileEdit& edit = edits[i];
    const bool begins_file = i == 0 || edits[i - 1].file != edit.file;
    if (begins_file) {
      const std::string uri = jsonQuote(uriOf(sources.displayPath(edit.file)));
      out += (i == 0 ? "" : "]},") + ("{\"artifactLocation\":{\"uri\":" + uri + "},\"replacements\":[");
    }
    const SourceLocation begin = locationOf(sources, edit.file, edit.begin);
    const SourceLocation end = locationOf(sources, edit.file, edit.end);
    out += std::string(begins_file ? "" : ",") + "{\"deletedRegion\":{\"startLine\":" + std::to_string(begin.line);
    appendField(out, "startColumn", begin.column);
    appendField(out, "endLine", end.line);
    appendField(out, "endColumn", end.column);
    out += "},\"insertedContent\":{\"text\":" + jsonQuote(edit.text) + "}}";
  }
  return out + "]}],\"properties\":{\"preferred\":" + (fix.is_sure ? "true" : "false") + "}}";
}

std::string sarifResult(const Diagnostic& diagnostic, const Sources& sources, size_t rule) {
  const Range range = rangeOf(sources, diagnostic.loc, diagnostic.length, diagnostic.path);
  std::string message = diagnostic.message;
  for (const Diagnostic::Attached& note : diagnostic.notes) {
    if (!note.loc) message += "; " + note.message;
  }
  std::string out = std::string("{\"ruleId\":\"") + diagInfo(diagnostic.diag).code +
                    "\",\"ruleIndex\":" + std::to_string(rule) + ",\"level\":\"" + sarifLevel(diagnostic.severity) +
                    "\",\"message\":{\"text\":" + jsonQuote(message) + "}";
  std::string location = sarifLocation(range);
  if (!diagnostic.element.empty()) {
    if (!location.empty()) location += ',';
    location += "\"logicalLocations\":[{\"fullyQualifiedName\":" + jsonQuote(diagnostic.element) + "}]";
  }
  if (!location.empty()) out += ",\"locations\":[{" + location + "}]";
  std::string related;
  for (const Diagnostic::Attached& note : diagnostic.notes) {
    if (!note.loc) continue;
    related += related.empty() ? "{" : ",{";
    related +=
        sarifLocation(rangeOf(sources, note.loc, 0, {})) + ",\"message\":{\"text\":" + jsonQuote(note.message) + "}}";
  }
  if (!related.empty()) out += ",\"relatedLocations\":[" + related + "]";
  return out + fixesOf(sources, diagnostic, sarifFix) + "}";
}

std::string renderSarif(const Diagnostics& diagnostics, const Sources& sources,
                        std::string_view (*page)(std::string_view)) {
  std::vector<Diag> rules;
  for (const Diagnostic& diagnostic : diagnostics.all()) rules.push_back(diagnostic.diag);
  std::sort(rules.begin(), rules.end());
  rules.erase(std::unique(rules.begin(), rules.end()), rules.end());

  std::string out =
      "{\"$schema\":\"https://json.schemastore.org/sarif-2.1.0.json\",\"version\":\"2.1.0\",\"runs\":[{"
      "\"tool\":{\"driver\":{\"name\":\"rung\",\"version\":\"" RUNG_VERSION "\",\"rules\":[";
  for (size_t i = 0; i < rules.size(); ++i) out += (i == 0 ? "\n" : ",\n") + sarifRule(rules[i], page);
  out += "]}},\"columnKind\":\"unicodeCodePoints\",\"results\":[";
  const char* separator = "\n";
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const auto rule = std::lower_bound(rules.begin(), rules.end(), diagnostic.diag) - rules.begin();
    out += separator + sarifResult(diagnostic, sources, static_cast<size_t>(rule));
    separator = ",\n";
  }
  return out + "\n]}]}\n";
}

}  // namespace

std::string jsonQuote(std::string_view text) {
  std::string out = "\"";
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const size_t length = characterLength(text.substr(i, 4));
    if (length == 0) {
      out += "\\ufffd";
    } else if (length > 1) {
      out += text.substr(i, length);
    } else if (lead == '"' || lead == '\\') {
      out += '\\';
      out += text[i];
    } else if (lead == '\n') {
      out += "\\n";
    } else if (lead == '\t') {
      out += "\\t";
    } else if (lead < 0x20 || lead == 0x7f) {
      appendHex(out, "\\u", lead, 4);
    } else {
      out += text[i];
    }
    i += std::max<size_t>(length, 1);
  }
  return out + '"';
}

std::string render(const Diagnostics& diagnostics, const Sources& sources, const RenderOptions& options) {
  switch (options.format) {
    case DiagnosticFormat::Text: return renderText(diagnostics, sources, options);
    case DiagnosticFormat::Json: return renderJson(diagnostics, sources);
    case DiagnosticFormat::Sarif: return renderSarif(diagnostics, sources, options.page);
  }
  return {};
}

}  // namespace rung
