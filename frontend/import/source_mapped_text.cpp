// SPDX-License-Identifier: Apache-2.0
// Text put together from parts of files; see source_mapped_text.h.
#include "frontend/import/source_mapped_text.h"

namespace rung::xml {

void SourceMappedText::segment(Loc from, bool verbatim) {
  segments_.push_back({static_cast<uint32_t>(text_.size()), from, verbatim});
}

void SourceMappedText::add(Loc begin, Loc end) {
  const FileId file = sources_.fileOf(begin);
  segment(begin, true);
  text_ += sources_.sourceText(file).substr(begin.offset - sources_.begin(file).offset, end.offset - begin.offset);
  end_ = end;
}

void SourceMappedText::add(const Document& document, const Element& element) {
  addRuns(document, element.first_run, element.end_run);
  if (element.first_run == element.end_run) end_ = element.end;
}

void SourceMappedText::addRuns(const Document& document, uint32_t first, uint32_t last) {
  for (uint32_t i = first; i < last; ++i) {
    const Run& run = document.runs[i];
    const Loc end{run.loc.offset + run.length};
    if (run.character == 0) {
      add(run.loc, end);
    } else {
      std::string character;
      appendUtf8(character, run.character);
      replace(run.loc, end, character);
    }
  }
}

void SourceMappedText::add(const Document& document, const Attribute& attribute) {
  const Loc end{attribute.loc.offset + static_cast<uint32_t>(attribute.raw.size())};
  if (attribute.raw.find('&') == std::string_view::npos)
    add(attribute.loc, end);
  else
    replace(attribute.loc, end, document.decoded(attribute));
}

void SourceMappedText::addUnquoted(const Document& document, const Element& element) {
  for (uint32_t i = element.first_run; i < element.end_run; ++i) {
    const Run& run = document.runs[i];
    const bool opens = i == element.first_run, closes = i + 1 == element.end_run;
    if (run.character != 0) {  // possibly a quote written as an entity
      if (!opens && !closes) addRuns(document, i, i + 1);
      continue;
    }
    const Loc begin{run.loc.offset + (opens ? 1u : 0u)}, end{run.loc.offset + run.length - (closes ? 1u : 0u)};
    if (begin < end) add(begin, end);
  }
}

void SourceMappedText::add(const Excerpt& excerpt) {
  if (excerpt.attribute != nullptr)
    add(*excerpt.document, *excerpt.attribute);
  else if (excerpt.element != nullptr && excerpt.quoted)
    addUnquoted(*excerpt.document, *excerpt.element);
  else if (excerpt.element != nullptr)
    add(*excerpt.document, *excerpt.element);
  if (excerpt.loc)
    put(excerpt.loc, excerpt.text);
  else
    word(excerpt.text);
}

std::string SourceMappedText::spellingOf(const Excerpt& excerpt) const {
  SourceMappedText spelling(sources_);
  spelling.add(excerpt);
  return spelling.text_;
}

void SourceMappedText::word(std::string_view text) {
  if (text.empty()) return;
  segment(end_, false);
  text_ += text;
}

void SourceMappedText::replace(Loc begin, Loc end, std::string_view text) {
  segment(begin, false);
  text_ += text;
  end_ = end;
}

FileId SourceMappedText::finish(Sources& sources, FileId file) {
  if (segments_.empty()) segments_.push_back({0, sources.begin(file), false});
  if (!segments_[0].from) segments_[0].from = sources.begin(file);
  const FileId created =
      sources.addSourceMapped(std::string(sources.path(file)), std::move(text_), std::move(segments_));
  if (created) sources.setDisplayPath(created, std::string(sources.displayPath(file)));
  return created;
}

}  // namespace rung::xml
