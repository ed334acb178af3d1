// SPDX-License-Identifier: Apache-2.0
#include "common/cli/keyboard.h"

#include <array>

#include <poll.h>
#include <unistd.h>

namespace aquarama::cli {

Keyboard::Keyboard() : isTerminal_(tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!isTerminal_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

Keyboard::~Keyboard() {
    if (isTerminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

bool Keyboard::read(std::string& keys, std::chrono::milliseconds most) {
    keys.clear();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, static_cast<int>(most.count())) <= 0) return true;
    std::array<char, 64> bytes{};
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) return false;
    keys.assign(bytes.data(), static_cast<std::size_t>(count));
    return true;
}

}  // namespace aquarama::cli
