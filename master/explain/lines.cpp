// SPDX-License-Identifier: Apache-2.0
#include "master/explain/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/place/angle.h"
#include "common/units/ids.h"

namespace aquarama {

namespace {

using fmt::format;

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

double seconds(std::uint32_t ticks) {
    return static_cast<double>(ticks) / kTicksPerSecond;
}

const char* wordFor(Intention intention) {
    constexpr std::array<const char*, kIntentions> kWords{
        "wander", "leave", "school", "eat", "mate", "escape", "avoid fish", "avoid obstacle"};
    return kWords[static_cast<std::size_t>(intention)];
}

const char* wordFor(Role role) {
    constexpr std::array<const char*, 3> kWords{"prey", "pacifist", "predator"};
    return kWords[static_cast<std::size_t>(role)];
}

std::string likesOf(const Mind& mind) {
    std::string words = (mind.likes & kIsFemale) != 0 ? "female" : "male";
    constexpr std::array<std::pair<Like, const char*>, 5> kWords{{{kLikesSchooling, "company"},
                                                                  {kLikesBrightness, "light"},
                                                                  {kLikesDarkness, "darkness"},
                                                                  {kLikesWarmth, "warmth"},
                                                                  {kLikesCold, "cold"}}};
    bool first = true;
    for (const auto& [like, word] : kWords) {
        if ((mind.likes & like) == 0) continue;
        words += std::exchange(first, false) ? ", likes " : ", ";
        words += word;
    }
    return words;
}

double degreesLeft(glm::vec3 heading, glm::vec3 direction) {
    return static_cast<double>(yawBetween(heading, direction)) * kDegreesPerRadian;
}

std::string whereabouts(glm::vec3 heading, glm::vec3 offset) {
    const double degrees = degreesLeft(heading, offset);
    const double aside = std::abs(degrees);
    const char* side = degrees > 0 ? "left" : "right";
    if (aside < 25) return "ahead";
    if (aside < 65) return format("ahead {}", side);
    if (aside < 115) return side;
    return aside < 155 ? format("behind {}", side) : std::string("behind");
}

// The screen grows line by line; a head stands in the margin of its first line.
class Screen {
  public:
    Screen(const Insight& insight, const Acquaintances& others) : of_(insight), others_(others) {}

    std::vector<std::string> drawn() {
        title();
        if (of_.away) {
            add("", "it is away: eaten, or not yet come. Nobody sees it, and it thinks nothing.");
            return std::move(lines_);
        }
        sees();
        feels();
        intends();
        does();
        why();
        return std::move(lines_);
    }

  private:
    void add(const char* head, const std::string& text) {
        lines_.push_back(format("{:<9}{}", head, text).substr(0, kScreenColumns));
    }

    [[nodiscard]] double lengths(double metres) const {
        return metres / std::max(1e-3, static_cast<double>(of_.lengthMetres));
    }

    [[nodiscard]] const std::string& speciesOf(std::uint32_t fish) const {
        return others_.species[others_.view.kind[fish]];
    }

    [[nodiscard]] std::string named(std::uint32_t fish) const {
        if (fish >= others_.view.size()) return format("#{}", fish);
        return format("#{} {}", fish, speciesOf(fish));
    }

    [[nodiscard]] std::string at(const Sighting& sighting, const std::string& who) const {
        if (!sighting.seen()) return "-";
        return format("{}, {:.1f} L {}",
                      who,
                      lengths(static_cast<double>(sighting.distance)),
                      whereabouts(of_.senses.heading, sighting.offset));
    }

    void title() {
        add("FISH", format("{} {}   tick {}", of_.fish, speciesOf(of_.fish), of_.tick.value));
        add("",
            format("{:.3f} m long (1 L), {}, {}",
                   of_.lengthMetres,
                   wordFor(of_.nature.role),
                   likesOf(of_.mind)));
    }

    [[nodiscard]] std::string listed(const Neighbours& near) const {
        std::string list = near.count == 0 ? "-" : "";
        for (std::size_t i = 0; i < near.count; ++i) {
            const double distance = std::sqrt(static_cast<double>(near.distanceSquared[i]));
            const std::string one =
                format("{}#{} {:.1f}", i == 0 ? "" : "  ", near.fish[i], lengths(distance));
            if (list.size() + one.size() > kListColumns) return list + "  ..";
            list += one;
        }
        return list;
    }

    [[nodiscard]] std::string predators() const {
        const Senses& senses = of_.senses;
        if (senses.predatorCount == 0) return "-";
        const std::string others =
            senses.predatorCount > 1 ? format(" and {} more", senses.predatorCount - 1) : "";
        return at(senses.predators[0], named(senses.predators[0].object)) + others;
    }

    [[nodiscard]] std::string fishSeen(const Sighting& sighting) const {
        return at(sighting, named(sighting.object));
    }

    void sees() {
        const Senses& senses = of_.senses;
        add("SEES", "schoolmates " + listed(senses.schoolmates));
        add("", "others      " + listed(senses.others));
        add("", "predator    " + predators());
        add("", "food        " + at(senses.food, format("particle {}", senses.food.object)));
        add("", "mate        " + fishSeen(senses.mate) + "   prey " + fishSeen(senses.prey));
        add("",
            format("submarine   {:.1f} m   light {:.0f} %   water {:.1f} C",
                   senses.submarineMetres,
                   100 * static_cast<double>(senses.light),
                   senses.celsius));
    }

    [[nodiscard]] static std::string bar(float value) {
        constexpr std::size_t kCells = 20;
        const auto full =
            static_cast<std::size_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * float{kCells}));
        return format("[{:.<{}}] {:.2f}", std::string(full, '#'), kCells, value);
    }

    void feels() {
        add("FEELS", "hunger " + bar(of_.feelings.hunger));
        add("", "libido " + bar(of_.feelings.libido));
        add("", "fear   " + bar(of_.feelings.fear));
    }

    [[nodiscard]] std::string targeted(Intention intention, std::uint32_t target) const {
        if (target == kNobody) return wordFor(intention);
        const bool isParticle = intention == Intention::Eat && of_.nature.role != Role::Predator;
        return format("{} {}",
                      wordFor(intention),
                      isParticle ? format("particle {}", target) : named(target));
    }

    void intends() {
        const Mind& mind = of_.mind;
        add("INTENDS",
            format("{}, its aim for {:.1f} s",
                   targeted(mind.intention, mind.target),
                   seconds(mind.pursued)));
        if (mind.remembered != Intention::Wander)
            add("",
                format("remembers: {}, {:.1f} s ago",
                       targeted(mind.remembered, mind.rememberedTarget),
                       seconds(mind.sinceRemembered)));
    }

    void does() {
        const Course& course = of_.course;
        const double climb =
            std::asin(std::clamp(static_cast<double>(course.direction.y), -1.0, 1.0)) *
            kDegreesPerRadian;
        const double left = degreesLeft(of_.senses.heading, course.direction);
        add("DOES",
            format("{} at {:.0f} %, swims {:.2f} L/s, urgency {:.2f}",
                   nameOf(of_.segment),
                   100 * static_cast<double>(of_.phase),
                   of_.swims,
                   course.urgency));
        add("",
            format("wants {:.0f} degrees {}, {:.0f} {}, {:.2f} L/s",
                   std::abs(left),
                   left < 0 ? "right" : "left",
                   std::abs(climb),
                   climb < 0 ? "down" : "up",
                   course.speed));
    }

    [[nodiscard]] std::string verdictOn(Rung rung, const Weighed& weighed) const;
    void why();

    static constexpr std::size_t kListColumns = 54;
    const Insight& of_;
    const Acquaintances& others_;
    std::vector<std::string> lines_;
};

constexpr std::array<const char*, kRungs> kRungNames{
    "obstacle", "other fish", "fear", "memory", "hunger", "libido", "climate", "company", "ease"};

std::string notInView(Rung rung) {
    switch (rung) {
        case Rung::OtherFish:
            return "nobody is in its way";
        case Rung::Climate:
            return "it is nowhere better";
        case Rung::Memory:
            return "what was interrupted cannot be resumed";
        default:
            return "none is in view";
    }
}

std::string Screen::verdictOn(Rung rung, const Weighed& weighed) const {
    const bool shelters = rung == Rung::Fear && weighed.intention == Intention::School;
    switch (weighed.verdict) {
        case Verdict::Wins:
            return format("WINS: {}{}",
                          targeted(weighed.intention, weighed.target),
                          shelters ? ", for shelter" : "");
        case Verdict::Outranked:
            return format("{}: comes after {}",
                          targeted(weighed.intention, weighed.target),
                          kRungNames[static_cast<std::size_t>(of_.reasoning.winner)]);
        case Verdict::AgainstNature:
            return "not in its nature";
        case Verdict::TooWeak:
            return format("too weak, {:.2f} of {:.2f}", weighed.value, weighed.threshold);
        case Verdict::NoTarget:
            return notInView(rung);
        case Verdict::Nothing:
            return "nothing was interrupted";
        case Verdict::TooOld:
            return format(
                "forgotten: {:.1f} s ago, more than {:.0f}", weighed.value, weighed.threshold);
        case Verdict::Resting:
            return "rests from the last chase";
        case Verdict::Yields:
            break;
    }
    return rung == Rung::Hunger ? "yields to libido" : "yields to hunger";
}

void Screen::why() {
    const bool changes = of_.reasoning.decision.intention != of_.mind.intention;
    for (std::size_t i = 0; i < kRungs; ++i)
        add(i == 0 ? "WHY" : "",
            format("{:<12}{}",
                   kRungNames[i],
                   verdictOn(static_cast<Rung>(i), of_.reasoning.rungs[i])) +
                (changes && i == static_cast<std::size_t>(of_.reasoning.winner)
                     ? ", at its next thought"
                     : ""));
}

}  // namespace

std::vector<std::string> linesOf(const Insight& insight, const Acquaintances& others) {
    return Screen(insight, others).drawn();
}

}  // namespace aquarama
