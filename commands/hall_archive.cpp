// SPDX-License-Identifier: Apache-2.0
#include "commands/hall_archive.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/base/seal.h"
#include "common/config/hours.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;
using formats::Archive;
using formats::ArchiveFile;
using nlohmann::json;

constexpr int kVersion = 1;
// Entries of the archive: what it is, the files of the hall, and the sealed archive.
constexpr const char* kAbout = "hall.json";
constexpr const char* kFiles = "files/";
constexpr const char* kSeal = "secrets.sealed";
// Of the sealed one, beside the secrets: the SHA-256 of each entry outside.
constexpr const char* kDigests = "digests.json";

std::vector<std::byte> bytesOf(const json& object) {
    const std::string text = object.dump(2) + "\n";
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// An object; empty where the bytes are anything else.
json jsonOf(std::span<const std::byte> bytes) {
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    json object = json::parse(text, text + bytes.size(), nullptr, false);
    return object.is_object() ? object : json::object();
}

// The SHA-256 of each file, by its name.
json digestsOf(const std::vector<ArchiveFile>& files) {
    json digests = json::object();
    for (const auto& [name, bytes] : files) digests[name] = toHex(digestOf(bytes));
    return digests;
}

// Throws Error where it is no hall, or one of a version that is not read.
std::string rigIn(const json& about, const std::string& source) {
    const auto version = about.find("version");
    const auto rig = about.find("rig");
    if (version == about.end() || !version->is_number_integer())
        throw Error(source + ": is no hall; give a file that aquarama hall export has written");
    if (*version != kVersion || rig == about.end() || !rig->is_string())
        throw Error(
            fmt::format("{}: is a hall of version {}, and this program reads {}; export it "
                        "by the same release",
                        source,
                        version->dump(),
                        kVersion));
    return rig->get<std::string>();
}

[[noreturn]] void refuseEntry(const std::string& source, const std::string& name) {
    throw Error(fmt::format("{}: has an entry \"{}\", which no hall has; export it anew",
                            source,
                            formats::printable(name)));
}

// Whether a name leads to a file below the folder that it is joined to.
bool staysInside(const std::string& name) {
    const fs::path path(name);
    return !name.empty() && path.is_relative() && path.lexically_normal().string() == name &&
           *path.begin() != "..";
}

// Whether a hall has secrets of this name.
bool isSecret(std::string_view name) {
    if (name == config::kHoursFile) return true;
    return std::ranges::any_of(std::array{kKeysOfHall, kDrawingsOfHall}, [&](std::string_view in) {
        return name.starts_with(in) && name.size() > in.size() &&
               name.find('/', in.size()) == std::string_view::npos;
    });
}

// All entries but the seal.
std::vector<ArchiveFile> openEntriesOf(Archive& archive) {
    std::vector<ArchiveFile> entries;
    for (const std::string& name : archive.names())
        if (name != kSeal) entries.emplace_back(name, archive.read(name));
    return entries;
}

// The files of a hall's folder, without the folder that they have in the archive.
std::vector<ArchiveFile> filesIn(std::vector<ArchiveFile> entries, const std::string& source) {
    std::vector<ArchiveFile> files;
    for (ArchiveFile& entry : entries) {
        if (entry.first == kAbout) continue;
        const bool isFile = entry.first.starts_with(kFiles);
        std::string inside = isFile ? entry.first.substr(std::string_view(kFiles).size()) : "";
        if (!staysInside(inside)) refuseEntry(source, entry.first);
        files.emplace_back(std::move(inside), std::move(entry.second));
    }
    return files;
}

// Throws Error where an entry is not as it was when the hall was sealed.
void compareDigests(const json& found, const json& known, const std::string& source) {
    const auto other = [&](const json& one, const json& than) {
        for (const auto& [name, digest] : one.items())
            if (!than.contains(name) || than[name] != digest) return name;
        return std::string();
    };
    const std::string lost = other(known, found), added = other(found, known);
    const std::string name = lost.empty() ? added : lost;
    if (!name.empty())
        throw Error(
            fmt::format("{}: its entry \"{}\" is not as it was sealed; copy or export it "
                        "anew",
                        source,
                        formats::printable(name)));
}

// Of a seal; throws Error where it does not fit the entries beside it.
std::vector<ArchiveFile> secretsIn(std::span<const std::byte> bytes,
                                   const json& digests,
                                   const std::string& source) {
    Archive archive(bytes, source);
    std::vector<ArchiveFile> secrets;
    json known = json::object();
    for (const std::string& name : archive.names()) {
        if (name != kDigests && !isSecret(name)) refuseEntry(source, name);
        if (name == kDigests)
            known = jsonOf(archive.read(name));
        else
            secrets.emplace_back(name, archive.read(name));
    }
    compareDigests(digests, known, source);
    return secrets;
}

}  // namespace

std::vector<std::byte> encodeHall(const TravellingHall& hall, const AskPassphrase& ask) {
    std::vector<ArchiveFile> entries;
    entries.emplace_back(kAbout, bytesOf({{"version", kVersion}, {"rig", hall.rig}}));
    for (const auto& [name, bytes] : hall.files) entries.emplace_back(kFiles + name, bytes);
    if (!hall.secrets.empty()) {
        std::vector<ArchiveFile> secrets = hall.secrets;
        secrets.emplace_back(kDigests, bytesOf(digestsOf(entries)));
        entries.emplace_back(kSeal, sealed(formats::encodeArchive(secrets), ask()));
    }
    std::vector<std::byte> bytes = formats::encodeArchive(entries);
    if (bytes.size() > kMostHallBytes)
        throw Error("the hall has more than a gigabyte; leave the drawings out");
    return bytes;
}

TravellingHall decodeHall(std::span<const std::byte> bytes,
                          const std::string& source,
                          const AskPassphrase& ask) {
    Archive archive(bytes, source);
    const bool isHall = archive.find(kAbout) == kAbout;
    TravellingHall hall;
    hall.rig = rigIn(isHall ? jsonOf(archive.read(kAbout)) : json::object(), source);
    std::vector<ArchiveFile> entries = openEntriesOf(archive);
    if (archive.find(kSeal) == kSeal) {
        const std::vector<std::byte> seal = archive.read(kSeal);
        hall.secrets = secretsIn(unsealed(seal, ask(), source), digestsOf(entries), source);
    }
    hall.files = filesIn(std::move(entries), source);
    if (std::ranges::find(hall.files, hall.rig, &ArchiveFile::first) == hall.files.end())
        throw Error(source + ": lacks its rig " + formats::printable(hall.rig) +
                    "; copy or export it anew");
    return hall;
}

}  // namespace aquarama
