// A text from parts of files; see assembly.h.
#include "frontend/vendor/assembly.h"

namespace rung::vendor {

void Assembly::segment(Loc from, bool verbatim) {
  segments_.push_back({static_cast<uint32_t>(text_.size()), from, verbatim});
}

void Assembly::add(Loc begin, Loc end) {
  const FileId file = sources_.fileOf(begin);
  segment(begin, true);
  text_ += sources_.text(file).substr(begin.offset - sources_.begin(file).offset, end.offset - begin.offset);
  end_ = end;
}

void Assembly::add(const xml::Document& document, const xml::Element& element) {
  for (uint32_t i = element.first_run; i < element.end_run; ++i) {
    const xml::Run& run = document.runs[i];
    const Loc end{run.loc.offset + run.length};
    if (run.character == 0) {
      add(run.loc, end);
    } else {
      std::string character;
      appendUtf8(character, run.character);
      replace(run.loc, end, character);
    }
  }
  if (element.first_run == element.end_run) end_ = element.end;
}

void Assembly::word(std::string_view text) {
  if (text.empty()) return;
  segment(end_, false);
  text_ += text;
}

void Assembly::replace(Loc begin, Loc end, std::string_view text) {
  segment(begin, false);
  text_ += text;
  end_ = end;
}

FileId Assembly::finish(Sources& sources, FileId file) {
  if (segments_.empty()) segments_.push_back({0, sources.begin(file), false});
  if (!segments_[0].from) segments_[0].from = sources.begin(file);
  const FileId made = sources.addAssembled(std::string(sources.path(file)), std::move(text_), std::move(segments_));
  if (made) sources.showAs(made, std::string(sources.shown(file)));
  return made;
}

}  // namespace rung::vendor
