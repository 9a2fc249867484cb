// SPDX-License-Identifier: Apache-2.0
// Reading and writing CSV (RFC 4180).
#include "stdlib/runtime/host/csv.h"

#include <gtest/gtest.h>

using namespace rung::host;

TEST(Csv, ReadsQuotesLineEndsAndEmptyCells) {
  std::vector<CsvRow> rows;
  std::string error;
  ASSERT_TRUE(
      readCsv("\xEF\xBB\xBF"
              "cycle,\"a[1,2]\"\r\n\r\n0,\"say \"\"hi\"\"\nx\"\n3,",
              rows, error));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].cells, (std::vector<std::string>{"cycle", "a[1,2]"}));
  EXPECT_EQ(rows[1].cells, (std::vector<std::string>{"0", "say \"hi\"\nx"}));
  EXPECT_EQ(rows[1].positions[0].line, 3u);
  EXPECT_EQ(rows[1].positions[1].column, 3u);
  EXPECT_EQ(rows[2].cells, (std::vector<std::string>{"3", ""}));
  EXPECT_EQ(rows[2].positions[0].line, 5u);
  EXPECT_EQ(rows[2].positions[1].column, 3u);
}

TEST(Csv, NamesTheLocationOfAMistake) {
  std::vector<CsvRow> rows;
  std::string error;
  EXPECT_FALSE(readCsv("a\nb,\"c\nd\n", rows, error));
  EXPECT_EQ(error, "2:3: the quote of a cell is not closed");
  EXPECT_FALSE(readCsv("\"a\"b\n", rows, error));
  EXPECT_EQ(error, "1:4: text after the closing quote of a cell");
}

TEST(Csv, QuotesWhereNeeded) {
  std::string text;
  appendCell(text, "plain");
  appendCell(text, "a,b");
  appendCell(text, "\"w\"");
  EXPECT_EQ(text, "plain\"a,b\"\"\"\"w\"\"\"");
}
