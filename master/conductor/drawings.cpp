// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/drawings.h"

#include <algorithm>
#include <chrono>
#include <span>

#include "common/base/log.h"
#include "common/body/side_view.h"

namespace aquarama::conductor {
namespace {

// Nodes have so long to load a skin before its fish is seen; one at a time comes in.
constexpr net::Duration kLoads = std::chrono::seconds(2);
constexpr std::size_t kMostListed = 8;  // of those that wait
// A fish that was told to leave is not looked at before, as records are a few ticks old.
constexpr net::Duration kUntilAway = std::chrono::seconds(1);
// What is not kept goes after so long, also where nobody closes the day.
constexpr std::uint64_t kDaySeconds = 20 * 3600;
constexpr std::size_t kMostRetired = 32;

net::Blob blobOf(const std::string& bytes) {
    const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
    return std::make_shared<const std::vector<std::byte>>(first, first + bytes.size());
}

}  // namespace

Drawings::Drawings(std::optional<config::DrawingRules> rules, std::filesystem::path folder)
    : rules_{std::move(rules)}, files_{rules_ ? std::move(folder) : std::filesystem::path{}} {
    FoundDrawings found = files_.read();
    lastNumber_ = found.lastNumber;
    for (KeptEntry& kept : found.drawings) {
        const Digest picture = digestOf(*kept.skin);
        if (kept.request != 0) take(kept.request, kept.number);
        entries_.push_back({.kept = std::move(kept), .picture = picture});
    }
}

void Drawings::enter(std::vector<DrawingSlots> slots) {
    slots_ = std::move(slots);
    toLeave_.clear();
    inputs_.clear();
    std::erase_if(entries_, [](const Entry& entry) { return entry.isForgotten; });
    for (Entry& entry : entries_) entry.rest();
    findWorn();
    changed();
}

// Which drawings fish of the world wear already.
void Drawings::findWorn() {
    for (const DrawingSlots& slots : slots_)
        for (std::size_t i = 0; i < slots.worn.size(); ++i)
            if (slots.worn[i] != 0)
                takeOver(slots.worn[i], slots.first + static_cast<std::uint32_t>(i));
}

// A fish that wears a drawing already. One that the crew does not want leaves.
void Drawings::takeOver(std::uint32_t number, std::uint32_t fish) {
    Entry* const entry = find(number);
    if (entry == nullptr || !entry->kept.isLetIn || entry->fish) {
        inputs_.emplace_back(world::LeaveDrawing{fish});
        return;
    }
    entry->fish = fish;
    entry->listed = net::monotonicNow();
}

Drawings::Entry* Drawings::find(std::uint32_t number) {
    const auto found = std::ranges::find_if(
        entries_, [&](const Entry& entry) { return entry.kept.number == number; });
    return found == entries_.end() ? nullptr : &*found;
}

std::string Drawings::objectionTo(const v1::OfferedDrawing& offered) const {
    if (!rules_) return "the rig has no drawings; give it a block drawings { }";
    if (!body::beginsAsSkin(std::as_bytes(std::span(offered.skin()))))
        return "the picture is no skin, a PNG of 1024 x 512 pixels; read the sheet again";
    if (std::ranges::find(rules_->species, offered.species()) == rules_->species.end())
        return "the rig has no drawings of " + offered.species();
    if (entries_.size() >= std::size_t{wire::kMostDrawings})
        return "no room for more drawings; take some down";
    return {};
}

ask::Answer Drawings::offer(std::uint64_t request,
                            const v1::OfferedDrawing& offered,
                            std::uint64_t unixSeconds,
                            std::uint32_t& number) {
    if (const TakenRequest* const known = requests_.find(request)) {
        number = known->number;
        return answerOf(*known);
    }
    if (std::string objection = objectionTo(offered); !objection.empty())
        return ask::refused(std::move(objection));
    lastNumber_ = lastNumber_ % motion::kMostSkin + 1;
    number = lastNumber_;
    const net::Blob skin = blobOf(offered.skin());
    entries_.push_back({.kept = {.number = number,
                                 .species = offered.species(),
                                 .isLetIn = rules_->areLetInAtOnce,
                                 .aside = offered.aside(),
                                 .offeredAt = unixSeconds,
                                 .request = request,
                                 .skin = skin},
                        .picture = digestOf(*skin)});
    logInfo("drawing {}: a {}", number, offered.species());
    changed();
    return answerOf(take(request, number));
}

const TakenRequest& Drawings::take(std::uint64_t request, std::uint32_t number) {
    return requests_.add({request, number, state_, net::monotonicNow()});
}

ask::Answer Drawings::answerOf(const TakenRequest& taken) {
    files_.turn();
    return requests_.answerOf(taken, files_.isKept(taken.state));
}

void Drawings::decideOne(Entry& entry, const v1::Moderation& moderation) {
    if (moderation.has_aside()) entry.kept.aside = moderation.aside();
    const v1::Moderation::Verdict verdict = moderation.verdict();
    switch (verdict) {
        case v1::Moderation::LET_IN:
            entry.kept.isLetIn = true;
            return;
        case v1::Moderation::KEEP:
        case v1::Moderation::KEEP_NO_MORE:
            entry.kept.isKept = verdict == v1::Moderation::KEEP;
            return;
        case v1::Moderation::END_DAY:
            if (!entry.kept.isKept) takeDown(entry);
            return;
        default:
            takeDown(entry);
    }
}

ask::Answer Drawings::decide(const std::string& user,
                             std::uint64_t request,
                             const v1::Moderation& moderation) {
    if (const TakenRequest* const known = requests_.find(request)) return answerOf(*known);
    if (!rules_) return ask::refused("the rig has no drawings; give it a block drawings { }");
    if (moderation.number() == 0) {
        for (Entry& entry : entries_) decideOne(entry, moderation);
    } else {
        Entry* const entry = find(moderation.number());
        if (entry == nullptr)
            return ask::refused("there is no drawing " + std::to_string(moderation.number()) +
                                " any more");
        decideOne(*entry, moderation);
    }
    logInfo("{} decides about drawing {} (0: all): {}",
            user,
            moderation.number(),
            v1::Moderation::Verdict_Name(moderation.verdict()));
    changed();
    return answerOf(take(request, 0));
}

// One that swims leaves first.
void Drawings::takeDown(Entry& entry) {
    entry.isForgotten = true;
    if (entry.swims()) toLeave_.push_back(*entry.fish);
}

// A fish that the world was not told of yet is away as well: nobody has left before all inputs are
// taken.
void Drawings::turn(std::span<const motion::FishRecord> fish,
                    bool maySwim,
                    net::Moment now,
                    std::uint64_t unixSeconds,
                    const Apply& apply) {
    if (!rules_) return;
    files_.turn();
    forgetOld(unixSeconds);
    if (inputs_.empty()) endLeft(fish, now);
    if (maySwim)
        enterNext(fish, now);
    else
        for (const Entry& entry : entries_)
            if (entry.swims()) toLeave_.push_back(*entry.fish);
    sendAway(now);
    while (!inputs_.empty() && apply(inputs_.front())) inputs_.pop_front();
}

void Drawings::sendAway(net::Moment now) {
    for (Entry& entry : entries_) {
        const bool isTold =
            entry.swims() && std::ranges::find(toLeave_, *entry.fish) != toLeave_.end();
        if (!isTold) continue;
        entry.leaving = now;
        inputs_.emplace_back(world::LeaveDrawing{*entry.fish});
        changed();
    }
    toLeave_.clear();
}

void Drawings::forgetOld(std::uint64_t unixSeconds) {
    for (Entry& entry : entries_) {
        const bool isOld = unixSeconds > entry.kept.offeredAt + kDaySeconds;
        if (isOld && !entry.kept.isKept && !entry.isForgotten) takeDown(entry);
    }
}

bool Drawings::Entry::hasLeft(std::span<const motion::FishRecord> of, net::Moment now) const {
    return fish && leaving && now - *leaving > kUntilAway && *fish < of.size() &&
           motion::isAway(of[*fish]);
}

void Drawings::endLeft(std::span<const motion::FishRecord> fish, net::Moment now) {
    bool isChange = false;
    for (Entry& entry : entries_) {
        if (!entry.hasLeft(fish, now)) continue;
        entry.rest();
        isChange = true;
    }
    const std::size_t gone = std::erase_if(
        entries_, [](const Entry& entry) { return entry.isForgotten && !entry.fish; });
    if (isChange || gone > 0) changed();
}

std::size_t Drawings::swimming() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(entries_, [](const Entry& entry) { return entry.swims(); }));
}

bool Drawings::hasRoomFor(const std::string& species) const {
    return std::ranges::find(slots_, species, &DrawingSlots::species) != slots_.end();
}

std::optional<std::uint32_t> Drawings::unwornFish(const std::string& species,
                                                  bool isAway,
                                                  std::span<const motion::FishRecord> fish) const {
    const auto slots = std::ranges::find(slots_, species, &DrawingSlots::species);
    if (slots == slots_.end()) return std::nullopt;
    for (std::uint32_t one = slots->first; one < std::min<std::size_t>(slots->last, fish.size());
         ++one) {
        const bool isWorn =
            std::ranges::any_of(entries_, [&](const Entry& entry) { return entry.fish == one; });
        if (!isWorn && motion::isAway(fish[one]) == isAway) return one;
    }
    return std::nullopt;
}

std::vector<Drawings::Entry*> Drawings::nextToEnter() {
    std::vector<Entry*> next;
    for (Entry& entry : entries_) {
        const bool waits = entry.kept.isLetIn && !entry.isForgotten && !entry.fish;
        if (waits && hasRoomFor(entry.kept.species) && next.size() < kMostListed)
            next.push_back(&entry);
    }
    return next;
}

// Nodes are told of the skins of those that wait; once they have had time to load it, the first is
// given a fish.
void Drawings::enterNext(std::span<const motion::FishRecord> fish, net::Moment now) {
    const std::vector<Entry*> waiting = nextToEnter();
    if (waiting.empty()) return;
    if (std::ranges::any_of(waiting, [](const Entry* entry) { return !entry->listed; })) {
        for (Entry* const entry : waiting) entry->listed = entry->listed.value_or(now);
        changed();
    }
    Entry* const next = waiting.front();
    if (now - *next->listed < kLoads) return;
    if (swimming() >= rules_->most) return makeRoom({});
    const auto free = unwornFish(next->kept.species, true, fish);
    if (!free && unwornFish(next->kept.species, false, fish)) return;  // it leaves
    if (!free) return makeRoom(next->kept.species);
    next->fish = free;
    inputs_.emplace_back(world::EnterDrawing{.fish = *free,
                                             .number = next->kept.number,
                                             .picture = next->picture,
                                             .aside = next->kept.aside});
    changed();
}

// One that leaves already makes room enough.
void Drawings::makeRoom(const std::string& species) {
    std::vector<Entry*> swimmers;
    for (Entry& entry : entries_)
        if (entry.fish && (species.empty() || entry.kept.species == species))
            swimmers.push_back(&entry);
    if (std::ranges::any_of(swimmers,
                            [](const Entry* entry) { return entry->leaving.has_value(); }))
        return;
    const auto oldest =
        std::ranges::find_if(swimmers, [](const Entry* entry) { return !entry->kept.isKept; });
    if (oldest != swimmers.end())
        takeDown(**oldest);
    else if (!swimmers.empty())
        takeDown(*swimmers.front());
}

std::optional<std::uint64_t> Drawings::version() const {
    return rules_ ? std::optional(version_) : std::nullopt;
}

v1::DrawingStatus::Condition Drawings::conditionOf(const Entry& entry) const {
    if (entry.leaving || entry.isForgotten) return v1::DrawingStatus::LEAVING;
    if (!entry.kept.isLetIn) return v1::DrawingStatus::WAITING;
    return entry.fish || hasRoomFor(entry.kept.species) ? v1::DrawingStatus::SWIMMING
                                                        : v1::DrawingStatus::HOMELESS;
}

v1::DrawingStatus Drawings::statusOf(const Entry& entry) const {
    v1::DrawingStatus status;
    status.set_number(entry.kept.number);
    status.set_species(entry.kept.species);
    status.set_condition(conditionOf(entry));
    if (entry.fish) status.set_fish(*entry.fish);
    status.set_kept(entry.kept.isKept);
    status.set_offered_at(entry.kept.offeredAt);
    status.set_aside(entry.kept.aside);
    return status;
}

v1::DrawingsReply Drawings::reply(const v1::DrawingsRequest& request) const {
    v1::DrawingsReply reply;
    reply.set_version(version_);
    reply.set_skin_of(request.skin_of());
    for (const Entry& entry : entries_) {
        *reply.add_drawings() = statusOf(entry);
        if (entry.kept.number == request.skin_of())
            reply.set_skin(entry.kept.skin->data(), entry.kept.skin->size());
    }
    if (rules_)
        for (const std::string& species : rules_->species)
            if (hasRoomFor(species)) reply.add_species(species);
    return reply;
}

net::Blob Drawings::blob(const Digest& digest) const {
    if (const auto known = blobs_.find(digest); known != blobs_.end()) return known->second;
    if (digest == kept_.digest) return kept_.list;
    const auto retired =
        std::ranges::find(retired_, digest, &decltype(retired_)::value_type::first);
    if (retired != retired_.end()) return retired->second;
    const auto entry = std::ranges::find(entries_, digest, &Entry::picture);
    return entry == entries_.end() ? nullptr : entry->kept.skin;
}

void Drawings::changed() {
    ++version_;
    tellSkins();
    keep();
}

void Drawings::keep() {
    std::vector<KeptEntry> kept;
    v1::KeptDrawings list;
    list.set_last_number(lastNumber_);
    for (const Entry& entry : entries_) {
        if (entry.isForgotten) continue;
        kept.push_back(entry.kept);
        v1::KeptDrawing& one = *list.add_drawings() = listed(entry.kept);
        one.set_picture(wire::bytesOf(entry.picture));
    }
    state_ = files_.keep(lastNumber_, std::move(kept));
    kept_.list = blobOf(list.SerializeAsString());
    kept_.digest = digestOf(*kept_.list);
}

// Lists the skins that are worn or will be soon.
void Drawings::tellSkins() {
    v1::SkinList list;
    std::map<Digest, net::Blob> blobs;
    for (const Entry& entry : entries_) {
        if (!entry.fish && !entry.listed) continue;
        v1::ListedSkin& skin = *list.add_skins();
        skin.set_number(entry.kept.number);
        skin.set_picture(wire::bytesOf(entry.picture));
        skin.set_species(entry.kept.species);
        blobs[entry.picture] = entry.kept.skin;
    }
    list_.reset();
    if (list.skins_size() > 0) {
        const net::Blob encoded = blobOf(list.SerializeAsString());
        list_ = digestOf(*encoded);
        blobs[*list_] = encoded;
    }
    replaceBlobs(std::move(blobs));
}

// Those of before are kept for a while.
void Drawings::replaceBlobs(std::map<Digest, net::Blob> blobs) {
    for (auto& [digest, blob] : blobs_)
        if (!blobs.contains(digest)) retired_.emplace_back(digest, std::move(blob));
    while (retired_.size() > kMostRetired) retired_.pop_front();
    blobs_ = std::move(blobs);
}

}  // namespace aquarama::conductor
