// SPDX-License-Identifier: Apache-2.0
// How a species lives: what it feels, fears, eats and likes, as its file says. Formulas: Tu &
// Terzopoulos 1994 and Tu 1996, with their time units taken as seconds and their distances given in
// metres or body lengths (docs/minds.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace aquarama::config {

// Prey escapes and schools and does not mate; a pacifist mates and neither escapes nor schools; a
// predator hunts, and neither escapes, schools, mates nor leaves.
enum class Role : std::uint8_t { Prey, Pacifist, Predator };

struct Span {
    double least = 0, most = 0;
};

// Of the fish of a species, the share that has a habit, 0 to 1; a fish draws its own by the seed.
struct HabitShares {
    double schooling = 0, brightness = 0, darkness = 0, warmth = 0, cold = 0;
    double female = 0.5;
};

// A fish feels threatened by what is inside this box about its middle line, in its own body
// lengths. Timid fish have large ones.
struct SensitivityBox {
    float aheadBodyLengths = 1.2F, asideBodyLengths = 0.4F, upBodyLengths = 0.35F;
};

// Shares of the time that a fish at ease swims so; they sum to 1.
struct Paces {
    double hover = 0, slow = 0.6, medium = 0.3, fast = 0.1;
};

enum class HomeKind : std::uint8_t { None, School, Place };
// A place of the fish's own, drawn by the seed in the water: it goes about within the radius and
// turns back at the leash.
struct Home {
    HomeKind kind = HomeKind::None;
    double radiusMetres = 2, leashMetres = 5;
    bool onTheReef = false;  // by a rock where there is one, and low
};

struct Hunt {
    double chaseSeconds = 8;  // at most
    double giveUpMetres = 6;  // a prey that is farther is let go
    double restSeconds = 60;  // after a chase
};

struct Habits {
    Role role = Role::Prey;
    // Hunger: appetite alpha in particles of plankton, digestion p0 per second.
    float appetiteParticles = 4, digestionPerSecond = 0.004F;
    float libidoPerSecond = 0;  // p1; 0: never mates
    // Fear: a predator at this distance or nearer frightens wholly (D0); fear above f0 is heeded,
    // above f1 a schooling fish flees alone.
    float fearMetres = 1.6F, fearFrom = 0.25F, fearAlone = 0.6F;
    HabitShares shares;
    Span depthMetres{1, 40};
    double bestDepthMetres = 6;
    Span light{0, 1};
    Span waterCelsius{20, 32};
    Paces paces;
    double gradualShare = 0.8;  // of turns for no reason; the others are sharp
    float visionBodyLengths = 14;
    float smellBodyLengths = 16;  // food is sensed so far in every direction
    SensitivityBox box;
    float persistence = 0.3F;  // another target must be nearer by this share to be preferred
    Home home;
    bool eatsPlankton = true;
    std::vector<std::string> hunts;  // species by name
    Hunt hunt;
    double pairBodyLengths = 0;        // keeps this near to a partner of its species; 0: alone
    std::vector<std::string> shadows;  // species that it likes to follow closely
};

}  // namespace aquarama::config
