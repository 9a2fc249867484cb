// Objects, lists and values of TwinCAT's archives; see archive.h.
#include "frontend/import/twincat/archive.h"

#include "frontend/source/names.h"

namespace rung::vendor {
namespace {

bool isNameChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

bool isPath(std::string_view text) {
  bool at_begin = true;
  for (const char c : text) {
    if (c == '.' && !at_begin) {
      at_begin = true;
    } else if (isNameChar(c) && !(at_begin && c >= '0' && c <= '9')) {
      at_begin = false;
    } else {
      return false;
    }
  }
  return !at_begin;
}

const xml::Element* Archive::root(const xml::Element& body, std::string_view type) const {
  const xml::Element* archive = document_.child(body, "XmlArchive");
  const xml::Element* data = archive == nullptr ? nullptr : document_.child(*archive, "Data");
  for (const xml::Element* e = first(data); e != nullptr; e = next(*e))
    if (e->name == "o" && typeOf(*e) == type) return e;
  return nullptr;
}

const xml::Element* Archive::member(const xml::Element& owner, std::string_view name) const {
  for (const xml::Element* e = document_.firstChild(owner); e != nullptr; e = document_.next(*e)) {
    const xml::Attribute* called = document_.attribute(*e, "n");
    if (called != nullptr && called->raw == name) return isNothing(*e) ? nullptr : e;
  }
  return nullptr;
}

std::string Archive::typeOf(const xml::Element& object) const {
  const xml::Attribute* type = document_.attribute(object, "t");
  if (type != nullptr) return document_.decoded(*type);
  if (object.parent == xml::kNone || document_.elements[object.parent].name != "l2") return {};
  return document_.value(document_.elements[object.parent], "cet");
}

std::string Archive::text(const xml::Element& value) const {
  std::string text = document_.text(value, sources_);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

std::string Archive::text(const xml::Element& owner, std::string_view name) const {
  const xml::Element* value = member(owner, name);
  return value == nullptr ? std::string() : text(*value);
}

bool Archive::isTrue(const xml::Element& owner, std::string_view name) const {
  return sameIdentifier(text(owner, name), "true");
}

uint64_t Archive::number(const xml::Element& owner, std::string_view name) const {
  uint64_t number = 0;
  for (const char c : text(owner, name)) {
    if (c < '0' || c > '9' || number > UINT64_MAX / 16) break;
    number = number * 10 + static_cast<uint64_t>(c - '0');
  }
  return number;
}

Loc Archive::locOf(const xml::Element& value) const {
  if (value.first_run == value.end_run) return value.loc;
  const xml::Run& run = document_.runs[value.first_run];
  const bool quoted = run.character == 0 && run.length > 1 && document_.text(value, sources_).front() == '"';
  return {run.loc.offset + (quoted ? 1u : 0u)};
}

void Archive::write(const xml::Element& value, xml::SourceMappedText& out) const {
  const std::string all = document_.text(value, sources_);
  const bool quoted = all.size() >= 2 && all.front() == '"' && all.back() == '"';
  for (uint32_t r = value.first_run; r < value.end_run; ++r) {
    const xml::Run& run = document_.runs[r];
    const bool opens = quoted && r == value.first_run, closes = quoted && r + 1 == value.end_run;
    if (run.character != 0) {  // possibly a quote written as an entity
      if (!opens && !closes) out.addRuns(document_, r, r + 1);
      continue;
    }
    const Loc begin{run.loc.offset + (opens ? 1u : 0u)}, end{run.loc.offset + run.length - (closes ? 1u : 0u)};
    if (begin.offset < end.offset) out.add(begin, end);
  }
}

void Archive::writeString(const xml::Element& owner, std::string_view name, xml::SourceMappedText& out) const {
  const xml::Element* value = member(owner, name);
  std::string text = value == nullptr ? std::string() : this->text(*value);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  if (text.empty()) return;
  std::string quoted = " '";
  for (const char c : text) {
    if (c == '\'' || c == '$') quoted += '$';
    quoted += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  out.put(value->loc, quoted + "'");
}

}  // namespace rung::vendor
