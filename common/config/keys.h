// SPDX-License-Identifier: Apache-2.0
// The keys of a wall: one file for its master, each channel and each role of people (keys.proto).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace aquarama::config {

// What the holder of a key may say to the master (conductor::maySay()); in the schema's order.
enum class KeyRole : std::uint8_t {
    Master,
    Node,
    Watcher,
    Visitor,
    Operator,
    Crew,
    Guests,
    Standby
};
// As command lines, logs and key files name them.
inline constexpr std::array<std::string_view, 8> kRoleNames{
    "master", "node", "watcher", "visitor", "operator", "crew", "guests", "standby"};
[[nodiscard]] constexpr std::string_view nameOf(KeyRole role) {
    return kRoleNames.at(static_cast<std::size_t>(role));
}

// Keys are Z85 text of 40 characters.
struct KeyFile {
    std::string rig;            // name of the rig's file without its ending
    std::string masterAddress;  // control, tcp://HOST:PORT
    std::string masterKey;      // public
    std::string name;           // of the channel; "master"; or of the role
    KeyRole role = KeyRole::Watcher;
    std::string publicKey, secretKey;  // the latter is empty where only the holder has it
    std::string made, revoked;         // days, 2026-11-23; revoked is empty while the key is valid
    std::string depotAddress = {};     // of releases; empty: the rig has none
};

// Throws Error where it cannot be read, is malformed, or others than its owner may read it.
[[nodiscard]] KeyFile readKeyFile(const std::filesystem::path& path);
// The key with which this process takes part. Throws Error also where the file has no secret.
[[nodiscard]] KeyFile readOwnKey(const std::filesystem::path& path);
[[nodiscard]] KeyFile parseKeyFile(const std::string& text, const std::string& source);
// Throws Error where others than its owner may read a secret.
void requirePrivate(const std::filesystem::path& path);
// As a file has it; parseKeyFile() reads it.
[[nodiscard]] std::string textOf(const KeyFile& key);
// Readable by its owner only, whole or not at all. Throws Error where it cannot be written.
void writeKeyFile(const std::filesystem::path& path, const KeyFile& key);

// Where the keys of a rig lie on the master's machine unless somebody says otherwise:
// aquarama/keys/RIG in the user's configuration folder.
[[nodiscard]] std::filesystem::path keyFolderOf(const std::string& rigPath);
// `chosen`, or that folder where it is empty.
[[nodiscard]] std::filesystem::path keyFolderOf(const std::string& rigPath,
                                                const std::string& chosen);
[[nodiscard]] std::filesystem::path keyFileIn(const std::filesystem::path& folder,
                                              std::string_view name);
// All key files of a folder, by name. Throws Error where one is malformed; empty where there is no
// such folder.
[[nodiscard]] std::vector<KeyFile> readKeyFolder(const std::filesystem::path& folder);

}  // namespace aquarama::config
