// SPDX-License-Identifier: Apache-2.0
// Fetches the blobs of a look, from the cache of this machine or in chunks from the master.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "common/base/digest.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::session {

// One blob at a time. Reading, checking and writing a large blob takes a second, so another thread
// does it: the net thread must not fall silent. Used by the net thread.
class BlobFetch {
  public:
    // `say` sends a message to the master. `wake` makes the net thread call turn() soon; it is
    // called from another thread.
    BlobFetch(net::BlobCache cache,
              std::function<void(v1::Envelope)> say,
              std::function<void()> wake);

    // Starts to fetch these blobs. Keeps blobs of the previous fetch that are wanted again.
    void begin(std::vector<Digest> wanted);
    // Keeps what was fetched.
    void stop() { isFetching_ = false; }
    void take(const v1::BlobChunk& chunk);
    // Goes on with what has come. True once for each begin(): all blobs are there. Throws Error
    // where the master has sent wrong bytes three times, after which it has stopped.
    [[nodiscard]] bool turn(net::Moment now);
    [[nodiscard]] const std::map<Digest, net::Blob>& blobs() const { return blobs_; }
    // On the cache's disk; 0 where it cannot be told.
    [[nodiscard]] std::uint64_t freeBytes() const { return cache_.freeBytes(); }

  private:
    // The result of one search in the cache, or of one check of what was sent.
    struct Obtained {
        Digest digest;
        net::Blob blob;  // null: not in the cache, or other bytes were sent
        bool wasSent = false;
    };
    void keep(const Obtained& obtained);
    void obtain(const Digest& digest,
                bool wasSent,
                std::function<std::optional<net::ByteVector>()> work);
    [[nodiscard]] std::optional<Obtained> takeObtained();
    [[nodiscard]] std::optional<Digest> firstMissing() const;
    void requestChunk();

    net::BlobCache cache_;
    std::function<void(v1::Envelope)> say_;
    std::function<void()> wake_;
    std::vector<Digest> wanted_;
    std::map<Digest, net::Blob> blobs_;
    bool isFetching_ = false, isObtaining_ = false;
    std::optional<net::BlobAssembly> assembly_;  // of the blob that the master sends
    net::Moment lastRequest_{};
    int spoiltBlobs_ = 0;  // that were sent, and had other bytes
    std::mutex mutex_;     // guards obtained_
    std::optional<Obtained> obtained_;
    std::future<void> obtaining_;  // last: it uses all of the above
};

}  // namespace aquarama::session
