// SPDX-License-Identifier: Apache-2.0
#include "master/standby/followed_drawings.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/base/log.h"
#include "common/wire/kept_drawings.h"

namespace aquarama::standby {

namespace {

constexpr net::Duration kRepeat = std::chrono::seconds(1);  // of a request without an answer

}  // namespace

FollowedDrawings::FollowedDrawings(std::filesystem::path folder,
                                   std::function<void(v1::Envelope)> say)
    : files_{std::move(folder)}, say_{std::move(say)} {
    for (const conductor::KeptEntry& found : files_.read().drawings)
        skins_[digestOf(*found.skin)] = found.skin;
}

void FollowedDrawings::want(const Digest& list) {
    if (list == wanted_ || (!wanted_ && list == kept_)) return;
    wanted_ = list;
    list_.reset();
    assembly_.reset();
    writing_.reset();
}

void FollowedDrawings::turn(net::Moment now) {
    files_.turn();
    if (!wanted_) return;
    if (writing_) {
        if (files_.isKept(*writing_)) kept_ = std::exchange(wanted_, {});
        return;
    }
    if (assembly_) {
        if (now - lastRequest_ > kRepeat) request(now);
        return;
    }
    const auto missing = list_ ? nextMissing() : wanted_;
    if (!missing) return write();
    assembly_.emplace(*missing);
    request(now);
}

std::optional<Digest> FollowedDrawings::nextMissing() const {
    for (const v1::KeptDrawing& drawing : list_->drawings())
        if (const Digest skin = wire::digestIn(drawing.picture()); !skins_.contains(skin))
            return skin;
    return std::nullopt;
}

void FollowedDrawings::request(net::Moment now) {
    say_(wire::chunkRequest(assembly_->digest(), assembly_->nextOffset()));
    lastRequest_ = now;
}

void FollowedDrawings::take(const v1::BlobChunk& chunk) {
    if (!assembly_ || wire::digestIn(chunk.digest()) != assembly_->digest() ||
        chunk.total() > wire::kMostSkinBytes ||
        !assembly_->take(chunk.offset(), chunk.total(), std::as_bytes(std::span{chunk.content()})))
        return;
    if (!assembly_->whole()) return request(net::monotonicNow());
    settle(*std::exchange(assembly_, {}));
}

// What cannot be used is not asked for again: the next list may be better.
void FollowedDrawings::settle(net::BlobAssembly whole) {
    const Digest digest = whole.digest();
    auto bytes = whole.checked();
    if (bytes && list_) {
        skins_[digest] = std::make_shared<const std::vector<std::byte>>(std::move(*bytes));
        return;
    }
    if (bytes) list_ = wire::keptDrawingsIn(*bytes);
    if (list_ && bytes) return;
    logError("the master's drawings cannot be read, and are not kept here; restart the master");
    wanted_.reset();
}

void FollowedDrawings::write() {
    std::vector<conductor::KeptEntry> entries;
    std::map<Digest, net::Blob> skins;
    for (const v1::KeptDrawing& drawing : list_->drawings()) {
        const Digest digest = wire::digestIn(drawing.picture());
        skins[digest] = skins_.at(digest);
        entries.push_back(conductor::entryOf(drawing, skins_.at(digest)));
    }
    skins_ = std::move(skins);
    writing_ = files_.keep(list_->last_number(), std::move(entries));
}

}  // namespace aquarama::standby
