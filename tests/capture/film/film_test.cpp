// SPDX-License-Identifier: Apache-2.0
// The film of fish and replica: what happens in it, and what each part of a picture shows.
#include "capture/film/film.h"

#include <algorithm>
#include <set>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "capture/film/film_script.h"
#include "common/base/units.h"
#include "common/config/species.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::film {
namespace {

using report::Manoeuvre;

const motion::Repertoire& repertoire() {
    static const motion::Repertoire made = test::syntheticRepertoire(false);
    return made;
}

// A replica of the synthetic repertoire in the place of both fish, in a plain skin.
Film::Shown shownBy(const report::Script& script) {
    Film::Shown shown;
    shown.body =
        body::makeBody(config::readSpecies(AQUARAMA_SOURCE_DIR "/config/species/clownfish.txtpb"));
    shown.skin.table = skin::makeLimitTable(shown.body, 1);
    shown.skin.colours.assign(shown.skin.table.indices.size(), glm::vec4(0.5F, 0.2F, 0.1F, 1));
    shown.script = script;
    shown.fish = report::traceReplica(repertoire(), script);
    shown.replica = shown.fish;
    return shown;
}

const report::Script kMedium{{Manoeuvre::ForwardMedium, 40, 20},
                             {Manoeuvre::ForwardMedium, 40, 20}};

// Mean difference of the codes of two parts of pictures, of this size.
double differenceOf(
    const Picture& a, glm::ivec2 from, const Picture& b, glm::ivec2 other, glm::ivec2 size) {
    double sum = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto codeOf = [&](const Picture& picture, glm::ivec2 corner) {
                    const int pixel = (corner.y + y) * picture.sizePixels.x + corner.x + x;
                    return static_cast<int>(picture.rgb[static_cast<std::size_t>(3 * pixel + c)]);
                };
                sum += std::abs(codeOf(a, from) - codeOf(b, other));
            }
    return sum / (3.0 * size.x * size.y);
}

// The middle of the views from above and from the side, where no text is.
constexpr glm::ivec2 kAbove{100, 40}, kSide{750, 50}, kPart{300, 140};
constexpr glm::ivec2 kNextBand{0, 204};

TEST(FilmScript, hasEveryManoeuvreAndStartsFromRestAndFromSwimming) {
    const report::Script script = filmScript(repertoire(), kWholeFilmSeconds);
    std::set<Manoeuvre> seen;
    std::set<Manoeuvre> beforeStarts;
    for (std::size_t i = 1; i < script.size(); ++i) {
        seen.insert(script[i].manoeuvre);
        if (report::isStart(script[i].manoeuvre)) beforeStarts.insert(script[i - 1].manoeuvre);
    }
    // Of six fast starts four: the others are the mirror images of two.
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(report::kManoeuvres) - 2);
    EXPECT_EQ(beforeStarts, (std::set{Manoeuvre::ForwardMedium, Manoeuvre::Hover}));
}

TEST(FilmScript, endsWithItsSeconds) {
    const report::Script script = filmScript(repertoire(), 2.5);
    EXPECT_EQ(report::ticksOf(script), 150);
    EXPECT_EQ(report::ticksOf(filmScript(repertoire(), 600)),
              report::ticksOf(filmScript(repertoire(), 700)));
}

TEST(Film, showsEveryOtherTickAndFastStartsAtAQuarterOfTheirSpeed) {
    EXPECT_EQ(Film(shownBy(kMedium)).pictures(), 20U);
    report::Script script = kMedium;
    script.push_back(report::briefest(repertoire(), Manoeuvre::StartLeftLarge));
    script.push_back({Manoeuvre::ForwardFast, 40, 20});
    const auto slow =
        static_cast<std::size_t>(script[2].ticks) + 7;  // and a little of what follows
    EXPECT_EQ(Film(shownBy(script)).pictures(), 20 + 2 * slow + (40 - 7) / 2);
}

TEST(Film, aReplicaThatIsTheFishLooksLikeItAndItsGhostLiesOverIt) {
    const Film film(shownBy(kMedium));
    const Picture picture = film.picture(7);
    EXPECT_EQ(picture.sizePixels, kFilmPixels);
    for (const glm::ivec2 part : {kAbove, kSide}) {
        EXPECT_EQ(differenceOf(picture, part, picture, part + kNextBand, kPart), 0);
        EXPECT_GT(differenceOf(picture, part, picture, part + 2 * kNextBand, kPart), 1);
    }
    EXPECT_GT(differenceOf(picture, kSide, film.picture(12), kSide, kPart), 0.2) << "nothing moves";
}

TEST(Film, aReplicaThatGoesAstrayLeavesTheFish) {
    Film::Shown astray = shownBy(kMedium);
    for (std::size_t tick = 41; tick < astray.replica.size(); ++tick)
        astray.replica[tick].frame.origin.z += 0.007 * static_cast<double>(tick - 40);
    const Film film(std::move(astray));
    const Film straight(shownBy(kMedium));
    const Picture late = film.picture(19);
    const Picture expected = straight.picture(19);
    EXPECT_EQ(differenceOf(late, kAbove, expected, kAbove, kPart), 0) << "the fish is as it was";
    EXPECT_GT(differenceOf(late, kAbove + 2 * kNextBand, expected, kAbove + 2 * kNextBand, kPart),
              2)
        << "the ghost is beside it";
}

TEST(Film, finsAreDrawnAsTheyStand) {
    Film::Shown rowing = shownBy(kMedium);
    for (report::TracePoint& point : rowing.fish)
        point.drive.left.open = point.drive.right.open = 1.2F;
    const Picture open = Film(std::move(rowing)).picture(3);
    const Picture folded = Film(shownBy(kMedium)).picture(3);
    EXPECT_GT(differenceOf(open, kAbove, folded, kAbove, kPart), 0.05);
    EXPECT_EQ(differenceOf(open, kAbove + kNextBand, folded, kAbove + kNextBand, kPart), 0);
}

// The trace of a fish that goes along +x and faces so many degrees to the left of it.
report::Trace crabbing(double degrees, double bodyLengthsASecond) {
    report::Trace trace(61);
    const glm::dmat3 turned =
        glm::mat3_cast(glm::angleAxis(degrees * kRadiansPerDegree<double>, glm::dvec3(0, 1, 0)));
    for (std::size_t tick = 0; tick < trace.size(); ++tick)
        trace[tick].frame = {
            glm::dvec3(bodyLengthsASecond * static_cast<double>(tick) / kTicksPerSecond, 0, 0),
            turned};
    return trace;
}

TEST(Slip, isTheAngleBetweenFaceAndPath) {
    EXPECT_NEAR(slipDegrees(crabbing(0, 1), 30).value(), 0, 1e-5);
    EXPECT_NEAR(slipDegrees(crabbing(25, 1), 30).value(), 25, 1e-5);
    EXPECT_FALSE(slipDegrees(crabbing(25, 0.1), 30)) << "it hardly moves";
    EXPECT_FALSE(slipDegrees(crabbing(180, 1), 30)) << "it backs";
    EXPECT_FALSE(slipDegrees(crabbing(25, 1), 10)) << "before the first half second";
}

}  // namespace
}  // namespace aquarama::film
