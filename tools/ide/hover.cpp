// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/hover.h"

#include <algorithm>

#include "frontend/source/scanner.h"
#include "frontend/syntax/keywords.h"
#include "tools/ide/code_lens.h"
#include "tools/ide/inlay_hints.h"
#include "tools/ide/navigation.h"
#include "tools/ide/outer_names.h"
#include "tools/ide/signature.h"
#include "tools/ide/source_text.h"
#include "tools/ide/timing_drawings.h"

namespace rung::ide {
namespace {

// A block of characters: what a picture is in a client that shows text alone.
std::string timingOf(std::string_view library, std::string_view block) {
  const std::string_view drawing = library == "Standard" ? timingDrawingOf(block) : std::string_view();
  return drawing.empty() ? std::string() : "\n\n```text\n" + std::string(drawing) + "\n```";
}

class Describer {
 public:
  explicit Describer(const View& view)
      : view_(view), tree_(view.tree()), scope_(view.meanings().scope()), project_(scope_.project()) {}

  Description of(Entity entity) const {
    switch (entity.entityKind()) {
      case EntityKind::Var: return var(project_.vars[entity.index]);
      case EntityKind::Pou: return pou({entity.index});
      case EntityKind::Type: return type({entity.index});
      case EntityKind::EnumValue: return item(project_.enum_values[entity.index]);
      case EntityKind::GlobalList: return list(project_.global_lists[entity.index]);
      case EntityKind::Program: return instance(project_.instances[entity.index]);
      case EntityKind::Property: return property(project_.properties[entity.index]);
      case EntityKind::Namespace:
      case EntityKind::None:
      case EntityKind::Error: break;
    }
    return {};
  }

 private:
  std::string text(NameId name) const { return std::string(view_.names().string(name)); }
  std::string written(Range range) const { return sourceOnOneLine(view_.sources(), range); }

  Description var(const sema::Var& var) const {
    if (var.of_chart) return {"STEP " + text(var.name), {}, ownerOf(var)};
    Description result;
    result.declaration = std::string(keywordOf(var.section)) + modifiersOf(var) + " " + text(var.name);
    std::string type = project_.types.toString(var.type), initial;
    if (var.decl && tree_.kind(var.decl) == DeclKind::Var) {
      const VarDecl& decl = tree_.as<VarDecl>(var.decl);
      if (decl.type) type = written(tree_.range(decl.type));
      if (decl.init) initial = written(tree_.range(decl.init));
      if (decl.located && decl.address_loc)
        result.declaration += " AT " + std::string(view_.sources().tokenAt(decl.address_loc));
      result.documentation = documentationOf(view_.sources(), decl.h);
    }
    if (var.record && !var.pou) result.declaration = text(var.name);  // a field
    result.declaration += " : " + type;
    if (!initial.empty()) result.declaration += " := " + initial;
    result.facts = ownerOf(var) + valueOf(var) + placeOf(var) + tasksOf(var.pou);
    return result;
  }

  std::string modifiersOf(const sema::Var& var) const {
    std::string out;
    if (var.constant) out += " CONSTANT";
    if (var.keeping.retain) out += " RETAIN";
    if (var.keeping.persistent) out += " PERSISTENT";
    return out;
  }

  static std::string paragraph(const std::string& text) { return "\n\n" + text; }

  std::string ownerOf(const sema::Var& var) const {
    if (var.pou) return paragraph("of `" + text(project_.pou(var.pou).name) + "`");
    if (var.record) return paragraph("of `" + project_.types.toString(var.record) + "`");
    if (var.list.index != 0 && project_.global_lists[var.list.index].name)
      return paragraph("in `" + text(project_.global_lists[var.list.index].name) + "`");
    return {};
  }
  std::string valueOf(const sema::Var& var) const {
    if (!var.constant || !var.has_value) return {};
    return paragraph("value `" + types::toString(project_.types, view_.names(), var.value) + "`");
  }
  std::string sizeOf(TypeId type) const {
    const types::TypeTable& types = project_.types;
    const types::TypeInfo& info = types.info(types.resolve(type));
    const bool is_large = info.kind == types::TypeKind::Array || info.kind == types::TypeKind::Record;
    uint64_t size = is_large && info.laid_out ? info.size : 0;
    if (const types::TypeKind kind = types.plainKind(type); types::TypeTable::isScalar(kind))
      size = (types::TypeTable::bitWidth(kind) + 7) / 8;
    return size == 0 ? std::string() : paragraph(std::to_string(size) + (size == 1 ? " byte" : " bytes"));
  }

  // Its size, and the addresses that it has in the process image: of a variable of a block in each instance.
  std::string placeOf(const sema::Var& var) const {
    constexpr size_t kMost = 4;
    std::vector<std::string> addresses;
    if (var.storage == sema::Storage::Image) addresses.push_back(addressText(project_, var.image));
    for (const sema::InstancePath& path : project_.instance_paths)
      if (path.located && &project_.var(path.var) == &var) addresses.push_back(addressText(project_, path.image));
    std::string text;
    for (size_t i = 0; i < std::min(addresses.size(), kMost); ++i)
      text += (i > 0 ? ", `" : "at `") + addresses[i] + "`";
    if (addresses.size() > kMost) text += ", …";
    const bool is_bit = var.storage == sema::Storage::Image && var.image.is_bit;
    std::string size = is_bit ? std::string() : sizeOf(var.type);
    if (text.empty()) return size;
    return size.empty() ? paragraph(text) : size + " " + text;
  }

  // Those that run a program.
  std::string tasksOf(PouId program) const {
    std::string out;
    if (!program || project_.pou(program).kind != PouKind::Program) return out;
    for (const sema::ProgramInstance& instance : project_.instances)
      if (const std::string task = instance.program == program ? taskOf(instance) : ""; out.find(task) == out.npos)
        out += task;
    return out;
  }

  Description pou(PouId id) const {
    const PouSignature signature = signatureOf(view_, id);
    Description result{signature.declaration(), signature.documentation, {}};
    const sema::Pou& pou = project_.pou(id);
    if (pou.owner) result.facts += paragraph("of `" + text(project_.pou(pou.owner).name) + "`");
    if (pou.library && pou.library_name) {
      result.facts += timingOf(text(pou.library_name), text(pou.name));
      result.facts += paragraph("in the library `" + text(pou.library_name) + "`");
    }
    result.facts += tasksOf(id);
    return result;
  }

  std::string taskOf(const sema::ProgramInstance& instance) const {
    const std::string task = taskText(view_, instance);
    return task.empty() ? std::string() : paragraph("runs in " + task);
  }

  // As it is written, at most twenty lines of it.
  Description type(TypeId id) const {
    if (const PouId block = scope_.blockOf(id)) return pou(block);
    constexpr int kMostLines = 20;
    Description result{"TYPE " + project_.types.toString(id), {}, sizeOf(id)};
    const Loc loc = scope_.locOf(Entity::of(EntityKind::Type, id.index));
    const FileId file = view_.sources().fileOf(loc);
    if (!file) return result;
    const std::string_view source = view_.sources().original(file);
    const size_t begin = loc.offset - view_.sources().begin(file).offset;
    size_t end = endOfType(source, begin);
    int lines = 0;
    for (size_t at = begin; at < end; ++at)
      if (source[at] == '\n' && ++lines == kMostLines) end = at;
    result.declaration = "TYPE " + std::string(source.substr(begin, end - begin));
    if (lines == kMostLines) result.declaration += "\n…";
    result.documentation = documentationAbove(source, begin);
    return result;
  }

  // After the `;` that ends an entry of a TYPE block.
  static size_t endOfType(std::string_view source, size_t begin) {
    Scanner scanner(source);
    scanner.moveTo(begin);
    int structures = 0;
    for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
      const std::string word = upper(scanner.textOf(unit));
      if (word == "STRUCT" || word == "UNION") ++structures;
      if (word == "END_STRUCT" || word == "END_UNION") --structures;
      if (word == ";" && structures <= 0) return unit.end;
      if (word == "END_TYPE") return unit.begin;
    }
    return source.size();
  }

  Description item(const sema::EnumValue& item) const {
    return {project_.types.toString(item.type) + "#" + text(item.name) + " := " + std::to_string(item.value), {}, {}};
  }
  Description list(const sema::GlobalList& list) const {
    return {"VAR_GLOBAL  // " + text(list.name), {}, paragraph(std::to_string(list.vars.size()) + " variables")};
  }
  Description instance(const sema::ProgramInstance& instance) const {
    return {"PROGRAM " + text(instance.name) + " : " + text(project_.pou(instance.program).name), {}, taskOf(instance)};
  }
  Description property(const sema::Property& property) const {
    Description result{"PROPERTY " + text(property.name), {}, {}};
    for (uint32_t i = 1; i < project_.properties.size(); ++i)
      if (&project_.properties[i] == &property)
        result.declaration += " : " + project_.types.toString(scope_.typeOf(Entity::of(EntityKind::Property, i)));
    if (!property.set) result.facts = paragraph("only read");
    if (!property.get) result.facts = paragraph("only written");
    return result;
  }

  const View& view_;
  const Tree& tree_;
  const Scope& scope_;
  const sema::Project& project_;
};

std::string markdownOf(const Description& description) {
  std::string out = "```iecst\n" + description.declaration + "\n```";
  if (!description.documentation.empty()) out += "\n\n" + description.documentation;
  return out + description.facts;
}

// `NAMESPACE Plant.Drives`.
std::string outerText(const OuterName& name) {
  const auto declarations = std::count_if(name.references.begin(), name.references.end(),
                                          [](const Reference& reference) { return reference.is_declaration; });
  const std::string blocks = declarations > 1 ? "\n\nin " + std::to_string(declarations) + " blocks" : "";
  return markdownOf({upper(wordOf(name.kind)) + " " + name.full, {}, blocks});
}

}  // namespace

Description describe(const View& view, Entity entity) { return Describer(view).of(entity); }

std::optional<Hover> hoverAt(const View& view, const LibraryIndex& libraries, FileId file, uint32_t byte) {
  if (const std::optional<OuterName> name = outerNameAt(view, file, byte); name && name->kind != OuterKind::List)
    return Hover{name->at, outerText(*name)};
  if (const std::optional<NamePlace> place = nameAt(view, file, byte)) {
    const Description description = describe(view, place->entity);
    if (!description.declaration.empty()) return Hover{view.nameInFile(place->loc), markdownOf(description)};
  }
  // A library block that the program does not use yet, because the line is not finished.
  const Loc at = view.parsedAt(file, byte);
  if (!at || view.snapshot().project() == nullptr) return std::nullopt;
  const FileRange token = view.tokenInFile(at);
  const std::string_view text = view.textOf(token.file);
  uint32_t begin = token.begin;
  while (begin > 0 && isNameCharacter(text[begin - 1])) --begin;
  uint32_t end = token.begin;
  while (end < text.size() && isNameCharacter(text[end])) ++end;
  const LibraryName* const name =
      libraries.find(text.substr(begin, end - begin), view.snapshot().project()->options.dialect);
  const std::optional<PouSignature> signature = name == nullptr ? std::nullopt : signatureOf(*name);
  if (!signature) return std::nullopt;
  return Hover{
      {token.file, begin, end},
      markdownOf({signature->declaration(), signature->documentation,
                  timingOf(name->library, name->name) + "\n\nin the library `" + std::string(name->library) + "`"})};
}

}  // namespace rung::ide
