// SPDX-License-Identifier: Apache-2.0
#include "console/certificate.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>
#include <span>
#include <utility>

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

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
// Of a console's certificate, and of the authority: 397 days, and ten years.
constexpr double kLeafSeconds = 397 * kSecondsOfDay;
constexpr double kAuthoritySeconds = 3650 * kSecondsOfDay;
// How long before its end a certificate is renewed.
constexpr double kRenewSeconds = 31 * kSecondsOfDay;

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
void writePrivateText(const std::filesystem::path& path, const std::string& text) {
    writePrivate(path, std::as_bytes(std::span(text)));
}

// Without a pass phrase: the console starts without a person.
void writeKey(const std::filesystem::path& path, EVP_PKEY* key) {
    const Memory memory(BIO_new(BIO_s_mem()));
    require(PEM_write_bio_PrivateKey(memory.get(), key, nullptr, nullptr, 0, nullptr, nullptr) ==
            1);
    writePrivateText(path, textOf(memory.get()));
}

// As PEM, which browsers and tablets install.
void writeCertificate(const std::filesystem::path& path, X509* certificate) {
    const Memory memory(BIO_new(BIO_s_mem()));
    require(PEM_write_bio_X509(memory.get(), certificate) == 1);
    writePrivateText(path, textOf(memory.get()));
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

// Without extensions and signature. It is valid from a day ago: the clock of a tablet may be slow.
Certificate begin(const std::string& name, EVP_PKEY* key, const Validity& validity) {
    Certificate certificate(X509_new());
    std::array<unsigned char, 16> serial{};
    require(RAND_bytes(serial.data(), static_cast<int>(serial.size())) == 1);
    serial[0] &= 0x7FU;
    BIGNUM* number = BN_bin2bn(serial.data(), static_cast<int>(serial.size()), nullptr);
    BN_to_ASN1_INTEGER(number, X509_get_serialNumber(certificate.get()));
    BN_free(number);
    X509_set_version(certificate.get(), X509_VERSION_3);
    ASN1_TIME_set(X509_getm_notBefore(certificate.get()),
                  static_cast<std::time_t>(validity.from - kSecondsOfDay));
    ASN1_TIME_set(X509_getm_notAfter(certificate.get()), static_cast<std::time_t>(validity.until));
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
void makeAuthority(const CertificateFiles& files, UnixSeconds now) {
    const PrivateKey key(EVP_EC_gen("P-256"));
    require(key != nullptr);
    const Certificate own = begin(kAuthorityName, key.get(), {now, now + kAuthoritySeconds});
    X509_set_issuer_name(own.get(), X509_get_subject_name(own.get()));
    extend(own.get(), own.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
    extend(own.get(), own.get(), NID_key_usage, "critical,keyCertSign,cRLSign");
    extend(own.get(), own.get(), NID_subject_key_identifier, "hash");
    require(X509_sign(own.get(), key.get(), EVP_sha256()) > 0);
    writeKey(files.authorityKey, key.get());
    writeCertificate(files.authority, own.get());
}

// The authority with what it signs by.
struct Issuer {
    Certificate certificate;
    PrivateKey key;
};

// Throws Error where it is elsewhere or damaged.
Issuer issuerIn(const CertificateFiles& files) {
    std::error_code none;
    if (!std::filesystem::exists(files.authorityKey, none))
        throw Error(files.authorityKey.string() +
                    ": the authority's key is not there; put it back, or make another authority "
                    "(--certify ADDRESS --new-authority) and install that on all tablets");
    Issuer issuer{Certificate(readPem(files.authority, PEM_read_bio_X509)),
                  PrivateKey(readPem(files.authorityKey, PEM_read_bio_PrivateKey))};
    if (!issuer.certificate || !issuer.key)
        throw Error(files.authority.string() +
                    ": is damaged; make another (--certify ADDRESS --new-authority), and install "
                    "it on all tablets");
    return issuer;
}

// From now on; never longer than its issuer.
Validity leafValidity(UnixSeconds now, UnixSeconds authorityUntil) {
    return {now, std::min(now + kLeafSeconds, authorityUntil)};
}

// A certificate of a console for the holder of this key, without names and signature.
Certificate leafOf(const Issuer& issuer, EVP_PKEY* key, const Validity& validity) {
    Certificate own = begin("Aquarama console", key, validity);
    X509_set_issuer_name(own.get(), X509_get_subject_name(issuer.certificate.get()));
    extend(own.get(), issuer.certificate.get(), NID_basic_constraints, "critical,CA:FALSE");
    extend(own.get(), issuer.certificate.get(), NID_key_usage, "critical,digitalSignature");
    extend(own.get(), issuer.certificate.get(), NID_ext_key_usage, "serverAuth");
    return own;
}

// The same names and key for another while: what tablets know stays valid.
void renewCertificate(const CertificateFiles& files, UnixSeconds now) {
    const Issuer issuer = issuerIn(files);
    const Certificate old(readPem(files.certificate, PEM_read_bio_X509));
    require(old != nullptr);
    const Certificate fresh = leafOf(
        issuer, X509_get0_pubkey(old.get()), leafValidity(now, validityOf(files.authority).until));
    const int names = X509_get_ext_by_NID(old.get(), NID_subject_alt_name, -1);
    require(names >= 0 && X509_add_ext(fresh.get(), X509_get_ext(old.get(), names), -1) == 1);
    require(X509_sign(fresh.get(), issuer.key.get(), EVP_sha256()) > 0);
    writeCertificate(files.certificate, fresh.get());
}

// Whether the authority beside it has signed it. False where there is none.
bool isSignedByAuthority(const CertificateFiles& files) {
    std::error_code none;
    if (!std::filesystem::exists(files.authority, none)) return false;
    const Certificate own(readPem(files.certificate, PEM_read_bio_X509));
    const Certificate authority(readPem(files.authority, PEM_read_bio_X509));
    return own && authority && X509_check_issued(authority.get(), own.get()) == X509_V_OK &&
           X509_verify(own.get(), X509_get0_pubkey(authority.get())) == 1;
}

// SHA-256, as tablets show it.
std::string fingerprintOf(X509* certificate) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    X509_digest(certificate, EVP_sha256(), digest.data(), &size);
    std::string print;
    for (unsigned i = 0; i < size; ++i)
        print += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest.at(i));
    return print;
}

// One that is over or not yet valid serves nobody.
bool isAuthorityOver(const CertificateFiles& files, UnixSeconds now) {
    std::error_code none;
    if (!std::filesystem::exists(files.authority, none)) return true;
    const Validity validity = validityOf(files.authority);
    return now < validity.from || now > validity.until;
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

// A new key each time; the authority stays as long as it can, so tablets need nothing new.
MadeCertificate makeCertificate(const CertificateFiles& files,
                                const std::vector<std::string>& names,
                                const CertificateClock& clock,
                                bool takesNewAuthority) {
    if (const std::string doubt = clockDoubt(clock.now, clock.built); !doubt.empty())
        throw Error(doubt + ": no certificate is made now; " + kSetTheClock);
    MadeCertificate made;
    made.isNewAuthority = takesNewAuthority || isAuthorityOver(files, clock.now);
    if (made.isNewAuthority) makeAuthority(files, clock.now);
    const Issuer issuer = issuerIn(files);
    const PrivateKey key(EVP_EC_gen("P-256"));
    require(key != nullptr);
    const Validity validity = leafValidity(clock.now, validityOf(files.authority).until);
    const Certificate own = leafOf(issuer, key.get(), validity);
    extend(own.get(), issuer.certificate.get(), NID_subject_alt_name, alternativeNames(names));
    require(X509_sign(own.get(), issuer.key.get(), EVP_sha256()) > 0);
    writeKey(files.key, key.get());
    writeCertificate(files.certificate, own.get());
    made.fingerprint = fingerprintOf(issuer.certificate.get());
    made.until = validity.until;
    return made;
}

CertificateKeeper::CertificateKeeper(CertificateFiles files, std::string certify, UnixSeconds built)
    : files_{std::move(files)}, certify_{std::move(certify)}, built_{built} {
    read();
}

// Zeros where a file is not there at the moment.
CertificateKeeper::Stamp CertificateKeeper::look() const {
    Stamp stamp{};
    std::size_t at = 0;
    for (const auto& path : {files_.certificate, files_.key}) {
        struct stat found {};
        if (stat(path.c_str(), &found) == 0) {
            constexpr std::int64_t kNanoseconds = 1'000'000'000;
            stamp.at(at) = found.st_ctim.tv_sec * kNanoseconds + found.st_ctim.tv_nsec;
            stamp.at(at + 1) = static_cast<std::int64_t>(found.st_ino);
        }
        at += 2;
    }
    return stamp;
}

// Throws Error where the certificate or the authority cannot be read.
void CertificateKeeper::read() {
    validity_ = validityOf(files_.certificate);
    std::error_code none;
    authority_.reset();
    if (std::filesystem::exists(files_.authority, none)) authority_ = validityOf(files_.authority);
    isOurs_ = isSignedByAuthority(files_);
}

// Only where another would last longer: near its own end the authority can give no more. By a clock
// that is wrong nothing is made.
bool CertificateKeeper::isDue(UnixSeconds now) const {
    if (!isOurs_ || !clockDoubt(now, built_).empty()) return false;
    if (now > authority_->until || now < authority_->from) return false;
    if (now < validity_.from) return true;
    const UnixSeconds next = leafValidity(now, authority_->until).until;
    return validity_.until - now < kRenewSeconds && next > validity_.until + kSecondsOfDay;
}

// What fails is tried again an hour later.
bool CertificateKeeper::tend(UnixSeconds now) {
    constexpr int kCallsBetweenTries = 360;
    try {
        if (look() != stamp_) read();
        if (callsToNextTry_ > 0) --callsToNextTry_;
        if (isDue(now) && callsToNextTry_ == 0) {
            callsToNextTry_ = kCallsBetweenTries;
            renewCertificate(files_, now);
            read();
            whyNotRenewed_.clear();
            callsToNextTry_ = 0;
            logInfo("the console's certificate is renewed until {}", dayOf(validity_.until));
        }
    } catch (const std::exception& problem) {
        whyNotRenewed_ = problem.what();
    }
    return look() != stamp_;
}

void CertificateKeeper::taken() {
    stamp_ = look();
    whyNotTaken_.clear();
}

// Between two files that are put there one after the other they may not fit.
void CertificateKeeper::refused(const std::string& why) {
    whyNotTaken_ = why;
}

// The key of a fault changes with its urgency, so that one that was acknowledged fires anew.
std::vector<Fault> CertificateKeeper::faults(UnixSeconds now) {
    constexpr double kBetweenTwoFiles = 60;
    std::vector<Fault> faults;
    if (!whyNotTaken_.empty())
        faults.push_back({"certificate files", whyNotTaken_, kBetweenTwoFiles});
    if (!clockDoubt(now, built_).empty()) return faults;  // tells nothing of their ends
    const auto add = [&](const std::string& what,
                         const Validity& validity,
                         double noticeDays,
                         const std::string& todo) {
        const auto concern = concernAbout(validity, now, noticeDays);
        if (!concern) return;
        const std::string degree = now > validity.until ? " over"
                                   : concern->isUrgent  ? " urgent"
                                                        : " soon";
        faults.push_back({what + degree, "the console's " + what + " " + concern->what + todo, 0});
    };
    const std::string by =
        !isOurs_ ? "; it is not of this rig's authority: put a newer one in its place (" +
                       files_.certificate.string() + "), or make one: " + certify_
        : whyNotRenewed_.empty() ? "; make another: " + certify_
                                 : "; it cannot be renewed: " + whyNotRenewed_;
    add("certificate", validity_, kCertificateNoticeDays, by);
    if (isOurs_)
        add("authority",
            *authority_,
            kAuthorityNoticeDays,
            "; make another and install it on each tablet: " + certify_ + " --new-authority");
    std::string line;
    for (const Fault& fault : faults) line += (line.empty() ? "" : "; ") + fault.text;
    if (std::exchange(logged_, line) != line && !line.empty()) logWarning("{}", line);
    return faults;
}

}  // namespace aquarama::console
