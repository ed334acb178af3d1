// SPDX-License-Identifier: Apache-2.0
#include "releases/signing.h"

#include <array>
#include <fstream>
#include <memory>

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>

#include "common/base/log.h"

namespace aquarama::releases {

namespace {

constexpr std::size_t kSignatureBytes = 64;

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Memory = std::unique_ptr<BIO, decltype(&BIO_free)>;
using Digester = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

const unsigned char* readable(const std::byte* bytes) {
    return reinterpret_cast<const unsigned char*>(bytes);
}

// Of OpenSSL's functions, which fail here for lack of memory or of random numbers only.
void require(bool isDone) {
    if (!isDone) throw Error("OpenSSL has no memory or no random numbers; end other programs");
}

Memory memoryOf(const std::string& text) {
    Memory memory(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), &BIO_free);
    require(memory != nullptr);
    return memory;
}

std::string textIn(BIO* memory) {
    char* text = nullptr;
    const long size = BIO_get_mem_data(memory, &text);
    return {text, static_cast<std::size_t>(size)};
}

// Nobody is asked for a passphrase: a key that has one is refused.
int noPassphrase(char* /*buffer*/, int /*size*/, int /*writes*/, void* /*data*/) {
    return 0;
}

Key requireEd25519(EVP_PKEY* read, const std::string& source, const char* kind) {
    Key key(read, &EVP_PKEY_free);
    if (!key || EVP_PKEY_id(key.get()) != EVP_PKEY_ED25519)
        throw Error(source + ": is no " + kind +
                    " key of releases; aquarama release key new makes one");
    return key;
}

Digester newDigester() {
    Digester digester(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
    require(digester != nullptr);
    return digester;
}

}  // namespace

SigningKeys makeSigningKeys() {
    const Key key(EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"), &EVP_PKEY_free);
    require(key != nullptr);
    const Memory secret(BIO_new(BIO_s_mem()), &BIO_free), open(BIO_new(BIO_s_mem()), &BIO_free);
    require(secret && open);
    require(PEM_write_bio_PrivateKey(
                secret.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1);
    require(PEM_write_bio_PUBKEY(open.get(), key.get()) == 1);
    return {textIn(secret.get()), textIn(open.get())};
}

std::vector<std::byte> signatureOf(std::span<const std::byte> content,
                                   const std::string& secretPem,
                                   const std::string& source) {
    const Memory pem = memoryOf(secretPem);
    const Key key = requireEd25519(
        PEM_read_bio_PrivateKey(pem.get(), nullptr, &noPassphrase, nullptr), source, "secret");
    const Digester signer = newDigester();
    std::vector<std::byte> signature(kSignatureBytes);
    std::size_t size = signature.size();
    require(EVP_DigestSignInit(signer.get(), nullptr, nullptr, nullptr, key.get()) == 1);
    require(EVP_DigestSign(signer.get(),
                           reinterpret_cast<unsigned char*>(signature.data()),
                           &size,
                           readable(content.data()),
                           content.size()) == 1);
    return signature;
}

bool isSignedBy(const std::string& publicPem,
                std::span<const std::byte> content,
                std::span<const std::byte> signature,
                const std::string& source) {
    const Memory pem = memoryOf(publicPem);
    const Key key = requireEd25519(
        PEM_read_bio_PUBKEY(pem.get(), nullptr, &noPassphrase, nullptr), source, "public");
    const Digester verifier = newDigester();
    require(EVP_DigestVerifyInit(verifier.get(), nullptr, nullptr, nullptr, key.get()) == 1);
    return EVP_DigestVerify(verifier.get(),
                            readable(signature.data()),
                            signature.size(),
                            readable(content.data()),
                            content.size()) == 1;
}

Digest digestOfFile(const std::filesystem::path& path) {
    constexpr std::size_t kPiece = std::size_t{1} << 20U;
    std::ifstream file(path, std::ios::binary);
    std::vector<char> piece(kPiece);
    const Digester digester = newDigester();
    require(EVP_DigestInit_ex(digester.get(), EVP_sha256(), nullptr) == 1);
    while (file.read(piece.data(), kPiece) || file.gcount() > 0)
        require(EVP_DigestUpdate(
                    digester.get(), piece.data(), static_cast<std::size_t>(file.gcount())) == 1);
    if (!file.eof()) throw Error(path.string() + ": cannot be read; see its permissions and disk");
    Digest digest;
    unsigned int size = 0;
    require(EVP_DigestFinal_ex(digester.get(), digest.bytes.data(), &size) == 1);
    return digest;
}

}  // namespace aquarama::releases
