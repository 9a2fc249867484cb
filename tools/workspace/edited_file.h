// SPDX-License-Identifier: Apache-2.0
// A file in ST of a checked project while somebody types in it. In: the file as the project was checked with it, then
// one text after another. Out: the project with the bodies of the new text, as long as only bodies differ; what the
// rest of the file declares, and all other files, stay as they are.
//
//   FUNCTION_BLOCK Ramp VAR_OUTPUT y : REAL; END_VAR
//     y := y + 1.0;                                      <- a change from here …
//   END_FUNCTION_BLOCK                                   <- … to here
//
// The declaration around the change, a POU with all its methods and actions, is parsed again as a text of its own and
// its bodies are checked again; the sources map it, and what lies after it, to the new text.
#pragma once

#include <string>
#include <vector>

#include "sema/check.h"
#include "tools/driver/compile.h"

namespace rung::workspace {

class EditedFile {
 public:
  EditedFile(driver::Compilation& of, FileId file);

  // Takes the text as that of the file. False: more than bodies differ, or other parts of the project depend on them.
  // Then the project is of no use until it is checked again.
  bool replace(const std::string& text);
  // Takes the text as that of the file, which is then to be parsed. False: other files may depend on how it is read, or
  // it on them.
  bool take(const std::string& text);
  FileId file() const { return file_; }
  // Of the declaration that the change to this text is in; 0: in none.
  size_t bytesAround(std::string_view text) const;
  // Frees the texts of before. No location leads there any more.
  void release();

 private:
  using NewBody = sema::CheckedProject::NewBody;

  struct Span {  // offsets in the current text
    uint32_t begin, end;
    bool contains(uint32_t from, uint32_t to) const { return begin <= from && to <= end; }
    friend bool operator==(const Span&, const Span&) = default;
  };
  struct Body {
    Span span;         // with the blanks around it
    uint32_t was_end;  // of the span, in the text that was parsed as a whole
  };
  struct Region {  // of a POU and its members, with the pragmas before it
    size_t decl;   // index in the declarations of the file
    Span span, was;
    size_t first_body, bodies;
    FileId copy;  // that was parsed last; none: the whole text
  };
  struct Change {
    uint32_t begin, old_end, new_end;
    uint32_t delta() const { return new_end - old_end; }  // modulo 2^32
  };

  bool findRegions();
  bool findBodies(DeclId decl, Loc base, std::string_view text, std::vector<Span>& out) const;
  Change changeTo(std::string_view text) const;
  Region* regionOf(const Change& change, size_t& body);
  static bool keepsWords(const Body& body, const Change& change, std::string_view text);
  bool keepsMessages(const Region& region, const Change& change, std::string_view text) const;
  void shift(const Change& change, const Region& region, size_t body);
  bool mapSources(Region& region, const std::string& text);
  bool retractSyntaxErrors(const Region& region);
  bool parse(Region& region, FileUnit& unit);
  DeclId splice(DeclId old, DeclId parsed, std::vector<NewBody>& bodies) const;
  bool speaksOfItself(const Region& region, const std::vector<NewBody>& bodies) const;
  std::vector<NewBody> bodiesOf(DeclId decl) const;
  FileUnit& unit();

  driver::Compilation& of_;
  FileId file_;
  FileId before_;     // the text before take()
  FileId was_;        // the text that was parsed as a whole; none: the current one
  bool is_plain_;     // ST as it is on disk, without directives
  bool has_regions_;  // and bodies can be told from declarations
  std::vector<Region> regions_;
  std::vector<Body> bodies_;  // sorted
};

}  // namespace rung::workspace
