// SPDX-License-Identifier: Apache-2.0
// The parts of a module; see bodies.h.
#include "frontend/import/nct/bodies.h"

#include <algorithm>
#include <array>
#include <string>

#include "frontend/import/diagnostics.h"
#include "frontend/source/names.h"

namespace rung::importer::nct {
namespace {

class BodyFinder {
 public:
  BodyFinder(const Module& module, Diagnostics& diagnostics)
      : elements_(module.elements), loc_(module.loc), diagnostics_(diagnostics) {}

  Bodies run() {
    findParts();
    checkLabels();
    return std::move(bodies_);
  }

 private:
  Report report(Diag diag, const Word& at, std::initializer_list<std::string_view> arguments) {
    return reportAt(diagnostics_, diag, at, arguments);
  }

  // The cyclic part, and the subroutines after END.
  //   fails   a rung between END and SBN                                         E1418
  //   fails   SBN before END                                                     E1418
  void findParts() {
    bodies_.list.clear();
    Body body{0, 0, -1, loc_};
    bool ended = false, in_body = true;
    const auto close = [&](uint32_t at) {
      if (!in_body) return;
      body.end = at;
      bodies_.list.push_back(body);
    };
    for (uint32_t k = 0; k < elements_.size(); ++k) {
      const Element& element = elements_[k];
      const bool marker = element.shape == Shape::Marker;
      if (marker && sameIdentifier(element.word.text, "END")) {
        if (ended) {
          report(diag::NctAfterEnd, element.word, {"a second END"});
          continue;
        }
        if (body.label >= 0) report(diag::NctAfterEnd, element.word, {"END after a subroutine"});
        close(k);
        ended = true;
        in_body = false;
      } else if (marker && sameIdentifier(element.word.text, "SBN")) {
        if (!ended) report(diag::NctAfterEnd, element.word, {"a subroutine before END"});
        close(k);
        ended = in_body = true;
        body = {k + 1, k + 1, labelOf(element), element.word.loc};
      } else if (!in_body && !(marker && sameIdentifier(element.word.text, "SEC"))) {
        report(diag::NctAfterEnd, element.word, {"a rung after END"});
        in_body = true;  // one report
        body = {k, k, kMostLabel + 1, element.word.loc};
      }
    }
    close(static_cast<uint32_t>(elements_.size()));
  }

  // Labels of JME and SBN, each once; targets in reach; no recursion. NCT manual 6.14.
  void checkLabels() {
    struct Target {
      const Element* element = nullptr;
      size_t body = 0;
      uint32_t at = 0;
      bool used = false;
    };
    std::array<Target, size_t{kMostLabel} + 1> targets{};
    for (size_t b = 0; b < bodies_.list.size(); ++b) {
      const auto take = [&](uint32_t k) {
        const Element& element = elements_[k];
        const int32_t label = labelOf(element);
        if (label < 0) return;
        Target& target = targets[static_cast<size_t>(label)];
        if (target.element != nullptr)
          report(diag::NctTwice, element.operands[0], {"label " + std::to_string(label)})
              .declaredHere(target.element->operands[0].loc);
        else
          target = {&element, b, k, false};
      };
      if (bodies_.list[b].label >= 0 && bodies_.list[b].begin > 0 &&
          isMarker(elements_[bodies_.list[b].begin - 1], "SBN"))
        take(bodies_.list[b].begin - 1);
      for (uint32_t k = bodies_.list[b].begin; k < bodies_.list[b].end; ++k)
        if (isMarker(elements_[k], "JME")) take(k);
    }
    std::vector<std::vector<size_t>> calls(bodies_.list.size());
    for (size_t b = 0; b < bodies_.list.size(); ++b) {
      for (uint32_t k = bodies_.list[b].begin; k < bodies_.list[b].end; ++k) {
        const Element& element = elements_[k];
        if (element.shape != Shape::Jump || element.operand_count == 0 || labelOf(element) < 0) continue;
        const bool calls_sub = sameIdentifier(element.word.text, "SBS");
        Target& target = targets[static_cast<size_t>(labelOf(element))];
        const bool is_sub = target.element != nullptr && sameIdentifier(target.element->word.text, "SBN");
        if (target.element == nullptr || is_sub != calls_sub || (!calls_sub && target.body != b)) {
          const std::string_view wanted = calls_sub ? "a SBN with this number in this module"
                                          : target.element != nullptr && !is_sub
                                              ? "a JME with this number in the same part: a jump leaves neither "
                                                "the cyclic part nor a subroutine"
                                              : "a JME with this number in this module";
          report(diag::NctNoLabel, element.operands[0], {element.word.text, element.operands[0].text, wanted});
          bodies_.broken_jumps.insert(&element);
          continue;
        }
        target.used = true;
        if (calls_sub) calls[b].push_back(target.body);
        if (!calls_sub && target.at < k) report(diag::NctBackward, element.operands[0], {element.operands[0].text});
      }
    }
    for (const Target& target : targets)
      if (target.element != nullptr && !target.used)
        report(diag::NctUnusedLabel, target.element->operands[0],
               {target.element->word.text, target.element->operands[0].text});
    checkRecursion(calls);
  }

  void checkRecursion(const std::vector<std::vector<size_t>>& calls) {
    std::vector<uint8_t> state(calls.size());
    recursive_ = false;
    for (size_t b = 0; b < calls.size() && !recursive_; ++b) follow(calls, b, state);
  }

  void follow(const std::vector<std::vector<size_t>>& calls, size_t body, std::vector<uint8_t>& state) {
    if (state[body] == 2 || recursive_) return;
    if (state[body] == 1) {
      recursive_ = true;
      diagnostics_.report(diag::NctRecursion, bodies_.list[body].loc, {std::to_string(bodies_.list[body].label)});
      return;
    }
    state[body] = 1;
    for (const size_t called : calls[body]) follow(calls, called, state);
    state[body] = 2;
  }

  std::span<const Element> elements_;
  Loc loc_;
  Diagnostics& diagnostics_;
  Bodies bodies_;
  bool recursive_ = false;
};

}  // namespace

int32_t labelOf(const Element& element) {
  if (element.operand_count == 0) return -1;
  const std::string_view text = element.operands[0].text;
  const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits && text.size() <= 2 ? std::stoi(std::string(text)) : -1;
}

bool isMarker(const Element& element, std::string_view word) {
  return element.shape == Shape::Marker && sameIdentifier(element.word.text, word);
}

Bodies findBodies(const Module& module, Diagnostics& diagnostics) { return BodyFinder(module, diagnostics).run(); }

}  // namespace rung::importer::nct
