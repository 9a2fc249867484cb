// SPDX-License-Identifier: Apache-2.0
// Comments beside the tree: their kinds and ranges, and which of them belong to a node.
#include "frontend/syntax/trivia.h"

#include <gtest/gtest.h>

#include <string>

#include "frontend/parse/parse.h"

namespace rung {
namespace {

constexpr const char* kProgram = R"(// Head of the file.
/// What it does.
PROGRAM main  (* inline *)
VAR
  a : INT;  // unit: mm
  (* first *) /* second */
  b : INT;
END_VAR
a := 1; (* one *) // rest
// before the second

b := 2;  // its own
END_PROGRAM
// the end)";

class TriviaTest : public ::testing::Test {
 protected:
  TriviaTest() {
    file_ = sources_.add("p.st", kProgram);
    unit_ = text::parseFile(tree_, names_, sources_, file_, Dialect::Codesys, diagnostics_, &trivia_);
    pou_ = tree_.as<PouDecl>(tree_.list(unit_.decls)[0]);
  }
  std::string show(std::span<const Comment> comments) const {
    std::string out;
    for (const Comment& comment : comments) {
      const uint32_t base = sources_.begin(file_).offset;
      out += "[" +
             std::string(sources_.sourceText(file_).substr(comment.range.begin.offset - base,
                                                           comment.range.end.offset - comment.range.begin.offset)) +
             "]";
    }
    return out;
  }
  DeclId variable(uint32_t k) const { return tree_.list(tree_.as<SectionDecl>(tree_.list(pou_.sections)[0]).vars)[k]; }
  template <class Id>
  std::string before(Id id) const {
    return show(trivia_.before(sources_, tree_.range(id).begin));
  }
  template <class Id>
  std::string after(Id id) const {
    return show(trivia_.after(sources_, tree_.range(id).end));
  }

  Sources sources_;
  Names names_;
  Diagnostics diagnostics_{sources_};
  Tree tree_;
  Trivia trivia_;
  FileId file_;
  FileUnit unit_;
  PouDecl pou_{};
};

TEST_F(TriviaTest, KindsInSourceOrder) {
  std::string kinds;
  for (const Comment& comment : trivia_.all())
    kinds += comment.kind == CommentKind::Line ? 'l' : comment.kind == CommentKind::Block ? 'b' : 'd';
  EXPECT_EQ(kinds, "ldblbbbllll");
}

TEST_F(TriviaTest, BeforeAndAfterDeclarations) {
  EXPECT_EQ(before(tree_.list(unit_.decls)[0]), "[// Head of the file.][/// What it does.]");
  EXPECT_EQ(before(variable(0)), "");
  EXPECT_EQ(after(variable(0)), "[// unit: mm]");
  EXPECT_EQ(before(variable(1)), "[(* first *)][/* second */]");
  EXPECT_EQ(after(variable(1)), "");
  EXPECT_EQ(after(tree_.list(unit_.decls)[0]), "");
}

TEST_F(TriviaTest, BeforeAndAfterStatements) {
  const auto body = tree_.list(pou_.body);
  EXPECT_EQ(before(body[0]), "");
  EXPECT_EQ(after(body[0]), "[(* one *)][// rest]");
  EXPECT_EQ(before(body[1]), "[// before the second]");
  EXPECT_EQ(after(body[1]), "[// its own]");
}

TEST_F(TriviaTest, WithinARange) {
  EXPECT_EQ(show(trivia_.within(tree_.range(tree_.list(pou_.sections)[0]))),
            "[// unit: mm][(* first *)][/* second */]");
}

TEST_F(TriviaTest, NothingIsKeptUnasked) {
  Tree tree;
  text::parseFile(tree, names_, sources_, file_, Dialect::Codesys, diagnostics_);
  EXPECT_EQ(trivia_.all().size(), 11u);
}

}  // namespace
}  // namespace rung
