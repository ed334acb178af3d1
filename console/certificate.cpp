// SPDX-License-Identifier: Apache-2.0
#include "console/certificate.h"

#include <array>
#include <memory>
#include <span>

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::console {

namespace {

// A deleter that calls one of OpenSSL's functions.
template <auto release>
struct Releaser {
    template <class T>
    void operator()(T* object) const {
        release(object);
    }
};
using PrivateKey = std::unique_ptr<EVP_PKEY, Releaser<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Releaser<X509_free>>;
using Memory = std::unique_ptr<BIO, Releaser<BIO_free>>;

constexpr const char* kAuthorityName = "Aquarama console authority";
// Certificates are valid from a day ago: the clock of a tablet may be slow.
constexpr long kDaySeconds = 86400;

// Of OpenSSL's functions, which fail for lack of memory only.
void require(bool isDone) {
    if (!isDone) throw Error("OpenSSL cannot make a certificate; see that its version is 3");
}

// All that was written into a memory of OpenSSL.
std::string textOf(BIO* memory) {
    const char* begin = nullptr;
    const long count = BIO_get_mem_data(memory, &begin);
    return {begin, static_cast<std::size_t>(count)};
}

// For its owner alone, whole or not at all.
void write(const std::filesystem::path& path, const std::string& text) {
    writeWhole(path, std::as_bytes(std::span(text)));
    std::filesystem::permissions(
        path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

// Without a pass phrase: the console starts without a person.
void writeKey(const std::filesystem::path& path, EVP_PKEY* key) {
    const Memory memory(BIO_new(BIO_s_mem()));
    require(PEM_write_bio_PrivateKey(memory.get(), key, nullptr, nullptr, 0, nullptr, nullptr) ==
            1);
    write(path, textOf(memory.get()));
}

// As PEM, which browsers and tablets install.
void writeCertificate(const std::filesystem::path& path, X509* certificate) {
    const Memory memory(BIO_new(BIO_s_mem()));
    require(PEM_write_bio_X509(memory.get(), certificate) == 1);
    write(path, textOf(memory.get()));
}

// Throws Error where the file cannot be read; null where it holds no such object.
template <class Read>
auto readPem(const std::filesystem::path& path, Read read) {
    constexpr std::uintmax_t kMostBytes = 64U << 10U;
    const auto bytes = readWhole(path, kMostBytes);
    const Memory memory(BIO_new_mem_buf(bytes.data(), static_cast<int>(bytes.size())));
    return read(memory.get(), nullptr, nullptr, nullptr);
}

// One extension of version 3, as OpenSSL's configuration files write it.
void extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
    X509V3_CTX context;
    X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
    X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
    require(extension != nullptr);
    X509_add_ext(certificate, extension, -1);
    X509_EXTENSION_free(extension);
}

// Without extensions and signature.
Certificate begin(const std::string& name, EVP_PKEY* key, long days) {
    Certificate certificate(X509_new());
    std::array<unsigned char, 16> serial{};
    require(RAND_bytes(serial.data(), static_cast<int>(serial.size())) == 1);
    serial[0] &= 0x7FU;
    BIGNUM* number = BN_bin2bn(serial.data(), static_cast<int>(serial.size()), nullptr);
    BN_to_ASN1_INTEGER(number, X509_get_serialNumber(certificate.get()));
    BN_free(number);
    X509_set_version(certificate.get(), X509_VERSION_3);
    X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kDaySeconds);
    X509_gmtime_adj(X509_getm_notAfter(certificate.get()), days * kDaySeconds);
    X509_set_pubkey(certificate.get(), key);
    X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()),
                               "CN",
                               MBSTRING_UTF8,
                               reinterpret_cast<const unsigned char*>(name.c_str()),
                               -1,
                               -1,
                               0);
    return certificate;
}

// It signs certificates of consoles, and no further authorities.
void makeAuthority(const CertificateFiles& files) {
    constexpr long kYears = 10, kDaysOfYear = 365;
    const PrivateKey key(EVP_EC_gen("P-256"));
    require(key != nullptr);
    const Certificate own = begin(kAuthorityName, key.get(), kYears * kDaysOfYear);
    X509_set_issuer_name(own.get(), X509_get_subject_name(own.get()));
    extend(own.get(), own.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
    extend(own.get(), own.get(), NID_key_usage, "critical,keyCertSign,cRLSign");
    extend(own.get(), own.get(), NID_subject_key_identifier, "hash");
    require(X509_sign(own.get(), key.get(), EVP_sha256()) > 0);
    writeKey(files.authorityKey, key.get());
    writeCertificate(files.authority, own.get());
}

// "IP:192.168.7.1,DNS:master.local"
std::string alternativeNames(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) {
        const bool isAddress = name.find_first_not_of("0123456789.") == std::string::npos ||
                               name.find(':') != std::string::npos;
        list += (list.empty() ? "" : ",") + std::string(isAddress ? "IP:" : "DNS:") + name;
    }
    return list;
}

}  // namespace

// The names that --listen looks for.
CertificateFiles certificateFilesIn(const std::filesystem::path& folder) {
    return {folder / "authority.pem",
            folder / "authority.key",
            folder / "certificate.pem",
            folder / "certificate.key"};
}

// A new key each time; the authority stays, so tablets need nothing new.
std::string makeCertificate(const CertificateFiles& files, const std::vector<std::string>& names) {
    if (!std::filesystem::exists(files.authority)) makeAuthority(files);
    const Certificate issuer(readPem(files.authority, PEM_read_bio_X509));
    const PrivateKey issuerKey(readPem(files.authorityKey, PEM_read_bio_PrivateKey));
    if (!issuer || !issuerKey)
        throw Error(files.authority.string() +
                    ": is damaged; remove it, and install the new one on all tablets");
    constexpr long kDays = 397;
    const PrivateKey key(EVP_EC_gen("P-256"));
    require(key != nullptr);
    const Certificate own = begin("Aquarama console", key.get(), kDays);
    X509_set_issuer_name(own.get(), X509_get_subject_name(issuer.get()));
    extend(own.get(), issuer.get(), NID_basic_constraints, "critical,CA:FALSE");
    extend(own.get(), issuer.get(), NID_key_usage, "critical,digitalSignature");
    extend(own.get(), issuer.get(), NID_ext_key_usage, "serverAuth");
    extend(own.get(), issuer.get(), NID_subject_alt_name, alternativeNames(names));
    require(X509_sign(own.get(), issuerKey.get(), EVP_sha256()) > 0);
    writeKey(files.key, key.get());
    writeCertificate(files.certificate, own.get());

    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    X509_digest(issuer.get(), EVP_sha256(), digest.data(), &size);
    std::string print;
    for (unsigned i = 0; i < size; ++i)
        print += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest.at(i));
    return print;
}

}  // namespace aquarama::console
