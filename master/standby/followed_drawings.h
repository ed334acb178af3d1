// SPDX-License-Identifier: Apache-2.0
// Visitors' drawings as the master has them, on the disk of a standby.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "common/base/digest.h"
#include "common/net/blob.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "master/conductor/drawing_files.h"

namespace aquarama::standby {

// Fetches the master's list and the skins that this disk lacks, and writes them when it has all:
// what was there stays until then. Used by one thread.
class FollowedDrawings {
  public:
    // `folder`: where a master of this machine would look. `say` sends a message to the master.
    FollowedDrawings(std::filesystem::path folder, std::function<void(v1::Envelope)> say);

    // The master's newest list.
    void want(const Digest& list);
    void take(const v1::BlobChunk& chunk);
    // Goes on with what has come.
    void turn(net::Moment now);
    // The list that this disk has, with all skins; nothing: none of this master.
    [[nodiscard]] const std::optional<Digest>& kept() const { return kept_; }

  private:
    [[nodiscard]] std::optional<Digest> nextMissing() const;
    void request(net::Moment now);
    void settle(net::BlobAssembly whole);
    void write();

    conductor::DrawingFiles files_;
    std::function<void(v1::Envelope)> say_;
    std::optional<Digest> wanted_;          // nothing: all that can be done is done
    std::optional<v1::KeptDrawings> list_;  // the wanted one, where it has come
    std::map<Digest, net::Blob> skins_;
    std::optional<net::BlobAssembly> assembly_;
    net::Moment lastRequest_{};
    std::optional<std::uint64_t> writing_;  // state of the files that has the wanted list
    std::optional<Digest> kept_;
};

}  // namespace aquarama::standby
