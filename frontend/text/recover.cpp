#include "frontend/text/recover.h"

namespace rung::text {
// thin version
void balanceBlocks(TokenStream&, const Names&, const Sources&, FileId, Standard, Diagnostics&) {}
Tok nearestKeyword(std::string_view written, std::span<const Tok> candidates) {
  std::vector<std::string_view> words;
  for (Tok t : candidates) words.push_back(spelling(t));
  const std::string_view found = nearest(written, words);
  for (Tok t : candidates)
    if (found == spelling(t)) return t;
  return Tok::End;
}
}  // namespace rung::text
