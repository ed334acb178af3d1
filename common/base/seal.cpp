// SPDX-License-Identifier: Apache-2.0
#include "common/base/seal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include <openssl/crypto.h>
#include <openssl/evp.h>

#include "common/base/log.h"
#include "common/base/random_bytes.h"

namespace aquarama {

namespace {

// A seal is: the mark, the salt, the check of the passphrase, the tag, the content encrypted.
constexpr std::array<unsigned char, 8> kMark{'A', 'Q', 'S', 'E', 'A', 'L', ' ', '1'};
constexpr std::size_t kPart = 16;  // bytes of salt, check and tag
constexpr std::size_t kHead = kMark.size() + 3 * kPart;
constexpr std::size_t kMostContent = std::size_t{1} << 30U;
constexpr std::size_t kKey = 32;
// Each seal has a salt and so a key of its own, under which nothing else is encrypted.
constexpr std::array<unsigned char, 12> kNonce{};

using Part = std::array<unsigned char, kPart>;
using Bytes = std::vector<std::byte>;
using Cipher = std::unique_ptr<EVP_CIPHER_CTX, decltype(&EVP_CIPHER_CTX_free)>;

// What follows from a passphrase and a salt.
struct SealKeys {
    std::array<unsigned char, kKey> key{};
    Part check{};  // tells a wrong passphrase from a changed byte
};

unsigned char* writable(std::byte* bytes) {
    return reinterpret_cast<unsigned char*>(bytes);
}

const unsigned char* readable(const std::byte* bytes) {
    return reinterpret_cast<const unsigned char*>(bytes);
}

// Of OpenSSL's functions, which fail here for lack of memory only.
void require(bool isDone) {
    if (!isDone) throw Error("sealing needs 128 MB of memory; end other programs");
}

// Scrypt as RFC 7914 recommends it for files, with the cost of 128 MB.
SealKeys keysOf(std::string_view passphrase, const Part& salt) {
    constexpr std::uint64_t kCost = 1U << 17U, kBlocks = 8, kLanes = 1;
    constexpr std::uint64_t kMostMemory = std::uint64_t{1} << 28U;
    std::array<unsigned char, kKey + kPart> bytes{};
    require(EVP_PBE_scrypt(passphrase.data(),
                           passphrase.size(),
                           salt.data(),
                           salt.size(),
                           kCost,
                           kBlocks,
                           kLanes,
                           kMostMemory,
                           bytes.data(),
                           bytes.size()) == 1);
    SealKeys keys;
    std::copy_n(bytes.begin(), kKey, keys.key.begin());
    std::copy_n(bytes.begin() + kKey, kPart, keys.check.begin());
    return keys;
}

Cipher newCipher() {
    Cipher cipher(EVP_CIPHER_CTX_new(), &EVP_CIPHER_CTX_free);
    require(cipher != nullptr);
    return cipher;
}

Part partOf(std::span<const std::byte> seal, std::size_t number) {
    Part part{};
    std::copy_n(readable(seal.data()) + kMark.size() + number * kPart, kPart, part.begin());
    return part;
}

void setPart(Bytes& seal, std::size_t number, const Part& part) {
    std::ranges::copy(part, writable(seal.data()) + kMark.size() + number * kPart);
}

bool isSeal(std::span<const std::byte> seal) {
    return seal.size() >= kHead && seal.size() - kHead <= kMostContent &&
           std::equal(kMark.begin(), kMark.end(), readable(seal.data()));
}

// Encrypts into `hidden`, of the same size; returns the tag.
Part encrypt(std::span<const std::byte> content,
             const SealKeys& keys,
             std::span<std::byte> hidden) {
    const Cipher cipher = newCipher();
    EVP_CIPHER_CTX* const at = cipher.get();
    unsigned char* const out = writable(hidden.data());
    int size = 0;
    Part tag{};
    require(EVP_EncryptInit_ex(at, EVP_aes_256_gcm(), nullptr, keys.key.data(), kNonce.data()) ==
            1);
    require(EVP_EncryptUpdate(
                at, out, &size, readable(content.data()), static_cast<int>(content.size())) == 1);
    require(EVP_EncryptFinal_ex(at, out + size, &size) == 1);
    require(EVP_CIPHER_CTX_ctrl(at, EVP_CTRL_GCM_GET_TAG, kPart, tag.data()) == 1);
    return tag;
}

// Decrypts into `content`, of the same size; false: the tag is of other bytes.
bool decrypt(std::span<const std::byte> hidden,
             const SealKeys& keys,
             Part tag,
             std::span<std::byte> content) {
    const Cipher cipher = newCipher();
    EVP_CIPHER_CTX* const at = cipher.get();
    unsigned char* const out = writable(content.data());
    int size = 0;
    require(EVP_DecryptInit_ex(at, EVP_aes_256_gcm(), nullptr, keys.key.data(), kNonce.data()) ==
            1);
    require(EVP_DecryptUpdate(
                at, out, &size, readable(hidden.data()), static_cast<int>(hidden.size())) == 1);
    require(EVP_CIPHER_CTX_ctrl(at, EVP_CTRL_GCM_SET_TAG, kPart, tag.data()) == 1);
    return EVP_DecryptFinal_ex(at, out + size, &size) == 1;
}

}  // namespace

std::vector<std::byte> sealed(std::span<const std::byte> content, std::string_view passphrase) {
    if (passphrase.size() < kLeastPassphraseBytes)
        throw Error("the passphrase has fewer than 8 characters: take several words");
    if (content.size() > kMostContent) throw Error("more than a gigabyte cannot be sealed");
    const Part salt = randomBytes<kPart>();
    const SealKeys keys = keysOf(passphrase, salt);
    Bytes seal(kHead + content.size());
    std::ranges::copy(kMark, writable(seal.data()));
    setPart(seal, 0, salt);
    setPart(seal, 1, keys.check);
    setPart(seal, 2, encrypt(content, keys, std::span(seal).subspan(kHead)));
    return seal;
}

std::vector<std::byte> unsealed(std::span<const std::byte> seal,
                                std::string_view passphrase,
                                std::string_view source) {
    const std::string name(source);
    if (!isSeal(seal)) throw Error(name + ": is no seal of this version; copy or export it anew");
    const SealKeys keys = keysOf(passphrase, partOf(seal, 0));
    const Part check = partOf(seal, 1);
    if (CRYPTO_memcmp(check.data(), keys.check.data(), kPart) != 0)
        throw Error(name + ": the passphrase is wrong; type the one with which it was sealed");
    const std::span<const std::byte> hidden = seal.subspan(kHead);
    Bytes content(hidden.size());
    if (!decrypt(hidden, keys, partOf(seal, 2), content))
        throw Error(name + ": was changed after it was sealed; copy or export it anew");
    return content;
}

}  // namespace aquarama
