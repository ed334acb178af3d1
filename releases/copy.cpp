// SPDX-License-Identifier: Apache-2.0
#include "releases/copy.h"

#include <algorithm>
#include <set>
#include <utility>

#include "common/base/durable.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "releases/signing.h"

namespace aquarama::releases {

namespace fs = std::filesystem;

ReleaseCopy::ReleaseCopy(ReleaseId wanted, const ReleaseId& running, fs::path folder, ShowKey key)
    : wanted_{std::move(wanted)},
      least_{running.serial + 1},
      folder_{std::move(folder)},
      key_{std::move(key)} {}

std::string ReleaseCopy::nameOf(const std::string& file) const {
    return "release " + wanted_.version + ": " + file + " ";
}

std::optional<WantedPiece> ReleaseCopy::wanted() const {
    if (isWhole_) return std::nullopt;
    if (hasList_) return WantedPiece{wanted_.version, content_.files[file_].name, offset_};
    return WantedPiece{wanted_.version, list_.empty() ? kListFile : kSignatureFile, 0};
}

void ReleaseCopy::take(const ArrivedPiece& piece) {
    if (piece.place != wanted()) return;
    if (!piece.total)
        throw Error(nameOf(piece.place.file) + "is not in the depot; put the release there");
    hasList_ ? takeContent(piece) : takeList(piece);
}

// Both come in one piece each.
void ReleaseCopy::takeList(const ArrivedPiece& piece) {
    const bool isList = list_.empty();
    const std::size_t most = isList ? kMostListBytes : kMostSignatureBytes;
    if (piece.content.empty() || piece.content.size() != *piece.total || *piece.total > most)
        throw Error(nameOf(piece.place.file) + "has no size of one; sign the release anew");
    (isList ? list_ : signature_).assign(piece.content.begin(), piece.content.end());
    if (!isList) readList();
}

// What is there of another release with this version is removed.
void ReleaseCopy::readList() {
    content_ = signedList(list_, signature_, key_, "release " + wanted_.version + ": " + kListFile);
    requireSerial(content_, least_);
    if (content_.id != wanted_)
        throw Error(nameOf(kListFile) + "is of release " + content_.id.version + ", serial " +
                    std::to_string(content_.id.serial) + "; stage the release anew");
    hasList_ = true;
    fs::create_directories(folder_);
    std::set<std::string> names;
    for (const ReleaseFile& file : content_.files) names.insert(file.name);
    for (const auto& entry : fs::directory_iterator(folder_))
        if (!names.contains(entry.path().filename().string())) fs::remove_all(entry.path());
    startFile();
}

void ReleaseCopy::startFile() {
    const fs::path path = folder_ / content_.files[file_].name;
    offset_ = fs::exists(path) ? fs::file_size(path) : 0;
    isResumed_ = offset_ > 0;
}

// A file that is longer than it should be is no part of it.
void ReleaseCopy::takeContent(const ArrivedPiece& piece) {
    const ReleaseFile& file = content_.files[file_];
    const std::uint64_t total = *piece.total;
    if (total > kMostReleaseFileBytes || piece.content.size() > total ||
        total - piece.content.size() < offset_) {
        if (!isResumed_) throw Error(nameOf(file.name) + "is too long; sign the release anew");
        removeDurably(folder_ / file.name);
        return startFile();
    }
    if (piece.content.empty() && offset_ < total)
        throw Error(nameOf(file.name) + "cannot be read in the depot; see the depot's disk");
    if (offset_ == 0 && total > freeBytesAt(folder_))
        throw Error(nameOf(file.name) + "has " + std::to_string(total >> 20U) +
                    " MiB, and there is no room in " + folder_.string() + "; make room there");
    GrowingFile(folder_ / file.name, GrowingFile::kAll).append(piece.content);
    offset_ += piece.content.size();
    if (offset_ == total) finishFile();
}

// A power cut may leave other bytes than were written: a file of two pasts gets a second try.
void ReleaseCopy::finishFile() {
    const ReleaseFile& file = content_.files[file_];
    GrowingFile written(folder_ / file.name, GrowingFile::kAll);
    written.close();
    if (digestOfFile(folder_ / file.name) != file.digest) {
        removeDurably(folder_ / file.name);
        if (!isResumed_)
            throw Error(nameOf(file.name) + "was changed or cut after it was signed; put the " +
                        "release into the depot anew");
        return startFile();
    }
    if (++file_ < content_.files.size()) return startFile();
    finish();
}

void ReleaseCopy::finish() {
    writeWhole(folder_ / kSignatureFile, signature_);
    writeWhole(folder_ / kListFile, list_);
    checkRelease(folder_, key_);
    isWhole_ = true;
}

}  // namespace aquarama::releases
