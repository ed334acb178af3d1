// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "console/overview.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzBrowser(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    const auto message = console::readBrowser(text);
    if (!message) return 0;
    promise(message->look().topics_size() <= 64, "a look has few topics");
    promise(message->look().channels_size() <= 64, "a look has few channels");
    promise(message->ByteSizeLong() <= 4 * size + 16, "a message is no larger than its text");
    return 0;
}

}  // namespace aquarama
