// SPDX-License-Identifier: Apache-2.0
// Sequential Function Chart. Private to frontend/parse; see cursor.h. sfc.cpp, sfc_macros.cpp.
#pragma once

#include "frontend/parse/network.h"

namespace rung::text {

class ChartParser : public NetworkParser {
 public:
  using NetworkParser::NetworkParser;

 protected:
  bool atSfc() const;
  bool chartInSt();
  void parseMembersOf(const PouDecl& d, std::vector<DeclId>& members, std::vector<SfcTransition>& conditions);
  void parseSfc(PouDecl& d, std::vector<DeclId>& members, std::vector<SfcTransition>& transitions);

  // ---- later subjects
  virtual void parseMember(std::vector<DeclId>& out) = 0;
  virtual void parseBody(PouDecl& d) = 0;

 private:
  struct SfcMacro {
    Ident name, entry, exit;
    uint32_t first_step;  // index of the first step inside; the steps end at `end_step`
    uint32_t end_step;
    uint32_t errors;  // number of errors before it
    const Token* open;
  };
  bool atMacroEnd() const { return is(t_, "END_MACRO_STEP"); }
  bool atCondition() const;
  bool atOwnAction() const;
  void openMacro(std::vector<SfcMacro>& macros, std::vector<uint32_t>& open, size_t steps);
  void skipMacro();
  void closeMacro(std::vector<SfcMacro>& macros, std::vector<uint32_t>& open, std::span<const SfcStep> steps);
  void inlineMacros(std::span<const SfcMacro> macros, std::span<const SfcStep> steps,
                    std::vector<SfcTransition>& transitions);
  void parseStep(std::vector<SfcStep>& out);
  void parseStepTimes(SfcStep& step);
  bool parseActionName(Ident& out);
  bool parseAssociation(std::vector<SfcAssociation>& out);
  bool parseTransition(std::vector<SfcTransition>& out, std::vector<DeclId>& members);
  bool parseSteps(Slice<Ident>& out);
  SfcExpr parseSfcExpr();
  void parseCondition(SfcTransition& t, std::vector<DeclId>& members);
  bool parseConditionValue(PouDecl& d, SfcTransition& t);
  bool parseConditionBody(PouDecl& d, const SfcTransition& t, const Token* first);
  void storeCondition(PouDecl& d, const SfcTransition& t);
  void syncChart(Tok end);
};

}  // namespace rung::text
