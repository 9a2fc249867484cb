// SPDX-License-Identifier: Apache-2.0
/* A compiled project as a shared library: loaded at run time, with its single exported function found by name. */
#include <dlfcn.h>
#include <stdio.h>

#include "rung/module.h"

typedef const rung_module *(*module_function)(void);

int main(int argc, char **argv) {
  void *library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : NULL;
  if (library == NULL) return printf("%s\n", dlerror()), 1;
  void *symbol = dlsym(library, "plant_module");
  if (symbol == NULL) return printf("%s\n", dlerror()), 1;
  const rung_module *module = (*(module_function *)&symbol)();
  printf("abi %u, %u tasks, interval %lld ms\n", module->abi, module->tasks.count, (long long)(rung_task_at(module, 0)->interval_ns / 1000000));
  return 0;
}
