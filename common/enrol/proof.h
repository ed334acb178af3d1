// SPDX-License-Identifier: Apache-2.0
// How two programs that have never met show each other that somebody has read a code on the screen
// of one and typed it at the other.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace aquarama::enrol {

// Which of the two shows it: neither can repeat what the other has said.
enum class Side : std::uint8_t { Assigner, Node };

// What a code becomes before it is used: scrypt with the node's public key as salt, which costs 32
// MB and a tenth of a second, so that to guess the code from a proof takes years.
class CodeKey {
  public:
    // `nodeKey`: the public key under which the node is spoken to. Throws Error where memory is
    // short.
    CodeKey(std::string_view code, std::string_view nodeKey);
    // 32 bytes: an HMAC of the side and of the node's key. A proof that was made for the key of
    // somebody in between proves nothing to the node.
    [[nodiscard]] std::string proofOf(Side side) const;
    // In a time that does not tell where they differ.
    [[nodiscard]] bool isProof(Side side, std::string_view proof) const;

  private:
    std::string key_;
    std::string nodeKey_;
};

}  // namespace aquarama::enrol
