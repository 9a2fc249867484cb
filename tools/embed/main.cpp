// SPDX-License-Identifier: Apache-2.0
// Embeds files in a C++ source: error pages for `rung explain`, the libraries of the language.
//   rung_embed_tool NAME PREFIX LIST OUT.cpp OUT.h
// In: LIST, one path per line. Out: a table of {name, text} sorted by name, names relative to PREFIX.
// Called at build time by rung_embed() of cmake/RungEmbed.cmake.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Embedded {
  std::string name, text;
};

bool read(const std::string& path, std::string& text) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return false;
  std::ostringstream all;
  all << in.rdbuf();
  text = all.str();
  return true;
}

bool write(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  return !out.fail();
}

// One piece of a literal for each line, so that the generated source can be read and compared.
std::string literalOf(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n') {
      out += "\\n\"\n    \"";
    } else if (c == '"' || c == '\\' || c == '?') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\%03o", static_cast<unsigned>(byte));
      out += escape;
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: rung_embed_tool NAME PREFIX LIST OUT.cpp OUT.h\n");
    return 2;
  }
  const std::string name = argv[1], prefix = std::string(argv[2]) + "/";
  std::ifstream list(argv[3]);
  std::vector<Embedded> files;
  for (std::string path; std::getline(list, path);) {
    if (path.empty()) continue;
    Embedded file;
    if (!read(path, file.text)) {
      std::fprintf(stderr, "rung_embed_tool: cannot read %s\n", path.c_str());
      return 2;
    }
    file.name = path.compare(0, prefix.size(), prefix) == 0 ? path.substr(prefix.size()) : path;
    files.push_back(std::move(file));
  }
  std::sort(files.begin(), files.end(), [](const Embedded& a, const Embedded& b) { return a.name < b.name; });

  std::string source = "// Made by tools/embed.\n#include \"" + name + ".h\"\n\nnamespace rung::embedded {\n";
  source += "const File " + name + "[] = {\n";
  for (const Embedded& file : files) {
    source += "  {" + literalOf(file.name) + ",\n   {" + literalOf(file.text) + ", " +
              std::to_string(file.text.size()) + "}},\n";
  }
  source += "  {}};\nconst size_t " + name + "_count = " + std::to_string(files.size()) +
            ";\n}  // namespace rung::embedded\n";
  const std::string header =
      "// Made by tools/embed.\n#pragma once\n\n#include <cstddef>\n#include <string_view>\n\n"
      "namespace rung::embedded {\n#ifndef RUNG_EMBEDDED_FILE\n#define RUNG_EMBEDDED_FILE\n"
      "struct File {\n  std::string_view name, text;\n};\n#endif\n"
      "extern const File " +
      name + "[];  // sorted by name\nextern const size_t " + name + "_count;\n}  // namespace rung::embedded\n";
  if (!write(argv[4], source) || !write(argv[5], header)) {
    std::fprintf(stderr, "rung_embed_tool: cannot write %s\n", argv[4]);
    return 2;
  }
  return 0;
}
