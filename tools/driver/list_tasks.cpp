// SPDX-License-Identifier: Apache-2.0
// `rung list tasks`: the tasks of each resource with what starts them and what they run, and a chart of the order when
// all start together.
#include <algorithm>

#include "sema/project.h"
#include "tools/driver/commands.h"
#include "tools/driver/compile.h"
#include "tools/driver/list.h"
#include "tools/driver/task_chart.h"

namespace rung::driver {
namespace {

using sema::TaskKind;

const char* word(TaskKind kind) {
  switch (kind) {
    case TaskKind::Cyclic: return "cyclic";
    case TaskKind::Freewheeling: return "freewheeling";
    case TaskKind::Event: return "event";
    case TaskKind::Status: return "status";
    case TaskKind::External: return "external";
  }
  return "";
}

struct Program {
  std::string name, type;
};

// One task with what it runs, in order.
struct Row {
  const sema::Task* task;
  std::vector<Program> programs;
};

// Tasks that share a CPU.
struct Resource {
  std::string configuration, name;
  std::vector<Row> rows;  // by priority: the order in which they run when all start together
  TaskChart chart;

  std::string path() const { return configuration.empty() ? name : configuration + "." + name; }
};

class TaskList {
 public:
  explicit TaskList(const sema::Project& project) : project_(project) {
    for (uint32_t i = 0; i < project.tasks.size(); ++i) addTask(i);
    for (Resource& resource : resources_) {
      std::stable_sort(resource.rows.begin(), resource.rows.end(),
                       [](const Row& a, const Row& b) { return a.task->priority < b.task->priority; });
      resource.chart = chartOf(resource);
    }
  }

  std::string text() const {
    std::string out;
    for (const Resource& resource : resources_) {
      if (!out.empty()) out += '\n';
      if (!resource.path().empty()) out += resource.path() + "\n";
      appendTable(out, resource);
      appendChart(out, resource);
    }
    return out;
  }

  void addTo(List& list) const {
    for (const Resource& resource : resources_)
      for (size_t i = 0; i < resource.rows.size(); ++i) list.add("", json(resource, i));
  }

 private:
  std::string string(NameId name) const { return std::string(project_.names.string(name)); }

  void addTask(uint32_t index) {
    const sema::Task& task = project_.tasks[index];
    const std::string configuration = string(task.configuration), name = string(task.resource);
    auto at = std::find_if(resources_.begin(), resources_.end(), [&](const Resource& resource) {
      return resource.configuration == configuration && resource.name == name;
    });
    if (at == resources_.end()) at = resources_.insert(at, Resource{configuration, name, {}, {}});
    Row row{&task, {}};
    for (const sema::ProgramInstance& instance : project_.instances) {
      if (instance.task == index + 1 && instance.program)
        row.programs.push_back({string(instance.name), string(project_.pou(instance.program).name)});
    }
    for (const sema::BlockTask& block : project_.block_tasks) {
      if (block.task != index + 1) continue;
      const sema::Var& var = project_.var(block.block);
      row.programs.push_back({string(project_.instances[block.instance].name) + "." + string(var.name),
                              project_.types.toString(var.type)});
    }
    at->rows.push_back(std::move(row));
  }

  // Freewheeling and status tasks run as often as in virtual time: once in each period of the fastest cyclic task.
  TaskChart chartOf(const Resource& resource) const {
    int64_t fastest = 0;
    for (const Row& row : resource.rows)
      if (row.task->interval_ns > 0 && (fastest == 0 || row.task->interval_ns < fastest))
        fastest = row.task->interval_ns;
    if (fastest == 0) fastest = project_.options.default_interval_ns;
    std::vector<ChartTask> tasks;
    for (const Row& row : resource.rows) {
      const TaskKind kind = row.task->kind;
      const bool every_row = kind == TaskKind::Freewheeling || kind == TaskKind::Status;
      tasks.push_back({every_row ? fastest : row.task->interval_ns, row.task->duration_ns, row.task->priority});
    }
    return driver::chartOf(tasks);
  }

  static std::string intervalText(const sema::Task& task) {
    return task.interval_ns > 0 ? types::durationText(task.interval_ns) : "";
  }
  static std::string watchdogText(const sema::Task& task) {
    if (task.watchdog_ns == 0) return "";
    return types::durationText(task.watchdog_ns) +
           (task.sensitivity > 1 ? " x " + std::to_string(task.sensitivity) : "");
  }
  static std::string programsText(const Row& row) {
    std::string out;
    for (const Program& program : row.programs) {
      if (!out.empty()) out += ", ";
      out += program.name + (program.name == program.type ? "" : " : " + program.type);
    }
    return out;
  }
  static const std::string& triggerOf(const sema::Task& task) {
    return task.kind == TaskKind::External ? task.external_event : task.trigger;
  }

  // Columns that are empty in every row are left out.
  void appendTable(std::string& out, const Resource& resource) const {
    std::vector<std::vector<std::string>> table = {
        {"task", "kind", "interval", "trigger", "priority", "watchdog", "duration", "programs"}};
    for (const Row& row : resource.rows) {
      const sema::Task& task = *row.task;
      table.push_back({string(task.name), word(task.kind), intervalText(task), triggerOf(task),
                       std::to_string(task.priority), watchdogText(task),
                       task.duration_ns > 0 ? types::durationText(task.duration_ns) : "", programsText(row)});
    }
    std::vector<size_t> width(table[0].size(), 0);
    for (size_t column = 0; column < width.size(); ++column) {
      bool any = false;
      for (size_t i = 0; i < table.size(); ++i) {
        any = any || (i > 0 && !table[i][column].empty());
        width[column] = std::max(width[column], table[i][column].size());
      }
      if (!any) width[column] = 0;
    }
    for (const std::vector<std::string>& row : table) {
      std::string line;
      for (size_t column = 0; column < width.size(); ++column)
        if (width[column] > 0) line += "  " + row[column] + std::string(width[column] - row[column].size(), ' ');
      out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  }

  void appendChart(std::string& out, const Resource& resource) const {
    const TaskChart& chart = resource.chart;
    out += chart.complete ? "  order within " + types::durationText(chart.hyperperiod_ns) + " when all start together"
                          : "  order at the beginning when all start together";
    out += "; a column is " + types::durationText(chart.column_ns) + ", # runs, - waits\n";
    size_t width = 0;
    for (const Row& row : resource.rows) width = std::max(width, string(row.task->name).size());
    for (size_t i = 0; i < resource.rows.size(); ++i) {
      const std::string name = string(resource.rows[i].task->name);
      out += "  " + name + std::string(width - name.size() + 2, ' ') + chart.rows[i] + "\n";
    }
  }

  JsonRow json(const Resource& resource, size_t index) const {
    const Row& row = resource.rows[index];
    const sema::Task& task = *row.task;
    std::vector<JsonRow> programs;
    for (const Program& program : row.programs)
      programs.push_back(JsonRow().text("name", program.name).text("type", program.type));
    return JsonRow()
        .text("configuration", resource.configuration)
        .text("resource", resource.name)
        .text("name", string(task.name))
        .text("kind", word(task.kind))
        .number("interval_ns", static_cast<uint64_t>(task.interval_ns))
        .text("trigger", triggerOf(task))
        .number("priority", task.priority)
        .number("watchdog_ns", static_cast<uint64_t>(task.watchdog_ns))
        .number("sensitivity", task.sensitivity)
        .number("duration_ns", static_cast<uint64_t>(task.duration_ns))
        .rows("programs", programs)
        .number("column_ns", static_cast<uint64_t>(resource.chart.column_ns))
        .text("chart", resource.chart.rows[index]);
  }

  const sema::Project& project_;
  std::vector<Resource> resources_;
};

}  // namespace

int listTasks(const ProjectOptions& project, Sink& sink) {
  if (project.inputs.empty()) return usageError(sink, "`rung list tasks` needs files or folders to read");
  PhaseTimes times;
  Compilation compilation(project, times, sink);
  if (!compilation.check() || compilation.diagnostics.hasErrors()) return compilation.finish();
  const TaskList tasks(*compilation.project);
  List list(project.report);
  tasks.addTo(list);
  const int exit = compilation.finish();
  const bool is_json = project.report.format == DiagnosticFormat::Json;
  return exit == kSuccess ? printResult(sink, is_json ? list.text() : tasks.text()) : exit;
}

}  // namespace rung::driver
