// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "common/base/log.h"
#include "common/body/fish_body.h"
#include "common/config/species.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

// What is read can also be built.
int fuzzSpecies(const std::uint8_t* bytes, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    try {
        const body::FishBody body = body::makeBody(config::parseSpecies(text, "fuzzed"));
        promise(body.cage.vertices.size() == std::size_t{body::kControlPoints}, "a cage is whole");
    } catch (const Error& error) {
        promiseLine(error.what());
        promise(*error.what() != '\0', "an error says what is wrong");
    }
    return 0;
}

}  // namespace aquarama
