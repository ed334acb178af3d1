// SPDX-License-Identifier: Apache-2.0
// A node without a key shows a letter and a code on each monitor, until somebody gives it a
// channel.
#pragma once

#include <filesystem>
#include <string>

namespace aquarama::show {

// Waits for a key, and writes it to this file. With `isHeadless` the log says what screens would
// show. `connector`: of the monitor; empty: all. On the main thread. False: a signal, or a key in a
// window, has ended it. Throws Error where no window can be opened, or the network cannot be
// listened to.
[[nodiscard]] bool waitForKey(const std::filesystem::path& keyFile,
                              bool isHeadless,
                              const std::string& connector);

}  // namespace aquarama::show
