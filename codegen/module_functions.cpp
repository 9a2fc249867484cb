// SPDX-License-Identifier: Apache-2.0
// The functions of a module: see module_functions.h.
#include "codegen/module_functions.h"

#include "codegen/cxx/print.h"
#include "codegen/names.h"
#include "codegen/signature.h"
#include "codegen/types.h"

namespace rung::codegen {

using cxx::Ex;
using cxx::Statements;
using types::TypeKind;
using types::TypeTable;

// ---- what the functions do

Ex ModuleFunctions::block(uint32_t number) {
  return tree_.element(tree_.arrow(tree_.fixed("ctx"), "blocks"), tree_.number(number));
}

Ex ModuleFunctions::asRecord(TypeId record, Ex instance) {
  return tree_.prefix("*", tree_.call("static_cast<" + recordName(types_, record) + "*>", {instance}));
}

Ex ModuleFunctions::clearing(uint32_t number) {
  return tree_.call("memset", {block(number), tree_.number(0), tree_.number(is_.blocks[number].size)});
}

Ex ModuleFunctions::callWith(ir::BodyId id, Ex instance) {
  declare(id);
  std::string name;
  appendFunctionName(name, module_, module_.body(id));
  return tree_.call(name, {instance, tree_.fixed("ctx")});
}

Ex ModuleFunctions::callOn(ir::BodyId id, TypeId record, Ex instance) {
  return callWith(id, asRecord(record, instance));
}

Ex ModuleFunctions::callOf(ir::BodyId id) {
  declare(id);
  std::string name;
  appendFunctionName(name, module_, module_.body(id));
  return tree_.call(name, {tree_.fixed("ctx")});
}

Ex ModuleFunctions::runOf(const ir::ProgramInstance& program, uint32_t number) {
  return program.run ? callOf(program.run) : callOn(program.body, program.record, block(number));
}

void ModuleFunctions::declare(ir::BodyId id) {
  if (!declared_.insert(id.index).second) return;
  const ir::Body& body = module_.body(id);
  if (body.self && named_records_.insert(types_.resolve(body.self).index).second)
    records_.add(tree_.variable(recordType(types_, body.self), {}));
  prototypes_.add(signatureOf(tree_, module_, body));
}

void ModuleFunctions::add(Statements& to, Ex e) {
  cxx::Stmt* const made = tree_.stmt(cxx::StmtKind::Expression, e);
  made->begins = true;
  to.add(made);
}

cxx::Function* ModuleFunctions::function(std::string_view prefix, std::string_view name) {
  cxx::Function* const made = tree_.declaration<cxx::Function>();
  made->prefix = prefix;
  made->result.base = "void";
  made->name = tree_.kept(name);
  made->parameters.add(tree_.variable(cxx::Type{"rung_context", "*", {}}, "ctx"));
  return made;
}

void ModuleFunctions::define(cxx::Declarations& where, cxx::Function* made, const Statements& body) {
  made->form = cxx::Function::Form::Lines;
  made->body = body.first();
  where.add(tree_.blank());
  where.add(made);
}

// ---- functions that the tables name

void ModuleFunctions::addInitialiser(const std::string& name, ir::BodyId init) {
  cxx::Function* const made = function("static", name);
  made->parameters.add(tree_.variable(cxx::Type{"void", "*", {}}, "instance"));
  const ir::Body& called = module_.body(init);
  const Ex instance = tree_.fixed("instance");
  Statements body;
  if (called.kind == ir::BodyKind::Init)
    add(body, callOn(init, called.self, instance));
  else
    add(body, callWith(init, instance));  // a maker takes any instance, as methods do
  define(functions_, made, body);
}

std::string ModuleFunctions::addBlockInit(const std::string& name, const ir::Description::Life& life) {
  Statements body;
  if (hasCode(life.init)) add(body, callOn(life.init, life.record, block(life.block)));
  if (life.setup) add(body, callOf(life.setup));
  if (body.empty()) return "nullptr";
  define(functions_, function("static", name), body);
  return name;
}

std::string ModuleFunctions::addBlockFunction(const std::string& name, const ir::Description::Life& life,
                                              ir::BodyId called) {
  if (!called) return "nullptr";
  Statements body;
  add(body, callWith(called, block(life.block)));
  define(functions_, function("static", name), body);
  return name;
}

void ModuleFunctions::addTask(const std::string& name, uint32_t task) {
  const ir::Task& is = module_.tasks[task];
  Statements body;
  add(body, tree_.cast("void", tree_.fixed("ctx")));
  if (is.before) add(body, callOf(is.before));
  for (uint32_t p = 0; p < module_.programs.size(); ++p) {
    const ir::ProgramInstance& program = module_.programs[p];
    if (program.task == task + 1 && program.body) add(body, runOf(program, facts_.program_block[p]));
  }
  for (const ir::BlockTask& block : module_.block_tasks)
    if (block.task == task + 1) add(body, callOf(block.run));
  if (is.after) add(body, callOf(is.after));
  define(functions_, function("static", name), body);
}

ModuleFunctions::TestNames ModuleFunctions::addTest(const std::string& name, const ir::Description::Test& test) {
  const ir::Body& body = module_.body(test.body);
  Statements init, run, exit, last;
  if (test.before) add(run, callOf(test.before));
  if (body.kind == ir::BodyKind::Function) {
    declare(test.body);
    addFunctionTest(run, body);
  } else if (test.program != RUNG_NONE) {
    const ir::ProgramInstance& program = module_.programs[test.program];
    const uint32_t number = facts_.program_block[test.program];
    add(run, runOf(program, number));
    add(init, clearing(number));
    if (hasCode(program.init)) add(init, callOn(program.init, program.record, block(number)));
    if (program.setup) add(init, callOf(program.setup));
    if (program.after_init) add(init, callOf(program.after_init));
    if (program.exit) add(last, callOf(program.exit));
  }
  for (const ir::BodyId setup : test.setups) add(init, callOf(setup));
  for (const ir::BodyId teardown : test.teardowns) add(exit, callOf(teardown));
  exit.append(last);
  TestNames names;
  names.run = name;
  if (!init.empty()) define(functions_, function("static", names.init = name + "_init"), init);
  if (!exit.empty()) define(functions_, function("static", names.exit = name + "_exit"), exit);
  if (test.after) add(run, callOf(test.after));
  define(functions_, function("static", name), run);
  return names;
}

// A test that is a function: its parameters are zero, its results are dropped.
void ModuleFunctions::addFunctionTest(Statements& to, const ir::Body& body) {
  std::vector<Ex> arguments{tree_.fixed("ctx")};
  Statements variables;
  for (const ir::Local& local : body.locals) {
    const bool is_result = local.kind == ir::LocalKind::Result;
    if (!isParameter(local) && !(is_result && local.by_reference)) continue;
    if (types_.kind(elementOf(types_, local.type)) == TypeKind::Record) return;  // sema rejects tests with pins
    const Ex name = tree_.name("p" + std::to_string(arguments.size()));
    cxx::Stmt* const made =
        tree_.declare(tree_.variable(valueType(tree_, types_, local.type), name->text, tree_.braces({})));
    made->begins = true;
    variables.add(made);
    const bool by_address = local.by_reference && !TypeTable::isString(types_.kind(local.type));
    arguments.push_back(by_address ? tree_.prefix("&", name) : name);
  }
  std::string function;
  appendFunctionName(function, module_, body);
  to.append(variables);
  add(to, tree_.call(function, arguments));
}

// ---- entries

void ModuleFunctions::addEntry(std::string_view name, const Statements& body) {
  define(entries_, function({}, name), body);
}

void ModuleFunctions::addEntries() {
  Statements init;
  add(init, tree_.cast("void", tree_.fixed("ctx")));
  for (uint32_t i = 0; i < facts_.blocks.size(); ++i) add(init, clearing(i));
  const std::vector<ir::InitStep> order = ir::initOrder(module_, facts_);
  for (const ir::InitStep& step : order) {
    const ir::BodyId body = step.is_list ? module_.lists[step.index].init : module_.programs[step.index].init;
    if (!hasCode(body)) continue;
    const TypeId record = step.is_list ? module_.lists[step.index].record : module_.programs[step.index].record;
    add(init,
        callOn(body, record, block(step.is_list ? facts_.list_block[step.index] : facts_.program_block[step.index])));
  }
  for (const ir::InitStep& step : order)
    if (!step.is_list && module_.programs[step.index].setup) add(init, callOf(module_.programs[step.index].setup));
  if (module_.after_init) add(init, callOf(module_.after_init));
  addEntry("init", init);
  const auto entry = [&](std::string_view name, ir::BodyId id) {
    if (!id) return;
    Statements body;
    add(body, callOf(id));
    addEntry(name, body);
  };
  entry("exit", module_.exit);
  entry("safe", module_.safe);
}

// ---- text

std::string ModuleFunctions::printed(const cxx::Declarations& all) const {
  std::string out;
  cxx::print(out, tree_, all);
  return out;
}

std::string ModuleFunctions::declarations() const { return printed(records_) + printed(prototypes_); }

}  // namespace rung::codegen
