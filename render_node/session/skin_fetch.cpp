// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/skin_fetch.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "common/base/log.h"

namespace aquarama::session {
namespace {

constexpr net::Duration kSkinRepeat = std::chrono::seconds(1);  // of a request without an answer
constexpr std::size_t kMostUndecoded = 2;                       // pictures that wait

// The skin in a whole blob. Throws Error.
std::shared_ptr<const body::SideSkin> skinIn(net::BlobAssembly& whole) {
    const auto png = whole.checked();
    if (!png) throw Error("its bytes are others than its name says");
    return std::make_shared<const body::SideSkin>(body::sideSkinOf(*png, "the picture"));
}

}  // namespace

SkinFetch::SkinFetch(std::function<void(v1::Envelope)> say,
                     std::function<void()> wake,
                     std::function<void(Skins)> offer)
    : say_(std::move(say)), wake_(std::move(wake)), offer_(std::move(offer)) {}

void SkinFetch::want(const std::optional<Digest>& list) {
    if (list == list_) return;
    list_ = list;
    isListRead_ = !list;
    assembly_.reset();
    if (list) return;
    listed_.clear();
    pictures_.clear();
    offerAll();
}

void SkinFetch::turn(net::Moment now) {
    if (const auto decoded = takeDecoded()) keep(*decoded);
    decodeNext();
    if (assembly_) {
        if (now - lastRequest_ > kSkinRepeat) requestChunk();
        return;
    }
    if (undecoded_.size() >= kMostUndecoded) return;
    const auto wanted = list_ && !isListRead_ ? list_ : firstMissing();
    if (!wanted) return;
    assembly_.emplace(*wanted);
    requestChunk();
}

std::optional<Digest> SkinFetch::firstMissing() const {
    const auto missing = std::ranges::find_if(
        listed_, [&](const Listed& one) { return !pictures_.contains(one.picture); });
    return missing == listed_.end() ? std::nullopt : std::optional(missing->picture);
}

bool SkinFetch::isComplete() const {
    return isListRead_ && std::ranges::all_of(listed_, [&](const Listed& one) {
               const auto come = pictures_.find(one.picture);
               return come != pictures_.end() && come->second.isDone;
           });
}

void SkinFetch::requestChunk() {
    say_(wire::chunkRequest(assembly_->digest(), assembly_->nextOffset()));
    lastRequest_ = net::monotonicNow();
}

void SkinFetch::take(const v1::BlobChunk& chunk) {
    const Digest digest = wire::digestIn(chunk.digest());
    if (!assembly_ || digest != assembly_->digest()) return;
    if (chunk.total() > wire::kMostSkinBytes) {
        assembly_.reset();
        return refuse(digest, "it is larger than a skin may be");
    }
    if (!assembly_->take(chunk.offset(), chunk.total(), std::as_bytes(std::span{chunk.content()})))
        return;
    if (!assembly_->whole()) return requestChunk();
    settle(*std::exchange(assembly_, {}));
}

void SkinFetch::settle(net::BlobAssembly whole) {
    if (!isListRead_ && whole.digest() == list_) return readList(whole);
    pictures_[whole.digest()];
    undecoded_.push_back(std::move(whole));
}

// It names nothing.
void SkinFetch::unreadable() {
    logWarning("the master's list of drawings cannot be read; restart the master");
    isListRead_ = true;
    listed_.clear();
    pictures_.clear();
    offerAll();
}

void SkinFetch::readList(net::BlobAssembly& whole) {
    const auto bytes = whole.checked();
    const auto list = bytes ? wire::readSkinList(*bytes) : std::nullopt;
    if (!list) return unreadable();
    listed_.clear();
    for (const v1::ListedSkin& skin : list->skins())
        listed_.push_back({skin.number(), wire::digestIn(skin.picture()), skin.species()});
    std::erase_if(pictures_, [&](const auto& come) {
        return std::ranges::find(listed_, come.first, &Listed::picture) == listed_.end();
    });
    isListRead_ = true;
    offerAll();
}

void SkinFetch::decodeNext() {
    if (isDecoding_ || undecoded_.empty()) return;
    isDecoding_ = true;
    const auto decode = [this](net::BlobAssembly whole) {
        Decoded decoded{.picture = whole.digest(), .skin = {}, .problem = {}};
        try {
            decoded.skin = skinIn(whole);
        } catch (const Error& problem) {
            decoded.problem = problem.what();
        }
        {
            const std::lock_guard lock(mutex_);
            decoded_ = std::move(decoded);
        }
        wake_();
    };
    decoding_ = std::async(std::launch::async, decode, std::move(undecoded_.front()));
    undecoded_.pop_front();
}

std::optional<SkinFetch::Decoded> SkinFetch::takeDecoded() {
    const std::lock_guard lock(mutex_);
    return std::exchange(decoded_, {});
}

void SkinFetch::keep(const Decoded& decoded) {
    isDecoding_ = false;
    if (!decoded.skin) return refuse(decoded.picture, decoded.problem);
    if (!pictures_.contains(decoded.picture)) return;  // no longer listed
    pictures_[decoded.picture] = {decoded.skin, true};
    offerAll();
}

void SkinFetch::refuse(const Digest& picture, const std::string& problem) {
    if (!isListRead_ && picture == list_) return unreadable();
    const auto listed = std::ranges::find(listed_, picture, &Listed::picture);
    if (listed == listed_.end()) return;
    pictures_[picture] = {nullptr, true};
    logWarning("drawing {}, a {}, is not shown: {}; its fish keeps the skin of its species",
               listed->number,
               listed->species,
               problem);
}

void SkinFetch::offerAll() {
    body::SkinsByNumber skins;
    for (const Listed& one : listed_) {
        const auto come = pictures_.find(one.picture);
        if (come != pictures_.end() && come->second.skin) skins[one.number] = come->second.skin;
    }
    offer_(std::make_shared<const body::SkinsByNumber>(std::move(skins)));
}

}  // namespace aquarama::session
