// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/navigation.h"

#include "tools/ide/hover.h"
#include "tools/ide/signature_help.h"
#include "tools/lsp/requests.h"

namespace rung::lsp {
namespace {

Answer navigation(Session& session, const Json& params, ide::NavigationKind kind) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const auto found = ide::navigate(*place->view, place->file, place->byte, kind);
  if (!found) return Json();
  Translator translator(*place->view, session.encoding);
  Json::Array list;
  for (const ide::Destination& destination : found->destinations) {
    Json location = translator.location(destination.name);
    if (location.isNull()) continue;
    if (session.client.location_links)
      location = {{"originSelectionRange", translator.range(found->origin)},
                  {"targetUri", location["uri"]},
                  {"targetRange", translator.range(destination.range)},
                  {"targetSelectionRange", location["range"]}};
    list.push_back(std::move(location));
  }
  return Json(std::move(list));
}

// The text of a signature on one line, and where each pin is in it.
struct Label {
  std::string text;
  std::vector<std::pair<uint32_t, uint32_t>> pins;  // in units of the encoding
};
Label labelOf(const ide::PouSignature& signature, Encoding encoding) {
  Label label{signature.name + "(", {}};
  for (const ide::SignaturePin& pin : signature.pins) {
    if (!label.pins.empty()) label.text += ", ";
    const uint32_t begin = unitsOf(label.text, encoding);
    label.text += pin.name + (pin.section == SectionKind::Output ? " => " : " : ") + pin.type;
    if (!pin.initial.empty()) label.text += " := " + pin.initial;
    label.pins.emplace_back(begin, unitsOf(label.text, encoding));
  }
  label.text += ")";
  if (!signature.result.empty()) label.text += " : " + signature.result;
  return label;
}

Json markdown(const std::string& text) { return {{"kind", "markdown"}, {"value", text}}; }

}  // namespace

Answer declaration(Session& session, const Json& params) {
  return navigation(session, params, ide::NavigationKind::Declaration);
}
Answer definition(Session& session, const Json& params) {
  return navigation(session, params, ide::NavigationKind::Definition);
}
Answer typeDefinition(Session& session, const Json& params) {
  return navigation(session, params, ide::NavigationKind::Type);
}
Answer implementation(Session& session, const Json& params) {
  return navigation(session, params, ide::NavigationKind::Implementation);
}

Answer hover(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const auto found = ide::hoverAt(*place->view, session.projects.libraries(), place->file, place->byte);
  if (!found) return Json();
  Translator translator(*place->view, session.encoding);
  return Json{{"contents", markdown(found->markdown)}, {"range", translator.range(found->range)}};
}

Answer signatureHelp(Session& session, const Json& params) {
  const std::optional<Place> place = placeOf(session, params);
  if (!place) return noDocument();
  if (place->view == nullptr) return Json();
  const auto found = ide::signatureHelpAt(*place->view, session.projects.libraries(), place->file, place->byte);
  if (!found) return Json();
  const Label label = labelOf(found->signature, Encoding::Utf16);  // offsets in labels always count UTF-16 units
  Json::Array pins;
  for (size_t i = 0; i < label.pins.size(); ++i) {
    Json pin{{"label", Json::Array{label.pins[i].first, label.pins[i].second}}};
    if (const std::string& text = found->signature.pins[i].documentation; !text.empty())
      pin.set("documentation", markdown(text));
    pins.push_back(std::move(pin));
  }
  Json signature{{"label", label.text}, {"parameters", std::move(pins)}};
  if (!found->signature.documentation.empty()) signature.set("documentation", markdown(found->signature.documentation));
  Json answer{{"signatures", Json::Array{std::move(signature)}}, {"activeSignature", 0}};
  // Beyond the pins none is marked.
  answer.set("activeParameter", found->active_pin.value_or(static_cast<uint32_t>(label.pins.size())));
  return answer;
}

}  // namespace rung::lsp
