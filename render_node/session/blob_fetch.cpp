// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/blob_fetch.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <memory>
#include <span>
#include <utility>

#include "common/base/log.h"

namespace aquarama::session {
namespace {

constexpr net::Duration kRepeat = std::chrono::seconds(1);  // of a request without an answer
constexpr int kMostSpoiltBlobs = 3;

}  // namespace

BlobFetch::BlobFetch(net::BlobCache cache,
                     std::function<void(v1::Envelope)> say,
                     std::function<void()> wake)
    : cache_(std::move(cache)), say_(std::move(say)), wake_(std::move(wake)) {}

void BlobFetch::begin(std::vector<Digest> wanted) {
    wanted_ = std::move(wanted);
    std::erase_if(blobs_, [&](const auto& blob) {
        return std::ranges::find(wanted_, blob.first) == wanted_.end();
    });
    assembly_.reset();
    isFetching_ = true;
}

bool BlobFetch::turn(net::Moment now) {
    if (const auto obtained = takeObtained()) keep(*obtained);
    if (!isFetching_ || isObtaining_) return false;
    if (assembly_) {
        if (now - lastRequest_ > kRepeat) requestChunk();
        return false;
    }
    const auto digest = firstMissing();
    if (digest)
        obtain(*digest, false, [cache = cache_, digest = *digest] { return cache.find(digest); });
    else
        isFetching_ = false;
    return !digest;
}

// A blob is kept also where it was obtained for another look: its digest says what it is.
void BlobFetch::keep(const Obtained& obtained) {
    isObtaining_ = false;
    if (!isFetching_) return;
    if (obtained.blob) blobs_.emplace(obtained.digest, obtained.blob);
    if (firstMissing() != obtained.digest) return;
    if (obtained.wasSent && ++spoiltBlobs_ >= kMostSpoiltBlobs) {
        stop();
        throw Error("the master sends other bytes for blob " + toHex(obtained.digest) +
                    " than its name says; restart the master");
    }
    assembly_.emplace(obtained.digest);
    requestChunk();
}

void BlobFetch::obtain(const Digest& digest,
                       bool wasSent,
                       std::function<std::optional<net::ByteVector>()> work) {
    isObtaining_ = true;
    obtaining_ = std::async(std::launch::async, [this, digest, wasSent, work = std::move(work)] {
        auto bytes = work();
        net::Blob blob;
        if (bytes) blob = std::make_shared<const net::ByteVector>(std::move(*bytes));
        {
            const std::lock_guard lock(mutex_);
            obtained_ = Obtained{digest, std::move(blob), wasSent};
        }
        wake_();
    });
}

std::optional<BlobFetch::Obtained> BlobFetch::takeObtained() {
    const std::lock_guard lock(mutex_);
    return std::exchange(obtained_, {});
}

std::optional<Digest> BlobFetch::firstMissing() const {
    const auto missing =
        std::ranges::find_if(wanted_, [&](const Digest& d) { return !blobs_.contains(d); });
    return missing == wanted_.end() ? std::nullopt : std::optional(*missing);
}

void BlobFetch::requestChunk() {
    assert(assembly_);
    say_(wire::chunkRequest(assembly_->digest(), assembly_->nextOffset()));
    lastRequest_ = net::monotonicNow();
}

void BlobFetch::take(const v1::BlobChunk& chunk) {
    const Digest digest = wire::digestIn(chunk.digest());
    if (!isFetching_ || !assembly_ || digest != assembly_->digest()) return;
    const auto content = std::as_bytes(std::span{chunk.content()});
    if (!assembly_->take(chunk.offset(), chunk.total(), content)) return;
    if (!assembly_->whole()) return requestChunk();
    obtain(digest, true, [cache = cache_, assembly = *std::exchange(assembly_, {})]() mutable {
        auto blob = assembly.checked();
        if (blob) cache.keep(assembly.digest(), *blob);
        return blob;
    });
}

}  // namespace aquarama::session
