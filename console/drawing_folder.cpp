// SPDX-License-Identifier: Apache-2.0
#include "console/drawing_folder.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <vector>

#include "common/ask/drawing_reader.h"
#include "common/base/files.h"

namespace aquarama::console {

namespace {

namespace fs = std::filesystem;

// Of one look; more wait until these are gone.
constexpr std::size_t kMostEntries = 1000;
constexpr const char* kRefused = "refused";
constexpr int kTicksBetweenLooks = 20;

// One that a person or a program has put there to be read.
bool isPicture(const fs::directory_entry& entry) {
    std::error_code gone;
    return entry.is_regular_file(gone) && !entry.is_symlink(gone) &&
           !entry.path().filename().string().starts_with('.');
}

std::string bytesOf(const fs::path& path) {
    const auto bytes = readWhole(path, ask::kMostPictureBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The oldest that are too many.
void trim(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file()) files.emplace_back(entry.last_write_time(), entry.path());
    std::ranges::sort(files);
    for (std::size_t i = 0; i + DrawingFolder::kMostRefused < files.size(); ++i)
        fs::remove(files[i].second);
}

}  // namespace

DrawingFolder::Seen DrawingFolder::seenIn(const fs::path& folder) {
    Seen seen;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (seen.size() == kMostEntries) break;
        if (isPicture(entry) && entry.file_size() > 0)
            seen[entry.path().filename().string()] = {entry.file_size(), entry.last_write_time()};
    }
    return seen;
}

// A file is complete when nothing of it has changed between two looks. One that is too large has no
// picture here; it is refused unread.
DrawingFolder::Result DrawingFolder::lookInto(const fs::path& folder, const Seen& before) {
    Result result{.seen = seenIn(folder)};
    std::vector<Seen::value_type> complete;
    std::ranges::set_intersection(result.seen, before, std::back_inserter(complete));
    if (complete.empty()) return result;
    const auto oldest =
        std::ranges::min_element(complete, {}, [](const auto& file) { return file.second.second; });
    result.name = oldest->first;
    if (oldest->second.first <= ask::kMostPictureBytes)
        result.picture = bytesOf(folder / result.name);
    return result;
}

// Copied, as a folder of the network may have no other way.
DrawingFolder::Result DrawingFolder::takeAway(const fs::path& folder,
                                              const std::string& name,
                                              bool isRefused) {
    if (isRefused) {
        fs::create_directories(folder / kRefused);
        fs::copy_file(
            folder / name, folder / kRefused / name, fs::copy_options::overwrite_existing);
        trim(folder / kRefused);
    }
    fs::remove(folder / name);
    return {};
}

void DrawingFolder::tick(bool isOpen) {
    if (ticksToLook_ > 0) --ticksToLook_;
    if (errand_.valid()) {
        if (errand_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        hear(errand_.get());
    }
    if (command_ != 0) follow();
    if (isDue(isOpen)) begin();
}

bool DrawingFolder::isDue(bool isOpen) const {
    if (command_ != 0) return false;
    return !name_.empty() || (isOpen && ticksToLook_ == 0);
}

// Takes away what is done with, else looks for the next.
void DrawingFolder::begin() {
    ticksToLook_ = kTicksBetweenLooks;
    errand_ = std::async(
        std::launch::async,
        [folder = folder_, seen = seen_, name = name_, isRefused = isRefused_]() -> Result {
            try {
                return name.empty() ? lookInto(folder, seen) : takeAway(folder, name, isRefused);
            } catch (const std::exception& problem) {
                return {.problem = problem.what()};
            }
        });
}

// What cannot be taken away is tried again, and no other is read before.
void DrawingFolder::hear(Result result) {
    problem_ = result.problem.empty() ? ""
                                      : "the folder of pictures cannot be used (" + result.problem +
                                            "); it must be there, and this user write to it";
    if (!problem_.empty()) return;
    const bool wasTakenAway = !std::exchange(name_, {}).empty();
    if (wasTakenAway) return;
    seen_ = std::move(result.seen);
    if (!result.name.empty()) offer(std::move(result));
}

void DrawingFolder::offer(Result found) {
    isRefused_ = found.picture.empty();
    if (isRefused_)
        taker_.refuse(found.name, "the picture is too large: at most 16 MB");
    else
        command_ = taker_.take(found.name, std::move(found.picture));
    if (isRefused_ || command_ != 0) name_ = std::move(found.name);
}

// One whose end nobody knows is read once more.
void DrawingFolder::follow() {
    static const ask::Answer kUnknown{ask::Outcome::Lost, ""};
    const ask::Answer* const known = taker_.answerTo(command_);
    const ask::Answer& answer = known != nullptr ? *known : kUnknown;
    if (answer.outcome == ask::Outcome::Waiting) return;
    command_ = 0;
    isRefused_ = answer.outcome == ask::Outcome::Refused;
    if (answer.outcome == ask::Outcome::Lost) name_.clear();
}

}  // namespace aquarama::console
