// SPDX-License-Identifier: Apache-2.0
#include "common/base/random_bytes.h"

#include <openssl/rand.h>

#include "common/base/log.h"

namespace aquarama {

void fillRandom(std::span<unsigned char> bytes) {
    if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
        throw Error("the system has no random numbers; try again");
}

}  // namespace aquarama
