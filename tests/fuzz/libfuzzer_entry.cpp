// SPDX-License-Identifier: Apache-2.0
// Where libFuzzer comes in; AQUARAMA_FUZZ_TARGET names the target.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    return aquarama::AQUARAMA_FUZZ_TARGET(bytes, size);
}
