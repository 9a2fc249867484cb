// SPDX-License-Identifier: Apache-2.0
// A module that the interpreter runs: see program.h.
#include "ir/interpreter/program.h"

#include <ucontext.h>
#include <algorithm>
#include <cstring>

#include "frontend/source/invariant.h"
#include "ir/description.h"
#include "ir/interpreter/debug.h"
#include "ir/interpreter/translate.h"
#include "rung/change.h"

namespace rung::ir::interpreter {

namespace {

constexpr size_t kTaskStack = size_t{1} << 20;  // of an activation, on top of the largest frame

// The frames of this thread's activation: allocated once, so that the cycle allocates nothing.
struct Stack {
  std::unique_ptr<uint8_t[]> memory;
  size_t size = 0;
};
thread_local Stack stack;
thread_local const Machine* running_machine = nullptr;

}  // namespace

struct Program::Parts {
  rung_module is{};  // first: a context points to it, of() to the whole
  std::string refusal, name;
  Code code;
  std::unique_ptr<DebugCode> debug;
  std::unique_ptr<Description> description;
  std::vector<rung_task> tasks;
  std::vector<rung_test> tests;
  std::vector<rung_initialiser> initialisers;
  std::vector<rung_block_life> lives;
  rung_names names{};
  rung_change_tables change{};
  std::vector<rung_extension> extensions;
  struct LifeEntries {
    Code::Entry init, refresh, reinit, exit;
  };
  std::vector<LifeEntries> of_life;
  Code::Entry init, exit, safe;
  std::vector<Code::Entry> of_initialiser, of_task, of_test, of_test_init, of_test_exit;
  size_t stack_size = kTaskStack;
  rung_site* spare_site = nullptr;  // the last row of code.sites: siteOfCrash

  static const Parts& of(const rung_context* ctx) { return *reinterpret_cast<const Parts*>(ctx->module); }

  void run(rung_context* ctx, const Code::Entry& entry, void* instance = nullptr) const {
    if (stack.size < stack_size) {
      stack.memory = std::make_unique_for_overwrite<uint8_t[]>(stack_size);
      stack.size = stack_size;
    }
    Machine machine;
    machine.ctx = ctx;
    uint8_t* const begin = stack.memory.get();
    machine.limit = begin + stack.size;
    machine.base = begin;
    machine.debug = debug.get();
    machine.site_of = [](const rung_context* of_ctx, const Insn* insn) {
      return of(of_ctx).siteOf(reinterpret_cast<uintptr_t>(insn)) + 1;
    };
    running_machine = &machine;
    execute(code.insns.data() + entry.at, begin, static_cast<uint8_t*>(instance), &machine);
  }

  bool isInsn(uintptr_t address) const {
    const uintptr_t distance = address - reinterpret_cast<uintptr_t>(code.insns.data());
    return distance % sizeof(Insn) == 0 && distance / sizeof(Insn) < code.insns.size();
  }

  // The source location of the statement that contains an instruction, as the last site.
  uint32_t siteOf(uintptr_t insn) const {
    if (!isInsn(insn)) return RUNG_NONE;
    const uintptr_t index = (insn - reinterpret_cast<uintptr_t>(code.insns.data())) / sizeof(Insn);
    auto entry = std::upper_bound(code.line_table.begin(), code.line_table.end(), index,
                                  [](uintptr_t at, const Code::LineEntry& it) { return at < it.insn; });
    if (entry == code.line_table.begin()) return RUNG_NONE;
    --entry;
    rung_site& site = *spare_site;
    site.pou = entry->pou;
    site.file = entry->file;
    site.line = entry->line;
    site.column = entry->column;
    return static_cast<uint32_t>(spare_site - code.sites.data());
  }

  // The frames from that of the fault to the one that the task called; a frame begins with where it was called.
  static void findCallers(rung_context* ctx) {
    if (running_machine == nullptr || running_machine->ctx != ctx) return;
    const uint8_t* const begin = stack.memory.get();
    const uint8_t *fp = running_machine->fp, *self = running_machine->self;
    while (fp != begin) {
      const Linkage& caller = *reinterpret_cast<const Linkage*>(fp);
      if (caller.fp == begin) return;
      const uint32_t site = siteOfCall(caller.ip - 1);
      if (ctx->caller_count < RUNG_CALLERS) ctx->callers[ctx->caller_count] = {site == 0 ? RUNG_NONE : site - 1, self};
      ++ctx->caller_count;
      fp = caller.fp;
      self = caller.self;
    }
  }

  static void runInit(rung_context* ctx) { of(ctx).run(ctx, of(ctx).init); }
  static void runExit(rung_context* ctx) { of(ctx).run(ctx, of(ctx).exit); }
  static void runSafe(rung_context* ctx) { of(ctx).run(ctx, of(ctx).safe); }
  static void runInitialiser(rung_context* ctx, void* instance) {
    const Parts& parts = of(ctx);
    const auto* const row = static_cast<const rung_initialiser*>(ctx->entry);
    parts.run(ctx, parts.of_initialiser[static_cast<size_t>(row - parts.initialisers.data())], instance);
  }
  static void runTask(rung_context* ctx) {
    const Parts& parts = of(ctx);
    parts.run(ctx, parts.of_task[static_cast<size_t>(static_cast<const rung_task*>(ctx->entry) - parts.tasks.data())]);
  }
  template <Code::Entry LifeEntries::*Function>
  static void runLife(rung_context* ctx) {
    const Parts& parts = of(ctx);
    const auto row = static_cast<size_t>(static_cast<const rung_block_life*>(ctx->entry) - parts.lives.data());
    parts.run(ctx, parts.of_life[row].*Function);
  }
  static size_t testOf(rung_context* ctx) {
    return static_cast<size_t>(static_cast<const rung_test*>(ctx->entry) - of(ctx).tests.data());
  }
  static void runTestInit(rung_context* ctx) { of(ctx).run(ctx, of(ctx).of_test_init[testOf(ctx)]); }
  static void runTestExit(rung_context* ctx) { of(ctx).run(ctx, of(ctx).of_test_exit[testOf(ctx)]); }
  static void runTest(rung_context* ctx) { of(ctx).run(ctx, of(ctx).of_test[testOf(ctx)]); }

  void translate(const Module& module, const MemoryBlocks& blocks, const ProgramOptions& options);
  void describe();
};

// The entries of a module: the code of its init, exit, tasks and tests, which calls bodies.
class Entries {
 public:
  Entries(const Module& module, const MemoryBlocks& blocks, BodyTranslator& translator)
      : module_(module), blocks_(blocks), translator_(translator) {}

  Code::Entry callOf(BodyId function) { return one({Step::CallOf, function, 0}); }
  Code::Entry callOnSelf(BodyId body) { return one({Step::CallOnSelf, body, 0}); }

  Code::Entry init() {
    std::vector<Step> steps;
    for (uint32_t i = 0; i < blocks_.block_count; ++i) steps.push_back({Step::Clear, {}, i});
    const std::vector<InitStep> order = initOrder(module_, blocks_);
    for (const InitStep& step : order) {
      const BodyId body = step.is_list ? module_.lists[step.index].init : module_.programs[step.index].init;
      const uint32_t block = step.is_list ? blocks_.list_block[step.index] : blocks_.program_block[step.index];
      if (body) steps.push_back({Step::CallOn, body, block});
    }
    for (const InitStep& step : order)
      if (!step.is_list) addCallOf(steps, module_.programs[step.index].setup);
    addCallOf(steps, module_.after_init);
    return translator_.translateSteps(steps);
  }

  // The functions of a block for an online change.
  Code::Entry blockInit(const Description::Life& life) {
    std::vector<Step> steps;
    if (life.init) steps.push_back({Step::CallOn, life.init, life.block});
    addCallOf(steps, life.setup);
    return translator_.translateSteps(steps);
  }
  Code::Entry callOnBlock(BodyId body, uint32_t block) {
    return body ? one({Step::CallOn, body, block}) : Code::Entry{};
  }

  Code::Entry task(uint32_t number) {
    std::vector<Step> steps;
    addCallOf(steps, module_.tasks[number].before);
    for (uint32_t p = 0; p < module_.programs.size(); ++p)
      if (module_.programs[p].task == number + 1 && module_.programs[p].body) addRun(steps, p);
    for (const BlockTask& block : module_.block_tasks)
      if (block.task == number + 1) addCallOf(steps, block.run);
    addCallOf(steps, module_.tasks[number].after);
    return translator_.translateSteps(steps);
  }

  Code::Entry test(const Description::Test& test) {
    std::vector<Step> steps;
    addCallOf(steps, test.before);
    if (test.program == RUNG_NONE)
      addCallOf(steps, test.body);
    else
      addRun(steps, test.program);
    addCallOf(steps, test.after);
    return translator_.translateSteps(steps);
  }
  Code::Entry testInit(const Description::Test& test) {
    std::vector<Step> steps;
    if (test.program != RUNG_NONE) {
      const ProgramInstance& program = module_.programs[test.program];
      const uint32_t block = blocks_.program_block[test.program];
      steps.push_back({Step::Clear, {}, block});
      if (program.init) steps.push_back({Step::CallOn, program.init, block});
      addCallOf(steps, program.setup);
      addCallOf(steps, program.after_init);
    }
    for (const BodyId setup : test.setups) addCallOf(steps, setup);
    return translator_.translateSteps(steps);
  }
  Code::Entry testExit(const Description::Test& test) {
    std::vector<Step> steps;
    for (const BodyId teardown : test.teardowns) addCallOf(steps, teardown);
    if (test.program != RUNG_NONE) addCallOf(steps, module_.programs[test.program].exit);
    return translator_.translateSteps(steps);
  }

 private:
  using Step = BodyTranslator::Step;

  Code::Entry one(const Step& step) { return translator_.translateSteps({&step, 1}); }
  static void addCallOf(std::vector<Step>& steps, BodyId function) {
    if (function) steps.push_back({Step::CallOf, function, 0});
  }
  void addRun(std::vector<Step>& steps, uint32_t number) {
    const ProgramInstance& program = module_.programs[number];
    if (program.run)
      addCallOf(steps, program.run);
    else if (program.body)
      steps.push_back({Step::CallOn, program.body, blocks_.program_block[number]});
  }

  const Module& module_;
  const MemoryBlocks& blocks_;
  BodyTranslator& translator_;
};

void Program::Parts::translate(const Module& module, const MemoryBlocks& blocks, const ProgramOptions& options) {
  TranslateOptions translate_options;
  translate_options.natives = options.natives;
  translate_options.coverage = options.coverage;
  translate_options.trace_calls = options.trace_calls;
  translate_options.debug = options.debug;
  BodyTranslator translator(module, blocks, description->strings, translate_options, code);
  code.bodies.resize(module.bodies.size());
  if (options.debug) code.debug_ends.resize(module.bodies.size());
  if (options.debug) code.debug_offsets.resize(module.bodies.size());
  translateData(module, code);
  translateDispatches(module, code);
  for (uint32_t i = 1; i < module.bodies.size(); ++i) {
    if (module.bodies[i].native || module.bodies[i].abstract) continue;
    const std::string_view body_name = module.names.string(module.bodies[i].name);
    setPhaseSubject(body_name.data(), body_name.size());
    translator.translate(BodyId{i});
  }
  setPhaseSubject("", 0);

  Entries entries(module, blocks, translator);
  init = entries.init();
  if (module.exit) exit = entries.callOf(module.exit);
  if (module.exit) is.exit = runExit;
  if (module.safe) safe = entries.callOf(module.safe);
  if (module.safe) is.safe = runSafe;
  for (const Description::Initialiser& row : description->initialisers) {
    initialisers.push_back({row.type, runInitialiser});
    of_initialiser.push_back(entries.callOnSelf(row.body));
  }
  for (const Description::Life& life : description->lives) {
    of_life.push_back({entries.blockInit(life), entries.callOnBlock(life.refresh, life.block),
                       entries.callOnBlock(life.reinit, life.block), entries.callOnBlock(life.exit, life.block)});
    lives.push_back(
        {life.block, life.type, runLife<&LifeEntries::init>, life.refresh ? runLife<&LifeEntries::refresh> : nullptr,
         life.reinit ? runLife<&LifeEntries::reinit> : nullptr, life.exit ? runLife<&LifeEntries::exit> : nullptr});
  }
  for (uint32_t i = 0; i < module.tasks.size(); ++i) of_task.push_back(entries.task(i));
  for (const Description::Test& test : description->tests) {
    of_test.push_back(entries.test(test));
    of_test_init.push_back(entries.testInit(test));
    of_test_exit.push_back(entries.testExit(test));
  }
  link(module, code);
  for (const Code::Entry& body : code.bodies) stack_size = std::max(stack_size, kTaskStack + 2 * size_t{body.frame});
  if (!code.missing.empty()) refusal = "the native function `" + code.missing + "` is not part of rung";
  if (!module.cpp_bodies.empty()) {
    const Body& body = module.body(module.cpp_bodies.front().body);
    refusal = "`" + std::string(module.names.string(body.spelling)) + "` has a C++ body";
  }
}

void Program::Parts::describe() {
  const Description& from = *description;
  tasks = from.tasks;
  for (rung_task& task : tasks) task.run = runTask;
  for (const Description::Test& test : from.tests) {
    tests.push_back(test.row);
    tests.back().init = runTestInit;
    tests.back().run = runTest;
    tests.back().exit = runTestExit;
  }
  spare_site = &code.sites.emplace_back();
  is.abi = RUNG_MODULE_ABI;
  is.layout = RUNG_MODULE_LAYOUT;
  is.pointer_size = sizeof(void*);
  is.flags = from.aligned_globals ? RUNG_ALIGNED_GLOBALS : 0;
  is.name = name.c_str();
  is.compiler = "rung";
  is.strings = from.strings.bytes().c_str();
  is.layout_hash = from.layout_hash;
  const auto table = [](const auto& rows) {
    return rung_table{rows.data(), static_cast<uint32_t>(rows.size()), sizeof rows[0]};
  };
  is.blocks = table(from.blocks);
  is.areas = table(from.areas);
  is.resources = table(from.resources);
  is.tasks = table(tasks);
  is.writes = table(from.writes);
  is.io_modules = table(from.io_modules);
  is.symbols = table(from.symbols);
  is.types = table(from.types);
  is.fields = table(from.fields);
  is.enum_items = table(from.enum_items);
  is.dimensions = table(from.dimensions);
  is.retain = table(from.retain);
  is.persistent = table(from.persistent);
  is.sites = table(code.sites);
  is.initialisers = table(initialisers);
  is.tests = table(tests);
  if (!from.names.empty()) {
    names.slots = table(from.names);
    extensions.push_back({RUNG_NAMES, &names, sizeof names});
  }
  if (!lives.empty()) {
    change = {table(lives), table(from.classes)};
    extensions.push_back({RUNG_CHANGE, &change, sizeof change});
  }
  is.extensions = table(extensions);
  is.init = runInit;
  is.find_callers = findCallers;
}

Program::Program(const Module& module, const ProgramOptions& options) : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  if (module.types.pointerSize() != sizeof(void*)) {
    parts.refusal = "it uses another pointer size";
    return;
  }
  const MemoryBlocks blocks(module);
  parts.name = options.module_name;
  parts.description = std::make_unique<Description>(module, blocks, options.with_tests, options.debug);
  parts.translate(module, blocks, options);
  if (options.debug) parts.debug = std::make_unique<DebugCode>(module, *parts.description, parts.code);
  parts.describe();
}

Program::~Program() = default;

const Machine* Program::running() { return running_machine; }

// The current instruction is in some register, its successor perhaps in another; a native function's was noted.
uint32_t Program::siteOfCrash(const rung_context* ctx, const void* details) {
  if (running_machine == nullptr || running_machine->ctx != ctx) return RUNG_NONE;
  const Parts& parts = Parts::of(ctx);
  constexpr size_t kRegisters = 23;
  uintptr_t registers[kRegisters];
  memcpy(registers, &static_cast<const ucontext_t*>(details)->uc_mcontext, sizeof registers);
  uintptr_t at = UINTPTR_MAX;
  for (const uintptr_t value : registers)
    if (parts.isInsn(value)) at = std::min(at, value);
  return parts.siteOf(at != UINTPTR_MAX ? at : reinterpret_cast<uintptr_t>(running_machine->ip));
}

const std::string& Program::refusal() const { return parts_->refusal; }
const rung_module& Program::description() const { return parts_->is; }
DebugCode* Program::debug() const { return parts_->debug.get(); }
const std::deque<Counter>& Program::counters() const { return parts_->code.counters; }

std::string Program::counts() const {
  std::string bytes;
  for (const Counter& counter : parts_->code.counters)
    bytes.append(reinterpret_cast<const char*>(&counter.count), sizeof counter.count);
  return bytes;
}

void Program::addCounts(std::string_view counts) {
  size_t at = 0;
  for (Counter& counter : parts_->code.counters) {
    uint64_t count = 0;
    if (counts.size() - at < sizeof count) return;
    memcpy(&count, counts.data() + at, sizeof count);
    counter.count += count;
    at += sizeof count;
  }
}

}  // namespace rung::ir::interpreter
