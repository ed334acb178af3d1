// SPDX-License-Identifier: Apache-2.0
#include "guests/visitor_drawings.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

namespace aquarama::guests {

namespace {

using nlohmann::json;
using web::HttpReply;
using web::HttpRequest;

constexpr std::string_view kPath = "/drawing/";
constexpr std::chrono::seconds kUploadTime{30};
constexpr int kGood = 200;

// -1, 0 or 1 of a target; nothing where it is none.
std::optional<int> asideOf(const HttpRequest& request) {
    constexpr std::array<std::string_view, 3> kSides{"left", "middle", "right"};
    const std::string_view side = std::string_view(request.target).substr(kPath.size());
    const auto found = std::ranges::find(kSides, side);
    if (found == kSides.end()) return std::nullopt;
    return static_cast<int>(found - kSides.begin()) - 1;
}

// The page has a line for each word.
HttpReply refusalOf(int status, const char* word) {
    return {.status = status, .body = word};
}

const char* nameOf(WallDrawing::Condition condition) {
    constexpr std::array kNames{"waiting", "swimming", "homeless", "leaving"};
    return kNames.at(static_cast<std::size_t>(condition));
}

}  // namespace

VisitorDrawings::VisitorDrawings(DrawingPlace place, Sessions& sessions, VisitedWall& wall)
    : place_{std::move(place)},
      sessions_{sessions},
      port_{wall},
      uploads_{std::make_shared<const char>()} {}

bool VisitorDrawings::isMeant(const HttpRequest& request) {
    return request.method == "POST" && request.target.starts_with(kPath);
}

GuestId VisitorDrawings::senderOf(const HttpRequest& request) const {
    constexpr std::string_view kScheme = "Bearer ";
    if (!request.authorization.starts_with(kScheme)) return {};
    return sessions_.guestOf(request.authorization.substr(kScheme.size()));
}

HttpReply VisitorDrawings::objectionTo(const HttpRequest& head) const {
    if (senderOf(head).empty()) return refusalOf(401, "session");
    if (!asideOf(head)) return refusalOf(404, "off");
    return isOpen() ? HttpReply{} : refusalOf(503, "off");
}

HttpReply VisitorDrawings::objectionTo(const Visit& visit, double now) {
    if (visit.isBeingRead || now < visit.mayDraw) return refusalOf(429, "soon");
    const bool isCrowd = static_cast<std::size_t>(uploads_.use_count()) > kMostUploads;
    return !isCrowd && pictures_.take(now) ? HttpReply{} : refusalOf(503, "crowd");
}

std::optional<web::BodyLimit> VisitorDrawings::admit(const HttpRequest& head,
                                                     double now,
                                                     HttpReply& refusal) {
    refusal = objectionTo(head);
    if (refusal.status != kGood) return std::nullopt;
    Visit& visit = *sessions_.find(senderOf(head));
    refusal = objectionTo(visit, now);
    if (refusal.status != kGood) return std::nullopt;
    visit.mayDraw = now + kBetween;
    return web::BodyLimit{
        .mostBytes = ask::kMostPictureBytes, .within = kUploadTime, .place = uploads_};
}

HttpReply VisitorDrawings::take(const HttpRequest& request) {
    if (HttpReply objection = objectionTo(request); objection.status != kGood) return objection;
    const GuestId guest = senderOf(request);
    Visit& visit = *sessions_.find(guest);
    if (visit.isBeingRead) return refusalOf(429, "soon");
    const int aside = *asideOf(request);
    const bool isTaken =
        place_.read(request.body, [this, guest, aside](const ask::DrawingOutcome& outcome) {
            wasRead(guest, aside, outcome);
        });
    if (!isTaken) return refusalOf(503, "crowd");
    visit.isBeingRead = true;
    visit.refusedDrawing.clear();
    return {.status = 202};
}

void VisitorDrawings::wasRead(const GuestId& guest, int aside, const ask::DrawingOutcome& outcome) {
    if (const auto* refused = std::get_if<ask::DrawingRefused>(&outcome))
        return refuse(guest, refused->word);
    const auto& drawing = std::get<ask::ReadDrawing>(outcome);
    const auto& known = place_.species;
    if (std::ranges::find(known, drawing.species) == known.end())
        return refuse(guest, "unknown_species");
    const std::uint64_t request = ask::freshRequest();
    offers_[request] = guest;
    port_.offer(
        {.request = request, .species = drawing.species, .skin = drawing.skin, .aside = aside});
}

// Of a visitor who was forgotten meanwhile there is nobody to tell.
void VisitorDrawings::refuse(const GuestId& guest, const std::string& word) {
    Visit* const visit = sessions_.find(guest);
    if (visit == nullptr) return;
    visit->isBeingRead = false;
    visit->refusedDrawing = word;
}

void VisitorDrawings::offered(std::uint64_t request, std::uint32_t number) {
    const auto offer = offers_.extract(request);
    if (offer.empty()) return;
    if (number == 0) return refuse(offer.mapped(), "no_room");
    Visit* const visit = sessions_.find(offer.mapped());
    if (visit == nullptr) return;
    visit->isBeingRead = false;
    fresh_.insert(number);
    visit->drawings.push_back(number);
    if (visit->drawings.size() > Visit::kMostDrawings)
        visit->drawings.erase(visit->drawings.begin());
}

// A number comes before the list that has it.
void VisitorDrawings::heard(std::shared_ptr<const WallDrawings> drawings) {
    wall_ = std::move(drawings);
    std::erase_if(fresh_, [this](std::uint32_t number) { return find(number) != nullptr; });
}

void VisitorDrawings::does(std::uint32_t fish, const FishDeed& deed) {
    deeds_[fish] = deed;
}

const WallDrawing* VisitorDrawings::find(std::uint32_t number) const {
    if (!wall_) return nullptr;
    const auto found = wall_->find(number);
    return found == wall_->end() ? nullptr : &found->second;
}

void VisitorDrawings::watch(const std::set<GuestId>& guests) {
    std::set<std::uint32_t> fish;
    for (const GuestId& guest : guests)
        if (const Visit* const visit = sessions_.find(guest))
            for (const std::uint32_t number : visit->drawings)
                if (const WallDrawing* const drawing = find(number); drawing && drawing->fish)
                    fish.insert(*drawing->fish);
    std::erase_if(deeds_, [&](const auto& deed) { return !fish.contains(deed.first); });
    port_.watch(fish);
}

// "gone" where the wall has it no more.
json VisitorDrawings::toldOf(std::uint32_t number) const {
    const WallDrawing* const drawing = find(number);
    json told{{"number", number}, {"is", drawing ? nameOf(drawing->condition) : "gone"}};
    if (!drawing || drawing->condition != WallDrawing::Condition::Swimming || !drawing->fish)
        return told;
    const auto deed = deeds_.find(*drawing->fish);
    if (deed == deeds_.end()) return told;
    told["does"] = deed->second.does;
    told["whom"] = deed->second.whom;
    told["saw"] = deed->second.saw;
    return told;
}

json VisitorDrawings::told(const GuestId& guest, double now) const {
    if (!isOpen()) return nullptr;
    const Visit& visit = *sessions_.find(guest);
    json fish = json::array();
    for (const std::uint32_t number : visit.drawings)
        if (!fresh_.contains(number)) fish.push_back(toldOf(number));
    return {{"wait_s", std::lround(std::ceil(std::max(visit.mayDraw - now, 0.0)))},
            {"reading", visit.isBeingRead},
            {"refused", visit.refusedDrawing},
            {"fish", std::move(fish)}};
}

}  // namespace aquarama::guests
