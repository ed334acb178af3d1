// SPDX-License-Identifier: Apache-2.0
#include "guests/sessions.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/random_bytes.h"

namespace aquarama::guests {

namespace {

constexpr std::size_t kNameLetters = 64;  // of a SHA-256 in hex

constexpr const char* kReading = " reading";

bool isName(const std::string& text) {
    return text.size() == kNameLetters &&
           text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Of a visitor's drawings, up to the end of his line.
void readDrawings(std::istream& words, Visit& visit) {
    std::string rest;
    std::getline(words, rest);
    const std::string reading = kReading;
    if (rest.starts_with(reading)) {
        visit.refusedDrawing = "lost";
        rest = rest.substr(reading.size());
    }
    std::istringstream numbers(rest);
    std::uint32_t number = 0;
    while (visit.drawings.size() < Visit::kMostDrawings && numbers >> number)
        visit.drawings.push_back(number);
}

}  // namespace

std::optional<std::string> Sessions::admit(double now) {
    if (visits_.size() >= kMost) {
        const auto leaves = std::ranges::min_element(visits_, {}, [&](const auto& one) {
            return one.second.phone != nullptr ? now : one.second.seen;
        });
        if (leaves->second.phone != nullptr) return std::nullopt;
        visits_.erase(leaves);
    }
    std::string secret;
    for (const unsigned char byte : randomBytes<16>()) secret += fmt::format("{:02x}", byte);
    visits_[toHex(digestOf(secret))] = {.seen = now};
    return secret;
}

GuestId Sessions::guestOf(const std::string& secret) const {
    GuestId guest = toHex(digestOf(secret));
    return visits_.contains(guest) ? guest : GuestId{};
}

Visit* Sessions::find(const GuestId& guest) {
    const auto visit = visits_.find(guest);
    return visit == visits_.end() ? nullptr : &visit->second;
}

std::vector<GuestId> Sessions::forget(double now) {
    std::vector<GuestId> forgotten;
    for (const auto& [guest, visit] : visits_) {
        const double kept = visit.drawings.empty() ? kForgotten : kForgottenDrawn;
        if (visit.phone == nullptr && now - visit.seen > kept) forgotten.push_back(guest);
    }
    for (const GuestId& guest : forgotten) visits_.erase(guest);
    return forgotten;
}

void Sessions::keep(const std::filesystem::path& file,
                    const VisitorQueue& queue,
                    double now) const {
    std::string text;
    const auto add = [&](const GuestId& guest, double left) {
        const Visit& visit = visits_.at(guest);
        text += fmt::format("{} {:.1f}{}", guest, left, visit.isBeingRead ? kReading : "");
        for (const std::uint32_t number : visit.drawings) text += fmt::format(" {}", number);
        text += '\n';
    };
    std::set<GuestId> seated;
    for (const GuestSeat& seat : queue.seats()) {
        add(seat.guest, queue.leftOf(seat, now));
        seated.insert(seat.guest);
    }
    for (const auto& [guest, visit] : visits_)
        if (!seated.contains(guest)) add(guest, 0);
    keepIfPossible(file,
                   std::as_bytes(std::span(text)),
                   "visitors lose their places where aquarama-guests is started again");
}

std::vector<GuestSeat> Sessions::restore(const std::filesystem::path& file, double now) {
    std::vector<GuestSeat> seats;
    std::ifstream lines(file);
    for (std::string line; visits_.size() < kMost && std::getline(lines, line);) {
        std::istringstream words(line);
        GuestSeat seat;
        words >> seat.guest;
        if (!isName(seat.guest)) continue;
        const auto [visit, isNew] = visits_.try_emplace(seat.guest, Visit{.seen = now});
        if (!isNew || !(words >> seat.left)) continue;
        if (seat.left > 0) seats.push_back(seat);
        readDrawings(words, visit->second);
    }
    return seats;
}

}  // namespace aquarama::guests
