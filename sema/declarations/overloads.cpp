// Functions and methods of one name, told apart by the types of their parameters. Edition 3 alone: ed. 2 and codesys
// keep such names for the library. In: declarations. Out: lists of overloads, Pou::overloads and next_overload.
// Which of them a call means is bodies/overloads.cpp.
#include <algorithm>

#include "sema/declarations/declarations.h"
#include "sema/declarations/overloads.h"

namespace rung::sema {

bool sameParameters(const Project& project, PouId a, PouId b) {
  const auto isParameter = [&](VarId id) {
    const SectionKind section = project.var(id).section;
    return section == SectionKind::Input || section == SectionKind::Output || section == SectionKind::InOut;
  };
  std::vector<VarId> left, right;
  for (const VarId id : project.pou(a).vars)
    if (isParameter(id)) left.push_back(id);
  for (const VarId id : project.pou(b).vars)
    if (isParameter(id)) right.push_back(id);
  if (left.size() != right.size()) return false;
  for (size_t i = 0; i < left.size(); ++i) {
    const Var &one = project.var(left[i]), &other = project.var(right[i]);
    const TypeId type = project.types.resolve(one.type);
    const bool texts = types::TypeTable::isText(project.types.info(type).kind) &&
                       project.types.info(type).kind == project.types.kind(other.type);
    if (one.section != other.section || (!texts && type != project.types.resolve(other.type))) return false;
  }
  return true;
}

PouId methodLike(const Project& project, PouId object, PouId like_id) {
  const Pou& like = project.pou(like_id);
  for (const PouId member : project.pou(object).members) {
    const Pou& pou = project.pou(member);
    if (pou.kind != PouKind::Method || pou.accessor != like.accessor || !project.names.same(pou.name, like.name))
      continue;
    if ((!pou.overloads && !like.overloads) || sameParameters(project, member, like_id)) return member;
  }
  return {};
}

bool addOverload(Context& context, Entity first, PouId added) {
  Project& project = context.project;
  if (project.options.standard != text::Standard::Iec3 || first.what() != EntityKind::Pou) return false;
  const PouId head{first.index};
  Pou& pou = project.pou(added);
  const PouKind kind = project.pou(head).kind;
  if (kind != pou.kind || (kind != PouKind::Function && kind != PouKind::Method) || project.pou(head).library)
    return false;
  PouId last = head;
  uint32_t count = 2;
  for (; project.pou(last).next_overload; last = project.pou(last).next_overload) ++count;
  project.pou(last).next_overload = added;
  project.pou(head).overloads = pou.overloads = head;
  if (kind == PouKind::Function) {  // a method has a name of its own already
    const std::string stem = spelled(context, pou.unique_name) + "__";
    do {
      pou.unique_name = context.names().intern(stem + std::to_string(count++));
    } while (!context.scopes.member_names.insert(keyOf(context, pou.unique_name), entity(added)) ||
             context.scopes.pous_and_types.find(keyOf(context, pou.unique_name)));
  }
  return true;
}

void markOverloads(Context& context) {
  Project& project = context.project;
  if (project.options.standard != text::Standard::Iec3) return;
  const auto isOverloadedIn = [&](PouId object, const Pou& like) {
    for (const PouId member : project.pou(object).members)
      if (project.pou(member).overloads && project.names.same(project.pou(member).name, like.name)) return true;
    return false;
  };
  for (uint32_t i = 1; i < project.pous.size(); ++i) {
    Pou& pou = project.pous[i];
    if (pou.kind != PouKind::Method || pou.overloads || pou.accessor != Pou::Accessor::None) continue;
    for (PouId at = project.pou(pou.owner).base; at && !pou.overloads; at = project.pou(at).base)
      if (isOverloadedIn(at, pou)) pou.overloads = PouId{i};
  }
}

// Forbids overloads that no call could tell apart. IEC 61131-3 ed. 3, 6.1.2.
//   passes  FUNCTION f VAR_INPUT x : INT; …     FUNCTION f VAR_INPUT x : REAL; …
//   fails   FUNCTION f VAR_INPUT x : INT; …     FUNCTION f VAR_INPUT y : INT; …           E0301
void checkOverloads(Context& context, PouId head) {
  for (PouId id = head; id; id = context.project.pou(id).next_overload) {
    resolvePou(context, id);
    for (PouId earlier = head; earlier != id; earlier = context.project.pou(earlier).next_overload) {
      if (!sameParameters(context.project, earlier, id)) continue;
      reportTwice(context, context.project.pou(id).name, context.project.pou(id).loc, context.project.pou(earlier).loc);
      break;
    }
  }
}

}  // namespace rung::sema
