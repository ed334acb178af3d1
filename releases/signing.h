// SPDX-License-Identifier: Apache-2.0
// Ed25519 by OpenSSL: the key of a show, and what is signed with it. Keys are PEM, as `openssl`
// reads them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/base/digest.h"

namespace aquarama::releases {

// A pair of keys, each as the text of a PEM file.
struct SigningKeys {
    std::string secretPem, publicPem;
};
// A new pair. Throws Error where the system has no random numbers.
[[nodiscard]] SigningKeys makeSigningKeys();

// The signature of a content, 64 bytes. `source` names the key in errors. Throws Error where it is
// no secret key of Ed25519.
[[nodiscard]] std::vector<std::byte> signatureOf(std::span<const std::byte> content,
                                                 const std::string& secretPem,
                                                 const std::string& source);
// Whether the holder of this key has signed the content. Throws Error where it is no public key of
// Ed25519.
[[nodiscard]] bool isSignedBy(const std::string& publicPem,
                              std::span<const std::byte> content,
                              std::span<const std::byte> signature,
                              const std::string& source);

// The SHA-256 of a file of any size, read in pieces. Throws Error where it cannot be read.
[[nodiscard]] Digest digestOfFile(const std::filesystem::path& path);

}  // namespace aquarama::releases
