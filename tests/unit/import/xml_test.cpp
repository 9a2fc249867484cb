// SPDX-License-Identifier: Apache-2.0
// The XML reader: elements, attributes, decoded text and its locations, and broken input of every kind.
#include "frontend/import/xml.h"

#include <gtest/gtest.h>

namespace rung::xml {
namespace {

class XmlTest : public testing::Test {
 protected:
  bool parse(std::string text) {
    document = {};
    file = sources.add("a.xml", std::move(text));
    return read(sources, file, diagnostics, document);
  }
  // "line:column message" of the only error.
  std::string error(std::string text) {
    const size_t before = diagnostics.all().size();
    if (parse(std::move(text))) return "none";
    if (diagnostics.all().size() != before + 1) return std::to_string(diagnostics.all().size() - before) + " errors";
    return at(diagnostics.all().back().loc) + " " + diagnostics.all().back().message;
  }
  std::string at(Loc loc) const {
    const SourceLocation location = sources.location(loc);
    return std::to_string(location.line) + ":" + std::to_string(location.column);
  }
  const Element& root() const { return document.elements[0]; }

  Sources sources;
  Diagnostics diagnostics{sources};
  FileId file;
  Document document;
};

TEST_F(XmlTest, ElementsInOrderOfTheFile) {
  ASSERT_TRUE(
      parse("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- <x> -->\n<a><b/><c><d/></c>\n<b2></b2></a>\n<!-- end -->\n"));
  ASSERT_EQ(document.elements.size(), 5u);
  const Element* b = document.firstChild(root());
  const Element* c = document.next(*b);
  const Element* b2 = document.next(*c);
  EXPECT_EQ(b->name, "b");
  EXPECT_EQ(c->name, "c");
  EXPECT_EQ(document.firstChild(*c)->name, "d");
  EXPECT_EQ(b2->name, "b2");
  EXPECT_EQ(at(b2->loc), "4:2");
  EXPECT_EQ(document.next(*b2), nullptr);
  EXPECT_EQ(document.child(root(), "c"), c);
  EXPECT_EQ(document.child(root(), "d"), nullptr);
  EXPECT_EQ(document.next(root()), nullptr);
}

TEST_F(XmlTest, NamesLoseTheirPrefix) {
  ASSERT_TRUE(parse("<t:a xmlns:t='u' xsi:type='LD'><t:b></t:b></t:a>"));
  EXPECT_EQ(root().name, "a");
  EXPECT_EQ(document.value(root(), "type"), "LD");
  EXPECT_NE(document.child(root(), "b"), nullptr);
}

TEST_F(XmlTest, AttributesWithBothQuotesAndEntities) {
  ASSERT_TRUE(parse("<a one = 'x \"y\"'\n  two=\"&lt;&#65;&#x42;&amp;&apos;\" empty=''/>"));
  EXPECT_EQ(document.value(root(), "one"), "x \"y\"");
  EXPECT_EQ(document.value(root(), "two"), "<AB&'");
  EXPECT_EQ(document.value(root(), "empty"), "");
  EXPECT_EQ(at(document.attribute(root(), "two")->loc), "2:8");
  EXPECT_EQ(document.attribute(root(), "three"), nullptr);
}

TEST_F(XmlTest, TextIsDecodedAndKeepsItsLocations) {
  ASSERT_TRUE(parse("<a>x &lt; y\n<![CDATA[<&amp;>\n]] ]]><b> &#228;&#x1F600;</b>end</a>"));
  EXPECT_EQ(document.text(root(), sources), "x < y\n<&amp;>\n]]  ä😀end");
  EXPECT_EQ(document.text(*document.child(root(), "b"), sources), " ä😀");
  ASSERT_EQ(document.runs.size(), 8u);
  EXPECT_EQ(at(document.runs[1].loc), "1:6");  // &lt;
  EXPECT_EQ(document.runs[1].character, U'<');
  EXPECT_EQ(at(document.runs[3].loc), "2:10");  // of the CDATA
  EXPECT_EQ(at(document.runs[5].loc), "3:11");  // &#228;
  EXPECT_EQ(at(document.runs[7].loc), "3:30");  // end
}

// A billion laughs and a file of somebody else: refused before anything is read.
TEST_F(XmlTest, DocumentTypeIsRefused) {
  const std::string refused = " malformed XML: Rung does not read document types; remove this one";
  EXPECT_EQ(error("<?xml version='1.0'?>\n<!DOCTYPE a [ <!ENTITY x 'y'> <!ENTITY z '&x;&x;'> ]><a>&z;</a>"),
            "2:1" + refused);
  EXPECT_EQ(error("<!DOCTYPE a SYSTEM 'file:///etc/passwd'><a/>"), "1:1" + refused);
  EXPECT_EQ(error("<a>&z;</a>"), "1:4 `&z;` is not a character reference known in XML; write `&amp;` for `&`");
}

TEST_F(XmlTest, Encodings) {
  EXPECT_TRUE(parse("<?xml version=\"1.0\" encoding=\"UTF-8\"?><a>\xc3\xa4</a>"));
  EXPECT_TRUE(parse("<?xml version='1.0' encoding='Shift_JIS'?><a>plain</a>"));
  EXPECT_EQ(error("<?xml version='1.0' encoding='Shift_JIS'?><a>\x83\x5c</a>"),
            "1:31 malformed XML: unsupported encoding; save the file as UTF-8");
  EXPECT_EQ(error("\n<?xml version='1.0'?><a/>"),
            "2:1 malformed XML: the XML declaration must be at the very beginning");
}

TEST_F(XmlTest, EachMistakeHasOneErrorAtItsLocation) {
  EXPECT_EQ(error(""), "1:1 malformed XML: the file contains no element");
  EXPECT_EQ(error("text"), "1:1 malformed XML: text before the root element");
  EXPECT_EQ(error("<a/> text"), "1:6 malformed XML: text after the root element");
  EXPECT_EQ(error("<a/><b/>"), "1:5 malformed XML: second root element");
  EXPECT_EQ(error("<a>\n <b>\n</a>"), "3:3 `</a>` cannot close the `<b>` on line 2");
  EXPECT_EQ(error("<a>\n <b>\n"), "2:3 `<b>` is not closed; the file may be truncated");
  EXPECT_EQ(error("</a>"), "1:1 malformed XML: unmatched end tag");
  EXPECT_EQ(error("<a>1 < 2</a>"),
            "1:6 malformed XML: expected a name after `<`; write `&lt;` for the character itself");
  EXPECT_EQ(error("<a b>"), "1:5 malformed XML: expected `=` and a value after the attribute's name");
  EXPECT_EQ(error("<a b=c>"), "1:6 malformed XML: the value of an attribute needs quotes");
  EXPECT_EQ(error("<a b='c>"), "1:6 malformed XML: this quote is not closed");
  EXPECT_EQ(error("<a b='c\n<d e='f'/>"),
            "2:1 malformed XML: `<` is not allowed in a value; write `&lt;`, or close the quote before it");
  EXPECT_EQ(error("<a b='1'c='2'/>"), "1:9 malformed XML: expected a space before this attribute");
  EXPECT_EQ(error("<a =1>"), "1:4 malformed XML: expected an attribute, `>` or `/>`");
  EXPECT_EQ(error("<a"), "1:3 malformed XML: the file ends inside a tag");
  EXPECT_EQ(error("<a></a x>"), "1:8 malformed XML: expected `>` to close the end tag");
  EXPECT_EQ(error("<a><!-- a -- b --></a>"), "1:11 malformed XML: `--` is not allowed in a comment");
  EXPECT_EQ(error("<a x='1' t:x='1' x='2'/>"), "1:18 malformed XML: duplicate attribute in this tag");
  EXPECT_EQ(error("<a>\x01</a>"), "1:4 malformed XML: control characters are not allowed in XML");
  EXPECT_EQ(error("<a>]]></a>"), "1:4 malformed XML: `]]>` does not close a CDATA section; write `]]&gt;`");
  EXPECT_EQ(error("<a><? b?></a>"), "1:4 malformed XML: expected a name after `<?`");
  EXPECT_EQ(error("<a><!-- </a>"), "1:4 malformed XML: expected `-->` to close this comment");
  EXPECT_EQ(error("<a><![CDATA[ ]]</a>"), "1:4 malformed XML: expected `]]>` to close this CDATA section");
  EXPECT_EQ(error("<![CDATA[x]]>"), "1:1 malformed XML: text outside the root element");
  EXPECT_EQ(error("<a>R & D</a>"), "1:6 `&` is not a character reference known in XML; write `&amp;` for `&`");
  EXPECT_EQ(error("<a b='&nbsp;'/>"), "1:7 `&nbsp;` is not a character reference known in XML; write `&amp;` for `&`");
  for (const char* entity : {"&#0;", "&#xD800;", "&#x110000;", "&#;", "&#x;", "&;", "&#99999999999;"})
    EXPECT_EQ(error("<a>" + std::string(entity) + "</a>").substr(0, 4), "1:4 ") << entity;
}

TEST_F(XmlTest, DepthIsLimitedAndCostsNoStack) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_EQ(error(deep), "1:3002 too many nested elements; the limit is 1000");
  std::string ok;
  for (int i = 0; i < 1000; ++i) ok += "<a>";
  for (int i = 0; i < 1000; ++i) ok += "</a>";
  EXPECT_TRUE(parse(ok));
}

TEST_F(XmlTest, EveryTruncationIsAnError) {
  const std::string whole =
      "<?xml version=\"1.0\" encoding='utf-8'?><a one='&lt;' two=\"2\"><!-- c "
      "--><b><![CDATA[x]]>&#65;t</b><c/></a>";
  ASSERT_TRUE(parse(whole));
  for (size_t n = 0; n < whole.size(); ++n) EXPECT_NE(error(whole.substr(0, n)), "none") << n;
}

}  // namespace
}  // namespace rung::xml
