// SPDX-License-Identifier: Apache-2.0
// A signed release is taken as it was signed; what was changed, cut, left out, added, renamed or
// signed by others is refused by a line that names release and file.
#include "releases/release.h"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "releases/signing.h"
#include "tests/support/refusal.h"

namespace aquarama::releases {
namespace {

namespace fs = std::filesystem;
using test::refusalOf;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) {
    writeWhole(file, std::as_bytes(std::span(text)));
}

std::string textOf(const fs::path& file) {
    const auto bytes = readWhole(file, kMostListBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class SignedRelease : public testing::Test {
  protected:
    SignedRelease() {
        write(folder_ / "vmlinuz", "kernel");
        write(folder_ / "initrd.img", "first files");
        write(folder_ / "filesystem.squashfs", std::string(3'000'000, 's'));
        signRelease(folder_, 7, keys_.secretPem, "show.key");
    }
    [[nodiscard]] std::string refusal(const ShowKey& key) const {
        return refusalOf([&] { checkRelease(folder_, key); });
    }
    [[nodiscard]] std::string refusal() const { return refusal(key_); }

    TemporaryFolder temporary_{"release_test"};
    fs::path folder_ = temporary_.path() / "1.4.0";
    SigningKeys keys_ = makeSigningKeys();
    ShowKey key_{keys_.publicPem, "show.key.pub"};
};

TEST_F(SignedRelease, isTakenAsItWasSigned) {
    const ReleaseContent release = checkRelease(folder_, key_);
    EXPECT_EQ(release.id, (ReleaseId{"1.4.0", 7}));
    EXPECT_EQ(release.files.size(), 3U);
    EXPECT_EQ(idIn(folder_), release.id);
    EXPECT_EQ(checkRelease(folder_ / "", key_).id, release.id);  // with a slash at its end
}

TEST_F(SignedRelease, isReadByTheToolsOfTheSystem) {
    write(temporary_.path() / "show.pub", keys_.publicPem);
    const std::string in = "cd " + folder_.string() + " && ";
    EXPECT_EQ(std::system((in + "sha256sum --quiet --strict -c SHA256SUMS").c_str()), 0);
    const std::string verify =
        "openssl pkeyutl -verify -pubin -inkey ../show.pub -rawin -in SHA256SUMS -sigfile "
        "SHA256SUMS.sig >/dev/null";
    EXPECT_EQ(std::system((in + verify).c_str()), 0);
}

TEST_F(SignedRelease, isRefusedWhereAnyFileWasChanged) {
    for (const char* name : {"vmlinuz", "initrd.img", "filesystem.squashfs"}) {
        const auto whole = readWhole(folder_ / name, 4'000'000);
        auto changed = whole;
        changed.back() ^= std::byte{1};
        writeWhole(folder_ / name, changed);
        EXPECT_THAT(refusal(), HasSubstr(std::string("release 1.4.0: ") + name + " in "));
        writeWhole(folder_ / name, std::span(whole).first(whole.size() - 1));
        EXPECT_THAT(refusal(), HasSubstr("was changed or cut"));
        fs::remove(folder_ / name);
        EXPECT_THAT(refusal(), HasSubstr(std::string("release 1.4.0: ") + name + " is missing"));
        writeWhole(folder_ / name, whole);
    }
    EXPECT_EQ(refusal(), "");
}

TEST_F(SignedRelease, isRefusedWithMoreThanWasSigned) {
    write(folder_ / "more", "");
    EXPECT_THAT(refusal(), HasSubstr("release 1.4.0: more in "));
    fs::remove(folder_ / "more");
    fs::create_directory(folder_ / "folder");
    EXPECT_THAT(refusal(), HasSubstr("plain files only"));
    fs::remove(folder_ / "folder");
    fs::create_symlink("vmlinuz", folder_ / "link");
    EXPECT_THAT(refusal(), HasSubstr("plain files only"));
}

// Each byte of the list and of its signature.
TEST_F(SignedRelease, isRefusedWhereListOrSignatureWasChanged) {
    for (const char* name : {kListFile, kSignatureFile}) {
        const auto whole = readWhole(folder_ / name, kMostListBytes);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            auto changed = whole;
            changed[i] ^= std::byte{1};
            const bool isList = name == std::string(kListFile);
            const auto list = readWhole(folder_ / kListFile, kMostListBytes);
            const auto signature = readWhole(folder_ / kSignatureFile, kMostSignatureBytes);
            EXPECT_FALSE(isSignedBy(
                key_.pem, isList ? changed : list, isList ? signature : changed, key_.source));
        }
        writeWhole(folder_ / name, std::span(whole).first(whole.size() / 2));
        EXPECT_THAT(refusal(), HasSubstr("is not signed by the key of this show, show.key.pub"));
        fs::remove(folder_ / name);
        EXPECT_THAT(refusal(), HasSubstr(std::string("release 1.4.0: ") + name + " is missing"));
        writeWhole(folder_ / name, whole);
    }
}

TEST_F(SignedRelease, isRefusedWhereAnotherKeyHasSignedIt) {
    EXPECT_THAT(refusal({makeSigningKeys().publicPem, "other.pub"}),
                HasSubstr("is not signed by the key of this show, other.pub"));
    EXPECT_THAT(refusal({"no key", "other.pub"}), HasSubstr("other.pub: is no public key"));
    EXPECT_THAT(refusal({keys_.secretPem, "show.key"}), HasSubstr("show.key: is no public key"));
}

TEST_F(SignedRelease, isRefusedUnderAnotherName) {
    const fs::path other = temporary_.path() / "1.5.0";
    fs::rename(folder_, other);
    EXPECT_THAT(refusalOf([&] { checkRelease(other, key_); }),
                HasSubstr("release 1.4.0: stands in a folder of another name"));
}

TEST_F(SignedRelease, isRefusedWhereItIsOlder) {
    const ReleaseContent release = checkRelease(folder_, key_);
    EXPECT_EQ(refusalOf([&] { requireSerial(release, 7); }), "");
    EXPECT_THAT(refusalOf([&] { requireSerial(release, 8); }),
                HasSubstr("release 1.4.0: is older (serial 7) than serial 8"));
}

// The list says what a peer may make us write: no path leads out of the folder.
TEST_F(SignedRelease, isRefusedWhereItsListIsNone) {
    const std::string list = textOf(folder_ / kListFile);
    const std::string line = list.substr(list.find('\n') + 1);
    const auto signedAs = [&](const std::string& text) {
        const auto bytes = std::as_bytes(std::span(text));
        const auto signature = signatureOf(bytes, keys_.secretPem, "show.key");
        return refusalOf(
            [&] { static_cast<void>(signedList(bytes, signature, key_, "SHA256SUMS")); });
    };
    const std::string head = "# aquarama release 1.4.0 7\n", hex = line.substr(0, 64);
    EXPECT_EQ(signedAs(head + hex + "  vmlinuz\n"), "");
    for (const std::string& text : {std::string(),
                                    head,
                                    head + hex + "  vmlinuz",
                                    head + hex + "  ../vmlinuz\n",
                                    head + hex + "  .hidden\n",
                                    head + hex + "  SHA256SUMS\n",
                                    head + hex + " vmlinuz\n",
                                    head + hex.substr(1) + "  vmlinuz\n",
                                    head + "g" + hex.substr(1) + "  vmlinuz\n",
                                    head + hex + "  vmlinuz\n" + hex + "  vmlinuz\n",
                                    "# aquarama release 1.4.0\n" + hex + "  vmlinuz\n",
                                    "# aquarama release 1+4 7\n" + hex + "  vmlinuz\n",
                                    "# aquarama release 1.4.0 -7\n" + hex + "  vmlinuz\n",
                                    hex + "  vmlinuz\n"})
        EXPECT_THAT(signedAs(text), HasSubstr("is no list of a release")) << text;
}

TEST(Signing, refusesWhatIsNoRelease) {
    const TemporaryFolder folder("release_test");
    const SigningKeys keys = makeSigningKeys();
    const auto refusal = [&](const fs::path& path, const std::string& key) {
        return refusalOf([&] { signRelease(path, 1, key, "show.key"); });
    };
    fs::create_directory(folder.path() / "1.0");
    EXPECT_THAT(refusal(folder.path() / "1.0", keys.secretPem), HasSubstr("has no files"));
    EXPECT_THAT(refusal(folder.path() / "2.0", keys.secretPem), HasSubstr("is no folder"));
    write(folder.path() / "1.0/a", "a");
    write(folder.path() / "1.0+1/a", "a");
    EXPECT_THAT(refusal(folder.path() / "1.0+1", keys.secretPem), HasSubstr("rename it"));
    EXPECT_THAT(refusal(folder.path() / "1.0", keys.publicPem),
                HasSubstr("show.key: is no secret"));
}

}  // namespace
}  // namespace aquarama::releases
