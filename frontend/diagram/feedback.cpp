#include "frontend/diagram/feedback.h"

#include <algorithm>
#include <string>

namespace rung::diagram {
namespace {

constexpr uint32_t kMaxDepth = 100;

bool isFunction(const DiagramElement& e) { return e.kind == ElementKind::Box && !keepsState(e); }

class Search {
 public:
  Search(const Tree& tree, const Graph& graph)
      : tree_(tree), graph_(graph), phase_(graph.elements.size(), Phase::New), turn_(graph.elements.size(), 0) {
    for (uint32_t k = 0; k < graph.roots.size(); ++k) turn_[graph.roots[k]] = k + 1;
  }

  std::vector<uint32_t> run() {
    for (const uint32_t root : graph_.roots) walk(root);
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return found_;
  }

 private:
  enum class Phase : uint8_t { New, Busy, Done };
  struct Frame {
    uint32_t element, pin, wire;
  };

  bool isKept(uint32_t element) const {
    return keepsState(graph_.elements[element]) || std::find(found_.begin(), found_.end(), element) != found_.end();
  }

  uint32_t next(Frame& frame) const {
    const DiagramElement& e = graph_.elements[frame.element];
    while (frame.pin < e.pins.count) {
      const DiagramPin& pin = tree_.list(e.pins)[frame.pin];
      if (frame.wire < pin.wires.count) return graph_.sources[graph_.sourceOf(pin, frame.wire++)].element;
      ++frame.pin;
      frame.wire = 0;
    }
    return kNone;
  }

  void walk(uint32_t root) {
    if (phase_[root] != Phase::New) return;
    std::vector<Frame> stack{{root, 0, 0}};
    phase_[root] = Phase::Busy;
    while (!stack.empty()) {
      const uint32_t from = next(stack.back());
      if (from == kNone) {
        phase_[stack.back().element] = Phase::Done;
        stack.pop_back();
        continue;
      }
      const DiagramElement& e = graph_.elements[from];
      if (e.order != 0) {  // who reads it has its turn at the root's
        if (isFunction(e) && turn_[from] >= turn_[root]) found_.push_back(from);
        continue;
      }
      if (phase_[from] == Phase::New) {
        phase_[from] = Phase::Busy;
        stack.push_back({from, 0, 0});
      } else if (phase_[from] == Phase::Busy) {
        breakCircle(stack, from);
      }
    }
  }

  // The circle is the end of the stack from `first` on. Nothing is needed where one of it keeps a value.
  void breakCircle(const std::vector<Frame>& stack, uint32_t first) {
    uint32_t box = kNone;
    for (size_t k = stack.size(); k > 0; --k) {
      const uint32_t element = stack[k - 1].element;
      if (isKept(element)) return;
      if (isFunction(graph_.elements[element])) box = element;
      if (element == first) break;
    }
    if (box != kNone) found_.push_back(box);
  }

  const Tree& tree_;
  const Graph& graph_;
  std::vector<Phase> phase_;
  std::vector<uint32_t> turn_;
  std::vector<uint32_t> found_;
};

class Types {
 public:
  Types(Tree& tree, Names& names, const PouDecl& pou, const Graph& graph)
      : tree_(tree), names_(names), pou_(pou), graph_(graph) {}

  TypeExprId ofBox(uint32_t element, uint32_t depth) {
    if (depth > kMaxDepth) return {};
    const DiagramElement& e = graph_.elements[element];
    if (!isFunction(e)) return {};
    const std::string_view name = names_.text(e.name.name);
    for (const char* comparison : {"GT", "GE", "EQ", "LE", "LT", "NE"})
      if (sameIdentifier(name, comparison)) return named("BOOL", e.loc);
    std::string upper(name);
    for (char& c : upper) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
    if (const size_t to = upper.rfind("TO_"); to == 0 || (to != std::string::npos && upper[to - 1] == '_'))
      return named(upper.substr(to + 3), e.loc);
    for (const char* same : {"AND", "OR",    "XOR", "NOT", "ADD", "SUB", "MUL", "DIV", "MOD", "MOVE", "SEL",
                             "MUX", "LIMIT", "MAX", "MIN", "ABS", "SHL", "SHR", "ROL", "ROR", "EXPT"})
      if (sameIdentifier(name, same)) return ofOperands(e, element, upper, depth);
    return {};
  }

 private:
  // The type that the inputs share; where they tell nothing, that of the variable that takes the value.
  TypeExprId ofOperands(const DiagramElement& e, uint32_t element, const std::string& name, uint32_t depth) {
    bool first = true;
    for (const DiagramPin& pin : tree_.list(e.pins)) {
      const bool control = sameIdentifier(names_.text(pin.name.name), "EN");
      if (pin.direction == PinDirection::Output || control) continue;
      const bool selects = first && (name == "SEL" || name == "MUX");
      first = false;
      if (selects || pin.wires.empty()) continue;
      const TypeExprId type = ofSource(graph_.sourceOf(pin, 0), depth + 1);
      if (type) return type;
    }
    for (uint32_t s = graph_.first_source[element]; s != kNone; s = graph_.sources[s].next) {
      if (graph_.sources[s].user == kNone) continue;
      const DiagramElement& user = graph_.elements[graph_.sources[s].user];
      if (user.kind == ElementKind::Output && user.operand) return ofVariable(user.operand);
      if (user.kind == ElementKind::Coil) return named("BOOL", e.loc);
    }
    return {};
  }

  TypeExprId ofSource(uint32_t source, uint32_t depth) {
    const uint32_t element = graph_.sources[source].element;
    const DiagramElement& e = graph_.elements[element];
    if (e.kind == ElementKind::Contact || e.kind == ElementKind::Rail) return named("BOOL", e.loc);
    if (e.kind == ElementKind::Input || e.kind == ElementKind::InOut) return ofVariable(e.operand);
    return ofBox(element, depth);
  }

  TypeExprId ofVariable(ExprId expr) {
    if (tree_.kind(expr) != ExprKind::Name) return {};
    const NameId name = tree_.as<NameExpr>(expr).name;
    for (const DeclId s : tree_.list(pou_.sections))
      for (const DeclId v : tree_.list(tree_.as<SectionDecl>(s).vars)) {
        const VarDecl& var = tree_.as<VarDecl>(v);
        for (const Ident& declared : tree_.list(var.names))
          if (names_.same(declared.name, name)) return var.type;
      }
    return {};
  }

  TypeExprId named(std::string_view type, Loc loc) {
    const Ident ident{names_.intern(type), loc};
    NamedTypeExpr node{};
    node.h = {TypeExprKind::Named, 0, 0, loc, {}};
    node.path = tree_.addList<Ident>({&ident, 1});
    return tree_.add<TypeExprId>(node);
  }

  Tree& tree_;
  Names& names_;
  const PouDecl& pou_;
  const Graph& graph_;
};

}  // namespace

std::vector<uint32_t> readBeforeTurn(const Tree& tree, const Graph& graph) { return Search(tree, graph).run(); }

TypeExprId typeOfBox(Tree& tree, Names& names, const PouDecl& pou, const Graph& graph, uint32_t box) {
  return Types(tree, names, pou, graph).ofBox(box, 0);
}

}  // namespace rung::diagram
