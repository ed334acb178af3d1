// SPDX-License-Identifier: Apache-2.0
// Keys of whoever sits at the terminal.
#pragma once

#include <chrono>
#include <string>

#include <termios.h>

namespace aquarama::cli {

// Standard input as a terminal that reports each key at once and without echo, while this object
// lives; Ctrl-C is a key too. Other inputs are read unchanged.
class Keyboard {
  public:
    Keyboard();
    ~Keyboard();
    Keyboard(const Keyboard&) = delete;
    Keyboard& operator=(const Keyboard&) = delete;

    // Reads keys, waiting for so long at most. False: the input has ended.
    [[nodiscard]] bool read(std::string& keys, std::chrono::milliseconds most);

  private:
    termios before_{};
    bool isTerminal_;
};

}  // namespace aquarama::cli
