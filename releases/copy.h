// SPDX-License-Identifier: Apache-2.0
// A release on its way from the depot to a machine, in pieces. What came before a power cut stays;
// the list comes onto the disk last, so that a folder with a list is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "releases/release.h"

namespace aquarama::releases {

// A piece that is asked for.
struct WantedPiece {
    std::string version;
    std::string file;
    std::uint64_t offset = 0;
    friend bool operator==(const WantedPiece&, const WantedPiece&) = default;
};

// A piece that has come. No total: there is no such file.
struct ArrivedPiece {
    WantedPiece place;
    std::optional<std::uint64_t> total;
    std::span<const std::byte> content;
};

// One copy. All functions throw Error, which names release and file, where it cannot go on. One
// thread uses it.
class ReleaseCopy {
  public:
    // `folder`: of the release, whose name is the version. `running`: a release that is not newer
    // is refused.
    ReleaseCopy(ReleaseId wanted,
                const ReleaseId& running,
                std::filesystem::path folder,
                ShowKey key);

    // What is copied.
    [[nodiscard]] const ReleaseId& release() const { return wanted_; }
    // The piece that is lacking now; nothing: it is whole, and was checked.
    [[nodiscard]] std::optional<WantedPiece> wanted() const;
    // Takes the piece that is lacking; another one is ignored.
    void take(const ArrivedPiece& piece);

  private:
    [[nodiscard]] std::string nameOf(const std::string& file) const;
    void takeList(const ArrivedPiece& piece);
    void takeContent(const ArrivedPiece& piece);
    void readList();
    void startFile();
    void finishFile();
    void finish();

    ReleaseId wanted_;
    std::uint64_t least_;  // serial
    std::filesystem::path folder_;
    ShowKey key_;
    std::vector<std::byte> list_, signature_;
    bool hasList_ = false;  // with its signature
    ReleaseContent content_;
    std::size_t file_ = 0;  // of content_
    std::uint64_t offset_ = 0;
    bool isResumed_ = false;  // this file
    bool isWhole_ = false;
};

}  // namespace aquarama::releases
