// SPDX-License-Identifier: Apache-2.0
// `rung new`: a small project of a template, whole or not at all. The templates are the folders of tools/templates; the
// table below says what to try with each.
#include <unistd.h>

#include <filesystem>
#include <vector>

#include "templates.h"
#include "tools/driver/commands.h"
#include "tools/driver/new_project.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

struct Template {
  std::string_view name, summary;
  std::string_view run;  // arguments of `rung run` that show something
  bool draws;            // it has something for `rung graph`
};
constexpr Template kTemplates[] = {
    {"st", "a level control in ST, with an interlock as a ladder",
     "--cycles 60 --watch Main.level,Main.interlock.motor --plot plot.svg", true},
    {"ladder", "a motor starter as a ladder diagram",
     "--cycles 60 --inputs shift.csv --watch MotorStarter.motor,MotorStarter.star,MotorStarter.delta --plot plot.svg",
     true},
    {"sfc", "a filling station as a sequential function chart",
     "--cycles 50 --inputs shift.csv --watch Station.belt,Station.valve,Station.bottles --plot plot.svg", true},
    {"motion", "a servo axis that moves to and fro, with a simulated drive",
     "--for T#5s --watch Carriage.fActPosition,Carriage.fActVelocity --plot plot.svg", false},
    {"modbus", "a Modbus TCP master, with a simulated device in its test",
     "--realtime --for T#1s --watch Main.level,Main.alarm --plot plot.svg", false},
    {"nct", "the ladder of an NCT machine-tool control",
     "--cycles 160 --inputs panel.csv --watch BUTTON,PUMP,PRESSURE,LAMP --plot plot.svg", true},
    {"cpp", "a filter in C++ and a program in ST", "--cycles 100 --watch Main.sensor,Main.filtered --plot plot.svg",
     false},
};

const Template* findTemplate(std::string_view name) {
  for (const Template& row : kTemplates)
    if (row.name == name) return &row;
  return nullptr;
}

// The files of a template. Its rung.project is that of a project `plant`.
std::vector<TextFile> filesOf(const Template& row, const std::string& folder) {
  const std::string prefix = std::string(row.name) + "/";
  std::vector<TextFile> files;
  for (size_t i = 0; i < embedded::templates_count; ++i) {
    const embedded::File& file = embedded::templates[i];
    if (!file.name.starts_with(prefix)) continue;
    std::string path(file.name.substr(prefix.size())), text(file.text);
    if (path == "rung.project") {
      constexpr std::string_view kTitle = "# plant:", kName = "name = plant\n";
      text.replace(text.find(kTitle), kTitle.size(), "# " + folder + ":");
      text.replace(text.find(kName), kName.size(), "name = " + moduleNameOf(folder) + "\n");
    }
    files.push_back({std::move(path), std::move(text)});
  }
  return files;
}

// Makes the folder beside its place and then moves it there: another process, or one that was interrupted, never sees
// a part of it.
int makeFolder(const fs::path& target, const std::vector<TextFile>& files, Sink& sink) {
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const fs::path made = parent / (".rung_new_" + std::to_string(getpid()));
  std::error_code error;
  if (!fs::create_directory(made, error))
    return usageError(sink, "cannot create the folder " + backquoted(target.string()) +
                                (error ? ": " + error.message() : "; remove " + backquoted(made.string())));
  int exit = writeFiles(made.string(), files, sink);
  if (exit == kSuccess) {
    fs::rename(made, target, error);
    if (error)
      exit = usageError(sink, "cannot create the folder " + backquoted(target.string()) + ": " + error.message());
  }
  if (exit != kSuccess) fs::remove_all(made, error);
  return exit;
}

}  // namespace

std::string moduleNameOf(std::string_view folder) {
  std::string name;
  for (const char c : folder) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!is_plain && (name.empty() || name.back() == '_')) continue;
    name += is_plain ? c : '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name.insert(0, "plc");
  return name.substr(0, 200);
}

std::string shellWord(const std::string& word) {
  const auto isPlain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./+,:=@%").find(c) != std::string_view::npos;
  };
  bool plain = !word.empty();
  for (const char c : word) plain = plain && isPlain(c);
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string templateHelp() {
  std::string out;
  for (const Template& row : kTemplates)
    out += "  " + std::string(row.name) + std::string(8 - row.name.size(), ' ') + std::string(row.summary) + "\n";
  return out;
}

int runNew(const std::string& folder, const std::string& project_template, Sink& sink) {
  const Template* row = findTemplate(project_template);
  if (row == nullptr) {
    std::vector<std::string_view> names;
    for (const Template& each : kTemplates) names.push_back(each.name);
    return usageError(sink,
                      withSuggestion("no template is called " + backquoted(project_template), project_template, names) +
                          " (`rung new --help` lists all)");
  }
  fs::path target = fs::path(folder).lexically_normal();
  if (!target.has_filename()) target = target.parent_path();
  const std::string name = target.filename().string();
  if (name.empty() || name == "." || name == "..")
    return usageError(sink, backquoted(folder) + " is not a name for a new folder");
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      return usageError(sink, "the name of a new project has no control characters");
  std::error_code error;
  if (fs::symlink_status(target, error).type() != fs::file_type::not_found)
    return usageError(
        sink, backquoted(target.string()) + " exists; " +
                  (fs::is_directory(target, error) ? "for the sources in it: `rung init " + target.string() + "`"
                                                   : "choose another name"));
  const std::vector<TextFile> files = filesOf(*row, name);
  if (const int exit = makeFolder(target, files, sink); exit != kSuccess) return exit;

  std::string out = "created " + target.string() + ": " + std::string(row->summary) + "\n";
  for (const TextFile& file : files) out += "  " + (target / file.path).string() + "\n";
  out += "\ntry:\n  cd " + shellWord(target.string()) + "\n  rung test\n  rung run " + std::string(row->run) + "\n";
  if (row->draws) out += "  rung graph -o pictures\n";
  return printResult(sink, out);
}

}  // namespace rung::driver
