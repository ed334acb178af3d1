// SPDX-License-Identifier: Apache-2.0
#include "releases/release.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>

#include "common/base/files.h"
#include "common/base/log.h"
#include "releases/signing.h"

namespace aquarama::releases {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 64;
constexpr std::size_t kMostNameBytes = 64;
constexpr std::size_t kMostKeyBytes = 4096;
// The first line, which sha256sum takes for a comment, goes on with version and serial.
constexpr std::string_view kHead = "# aquarama release ";
constexpr std::size_t kHexDigits = 64;

bool isName(std::string_view text) {
    constexpr std::string_view kOthers = "._~-";
    constexpr std::string_view kAll =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._~-";
    return !text.empty() && text.size() <= kMostNameBytes &&
           kOthers.find(text.front()) == std::string_view::npos &&
           text.find_first_not_of(kAll) == std::string_view::npos;
}

bool isOwn(const std::string& name) {
    return name == kListFile || name == kSignatureFile;
}

// Of "D4": 212; nothing of other characters.
std::optional<Digest> digestIn(std::string_view hex) {
    Digest digest;
    if (hex.size() != kHexDigits) return std::nullopt;
    for (std::size_t i = 0; i < digest.bytes.size(); ++i) {
        const char* const at = hex.data() + 2 * i;
        const auto [end, error] = std::from_chars(at, at + 2, digest.bytes.at(i), 16);
        if (error != std::errc{} || end != at + 2) return std::nullopt;
    }
    return digest;
}

// "D4...  vmlinuz", as sha256sum writes it.
std::optional<ReleaseFile> fileIn(const std::string& line) {
    if (line.size() <= kHexDigits + 2 || line.substr(kHexDigits, 2) != "  ") return std::nullopt;
    const auto digest = digestIn(std::string_view(line).substr(0, kHexDigits));
    const std::string name = line.substr(kHexDigits + 2);
    if (!digest || !isName(name) || isOwn(name)) return std::nullopt;
    return ReleaseFile{name, *digest};
}

// Of "# aquarama release 1.4.0 1764384000".
std::optional<ReleaseId> idInLine(const std::string& line) {
    if (!line.starts_with(kHead)) return std::nullopt;
    const std::size_t space = line.rfind(' ');
    if (space < kHead.size()) return std::nullopt;
    ReleaseId id{line.substr(kHead.size(), space - kHead.size()), 0};
    const char* const end = line.data() + line.size();
    const auto [rest, error] = std::from_chars(line.data() + space + 1, end, id.serial);
    if (error != std::errc{} || rest != end || !isVersion(id.version)) return std::nullopt;
    return id;
}

// The lines after the first one, each with another name.
bool takeFiles(std::istream& lines, std::vector<ReleaseFile>& files) {
    std::set<std::string> names;
    for (std::string line; std::getline(lines, line);) {
        const auto file = fileIn(line);
        if (!file || !names.insert(file->name).second) return false;
        files.push_back(*file);
    }
    return !files.empty() && files.size() <= kMostFiles;
}

// Nothing where it is no list of a release.
std::optional<ReleaseContent> releaseIn(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const auto id = idInLine(line);
    if (!id || !text.ends_with('\n')) return std::nullopt;
    ReleaseContent release{*id, {}};
    if (!takeFiles(lines, release.files)) return std::nullopt;
    return release;
}

std::string textOf(const ReleaseContent& release) {
    std::string text =
        std::string(kHead) + release.id.version + " " + std::to_string(release.id.serial) + "\n";
    for (const ReleaseFile& file : release.files)
        text += toHex(file.digest) + "  " + file.name + "\n";
    return text;
}

std::string asText(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// "aquarama/1.4.0/" has no file name.
fs::path withoutSlash(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

bool isPlainFile(const fs::directory_entry& entry) {
    return entry.is_regular_file() && !entry.is_symlink() &&
           isName(entry.path().filename().string());
}

// The files of a folder but for list and signature, by name. Throws Error where it is no folder of
// plain files.
std::set<std::string> namesIn(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw Error(folder.string() + ": is no folder of a release; name the folder VERSION");
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (!isPlainFile(entry))
            throw Error(entry.path().string() +
                        ": a release has plain files only, named by letters, digits and . _ ~ -; "
                        "take it away");
        names.insert(entry.path().filename().string());
    }
    names.erase(kListFile);
    names.erase(kSignatureFile);
    return names;
}

// "release 1.4.0: vmlinuz "
std::string nameOf(const ReleaseId& id, const std::string& file) {
    return "release " + id.version + ": " + file + " ";
}

void requireFiles(const fs::path& folder, const ReleaseContent& release) {
    std::set<std::string> names = namesIn(folder);
    for (const ReleaseFile& file : release.files) {
        if (names.erase(file.name) == 0)
            throw Error(nameOf(release.id, file.name) + "is missing in " + folder.string() +
                        "; copy the release anew");
        if (digestOfFile(folder / file.name) != file.digest)
            throw Error(nameOf(release.id, file.name) + "in " + folder.string() +
                        " was changed or cut after it was signed; copy the release anew");
    }
    if (!names.empty())
        throw Error(nameOf(release.id, *names.begin()) + "in " + folder.string() +
                    " was added after it was signed; take it away");
}

}  // namespace

bool isVersion(std::string_view text) {
    return isName(text);
}

ReleaseContent signRelease(const fs::path& given,
                           std::uint64_t serial,
                           const std::string& secretPem,
                           const std::string& keySource) {
    const fs::path folder = withoutSlash(given);
    ReleaseContent release{{folder.filename().string(), serial}, {}};
    const std::set<std::string> names = namesIn(folder);
    if (!isVersion(release.id.version))
        throw Error(folder.string() +
                    ": its name is the version: letters, digits and . _ ~ - only; rename it");
    if (names.empty() || names.size() > kMostFiles)
        throw Error(folder.string() + ": has no files, or more than " + std::to_string(kMostFiles) +
                    "; name the folder of a release");
    for (const std::string& name : names)
        release.files.push_back({name, digestOfFile(folder / name)});
    const std::string text = textOf(release);
    const auto list = std::as_bytes(std::span(text));
    const std::vector<std::byte> signature = signatureOf(list, secretPem, keySource);
    writeWhole(folder / kListFile, list);
    writeWhole(folder / kSignatureFile, signature);
    return release;
}

ShowKey readShowKey(const fs::path& file) {
    return {asText(readWhole(file, kMostKeyBytes)), file.string()};
}

ReleaseContent signedList(std::span<const std::byte> list,
                          std::span<const std::byte> signature,
                          const ShowKey& key,
                          const std::string& source) {
    if (!isSignedBy(key.pem, list, signature, key.source))
        throw Error(source + ": is not signed by the key of this show, " + key.source +
                    "; sign the release with it, or take another release");
    const auto release = releaseIn(asText(list));
    if (!release) throw Error(source + ": is no list of a release; sign the release anew");
    return *release;
}

ReleaseContent checkRelease(const fs::path& given, const ShowKey& key) {
    const fs::path folder = withoutSlash(given);
    static_cast<void>(namesIn(folder));
    for (const char* own : {kListFile, kSignatureFile})
        if (!fs::exists(folder / own))
            throw Error("release " + folder.filename().string() + ": " + own + " is missing in " +
                        folder.string() + "; sign it (aquarama release sign)");
    ReleaseContent release = signedList(readWhole(folder / kListFile, kMostListBytes),
                                        readWhole(folder / kSignatureFile, kMostSignatureBytes),
                                        key,
                                        (folder / kListFile).string());
    if (release.id.version != folder.filename())
        throw Error("release " + release.id.version + ": stands in a folder of another name, " +
                    folder.string() + "; name the folder as the version");
    requireFiles(folder, release);
    return release;
}

void requireSerial(const ReleaseContent& release, std::uint64_t least) {
    if (release.id.serial < least)
        throw Error("release " + release.id.version + ": is older (serial " +
                    std::to_string(release.id.serial) + ") than serial " + std::to_string(least) +
                    "; take a newer one");
}

ReleaseId idIn(const fs::path& given) {
    const fs::path folder = withoutSlash(given);
    const auto release = fs::exists(folder / kListFile)
                             ? releaseIn(asText(readWhole(folder / kListFile, kMostListBytes)))
                             : std::nullopt;
    return release ? release->id : ReleaseId{folder.filename().string(), 0};
}

}  // namespace aquarama::releases
