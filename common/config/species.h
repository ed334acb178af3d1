// SPDX-License-Identifier: Apache-2.0
// A species of fish as its file describes it: shape, biomechanics, gaits, habits and colours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aquarama::config {

// On the animal lengths are body lengths: s from 0 at the nose to 1 at the tip of the tail, y up.
// Columns of equal length, ascending s.
struct BodyProfile {
    std::vector<float> stations;
    std::vector<float> dorsal;
    std::vector<float> ventral;  // positive
    std::vector<float> halfWidth;
    // Of the section above and below the axis: the exponent of a superellipse, |z|^n + |y|^n = 1.
    std::vector<float> fullnessUp, fullnessDown;
};

// A ruled patch of points (s, y): ray by ray from the base on the body to the edge.
struct Fin {
    std::vector<glm::vec2> base;
    std::vector<glm::vec2> edge;
    float angleRadians = 0.0F;  // paired fins: how far it stands off the flank
    float round = 0.0F;         // paired fins: 1 makes a paddle of what is drawn
    float flex = 1.0F;          // median fins and tail: how far it ripples
};

// All fins of a fish; of pelvic and pectoral fins, which come in pairs, one.
struct Fins {
    Fin firstDorsal;  // the only one, along the whole back, where there is no second
    std::optional<Fin> secondDorsal;
    Fin anal, caudal, pelvic, pectoral;
};

// How the pectoral fins row and trim, at their most; all zero: they keep still (species.proto).
struct Rowing {
    float beatHertz = 0;
    float strokeRadians = 0, featherRadians = 0, openRadians = 0, flapRadians = 0;
    float leadRadians = 0, twistRadians = 0, middleRadians = 0;
    float trimRadians = 0;
    // Whether they row at all.
    [[nodiscard]] bool rows() const { return strokeRadians > 0; }
};
// Of the median fins, from their front to their end.
struct Ripple {
    float amplitude = 0;  // lengths of a ray
    float waves = 0;
    float beatHertz = 0;
    bool isOpposed = false;
};
// Ripples: in time with the tail, and of a fish that stands.
struct FinMotion {
    Rowing rowing;
    Ripple swimming, hovering;
    float cuppingRadians = 0, pelvicFoldRadians = 0;
};

// A ball that stands out of the skin.
struct FishEye {
    float s = 0.0F;
    float y = 0.0F;
    float radius = 0.0F;
    float bulge = 0.35F;  // height over the skin, in radii
};

// What shows of the teeth, in the schema's order.
enum class Teeth : std::uint8_t { Hidden, Pointed, Beak };

// The lips meet along the line from front to corner, (s, y) as seen from the side; the lower jaw
// turns about its joint.
struct Mouth {
    glm::vec2 front{}, corner{}, joint{};
    float lip = 0.0025F;  // width of each lip
    // Wide open: so far the lower jaw turns, and the upper one slides forward.
    float gapeRadians = 0.0F;
    float protrusion = 0.0F;
    Teeth teeth = Teeth::Hidden;
};

// The gill cover: the station of its hind edge at mid-height, how much further forward that is at
// back and belly, and how far it lifts off the flank.
struct Gill {
    float s = 0.24F, bow = 0.035F, flare = 0.008F;
};

// Thinner than the cage can draw, in the middle plane of the body.
struct Thread {
    std::vector<glm::vec2> at;                // (s, y) from its root to its tip
    float rootWidth = 0.0F, tipWidth = 0.0F;  // seen from the side
    bool isOfFirstDorsal = false;
};

// Four nodal points about the axis.
struct SkeletonRing {
    double s = 0, halfHeight = 0, halfWidth = 0;
    double nodeMass = 0;
};

// The nodal points at rest; masses count relative to each other.
struct Skeleton {
    std::array<SkeletonRing, 5> rings;
    double tailHalfSpan = 0;
    double noseMass = 0;
    double tailTipMass = 0;
};

// Units: body lengths, the animal's mass, and its own seconds, of which timeScale make one of ours.
struct Tissue {
    double timeScale = 1;
    double stiffness = 0, crossStiffness = 0, muscleStiffness = 0;
    double tailStiffening = 1;  // factor on all units behind ring 3
    double damping = 0;
    double muscleContraction = 0;  // share of its length lost at full contraction
};

// How the water resists the body.
struct Water {
    double drag = 0;         // mu: force on an advancing face = mu * area * (normal speed)^2
    double frontFactor = 1;  // share of that on the head
    double finDrag = 0;      // of each pectoral fin: force = finDrag * normal speed
};

// Of steady swimming.
struct Gait {
    double beatHertz = 0;
    double gain = 1;
    double rows = 0;  // share of the stroke of the pectoral fins
};

// The muscles of the middle and the back beat left against right, the back ones later.
struct Swim {
    double middleDrive = 0, backDrive = 0;  // contraction, 0 to 1
    double backLagRadians = 0;
    Gait slow, medium, fast;
};

// Of the whole body to one side, quick to come and slow to go.
struct Bend {
    double strength = 0;  // 0 to 1
    double tempo = 1;     // 1: over in 1.45 of the fish's own seconds
};

// A stage of a fast start: how hard the muscles of one side contract, 0 to 1, and for how long.
struct StartStage {
    double front = 0, middle = 0, back = 0;
    double seconds = 0;
};

// A C-start: the body bends to one side, then it beats to the other and swims on. Factors are of
// what the relaxed tissue has.
struct FastStart {
    double tone = 1;         // stiffness of all tissue while it lasts
    double tailTone = 1;     // further, of the tail
    double muscleTone = 1;   // further, of a muscle that contracts fully
    double contraction = 1;  // of Tissue::muscleContraction
    StartStage bend, stroke;
    double lagSeconds = 0;                    // from one segment to the next
    double riseSeconds = 0, fallSeconds = 0;  // of each contraction
    double beatPhase = 0;                     // 0 to 1, with which it swims on
};

// The two turns of the repertoire, either to both sides.
struct Turn {
    Bend gradual, sharp;
};

// How long the fish of a species are: a bell curve, cut off.
struct SizeRange {
    float meanMetres = 0.24F, deviationMetres = 0.012F, leastMetres = 0.20F, mostMetres = 0.28F;
};

// The colour of a part of the skin.
struct Paint {
    std::string part;
    glm::vec3 linear{};  // Rec. 709
};

// Prey escapes and schools; a pacifist does neither; a predator hunts, and neither escapes, schools
// nor leaves. In the schema's order.
enum class Role : std::uint8_t { Prey, Pacifist, Predator };

// From one bound to the other, both included.
struct Span {
    double least = 0, most = 0;
};

// Of the fish of a species, the share that has a habit, 0 to 1; a fish draws its own by the seed.
struct HabitShares {
    double schooling = 0, brightness = 0, darkness = 0, warmth = 0, cold = 0;
    double female = 0.5;
    // Where the sex follows from the size: the least length of a male, or of a female, metres.
    std::optional<float> maleFromMetres = {}, femaleFromMetres = {};
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

// What a site of a reef is to the animals that know it.
enum class SiteKind : std::uint8_t { Anemone, Branching, Ledge, Hole, Turf, Cleaning };
inline constexpr std::size_t kSiteKinds = 6;

// What a fish keeps to.
enum class HomeKind : std::uint8_t { None, School, Place };

// A place of the fish's own, drawn by the seed in the water: it goes about within the radius and
// turns back at the leash.
struct Home {
    HomeKind kind = HomeKind::None;
    double radiusMetres = 2, leashMetres = 5;
    bool onTheReef = false;             // by a boulder where there is one
    std::optional<SiteKind> site = {};  // at one of these sites where there is one
    std::uint32_t group = 2;            // as many share a home
};

// Life over a home: height of the largest fish above it, and the mean time from one particle that
// it picks to the next.
struct Cloud {
    double heightMetres = 1, pickSeconds = 3;
};

// Feeding on turf. A shoal goes together; on a loop each fish goes round patches of its own. In the
// schema's order.
enum class GrazeManner : std::uint8_t { Shoal, Loop };
struct Graze {
    GrazeManner manner = GrazeManner::Shoal;
    double share = 1;  // of the time at ease
    double bitesPerSecond = 2;
    std::uint32_t leastBites = 3, mostBites = 10;  // at one spot
    std::uint32_t bitesPerParticle = 10;           // that feed as much as one particle
    double sandSeconds = 0;  // from one puff of sand to the next, in the mean; 0: none
};

// A share of its fish each hold the water about their home.
struct Territory {
    double radiusMetres = 1, share = 1;
};

// The hunt of one that lies in wait: it creeps up to prey that it notices and rushes at prey that
// is nearer, both from its mouth; it waits head down by an angle, at so many posts in turn.
struct Ambush {
    double noticesMetres = 1, strikesMetres = 0.2;
    double hangsDegrees = 0;
    std::uint32_t posts = 1;
};

// When a species is active, in the schema's order.
enum class Activity : std::uint8_t { Always, Day, Night };

// The hours of a species: it rests outside them. Where they begin and end, as shares of the
// twilight: one of the day retires in the course of dusk and rises in that of dawn, one of the
// night retires at dawn and rises at dusk.
struct ActiveHours {
    Activity active = Activity::Always;
    double retires = 0.5, rises = 0.5;
};

// Of predators.
struct Hunt {
    double chaseSeconds = 8;  // at most
    double giveUpMetres = 6;  // a prey that is farther is let go
    // After a chase: at dusk and by night, and by day.
    double restSeconds = 60, restByDaySeconds = 60;
    std::optional<Ambush> ambush = {};  // none: it stalks
};

// It cleans larger fish at its home; each for a third of this time to all of it.
struct Cleans {
    double inspectSeconds = 12;
};

// Appetite alpha in particles of plankton, digestion p0 per second.
struct Hunger {
    float appetiteParticles = 4, digestionPerSecond = 0.004F;
    bool eatsPlankton = true;
};

// A predator at this distance or nearer frightens wholly (D0); fear above f0 is heeded, above f1 a
// schooling fish flees alone.
struct Fear {
    float metres = 1.6F, from = 0.25F, alone = 0.6F;
};

// The water that a species likes.
struct Comfort {
    Span depthMetres{1, 40};
    double bestDepthMetres = 6;
    Span light{0, 1};
    Span waterCelsius{20, 32};
};

// How a species lives: what it feels, fears, eats and likes. Formulas: Tu & Terzopoulos 1994 and Tu
// 1996, with their time units taken as seconds and their distances given in metres or body lengths
// (docs/minds.md). The values here are those of habits built in code; species.proto says which a
// file may leave out.
struct Habits {
    Role role = Role::Prey;
    Hunger hunger;
    float libidoPerSecond = 0;  // p1; 0: never mates
    // At sunset and dusk a female rises fast and males follow; else pairs court at all active
    // hours.
    bool spawnsInRush = false;
    Fear fear;
    HabitShares shares;
    Comfort comfort;
    Paces paces;
    double gradualShare = 0.8;  // of turns for no reason; the others are sharp
    float visionBodyLengths = 14;
    float smellBodyLengths = 16;  // food is sensed so far in every direction
    SensitivityBox box;
    float persistence = 0.3F;  // another target must be nearer by this share to be preferred
    Home home;
    std::optional<Cloud> cloud;
    std::optional<Graze> graze;
    std::optional<Territory> territory;
    std::vector<SiteKind> hidesIn;  // none: it flees in open water
    ActiveHours hours;
    std::vector<std::string> hunts;  // species by name
    Hunt hunt;
    std::optional<Cleans> cleans;
    double pairBodyLengths = 0;        // keeps this near to a partner of its species; 0: alone
    std::vector<std::string> shadows;  // species that it likes to follow closely
};

// All of a species' file.
struct Species {
    std::string text;    // of the file, as it was read: recorded, and sent to the nodes
    std::string motion;  // all of it that moves the animal, in one form: no habits, colours or
                         // comments. Two species that agree in it swim alike
    std::string name;
    SizeRange size;
    BodyProfile profile;
    Fins fins;
    FinMotion finMotion;
    FishEye eye;
    Mouth mouth;
    Gill gill;
    std::vector<Thread> threads;
    Skeleton skeleton;
    Tissue tissue;
    Water water;
    Swim swim;
    Turn turn;
    FastStart start;
    Habits habits;
    std::vector<Paint> palette;
    // The repertoire keeps the control points of every frame (eq. 9) beside the nodal points, which
    // saves time and costs memory: for those that swim in great numbers.
    bool recordsControlPoints = false;
};

// Throws Error with file:line:column for whatever the schema or the animal cannot have. `source` is
// the file's name in errors.
[[nodiscard]] Species readSpecies(const std::string& path);
[[nodiscard]] Species parseSpecies(const std::string& text, const std::string& source);

}  // namespace aquarama::config
