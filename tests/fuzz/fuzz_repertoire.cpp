// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/motion/repertoire.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

using Bytes = std::vector<std::byte>;

void readOne(const Bytes& file) {
    try {
        const motion::Repertoire repertoire = motion::decodeRepertoire(file, "fuzzed");
        promise(motion::encodeRepertoire(repertoire) == file,
                "a repertoire is written as it was read");
    } catch (const Error& error) {
        promise(std::string(error.what()).starts_with("fuzzed: "), "an error names its source");
    }
}

// With the length and the digest that its content asks for, which no mutation would ever hit.
Bytes mended(Bytes file) {
    constexpr std::size_t kLengthAt = 7;
    constexpr std::size_t kDigestBytes = 32;
    if (file.size() < kLengthAt + 4 + kDigestBytes) return file;
    for (std::size_t i = 0; i < 4; ++i)
        file[kLengthAt + i] = static_cast<std::byte>(file.size() >> 8 * i);
    const Digest digest = digestOf(std::span(file).first(file.size() - kDigestBytes));
    std::ranges::copy(std::as_bytes(std::span(digest.bytes)),
                      file.end() - static_cast<std::ptrdiff_t>(kDigestBytes));
    return file;
}

}  // namespace

int fuzzRepertoire(const std::uint8_t* bytes, std::size_t size) {
    const auto input = std::as_bytes(std::span(bytes, size));
    const Bytes file(input.begin(), input.end());
    readOne(file);
    readOne(mended(file));
    return 0;
}

}  // namespace aquarama
