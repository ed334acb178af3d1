// SPDX-License-Identifier: Apache-2.0
#include "console/drawing_book.h"

#include <algorithm>
#include <ranges>

#include "common/base/digest.h"

namespace aquarama::console {

namespace {

std::uint32_t countOf(const v1::DrawingsReply& list, v1::DrawingStatus::Condition condition) {
    return static_cast<std::uint32_t>(
        std::ranges::count(list.drawings(), condition, &v1::DrawingStatus::condition));
}

}  // namespace

// A picture of what is not listed any more is dropped, so a number that is given anew has a new
// one.
void DrawingBook::hear(const v1::DrawingsReply& reply) {
    list_ = reply;
    list_.clear_skin();
    std::erase_if(pictures_, [&](const auto& one) {
        const bool isGone =
            std::ranges::count(list_.drawings(), one.first, &v1::DrawingStatus::number) == 0;
        if (isGone && one.second.png) bytes_ -= one.second.png->size();
        return isGone;
    });
    if (reply.skin_of() != 0) keep(reply.skin_of(), reply.skin());
    ++version_;
}

void DrawingBook::clear() {
    if (size() > 0) hear({});
}

// An empty one is kept too: it is not asked for again.
void DrawingBook::keep(std::uint32_t number, const std::string& png) {
    const bool isListed =
        std::ranges::count(list_.drawings(), number, &v1::DrawingStatus::number) > 0;
    if (!isListed || pictures_.contains(number)) return;
    SkinPicture& picture = pictures_[number];
    if (png.empty()) return;
    constexpr std::size_t kTagDigits = 16;
    picture = {std::make_shared<const std::string>(png),
               toHex(digestOf(png)).substr(0, kTagDigits)};
    bytes_ += png.size();
}

bool DrawingBook::isWaiting(std::uint32_t number) const {
    return std::ranges::any_of(list_.drawings(), [&](const v1::DrawingStatus& one) {
        return one.number() == number && one.condition() == v1::DrawingStatus::WAITING;
    });
}

// The oldest that the crew has decided of goes.
void DrawingBook::makeRoom() {
    while (isFull()) {
        const auto oldest = std::ranges::find_if(
            pictures_, [&](const auto& one) { return one.second.png && !isWaiting(one.first); });
        if (oldest == pictures_.end()) return;
        bytes_ -= oldest->second.png->size();
        pictures_.erase(oldest);
        ++version_;
    }
}

std::uint32_t DrawingBook::wanted() {
    const auto lacks = [&](const v1::DrawingStatus& one) {
        return !pictures_.contains(one.number());
    };
    const auto waiting = std::ranges::find_if(list_.drawings(), [&](const auto& one) {
        return one.condition() == v1::DrawingStatus::WAITING && lacks(one);
    });
    const bool isForCrew = waiting != list_.drawings().end();
    if (isForCrew) makeRoom();
    if (isFull()) return 0;
    if (isForCrew) return waiting->number();
    const auto newest = std::views::reverse(list_.drawings());
    const auto found = std::ranges::find_if(newest, lacks);
    return found == newest.end() ? 0 : found->number();
}

const SkinPicture* DrawingBook::picture(std::uint32_t number) const {
    const auto found = pictures_.find(number);
    return found == pictures_.end() || !found->second.png ? nullptr : &found->second;
}

DrawingCounts DrawingBook::counts() const {
    return {.waiting = countOf(list_, v1::DrawingStatus::WAITING),
            .swimming = countOf(list_, v1::DrawingStatus::SWIMMING)};
}

std::size_t DrawingBook::size() const {
    return static_cast<std::size_t>(list_.drawings_size());
}

browser::Drawings DrawingBook::message() const {
    browser::Drawings message;
    *message.mutable_drawings() = list_.drawings();
    *message.mutable_species() = list_.species();
    for (const auto& [number, picture] : pictures_) {
        if (!picture.png) continue;
        browser::DrawingPicture& one = *message.add_pictures();
        one.set_number(number);
        one.set_tag(picture.tag);
    }
    return message;
}

}  // namespace aquarama::console
