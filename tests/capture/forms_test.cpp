// SPDX-License-Identifier: Apache-2.0
// The forms of swimming are told apart by midlines and fin beats alone.
#include "capture/report/forms.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture/measure.h"
#include "common/base/units.h"
#include "tests/capture/all_species.h"

namespace aquarama::report {
namespace {

using capture::allRepertoires;
using capture::allSpecies;
using motion::Action;

constexpr double kTwoPi = 2 * std::numbers::pi;

// What the species are in life: docs/motion.md gives the sources.
const std::map<std::string, SwimmingForm>& expectedForms() {
    static const std::map<std::string, SwimmingForm> kForms{
        {"bigeye_scad", SwimmingForm::Carangiform},
        {"bigeye_trevally", SwimmingForm::Carangiform},
        {"blacktip_reef_shark", SwimmingForm::HeadYawing},
        {"blue_tang", SwimmingForm::Labriform},
        {"butterflyfish", SwimmingForm::Labriform},
        {"cleaner_wrasse", SwimmingForm::Labriform},
        {"clownfish", SwimmingForm::Labriform},
        {"coral_grouper", SwimmingForm::Labriform},
        {"fusilier", SwimmingForm::Carangiform},
        {"green_chromis", SwimmingForm::Labriform},
        {"lionfish", SwimmingForm::HeadYawing},
        {"moorish_idol", SwimmingForm::Labriform},
        {"parrotfish", SwimmingForm::Labriform},
        {"powder_blue_tang", SwimmingForm::Labriform},
        {"sea_goldie", SwimmingForm::Labriform},
        {"sergeant", SwimmingForm::Labriform},
        {"trumpetfish", SwimmingForm::StiffBodied}};
    return kForms;
}

// The figures of a fish that is known by nothing else.
struct Fish {
    FormFigures slow, fast;
};
const std::vector<Fish>& allFish() {
    static const auto kAll = [] {
        std::vector<Fish> all;
        for (const motion::Repertoire& repertoire : allRepertoires())
            all.push_back(
                {formFigures(repertoire.segments.at(motion::indexOf(Action::ForwardSlow))),
                 formFigures(repertoire.segments.at(motion::indexOf(Action::ForwardFast)))});
        return all;
    }();
    return kAll;
}

class Forms : public testing::TestWithParam<std::size_t> {
  protected:
    [[nodiscard]] static const Fish& fish() { return allFish().at(GetParam()); }
    [[nodiscard]] static SwimmingForm expected() {
        return expectedForms().at(allSpecies().at(GetParam()).name);
    }
};
INSTANTIATE_TEST_SUITE_P(Of,
                         Forms,
                         testing::Range(std::size_t{0}, allSpecies().size()),
                         capture::nameOfSpecies);

TEST_P(Forms, areToldByMidlinesAndFinBeats) {
    const auto form = formOf(fish().slow, fish().fast);
    ASSERT_TRUE(form);
    EXPECT_STREQ(nameOf(*form), nameOf(expected()));
}

TEST_P(Forms, rowersRowWhenSlowAndAllBeatTheTailWhenFast) {
    EXPECT_EQ(isRowed(fish().slow), expected() == SwimmingForm::Labriform);
    EXPECT_EQ(beatsTail(fish().slow), expected() != SwimmingForm::Labriform);
    EXPECT_FALSE(isRowed(fish().fast));
    EXPECT_TRUE(beatsTail(fish().fast));
}

// With every figure 10 % more or less, in all combinations, a fish remains what it is. So each pair
// of forms is at least 20 % apart in some figure.
TEST_P(Forms, areApartByAMargin) {
    for (unsigned signs = 0; signs < 32; ++signs) {
        const auto factor = [&](unsigned bit) { return (signs >> bit & 1U) != 0 ? 1.1 : 0.9; };
        const auto changed = [&](FormFigures figures) {
            figures.tail *= factor(0);
            figures.finStroke *= factor(1);
            figures.swinging *= factor(2);
            figures.headYaw *= factor(3);
            figures.wavelength *= factor(4);
            return figures;
        };
        EXPECT_EQ(formOf(changed(fish().slow), changed(fish().fast)), expected()) << signs;
    }
}

// The form follows the motion: with the slow gait of a rower any fish is one, and no rower without.
TEST_P(Forms, belongToTheMotionNotToTheFish) {
    for (std::size_t other = 0; other < allFish().size(); ++other) {
        const bool rows =
            expectedForms().at(allSpecies().at(other).name) == SwimmingForm::Labriform;
        EXPECT_EQ(formOf(allFish().at(other).slow, fish().fast) == SwimmingForm::Labriform, rows)
            << other;
    }
    EXPECT_NE(formOf(fish().fast, fish().fast), SwimmingForm::Labriform);
    EXPECT_FALSE(formOf(fish().fast, FormFigures{})) << "a fish that does not beat its tail";
}

// A swimmer of which everything is known: a wave and two strokes in a cycle of a second.
struct Known {
    double wavelength = 1;  // negative: it runs towards the head
    int waves = 1;          // in a cycle
    int strokes = 1;
    double strokeRadians = 0;
    double apartRadians = 0;  // left behind right
};
constexpr std::array<double, capture::kWaveStations> kStations{0, 0.2, 0.4, 0.55, 0.7, 0.85, 1};
constexpr double kSpeed = 0.6;

// Of the wave; the tail swings by 0.2, and half of that at 0.66.
double halfSwingAt(double s) {
    return 0.02 - 0.08 * s + 0.16 * s * s;
}

motion::ActionSegment swimming(const Known& known) {
    motion::ActionSegment segment;
    segment.periodSeconds = 1;
    for (std::size_t k = 0; k < motion::kPhases; ++k) {
        const double cycle = static_cast<double>(k) / motion::kPhases;
        segment.increments.at(k).translation = {kSpeed / motion::kPhases, 0, 0};
        for (std::size_t node = 0; node < std::size_t{body::kNodalPoints}; ++node) {
            const double s = kStations.at(node == 0 ? 0 : 1 + (node - 1) / 4);
            const double phase = kTwoPi * (known.waves * cycle - s / known.wavelength);
            const double z = halfSwingAt(s) * std::sin(phase);
            segment.nodes.at(k).at(node) = {
                static_cast<std::int16_t>(std::lround((0.4 - s) * 32767)),
                0,
                static_cast<std::int16_t>(std::lround(z * 32767))};
        }
        const auto stroke = [&](double behind) {
            const double angle =
                known.strokeRadians / 2 * std::sin(kTwoPi * known.strokes * cycle - behind);
            return static_cast<std::int16_t>(
                std::lround(angle / static_cast<double>(motion::kFinUnit)));
        };
        segment.fins.at(k) = {motion::FinAngles{8000, stroke(known.apartRadians), 0},
                              motion::FinAngles{8000, stroke(0), 0}};
    }
    return segment;
}

TEST(FormFigures, areThoseOfAKnownSwimmer) {
    const FormFigures figures = formFigures(swimming({.wavelength = 1.2,
                                                      .waves = 1,
                                                      .strokes = 2,
                                                      .strokeRadians = 80 * kDegree,
                                                      .apartRadians = 150 * kDegree}));
    EXPECT_NEAR(figures.speed, kSpeed, 1e-4);
    EXPECT_NEAR(figures.tailHertz, 1, 1e-6);
    EXPECT_NEAR(figures.stride, kSpeed, 1e-4);
    EXPECT_NEAR(figures.tail, 0.2, 2e-3);
    EXPECT_NEAR(figures.head, 0.04, 1e-3);
    EXPECT_NEAR(figures.least, 0.02, 2e-3);
    EXPECT_NEAR(figures.leastAt, 0.25, 0.08);
    EXPECT_NEAR(figures.swinging, 0.25, 0.02) << "of the envelope: half of the tail's at 0.75";
    EXPECT_NEAR(figures.wavelength, 1.2, 2e-3);
    EXPECT_NEAR(figures.strouhal, 0.2 / kSpeed, 5e-3);
    EXPECT_NEAR(figures.finHertz, 2, 1e-6);
    EXPECT_NEAR(figures.finStroke, 80 * kDegree, 0.3 * kDegree);
    EXPECT_NEAR(figures.finsApart, 150 * kDegree, 0.1 * kDegree);
}

// From ring 1 to the nose: the difference of two motions a sixth of a wave apart.
TEST(FormFigures, theHeadYawsAsItsEndsSwing) {
    const double between = kTwoPi * kStations[1] / 1.2;
    const double a = halfSwingAt(0);
    const double b = halfSwingAt(kStations[1]);
    const double across = std::sqrt(a * a + b * b - 2 * a * b * std::cos(between));
    const FormFigures figures = formFigures(swimming({.wavelength = 1.2}));
    EXPECT_NEAR(figures.headYaw, 2 * std::atan(across / kStations[1]), 0.1 * kDegree);
}

TEST(FormFigures, countBeatsInTheCycle) {
    const FormFigures figures = formFigures(swimming({.waves = 2}));
    EXPECT_NEAR(figures.tailHertz, 2, 1e-6);
    EXPECT_NEAR(figures.stride, kSpeed / 2, 1e-4);
    EXPECT_NEAR(figures.strouhal, 2 * 0.2 / kSpeed, 0.01);
    EXPECT_EQ(figures.finHertz, 0);
    EXPECT_EQ(figures.finStroke, 0);
}

TEST(Form, isNoneForTheWaveOfAnEelNorForFinsAndTailTogether) {
    const FormFigures eel = formFigures(swimming({.wavelength = 0.6}));
    EXPECT_TRUE(beatsTail(eel));
    EXPECT_FALSE(formOf(eel, eel));
    const FormFigures both = formFigures(swimming({.strokeRadians = 90 * kDegree}));
    EXPECT_FALSE(isRowed(both));
    EXPECT_FALSE(beatsTail(both));
    EXPECT_FALSE(formOf(both, both));
}

bool hasNull(const nlohmann::json& data) {
    return data.is_structured() ? std::ranges::any_of(data, hasNull) : data.is_null();
}

TEST(FormsData, holdsSlowAndFastGaitOfEachSpecies) {
    const nlohmann::json data = nlohmann::json::parse(formsData(allRepertoires()));
    EXPECT_FALSE(hasNull(data)) << "what is not a number has no JSON";
    ASSERT_EQ(data.size(), allSpecies().size());
    for (std::size_t i = 0; i < data.size(); ++i) {
        EXPECT_EQ(data[i]["species"], allSpecies().at(i).name);
        EXPECT_EQ(data[i]["form"], nameOf(expectedForms().at(allSpecies().at(i).name)));
        for (const char* gait : {"slow", "fast"}) {
            EXPECT_EQ(data[i][gait]["midlines"].size(), std::size_t{motion::kPhases});
            EXPECT_EQ(data[i][gait]["strokes_degrees"].size(), 2U);
            EXPECT_EQ(data[i][gait]["strokes_degrees"][0].size(), std::size_t{motion::kPhases});
        }
        EXPECT_EQ(data[i]["fast"]["figures"]["strouhal"], allFish().at(i).fast.strouhal);
    }
}

}  // namespace
}  // namespace aquarama::report
