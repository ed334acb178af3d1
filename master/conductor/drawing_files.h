// SPDX-License-Identifier: Apache-2.0
// Visitors' drawings on the disk of the master, and of a standby: a list, and a PNG for each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "common/net/blob.h"
#include "common/wire/kept_drawings.h"

namespace aquarama::conductor {

// One of them, as it is kept.
struct KeptEntry {
    std::uint32_t number = 0;
    std::string species;
    bool isLetIn = false;         // else it waits for the crew
    bool isKept = false;          // past the day
    int aside = 0;                // its maker: -1 left, 0 middle, 1 right
    std::uint64_t offeredAt = 0;  // Unix time, seconds
    std::uint64_t request = 0;    // by which it was offered
    net::Blob skin;               // PNG
};

// As a list names it, without its skin.
[[nodiscard]] v1::KeptDrawing listed(const KeptEntry& entry);
[[nodiscard]] KeptEntry entryOf(const v1::KeptDrawing& listed, net::Blob skin);

// What a master finds when it starts.
struct FoundDrawings {
    std::uint32_t lastNumber = 0;
    std::vector<KeptEntry> drawings;
};

// Of one thread; it writes on another one, so that a slow disk delays no frame.
class DrawingFiles {
  public:
    // Empty folder: nothing is kept.
    explicit DrawingFiles(std::filesystem::path folder);
    // Waits for what is being written.
    ~DrawingFiles();
    DrawingFiles(const DrawingFiles&) = delete;
    DrawingFiles& operator=(const DrawingFiles&) = delete;

    // What is there. A list or picture that cannot be read is one warning, and is left out.
    [[nodiscard]] FoundDrawings read() const;
    // Writes these, and removes pictures of others. What cannot be written is one warning. Returns
    // the number of this state.
    std::uint64_t keep(std::uint32_t lastNumber, std::vector<KeptEntry> drawings);
    // Begins with what waits, where nothing is being written.
    void turn();
    // Whether a state, or a later one, is on the disk, or could not be written.
    [[nodiscard]] bool isKept(std::uint64_t state) const {
        return folder_.empty() || written_ >= state;
    }

  private:
    struct Wanted {
        std::uint32_t lastNumber = 0;
        std::vector<KeptEntry> drawings;
    };
    std::filesystem::path folder_;
    std::optional<Wanted> waiting_;
    std::uint64_t newest_ = 0, begun_ = 0, written_ = 0;  // states
    std::future<std::string> writing_;  // why it could not be written; empty: it was
};

}  // namespace aquarama::conductor
