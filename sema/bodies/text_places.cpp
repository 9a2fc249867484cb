// Places for texts whose address is taken: ADR('text') of codesys needs memory behind the literal. Equal texts of one
// POU share a place; what happens when it is written through the pointer, CODESYS leaves open.
// In: literals of one POU. Out: constants in a global list of its own, which no name in a program can reach. The list
// is declared when the body is checked, so that a POU's places depend on its own text alone.
#include <algorithm>

#include "sema/bodies/bodies.h"
#include "sema/declarations/configuration.h"
#include "sema/declarations/declarations.h"

namespace rung::sema {

ExprId placeOfText(Context& context, ExprId literal) {
  Symbols& symbols = context.symbols;
  const LiteralExpr& node = context.tree().as<LiteralExpr>(literal);
  const Loc loc = node.h.loc;
  const bool wide = node.literal() == LiteralKind::WString;
  const NameId text = context.names().intern(context.tree().text(node.text()));
  Scopes::Texts& texts = context.scopes.texts;
  VarId& place = texts.places[{context.pou.index, uint64_t{text.index} << 1 | uint64_t{wide}}];
  if (!place) {
    place = VarId{static_cast<uint32_t>(symbols.vars.size())};
    Var var;
    var.name = context.names().intern("text" + std::to_string(texts.places.size()));
    var.loc = loc;
    // Room for what a pointer to a STRING of the usual length reads and writes.
    const uint32_t length = std::max(context.types().info(context.types().resolve(node.h.type)).length, 80u);
    var.type = wide ? context.types().wstring(length) : context.types().string(length);
    var.section = SectionKind::Global;
    var.storage = Storage::Global;
    var.constant = var.read = var.written = true;
    var.init = literal;
    symbols.vars.push_back(var);
    texts.undeclared.push_back({context.pou, place});
  }
  NameExpr name{};
  name.h.kind = ExprKind::Name;
  name.h.loc = loc;
  name.h.type = symbols.var(place).type;
  name.name = symbols.var(place).name;
  name.entity = entity(place);
  return context.tree().add<ExprId>(name);
}

void declareTexts(Context& context, PouId pou) {
  Symbols& symbols = context.symbols;
  std::vector<Scopes::Texts::Place>& undeclared = context.scopes.texts.undeclared;
  ListId list;
  size_t kept = 0;
  for (const Scopes::Texts::Place place : undeclared) {
    if (place.pou != pou) {
      undeclared[kept++] = place;
      continue;
    }
    if (!list) {
      const std::string owner = pou ? spelled(context, symbols.pou(pou).unique_name) : std::string();
      const Loc loc = symbols.var(place.var).loc;
      list = listNamed(context, owner + "__texts", symbols.sources.fileOf(loc), loc, context.scopes.qualifiers);
    }
    symbols.var(place.var).list = list;
    symbols.global_lists[list.index].vars.push_back(place.var);
  }
  undeclared.resize(kept);
  if (list) settleDeclarations(context);
}

void declareTexts(Context& context) {
  while (!context.scopes.texts.undeclared.empty()) declareTexts(context, context.scopes.texts.undeclared.front().pou);
}

}  // namespace rung::sema
