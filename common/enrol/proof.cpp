// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/proof.h"

#include <array>

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include "common/base/log.h"

namespace aquarama::enrol {

namespace {

constexpr std::size_t kProofBytes = 32;

const unsigned char* bytesOf(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

CodeKey::CodeKey(std::string_view code, std::string_view nodeKey)
    : key_(kProofBytes, '\0'), nodeKey_{nodeKey} {
    constexpr std::uint64_t kCost = 1U << 15U, kBlocks = 8, kLanes = 1;
    constexpr std::uint64_t kMostMemory = std::uint64_t{1} << 26U;
    const int isDone = EVP_PBE_scrypt(code.data(),
                                      code.size(),
                                      bytesOf(nodeKey),
                                      nodeKey.size(),
                                      kCost,
                                      kBlocks,
                                      kLanes,
                                      kMostMemory,
                                      reinterpret_cast<unsigned char*>(key_.data()),
                                      key_.size());
    if (isDone != 1) throw Error("to check a code takes 32 MB of memory; end other programs");
}

std::string CodeKey::proofOf(Side side) const {
    const std::string said = (side == Side::Node ? "node " : "assigner ") + nodeKey_;
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    HMAC(EVP_sha256(),
         key_.data(),
         static_cast<int>(key_.size()),
         bytesOf(said),
         said.size(),
         digest.data(),
         &size);
    return {digest.begin(), digest.begin() + kProofBytes};
}

bool CodeKey::isProof(Side side, std::string_view proof) const {
    const std::string own = proofOf(side);
    return proof.size() == own.size() && CRYPTO_memcmp(proof.data(), own.data(), own.size()) == 0;
}

}  // namespace aquarama::enrol
