// SPDX-License-Identifier: Apache-2.0
#include "sema/declarations/mentions.h"

#include <algorithm>
#include <utility>

#include "sema/project.h"

namespace rung::sema {

namespace {

// None: they are not recorded.
std::vector<Mention>* mentionsOf(Context& context) {
  Project& project = context.project;
  if (!project.options.records_mentions || context.library) return nullptr;
  return context.body != nullptr ? &project.pou(context.pou).body.mentions : &project.mentions;
}

}  // namespace

void noteMention(Context& context, Entity entity, Loc loc, Access access) {
  if (std::vector<Mention>* const mentions = mentionsOf(context)) mentions->push_back({entity, loc, access});
}

void noteNameInPragma(Context& context, Entity entity, const Pragma& pragma) {
  const Sources& sources = context.symbols.sources;
  const FileId file = sources.fileOf(pragma.loc);
  const uint32_t begin = pragma.loc.offset - sources.begin(file).offset;
  const std::string_view text = sources.sourceText(file).substr(begin, pragma.end.offset - pragma.loc.offset);
  const std::string_view value = context.tree().string(pragma.value);
  const size_t at = text.rfind(value);
  if (value.empty() || at == std::string_view::npos) return;
  const size_t name = at + (value.rfind('.') + 1);  // the last of a path
  noteName(context, entity, Loc{pragma.loc.offset + static_cast<uint32_t>(name)});
}

void noteNameInstead(Context& context, Entity entity, Loc loc) {
  std::vector<Mention>* const mentions = mentionsOf(context);
  if (mentions == nullptr) return;
  for (auto at = mentions->rbegin(); at != mentions->rend() && at->loc == loc; ++at) at->loc = {};
  noteName(context, entity, loc);
}

void noteEffect(Context& context) {
  if (context.body != nullptr) context.symbols.pou(context.pou).body.affects_others = true;
}

BodiesWith::BodiesWith(const Project& project, std::vector<bool> wanted)
    : is_recorded_(project.options.records_mentions), wanted_(std::move(wanted)) {}

bool BodiesWith::mayMention(const Pou& pou) const {
  if (!is_recorded_ || pou.library || pou.cpp.is_body) return true;
  return std::any_of(pou.body.mentions.begin(), pou.body.mentions.end(), [&](const Mention& mention) {
    return mention.entity.entityKind() == EntityKind::Var && wanted_[mention.entity.index];
  });
}

}  // namespace rung::sema
