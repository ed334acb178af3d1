// SPDX-License-Identifier: Apache-2.0
// What a repertoire holds, as a table of text.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace aquarama::report {

// Throws Error, naming `source`, when the bytes are no intact repertoire.
[[nodiscard]] std::string inspectRepertoire(std::span<const std::byte> bytes,
                                            const std::string& source);

// Of the file format.
[[nodiscard]] int formatVersionOf(std::span<const std::byte> intactRepertoire);

}  // namespace aquarama::report
