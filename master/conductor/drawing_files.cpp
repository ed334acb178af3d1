// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/drawing_files.h"

#include <chrono>
#include <set>
#include <utility>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/wire/kept_drawings.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLoss = "drawings are lost with the next start";

bool isDone(const std::future<std::string>& work) {
    return work.valid() && work.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

fs::path listIn(const fs::path& folder) {
    return folder / "list.txtpb";
}
fs::path pictureIn(const fs::path& folder, std::uint32_t number) {
    return folder / (std::to_string(number) + ".png");
}

// Pictures first: the list never names one that is not there.
void writeAll(const fs::path& folder,
              std::uint32_t lastNumber,
              const std::vector<KeptEntry>& drawings) {
    fs::create_directories(folder);
    v1::KeptDrawings list;
    list.set_last_number(lastNumber);
    std::set<fs::path> named{listIn(folder)};
    for (const KeptEntry& entry : drawings) {
        const fs::path picture = pictureIn(folder, entry.number);
        named.insert(picture);
        if (!fs::exists(picture)) writePrivate(picture, *entry.skin);
        *list.add_drawings() = listed(entry);
    }
    wire::keepDrawings(listIn(folder), std::move(list));
    std::error_code none;
    for (const auto& file : fs::directory_iterator(folder))
        if (!named.contains(file.path()) && file.path().extension() == ".png")
            fs::remove(file.path(), none);
}

}  // namespace

v1::KeptDrawing listed(const KeptEntry& entry) {
    v1::KeptDrawing listed;
    listed.set_number(entry.number);
    listed.set_species(entry.species);
    listed.set_verdict(entry.isLetIn ? v1::KeptDrawing::LET_IN : v1::KeptDrawing::WAITING);
    if (entry.isKept) listed.set_kept(true);
    listed.set_aside(entry.aside);
    listed.set_offered_at(entry.offeredAt);
    listed.set_request(entry.request);
    return listed;
}

KeptEntry entryOf(const v1::KeptDrawing& listed, net::Blob skin) {
    return {.number = listed.number(),
            .species = listed.species(),
            .isLetIn = listed.verdict() == v1::KeptDrawing::LET_IN,
            .isKept = listed.kept(),
            .aside = listed.aside(),
            .offeredAt = listed.offered_at(),
            .request = listed.request(),
            .skin = std::move(skin)};
}

DrawingFiles::DrawingFiles(fs::path folder) : folder_{std::move(folder)} {}

DrawingFiles::~DrawingFiles() {
    if (writing_.valid()) writing_.wait();
    turn();
    if (writing_.valid()) writing_.wait();
}

FoundDrawings DrawingFiles::read() const {
    FoundDrawings found;
    if (folder_.empty() || !fs::exists(listIn(folder_))) return found;
    v1::KeptDrawings list;
    try {
        list = wire::readKeptDrawings(listIn(folder_));
    } catch (const Error& problem) {
        logWarning("{}; the drawings are left out", problem.what());
        return found;
    }
    found.lastNumber = list.last_number();
    for (const v1::KeptDrawing& drawing : list.drawings()) {
        try {
            const fs::path picture = pictureIn(folder_, drawing.number());
            found.drawings.push_back(entryOf(drawing,
                                             std::make_shared<const std::vector<std::byte>>(
                                                 readWhole(picture, wire::kMostSkinBytes))));
        } catch (const Error& problem) {
            logWarning("{}; drawing {} is left out", problem.what(), drawing.number());
        }
    }
    return found;
}

std::uint64_t DrawingFiles::keep(std::uint32_t lastNumber, std::vector<KeptEntry> drawings) {
    waiting_ = Wanted{lastNumber, std::move(drawings)};
    ++newest_;
    turn();
    return newest_;
}

void DrawingFiles::turn() {
    if (isDone(writing_)) {
        if (const std::string problem = writing_.get(); !problem.empty())
            warnOnceOf(folder_, problem, kLoss);
        written_ = begun_;
    }
    if (folder_.empty() || writing_.valid() || !waiting_) return;
    begun_ = newest_;
    const auto write = [folder = folder_,
                        wanted = *std::exchange(waiting_, std::nullopt)]() -> std::string {
        try {
            writeAll(folder, wanted.lastNumber, wanted.drawings);
            return {};
        } catch (const std::exception& problem) {  // also of std::filesystem
            return problem.what();
        }
    };
    writing_ = std::async(std::launch::async, write);
}

}  // namespace aquarama::conductor
