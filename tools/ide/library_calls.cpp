// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/library_calls.h"

#include <algorithm>

#include "frontend/parse/parse.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"
#include "tools/ide/signature.h"

namespace rung::ide {
namespace {

struct TypeLiteral {
  std::string_view type, literal;
};
constexpr TypeLiteral kLiterals[] = {
    {"BOOL", "FALSE"},
    {"SINT", "1"},
    {"INT", "1"},
    {"DINT", "1"},
    {"LINT", "1"},
    {"USINT", "1"},
    {"UINT", "1"},
    {"UDINT", "1"},
    {"ULINT", "1"},
    {"BYTE", "1"},
    {"WORD", "1"},
    {"DWORD", "1"},
    {"LWORD", "1"},
    {"REAL", "1.0"},
    {"LREAL", "1.0"},
    {"TIME", "T#0s"},
    {"LTIME", "LTIME#0s"},
    {"DATE", "D#2000-01-01"},
    {"LDATE", "LDATE#2000-01-01"},
    {"TIME_OF_DAY", "TOD#00:00:00"},
    {"TOD", "TOD#00:00:00"},
    {"LTIME_OF_DAY", "LTOD#00:00:00"},
    {"LTOD", "LTOD#00:00:00"},
    {"DATE_AND_TIME", "DT#2000-01-01-00:00:00"},
    {"DT", "DT#2000-01-01-00:00:00"},
    {"LDATE_AND_TIME", "LDT#2000-01-01-00:00:00"},
    {"LDT", "LDT#2000-01-01-00:00:00"},
    {"STRING", "''"},
    {"WSTRING", "\"\""},
    {"ANY", "1"},
    {"ANY_ELEMENTARY", "1"},
    {"ANY_MAGNITUDE", "1"},
    {"ANY_NUM", "1"},
    {"ANY_REAL", "1.0"},
    {"ANY_INT", "1"},
    {"ANY_UNSIGNED", "1"},
    {"ANY_SIGNED", "1"},
    {"ANY_BIT", "1"},
    {"ANY_STRING", "''"},
    {"ANY_DURATION", "T#0s"},
    {"ANY_DATE", "DT#2000-01-01-00:00:00"},
};

bool isGeneric(std::string_view type) { return sameIdentifier(type.substr(0, 3), "ANY"); }

// Of the result. 1 may be a BOOL, 2 is a number in any case.
std::string typedLiteral(std::string_view type) {
  std::string literal = literalOfType(type);
  if (isGeneric(type) && literal == "1") literal = "2";
  const bool has_type =
      literal.empty() || isGeneric(type) || literal == "FALSE" || literal.find('#') != std::string::npos;
  return has_type ? literal : std::string(type) + "#" + literal;
}

// By position where there are few, as completion does it for functions of the project.
std::string callOf(const PouSignature& signature) {
  constexpr size_t kMostWithoutNames = 3;
  const auto count =
      static_cast<size_t>(std::count_if(signature.pins.begin(), signature.pins.end(),
                                        [](const SignaturePin& pin) { return pin.section != SectionKind::Output; }));
  std::string out = signature.name + "(";
  size_t place = 0;
  for (const SignaturePin& pin : signature.pins) {
    if (pin.section == SectionKind::Output) continue;
    const std::string literal = pin.section == SectionKind::Input ? literalOfType(pin.type) : std::string();
    if (literal.empty()) return {};
    if (place++ > 0) out += ", ";
    if (count > kMostWithoutNames) out += pin.name + " := ";
    out += "${" + std::to_string(place) + ":" + literal + "}";
  }
  return out + ")";
}

bool declaresType(std::string_view source, std::string_view name) {
  Sources sources;
  Names names;
  Tree tree;
  Diagnostics unused(sources);
  const FileId file = sources.add("library", std::string(source));
  const uint32_t base = sources.begin(file).offset;
  const auto end = static_cast<uint32_t>(base + source.size());
  const Slice<DeclId> decls = text::parseDeclarations(tree, names, sources, {base}, {end}, Dialect::Library, unused);
  const std::span<const DeclId> list = tree.list(decls);
  return std::any_of(list.begin(), list.end(), [&](DeclId decl) {
    return tree.kind(decl) == DeclKind::Type && sameIdentifier(names.string(tree.as<TypeDecl>(decl).name), name);
  });
}

}  // namespace

std::string literalOfType(std::string_view type) {
  const auto row = std::find_if(std::begin(kLiterals), std::end(kLiterals),
                                [&](const TypeLiteral& of) { return sameIdentifier(of.type, type); });
  return row == std::end(kLiterals) ? std::string() : std::string(row->literal);
}

LibraryUse useOf(const LibraryName& name) {
  LibraryUse use;
  const std::string_view source = name.source.substr(name.begin, name.end - name.begin);
  const std::string word = firstWord(source);
  use.is_extensible = hasPragma(source, {"extensible"});
  use.is_for_tests = hasPragma(source, {"test_only"});
  if (word == "TYPE") {
    if (declaresType(source, name.name)) use.kind = LibraryKind::Type;
  } else if (word == "FUNCTION") {
    use.kind = LibraryKind::Function;
    LibraryName alone = name;  // its declaration is enough
    alone.source = source;
    alone.begin = 0;
    alone.end = static_cast<uint32_t>(source.size());
    const std::optional<PouSignature> signature = signatureOf(alone);
    if (!signature) return use;
    use.call = callOf(*signature);
    for (const SignaturePin& pin : signature->pins) use.pins.push_back(pin.name);
    use.has_result = !signature->result.empty();
    use.result = typedLiteral(signature->result);
  } else if (word == "FUNCTION_BLOCK" || word == "CLASS") {
    use.kind = LibraryKind::Block;
  } else if (word == "INTERFACE") {
    use.kind = LibraryKind::Interface;
  }
  return use;
}

}  // namespace rung::ide
