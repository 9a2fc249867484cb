// SPDX-License-Identifier: Apache-2.0
// Networks of TwinCAT's FBD and LD editor; see archive.h. A network is a list of trees: assignments and boxes whose
// inputs are trees again. They are written in post-order, inputs before the box that reads them. This is TwinCAT's
// order of evaluation, so elements need no execution order numbers.
//
// LD and FBD are two views of the same trees. In the LD view, AND and OR of BOOL operands become contacts in series and
// in parallel. A line that branches (BoxTreeDemux) is evaluated before the rest of its network: through a MOVE, unless
// it comes from a box, which fixes its value already.
#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "frontend/import/diagnostics.h"
#include "frontend/import/network_writer.h"
#include "frontend/import/twincat/archive.h"
#include "frontend/source/names.h"
#include "frontend/syntax/standard_names.h"

namespace rung::importer::twincat {
namespace {

constexpr std::string_view kMissing = "???";  // the editor's placeholder

// The bits of an object `Flags`. For a coil, Negation and Set together mean reset.
constexpr uint64_t kNegation = 1, kSet = 2, kJumps = 4, kReturns = 8, kRising = 16, kFalling = 32;

struct Wire {
  uint64_t from;            // element of the notation
  const xml::Element* pin;  // <v> with the name of its output; null: its only one
  Loc loc;
};
struct Wires {  // several wires are joined by OR
  std::vector<Wire> all;
  uint64_t flags = 0;  // still to be applied to their value: kNegation, kRising, kFalling
};

Modifiers modifiersOf(uint64_t flags) {
  const EdgeKind edge = (flags & kRising) != 0    ? EdgeKind::Rising
                        : (flags & kFalling) != 0 ? EdgeKind::Falling
                                                  : EdgeKind::None;
  return {(flags & kNegation) != 0, edge, PinStorage::None};
}

class TreeReader {
 public:
  explicit TreeReader(const ArchivedBody& body)
      : archive_(body.archive), name_(body.name), diagnostics_(body.diagnostics), writer_(body.out) {}

  void run(const xml::Element& body);

 private:
  // ---- checks
  bool check(const Element& network, uint32_t number);
  bool checkTree(const Element& tree);
  bool checkOperand(const Element* operand, bool returns = false);

  // ---- writing
  void writeNetwork(const Element& network, uint32_t number, bool readable);
  Wires value(const Element& tree);
  Wires operand(const Element& tree);
  Wires box(const Element& tree);
  Wires demux(const Element& tree);
  Wires parallel(const Element& tree);
  Wires rail(Loc loc);
  Wires boxOf(std::string_view type, const std::vector<Wires>& inputs, Loc loc);
  Wires plain(const Wires& wires, Loc loc) { return wires.flags == 0 ? wires : boxOf(kMove, {wires}, loc); }
  void assign(const Element& target, uint64_t flags, const Wires& wires, bool of_box = false);
  std::vector<WireSource> sourcesOf(const Wires& wires) const;
  void readInstance(const Element& tree, NetworkElement& out) const;
  void readInputs(const Element& tree, const std::vector<Wires>& inputs, NetworkElement& out) const;
  void readOutputs(const Element& tree, size_t count, NetworkElement& out) const;
  size_t mainOutput(const std::vector<const Element*>& targets) const;
  // The name of the kth pin in a list; null: it has none.
  const Element* nameIn(const std::vector<const Element*>& names, size_t k) const {
    return k < names.size() && isPath(archive_.text(*names[k])) ? names[k] : nullptr;
  }
  NetworkElement element(ElementKind kind, Loc loc) { return {kind, loc, {loc, std::to_string(++last_)}}; }

  // ---- contacts
  bool isContact(const Element& tree) const;
  bool isSeries(const Element& tree, bool at_rail) const;
  Wires series(const Element& tree, Wires from);

  bool isDisabled(const Element& network) const { return archive_.isTrue(network, "OutCommented"); }
  uint64_t flagsOf(const Element& object) const {
    const Element* flags = archive_.member(object, "Flags");
    return flags == nullptr ? 0 : archive_.number(*flags, "Flags");
  }
  const Element* listOf(const Element& owner, std::string_view holder, std::string_view list) const {
    const Element* object = archive_.member(owner, holder);
    return object == nullptr ? nullptr : archive_.member(*object, list);
  }
  // Certainly an expression: a path, or a literal without quotes.
  bool isPlainOrNothing(const Element* text) const {
    if (text == nullptr) return true;
    const std::string t = archive_.text(*text);
    if (t.empty() || isPath(t)) return true;
    const bool literal = t[0] >= '0' && t[0] <= '9';
    return literal ? t.find_first_not_of("0123456789") == std::string::npos
                   : t.starts_with("T#") && isPath(t.substr(2).insert(0, 1, 'd'));
  }
  std::vector<const Element*> itemsOf(const Element* list) const {
    std::vector<const Element*> items;
    for (const xml::Element& e : archive_.items(list)) items.push_back(&e);
    return items;
  }

  const Archive& archive_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  NetworkWriter writer_;
  bool ladder_ = false;
  bool quiet_ = false;  // in a disabled network, which causes no errors
  uint64_t last_ = 0;   // number of an element
  uint64_t rail_ = 0;   // of the current network
  std::unordered_map<uint64_t, Wires> branches_;
  std::unordered_set<uint64_t> begun_;  // branches that checkTree() has seen
};

// ---- checks

// Forbids placeholders that the editor leaves for missing names.
//   fails   <v n="Operand">"???"</v>          E1086
bool TreeReader::checkOperand(const Element* operand, bool returns) {
  const Element* text = operand == nullptr ? nullptr : archive_.member(*operand, "Operand");
  if (text == nullptr || returns) return true;
  if (quiet_) return isPlainOrNothing(text);
  if (archive_.text(*text) != kMissing) return true;
  diagnostics_.report(diag::ArchiveOpen, archive_.locOf(*text)).length(kMissing.size());
  return false;
}

// Forbids unknown objects, and a branch that continues an unknown line.
//   fails   <o t="BoxTreeVoid">                                         E1087
//   fails   a BoxTreeDemux without an input whose VarId is new          E1088
bool TreeReader::checkTree(const Element& tree) {
  if (Archive::isNothing(tree)) return true;
  const std::string type = archive_.typeOf(tree);
  bool ok = true;
  const auto inner = [&](const Element* e) { ok = (e == nullptr || checkTree(*e)) && ok; };
  if (type == "BoxTreeOperand") return checkOperand(archive_.member(tree, "Operand"));
  if (type == "BoxTreeAssign") {
    inner(archive_.member(tree, "RValue"));
    for (const Element* target : itemsOf(listOf(tree, "OutputItems", "OutputItems")))
      ok = checkOperand(target, ((flagsOf(*target) | flagsOf(tree)) & kReturns) != 0) && ok;
  } else if (type == "BoxTreeBox") {
    const Element* called = archive_.member(tree, "BoxType");
    if (quiet_ && (archive_.isTrue(tree, "ProvidesSTSnippet") || !isPlainOrNothing(called))) return false;
    if (called != nullptr && archive_.text(*called) == kMissing) {
      diagnostics_.report(diag::ArchiveOpen, archive_.locOf(*called)).length(kMissing.size());
      return false;
    }
    ok = checkOperand(archive_.member(tree, "Instance"));
    for (const Element* item : itemsOf(archive_.member(tree, "InputItems"))) inner(item);
    for (const Element* target : itemsOf(listOf(tree, "OutputItems", "OutputItems"))) ok = checkOperand(target) && ok;
  } else if (type == "BoxTreeDemux") {
    const Element* input = archive_.member(tree, "Input");
    const uint64_t branch = archive_.number(tree, "VarId");
    inner(input);
    if (input != nullptr) {
      begun_.insert(branch);
    } else if (begun_.count(branch) == 0) {
      if (quiet_) return false;
      diagnostics_.report(diag::ArchiveBranch, tree.loc, {std::to_string(branch)});
      return false;
    }
  } else if (type == "BoxTreeTerminator" || type == "BoxTreeParallel") {
    inner(archive_.member(tree, "Input"));
    for (const Element* item : itemsOf(archive_.member(tree, "Trees"))) inner(item);
  } else {
    if (quiet_) return false;
    archive_.reportObject(diagnostics_, tree, "FBD or LD", name_);
    return false;
  }
  return ok;
}

// Forbids a network that exists only in IL.
//   fails   ILActive, with ILLines and without NetworkItems          E1089
bool TreeReader::check(const Element& network, uint32_t number) {
  const Element* lines = archive_.first(archive_.member(network, "ILLines"));
  if (lines != nullptr && archive_.isTrue(network, "ILActive")) {
    if (quiet_) return false;
    diagnostics_.report(diag::ArchiveIl, lines->loc, {std::to_string(number), name_});
    return false;
  }
  bool ok = !quiet_ || isPlainOrNothing(archive_.member(network, "Label"));
  for (const Element* item : itemsOf(archive_.member(network, "NetworkItems"))) ok = checkTree(*item) && ok;
  return ok;
}

// ---- writing

void TreeReader::run(const Element& body) {
  ladder_ = sameIdentifier(archive_.text(body, "DefaultViewMode"), "Ld");
  const std::vector<const Element*> networks = itemsOf(archive_.member(body, "NetworkList"));
  std::vector<bool> readable;
  bool ok = true;
  for (const Element* network : networks) {
    quiet_ = isDisabled(*network);
    readable.push_back(check(*network, static_cast<uint32_t>(readable.size()) + 1));
    ok = ok && (readable.back() || quiet_);
  }
  if (!ok) return;
  writer_.beginBody(body.loc, ladder_ ? NetworkLanguage::Ladder : NetworkLanguage::Blocks);
  for (uint32_t k = 0; k < networks.size(); ++k) writeNetwork(*networks[k], k + 1, readable[k]);
  writer_.endBody(body.end);
}

// A disabled network is only drawn: if it is not readable, it is empty.
void TreeReader::writeNetwork(const Element& network, uint32_t number, bool readable) {
  writer_.beginNetwork(network.loc, number, isDisabled(network), archive_.commentOf(network, "Title"));
  if (!readable) return;
  rail_ = 0;
  if (!archive_.text(network, "Comment").empty()) {
    NetworkElement comment = element(ElementKind::Comment, network.loc);
    comment.comment = archive_.commentOf(network, "Comment");
    writer_.write(comment);
  }
  if (const Element* text = archive_.member(network, "Label"); text != nullptr && !archive_.text(*text).empty()) {
    NetworkElement label = element(ElementKind::Label, text->loc);
    label.name = archive_.excerptOf(*text);
    writer_.write(label);
  }
  for (const Element* item : itemsOf(archive_.member(network, "NetworkItems"))) value(*item);
}

Wires TreeReader::rail(Loc loc) {
  if (rail_ == 0) {
    writer_.write(element(ElementKind::Rail, loc));
    rail_ = last_;
  }
  return {{{rail_, nullptr, loc}}, 0};
}

std::vector<WireSource> TreeReader::sourcesOf(const Wires& wires) const {
  std::vector<WireSource> sources;
  for (const Wire& wire : wires.all)
    sources.push_back(
        {{wire.loc, std::to_string(wire.from)}, wire.pin == nullptr ? xml::Excerpt() : archive_.excerptOf(*wire.pin)});
  return sources;
}

// The value of a tree; none: the tree is empty.
Wires TreeReader::value(const Element& tree) {
  if (Archive::isNothing(tree)) return {};
  const std::string type = archive_.typeOf(tree);
  if (ladder_ && isSeries(tree, true)) return series(tree, rail(tree.loc));
  if (type == "BoxTreeOperand") return operand(tree);
  if (type == "BoxTreeBox") return box(tree);
  if (type == "BoxTreeDemux") return demux(tree);
  if (type == "BoxTreeParallel") return parallel(tree);
  if (type == "BoxTreeTerminator") {
    const Element* input = archive_.member(tree, "Input");
    return input == nullptr ? rail(tree.loc) : value(*input);
  }
  const Element* source = archive_.member(tree, "RValue");
  Wires wires = source == nullptr ? Wires{} : value(*source);
  for (const Element* target : itemsOf(listOf(tree, "OutputItems", "OutputItems")))
    assign(*target, flagsOf(*target) | (flagsOf(tree) & (kJumps | kReturns)), wires);
  return wires;
}

Wires TreeReader::operand(const Element& tree) {
  const Element* held = archive_.member(tree, "Operand");
  const Element* text = held == nullptr ? nullptr : archive_.member(*held, "Operand");
  if (text == nullptr || archive_.text(*text).empty()) return {};
  const uint64_t flags = flagsOf(*held) | flagsOf(tree);
  NetworkElement input = element(ElementKind::Input, text->loc);
  input.operand = archive_.excerptOf(*text);
  input.modifiers.negated = (flags & kNegation) != 0;
  writer_.write(input);
  return {{{last_, nullptr, text->loc}}, flags & (kRising | kFalling)};
}

// A coil or an output; or a jump or return, which the editor treats as coils.
void TreeReader::assign(const Element& target, uint64_t flags, const Wires& wires, bool of_box) {
  const Element* text = archive_.member(target, "Operand");
  if (Archive::isNothing(target) || text == nullptr) return;
  const std::string spelling = archive_.text(*text);
  const bool jump = (flags & kJumps) != 0, leaves = (flags & kReturns) != 0;
  if (spelling.empty() && !leaves) return;
  const bool stores = (flags & kSet) != 0;
  const bool coil = ladder_ && !of_box && sameIdentifier(archive_.text(target, "Type"), "BOOL");
  NetworkElement out = element(jump     ? ElementKind::Jump
                               : leaves ? ElementKind::Return
                               : coil   ? ElementKind::Coil
                                        : ElementKind::Output,
                               text->loc);
  if (!leaves) (jump ? out.name : out.operand) = archive_.excerptOf(*text);
  const uint64_t own = stores ? 0 : flags & kNegation;
  out.modifiers = modifiersOf((own ^ (wires.flags & kNegation)) | ((flags | wires.flags) & (kRising | kFalling)));
  if (stores) out.modifiers.storage = (flags & kNegation) != 0 ? PinStorage::Reset : PinStorage::Set;
  out.input = sourcesOf(wires);
  writer_.write(out);
}

// TON (instance), Module.Method, or a callee that is not a path: M (SUPER^.M)
void TreeReader::readInstance(const Element& tree, NetworkElement& out) const {
  const Element* type = archive_.member(tree, "BoxType");
  const std::string called = type == nullptr ? std::string() : archive_.text(*type);
  const Element* instance = archive_.member(tree, "Instance");
  const Element* operand = instance == nullptr ? nullptr : archive_.member(*instance, "Operand");
  if (called.empty()) {
    out.name = {tree.loc, archive_.text(tree, "CallType")};
  } else if (isPath(called)) {
    out.name = archive_.excerptOf(*type);
  } else {
    out.name = {type->loc, called.substr(called.find_last_of(".^") + 1)};
    out.operand = archive_.excerptOf(*type);
  }
  if (operand != nullptr && !archive_.text(*operand).empty()) out.operand = archive_.excerptOf(*operand);
}

void TreeReader::readInputs(const Element& tree, const std::vector<Wires>& inputs, NetworkElement& out) const {
  const std::vector<const Element*> items = itemsOf(archive_.member(tree, "InputItems"));
  const std::vector<const Element*> names = itemsOf(listOf(tree, "InputParam", "Names"));
  size_t unnamed = 0;
  for (size_t k = 0; k < inputs.size(); ++k) {
    const Element* name = nameIn(names, k);
    const bool enable = name != nullptr && isEnable(archive_.text(*name));
    const size_t index = enable ? unnamed : unnamed++;
    // EN connected to the power rail is always TRUE.
    if (enable && rail_ != 0 && inputs[k].all.size() == 1 && inputs[k].all[0].from == rail_) continue;
    xml::Excerpt named =
        name == nullptr ? xml::Excerpt(items[k]->loc, pinName(PinDirection::Input, index)) : archive_.excerptOf(*name);
    out.pins.push_back({std::move(named), PinDirection::Input, modifiersOf(inputs[k].flags), sourcesOf(inputs[k])});
  }
}

void TreeReader::readOutputs(const Element& tree, size_t count, NetworkElement& out) const {
  const std::vector<const Element*> results = itemsOf(listOf(tree, "OutputParam", "Names"));
  for (size_t k = 0; k < std::max(results.size(), count); ++k) {
    const Element* name = nameIn(results, k);
    xml::Excerpt named =
        name == nullptr ? xml::Excerpt(tree.loc, pinName(PinDirection::Output, k)) : archive_.excerptOf(*name);
    out.pins.push_back({std::move(named), PinDirection::Output, {}, {}});
  }
}

// The output that the enclosing tree reads is the one without a target.
size_t TreeReader::mainOutput(const std::vector<const Element*>& targets) const {
  const auto nothing =
      std::find_if(targets.begin(), targets.end(), [](const Element* e) { return Archive::isNothing(*e); });
  if (nothing != targets.end()) return static_cast<size_t>(nothing - targets.begin());
  const auto open = std::find_if(targets.begin(), targets.end(),
                                 [&](const Element* e) { return archive_.text(*e, "Operand").empty(); });
  return open == targets.end() ? 0 : static_cast<size_t>(open - targets.begin());
}

Wires TreeReader::box(const Element& tree) {
  const std::vector<const Element*> input_flags = itemsOf(archive_.member(tree, "InputFlags"));
  const std::vector<const Element*> targets = itemsOf(listOf(tree, "OutputItems", "OutputItems"));
  std::vector<Wires> inputs;
  for (const Element* item : itemsOf(archive_.member(tree, "InputItems"))) {
    // Only the first input may be contacts, the others are values.
    const bool reads = !inputs.empty() && !Archive::isNothing(*item) && archive_.typeOf(*item) == "BoxTreeOperand";
    inputs.push_back(reads ? operand(*item) : value(*item));
  }
  for (size_t k = 0; k < inputs.size() && k < input_flags.size(); ++k)
    inputs[k].flags ^= archive_.number(*input_flags[k], "Flags");

  const Element* snippet = archive_.member(tree, "STSnippet");
  const bool executes = snippet != nullptr && archive_.isTrue(tree, "ProvidesSTSnippet");
  NetworkElement out = element(executes ? ElementKind::Execute : ElementKind::Box, tree.loc);
  const uint64_t number = last_;
  if (!executes) readInstance(tree, out);
  out.has_pins = true;
  readInputs(tree, inputs, out);
  readOutputs(tree, targets.size(), out);
  if (executes) out.statements = archive_.excerptOf(*snippet);
  writer_.write(out);

  const std::vector<const Element*> results = itemsOf(listOf(tree, "OutputParam", "Names"));
  for (size_t k = 0; k < targets.size(); ++k)
    if (!Archive::isNothing(*targets[k]))
      assign(*targets[k], flagsOf(*targets[k]), {{{number, nameIn(results, k), targets[k]->loc}}, 0}, true);
  const Element* main = nameIn(results, mainOutput(targets));
  return {{{number, main, tree.loc}}, flagsOf(tree) & (kNegation | kRising | kFalling)};
}

// A box of an operator that is not in the trees.
Wires TreeReader::boxOf(std::string_view type, const std::vector<Wires>& inputs, Loc loc) {
  NetworkElement out = element(ElementKind::Box, loc);
  out.name = {loc, std::string(type)};
  out.has_pins = true;
  for (size_t k = 0; k < inputs.size(); ++k)
    out.pins.push_back({{loc, pinName(PinDirection::Input, k)},
                        PinDirection::Input,
                        modifiersOf(inputs[k].flags),
                        sourcesOf(inputs[k])});
  out.pins.push_back({{loc, pinName(PinDirection::Output, 0)}, PinDirection::Output, {}, {}});
  writer_.write(out);
  return {{{last_, nullptr, loc}}, 0};
}

// The value of a line before it branches is fixed here: elements after it may write variables that it reads.
Wires TreeReader::demux(const Element& tree) {
  const uint64_t branch = archive_.number(tree, "VarId");
  const Element* input = archive_.member(tree, "Input");
  if (input == nullptr) {
    Wires wires = branches_[branch];
    for (Wire& wire : wires.all) wire.loc = tree.loc;
    wires.flags = flagsOf(tree) & (kNegation | kRising | kFalling);
    return wires;
  }
  Wires wires = value(*input);
  const bool resolved = wires.all.empty() || archive_.typeOf(*input) == "BoxTreeDemux" ||
                        archive_.typeOf(*input) == "BoxTreeTerminator" ||
                        (archive_.typeOf(*input) == "BoxTreeBox" && !(ladder_ && isSeries(*input, true)));
  if (!resolved || wires.flags != 0) wires = boxOf(kMove, {wires}, tree.loc);
  return branches_[branch] = wires;
}

// Parallel lines: AND of their common input with the OR of all lines.
Wires TreeReader::parallel(const Element& tree) {
  const Element* input = archive_.member(tree, "Input");
  Wires before = input == nullptr ? Wires{} : value(*input);
  std::vector<Wires> lines;
  for (const Element* line : itemsOf(archive_.member(tree, "Trees"))) lines.push_back(value(*line));
  if (lines.empty()) return before;
  const Wires any = lines.size() == 1 ? lines[0] : boxOf("OR", lines, tree.loc);
  return input == nullptr ? any : boxOf("AND", {before, any}, tree.loc);
}

// ---- contacts

bool TreeReader::isContact(const Element& tree) const {
  const Element* held = archive_.member(tree, "Operand");
  return held != nullptr && sameIdentifier(archive_.text(*held, "Type"), "BOOL") &&
         !archive_.text(*held, "Operand").empty();
}

// Tells whether the tree can be written as contacts. Other elements are allowed only at the power rail.
bool TreeReader::isSeries(const Element& tree, bool at_rail) const {
  if (Archive::isNothing(tree)) return false;
  const std::string type = archive_.typeOf(tree);
  if (type == "BoxTreeOperand") return isContact(tree);
  if (type == "BoxTreeParallel") {
    const Element* input = archive_.member(tree, "Input");
    const std::vector<const Element*> lines = itemsOf(archive_.member(tree, "Trees"));
    if (input != nullptr && !isSeries(*input, at_rail)) return false;
    for (const Element* line : lines)
      if (!isSeries(*line, false)) return false;
    return !lines.empty() && flagsOf(tree) == 0;
  }
  if (type != "BoxTreeBox" || flagsOf(tree) != 0) return false;
  const std::string call = archive_.text(tree, "CallType");
  const std::vector<const Element*> items = itemsOf(archive_.member(tree, "InputItems"));
  if ((call != "And" && call != "Or") || items.size() < 2) return false;
  if (archive_.first(listOf(tree, "InputParam", "Names")) != nullptr) return false;
  for (const Element* target : itemsOf(listOf(tree, "OutputItems", "OutputItems")))
    if (!Archive::isNothing(*target) && !archive_.text(*target, "Operand").empty()) return false;
  for (size_t k = 0; k < items.size(); ++k) {
    const bool begins = at_rail && (call == "Or" || k == 0);
    const std::string inner = Archive::isNothing(*items[k]) ? std::string() : archive_.typeOf(*items[k]);
    const bool other = begins && flagsOf(*items[k]) == 0 &&
                       (inner == "BoxTreeBox" || inner == "BoxTreeDemux" || inner == "BoxTreeTerminator");
    if (!isSeries(*items[k], begins) && !other) return false;
  }
  return true;
}

Wires TreeReader::series(const Element& tree, Wires from) {
  if (!isSeries(tree, true)) return plain(value(tree), tree.loc);
  const std::string type = archive_.typeOf(tree);
  if (type == "BoxTreeOperand") {
    const Element& held = *archive_.member(tree, "Operand");
    const Element& text = *archive_.member(held, "Operand");
    NetworkElement contact = element(ElementKind::Contact, text.loc);
    contact.operand = archive_.excerptOf(text);
    contact.modifiers = modifiersOf(flagsOf(held) | flagsOf(tree));
    contact.input = sourcesOf(from);
    writer_.write(contact);
    return {{{last_, nullptr, text.loc}}, 0};
  }
  Wires joined;
  const auto join = [&](const Element& line) {
    const Wires one = series(line, from);
    joined.all.insert(joined.all.end(), one.all.begin(), one.all.end());
  };
  if (type == "BoxTreeParallel") {
    if (const Element* input = archive_.member(tree, "Input")) from = series(*input, std::move(from));
    for (const Element* line : itemsOf(archive_.member(tree, "Trees"))) join(*line);
    return joined;
  }
  const bool any = archive_.text(tree, "CallType") == "Or";
  for (const Element* item : itemsOf(archive_.member(tree, "InputItems"))) {
    if (any)
      join(*item);
    else
      from = series(*item, std::move(from));
  }
  return any ? joined : from;
}

}  // namespace

void writeNwl(const ArchivedBody& body) { TreeReader(body).run(body.object); }

}  // namespace rung::importer::twincat
