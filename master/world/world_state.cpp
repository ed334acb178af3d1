// SPDX-License-Identifier: Apache-2.0
#include "master/world/world_state.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "common/base/byte_stream.h"
#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/base/movement_versions.h"
#include "common/motion/repertoire.h"

namespace aquarama::world {

namespace {

constexpr std::string_view kMagic = "AQSAV";
constexpr std::uint16_t kFormat = 1;
constexpr std::size_t kDigestBytes = 32;
constexpr double kLeastDaySeconds = 1e-3;
constexpr float kMostFloat = 1e5F;  // of metres, speeds and shares: far beyond any water

// Every number of a state in a fixed order, for those who write and read it: on(numbers and
// columns...), on.list(list, members...) of a list that keeps its length,
// on.growing(list, most, members...) of one that does not, and on.optional(value, members...).

template <class State, class Visitor>
void visitMotion(State& state, Visitor& on) {
    auto& states = state.states;
    on(states.x, states.y, states.z);
    on(states.orientationA, states.orientationB, states.orientationC);
    on(states.orientationLargest, states.phase, states.segment);
    on(states.fromPhase, states.fromSegment, states.warpFrame, states.warpLength);
    on(states.speed, states.spread, states.mouth, states.gaze);
    auto& commands = state.commands;
    on(commands.action, commands.phaseRate, commands.brake);
    on(commands.mouth, commands.gaze, commands.pitch, commands.yawRate);
}

template <class State, class Visitor>
void visitMinds(State& state, Visitor& on) {
    using fish::Mind;
    on.list(state.minds, &Mind::intention, &Mind::target, &Mind::pursued, &Mind::remembered);
    on.list(state.minds, &Mind::rememberedTarget, &Mind::sinceRemembered, &Mind::sinceMeal);
    on.list(state.minds, &Mind::sinceSpawning, &Mind::sinceChase, &Mind::sinceArrival);
    on.list(state.minds, &Mind::sinceCharge, &Mind::sinceCleaning, &Mind::alarm, &Mind::spot);
    on.list(state.minds, &Mind::eaten, &Mind::likes, &Mind::stage, &Mind::bites, &Mind::charged);
    on.list(state.minds, &Mind::sinceStage, &Mind::thoughtAt);
    using fish::Course;
    on.list(state.courses, &Course::direction, &Course::speed, &Course::urgency);
    on.list(state.courses, &Course::startsFast, &Course::openToChange, &Course::face);
    on(state.memory.chosenAt, state.memory.heldUntil);
    on(state.memory.patience, state.memory.recoversAt);
    on(state.signs);
    using fish::Wearer;
    on.list(state.wearers, &Wearer::visit, &Wearer::since, &Wearer::aside);
    on.list(state.wearers, &Wearer::number, &Wearer::picture);
}

template <class State, class Visitor>
void visitSurroundings(State& state, Visitor& on) {
    auto& food = state.food;
    on(food.x, food.y, food.z, food.lowest, food.kind, food.taken);
    on(food.generation, food.absentUntil, food.pellets);
    on(state.turf);
    on.list(state.structures, &surroundings::Structure::tiredOf, &surroundings::Structure::fright);
    using surroundings::HeldHand;
    on.growing(state.hands.hands,
               kMostWallHands,
               &HeldHand::seen,
               &HeldHand::heard,
               &HeldHand::quick,
               &HeldHand::still,
               &HeldHand::eye,
               &HeldHand::direction,
               &HeldHand::place);
    on(state.hands.heard);
    on(state.clock.since, state.clock.timeOfDay, state.clock.lengthSeconds);
    using surroundings::DayCue;
    on.optional(state.dayCue, &DayCue::holds, &DayCue::since, &DayCue::way, &DayCue::ticks);
    on(state.timeOfDay, state.nextDrop);
    auto& pilot = state.pilot;
    on(pilot.vessel.position, pilot.vessel.velocity, pilot.vessel.attitude);
    on(pilot.vessel.rate, pilot.vessel.push, pilot.steering);
    on(pilot.heldUntil, pilot.autopilotFrom, pilot.along);
    on(pilot.touring, pilot.everSteered);
}

template <class State, class Visitor>
void visitState(State& state, Visitor& on) {
    on(state.tick);
    visitMotion(state, on);
    visitMinds(state, on);
    visitSurroundings(state, on);
    const std::size_t all = state.states.size();
    on(state.goal.position, state.goal.velocityMetresPerSecond);
    on(state.goal.mill, state.goal.flatness);
    using Swallow = Meals::Swallow;
    on.growing(state.meals.swallows, all, &Swallow::fish, &Swallow::particle, &Swallow::ticksLeft);
    on.growing(state.released, all, &fish::Released::fish, &fish::Released::since);
    on.growing(state.absences, all, &Absence::fish, &Absence::until);
    auto& counts = state.counts;
    on(counts.meals, counts.catches, counts.spawnings, counts.returns);
    on(counts.bites, counts.puffs, counts.charges);
}

// Values of which every part is a float.
template <class Value>
concept Floats = std::is_same_v<Value, float> || std::is_same_v<Value, glm::vec3> ||
    std::is_same_v<Value, surroundings::Attitude> || std::is_same_v<Value, surroundings::Push>;
// Values without padding, whose bytes are their numbers.
template <class Value>
concept Plain = std::is_trivially_copyable_v<Value> &&
    (std::has_unique_object_representations_v<Value> || Floats<Value> ||
     std::is_same_v<Value, double> || std::is_same_v<Value, WallHand>);

struct Writer {
    ByteWriter& out;

    template <class... Values>
    void operator()(const Values&... values) {
        (one(values), ...);
    }
    template <class List, class... Members>
    void list(const List& values, Members... members) {
        one(std::uint64_t{values.size()});
        (write(values, members), ...);
    }
    template <class List, class... Members>
    void growing(const List& values, std::size_t, Members... members) {
        list(values, members...);
    }
    template <class Value, class... Members>
    void optional(const std::optional<Value>& value, Members... members) {
        one(value.has_value());
        if (value) (one((*value).*members), ...);
    }

  private:
    void one(const std::optional<double>& value) {
        one(value.has_value());
        one(value.value_or(0));
    }
    template <Plain Value>
    void one(const Value& value) {
        out.numbers(std::span<const Value>(&value, 1));
    }
    template <Plain Value>
    void one(const std::vector<Value>& column) {
        one(std::uint64_t{column.size()});
        out.numbers(std::span<const Value>(column));
    }
    template <class List, class Member>
    void write(const List& values, Member member) {
        for (std::size_t i = 0; i < values.size(); ++i) one(values[i].*member);
    }
};

// Throws Error where a list has another length than it can have, or a number is beyond all bounds.
struct Reader {
    ByteReader& in;
    const std::string& source;

    template <class... Values>
    void operator()(Values&... values) {
        (one(values), ...);
    }
    template <class List, class... Members>
    void list(List& values, Members... members) {
        requireLength(values.size(), values.size());
        (read(values, members), ...);
    }
    template <class List, class... Members>
    void growing(List& values, std::size_t most, Members... members) {
        values.resize(requireLength(0, most));
        (read(values, members), ...);
    }
    template <class Value, class... Members>
    void optional(std::optional<Value>& value, Members... members) {
        bool has = false;
        one(has);
        value.reset();
        if (!has) return;
        value.emplace();
        (one((*value).*members), ...);
    }

  private:
    void one(std::optional<double>& value) {
        bool has = false;
        double number = 0;
        one(has);
        one(number);
        if (has) value = number;
    }
    std::size_t requireLength(std::size_t least, std::size_t most) {
        const auto length = in.unsignedNumber<std::uint64_t>();
        if (length < least || length > most)
            throw Error(fmt::format("{}: it is of another world: a list of {} where this has {}",
                                    source,
                                    length,
                                    most));
        return length;
    }
    template <Plain Value>
    void one(Value& value) {
        in.numbers(std::span<Value>(&value, 1));
        requireBounded(value);
    }
    void one(bool& value) { value = in.unsignedNumber<std::uint8_t>() != 0; }
    template <Plain Value>
    void one(std::vector<Value>& column) {
        requireLength(column.size(), column.size());
        in.numbers(std::span<Value>(column));
        for (const Value& value : column) requireBounded(value);
    }
    template <class List, class Member>
    void read(List& values, Member member) {
        for (std::size_t i = 0; i < values.size(); ++i) one(values[i].*member);
    }
    template <class Value>
    void requireBounded(const Value& value) const {
        bool isBounded = true;
        if constexpr (Floats<Value>)
            for (const float part :
                 std::bit_cast<std::array<float, sizeof(Value) / sizeof(float)>>(value))
                isBounded = isBounded && std::abs(part) <= kMostFloat;
        if constexpr (std::is_same_v<Value, double>) isBounded = std::isfinite(value);
        if constexpr (std::is_same_v<Value, WallHand>) requireBounded(value.point);
        if (!isBounded) throw Error(source + ": a number in it is beyond all bounds");
    }
};

// Checks of a state that was read: every number that is used as an index, and every choice.
struct Checker {
    const WorldState& state;
    const StateBounds& bounds;
    const std::string& source;

    void run() const {
        each("fish", state.states.size(), [&](std::size_t i) {
            return isSound(static_cast<std::uint32_t>(i));
        });
        for (const fish::SpeciesParameters& species : bounds.species)
            for (std::uint32_t fish = species.first; fish < species.last; ++fish)
                require(targetsExist(species, state.minds[fish]), "the aim of fish", fish);
        each("drawing", state.wearers.size(), [&](std::size_t i) {
            return isSound(state.wearers[i]);
        });
        each("particle", state.food.size(), [&](std::size_t i) {
            return state.food.kind[i] <= surroundings::FoodKind::Pellet;
        });
        each("meal", state.meals.swallows.size(), [&](std::size_t i) {
            return isSound(state.meals.swallows[i]);
        });
        each("absence", state.absences.size(), [&](std::size_t i) {
            return isFish(state.absences[i].fish);
        });
        each("released hunter", state.released.size(), [&](std::size_t i) {
            return isFish(state.released[i].fish);
        });
        require(!state.dayCue || isSound(*state.dayCue), "the day's cue", 0);
        require(state.nextDrop <= bounds.surroundings.drops.size(), "drop", state.nextDrop);
        require(isTime(state.timeOfDay) && isSound(state.clock), "the time of day", 0);
    }

  private:
    void require(bool sound, const char* what, std::size_t number) const {
        if (!sound) throw Error(fmt::format("{}: {} {} in it cannot be", source, what, number));
    }
    template <class IsSound>
    void each(const char* what, std::size_t count, const IsSound& isSound) const {
        for (std::size_t i = 0; i < count; ++i) require(isSound(i), what, i);
    }
    [[nodiscard]] bool isFish(std::uint32_t fish) const { return fish < state.states.size(); }
    [[nodiscard]] static bool isTime(double day) { return day >= 0 && day < 1; }

    [[nodiscard]] bool isSound(std::uint32_t fish) const {
        const fish::Mind& mind = state.minds[fish];
        const auto isKnown = [](fish::Intention intention) {
            return static_cast<std::size_t>(intention) < fish::kIntentions;
        };
        return motion::isPlayable(motion::recordOf(state.states, fish)) &&
               state.states.orientationLargest[fish] < 4 &&
               state.commands.action[fish] < motion::kActions &&
               state.commands.phaseRate[fish] >= 0 && isKnown(mind.intention) &&
               isKnown(mind.remembered) && mind.alarm <= fish::Alarm::Alone &&
               mind.spot < surroundings::kSpots;
    }
    [[nodiscard]] bool targetsExist(const fish::SpeciesParameters& species,
                                    const fish::Mind& mind) const {
        return targetExists(species, mind.intention, mind.target) &&
               targetExists(species, mind.remembered, mind.rememberedTarget);
    }
    [[nodiscard]] bool targetExists(const fish::SpeciesParameters& species,
                                    fish::Intention intention,
                                    std::uint32_t target) const {
        return target == fish::kNobody || target < countOfTargets(species, intention);
    }
    // How many things there are of the kind that an intention is aimed at.
    [[nodiscard]] std::size_t countOfTargets(const fish::SpeciesParameters& species,
                                             fish::Intention intention) const {
        using enum fish::Intention;
        switch (intention) {
            case Graze:
                return bounds.surroundings.turf.patches.size();
            case Rest:
            case Hide:
                return bounds.surroundings.sites.size();
            case School:
                return bounds.surroundings.structures.size();
            case Eat:
                return species.habits.role == config::Role::Predator ? state.states.size()
                                                                     : state.food.size();
            default:
                return state.states.size();
        }
    }
    [[nodiscard]] bool isSound(const fish::Wearer& wearer) const {
        return wearer.visit <= fish::Visit::Leaves && std::abs(wearer.aside) <= 1 &&
               wearer.number <= motion::kMostSkin;
    }
    [[nodiscard]] bool isSound(const place::DayClock& clock) const {
        const bool goes = clock.lengthSeconds >= kLeastDaySeconds;
        return clock.since <= state.tick && isTime(clock.timeOfDay) &&
               (clock.lengthSeconds == 0 || goes);
    }
    [[nodiscard]] bool isSound(const surroundings::DayCue& cue) const {
        return cue.since <= state.tick && std::abs(cue.way) <= 1 &&
               (!cue.holds || isTime(*cue.holds));
    }
    [[nodiscard]] bool isSound(const Meals::Swallow& swallow) const {
        return isFish(swallow.fish) && swallow.particle < state.food.size() &&
               swallow.ticksLeft > 0;
    }
};

void writeHead(ByteWriter& out) {
    out.characters(kMagic);
    for (const int version : {int{kFormat}, kMotorVersion, kMindsVersion})
        out.unsignedNumber(static_cast<std::uint16_t>(version));
}

void readHead(ByteReader& in, const std::string& source) {
    if (in.characters(kMagic.size()) != kMagic) throw Error(source + ": it is no saved world");
    for (const auto& [what, own] : {std::pair{"format", int{kFormat}},
                                    std::pair{"motor", kMotorVersion},
                                    std::pair{"minds", kMindsVersion}}) {
        const int version = in.unsignedNumber<std::uint16_t>();
        if (in.ok() && version != own)
            throw Error(fmt::format(
                "{}: saved by another build, with version {} of the {}; this one has {}",
                source,
                version,
                what,
                own));
    }
}

}  // namespace

std::vector<std::byte> encodeState(const WorldState& state) {
    ByteWriter out;
    writeHead(out);
    Writer writer{out};
    visitState(state, writer);
    out.characters(digestOf(out.written()).bytes);
    return std::move(out).take();
}

WorldState decodeState(std::span<const std::byte> bytes,
                       const WorldState& like,
                       const StateBounds& bounds,
                       const std::string& source) {
    ByteReader head(bytes);
    readHead(head, source);
    const std::size_t body = bytes.size() - std::min(bytes.size(), kDigestBytes);
    ByteReader digest(bytes.subspan(body));
    const std::string kept = digest.characters(kDigestBytes);
    const Digest own = digestOf(bytes.first(body));
    if (kept != std::string(own.bytes.begin(), own.bytes.end()))
        throw Error(source + ": the saved world is damaged");
    ByteReader in(bytes.first(body));
    readHead(in, source);
    WorldState state = like;
    Reader reader{in, source};
    visitState(state, reader);
    if (!in.ok() || in.remaining() > 0)
        throw Error(source + ": the saved world is cut off or too long");
    Checker{state, bounds, source}.run();
    return state;
}

}  // namespace aquarama::world
