// SPDX-License-Identifier: Apache-2.0
// A file in ST of a checked project while somebody types in it. In: the file as the project was checked with it, then
// one text after another. Out: the project with the bodies of the new text, as long as only bodies differ; what the
// rest of the file declares, and all other files, stay as they are.
//
//   FUNCTION_BLOCK Ramp VAR_OUTPUT y : REAL; END_VAR
//     y := y + 1.0;                                      <- a change from here …
//   END_FUNCTION_BLOCK                                   <- … to here
//
// The file is parsed again. The bodies of the declaration around the change, a POU with all its methods and actions,
// take the place of the old ones and are checked. What else is known of the file has its locations in texts of before,
// which the sources map to the new one.
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
  // Frees the texts of before. No location leads there any more.
  void release();

  FileId file() const { return file_; }

 private:
  using NewBody = sema::CheckedProject::NewBody;

  struct Span {  // offsets in the current text
    uint32_t begin, end;
    bool contains(uint32_t from, uint32_t to) const { return begin <= from && to <= end; }
    friend bool operator==(const Span&, const Span&) = default;
  };
  struct Body {
    Span span;         // with the blanks around it
    uint32_t was_end;  // of the span, in the text of the declarations
  };
  struct Region {  // a POU with its members
    size_t decl;   // index in the declarations of the file
    Span span;
    size_t first_body, bodies;
    std::vector<NewBody> pous;  // with their declarations as they were parsed first; none: not edited yet
    FileId text;                // that the bodies were parsed in, when it is not that of the declarations
    uint32_t begin = 0;         // of the region, in that text
  };
  struct Change {
    uint32_t begin, old_end, new_end;
    uint32_t delta() const { return new_end - old_end; }  // modulo 2^32
  };

  bool findRegions();
  bool findBodies(DeclId decl, Loc base, std::string_view text, std::vector<Span>& out) const;
  Change changeTo(std::string_view text) const;
  bool mayStay(const Change& change, std::string_view text) const;
  Region* regionOf(const Change& change, size_t& body);
  static bool isApart(const Body& body, const Change& change, std::string_view text);
  void shift(const Change& change, const Region& region, size_t body);
  bool edit(const std::string& text);
  void mapTexts();
  bool hasSameBodies() const;
  DeclId splice(DeclId old, DeclId parsed, std::vector<NewBody>& bodies) const;
  bool speaksOfItself(const Region& region) const;
  std::vector<NewBody> pousOf(DeclId decl) const;
  void freeLastEdit(const Region& region);
  std::span<const DeclId> decls() const;

  driver::Compilation& of_;
  FileId file_;
  bool is_plain_;                              // ST as it is on disk, without directives
  bool has_regions_ = false;                   // and bodies can be told from declarations
  FileId declarations_;                        // the text that they were parsed in; none: the current one
  Region* last_ = nullptr;                     // whose bodies were parsed in the current text; none: not edited yet
  uint32_t size_before_ = 0, size_after_ = 0;  // of the tree, at the last edit
  size_t known_ = 0;                           // beside bodies, before it
  std::vector<DeclId> decls_;                  // of the file, as they were parsed first
  std::vector<Region> regions_;
  std::vector<Body> bodies_;  // sorted
};

}  // namespace rung::workspace
