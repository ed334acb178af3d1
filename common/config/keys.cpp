// SPDX-License-Identifier: Apache-2.0
#include "common/config/keys.h"

#include <algorithm>
#include <span>

#include <google/protobuf/text_format.h>
#include <sys/stat.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/keys.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

namespace fs = std::filesystem;

static_assert(v1::KeyFile::STANDBY - v1::KeyFile::MASTER == static_cast<int>(KeyRole::Standby));

constexpr std::uint32_t kKeysVersion = 1;
constexpr std::string_view kEnding = ".key";
constexpr std::size_t kKeyLength = 40;
constexpr std::string_view kZ85 =
    "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?&<>()[]{}@%$#";

void checkKey(const TextReader& file,
              const v1::KeyFile& in,
              const std::string& field,
              const std::string& key) {
    if (key.size() == kKeyLength && key.find_first_not_of(kZ85) == std::string::npos) return;
    file.refuse(in, field, field + " is no key of 40 characters: copy the file again");
}

}  // namespace

void requirePrivate(const fs::path& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && (status.st_mode & 077U) != 0)
        throw Error(path.string() +
                    ": others than its owner may read this key: chmod 600 it, and " +
                    "make a new one (aquarama keys rotate) if somebody may have");
}

KeyFile readKeyFile(const fs::path& path) {
    requirePrivate(path);
    return parseKeyFile(readTextFile(path.string()), path.string());
}

KeyFile readOwnKey(const fs::path& path) {
    KeyFile key = readKeyFile(path);
    if (key.secretKey.empty())
        throw Error(path.string() + ": another machine was given \"" + key.name +
                    "\" and alone has its secret; nobody takes part with this file: make a new " +
                    "key (aquarama keys rotate)");
    return key;
}

KeyFile parseKeyFile(const std::string& text, const std::string& source) {
    v1::KeyFile in;
    TextReader file(text, source, in);
    file.check();
    checkKey(file, in, "master_key", in.master_key());
    checkKey(file, in, "public_key", in.public_key());
    if (in.has_secret_key() || in.role() != v1::KeyFile::NODE)
        checkKey(file, in, "secret_key", in.secret_key());
    return {.rig = in.rig(),
            .masterAddress = in.master_address(),
            .masterKey = in.master_key(),
            .name = in.name(),
            .role = static_cast<KeyRole>(in.role() - v1::KeyFile::MASTER),
            .publicKey = in.public_key(),
            .secretKey = in.secret_key(),
            .made = in.made(),
            .revoked = in.revoked(),
            .depotAddress = in.depot_address()};
}

std::string textOf(const KeyFile& key) {
    v1::KeyFile out;
    out.set_version(kKeysVersion);
    out.set_rig(key.rig);
    out.set_master_address(key.masterAddress);
    out.set_master_key(key.masterKey);
    out.set_name(key.name);
    out.set_role(static_cast<v1::KeyFile::Role>(static_cast<int>(key.role) + v1::KeyFile::MASTER));
    out.set_public_key(key.publicKey);
    if (!key.secretKey.empty()) out.set_secret_key(key.secretKey);
    out.set_made(key.made);
    if (!key.revoked.empty()) out.set_revoked(key.revoked);
    if (!key.depotAddress.empty()) out.set_depot_address(key.depotAddress);
    std::string text;
    google::protobuf::TextFormat::PrintToString(out, &text);
    const std::string head = key.secretKey.empty()
                                 ? "# Public: its node alone has the secret of " + key.name
                                 : "# Secret: whoever holds this file takes part as " + key.name;
    return head + ".\n" + text;
}

void writeKeyFile(const fs::path& path, const KeyFile& key) {
    const std::string text = textOf(key);
    writePrivate(path, std::as_bytes(std::span(text)));
}

fs::path keyFolderOf(const std::string& rigPath) {
    return userFolder("XDG_CONFIG_HOME", ".config") / "keys" / fs::path(rigPath).stem();
}

fs::path keyFolderOf(const std::string& rigPath, const std::string& chosen) {
    return chosen.empty() ? keyFolderOf(rigPath) : fs::path(chosen);
}

fs::path keyFileIn(const fs::path& folder, std::string_view name) {
    return folder / (std::string(name) + std::string(kEnding));
}

std::vector<KeyFile> readKeyFolder(const fs::path& folder) {
    std::vector<KeyFile> keys;
    std::error_code missing;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
        if (entry.path().extension() == kEnding) keys.push_back(readKeyFile(entry.path()));
    std::ranges::sort(keys, {}, &KeyFile::name);
    return keys;
}

}  // namespace aquarama::config
