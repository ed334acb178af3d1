// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "common/units/angle.h"
#include "master/capture/fidelity/fidelity_figures.h"
#include "master/capture/fidelity/paint.h"

namespace aquarama::fidelity {

namespace {

constexpr const char* kChosen = "#e0702c";
constexpr double kPanelWidth = 270;
constexpr double kPanelHeight = 190;
constexpr std::size_t kOurs = 7;

struct Quantity {
    const char* title;
    double (*of)(const VocabularyErrors&);
    int digits;
};
constexpr std::array kQuantities{
    Quantity{"shape within a segment, % BL",
             [](const VocabularyErrors& e) { return e.shapeWithin * 100; },
             1},
    Quantity{"path of a command, median, %",
             [](const VocabularyErrors& e) { return e.pathError * 100; },
             0},
    Quantity{
        "heading after a turn, rms, deg",
        [](const VocabularyErrors& e) { return e.turnHeadingError / kRadiansPerDegree<double>; },
        0}};

std::vector<double> valuesAt(std::span<const SpeciesVocabularies> species,
                             const Quantity& quantity,
                             std::size_t vocabulary) {
    std::vector<double> values;
    for (const SpeciesVocabularies& one : species)
        values.push_back(quantity.of(one.errors[vocabulary]));
    std::ranges::sort(values);
    return values;
}

class Panel {
  public:
    Panel(report::Svg& svg,
          double left,
          std::span<const SpeciesVocabularies> species,
          const Quantity& of)
        : svg_(svg), left_(left), species_(species), quantity_(of) {
        for (std::size_t i = 0; i < vocabularies(); ++i)
            most_ = std::max(most_, valuesAt(species, of, i).back());
    }
    void draw() {
        svg_.text({left_, kTop - 12}, quantity_.title, letters(13));
        for (const double share : {0.0, 0.5, 1.0}) {
            const glm::dvec2 at(left_, kTop + (1 - share) * kPanelHeight);
            svg_.line(at, at + glm::dvec2(kPanelWidth, 0), kGrid);
            svg_.text(at + glm::dvec2(-6, 4),
                      report::fixed(share * most_, quantity_.digits),
                      letters(12, "end"));
        }
        for (const SpeciesVocabularies& one : species_) plot(one);
        plotMedian();
        for (std::size_t i = 0; i < vocabularies(); ++i) label(i);
    }

  private:
    static constexpr double kTop = 36;

    [[nodiscard]] std::size_t vocabularies() const { return species_.front().errors.size(); }
    [[nodiscard]] glm::dvec2 at(std::size_t vocabulary, double value) const {
        const double step = kPanelWidth / static_cast<double>(vocabularies());
        return {left_ + step * (static_cast<double>(vocabulary) + 0.5),
                kTop + (1 - value / most_) * kPanelHeight};
    }
    void plot(const SpeciesVocabularies& one) {
        std::vector<glm::dvec2> points;
        for (std::size_t i = 0; i < vocabularies(); ++i)
            points.push_back(at(i, quantity_.of(one.errors[i])));
        svg_.polyline(points, stroke("#b9c6cd", 1.2));
    }
    void plotMedian() {
        std::vector<glm::dvec2> points;
        for (std::size_t i = 0; i < vocabularies(); ++i) {
            const std::vector<double> values = valuesAt(species_, quantity_, i);
            points.push_back(at(i, values[values.size() / 2]));
        }
        svg_.polyline(points, stroke(kInk, 2.2));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool isOurs = species_.front().errors[i].segments == kOurs;
            svg_.circle(points[i],
                        isOurs ? 5 : 3.5,
                        std::string("fill=\"") + (isOurs ? kChosen : kInk) + "\"");
        }
    }
    void label(std::size_t vocabulary) {
        const VocabularyErrors& errors = species_.front().errors[vocabulary];
        const glm::dvec2 foot = at(vocabulary, 0);
        svg_.text(foot + glm::dvec2(0, 18), std::to_string(errors.segments), letters(13, "middle"));
        svg_.text(foot + glm::dvec2(0, 34),
                  report::fixed(static_cast<double>(errors.bytes) / 1e6, 1),
                  letters(11, "middle"));
    }

    report::Svg& svg_;
    double left_;
    std::span<const SpeciesVocabularies> species_;
    const Quantity& quantity_;
    double most_ = 1e-9;
};

}  // namespace

std::string drawVocabularies(std::span<const SpeciesVocabularies> species) {
    constexpr double kStep = kPanelWidth + 80;
    report::Svg svg(1080, 306);
    for (std::size_t i = 0; i < kQuantities.size(); ++i)
        Panel(svg, 44 + kStep * static_cast<double>(i), species, kQuantities.at(i)).draw();
    constexpr double kFoot = 290;
    svg.text({44, kFoot + 4}, "above: segments; below: MB with control points", letters(12));
    svg.line({394, kFoot}, {418, kFoot}, stroke("#b9c6cd", 1.2));
    svg.text({426, kFoot + 4}, "one species", letters(12));
    svg.line({530, kFoot}, {554, kFoot}, stroke(kInk, 2.2));
    svg.text({562, kFoot + 4}, "their median", letters(12));
    svg.circle({680, kFoot}, 5, std::string("fill=\"") + kChosen + "\"");
    svg.text({692, kFoot + 4}, "the seven of every repertoire here", letters(12));
    return std::move(svg).finish();
}

}  // namespace aquarama::fidelity
