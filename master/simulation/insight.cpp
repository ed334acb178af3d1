// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/insight.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/base/units.h"
#include "common/place/place.h"
#include "master/behaviour/perceive.h"

namespace aquarama::simulation {

std::optional<Insight> insightInto(const world::World& world, std::uint32_t fish) {
    if (fish >= world.traits().size()) return std::nullopt;
    const behaviour::Environment environment = world.environment();
    const fish::FishView& view = *environment.view;
    const fish::Courses& courses = world.courses();
    const motion::MotionStates& states = world.states();
    Insight insight;
    insight.fish = fish;
    insight.tick = world.tick();
    insight.parameters = environment.speciesParameters[view.kind[fish]];
    insight.lengthMetres = static_cast<float>(world.traits()[fish].lengthMillimetres) * 0.001F;
    insight.away = view.shows(fish, fish::kAway);
    insight.mind = world.minds()[fish];
    insight.course = courses[fish];
    insight.segment = motion::actionOf(states.segment[fish]);
    insight.phase = static_cast<float>(states.phase[fish]) / 65536.0F;
    insight.swims = motion::speedBodyLengths(states, fish);
    if (insight.away) return insight;
    // The stages of a thought, as think() runs them, but with nothing written back.
    insight.senses = behaviour::perceive(environment, insight.parameters, fish, insight.mind);
    insight.feelings = behaviour::feel(insight.parameters, insight.mind, insight.senses);
    insight.reasoning =
        behaviour::reason(insight.parameters, insight.mind, insight.senses, insight.feelings);
    return insight;
}

namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

double seconds(std::uint32_t ticks) {
    return static_cast<double>(ticks) / kTicksPerSecond;
}

// Words for roles, indexed by Role.
const char* wordFor(config::Role role) {
    constexpr std::array<const char*, 3> kWords{"prey", "pacifist", "predator"};
    return kWords[static_cast<std::size_t>(role)];
}

// Sex and likes, as a list of words.
std::string likesOf(const fish::Mind& mind) {
    std::string words = (mind.likes & fish::kIsFemale) != 0 ? "female" : "male";
    constexpr std::array<std::pair<fish::Like, const char*>, 5> kWords{
        {{fish::kLikesSchooling, "company"},
         {fish::kLikesBrightness, "light"},
         {fish::kLikesDarkness, "darkness"},
         {fish::kLikesWarmth, "warmth"},
         {fish::kLikesCold, "cold"}}};
    bool first = true;
    for (const auto& [like, word] : kWords) {
        if ((mind.likes & like) == 0) continue;
        words += std::exchange(first, false) ? ", likes " : ", ";
        words += word;
    }
    return words;
}

// From the heading to a direction, about the world's up; negative is to the right.
double degreesLeft(glm::vec3 heading, glm::vec3 direction) {
    return static_cast<double>(place::yawBetween(heading, direction)) * kDegreesPerRadian;
}

// Where something lies so far to the left of the heading, in words: eight sectors.
std::string whereabouts(double degrees) {
    const double aside = std::abs(degrees);
    const char* side = degrees > 0 ? "left" : "right";
    if (aside < 25) return "ahead";
    if (aside < 65) return fmt::format("ahead {}", side);
    if (aside < 115) return side;
    return aside < 155 ? fmt::format("behind {}", side) : std::string("behind");
}

// Composes the screen section by section. The title of a section stands in the left margin of its
// first line, nine characters wide.
class Screen {
  public:
    Screen(const Insight& insight, const Acquaintances& others) : of_(insight), others_(others) {}

    conductor::Explanation explained() {
        title();
        if (of_.away) {
            add("", "it is away: eaten, or not yet come. Nobody sees it, and it thinks nothing.");
            return std::move(told_);
        }
        sees();
        feels();
        intends();
        does();
        why();
        assert(told_.lines.size() <= kScreenLines);
        return std::move(told_);
    }

  private:
    using Kind = conductor::NearestSeen::Kind;

    // Appends a line, cut to the width of the screen.
    void add(const char* head, const std::string& text) {
        told_.lines.push_back(fmt::format("{:<9}{}", head, text).substr(0, kScreenColumns));
    }

    // In body lengths of the fish; its length may be 0 in an empty insight.
    [[nodiscard]] double lengths(double metres) const {
        return metres / std::max(1e-3, static_cast<double>(of_.lengthMetres));
    }

    // Name of the species of a fish that exists.
    [[nodiscard]] const std::string& speciesOf(std::uint32_t fish) const {
        return others_.species[others_.view.kind[fish]];
    }

    // Number and species; the number alone where there is no such fish.
    [[nodiscard]] std::string named(std::uint32_t fish) const {
        if (fish >= others_.view.size()) return fmt::format("#{}", fish);
        return fmt::format("#{} {}", fish, speciesOf(fish)).substr(0, kScreenColumns);
    }

    [[nodiscard]] static std::string particle(std::uint32_t number) {
        return fmt::format("particle {}", number);
    }

    // A sighting in words: its name, how far it is in body lengths (L), and where. Adds it to the
    // values.
    [[nodiscard]] std::string at(Kind kind,
                                 const behaviour::Sighting& sighting,
                                 const std::string& name) {
        if (!sighting.seen()) return "-";
        const double distance = lengths(static_cast<double>(sighting.distance));
        const double left = degreesLeft(of_.senses.heading, sighting.offset);
        told_.seen.push_back({kind, name, static_cast<float>(distance), static_cast<float>(-left)});
        return fmt::format("{}, {:.1f} L {}", name, distance, whereabouts(left));
    }

    void title() {
        add("FISH", fmt::format("{} {}   tick {}", of_.fish, speciesOf(of_.fish), of_.tick.value));
        add("",
            fmt::format("{:.3f} m long (1 L), {}, {}",
                        of_.lengthMetres,
                        wordFor(of_.parameters.habits.role),
                        likesOf(of_.mind)));
    }

    // As many neighbours as fit into kListColumns, nearest first.
    [[nodiscard]] std::string listed(const behaviour::Neighbours& near) const {
        std::string list = near.count == 0 ? "-" : "";
        for (std::size_t i = 0; i < near.count; ++i) {
            const double distance = std::sqrt(static_cast<double>(near.distanceSquared[i]));
            const std::string one =
                fmt::format("{}#{} {:.1f}", i == 0 ? "" : "  ", near.fish[i], lengths(distance));
            if (list.size() + one.size() > kListColumns) return list + "  ..";
            list += one;
        }
        return list;
    }

    // The nearest predator, and how many more are in sight.
    [[nodiscard]] std::string predators() {
        const behaviour::Senses& senses = of_.senses;
        if (senses.predatorCount == 0) return "-";
        const std::string others =
            senses.predatorCount > 1 ? fmt::format(" and {} more", senses.predatorCount - 1) : "";
        return fishSeen(Kind::Predator, senses.predators[0]) + others;
    }

    [[nodiscard]] std::string fishSeen(Kind kind, const behaviour::Sighting& sighting) {
        return at(kind, sighting, named(sighting.object));
    }

    void sees() {
        const behaviour::Senses& senses = of_.senses;
        add("SEES", "schoolmates " + listed(senses.schoolmates));
        add("", "others      " + listed(senses.others));
        add("", "predator    " + predators());
        add("", "food        " + at(Kind::Food, senses.food, particle(senses.food.object)));
        const std::string mate = fishSeen(Kind::Mate, senses.mate);
        add("", "mate        " + mate + "   prey " + fishSeen(Kind::Prey, senses.prey));
        add("",
            fmt::format("submarine   {:.1f} m   light {:.0f} %   water {:.1f} C",
                        senses.submarineMetres,
                        100 * static_cast<double>(senses.climate.light),
                        senses.climate.celsius));
    }

    // A bar of 20 cells for a value of 0 to 1.
    [[nodiscard]] static std::string bar(float value) {
        constexpr std::size_t kCells = 20;
        const auto full =
            static_cast<std::size_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * float{kCells}));
        return fmt::format("[{:.<{}}] {:.2f}", std::string(full, '#'), kCells, value);
    }

    void feels() {
        told_.feelings = of_.feelings;
        add("FEELS", "hunger " + bar(of_.feelings.hunger));
        add("", "libido " + bar(of_.feelings.libido));
        add("", "fear   " + bar(of_.feelings.fear));
        if (!of_.parameters.habits.hidesIn.empty()) add("", "threat " + bar(of_.feelings.threat));
    }

    // The target is a particle for those that eat food, a fish for all others; empty where there
    // is none.
    [[nodiscard]] std::string targetOf(fish::Intention intention, std::uint32_t target) const {
        if (target == fish::kNobody) return {};
        if (intention == fish::Intention::Hide || intention == fish::Intention::Rest)
            return fmt::format("site {}", target);
        if (intention == fish::Intention::Graze) return fmt::format("patch {}", target);
        const bool isParticle = intention == fish::Intention::Eat &&
                                of_.parameters.habits.role != config::Role::Predator;
        return isParticle ? particle(target) : named(target);
    }

    [[nodiscard]] std::string targeted(fish::Intention intention, std::uint32_t target) const {
        const std::string what = targetOf(intention, target);
        return what.empty() ? fish::nameOf(intention)
                            : fmt::format("{} {}", fish::nameOf(intention), what);
    }

    // The intention, and the aim that it interrupted, if any.
    void intends() {
        const fish::Mind& mind = of_.mind;
        told_.intention = mind.intention;
        told_.target = targetOf(mind.intention, mind.target);
        told_.pursuedSeconds = static_cast<float>(seconds(mind.pursued));
        add("INTENDS",
            fmt::format("{}, its aim for {:.1f} s",
                        targeted(mind.intention, mind.target),
                        seconds(mind.pursued)));
        if (mind.remembered != fish::Intention::Wander)
            add("",
                fmt::format("remembers: {}, {:.1f} s ago",
                            targeted(mind.remembered, mind.rememberedTarget),
                            seconds(mind.sinceRemembered)));
    }

    // What the body plays and what the course asks of it. Angles are relative to the heading.
    void does() {
        const fish::Course& course = of_.course;
        const double climb =
            std::asin(std::clamp(static_cast<double>(course.direction.y), -1.0, 1.0)) *
            kDegreesPerRadian;
        const double left = degreesLeft(of_.senses.heading, course.direction);
        add("DOES",
            fmt::format("{} at {:.0f} %, swims {:.2f} L/s, urgency {:.2f}",
                        motion::nameOf(of_.segment),
                        100 * static_cast<double>(of_.phase),
                        of_.swims,
                        course.urgency));
        add("",
            fmt::format("wants {:.0f} degrees {}, {:.0f} {}, {:.2f} L/s",
                        std::abs(left),
                        left < 0 ? "right" : "left",
                        std::abs(climb),
                        climb < 0 ? "down" : "up",
                        course.speed));
    }

    [[nodiscard]] std::string verdictOn(behaviour::PriorityRule rule,
                                        const behaviour::Weighed& weighed) const;
    void why();

    // Width of a list of neighbours, in characters.
    static constexpr std::size_t kListColumns = 54;
    const Insight& of_;
    const Acquaintances& others_;
    conductor::Explanation told_;
};

// Words for rules, indexed by PriorityRule.
constexpr std::array<const char*, behaviour::kPriorityRules> kPriorityRuleNames{"obstacle",
                                                                                "shelter",
                                                                                "other fish",
                                                                                "fear",
                                                                                "rest",
                                                                                "territory",
                                                                                "memory",
                                                                                "cleaning",
                                                                                "hunger",
                                                                                "libido",
                                                                                "climate",
                                                                                "company",
                                                                                "ease"};

// Words for Verdict::NoTarget of a rule.
std::string notInView(behaviour::PriorityRule rule) {
    switch (rule) {
        case behaviour::PriorityRule::OtherFish:
            return "nobody is in its way";
        case behaviour::PriorityRule::Climate:
            return "it is nowhere better";
        case behaviour::PriorityRule::Memory:
            return "what was interrupted cannot be resumed";
        case behaviour::PriorityRule::Territory:
            return "nobody intrudes";
        case behaviour::PriorityRule::Shelter:
            return "no shelter is near";
        case behaviour::PriorityRule::Cleaning:
            return "no cleaner or client is near";
        default:
            return "none is in view";
    }
}

// Why a rule won or did not: one phrase for each verdict.
std::string Screen::verdictOn(behaviour::PriorityRule rule,
                              const behaviour::Weighed& weighed) const {
    const bool shelters =
        rule == behaviour::PriorityRule::Fear && weighed.intention == fish::Intention::School;
    switch (weighed.verdict) {
        case behaviour::Verdict::Wins:
            return fmt::format("WINS: {}{}",
                               targeted(weighed.intention, weighed.target),
                               shelters ? ", for shelter" : "");
        case behaviour::Verdict::Outranked:
            return fmt::format("{}: comes after {}",
                               targeted(weighed.intention, weighed.target),
                               kPriorityRuleNames[static_cast<std::size_t>(of_.reasoning.winner)]);
        case behaviour::Verdict::AgainstHabits:
            return "not in its nature";
        case behaviour::Verdict::TooWeak:
            return fmt::format("too weak, {:.2f} of {:.2f}", weighed.value, weighed.threshold);
        case behaviour::Verdict::NoTarget:
            return notInView(rule);
        case behaviour::Verdict::Nothing:
            return "nothing was interrupted";
        case behaviour::Verdict::TooOld:
            return fmt::format(
                "forgotten: {:.1f} s ago, more than {:.0f}", weighed.value, weighed.threshold);
        case behaviour::Verdict::Resting:
            return rule == behaviour::PriorityRule::Territory ? "rests from the last charge"
                                                              : "rests from the last chase";
        case behaviour::Verdict::Sheltered:
            return rule == behaviour::PriorityRule::OtherFish ? "rests in its shelter"
                                                              : "a shelter is near";
        case behaviour::Verdict::Awake:
            return "awake: these are its active hours";
        case behaviour::Verdict::Yields:
            break;
    }
    if (rule == behaviour::PriorityRule::Cleaning) return "yields to its aim";
    return rule == behaviour::PriorityRule::Hunger ? "yields to libido" : "yields to hunger";
}

// One line for each rule in order of priority. If the decision differs from the present intention,
// the winner only takes effect at the next thought.
void Screen::why() {
    const bool changes = of_.reasoning.decision.intention != of_.mind.intention;
    for (std::size_t i = 0; i < behaviour::kPriorityRules; ++i)
        add(i == 0 ? "WHY" : "",
            fmt::format(
                "{:<12}{}",
                kPriorityRuleNames[i],
                verdictOn(static_cast<behaviour::PriorityRule>(i), of_.reasoning.rules[i])) +
                (changes && i == static_cast<std::size_t>(of_.reasoning.winner)
                     ? ", at its next thought"
                     : ""));
}

}  // namespace

conductor::Explanation explanationOf(const Insight& insight, const Acquaintances& others) {
    assert(insight.fish < others.view.size());
    return Screen(insight, others).explained();
}

}  // namespace aquarama::simulation
