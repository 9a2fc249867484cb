// SPDX-License-Identifier: Apache-2.0
// Inputs: folders and their order, missing and unreadable files, project files, pairs of files, kinds of files.
#include "tools/driver/inputs.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/diagnostics.h"
#include "tools/driver/diagnostics.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/unit/tools/temporary_folder.h"
#include "tools/driver/libraries.h"

namespace rung::driver {
namespace {

constexpr const char* kProgram = "PROGRAM p\nEND_PROGRAM\n";

class InputsTest : public testing::Test {
 protected:
  void read(std::vector<std::string> words) {
    options.inputs = std::move(words);
    readInputs(options, sources, diagnostics, inputs);
  }
  std::string onlyMessage() const {
    return diagnostics.all().size() == 1 ? diagnostics.all()[0].message : std::to_string(diagnostics.all().size());
  }
  std::vector<std::string> paths() const {
    std::vector<std::string> out;
    for (const InputFile& file : inputs.files) out.push_back(file.below);
    return out;
  }

  TemporaryFolder folder;
  ProjectOptions options;
  Sources sources;
  Diagnostics diagnostics{sources};
  Inputs inputs;
};

TEST_F(InputsTest, FolderInSortedOrderWithoutOtherKinds) {
  folder.write("p/b.st", kProgram);
  folder.write("p/a/z.iecst", kProgram);
  folder.write("p/a.ST", kProgram);
  folder.write("p/notes.txt", "Program notes");
  folder.write("p/.hidden/x.st", kProgram);
  read({folder.path() + "/p"});
  EXPECT_EQ(paths(), (std::vector<std::string>{"a.ST", "a/z.iecst", "b.st"}));
  EXPECT_EQ(inputs.files[0].shown, folder.path() + "/p/a.ST");
  EXPECT_FALSE(inputs.io_error);
}

TEST_F(InputsTest, OrderOfWordsDoesNotShowAndRepeatsCountOnce) {
  std::string a = folder.write("p/a.st", kProgram), b = folder.write("p/q/b.st", kProgram);
  read({b, a, folder.path() + "/p", a});
  EXPECT_EQ(paths(), (std::vector<std::string>{"a.st", "q/b.st"}));
}

TEST_F(InputsTest, UnknownFile) {
  folder.write("pump.st", kProgram);
  read({folder.path() + "/pmup.st"});
  EXPECT_TRUE(inputs.io_error);
  EXPECT_EQ(onlyMessage(), "cannot read `" + folder.path() + "/pmup.st`: No such file or directory");
  ASSERT_EQ(diagnostics.all()[0].notes.size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].notes[0].message, "did you mean `" + folder.path() + "/pump.st`?");
}

TEST_F(InputsTest, EmptyFolder) {
  folder.write("p/readme.md", "nothing");
  read({folder.path() + "/p"});
  EXPECT_TRUE(inputs.io_error);
  EXPECT_EQ(diagnostics.all()[0].diag, diag::EmptyFolder);
}

TEST_F(InputsTest, UnreadableFile) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  std::string path = folder.write("a.st", kProgram);
  chmod(path.c_str(), 0);
  read({path});
  EXPECT_TRUE(inputs.io_error);
  EXPECT_EQ(diagnostics.all()[0].diag, diag::CannotRead);
}

TEST_F(InputsTest, BinaryAndUtf16) {
  std::string noise;
  uint32_t x = 1;
  for (int i = 0; i < 500; i++) noise += static_cast<char>((x = x * 1664525 + 1013904223) >> 24 | 1);
  read({folder.write("noise.st", noise)});
  EXPECT_EQ(diagnostics.all()[0].diag, diag::BinaryFile);
  EXPECT_TRUE(inputs.io_error);

  Diagnostics more(sources);
  Inputs second;
  options.inputs = {folder.write("wide.st", std::string("\xff\xfeP\0R", 5))};
  readInputs(options, sources, more, second);
  EXPECT_EQ(more.all()[0].diag, diag::Utf16File);
}

TEST_F(InputsTest, FileThatFitsNoMemory) {
  std::string path = folder.write("huge.st", kProgram);
  ASSERT_EQ(truncate(path.c_str(), off_t{5} << 30), 0);  // a sparse file: no disk space
  read({path});
  EXPECT_TRUE(inputs.io_error);
  EXPECT_STREQ(diagInfo(diagnostics.all()[0].diag).code, "E0107");
}

TEST_F(InputsTest, DeviceIsNoFile) {
  read({"/dev/null"});
  EXPECT_TRUE(inputs.io_error);
}

TEST_F(InputsTest, ProjectFileNamesItsSources) {
  folder.write("p/rung.project", "[project]\nsources = main.st, lib\nstd = iec3\n");
  folder.write("p/main.st", kProgram);
  folder.write("p/other.st", kProgram);
  folder.write("p/lib/x.st", kProgram);
  read({folder.path() + "/p"});
  EXPECT_EQ(paths(), (std::vector<std::string>{"lib/x.st", "main.st"}));
  applyProjectFile(inputs.project, options);
  EXPECT_EQ(options.dialect, Dialect::Iec3);
}

TEST_F(InputsTest, ProjectOfTwinCatTakesWhatItLists) {
  const std::string object =
      "<TcPlcObject><DUT Name='a'><Declaration>TYPE a : INT; END_TYPE</Declaration></DUT></TcPlcObject>";
  folder.write(
      "p/plc/x.plcproj",
      "<Project xmlns=\"http://schemas.microsoft.com/developer/msbuild/2003\"><Compile Include=\"DUTS\\A.tcdut\"/>"
      "</Project>");
  folder.write("p/plc/DUTs/a.TcDUT", object);
  folder.write("p/plc/other.TcDUT", object);
  folder.write("p/plain.st", kProgram);
  read({folder.path() + "/p"});
  EXPECT_EQ(paths(), (std::vector<std::string>{"plain.st", "plc/DUTs/a.TcDUT"}));
  EXPECT_FALSE(inputs.io_error);
}

// -I X.plcproj: the files of the project without its programs and tasks; its name qualifies their declarations.
TEST_F(InputsTest, ProjectOfTwinCatAsLibrary) {
  const std::string head = "<Project xmlns=\"http://schemas.microsoft.com/developer/msbuild/2003\">";
  const std::string library = folder.write("lib/Parts.plcproj", head +
                                                                    "<Compile Include=\"FB_Part.TcPOU\"/><Compile "
                                                                    "Include=\"Try.TcPOU\"/><Compile "
                                                                    "Include=\"Task.TcTTO\"/></Project>");
  folder.write("lib/FB_Part.TcPOU",
               "<TcPlcObject><POU Name='FB_Part'><Declaration><![CDATA[FUNCTION_BLOCK FB_Part\n]]></Declaration>"
               "<Implementation><ST></ST></Implementation></POU></TcPlcObject>");
  folder.write("lib/Try.TcPOU",
               "<TcPlcObject><POU Name='Try'><Declaration><![CDATA[PROGRAM Try\n]]></Declaration>"
               "<Implementation><ST></ST></Implementation></POU></TcPlcObject>");
  folder.write("lib/Task.TcTTO", "<TcPlcObject><Task Name='T'/></TcPlcObject>");
  folder.write("p/main.st", kProgram);
  options.library_paths = {library};
  read({folder.path() + "/p"});
  EXPECT_EQ(paths(), (std::vector<std::string>{"../lib/FB_Part.TcPOU", "main.st", "../lib/Try.TcPOU"}));
  EXPECT_TRUE(inputs.project_names.empty());
  ASSERT_EQ(inputs.library_names.size(), 1u);
  EXPECT_EQ(inputs.library_names[0], (std::vector<std::string>{"Parts"}));
}

TEST(LibraryPath, MayBeCalledAnotherName) {
  EXPECT_EQ(libraryPath("lib/oscat").called, "");
  EXPECT_EQ(libraryPath("lib/oscat").path, "lib/oscat");
  EXPECT_EQ(libraryPath("OSCAT_BASIC=lib/oscat").called, "OSCAT_BASIC");
  EXPECT_EQ(libraryPath("OSCAT_BASIC=lib/oscat").path, "lib/oscat");
  EXPECT_EQ(libraryPath("lib/a=b").path, "lib/a=b");
}

TEST_F(InputsTest, ListedFileThatIsGone) {
  read({folder.write("x.plcproj",
                     "<Project xmlns=\"http://schemas.microsoft.com/developer/msbuild/2003\">\n<Compile "
                     "Include=\"gone.TcPOU\"/></Project>")});
  EXPECT_EQ(onlyMessage(), "cannot read `gone.TcPOU`: No such file or directory");
  EXPECT_EQ(sources.location(diagnostics.all()[0].loc).line, 2u);
  EXPECT_EQ(sources.location(diagnostics.all()[0].loc).column, 19u);
  EXPECT_FALSE(inputs.io_error);  // one error among others
  EXPECT_EQ(inputs.missing_files, 1u);
}

TEST_F(InputsTest, PairsOfFilesAreOnePou) {
  folder.write("p/a.pou", "PROGRAM a\nVAR x : INT; END_VAR\n");
  folder.write("p/A.st", "x := 1;");
  folder.write("p/b.st", kProgram);
  folder.write("p/c_body.st", "y := 1;");  // without any declaration
  folder.write("p/two.decl", "PROGRAM two\n");
  folder.write("p/two.pou", "PROGRAM two\n");
  folder.write("p/two.impl", ";");  // it is not clear of which POU
  read({folder.path() + "/p"});
  readPrograms(sources, diagnostics, inputs, false);
  EXPECT_EQ(paths(), (std::vector<std::string>{"a.pou", "b.st", "c_body.st", "two.decl", "two.impl", "two.pou"}));
  EXPECT_EQ(sources.sourceText(inputs.files[0].file), "PROGRAM a\nVAR x : INT; END_VAR\n\nx := 1;\nEND_PROGRAM");
}

TEST(KindOf, ContentThenExtension) {
  EXPECT_EQ(importer::kindOf("a.st", kProgram), FileKind::St);
  EXPECT_EQ(importer::kindOf("a.txt", "(* head *) // x\n{attribute 'a'}\nfunction_block b"), FileKind::St);
  EXPECT_EQ(importer::kindOf("a.txt", "just text"), FileKind::Unknown);
  EXPECT_EQ(importer::kindOf("a.exp", "\xef\xbb\xbf<?xml version='1.0'?>"), FileKind::Xml);
  EXPECT_EQ(importer::kindOf("a.st", ""), FileKind::St);
  EXPECT_EQ(importer::kindOf("a.st", std::string("\0\0", 2)), FileKind::Binary);
  EXPECT_EQ(importer::kindOf("a.st", "(* \xe4\xf6\xfc in Latin-1, as editors of the nineties wrote it *)"),
            FileKind::St);
  EXPECT_EQ(importer::kindOf("a.txt", "(* never closed"), FileKind::Unknown);
}

}  // namespace
}  // namespace rung::driver
