// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/code_lens.h"

#include "frontend/syntax/children.h"
#include "sema/types/arithmetic.h"
#include "tools/ide/meanings.h"

namespace rung::ide {
namespace {

class Lenses {
 public:
  Lenses(const View& view, FileId file)
      : view_(view), tree_(view.tree()), scope_(view.meanings().scope()), project_(scope_.project()), file_(file) {}

  std::vector<CodeLens> lenses() {
    for (const FileUnit* unit : view_.unitsOf(file_))
      for (const DeclId decl : tree_.list(unit->decls)) declaration(decl);
    return std::move(lenses_);
  }

 private:
  void add(Loc name, LensKind kind, std::string text = {}) {
    const FileRange at = view_.nameInFile(name);
    if (at.file == file_) lenses_.push_back({at, kind, std::move(text)});
  }

  void declaration(DeclId id) {
    const DeclKind kind = tree_.kind(id);
    const PouId pou = kind == DeclKind::Pou ? scope_.pouOf(id) : PouId{};
    if (pou) addPou(pou);
    if (kind == DeclKind::Type || kind == DeclKind::Property) add(tree_.loc(id), LensKind::References);
    forEachChild(tree_, id, [&](const auto& child) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, DeclId>) declaration(child);
    });
  }

  void addPou(PouId id) {
    const sema::Pou& pou = project_.pou(id);
    if (pou.object.accessor != sema::AccessorKind::None || !scope_.declaredAt(pou.loc)) return;
    if (pou.pragmas.test) return add(pou.loc, LensKind::Test, std::string(view_.names().string(pou.name)));
    add(pou.loc, LensKind::References);
    for (const sema::ProgramInstance& instance : project_.instances)
      if (instance.program == id)
        if (std::string task = taskText(view_, instance); !task.empty()) add(pou.loc, LensKind::Task, std::move(task));
  }

  const View& view_;
  const Tree& tree_;
  const Scope& scope_;
  const sema::Project& project_;
  FileId file_;
  std::vector<CodeLens> lenses_;
};

}  // namespace

std::vector<CodeLens> lensesOf(const View& view, FileId file) {
  return view.snapshot().project() == nullptr ? std::vector<CodeLens>() : Lenses(view, file).lenses();
}

std::string taskText(const View& view, const sema::ProgramInstance& instance) {
  const sema::Project& project = *view.snapshot().project();
  if (instance.task == 0 || instance.task > project.tasks.size()) return {};
  const sema::Task& task = project.tasks[instance.task - 1];
  std::string text = task.name ? "the task `" + std::string(view.names().string(task.name)) + "`" : "a task";
  if (task.kind == sema::TaskKind::Cyclic) text += ", every " + types::durationText(task.interval_ns);
  return text;
}

}  // namespace rung::ide
