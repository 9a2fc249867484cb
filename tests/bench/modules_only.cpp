// SPDX-License-Identifier: Apache-2.0
// Times the kernels of modules, for code by hand that has a main of its own. Arguments: name=rounds.
#include <cstdlib>
#include <string>

#include "measure_hand.h"

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const size_t equals = argument.find('=');
    measureKernel(argument.substr(0, equals).c_str(), std::atoi(argument.c_str() + equals + 1), nullptr);
  }
  return 0;
}
