// SPDX-License-Identifier: Apache-2.0
// Cams that the source declares; see constant_cams.h.
#include "sema/bodies/constant_cams.h"

#include <algorithm>
#include <map>

#include "cam/design/st_form.h"
#include "frontend/syntax/children.h"
#include "sema/bodies/expressions.h"
#include "sema/bodies/names.h"
#include "sema/declarations/constants.h"
#include "sema/declarations/mentions.h"
#include "sema/project.h"
#include "sema/scopes.h"

namespace rung::sema {

namespace {

using types::TypeInfo;

const TypeInfo& infoOf(const Context& context, TypeId type) {
  return context.types().info(context.types().resolve(type));
}

size_t fieldNamed(const Context& context, const TypeInfo& record, std::string_view name) {
  size_t i = 0;
  while (i < record.fields.size() && !sameIdentifier(context.names().string(record.fields[i].name), name)) ++i;
  return i;
}

VarId declared(const Context& context, VarId id) {
  while (const VarId global = context.symbols.var(id).external) id = global;
  return id;
}

ExprId withoutConversion(const Tree& tree, ExprId id) {
  while (id && tree.kind(id) == ExprKind::Convert) id = tree.as<ConvertExpr>(id).operand;
  return id;
}

// The variable of ADR(x) and ADR(x[first]); none of other expressions.
VarId addressed(Context& context, ExprId value) {
  const Tree& tree = context.tree();
  value = withoutConversion(tree, value);
  if (!value || tree.kind(value) != ExprKind::AddressOf) return {};
  ExprId lvalue = tree.as<AddressOfExpr>(value).lvalue;
  if (tree.kind(lvalue) == ExprKind::Index) {
    const IndexExpr& node = tree.as<IndexExpr>(lvalue);
    const TypeInfo& array = infoOf(context, typeOf(tree, node.base));
    if (array.dimensions.size() != node.indices.count) return {};
    for (uint32_t i = 0; i < node.indices.count; ++i)
      if (constantInteger(context, tree.list(node.indices)[i]) != array.dimensions[i].low) return {};
    lvalue = node.base;
  }
  const Entity entity = entityOf(context, lvalue);
  if (entity.entityKind() != EntityKind::Var) return {};
  if (tree.kind(lvalue) == ExprKind::Member && !isWhole(context, tree.as<MemberExpr>(lvalue))) return {};
  return declared(context, {entity.index});
}

// Cams, and what has its address taken: a body that mentions none of them changes no table.
std::vector<bool> partsOfCams(const Context& context) {
  const std::deque<Var>& vars = context.symbols.vars;
  std::vector<bool> parts(vars.size());
  for (uint32_t i = 1; i < vars.size(); ++i) parts[i] = isCam(context, vars[i].type);
  const auto add = [&](const std::vector<Mention>& mentions) {
    for (const Mention& mention : mentions)
      if (takesAddress(mention.access) && mention.entity.entityKind() == EntityKind::Var)
        parts[mention.entity.index] = true;
  };
  add(context.project.mentions);
  for (const Pou& pou : context.symbols.pous) add(pou.body.mentions);
  return parts;
}

// What the bodies of the project do with variables: which they may change, and which members of cams they set once.
class Changes {
 public:
  explicit Changes(Context& context)
      : context_(context), tree_(context.tree()), changed_(context.symbols.vars.size(), false) {
    const BodiesWith parts(context.project, partsOfCams(context));
    for (uint32_t i = 1; i < context.symbols.pous.size(); ++i) {
      const Pou& pou = context.symbols.pous[i];
      if (pou.library || !pou.decl || pou.generic || !pou.progress.checked() || !parts.mayMention(pou)) continue;
      for (const StmtId id : tree_.list(pou.body.code)) statement(id);
      all_ = all_ || pou.cpp.is_body;
    }
    // Initial values of instances set their members.
    for (uint32_t i = 1; i < context.symbols.vars.size(); ++i)
      if (const ExprId init = context.symbols.vars[i].init) expression(init, false);
  }

  bool mayChange(VarId id) const { return all_ || changed_[id.index]; }
  // The values that bodies assign to a member, by the variable and its field.
  std::vector<ExprId> assigned(VarId id, size_t field) const {
    const auto found = assigned_.find({id.index, field});
    return found == assigned_.end() ? std::vector<ExprId>() : found->second;
  }

 private:
  void statement(StmtId id) {
    if (tree_.kind(id) == StmtKind::Assign) {
      const AssignStmt& node = tree_.as<AssignStmt>(id);
      if (node.op() == AssignOp::Assign && isMemberOfCam(node)) return;
      expression(node.target, true);
      return expression(node.value, false);
    }
    forEachChild(tree_, id, [&](auto child) { visit(child); });
  }
  void visit(StmtId id) { statement(id); }
  void visit(ExprId id) { expression(id, false); }
  void visit(TypeExprId) {}
  void visit(DeclId) {}

  // cam.pce := ADR(points);
  bool isMemberOfCam(const AssignStmt& node) {
    if (tree_.kind(node.target) != ExprKind::Member) return false;
    const MemberExpr& member = tree_.as<MemberExpr>(node.target);
    const Entity base = entityOf(context_, member.base);
    if (base.entityKind() != EntityKind::Var || !isCam(context_, typeOf(tree_, member.base))) return false;
    if (tree_.kind(member.base) == ExprKind::Member && !isWhole(context_, tree_.as<MemberExpr>(member.base)))
      return false;
    const TypeInfo& record = infoOf(context_, typeOf(tree_, member.base));
    const size_t field = fieldNamed(context_, record, context_.names().string(member.member));
    const VarId cam = declared(context_, {base.index});
    assigned_[{cam.index, field}].push_back(node.value);
    if (!addressed(context_, node.value)) expression(node.value, false);
    return true;
  }

  void change(ExprId id) {
    if (const Entity entity = entityOf(context_, id); entity.entityKind() == EntityKind::Var)
      changed_[declared(context_, {entity.index}).index] = true;
  }

  void expression(ExprId id, bool writes) {
    if (!id) return;
    const ExprKind kind = tree_.kind(id);
    if (writes) change(id);
    if (shape(kind) == ExprShape::Step) return step(id, writes);
    if (kind == ExprKind::AddressOf) return expression(tree_.as<AddressOfExpr>(id).lvalue, true);
    if (kind == ExprKind::StructInit) return members(tree_.as<StructInitExpr>(id));
    if (kind == ExprKind::Call) return call(tree_.as<CallExpr>(id));
    if (kind == ExprKind::Assign) {
      expression(tree_.as<AssignExpr>(id).target, true);
      return expression(tree_.as<AssignExpr>(id).value, false);
    }
    forEachChild(tree_, id, [&](auto child) { visit(child); });
  }

  // Who writes through a pointer does not change the pointer.
  void step(ExprId id, bool writes) {
    const ExprKind kind = tree_.kind(id);
    if (kind == ExprKind::Index)
      for (const ExprId index : tree_.list(tree_.as<IndexExpr>(id).indices)) expression(index, false);
    expression(tree_.base(id), writes && kind != ExprKind::Deref);
  }

  // Members of an instance: `block : Mover := (cam := (…))`. The address of an array in a cam is not a change.
  void members(const StructInitExpr& node) {
    const bool of_cam = isCam(context_, meaning(node.h).type);
    for (const FieldInit& field : tree_.list(node.fields)) {
      if (of_cam && addressed(context_, field.value)) continue;
      expression(field.value, false);
      if (of_cam || !isCam(context_, typeOf(tree_, field.value))) continue;
      for (uint32_t i = 1; i < context_.symbols.vars.size(); ++i)
        if (context_.names().key(context_.symbols.vars[i].name) == context_.names().key(field.field.name))
          changed_[i] = true;
    }
  }

  void call(const CallExpr& node) {
    expression(node.callee, false);
    if (!meaning(node.h).call) {
      for (const Argument& argument : tree_.list(node.arguments)) expression(argument.value, true);
      return;
    }
    const Call& resolved = context_.symbols.call(meaning(node.h).call);
    if (resolved.instance) expression(resolved.instance, false);
    for (const Binding& binding : resolved.bindings) {
      const Var* const pin = binding.pin ? &context_.symbols.var(binding.pin) : nullptr;
      const bool writes = binding.is_output || (pin != nullptr && pin->section == SectionKind::InOut && !pin->constant);
      expression(binding.value, writes);
    }
    expression(resolved.eno, true);
    expression(resolved.en, false);
  }

  Context& context_;
  const Tree& tree_;
  bool all_ = false;  // a body in C++ may do anything
  std::vector<bool> changed_;
  std::map<std::pair<uint32_t, size_t>, std::vector<ExprId>> assigned_;
};

// Reads one cam.
class Reader {
 public:
  Reader(Context& context, const Changes& changes, VarId id)
      : context_(context), tree_(context.tree()), changes_(changes), var_(context.symbols.var(id)) {
    read_.var = id;
    read_.name = var_.loc;
    read_.cam.name = context.names().string(var_.name);
    for (const Pragma& pragma : tree_.list(tree_.decl(var_.decl).pragmas))
      if (sameIdentifier(context.names().string(pragma.name), cam::kDesignAttribute))
        read_.design = tree_.string(pragma.value);
  }

  bool read() {
    if (!isFixed(read_.var) || !readHeader()) return false;
    return readRows() && readSegments() && readTappets();
  }
  ConstantCam take() { return std::move(read_); }

 private:
  bool isFixed(VarId id) const {
    const Var& var = context_.symbols.var(id);
    const bool is_own = var.section == SectionKind::Local || var.section == SectionKind::Global ||
                        var.section == SectionKind::Stat || var.section == SectionKind::Temp;
    return is_own && var.storage != Storage::Image && !var.keeping.retain && !var.keeping.persistent &&
           !var.start.late && !changes_.mayChange(id);
  }

  // The value of a member: the initial one, or the only one that bodies assign. False: it is not known. None: 0.
  bool member(const char* name, ExprId& value) {
    const TypeInfo& record = infoOf(context_, var_.type);
    const size_t field = fieldNamed(context_, record, name);
    value = memberOf(var_.init, var_.type, name);
    const bool is_given = given_;
    const std::vector<ExprId> assigned = changes_.assigned(read_.var, field);
    if (assigned.empty()) return true;
    if (assigned.size() > 1 || is_given) return false;
    value = assigned.front();
    given_ = true;
    return true;
  }

  // What a structure's initial value, or else its type, gives a member.
  ExprId memberOf(ExprId init, TypeId type, const char* name) {
    given_ = false;
    if (init && tree_.kind(init) == ExprKind::StructInit) {
      for (const FieldInit& field : tree_.list(tree_.as<StructInitExpr>(init).fields)) {
        if (!sameIdentifier(context_.names().string(field.field.name), name)) continue;
        given_ = true;
        return field.value;
      }
    }
    const TypeId record = context_.types().resolve(type);
    const auto& inits = context_.project.field_inits;
    const size_t field = fieldNamed(context_, context_.types().info(record), name);
    return record.index < inits.size() && field < inits[record.index].size() ? inits[record.index][field] : ExprId{};
  }

  bool number(ExprId expr, double& value) {
    value = 0;
    if (!expr) return true;
    const std::optional<types::Value> known = evaluate(context_, expr);
    if (!known) return false;
    const types::TypeKind kind = context_.types().plainKind(known->type);
    if (kind == types::TypeKind::Real || kind == types::TypeKind::LReal)
      value = known->asReal();
    else
      value =
          context_.types().isSigned(kind) ? static_cast<double>(known->asSigned()) : static_cast<double>(known->bits);
    return true;
  }

  bool numberOf(const char* name, double& value, Loc* loc = nullptr) {
    ExprId expr;
    if (!member(name, expr)) return false;
    if (loc != nullptr) *loc = given_ && expr ? tree_.begin(expr) : var_.loc;
    return number(expr, value);
  }

  bool readHeader() {
    double type = 0, var_type = 0, elements = 0, capacity = 0, quality = 0;
    cam::Cam& cam = read_.cam;
    cam::Scale scale;
    if (!numberOf("byType", type) || !numberOf("byVarType", var_type, &read_.type_loc) ||
        !numberOf("nElements", elements, &read_.elements_loc) || !numberOf("nCapacity", capacity) ||
        !numberOf("xStart", cam.start) || !numberOf("xEnd", cam.end, &read_.end_loc) ||
        !numberOf("byInterpolationQuality", quality) || !numberOf("fTableMasterMin", scale.table_min) ||
        !numberOf("fTableMasterMax", scale.table_max) || !numberOf("fEditorMasterMin", scale.master_min) ||
        !numberOf("fEditorMasterMax", scale.master_max))
      return false;
    if (type < 0 || type > 3 || elements < 0) return false;
    cam.kind = static_cast<cam::Kind>(static_cast<int>(type));
    cam.cubic = quality == 3;
    cam.capacity = capacity > 0 ? static_cast<size_t>(capacity) : 0;
    if (scale.table_min != scale.table_max) cam.scale = scale;
    read_.elements = static_cast<int64_t>(elements);
    read_.var_type = static_cast<uint8_t>(var_type);
    return true;
  }

  // The array that a pointer of the cam leads to.
  VarId arrayOf(const char* pointer, bool& is_known) {
    ExprId address;
    is_known = member(pointer, address);
    if (!is_known || !address) return {};
    const VarId array = addressed(context_, address);
    is_known = array || (evaluate(context_, address) && evaluate(context_, address)->bits == 0);
    if (!array) return {};
    const Var& var = context_.symbols.var(array);
    is_known = isFixed(array) && context_.types().kind(var.type) == types::TypeKind::Array;
    return is_known ? array : VarId{};
  }

  // The elements of an array as its initial value gives them; a repeated one several times.
  void expand(Slice<ExprId> list, size_t most, std::vector<ExprId>& elements) const {
    for (const ExprId id : tree_.list(list)) {
      if (elements.size() >= most) return;
      if (tree_.kind(id) != ExprKind::Repeat) {
        elements.push_back(id);
        continue;
      }
      const RepeatExpr& repeat = tree_.as<RepeatExpr>(id);
      if (tree_.kind(repeat.count) != ExprKind::Literal) continue;
      const uint64_t times = tree_.as<LiteralExpr>(repeat.count).value();
      for (uint64_t i = 0; i < times && elements.size() < most; ++i) {
        if (repeat.elements.empty())
          elements.push_back({});
        else
          expand(repeat.elements, most, elements);
      }
    }
  }

  std::vector<ExprId> elementsOf(ExprId init, size_t count) const {
    std::vector<ExprId> elements;
    if (init && tree_.kind(init) == ExprKind::ArrayInit)
      expand(tree_.as<ArrayInitExpr>(init).elements, count, elements);
    elements.resize(count);
    return elements;
  }

  static cam::Number numberKind(types::TypeKind kind) {
    constexpr types::TypeKind kKinds[] = {types::TypeKind::None, types::TypeKind::Int,   types::TypeKind::UInt,
                                          types::TypeKind::DInt, types::TypeKind::UDInt, types::TypeKind::Real,
                                          types::TypeKind::LReal};  // by cam::Number
    const auto* const found = std::find(std::begin(kKinds) + 1, std::end(kKinds), kind);
    return found == std::end(kKinds) ? cam::Number::None : static_cast<cam::Number>(found - std::begin(kKinds));
  }

  bool readRows() {
    bool is_known = false;
    read_.array = arrayOf("pce", is_known);
    if (!read_.array) return false;
    const Var& array = context_.symbols.var(read_.array);
    if (!array.init) return false;  // a host, or a user at a terminal, fills it
    const TypeInfo& info = infoOf(context_, array.type);
    if (info.dimensions.empty()) return false;
    int64_t room = 1;
    for (const types::Dimension& dimension : info.dimensions) room *= static_cast<int64_t>(dimension.count());
    read_.low = info.dimensions[0].low;
    const bool is_record = context_.types().kind(info.base) == types::TypeKind::Record;
    const size_t per_row = read_.cam.kind == cam::Kind::Pairs ? 2 : 1;
    read_.number = numberKind(context_.types().plainKind(info.base));
    read_.cam.number = read_.number;
    const bool has_structures = read_.cam.kind == cam::Kind::QuinticPoints || read_.cam.kind == cam::Kind::Polynomials;
    if (is_record != has_structures || (!is_record && read_.number == cam::Number::None)) return false;
    read_.room = room / static_cast<int64_t>(per_row);
    const size_t count = static_cast<size_t>(std::min(read_.elements, read_.room));
    if (count > cam::kMostRows) return false;
    for (const ExprId element : elementsOf(array.init, count * per_row))
      if (!(is_record ? readStructure(element, info.base) : readNumber(element, per_row))) return false;
    if (read_.cam.kind == cam::Kind::QuinticPoints)
      read_.cam.segments.assign(read_.cam.points.size(), cam::SegmentKind::Quintic);
    return true;
  }

  void noteRow(ExprId master, ExprId element) {
    read_.rows.push_back(master ? tree_.begin(master) : element ? tree_.begin(element) : read_.name);
  }

  bool readNumber(ExprId element, size_t per_row) {
    double value = 0;
    if (!number(element, value)) return false;
    if (read_.cam.numbers.size() % per_row == 0) noteRow(element, {});
    read_.cam.numbers.push_back(value);
    return true;
  }

  bool readStructure(ExprId element, TypeId type) {
    if (element && tree_.kind(element) != ExprKind::StructInit) return false;
    const TypeInfo& record = infoOf(context_, type);
    const auto has = [&](const char* name) { return fieldNamed(context_, record, name) < record.fields.size(); };
    const ExprId master = memberOf(element, type, "dX");
    noteRow(given_ ? master : ExprId{}, element);
    if (read_.cam.kind == cam::Kind::QuinticPoints) {
      if (!has("dX") || !has("dY") || !has("dV") || !has("dA")) return false;
      cam::Point point{};
      if (!number(master, point.x) || !number(memberOf(element, type, "dY"), point.y) ||
          !number(memberOf(element, type, "dV"), point.slope) ||
          !number(memberOf(element, type, "dA"), point.curvature))
        return false;
      read_.cam.points.push_back(point);
      return true;
    }
    if (!has("dX") || !has("c")) return false;
    cam::Polynomial polynomial{};
    if (!number(master, polynomial.x)) return false;
    const std::vector<ExprId> factors = elementsOf(memberOf(element, type, "c"), std::size(polynomial.c));
    for (size_t i = 0; i < factors.size(); ++i)
      if (!number(factors[i], polynomial.c[i])) return false;
    read_.cam.polynomials.push_back(polynomial);
    return true;
  }

  bool readSegments() {
    bool is_known = false;
    const VarId array = arrayOf("pSegments", is_known);
    if (!array) return is_known;
    const std::vector<ExprId> kinds =
        elementsOf(context_.symbols.var(array).init, std::max<size_t>(read_.cam.segments.size(), 1) - 1);
    for (size_t i = 0; i < kinds.size(); ++i) {
      double kind = 0;
      if (!number(kinds[i], kind)) return false;
      read_.cam.segments[i] = kind == 0 ? cam::SegmentKind::Line : cam::SegmentKind::Quintic;
    }
    return true;
  }

  bool readTappets() {
    double count = 0;
    bool is_known = false;
    const VarId array = arrayOf("pt", is_known);
    if (!is_known || !numberOf("nTappets", count)) return false;
    if (!array || count <= 0) return true;
    const TypeInfo& info = infoOf(context_, context_.symbols.var(array).type);
    for (const ExprId element : elementsOf(context_.symbols.var(array).init, static_cast<size_t>(count))) {
      cam::Tappet tappet;
      double group = 0, direction = 0, action = 0, delay = 0, duration = 0;
      if (!number(memberOf(element, info.base, "x"), tappet.x) ||
          !number(memberOf(element, info.base, "iGroupID"), group) ||
          !number(memberOf(element, info.base, "ctt"), direction) ||
          !number(memberOf(element, info.base, "cta"), action) ||
          !number(memberOf(element, info.base, "dwDelay"), delay) ||
          !number(memberOf(element, info.base, "dwDuration"), duration) || direction > 2 || action > 3)
        return false;
      tappet.group = static_cast<int32_t>(group);
      tappet.direction = static_cast<cam::TappetDirection>(static_cast<int>(direction));
      tappet.action = static_cast<cam::TappetAction>(static_cast<int>(action));
      tappet.delay = static_cast<uint32_t>(delay);
      tappet.duration = static_cast<uint32_t>(duration);
      read_.cam.tappets.push_back(tappet);
    }
    return true;
  }

  Context& context_;
  const Tree& tree_;
  const Changes& changes_;
  const Var& var_;
  bool given_ = false;  // the last member has a value of its own
  ConstantCam read_;
};

}  // namespace

bool isCam(const Context& context, TypeId type) {
  if (!type || context.types().kind(type) != types::TypeKind::Record) return false;
  const TypeInfo& record = infoOf(context, type);
  return !record.fields.empty() && sameIdentifier(context.names().string(record.fields[0].name), "wCamStructID");
}

std::vector<ConstantCam> constantCams(Context& context) {
  std::vector<ConstantCam> cams;
  const std::deque<Var>& vars = context.symbols.vars;
  const auto isOfProject = [&](const Var& var) {
    const bool in_library = var.pou && context.symbols.pou(var.pou).library;
    return !var.record && !in_library && var.name && !var.external && isCam(context, var.type);
  };
  if (std::none_of(vars.begin() + 1, vars.end(), isOfProject)) return cams;
  const Changes changes(context);
  for (uint32_t i = 1; i < vars.size(); ++i) {
    if (!isOfProject(vars[i])) continue;
    Reader reader(context, changes, {i});
    if (reader.read()) cams.push_back(reader.take());
  }
  return cams;
}

}  // namespace rung::sema
