// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>

#include "common/enrol/words.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

int fuzzEnrol(const std::uint8_t* bytes, std::size_t size) {
    const auto packet = std::as_bytes(std::span(bytes, size));
    const auto word = enrol::wordIn(packet);
    if (word)
        promise(std::ranges::equal(enrol::packetOf(*word), packet), "a word is what was said");
    return 0;
}

}  // namespace aquarama
