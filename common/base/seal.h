// SPDX-License-Identifier: Apache-2.0
// Bytes under a passphrase: without it nobody reads them, and nobody changes them unseen.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace aquarama {

// A seal may be tried at leisure by whoever finds it: shorter passphrases are not taken.
inline constexpr std::size_t kLeastPassphraseBytes = 8;

// Seals at most a gigabyte. Takes half a second and 128 MB of memory, as does each trial of a
// passphrase. Throws Error where the passphrase is too short, or memory is.
[[nodiscard]] std::vector<std::byte> sealed(std::span<const std::byte> content,
                                            std::string_view passphrase);
// The content of a seal; `source` names it in errors. Throws Error where the passphrase is wrong,
// where a byte was changed, or where it is no seal.
[[nodiscard]] std::vector<std::byte> unsealed(std::span<const std::byte> seal,
                                              std::string_view passphrase,
                                              std::string_view source);

}  // namespace aquarama
