// SPDX-License-Identifier: Apache-2.0
// Configurations, resources and tasks as TC6 elements; see exporter.h. Text is added where the elements cannot express
// the declaration: tasks without programs, arguments of programs, programs in another order than their tasks.
#include <algorithm>
#include <vector>

#include "frontend/export/exporter.h"

namespace rung::exporter {
namespace {

class ConfigurationExport {
 public:
  explicit ConfigurationExport(Export& to) : to_(to) {}

  void run(DeclId id);

 private:
  void resource(std::string_view name, Slice<DeclId> members);
  struct TaskSettings;
  TaskSettings settingsOf(const TaskDecl& task);
  void task(const TaskDecl& task, std::span<const DeclId> members);
  void kindOfTask(const TaskSettings& settings);
  void program(const ProgramInstanceDecl& program);
  void globals(Slice<DeclId> members);
  void paths(Slice<DeclId> members, SectionKind kind);
  std::string pathText(const VarDecl& var) const;
  void time(std::string_view attribute, ExprId value);
  bool isTime(ExprId value) const;

  Export& to_;
  std::vector<DeclId> programs_;  // in the order of their elements
};

bool ConfigurationExport::isTime(ExprId value) const {
  return value && to_.tree.kind(value) == ExprKind::Literal &&
         to_.tree.as<LiteralExpr>(value).literal() == LiteralKind::Duration &&
         !to_.tree.as<LiteralExpr>(value).form.is_negative;
}

// A literal as PT0.05S; any other expression as written.
void ConfigurationExport::time(std::string_view attribute, ExprId value) {
  if (!isTime(value)) {
    to_.is_lossless = false;
    to_.xml.attribute(attribute, to_.printed(value));
    return;
  }
  const uint64_t ns = to_.tree.as<LiteralExpr>(value).value();
  std::string text = "PT" + std::to_string(ns / 1'000'000'000);
  if (std::string digits = std::to_string(1'000'000'000 + ns % 1'000'000'000); digits.find_first_not_of('0', 1) < 10) {
    digits.erase(digits.find_last_not_of('0') + 1);
    text += "." + digits.substr(1);
  }
  to_.xml.attribute(attribute, text + "S");
}

// What the settings of a task say, and what TC6 has no word for.
struct ConfigurationExport::TaskSettings {
  ExprId interval, priority, single, kind, trigger, watchdog, sensitivity;
  bool is_freewheeling = false, is_status = false, is_external = false;
  bool isPlain() const { return !kind && !trigger; }
};

ConfigurationExport::TaskSettings ConfigurationExport::settingsOf(const TaskDecl& task) {
  TaskSettings found;
  for (const Argument& setting : to_.tree.list(task.settings)) {
    const std::string_view name = to_.string(setting.pin.name);
    ExprId* const slot = sameIdentifier(name, "INTERVAL")      ? &found.interval
                         : sameIdentifier(name, "PRIORITY")    ? &found.priority
                         : sameIdentifier(name, "SINGLE")      ? &found.single
                         : sameIdentifier(name, "KIND")        ? &found.kind
                         : sameIdentifier(name, "TRIGGER")     ? &found.trigger
                         : sameIdentifier(name, "WATCHDOG")    ? &found.watchdog
                         : sameIdentifier(name, "SENSITIVITY") ? &found.sensitivity
                                                               : nullptr;
    if (slot == nullptr || !setting.value)
      to_.is_lossless = false;
    else
      *slot = setting.value;
  }
  const std::string word = found.kind ? to_.printed(found.kind) : std::string();
  found.is_freewheeling = sameIdentifier(word, "FREEWHEELING");
  found.is_status = sameIdentifier(word, "STATUS");
  found.is_external = sameIdentifier(word, "EXTERNAL");
  const bool has_kind = found.is_freewheeling || found.is_status || found.is_external;
  if (found.isPlain() ? found.interval == ExprId{} && found.single == ExprId{} : !has_kind) to_.is_lossless = false;
  if (found.interval && (found.single || found.kind)) to_.is_lossless = false;
  if (found.sensitivity && !found.watchdog) to_.is_lossless = false;
  return found;
}

// <task name="Fast" interval="PT0.01S" priority="1">, its programs, and the kind of the task as 3S names it.
void ConfigurationExport::task(const TaskDecl& task, std::span<const DeclId> members) {
  const TaskSettings settings = settingsOf(task);
  to_.xml.open("task").attribute("name", to_.string(task.name));
  if (settings.single) to_.xml.attribute("single", to_.printed(settings.single));
  if (settings.interval) time("interval", settings.interval);
  // The schema requires a priority; 1 is the default of a task.
  const bool is_number = settings.priority && to_.tree.kind(settings.priority) == ExprKind::Literal;
  if (settings.priority && !is_number) to_.is_lossless = false;
  to_.xml.attribute("priority", is_number ? to_.printed(settings.priority) : "1");
  bool any = false;
  for (const DeclId id : members) {
    if (to_.tree.kind(id) != DeclKind::ProgramInstance) continue;
    const auto& program = to_.tree.as<ProgramInstanceDecl>(id);
    if (!program.task.name || !to_.names.same(program.task.name, task.name)) continue;
    this->program(program);
    programs_.push_back(id);
    any = true;
  }
  if (!any) to_.is_lossless = false;
  if (!settings.isPlain() || settings.watchdog) kindOfTask(settings);
  to_.xml.close();
}

void ConfigurationExport::kindOfTask(const TaskSettings& settings) {
  AddData data(to_);
  data.open("tasksettings");
  to_.xml.open("TaskSettings");
  to_.xml.attribute("KindOfTask", settings.is_freewheeling ? "Freewheeling"
                                  : settings.is_status     ? "Status"
                                  : settings.is_external   ? "ExternalEvent"
                                  : settings.single        ? "Event"
                                                           : "Cyclic");
  if (settings.trigger) {
    std::string text = to_.printed(settings.trigger);
    const bool is_quoted = settings.is_external && text.size() > 1 && text[0] == '\'';
    if (is_quoted) text = text.substr(1, text.size() - 2);
    to_.xml.attribute(settings.is_external ? "ExternalEvent" : "Event", text);
  }
  if (settings.watchdog) {
    to_.xml.open("Watchdog").attribute("Enabled", "true");
    time("Time", settings.watchdog);
    if (settings.sensitivity) to_.xml.attribute("Sensitivity", to_.printed(settings.sensitivity));
    to_.xml.close();
  }
  to_.xml.close();
  data.close();
}

void ConfigurationExport::program(const ProgramInstanceDecl& program) {
  std::string type;
  for (const Ident& part : to_.tree.list(program.type))
    type += (type.empty() ? "" : ".") + std::string(to_.string(part.name));
  if (!program.arguments.empty() || !program.block_tasks.empty() || program.qualifiers != Qualifiers{})
    to_.is_lossless = false;
  to_.xml.open("pouInstance").attribute("name", to_.string(program.name)).attribute("typeName", type).close();
}

void ConfigurationExport::globals(Slice<DeclId> members) {
  for (const DeclId id : to_.tree.list(members)) {
    if (to_.tree.kind(id) != DeclKind::Section) continue;
    const auto& section = to_.tree.as<SectionDecl>(id);
    if (section.section != SectionKind::Global) continue;
    exportSection(to_, id, "globalVars");
    {
      AddData data(to_);
      exportAttributes(to_, section.h.pragmas, data);
    }
    to_.xml.close();
  }
}

// tasks, globals, programs: the order of the schema.
void ConfigurationExport::resource(std::string_view name, Slice<DeclId> members) {
  const std::span<const DeclId> list = to_.tree.list(members);
  to_.xml.open("resource").attribute("name", name);
  std::vector<DeclId> declared;
  for (const DeclId id : list) {
    if (to_.tree.kind(id) == DeclKind::Task) task(to_.tree.as<TaskDecl>(id), list);
    if (to_.tree.kind(id) == DeclKind::ProgramInstance) declared.push_back(id);
    if (to_.tree.kind(id) == DeclKind::Section && to_.tree.as<SectionDecl>(id).section != SectionKind::Global)
      to_.is_lossless = false;
  }
  globals(members);
  for (const DeclId id : declared) {
    const auto& program = to_.tree.as<ProgramInstanceDecl>(id);
    if (program.task.name) continue;
    this->program(program);
    programs_.push_back(id);
  }
  if (programs_ != declared) to_.is_lossless = false;
  programs_.clear();
  to_.xml.close();
}

// The path of VAR_ACCESS and VAR_CONFIG as written: `R1.Main.speed`.
std::string ConfigurationExport::pathText(const VarDecl& var) const {
  const SourceText& source = *to_.source;
  size_t begin = source.at(var.h.loc);
  const size_t end = source.endOfDeclaration(begin);
  const std::string_view text = source.cut(begin, end);
  return std::string(text.substr(0, std::min(text.find_first_of(" \t\r\n:"), text.size())));
}

// <accessVars> and <configVars>
void ConfigurationExport::paths(Slice<DeclId> members, SectionKind kind) {
  bool any = false;
  const bool access = kind == SectionKind::Access;
  for (const DeclId id : to_.tree.list(members)) {
    if (to_.tree.kind(id) != DeclKind::Section) continue;
    const auto& section = to_.tree.as<SectionDecl>(id);
    if (section.section != kind) continue;
    if (!any) to_.xml.open(access ? "accessVars" : "configVars");
    any = true;
    if (!section.h.pragmas.empty() || section.qualifiers != Qualifiers{}) to_.is_lossless = false;
    for (const DeclId v : to_.tree.list(section.vars)) {
      const auto& var = to_.tree.as<VarDecl>(v);
      if (var.names.empty()) {
        to_.is_lossless = false;
        continue;
      }
      to_.xml.open(access ? "accessVariable" : "configVariable");
      if (access) {
        if (var.located) to_.is_lossless = false;
        to_.xml.attribute("alias", to_.string(to_.tree.list(var.names)[0].name));
        to_.xml.attribute("instancePathAndName", var.init ? to_.printed(var.init) : "?");
        to_.xml.attribute("direction", var.read_only ? "readOnly" : "readWrite");
      } else {
        to_.xml.attribute("instancePathAndName", pathText(var));
        if (var.located) {
          const std::string_view rest = to_.source->cut(to_.source->at(var.address_loc), std::string_view::npos);
          to_.xml.attribute("address", rest.substr(0, rest.find_first_of(" \t\r\n:")));
        }
      }
      to_.xml.open("type");
      exportType(to_, var.type);
      to_.xml.close();
      if (!access && var.init) exportInitialValue(to_, var.init, var.type);
      to_.xml.close();
    }
  }
  if (any) to_.xml.close();
}

void ConfigurationExport::run(DeclId id) {
  const auto& configuration = to_.tree.as<ConfigurationDecl>(id);
  to_.is_lossless = true;
  to_.xml.open("configuration").attribute("name", to_.string(configuration.name));
  bool own = false;  // tasks and programs without a resource
  for (const DeclId member : to_.tree.list(configuration.members)) {
    const DeclKind kind = to_.tree.kind(member);
    if (kind == DeclKind::Resource) {
      const auto& resource = to_.tree.as<ResourceDecl>(member);
      this->resource(to_.string(resource.name), resource.members);
    }
    own = own || kind == DeclKind::Task || kind == DeclKind::ProgramInstance;
  }
  if (own) {
    to_.is_lossless = false;
    const std::span<const DeclId> members = to_.tree.list(configuration.members);
    to_.xml.open("resource").attribute("name", "Resource");
    for (const DeclId member : members)
      if (to_.tree.kind(member) == DeclKind::Task) task(to_.tree.as<TaskDecl>(member), members);
    for (const DeclId member : members) {
      if (to_.tree.kind(member) != DeclKind::ProgramInstance) continue;
      const auto& program = to_.tree.as<ProgramInstanceDecl>(member);
      if (!program.task.name) this->program(program);
    }
    to_.xml.close();
  }
  globals(configuration.members);
  paths(configuration.members, SectionKind::Access);
  paths(configuration.members, SectionKind::Config);
  const SourceText& source = *to_.source;
  const size_t name = source.at(configuration.h.loc), begin = source.wordBefore(name, "CONFIGURATION");
  if (!to_.is_lossless) {
    AddData data(to_);
    exportPlainText(to_, source.cut(begin, source.endOfWord(name, "END_CONFIGURATION")), data);
  }
  to_.documentation(source.comments(source.commentsBefore(begin), begin));
  to_.xml.close();
}

}  // namespace

void exportConfiguration(Export& to, DeclId configuration) { ConfigurationExport(to).run(configuration); }

}  // namespace rung::exporter
