// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/tokens.h"

#include <algorithm>
#include <optional>

#include "frontend/source/scanner.h"
#include "frontend/syntax/children.h"
#include "tools/ide/keywords.h"
#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

TokenKind kindOf(const sema::Pou& pou) {
  switch (pou.kind) {
    case PouKind::Function: return TokenKind::Function;
    case PouKind::Method:
    case PouKind::Action: return TokenKind::Method;
    case PouKind::Interface: return TokenKind::Interface;
    case PouKind::FunctionBlock:
    case PouKind::Program:
    case PouKind::Class: return TokenKind::Block;
  }
  return TokenKind::Block;
}

TokenKind kindOf(const types::TypeInfo& info) {
  if (info.kind == types::TypeKind::Enum) return TokenKind::Enumeration;
  if (info.kind == types::TypeKind::Record) return TokenKind::Structure;
  return TokenKind::Type;
}

Token tokenOf(const sema::Project& project, VarId id) {
  const sema::Var& var = project.var(id);
  Token token{{}, TokenKind::Variable};
  const bool is_pin =
      var.section == SectionKind::Input || var.section == SectionKind::Output || var.section == SectionKind::InOut;
  if (is_pin && project.pou(var.pou).result_var != id) token.kind = TokenKind::Parameter;
  if (var.record && !var.pou) token.kind = TokenKind::Field;
  if (var.constant) token.traits |= kReadOnly;
  if (var.storage == sema::Storage::Global) token.traits |= kGlobal;
  return token;
}

Token tokenOf(const sema::Project& project, Entity entity) {
  switch (entity.entityKind()) {
    case EntityKind::Var: return tokenOf(project, VarId{entity.index});
    case EntityKind::Pou: {
      const sema::Pou& pou = project.pous[entity.index];
      return {{}, kindOf(pou), static_cast<uint8_t>(pou.library ? kOfLibrary : 0)};
    }
    case EntityKind::Type: return {{}, kindOf(project.types.info({entity.index}))};
    case EntityKind::EnumValue: return {{}, TokenKind::Item, kReadOnly};
    case EntityKind::Property: return {{}, TokenKind::Property};
    case EntityKind::GlobalList:
    case EntityKind::Namespace: return {{}, TokenKind::Namespace};
    case EntityKind::Program: return {{}, TokenKind::Variable, kGlobal};
    case EntityKind::None:
    case EntityKind::Error: break;
  }
  return {{}, TokenKind::Variable};
}

class Tokenizer {
 public:
  Tokenizer(const View& view, FileId file) : view_(view), file_(file) {}

  std::vector<Token> tokens() {
    for (const FileUnit* unit : view_.unitsOf(file_)) add(*unit);
    std::stable_sort(tokens_.begin(), tokens_.end(),
                     [](const Token& a, const Token& b) { return a.range.begin < b.range.begin; });
    uint32_t end = 0;
    std::erase_if(tokens_, [&](const Token& token) {
      if (token.range.begin < end) return true;
      end = token.range.end;
      return false;
    });
    return std::move(tokens_);
  }

 private:
  void add(const FileUnit& unit) {
    const std::string_view source = view_.sources().sourceText(unit.file);
    const uint32_t base = view_.sources().begin(unit.file).offset;
    operators_.clear();
    for (const DeclId decl : view_.tree().list(unit.decls)) findOperators(decl);
    std::sort(operators_.begin(), operators_.end());
    const std::vector<NamePlace>* names = view_.snapshot().project() == nullptr ? nullptr : &view_.meanings().of(unit);
    Scanner scanner(source);
    for (Unit piece = scanner.next(); piece.kind != UnitKind::End; piece = scanner.next()) {
      const Loc loc{base + static_cast<uint32_t>(piece.begin)};
      if (scanner.textOf(piece) == ".") after_dot_ = loc.offset + 1;
      if (const std::optional<Token> token = tokenOfPiece(piece, loc, scanner.textOf(piece), names))
        add(loc, scanner.textOf(piece), *token);
    }
  }

  // The operators of IL are names for the scanner.
  void findOperators(DeclId id) {
    const Tree& tree = view_.tree();
    if (tree.kind(id) == DeclKind::Pou)
      for (const IlInstruction& instruction : tree.list(tree.as<PouDecl>(id).il)) operators_.push_back(instruction.loc);
    forEachChild(tree, id, [&](const auto& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, DeclId>) findOperators(child);
    });
  }

  std::optional<Token> tokenOfPiece(const Unit& piece, Loc loc, std::string_view text,
                                    const std::vector<NamePlace>* names) const {
    switch (piece.kind) {
      case UnitKind::Comment:
        return Token{{}, TokenKind::Comment, static_cast<uint8_t>(text.starts_with("///") ? kDocumentation : 0)};
      case UnitKind::Pragma: return Token{{}, TokenKind::Pragma};
      case UnitKind::String: return Token{{}, TokenKind::String};
      case UnitKind::Number: return Token{{}, TokenKind::Number};
      case UnitKind::Name: return tokenOfName(loc, text, names);
      case UnitKind::Other: break;
      case UnitKind::End: break;
    }
    const bool is_operator = std::string_view("+-*/=<>&:^").find(text.front()) != std::string_view::npos;
    return is_operator ? std::optional<Token>({{}, TokenKind::Operator}) : std::nullopt;
  }

  std::optional<Token> tokenOfName(Loc loc, std::string_view text, const std::vector<NamePlace>* names) const {
    if (names != nullptr) {
      const auto place = std::partition_point(names->begin(), names->end(),
                                              [&](const NamePlace& candidate) { return candidate.loc < loc; });
      if (place != names->end() && place->loc == loc) {
        Token token = tokenOf(*view_.snapshot().project(), place->entity);
        if (place->is_declaration) token.traits |= kDeclaration;
        return token;
      }
    }
    if (std::binary_search(operators_.begin(), operators_.end(), loc)) return Token{{}, TokenKind::Keyword};
    const WordKind word = kindOfWord(text);
    if (word == WordKind::Type) return Token{{}, TokenKind::Type, kOfLibrary};
    if (word != WordKind::None) return Token{{}, TokenKind::Keyword};
    if (text.data()[text.size()] == '#') return Token{{}, TokenKind::Number};  // T#1s; each source ends in a NUL
    return names == nullptr || loc.offset == after_dot_ ? std::nullopt : tokenOfUnresolved(loc, text);
  }

  // In a statement that is not finished.
  std::optional<Token> tokenOfUnresolved(Loc loc, std::string_view text) const {
    const Meanings& meanings = view_.meanings();
    const Entity entity = meanings.scope().lookUp(meanings.pouAt(loc), view_.names().key(view_.names().find(text)));
    return entity ? std::optional<Token>(tokenOf(*view_.snapshot().project(), entity)) : std::nullopt;
  }

  // One token for each line of the text, if the file has it as it was parsed.
  void add(Loc loc, std::string_view text, Token token) {
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
      if (end > begin) {
        const FileRange at =
            view_.bytesInFile({loc.offset + static_cast<uint32_t>(begin)}, static_cast<uint32_t>(end - begin));
        if (at.file == file_ &&
            view_.textOf(file_).substr(at.begin, at.end - at.begin) == text.substr(begin, end - begin)) {
          token.range = at;
          tokens_.push_back(token);
        }
      }
      begin = end + 1;
    }
  }

  const View& view_;
  FileId file_;
  std::vector<Loc> operators_;  // of IL, sorted
  uint32_t after_dot_ = 0;      // the location after the last dot
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokensOf(const View& view, FileId file) { return Tokenizer(view, file).tokens(); }

}  // namespace rung::ide
