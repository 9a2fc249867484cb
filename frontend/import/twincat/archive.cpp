// SPDX-License-Identifier: Apache-2.0
// Objects, lists and values of TwinCAT's archives; see archive.h.
#include "frontend/import/twincat/archive.h"

#include "frontend/import/diagnostics.h"
#include "frontend/source/names.h"

namespace rung::importer::twincat {
std::string pinName(PinDirection direction, size_t index) {
  if (direction != PinDirection::Output) return "IN" + std::to_string(index + 1);
  return index == 0 ? "OUT" : "OUT" + std::to_string(index);
}

const xml::Element* Archive::root(const xml::Element& body, std::string_view type) const {
  const xml::Element* archive = document_.child(body, "XmlArchive");
  const xml::Element* data = archive == nullptr ? nullptr : document_.child(*archive, "Data");
  for (const xml::Element& e : items(data))
    if (e.name == "o" && typeOf(e) == type) return &e;
  return nullptr;
}

const xml::Element* Archive::member(const xml::Element& owner, std::string_view name) const {
  for (const xml::Element& e : document_.children(owner)) {
    const xml::Attribute* called = document_.attribute(e, "n");
    if (called != nullptr && called->raw == name) return isNothing(e) ? nullptr : &e;
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

xml::Excerpt Archive::excerptOf(const xml::Element& value) const {
  xml::Excerpt excerpt(document_, value);
  const std::string all = document_.text(value, sources_);
  excerpt.quoted = all.size() >= 2 && all.front() == '"' && all.back() == '"';
  return excerpt;
}

std::string Archive::commentOf(const xml::Element& owner, std::string_view name) const {
  std::string comment = text(owner, name);
  while (!comment.empty() && isBlankCharacter(comment.back())) comment.pop_back();
  return comment;
}

void Archive::reportObject(Diagnostics& diagnostics, const xml::Element& object, std::string_view language,
                           std::string_view owner) const {
  const std::string type = typeOf(object);
  diagnostics.report(diag::ArchiveObject, document_.locOf(object, "t"), {type.empty() ? "?" : type, language, owner});
}

}  // namespace rung::importer::twincat
